(* Clusters of a speculative run: what one cluster keeps while others run, and that the merged result keeps the facts.
   *)
From Coq Require Import Reals Lra Lia Bool Arith.
From Kinesphere Require Import engine_machine engine_keeps.
Open Scope R_scope.

Section SpeculativeRunner.
Context {W : World} {L : Lemmas W}.
Variable on : rule -> Prop.
Hypothesis obeyed : forall r, on r.

(* The cluster has given the body an update, with a swept sphere that held the body at that time. *)
Definition updated_at (s : state) (a : body) (t : R) (e : nat) : Prop :=
  exists k, updates s k /\ updated k = a /\ with_revision k = e /\ since k <= t /\ before t (lasts k).

(* The motion of a body at a time of the batch as a cluster sees it: bodies of other clusters have the state of the
   batch's begin. *)
Definition seen (own : body -> bool) (s0 s : state) (a : body) (t : R) (e : nat) : Prop :=
  if own a then lived s a t e
  else e = revision (bodies s0 a) /\ clean s0 a /\ before t (window (bodies s0 a)).

Definition as_at_first (s0 s : state) (a : body) : Prop :=
  clean s0 a /\ revision (bodies s a) = revision (bodies s0 a) /\ window (bodies s a) = window (bodies s0 a).
Definition last_updated (s : state) (a : body) : Prop :=
  exists k, updates s k /\ updated k = a /\ with_revision k = revision (bodies s a) /\ lasts k = window (bodies s a).

(* Invariant of a cluster that runs concurrently with others. s0 is the state in which the batch began. *)
Record beside (own : body -> bool) (s0 s : state) : Prop := {
  comes_later : now s0 <= now s;
  same_epoch : epoch s = epoch s0;
  others_stay : forall a, own a = false -> bodies s a = bodies s0 a;
  none_is_added : forall a, there (bodies s a) = there (bodies s0 a);
  other_pairs_stay : forall a b, (a < b)%nat -> covers own a b = false ->
    graph s a b = graph s0 a b /\ (news s a b -> news s0 a b);
  has_an_update : forall a, own a = true -> clean s a -> as_at_first s0 s a \/ last_updated s a;
  updates_are_right : forall k, updates s k ->
    own (updated k) = true /\ now s0 <= since k <= now s /\ keeps_to (updated k, with_revision k) (as_known k) (since k) /\
    there (bodies s0 (updated k)) = true /\ forall b, own b = false -> static b = false -> clean s0 b ->
      ((updated k < b)%nat -> graph s0 (updated k) b = apart) /\ ((b < updated k)%nat -> graph s0 b (updated k) = apart);
  motions_are_known : forall a t e, own a = true -> now s0 <= t -> lived s a t e ->
    (clean s0 a /\ e = revision (bodies s0 a) /\ before t (window (bodies s0 a))) \/ updated_at s a t e;
  pairs_are_right : forall a b t e f r, (a < b)%nat -> some_of own a b -> now s0 <= t ->
    seen own s0 s a t e -> seen own s0 s b t f -> stood s a b t r -> ~ wrong r (a, e) (b, f) t;
  other_graphs_stood : forall a b t r, (a < b)%nat -> covers own a b = false -> some_of own a b -> now s0 <= t ->
    stood s a b t r -> r = graph s0 a b;
  all_is_recorded : forall t, now s0 <= t < now s ->
    (forall a, own a = true -> there (bodies s0 a) = true -> exists e, lived s a t e) /\
    (forall a b, some_of own a b -> exists r, stood s a b t r);
  nothing_is_forgotten :
    (forall a t e, lived s a t e -> (own a = true /\ now s0 <= t) \/ lived s0 a t e) /\
    (forall a b t r, stood s a b t r -> now s0 <= t \/ stood s0 a b t r) /\
    (forall a t e, lived s0 a t e -> lived s a t e) /\ (forall a b t r, stood s0 a b t r -> stood s a b t r)
}.

Lemma covers_some own a b : covers own a b = true -> some_of own a b.
Proof. unfold covers, some_of. destruct (own a), (own b), (static a), (static b); simpl; auto; discriminate. Qed.

Lemma begin_keeps own s : keeps everybody s -> keeps own (begin_batch s).
Proof.
  intros [B C Wi F P T]. split; try assumption.
  - intros a _. apply Wi. reflexivity.
  - intros a b Lt _. apply F; [assumption|left; reflexivity].
  - intros a b t e f r Lt _ _. apply P; trivial.
Qed.

Lemma begin_beside own s :
  keeps everybody s -> (forall a, there (bodies s a) = true -> dirty (bodies s a) = false) ->
  beside own (begin_batch s) (begin_batch s).
Proof.
  intros K Cl. split; simpl; try tauto; try lra.
  - intros a O [T D]. left. repeat split; assumption.
  - intros a t e O N Lv. apply (proj1 (past_is_past _ _ K)) in Lv. lra.
  - intros a b t e f r Lt So N Sa Sb St. apply (proj2 (past_is_past _ _ K)) in St. lra.
  - intros a b t r Lt Cv So N St. apply (proj2 (past_is_past _ _ K)) in St. lra.
  - intros; lra.
Qed.

(* Steps that neither give swept spheres nor let time pass change only own bodies and covered pairs. *)
Lemma quiet_step own s0 s s' :
  beside own s0 s ->
  now s' = now s -> epoch s' = epoch s -> updates s' = updates s -> lived s' = lived s -> stood s' = stood s ->
  (forall a, own a = false -> bodies s' a = bodies s a) ->
  (forall a, there (bodies s' a) = there (bodies s a)) ->
  (forall a b, (a < b)%nat -> covers own a b = false -> graph s' a b = graph s a b /\ (news s' a b -> news s a b)) ->
  (forall a, clean s' a -> clean s a /\ revision (bodies s' a) = revision (bodies s a) /\
                           window (bodies s' a) = window (bodies s a)) ->
  beside own s0 s'.
Proof.
  intros [A1 A2 A3 A4 A5 A6 A7 A8 A9 A10 A11 A12] En Ep Ek El Es Ob Th Pr Cl.
  split; unfold seen, updated_at, last_updated, as_at_first in *; rewrite ?En, ?Ep, ?Ek, ?El, ?Es; trivial.
  - intros a O. rewrite Ob by exact O. auto.
  - intros a. rewrite Th. apply A4.
  - intros a b Lt Cv. destruct (Pr a b Lt Cv) as [-> N]. destruct (A5 a b Lt Cv). auto.
  - intros a O C. destruct (Cl a C) as (C' & -> & ->). auto.
Qed.

Lemma step_beside own s0 s s' :
  step on own s s' -> keeps own s -> (forall a b, (a < b)%nat -> ~ news s0 a b) ->
  beside own s0 s -> beside own s0 s'.
Proof.
  intros St K No Be. destruct St as
    [s a p O Ob | s a k r n O Th Kn R N Oe d D | s a O | s set ends g P s' Se G Wn
    | s a b v r n g Lt Cv R N Oe G s' Ce | s a b r Lt Cv Ne R | s a b n Lt Cv N g G Gl
    | s a b n Lt Cv Nc N | s g G | s t Nt Cl Ns Wp D].
  - apply (quiet_step own s0 s); trivial; simpl.
    + intros x Ox. at_body x a; congruence.
    + intros x. at_body x a; reflexivity.
    + auto.
    + intros x. unfold clean; simpl. at_body x a; auto.
  - specialize (D (obeyed _)). subst d. apply (quiet_step own s0 s); trivial; simpl.
    + intros x Ox. at_body x a; congruence.
    + intros x. at_body x a; congruence.
    + intros x y _ Cv. rewrite R, N by (intros [_ H]; congruence). auto.
    + intros x. unfold clean; simpl. at_body x a; [intros [_ ?]; discriminate|auto].
  - apply (quiet_step own s0 s); trivial; simpl.
    + intros x Ox. at_body x a; congruence.
    + intros x. at_body x a; reflexivity.
    + auto.
    + intros x. unfold clean; simpl. at_body x a; [intros [_ ?]; discriminate|auto].
  - assert (Sx : forall x, set x = true -> exists p,
             known (bodies s x) = Some p /\ clean s' x /\ window (bodies s' x) = ends x).
    { intros x E. destruct (P x E) as (_ & T & Kx). unfold clean. simpl. unfold started. rewrite E.
      destruct (known (bodies s x)) as [p|]; [|congruence]. exists p. simpl. auto. }
    assert (Stp : forall x, revision (bodies s' x) = revision (bodies s x)).
    { intros x. exact (f_equal snd (motion_start s set ends g (noted s set ends) x)). }
    assert (Own : forall x, own x = false -> set x = false).
    { intros x O. destruct (set x) eqn:E; [|reflexivity]. destruct (P x E); congruence. }
    assert (Old : forall x, set x = false -> bodies s' x = bodies s x).
    { intros x E. simpl. unfold started. rewrite E. reflexivity. }
    assert (More : forall k, updates s k -> updates s' k) by (intros k H; left; exact H).
    destruct Be as [A1 A2 A3 A4 A5 A6 A7 A8 A9 A10 A11 A12]. split; trivial.
    + intros x O. rewrite Old by (apply Own; exact O). apply A3; exact O.
    + intros x. rewrite <- A4. destruct (set x) eqn:E; [|rewrite Old by exact E; reflexivity].
      destruct (Sx x E) as (p & _ & [T _] & _). rewrite T. symmetry. apply P; exact E.
    + intros x O C. destruct (set x) eqn:E.
      * right. destruct (Sx x E) as (p & Q & _ & Wx).
        exists (mkUpdate _ x (now s) p (revision (bodies s x)) (ends x)).
        split; [right; simpl; auto|]. split; [reflexivity|].
        split; [symmetry; exact (Stp x)|symmetry; exact Wx].
      * unfold clean in C. rewrite (Old x E) in C.
        destruct (A6 x O C) as [H|(k & H & H')]; unfold as_at_first, last_updated; rewrite (Old x E);
          [left; exact H|right; exists k; auto].
    + intros k [H|(E & Si & Q & Sk & La)].
      * apply A7 in H. exact H.
      * destruct (P _ E) as (O & Th & _). split; [exact O|]. rewrite Si, Sk. split; [simpl; lra|].
        split; [apply (bounds_hold _ _ K); exact Q|].
        split; [rewrite <- A4; exact Th|]. intros b Ob Fb Cb.
        destruct (Sx _ E) as (p & _ & Ck & _).
        assert (Cb' : clean s' b) by (unfold clean; rewrite (Old b), (A3 b) by auto; exact Cb).
        split; intros Lt.
        -- assert (Cv : covers own (updated k) b = false)
             by (unfold covers; rewrite Ob, Fb, !andb_false_r; reflexivity).
           rewrite <- (proj1 (A5 _ _ Lt Cv)).
           apply (Se (obeyed _) _ _ Lt (or_introl E) Ck Cb'); [apply obeyed|exact Cv].
        -- assert (Cv : covers own b (updated k) = false)
             by (unfold covers; rewrite Ob, Fb; reflexivity).
           rewrite <- (proj1 (A5 _ _ Lt Cv)).
           apply (Se (obeyed _) _ _ Lt (or_intror E) Cb' Ck); [apply obeyed|exact Cv].
    + intros x t e O N Lv. destruct (A8 x t e O N Lv) as [H|(k & H & H')]; [left; exact H|right; exists k; auto].
  - apply (quiet_step own s0 s); trivial; simpl; try (intros x C; split; [exact C|auto]; fail).
    intros x y Lt' Cv'. rewrite R, N by (intros [-> ->]; congruence). auto.
  - apply (quiet_step own s0 s); trivial; simpl; try (intros x C; split; [exact C|auto]; fail).
    intros x y Lt' Cv'. rewrite R by (intros [-> ->]; congruence). auto.
  - apply (quiet_step own s0 s); trivial; simpl; try (intros x C; split; [exact C|auto]; fail).
    intros x y Lt' Cv'. rewrite N by (intros [-> ->]; congruence). auto.
  - apply (quiet_step own s0 s); trivial; simpl; try (intros x C; split; [exact C|auto]; fail).
    intros x y Lt' Cv'. rewrite N by (intros [-> ->]; congruence). auto.
  - apply (quiet_step own s0 s); trivial; simpl; try (intros x C; split; [exact C|auto]; fail). auto.
  - assert (D' : forall h, queue s h -> valid s h -> concerns own h -> t <= due h).
    { intros h. apply D. destruct h; apply obeyed. }
    assert (Wp' := Wp (obeyed _)).
    destruct (past_is_past _ _ K) as [T1 T2].
    (* A body of the cluster at a time that passes now. *)
    assert (Now : forall x, own x = true -> there (bodies s x) = true -> clean s x /\
              forall u, now s <= u < t -> before u (window (bodies s x))).
    { intros x O Tx. assert (C : clean s x) by (split; auto). split; [exact C|].
      intros u U. eapply window_lasts; eauto. tauto. }
    destruct Be as [A1 A2 A3 A4 A5 A6 A7 A8 A9 A10 A11 A12]. split; trivial; simpl.
    + lra.
    + intros k H. destruct (A7 k H) as (O & Si & Kt & Th & Fo). repeat split; trivial; try lra.
      all: intros; apply Fo; auto.
    + intros x u e O N [H|(_ & Tx & U & ->)].
      * destruct (A8 x u e O N H) as [Q|(k & Q)]; [left; exact Q|right; exists k; exact Q].
      * destruct (Now x O Tx) as [C Wx]. destruct (A6 x O C) as [(C0 & -> & Ew)|(k & H & E1 & E2 & E3)].
        -- left. rewrite <- Ew. auto.
        -- right. exists k. rewrite E3. destruct (A7 k H) as (_ & Si & _). repeat split; auto. lra.
    + intros x y u e f r Lt So N Sx Sy [St|(_ & U & ->)].
      * (* passed before *)
        assert (u < now s) by (eapply T2; exact St).
        apply (A9 x y u e f r Lt So N); [| |exact St]; unfold seen in *; simpl in *.
        -- destruct (own x); [destruct Sx as [H'|(_ & _ & H' & _)]; [exact H'|lra]|exact Sx].
        -- destruct (own y); [destruct Sy as [H'|(_ & _ & H' & _)]; [exact H'|lra]|exact Sy].
      * assert (Known : forall z g, seen own s0 (mkState _ t (epoch s) (bodies s) (graph s) (news s) (queue s) (updates s) (delivered s)
             (fun a u e => lived s a u e \/
                (own a = true /\ there (bodies s a) = true /\ now s <= u < t /\ e = revision (bodies s a)))
             (fun a b u r => stood s a b u r \/ ((own a = true \/ own b = true) /\ now s <= u < t /\ r = graph s a b)))
             z u g -> clean s z /\ g = revision (bodies s z) /\ before u (window (bodies s z))).
        { intros z g. unfold seen; simpl. destruct (own z) eqn:O.
          - intros [H|(_ & Tz & _ & ->)]; [apply T1 in H; lra|]. destruct (Now z O Tz). auto.
          - unfold clean. rewrite (A3 z O). tauto. }
        destruct (Known x e Sx) as (Cx & -> & Wx). destruct (Known y f Sy) as (Cy & -> & Wy).
        apply (fact_now own s x y t u); trivial.
        destruct (covers own x y) eqn:Cv; [apply Ns; assumption|].
        intros Nw. apply (No x y Lt). apply (A5 x y Lt Cv). exact Nw.
    + intros x y u r Lt Cv So N [H|(_ & _ & ->)]; [eapply A10; eauto|]. apply A5; assumption.
    + intros u U. assert (Dec : u < now s \/ now s <= u) by lra. destruct Dec as [Lt|Ge].
      * destruct (A11 u) as [H1 H2]; [lra|]. split.
        -- intros x O Tx. destruct (H1 x O Tx) as [e H]. exists e. auto.
        -- intros x y So. destruct (H2 x y So) as [r H]. exists r. auto.
      * split.
        -- intros x O Tx. exists (revision (bodies s x)). right. rewrite A4. repeat split; auto; lra.
        -- intros x y So. exists (graph s x y). right. repeat split; auto; lra.
    + destruct A12 as (B1 & B2 & B3 & B4). repeat split; auto.
      * intros x u e [H|(O & _ & U & _)]; [apply B1; exact H|left; split; [exact O|lra]].
      * intros x y u r [H|(_ & U & _)]; [apply B2; exact H|left; lra].
Qed.

Lemma steps_beside own s0 s s' :
  steps on own s s' -> keeps own s -> (forall a b, (a < b)%nat -> ~ news s0 a b) ->
  beside own s0 s -> beside own s0 s'.
Proof.
  induction 1; intros K No B; [exact B|]. eapply step_beside; eauto. eapply steps_keep; eauto.
Qed.

End SpeculativeRunner.
