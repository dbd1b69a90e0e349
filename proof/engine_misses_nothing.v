(* The theorems: no sequence of steps of a world lets time pass a begin or an end of a contact that the contact graph
   does not know of, whether the world goes on in one cluster or in many. *)
From Coq Require Import Reals Lra Lia Bool Arith.
From Kinesphere Require Import engine_machine engine_keeps engine_clusters.
Open Scope R_scope.

Section Part.
Context {W : World} {L : Lemmas W}.
Variable on : rule -> Prop.
Hypothesis obeyed : forall r, on r.

Variables (s : state) (cluster : body -> option nat) (stop : R) (f : nat -> state) (g : entry -> Prop).
Hypothesis K : keeps everybody s.
Hypothesis A : accepted on s cluster stop f g.
Hypothesis kept : forall h, queue s h -> stop <= due h -> g h.
Hypothesis left : forall i h, queue (f i) h -> stop <= due h \/ concerns (own_of cluster i) h -> g h.

Let m := merged s cluster stop f g.
Let own (i : nat) := own_of cluster i.

Lemma is_own i a : cluster a = Some i -> own_of cluster i a = true.
Proof. unfold own_of. intros ->. apply Nat.eqb_refl. Qed.
Lemma not_own i j a : cluster a = Some j -> i <> j -> own_of cluster i a = false.
Proof. unfold own_of. intros ->. apply Nat.eqb_neq. Qed.
Lemma unassigned i a : cluster a = None -> own_of cluster i a = false.
Proof. unfold own_of. intros ->. reflexivity. Qed.
Lemma moves a i : cluster a = Some i -> static a = false.
Proof. intros E. destruct (static a) eqn:F; [|reflexivity]. apply (static_are_unassigned _ _ _ _ _ _ A) in F. congruence. Qed.

Lemma cluster_keeps i : keeps (own_of cluster i) (f i).
Proof. eapply steps_keep; [exact obeyed|apply (have_run _ _ _ _ _ _ A)|]. apply begin_keeps. exact K. Qed.
Lemma cluster_beside i : beside (own_of cluster i) (begin_batch s) (f i).
Proof.
  destruct (nothing_waits _ _ _ _ _ _ A) as [C N].
  eapply steps_beside; [exact obeyed|apply (have_run _ _ _ _ _ _ A)| |exact N|].
  - apply begin_keeps. exact K.
  - apply begin_beside; assumption.
Qed.
Lemma come i : now (f i) = stop.
Proof. apply (have_come _ _ _ _ _ _ A). Qed.
Lemma begins : now s <= stop.
Proof. apply (in_epoch _ _ _ _ _ _ A). Qed.

Lemma clean_before a : there (bodies s a) = true -> clean s a.
Proof. intros T. split; [exact T|]. apply (nothing_waits _ _ _ _ _ _ A). exact T. Qed.
Lemma clean_m a : clean m a -> clean s a.
Proof.
  intros [T _]. apply clean_before. simpl in T. destruct (cluster a) eqn:E; [|exact T].
  rewrite (none_is_added _ _ _ (cluster_beside n) a) in T. exact T.
Qed.

Lemma unassigned_window a u : cluster a = None -> clean s a -> u < stop -> before u (window (bodies s a)).
Proof.
  intros I C U. destruct (windows_will_end _ _ K a eq_refl C) as [N|(v & G & R)].
  - apply N. destruct (in_epoch _ _ _ _ _ _ A) as [_ P]. destruct (epoch s); simpl in *; [lra|exact Logic.I].
  - assert (stop <= v).
    { destruct (Rle_or_lt stop v) as [|Lt]; [assumption|exfalso].
      apply (due_in_one_cluster _ _ _ _ _ _ A _ G eq_refl Lt); [apply obeyed|exact I]. }
    destruct (window (bodies s a)); simpl in *; [lra|exact Logic.I].
Qed.

(* Updated bodies of different clusters: the pair is right as long as both windows last or, if not, until it is due. *)
Lemma updated_are_right i j a b k l :
  (a < b)%nat -> cluster a = Some i -> cluster b = Some j -> i <> j -> clean s b ->
  updates (f i) k -> updated k = a -> updates (f j) l -> updated l = b ->
  exists u, (forall t, since k <= t -> since l <= t -> before t (lasts k) -> before t (lasts l) -> before t u ->
                       ~ wrong (graph s a b) (a, with_revision k) (b, with_revision l) t) /\
    (u = None \/ exists v, u = Some v /\ stop <= v /\
      (forall t, since k <= t -> since l <= t -> t < v -> ~ wrong (graph s a b) (a, with_revision k) (b, with_revision l) t) /\
      (last_of (f i) k -> last_of (f j) l -> g (Pair v (a, with_revision k) (b, with_revision l)))).
Proof.
  intros Lt Ia Ib D Cb Hk <- Hl <-.
  destruct (updates_are_right _ _ _ (cluster_beside i) k Hk) as (_ & Nk & Kk & _ & Fk).
  destruct (updates_are_right _ _ _ (cluster_beside j) l Hl) as (_ & Nl & Kl & _). simpl in Nk, Nl.
  destruct (Fk (updated l)) as [Ap _];
    [eapply not_own; eauto|eapply moves; eauto|exact Cb|]. specialize (Ap Lt). simpl in Ap. rewrite Ap.
  destruct (updated_stay_apart _ _ _ _ _ _ A (obeyed _) i j k l D Lt Hk Hl) as [O|(u & Ce & [Sp|(v & -> & Sv & G)])].
  - exists None. split; [|left; reflexivity]. intros t Sk Sl Wk Wl _ V.
    destruct (apart_without_a_common_place _ _ _ V) as (p & Fp & Fq).
    eapply searches_are_complete; [exact O| |exact Wk|exact Wl| |]; [lra| |];
      eapply swept_spheres_hold; eauto; lra.
  - exists None. split; [|left; reflexivity]. intros t Sk Sl Wk Wl _.
    eapply certificates_are_early; eauto. apply Rmax_lub; assumption.
  - assert (Q : forall t, since k <= t -> since l <= t -> t < v ->
             ~ wrong apart (updated k, with_revision k) (updated l, with_revision l) t).
    { intros t Sk Sl U. eapply (certificates_are_early _ _ _ _ (Some v)); [exact Ce|exact Kk|exact Kl|exact Sk|exact Sl| |exact U].
      apply Rmax_lub; assumption. }
    exists (Some v). split; [intros t Sk Sl _ _ U; apply Q; assumption|]. right. exists v.
    split; [reflexivity|]. split; [exact Sv|]. split; [exact Q|]. intros; apply G; split; assumption.
Qed.

(* A fact of a cluster is a fact of the world if the cluster has the present state of its two bodies. *)
Lemma fact_of_cluster i a b :
  (a < b)%nat -> some_of (own_of cluster i) a b -> clean (f i) a -> clean (f i) b -> ~ news (f i) a b ->
  graph m a b = graph (f i) a b ->
  revision (bodies m a) = revision (bodies (f i) a) -> revision (bodies m b) = revision (bodies (f i) b) ->
  window (bodies m a) = window (bodies (f i) a) -> window (bodies m b) = window (bodies (f i) b) ->
  fact m a b.
Proof.
  intros Lt So Ca Cb N Bo Sa Sb Wa Wb.
  destruct (facts_hold _ _ (cluster_keeps i) a b Lt So Ca Cb) as [H|[H|(v & G & H)]].
  - contradiction.
  - right; left. unfold right_at, motion_of. rewrite Bo, Sa, Sb, Wa, Wb. simpl. rewrite <- (come i). exact H.
  - right; right. exists v. unfold right_at, motion_of. rewrite Bo, Sa, Sb. split.
    + apply (left i); [exact G|]. right. exact So.
    + simpl. rewrite <- (come i). exact H.
Qed.

Lemma covers_two i a b : cluster a = Some i -> cluster b = Some i -> covers (own_of cluster i) a b = true.
Proof. intros Ia Ib. apply covers_own; apply is_own; assumption. Qed.
Lemma covers_static i a b : cluster a = Some i -> static b = true -> covers (own_of cluster i) a b = true.
Proof. intros Ia F. unfold covers. rewrite (is_own i a Ia), F. destruct (own_of cluster i b), (static a); reflexivity. Qed.
Lemma covers_static' i a b : cluster b = Some i -> static a = true -> covers (own_of cluster i) a b = true.
Proof. intros Ib F. unfold covers. rewrite (is_own i b Ib), F. destruct (own_of cluster i a), (static b); reflexivity. Qed.
Lemma covers_not i a b :
  own_of cluster i b = false -> static b = false -> covers (own_of cluster i) a b = false.
Proof. intros O F. unfold covers. rewrite O, F, !andb_false_r. reflexivity. Qed.
Lemma covers_not' i a b :
  own_of cluster i a = false -> static a = false -> covers (own_of cluster i) a b = false.
Proof. intros O F. unfold covers. rewrite O, F. reflexivity. Qed.

Lemma clean_own i a : cluster a = Some i -> clean m a -> clean (f i) a.
Proof. intros I [T D]. simpl in T, D. rewrite I in T, D. split; assumption. Qed.
Lemma stays i a : own_of cluster i a = false -> bodies (f i) a = bodies s a.
Proof. apply (others_stay _ _ _ (cluster_beside i)). Qed.
Lemma clean_other i a : own_of cluster i a = false -> clean s a -> clean (f i) a.
Proof. intros O. unfold clean. rewrite (stays i a O). trivial. Qed.

Lemma no_news i a b : (a < b)%nat -> ~ news (f i) a b.
Proof.
  intros Lt. destruct (covers (own_of cluster i) a b) eqn:Cv.
  - apply (are_finished _ _ _ _ _ _ A i); assumption.
  - intros N. apply (other_pairs_stay _ _ _ (cluster_beside i) a b Lt Cv) in N.
    apply (nothing_waits _ _ _ _ _ _ A) in N; assumption.
Qed.

Lemma graph_of_others i a b : (a < b)%nat -> covers (own_of cluster i) a b = false -> graph (f i) a b = graph s a b.
Proof. intros Lt Cv. apply (other_pairs_stay _ _ _ (cluster_beside i) a b Lt Cv). Qed.

Lemma merged_facts a b : (a < b)%nat -> clean m a -> clean m b -> fact m a b.
Proof.
  intros Lt Ca Cb. assert (Ca0 := clean_m a Ca). assert (Cb0 := clean_m b Cb).
  destruct (cluster a) as [i|] eqn:Ia; destruct (cluster b) as [j|] eqn:Ib.
  - destruct (Nat.eq_dec i j) as [<-|D].
    + apply (fact_of_cluster i); trivial; try (apply clean_own; assumption); try (apply no_news; assumption);
        try (simpl; rewrite ?Ia, ?Ib; reflexivity).
      * left. apply is_own; exact Ia.
      * simpl. unfold cluster_of. rewrite Ia, Ib, Nat.eqb_refl. reflexivity.
    + assert (Bo : graph m a b = graph s a b).
      { simpl. unfold cluster_of. rewrite Ia, Ib. apply Nat.eqb_neq in D. rewrite D. reflexivity. }
      assert (Oa : own_of cluster j a = false) by (eapply not_own; eauto).
      assert (Ob : own_of cluster i b = false) by (eapply not_own; eauto).
      destruct (has_an_update _ _ _ (cluster_beside j) b (is_own j b Ib) (clean_own j b Ib Cb)) as [(_ & S2 & W2)|(l & Hl & l1 & l2 & l3)].
      * apply (fact_of_cluster i); trivial; try (apply no_news; assumption).
        -- left. apply is_own; exact Ia.
        -- apply clean_own; assumption.
        -- apply clean_other; assumption.
        -- rewrite Bo, graph_of_others; trivial. apply covers_not; [exact Ob|eapply moves; eauto].
        -- simpl. rewrite Ia. reflexivity.
        -- simpl in *. rewrite Ib, (stays i b Ob). exact S2.
        -- simpl. rewrite Ia. reflexivity.
        -- simpl in *. rewrite Ib, (stays i b Ob). exact W2.
      * destruct (has_an_update _ _ _ (cluster_beside i) a (is_own i a Ia) (clean_own i a Ia Ca)) as [(_ & S2 & W2)|(k & Hk & k1 & k2 & k3)].
        -- apply (fact_of_cluster j); trivial; try (apply no_news; assumption).
           ++ right. apply is_own; exact Ib.
           ++ apply clean_other; assumption.
           ++ apply clean_own; assumption.
           ++ rewrite Bo, graph_of_others; trivial. apply covers_not'; [exact Oa|eapply moves; eauto].
           ++ simpl in *. rewrite Ia, (stays j a Oa). exact S2.
           ++ simpl. rewrite Ib. reflexivity.
           ++ simpl in *. rewrite Ia, (stays j a Oa). exact W2.
           ++ simpl. rewrite Ib. reflexivity.
        -- destruct (updates_are_right _ _ _ (cluster_beside i) k Hk) as (_ & Nk & _).
           destruct (updates_are_right _ _ _ (cluster_beside j) l Hl) as (_ & Nl & _).
           rewrite come in Nk, Nl.
           assert (Ma : motion_of m a = (a, with_revision k)) by (unfold motion_of; simpl; rewrite Ia, k2; reflexivity).
           assert (Mb : motion_of m b = (b, with_revision l)) by (unfold motion_of; simpl; rewrite Ib, l2; reflexivity).
           destruct (updated_are_right i j a b k l Lt Ia Ib D Cb0 Hk k1 Hl l1) as (u & Q & [->|(v & -> & Sv & Q' & G)]).
           ++ right; left. intros t N Wa Wb. unfold right_at. rewrite Bo, Ma, Mb. simpl in N, Wa, Wb.
              rewrite Ia, <- k3 in Wa. rewrite Ib, <- l3 in Wb. apply Q; try assumption; try lra. exact Logic.I.
           ++ right; right. exists v. unfold right_at. rewrite Bo, Ma, Mb. split.
              ** simpl. apply G; unfold last_of; [rewrite k1|rewrite l1]; auto.
              ** intros t N. simpl in N. apply Q'; lra.
  - assert (Ob : own_of cluster i b = false) by (apply unassigned; exact Ib).
    apply (fact_of_cluster i); trivial; try (apply no_news; assumption).
    + left. apply is_own; exact Ia.
    + apply clean_own; assumption.
    + apply clean_other; assumption.
    + simpl. unfold cluster_of. rewrite Ia, Ib. destruct (static b) eqn:Fb; [reflexivity|].
      symmetry. apply graph_of_others; [exact Lt|]. apply covers_not; assumption.
    + simpl. rewrite Ia. reflexivity.
    + simpl. rewrite Ib, (stays i b Ob). reflexivity.
    + simpl. rewrite Ia. reflexivity.
    + simpl. rewrite Ib, (stays i b Ob). reflexivity.
  - assert (Oa : own_of cluster j a = false) by (apply unassigned; exact Ia).
    apply (fact_of_cluster j); trivial; try (apply no_news; assumption).
    + right. apply is_own; exact Ib.
    + apply clean_other; assumption.
    + apply clean_own; assumption.
    + simpl. unfold cluster_of. rewrite Ia, Ib. destruct (static a) eqn:Fa; [reflexivity|].
      symmetry. apply graph_of_others; [exact Lt|]. apply covers_not'; assumption.
    + simpl. rewrite Ia, (stays j a Oa). reflexivity.
    + simpl. rewrite Ib. reflexivity.
    + simpl. rewrite Ia, (stays j a Oa). reflexivity.
    + simpl. rewrite Ib. reflexivity.
  - assert (Ea : bodies m a = bodies s a) by (simpl; rewrite Ia; reflexivity).
    assert (Eb : bodies m b = bodies s b) by (simpl; rewrite Ib; reflexivity).
    assert (Bo : graph m a b = graph s a b) by (simpl; unfold cluster_of; rewrite Ia, Ib; reflexivity).
    unfold fact, right_at, motion_of. rewrite Ea, Eb, Bo.
    destruct (facts_hold _ _ K a b Lt (or_introl eq_refl) Ca0 Cb0) as [H|[H|(v & G & H)]].
    + apply (nothing_waits _ _ _ _ _ _ A) in H; [contradiction|exact Lt].
    + right; left. intros t N. apply H. simpl in N. pose proof begins as Bg. lra.
    + right; right. exists v. split.
      * apply kept; [exact G|]. simpl. destruct (Rle_or_lt stop v) as [|Lt']; [assumption|exfalso].
        apply (due_in_one_cluster _ _ _ _ _ _ A _ G (conj eq_refl eq_refl) Lt'); [apply obeyed|].
        simpl. unfold cluster_of. rewrite Ia, Ib. reflexivity.
      * intros t N. apply H. simpl in N. pose proof begins as Bg. lra.
Qed.

Lemma lived_before a t e : t < now s -> lived m a t e -> lived s a t e.
Proof.
  intros Lt. simpl. destruct (cluster a) as [i|] eqn:Ia.
  - intros H. destruct (nothing_is_forgotten _ _ _ (cluster_beside i)) as (B1 & _).
    destruct (B1 a t e H) as [[_ N]|H']; [simpl in N; lra|exact H'].
  - intros [H|(_ & N & _)]; [exact H|lra].
Qed.
Lemma stood_before a b t r : t < now s -> stood m a b t r -> stood s a b t r.
Proof.
  intros Lt. simpl. destruct (cluster_of cluster a b) as [i|].
  - intros H. destruct (nothing_is_forgotten _ _ _ (cluster_beside i)) as (_ & B2 & _).
    destruct (B2 a b t r H) as [N|H']; [simpl in N; lra|exact H'].
  - intros [H|(N & _)]; [exact H|lra].
Qed.

(* A body of no cluster, at a time of the batch. *)
Lemma seen_unassigned i a t e :
  cluster a = None -> now s <= t -> lived m a t e -> seen (own_of cluster i) (begin_batch s) (f i) a t e.
Proof.
  intros I N H. unfold seen. rewrite (unassigned i a I). simpl in *. rewrite I in H.
  destruct H as [H|(T & U & ->)]; [apply (past_is_past _ _ K) in H; lra|].
  assert (C := clean_before a T). repeat split; try apply C. apply unassigned_window; trivial. lra.
Qed.
Lemma seen_own i a t e : cluster a = Some i -> lived m a t e -> seen (own_of cluster i) (begin_batch s) (f i) a t e.
Proof. intros I H. unfold seen. rewrite (is_own i a I). simpl in H. rewrite I in H. exact H. Qed.

(* A pair of no cluster: the contact graph says what it said when the batch began. *)
Lemma right_beside i a b t e h :
  (a < b)%nat -> some_of (own_of cluster i) a b -> covers (own_of cluster i) a b = false -> now s <= t < stop ->
  seen (own_of cluster i) (begin_batch s) (f i) a t e -> seen (own_of cluster i) (begin_batch s) (f i) b t h ->
  ~ wrong (graph s a b) (a, e) (b, h) t.
Proof.
  intros Lt So Cv [N U] Sa Sb. assert (B := cluster_beside i).
  destruct (all_is_recorded _ _ _ B t) as [_ R]; [simpl; rewrite come; lra|].
  destruct (R a b So) as [r St]. assert (r = graph s a b) by (eapply (other_graphs_stood _ _ _ B); eauto). subst r.
  eapply (pairs_are_right _ _ _ B); eauto.
Qed.

Lemma merged_past a b t e h r :
  (a < b)%nat -> lived m a t e -> lived m b t h -> stood m a b t r -> ~ wrong r (a, e) (b, h) t.
Proof.
  intros Lt La Lb St. destruct (Rlt_or_le t (now s)) as [Be|N].
  { apply (past_is_right _ _ K a b t e h r Lt eq_refl eq_refl);
      [apply lived_before|apply lived_before|apply stood_before]; assumption. }
  assert (U : t < stop).
  { simpl in La. destruct (cluster a) as [i|] eqn:Ia.
    - apply (past_is_past _ _ (cluster_keeps i)) in La. rewrite come in La. exact La.
    - destruct La as [La|(_ & V & _)]; [apply (past_is_past _ _ K) in La; pose proof begins as Bg; lra|lra]. }
  destruct (cluster_of cluster a b) as [i|] eqn:Io.
  - (* the pair of a cluster *)
    assert (St' : stood (f i) a b t r) by (simpl in St; rewrite Io in St; exact St).
    assert (X : some_of (own_of cluster i) a b /\ seen (own_of cluster i) (begin_batch s) (f i) a t e /\
                seen (own_of cluster i) (begin_batch s) (f i) b t h).
    { unfold cluster_of in Io. destruct (cluster a) as [k|] eqn:Ia; destruct (cluster b) as [j|] eqn:Ib.
      - destruct (Nat.eqb_spec k j); [subst|discriminate]. injection Io as <-.
        split; [left; apply is_own; exact Ia|]. split; apply seen_own; assumption.
      - destruct (static b); [|discriminate]. injection Io as <-.
        split; [left; apply is_own; exact Ia|]. split; [apply seen_own|apply seen_unassigned]; assumption.
      - destruct (static a); [|discriminate]. injection Io as <-.
        split; [right; apply is_own; exact Ib|]. split; [apply seen_unassigned|apply seen_own]; assumption.
      - discriminate. }
    destruct X as (So & Sa & Sb). eapply (pairs_are_right _ _ _ (cluster_beside i)); eauto.
  - assert (r = graph s a b); [|subst r].
    { simpl in St. rewrite Io in St. destruct St as [St|[_ E]]; [|exact E].
      apply (past_is_past _ _ K) in St. lra. }
    unfold cluster_of in Io. destruct (cluster a) as [i|] eqn:Ia; destruct (cluster b) as [j|] eqn:Ib.
    + destruct (Nat.eqb_spec i j) as [|D]; [discriminate|].
      assert (Oa : own_of cluster j a = false) by (eapply not_own; eauto).
      assert (Ob : own_of cluster i b = false) by (eapply not_own; eauto).
      assert (La' := seen_own i a t e Ia La). assert (Lb' := seen_own j b t h Ib Lb).
      assert (La2 : lived (f i) a t e) by (simpl in La; rewrite Ia in La; exact La).
      assert (Lb2 : lived (f j) b t h) by (simpl in Lb; rewrite Ib in Lb; exact Lb).
      destruct (motions_are_known _ _ _ (cluster_beside j) b t h (is_own j b Ib) N Lb2) as [(C & E & Wi)|(l & Hl & l1 & l2 & l3 & l4)].
      * apply (right_beside i); trivial.
        -- left. apply is_own; exact Ia.
        -- apply covers_not; [exact Ob|eapply moves; eauto].
        -- split; assumption.
        -- unfold seen. rewrite Ob. auto.
      * destruct (motions_are_known _ _ _ (cluster_beside i) a t e (is_own i a Ia) N La2) as [(C & E & Wi)|(k & Hk & k1 & k2 & k3 & k4)].
        -- apply (right_beside j); trivial.
           ++ right. apply is_own; exact Ib.
           ++ apply covers_not'; [exact Oa|eapply moves; eauto].
           ++ split; assumption.
           ++ unfold seen. rewrite Oa. auto.
        -- rewrite <- k2, <- l2.
           assert (Cb : clean s b).
           { apply clean_before. rewrite <- l1. apply (updates_are_right _ _ _ (cluster_beside j) l Hl). }
           destruct (updated_are_right i j a b k l Lt Ia Ib D Cb Hk k1 Hl l1) as (u & Q & [->|(v & -> & Sv & Q' & _)]).
           ++ apply Q; try assumption. exact Logic.I.
           ++ apply Q'; trivial. lra.
    + destruct (static b) eqn:Fb; [discriminate|]. apply (right_beside i); trivial.
      * left. apply is_own; exact Ia.
      * apply covers_not; [apply unassigned; exact Ib|exact Fb].
      * split; assumption.
      * apply seen_own; assumption.
      * apply seen_unassigned; assumption.
    + destruct (static a) eqn:Fa; [discriminate|]. apply (right_beside j); trivial.
      * right. apply is_own; exact Ib.
      * apply covers_not'; [apply unassigned; exact Ia|exact Fa].
      * split; assumption.
      * apply seen_unassigned; assumption.
      * apply seen_own; assumption.
    + assert (Sa := seen_unassigned 0 a t e Ia N La). assert (Sb := seen_unassigned 0 b t h Ib N Lb).
      unfold seen in Sa, Sb. rewrite (unassigned 0 a Ia) in Sa. rewrite (unassigned 0 b Ib) in Sb.
      destruct Sa as (-> & Ca & Wa). destruct Sb as (-> & Cb & Wb).
      destruct (facts_hold _ _ K a b Lt (or_introl eq_refl) Ca Cb) as [H|[H|(v & G & H)]].
      * apply (nothing_waits _ _ _ _ _ _ A) in H; [contradiction|exact Lt].
      * apply H; assumption.
      * apply H. split; [exact N|]. destruct (Rle_or_lt stop v) as [|Lt']; [lra|exfalso].
        apply (due_in_one_cluster _ _ _ _ _ _ A _ G (conj eq_refl eq_refl) Lt'); [apply obeyed|].
        simpl. unfold cluster_of. rewrite Ia, Ib. reflexivity.
Qed.

Lemma merged_keeps : keeps everybody m.
Proof.
  split.
  - intros a p. unfold motion_of. simpl. destruct (cluster a) as [i|].
    + rewrite <- (come i). apply (bounds_hold _ _ (cluster_keeps i)).
    + intros Q. eapply bounds_last; [apply (bounds_hold _ _ K); exact Q|apply begins].
  - intros a C t l N. assert (Ca := clean_m a C). unfold motion_of. simpl in *. destruct (cluster a) as [i|] eqn:Ia.
    + rewrite <- (come i) in N. apply (swept_spheres_are_right _ _ (cluster_keeps i)); [|exact N].
      apply clean_own; assumption.
    + apply (swept_spheres_are_right _ _ K); [exact Ca|]. pose proof begins as Bg. lra.
  - intros a _ C. assert (Ca := clean_m a C). unfold will_renew, motion_of. simpl. destruct (cluster a) as [i|] eqn:Ia.
    + destruct (windows_will_end _ _ (cluster_keeps i) a (is_own i a Ia) (clean_own i a Ia C)) as [H|(v & G & R)].
      * left. rewrite (same_epoch _ _ _ (cluster_beside i)) in H. exact H.
      * right. exists v. split; [|exact R]. apply (left i); [exact G|]. right. apply is_own; exact Ia.
    + destruct (windows_will_end _ _ K a eq_refl Ca) as [H|(v & G & R)]; [left; exact H|right].
      exists v. split; [|exact R]. apply kept; [exact G|]. simpl.
      destruct (Rle_or_lt stop v) as [|Lt]; [assumption|exfalso].
      apply (due_in_one_cluster _ _ _ _ _ _ A _ G eq_refl Lt); [apply obeyed|exact Ia].
  - intros a b Lt _. apply merged_facts. exact Lt.
  - intros a b t e h r Lt _ _. apply merged_past. exact Lt.
  - split.
    + intros a t e. simpl. destruct (cluster a) as [i|].
      * rewrite <- (come i). apply (past_is_past _ _ (cluster_keeps i)).
      * pose proof begins as Bg. intros [H|(_ & U & _)]; [apply (past_is_past _ _ K) in H|]; lra.
    + intros a b t r. simpl. destruct (cluster_of cluster a b) as [i|].
      * rewrite <- (come i). apply (past_is_past _ _ (cluster_keeps i)).
      * pose proof begins as Bg. intros [H|(U & _)]; [apply (past_is_past _ _ K) in H|]; lra.
Qed.

(* The record has all times of the batch. *)
Lemma merged_record a b t :
  there (bodies s a) = true -> there (bodies s b) = true -> now s <= t < stop ->
  exists e h r, lived m a t e /\ lived m b t h /\ stood m a b t r.
Proof.
  intros Ta Tb U.
  assert (One : forall c, there (bodies s c) = true -> exists e, lived m c t e).
  { intros c Tc. simpl. destruct (cluster c) as [i|] eqn:Ic.
    - destruct (all_is_recorded _ _ _ (cluster_beside i) t) as [R _]; [simpl; rewrite come; exact U|].
      apply R; [apply is_own; exact Ic|exact Tc].
    - exists (revision (bodies s c)). right. auto. }
  destruct (One a Ta) as [e He]. destruct (One b Tb) as [h Hh]. exists e, h.
  assert (Two : exists r, stood m a b t r).
  { simpl. destruct (cluster_of cluster a b) as [i|] eqn:Io.
    - destruct (all_is_recorded _ _ _ (cluster_beside i) t) as [_ R]; [simpl; rewrite come; exact U|].
      apply R. unfold some_of, cluster_of in *. destruct (cluster a) as [k|] eqn:Ia; destruct (cluster b) as [j|] eqn:Ib.
      + destruct (Nat.eqb_spec k j); [|discriminate]. injection Io as <-. left. apply is_own; exact Ia.
      + destruct (static b); [|discriminate]. injection Io as <-. left. apply is_own; exact Ia.
      + destruct (static a); [|discriminate]. injection Io as <-. right. apply is_own; exact Ib.
      + discriminate.
    - exists (graph s a b). right. auto. }
  destruct Two as [r Hr]. exists r. auto.
Qed.

End Part.

Section World.
Context {W : World} {L : Lemmas W}.
Variable on : rule -> Prop.
Hypothesis obeyed : forall r, on r.

Lemma everybody_covers a b : covers everybody a b = true.
Proof. reflexivity. Qed.

Lemma world_step_keeps s s' : world_step on s s' -> keeps everybody s -> keeps everybody s'.
Proof.
  intros St K. destruct St as [s s' St|s next s' Wn|s a k c w r n Th Kn R N Oe|s a r n R N Oe|s cluster stop f g A G G'].
  - eapply step_keeps; eauto.
  - destruct K as [B C Wi F P T]. split; try assumption. intros a _. apply Wn.
  - destruct K as [B C Wi F P T]. split; simpl.
    + intros x q. unfold motion_of; simpl. at_body x a; [apply Kn|]. apply B.
    + intros x [Tx Dx] t l. unfold motion_of in *; simpl in *. at_body x a; [discriminate|]. apply C; split; assumption.
    + intros x Ox [Tx Dx]. specialize (Wi x Ox). unfold clean, will_renew, motion_of in *; simpl in *.
      at_body x a; [discriminate|]. apply Wi; split; assumption.
    + intros x y Lt So [Tx Dx] [Ty Dy]. specialize (F x y Lt So). unfold fact, right_at, motion_of, clean in *; simpl in *.
      at_body x a; [discriminate|]. at_body y a; [discriminate|].
      rewrite R, N by (intros [[H|H] _]; congruence). apply F; split; assumption.
    + exact P.
    + exact T.
  - destruct K as [B C Wi F P T]. split; simpl.
    + intros x q. unfold motion_of; simpl. at_body x a; [discriminate|apply B].
    + intros x [Tx Dx] t l. unfold motion_of in *; simpl in *. at_body x a; [discriminate|]. apply C; split; assumption.
    + intros x Ox [Tx Dx]. specialize (Wi x Ox). unfold clean, will_renew, motion_of in *; simpl in *.
      at_body x a; [discriminate|]. apply Wi; split; assumption.
    + intros x y Lt So [Tx Dx] [Ty Dy]. specialize (F x y Lt So). unfold fact, right_at, motion_of, clean in *; simpl in *.
      at_body x a; [discriminate|]. at_body y a; [discriminate|].
      rewrite R, N by (intros [[H|H] _]; congruence). apply F; split; assumption.
    + exact P.
    + exact T.
  - apply (merged_keeps on obeyed); trivial. apply G'. apply obeyed.
Qed.

Lemma empty_keeps s : empty s -> keeps everybody s.
Proof.
  intros (Th & Bo & Lv & St). split.
  - intros a p Q. destruct (Th a). congruence.
  - intros a [T _]. destruct (Th a). congruence.
  - intros a _ [T _]. destruct (Th a). congruence.
  - intros a b _ _ [T _]. destruct (Th a). congruence.
  - intros a b t e h r _ _ _ H. elim (Lv _ _ _ H).
  - split; [intros a t e H; elim (Lv _ _ _ H)|intros a b t r H; elim (St _ _ _ _ H)].
Qed.

Lemma world_step_delivers_begins s s' : world_step on s s' -> delivers_begins s -> delivers_begins s'.
Proof.
  intros St [B S].
  destruct St as [s s' St|s next s' Wn|s a k c w r n Th Kn R N Oe|s a r n R N Oe|s cluster stop f g A G G'].
  - eapply step_delivers_begins; eauto. split; assumption.
  - split; assumption.
  - split; [|exact S]. intros x y. eapply known_later; [apply B|auto|simpl; lra|apply Oe].
  - split; [|exact S]. intros x y. eapply known_later; [apply B|auto|simpl; lra|apply Oe].
  - assert (T : forall i, delivers_begins (f i)).
    { intros i. eapply steps_deliver_begins; [apply (have_run _ _ _ _ _ _ A)|]. split; assumption. }
    assert (N : now s <= stop) by apply (in_epoch _ _ _ _ _ _ A).
    assert (E : forall r, only_ends r r) by apply nothing_ends.
    split; simpl.
    + intros x y. destruct (cluster_of cluster x y) as [i|].
      * eapply known_later; [apply (proj1 (T i))|simpl; eauto|rewrite (have_come _ _ _ _ _ _ A i); lra|apply E].
      * eapply known_later; [apply B|simpl; auto|exact N|apply E].
    + intros x y t r. destruct (cluster_of cluster x y) as [i|].
      * intros H. eapply known_later; [apply (proj2 (T i)); exact H|simpl; eauto|lra|apply E].
      * intros [H|[U ->]].
        -- eapply known_later; [apply S; exact H|simpl; auto|lra|apply E].
        -- eapply known_later; [apply B|simpl; auto|lra|apply E].
Qed.

Lemma world_delivers_begins s : reachable on s -> delivers_begins s.
Proof.
  induction 1 as [s (_ & Bo & _ & St)|]; [|eapply world_step_delivers_begins; eauto]. split.
  - intros a b. exists apart. rewrite Bo. split; [apply nothing_ends|left; reflexivity].
  - intros a b t r H. elim (St _ _ _ _ H).
Qed.

(* In each reachable state each pair has its fact, and each swept sphere holds its body. docs/guarantee.md states it in
   words. *)
Theorem engine_keeps_its_facts s : reachable on s -> keeps everybody s.
Proof. induction 1; [apply empty_keeps; assumption|eapply world_step_keeps; eauto]. Qed.

(* At no past time was the contact graph wrong about a pair. *)
Theorem engine_misses_nothing s : reachable on s -> nothing_missed s.
Proof.
  intros R a b t e h r Lt. apply (past_is_right _ _ (engine_keeps_its_facts s R)); trivial.
Qed.

Lemma step_record s s' a b t :
  step on everybody s s' -> there (bodies s a) = true -> there (bodies s b) = true -> now s <= t < now s' ->
  exists e h r, lived s' a t e /\ lived s' b t h /\ stood s' a b t r.
Proof.
  intros St Ta Tb U. destruct St; simpl in *; try lra.
  exists (revision (bodies s a)), (revision (bodies s b)), (graph s a b).
  split; [|split]; right; unfold everybody; auto.
Qed.

(* No contact is missed in one step, which may be a whole batch with its clusters: each time that the step passes is on
   record for each pair of present bodies, with the revisions and the relation in force at that time. *)
Theorem no_step_passes_a_contact s s' a b t :
  reachable on s -> world_step on s s' -> (a < b)%nat -> there (bodies s a) = true -> there (bodies s b) = true ->
  now s <= t < now s' ->
  exists e h r, lived s' a t e /\ lived s' b t h /\ stood s' a b t r /\ ~ wrong r (a, e) (b, h) t.
Proof.
  intros R St Lt Ta Tb U.
  assert (Rec : exists e h r, lived s' a t e /\ lived s' b t h /\ stood s' a b t r).
  { destruct St as [s s' St|s next s' Wn|s x k c w r n Th Kn Rr N Oe|s x r n Rr N Oe|s cluster stop f g A G G']; simpl in *; try lra.
    - eapply step_record; eauto.
    - apply (merged_record on obeyed s cluster stop f g (engine_keeps_its_facts s R) A); assumption. }
  destruct Rec as (e & h & r & H1 & H2 & H3). exists e, h, r. repeat split; trivial.
  apply (engine_misses_nothing s' (then_one _ _ _ R St) a b t e h r Lt H1 H2 H3).
Qed.

(* If it would be wrong to call two bodies apart, because they touch or one senses the other, an event has reported that
   by then: each contact is reported, and none is late. *)
Theorem every_contact_is_reported s s' a b t e h :
  reachable on s -> world_step on s s' -> (a < b)%nat -> there (bodies s a) = true -> there (bodies s b) = true ->
  now s <= t < now s' -> lived s' a t e -> lived s' b t h -> wrong apart (a, e) (b, h) t ->
  exists r u q, stood s' a b t r /\ r <> apart /\ u <= t /\ delivered s' a b u q /\ only_ends q r.
Proof.
  intros R St Lt Ta Tb U Ha Hb V.
  destruct (no_step_passes_a_contact s s' a b t R St Lt Ta Tb U) as (_ & _ & r & _ & _ & H3 & _).
  assert (R' := then_one _ _ _ R St).
  assert (Ne : r <> apart).
  { intros ->. exact (engine_misses_nothing s' R' a b t e h apart Lt Ha Hb H3 V). }
  destruct (proj2 (world_delivers_begins s' R') a b t r H3) as (q & E & [->|(u & Nu & H)]).
  - elim Ne. apply nothing_ends_twice. exact E.
  - exists r, u, q. auto.
Qed.

End World.
