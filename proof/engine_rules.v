(* Each rule of the machine is needed: a machine that obeys all others lets time pass a contact. The worlds here have
   two bodies with exactly known motions, and ideal searches and certificates. *)
From Coq Require Import Reals Lra Lia Bool Arith.
From Kinesphere Require Import engine_machine.
Open Scope R_scope.

Section Toy.
(* The times at which a motion is at the only place; two motions at that place at the same time touch. *)
Variable is_there : motion -> R -> Prop.
Definition touch (x y : motion) (t : R) : Prop := is_there x t /\ is_there y t.

Instance Toy : World := {|
  place := unit; bound := motion; swept_sphere := R -> Prop; relation := bool; apart := false;
  only_ends r q := q = true -> r = true;
  static _ := false;
  fills x t _ := is_there x t;
  wrong r x y t := if r then ~ touch x y t else touch x y t;
  keeps_to x p _ := x = p;
  holds c t _ := c t;
  swept_sphere_of p _ _ := is_there p;
  left_out c d now u v := forall t, now <= t -> before t u -> before t v -> ~ (c t /\ d t);
  certifies r p q now u := forall t, now <= t -> before t u -> ~ (if r then ~ touch p q t else touch p q t)
|}.

Instance Toy_obeys_the_lemmas : Lemmas Toy.
Proof.
  split; simpl; unfold touch; intros; subst; auto.
  - destruct r; [specialize (H eq_refl)|]; congruence.
  - exists tt. assumption.
  - eapply H; eauto.
Qed.

Definition nothing (ph : until) : state :=
  mkState _ 0 ph (fun _ => mkBody _ false 0 false None (fun _ => False) None) (fun _ _ => false)
    (fun _ _ => False) (fun _ => False) (fun _ => False) (fun _ _ _ _ => False) (fun _ _ _ => False)
    (fun _ _ _ _ => False).
Definition arrived (a : body) (s : state) : state :=
  set_bodies (put s a (mkBody _ true (S (revision (bodies s a))) true (Some (a, S (revision (bodies s a)))) (fun _ => False) None))
    (set_pairs (graph s) (news s) (queue s) s).
Definition start_of (set : body -> bool) (ends : until) (g : entry -> Prop) (s : state) : state :=
  mkState _ (now s) (epoch s) (started s set (fun _ => ends)) (graph s) (news s) g (noted s set (fun _ => ends)) (delivered s)
    (lived s) (stood s).
Definition both (x : body) : bool := x <? 2.
(* The state after two bodies were added and started at time 0. *)
Definition two (ph ends : until) (g : entry -> Prop) : state := start_of both ends g (arrived 1%nat (arrived 0%nat (nothing ph))).

Lemma two_reachable (on : rule -> Prop) ph ends g :
  (on search_for_who_starts -> gets_fact on everybody (two ph ends g) 0%nat 1%nat) ->
  no_later ph ends -> reachable on (two ph ends g).
Proof.
  intros F P.
  assert (R0 : reachable on (nothing ph)) by (apply at_first; unfold empty; simpl; auto).
  assert (R1 : reachable on (arrived 0%nat (nothing ph))).
  { eapply then_one; [exact R0|]. apply come; simpl; intros; try (intros ? ? _); auto; congruence. }
  assert (R2 : reachable on (arrived 1%nat (arrived 0%nat (nothing ph)))).
  { eapply then_one; [exact R1|]. apply come; simpl; intros; try (intros ? ? _); auto; congruence. }
  eapply then_one; [exact R2|]. apply alone. apply start.
  - intros [|[|x]]; simpl; try discriminate; repeat split; congruence.
  - intros S [|a] [|[|b]] Lt _ Ca Cb; try lia.
    + apply F. exact S.
    + destruct Cb as [Cb _]. discriminate.
    + destruct Cb as [Cb _]. discriminate.
  - simpl. intros _ h [].
  - intros [|[|x]] _ [T _]; try discriminate; left; exact P.
Qed.

(* A contact was missed: two bodies touched at a time at which the contact graph called them apart. *)
Lemma missed s t e h (r : bool) :
  lived s 0%nat t e -> lived s 1%nat t h -> stood s 0%nat 1%nat t r ->
  (if r then ~ touch (0%nat, e) (1%nat, h) t else touch (0%nat, e) (1%nat, h) t) -> ~ nothing_missed s.
Proof. intros A B C T N. exact (N 0%nat 1%nat t e h r ltac:(lia) A B C T). Qed.

(* Time moves on to t, for all bodies or for some. *)
Definition passes (own : body -> bool) (t : R) (s : state) : state :=
  mkState _ t (epoch s) (bodies s) (graph s) (news s) (queue s) (updates s) (delivered s)
    (fun a u e => lived s a u e \/
                  (own a = true /\ there (bodies s a) = true /\ now s <= u < t /\ e = revision (bodies s a)))
    (fun a b u r => stood s a b u r \/ ((own a = true \/ own b = true) /\ now s <= u < t /\ r = graph s a b)).
Definition later := passes everybody.

(* A body gets another velocity, and becomes dirty if d. *)
Definition velocity_change (a : body) (d : bool) (s : state) : state :=
  set_bodies (put s a (mkBody _ true (S (revision (bodies s a))) d (Some (a, S (revision (bodies s a))))
                        (held (bodies s a)) (window (bodies s a))))
    (set_pairs (graph s) (news s) (queue s) s).
Lemma changes_are_steps (on : rule -> Prop) own a d s :
  own a = true -> there (bodies s a) = true -> (on changed_are_dirty -> d = true) -> step on own s (velocity_change a d s).
Proof.
  intros O T D. apply change; auto; simpl; try (intros ? ? _; reflexivity); try congruence.
Qed.

(* A contact is missed if time moves on from a state with a contact graph that is wrong about a time before. *)
Lemma missed_later (on : rule -> Prop) s t u :
  reachable on s -> step on everybody s (later t s) -> there (bodies s 0%nat) = true -> there (bodies s 1%nat) = true ->
  now s <= u < t -> wrong (graph s 0%nat 1%nat) (motion_of s 0%nat) (motion_of s 1%nat) u ->
  exists s', reachable on s' /\ ~ nothing_missed s'.
Proof.
  intros R St T0 T1 U V. exists (later t s). split.
  - eapply then_one; [exact R|]. apply alone. exact St.
  - eapply (missed _ u (revision (bodies s 0%nat)) (revision (bodies s 1%nat)) (graph s 0%nat 1%nat)); simpl.
    + right. unfold everybody. auto.
    + right. unfold everybody. auto.
    + right. unfold everybody. auto.
    + exact V.
Qed.

End Toy.

Definition but (r : rule) : rule -> Prop := fun q => q <> r.
Ltac off := match goal with H : but ?r ?r |- _ => exfalso; apply H; reflexivity end.
Ltac bodies_of x := destruct x as [|[|x]]; simpl in *; try discriminate; try lia.

(* The two bodies are present from time 1 on. *)
Definition from_1 (x : motion) (t : R) : Prop := 1 <= t.

(* A starting body is not searched for, so the coming contact of the two bodies is unknown. *)
Example search_is_needed : exists (W : World) (L : Lemmas W) s, reachable (but search_for_who_starts) s /\ ~ nothing_missed s.
Proof.
  exists (Toy from_1), (Toy_obeys_the_lemmas from_1).
  apply (missed_later from_1 _ (two from_1 None None (fun _ => False)) 2 1); simpl; try reflexivity; try lra.
  - apply two_reachable; [intros; off|intros t _; exact I].
  - apply advance; simpl; try lra; try tauto.
    intros a _. bodies_of a; auto.
  - unfold touch, from_1. lra.
Qed.

(* Time moves on although the pair is due before. *)
Definition due_at_1 (h : entry) : Prop := h = Pair 1 (0%nat, 1%nat) (1%nat, 1%nat).
Lemma due_at_1_reachable (on : rule -> Prop) ph : @reachable (Toy from_1) on (two from_1 ph None due_at_1).
Proof.
  apply two_reachable; [|intros t _; exact I].
  intros _. split; [intros; discriminate|]. right; left.
  exists (0%nat, 1%nat), (1%nat, 1%nat), (Some 1). simpl. repeat split.
  - intros t N B. unfold touch, from_1. lra.
  - right. exists 1. split; reflexivity.
Qed.

Example earliest_is_needed : exists (W : World) (L : Lemmas W) s, reachable (but earliest_is_due) s /\ ~ nothing_missed s.
Proof.
  exists (Toy from_1), (Toy_obeys_the_lemmas from_1).
  apply (missed_later from_1 _ (two from_1 None None due_at_1) 2 1); simpl; try reflexivity; try lra.
  - apply due_at_1_reachable.
  - apply advance; simpl; try lra; try tauto.
    + intros a _. bodies_of a; auto.
    + intros h O ->. off.
  - unfold touch, from_1. lra.
Qed.

(* A start, here of no body, drops the certificates of other bodies. *)
Example old_certificates_are_needed :
  exists (W : World) (L : Lemmas W) s, reachable (but certificates_outlive_starts) s /\ ~ nothing_missed s.
Proof.
  exists (Toy from_1), (Toy_obeys_the_lemmas from_1).
  apply (missed_later from_1 _ (start_of from_1 (fun _ => false) None (fun _ => False) (two from_1 None None due_at_1)) 2 1);
    simpl; try reflexivity; try lra.
  - eapply then_one; [apply due_at_1_reachable|]. apply alone. apply start; simpl.
    + discriminate.
    + intros _ a b _ [H|H]; discriminate.
    + intros; off.
    + intros x _ C. left. intros t _. simpl. unfold started at 1. simpl. bodies_of x; exact I.
  - apply advance; simpl; try lra; try tauto.
    intros a _. unfold started at 1 2. simpl. bodies_of a; auto.
  - unfold touch, from_1. lra.
Qed.

(* The first body is nowhere before its velocity change, then present from time 1 on. The other is always present. *)
Definition changed_to_1 (x : motion) (t : R) : Prop := fst x = 0%nat -> snd x = 2%nat /\ 1 <= t.
Lemma two_apart (on : rule -> Prop) is_there ph ends :
  (forall t, ~ touch is_there (0%nat, 1%nat) (1%nat, 1%nat) t) -> no_later ph ends ->
  @reachable (Toy is_there) on (two is_there ph ends (fun _ => False)).
Proof.
  intros T P. apply two_reachable; [|exact P]. intros _. split; [intros; discriminate|].
  left. split; [reflexivity|]. simpl. intros t _ _ _. apply T.
Qed.
Lemma not_before_the_change t : ~ touch changed_to_1 (0%nat, 1%nat) (1%nat, 1%nat) t.
Proof. intros [H _]. destruct (H eq_refl). discriminate. Qed.

(* A changed body is not dirty, so it is not searched for. *)
Example dirty_is_needed : exists (W : World) (L : Lemmas W) s, reachable (but changed_are_dirty) s /\ ~ nothing_missed s.
Proof.
  exists (Toy changed_to_1), (Toy_obeys_the_lemmas changed_to_1).
  apply (missed_later changed_to_1 _ (velocity_change changed_to_1 0%nat false (two changed_to_1 None None (fun _ => False))) 2 1);
    simpl; try reflexivity; try lra.
  - eapply then_one; [apply (two_apart _ changed_to_1 None None not_before_the_change); intros t _; exact I|].
    apply alone. apply changes_are_steps; try reflexivity. intros; off.
  - apply advance; simpl; try lra; try tauto.
    intros a _. unfold put. bodies_of a; auto.
  - unfold touch, changed_to_1. simpl. repeat split; try lra; discriminate.
Qed.

(* Time moves on past the end of the windows up to which the swept spheres are apart. *)
Example windows_are_needed : exists (W : World) (L : Lemmas W) s, reachable (but windows_are_not_passed) s /\ ~ nothing_missed s.
Proof.
  exists (Toy from_1), (Toy_obeys_the_lemmas from_1).
  apply (missed_later from_1 _ (two from_1 (Some 1) (Some 1) (fun _ => False)) 2 1); simpl; try reflexivity; try lra.
  - apply two_reachable; [|intros t B; exact B]. intros _. split; [intros; discriminate|].
    left. split; [reflexivity|]. simpl. unfold from_1. intros t _ B _. lra.
  - apply advance; simpl; try lra; try tauto.
    + intros a _. bodies_of a; auto.
    + intros; off.
  - unfold touch, from_1. lra.
Qed.

(* A pair that touches at time 0 is rechecked, and the event is delivered. *)
Definition due_at_0 (h : entry) : Prop := h = Pair 0 (0%nat, 1%nat) (1%nat, 1%nat).
Definition they_touch (a b : body) : bool := (a =? 0) && (b =? 1).
Definition the_pair (a b : body) : Prop := if they_touch a b then True else False.
Lemma not_the_pair a b : ~ (a = 0%nat /\ b = 1%nat) -> they_touch a b = false.
Proof. unfold they_touch. destruct a as [|a], b as [|[|b]]; simpl; tauto. Qed.
Section Touching.
Variable is_there : motion -> R -> Prop.
Instance TheToy : World := Toy is_there.
Definition with_news : state := set_pairs (fun _ _ => false) the_pair (fun _ => False) (two is_there None None due_at_0).
Definition with_contact : state := deliver_event 0%nat 1%nat true (set_pairs they_touch the_pair (fun _ => False) with_news).
Lemma contact_reachable (on : rule -> Prop) : reachable on with_contact.
Proof.
  assert (R : reachable on (two is_there None None due_at_0)).
  { apply two_reachable; [|intros t _; exact I]. intros _. split; [intros; discriminate|]. right; left.
    exists (0%nat, 1%nat), (1%nat, 1%nat), (Some 0). simpl. repeat split.
    - intros t N B. lra.
    - right. exists 0. split; reflexivity. }
  assert (R' : reachable on with_news).
  { eapply then_one; [exact R|]. apply alone. apply (recheck on everybody (two is_there None None due_at_0) 0%nat 1%nat 0).
    - lia.
    - reflexivity.
    - intros x y _. reflexivity.
    - intros x y Ot. simpl. unfold the_pair. rewrite (not_the_pair x y Ot). reflexivity.
    - simpl. auto.
    - intros h H. right. exact H.
    - right. exact I. }
  eapply then_one; [exact R'|]. apply alone. apply (deliver on everybody with_news 0%nat 1%nat they_touch).
  - lia.
  - reflexivity.
  - exact I.
  - intros x y Ot. apply (not_the_pair x y Ot).
Qed.
End Touching.

(* The two bodies part at time 1. After the contact has begun the pair is not rechecked. *)
Definition up_to_1 (x : motion) (t : R) : Prop := t < 1.
Example second_recheck_is_needed : exists (W : World) (L : Lemmas W) s, reachable (but news_is_rechecked) s /\ ~ nothing_missed s.
Proof.
  exists (Toy up_to_1), (Toy_obeys_the_lemmas up_to_1).
  apply (missed_later up_to_1 _ (set_pairs (W := Toy up_to_1) they_touch (fun _ _ => False) (fun _ => False) (with_contact up_to_1)) 2 1);
    simpl; try reflexivity; try lra.
  - eapply then_one; [apply contact_reachable|]. apply alone.
    apply (recertify _ everybody (with_contact up_to_1) 0%nat 1%nat (fun _ _ => False)).
    + lia.
    + reflexivity.
    + intros x y Ot. simpl. unfold the_pair. rewrite (not_the_pair x y Ot). reflexivity.
    + simpl. auto.
    + intros; off.
  - apply advance; simpl; try lra; try tauto.
    intros a _. bodies_of a; auto.
  - unfold touch, up_to_1. lra.
Qed.

(* The first body is elsewhere after its velocity change. The contact graph has a contact of the two, but the pair is
   left to the search. *)
Definition gone_by_a_change (x : motion) (t : R) : Prop := x <> (0%nat, 2%nat).
Definition only_0 (x : body) : bool := x =? 0.
Example links_are_needed : exists (W : World) (L : Lemmas W) s, reachable (but links_are_not_searched) s /\ ~ nothing_missed s.
Proof.
  exists (Toy gone_by_a_change), (Toy_obeys_the_lemmas gone_by_a_change).
  set (s1 := set_pairs (W := Toy gone_by_a_change) they_touch (fun _ _ => False) due_at_0 (with_contact gone_by_a_change)).
  set (s2 := set_pairs (W := Toy gone_by_a_change) they_touch (fun _ _ => False) (fun _ => False) (velocity_change gone_by_a_change 0%nat true s1)).
  apply (missed_later gone_by_a_change _ (start_of gone_by_a_change only_0 None (fun _ => False) s2) 1 0);
    simpl; try reflexivity; try lra.
  - eapply then_one; [eapply then_one; [eapply then_one; [eapply then_one; [apply contact_reachable|]|]|]|].
    + apply alone. apply (recertify _ everybody (with_contact gone_by_a_change) 0%nat 1%nat (fun _ _ => False)) with (g := due_at_0).
      * lia.
      * reflexivity.
      * intros x y Ot. simpl. unfold the_pair. rewrite (not_the_pair x y Ot). reflexivity.
      * simpl. tauto.
      * intros _. reflexivity.
    + apply alone. apply (changes_are_steps gone_by_a_change _ everybody 0%nat true s1); reflexivity.
    + apply alone. apply (drop _ everybody (velocity_change gone_by_a_change 0%nat true s1) (fun _ => False)).
      intros h H. right; left. rewrite H. intros [E _]. discriminate.
    + apply alone. apply start; simpl.
      * intros x. unfold only_0, put. bodies_of x. intros _. repeat split. discriminate.
      * intros _ a b Lt _ Ca Cb. destruct a as [|a], b as [|[|b]]; try lia; try (destruct Cb as [Cb _]; discriminate).
        split; [intros; discriminate|]. left. split; [intros; off|]. simpl. intros t _ _ _ [H _]. apply H. reflexivity.
      * intros _ h [].
      * intros x _ [T _]. left. bodies_of x; intros t _; exact I.
  - apply advance; simpl; try lra; try tauto.
    intros a _. unfold started, put. bodies_of a; auto.
  - unfold touch, gone_by_a_change. simpl. intros [H _]. apply H. reflexivity.
Qed.

(* Clusters of a batch. *)
Section Parts.
Variable is_there : motion -> R -> Prop.
Instance PartToy : World := Toy is_there.
Variable on : rule -> Prop.

(* A cluster that only lets time pass. *)
Lemma none_acts own t s :
  now s <= t -> (forall a, own a = true -> there (bodies s a) = true -> dirty (bodies s a) = false) ->
  (forall a b, ~ news s a b) -> reaches t (epoch s) ->
  (forall h, queue s h -> valid s h -> concerns own h -> t <= due h) ->
  steps on own (begin_batch s) (passes is_there own t (begin_batch s)).
Proof.
  intros N C Ne P D. eapply one_more; [apply no_step|]. apply advance; simpl; auto.
Qed.

(* The bodies 0 and 1 in these clusters, in worlds of two bodies without a certificate that is due in the batch. *)
Lemma accepted_batch cluster stop f g ph :
  (forall a, (1 < a)%nat -> cluster a = None) -> 0 <= stop -> reaches stop ph ->
  (forall i, steps on (own_of cluster i) (begin_batch (two is_there ph None (fun _ => False))) (f i)) ->
  (forall i, now (f i) = stop) ->
  (forall i a, own_of cluster i a = true -> there (bodies (f i) a) = true -> dirty (bodies (f i) a) = false) ->
  (forall i a b, ~ news (f i) a b) ->
  (on updates_are_compared -> forall i j k l, i <> j -> (updated k < updated l)%nat -> updates (f i) k -> updates (f j) l ->
    stay_apart 0 stop k l (last_of (f i) k /\ last_of (f j) l) g) ->
  accepted on (two is_there ph None (fun _ => False)) cluster stop f g.
Proof.
  intros I N P R C S Ne K. split; auto.
  - split; [|simpl; tauto]. intros a. simpl. bodies_of a; auto.
  - discriminate.
  - intros h [].
Qed.

(* A cluster of the first body alone gives it another velocity at once. *)
Definition run_of (a : body) (own : body -> bool) (g : entry -> Prop) (stop : R) (s : state) : state :=
  passes is_there own stop (start_of is_there (fun x => x =? a) None g (velocity_change is_there a true (begin_batch s))).
Lemma run_steps a own g stop s :
  own a = true -> there (bodies s a) = true ->
  let k := velocity_change is_there a true (begin_batch s) in
  let st := start_of is_there (fun x => x =? a) None g k in
  step on own k st -> step on own st (passes is_there own stop st) ->
  steps on own (begin_batch s) (run_of a own g stop s).
Proof.
  intros O T k st S1 S2. eapply one_more; [eapply one_more; [eapply one_more; [apply no_step|]|exact S1]|exact S2].
  apply changes_are_steps; [exact O|exact T|reflexivity].
Qed.
End Parts.

Definition alone_0 (a : body) : option nat := if a =? 0 then Some 0%nat else None.
Local Notation none_due := (fun _ : entry => False).

(* An updated body of a cluster may meet a body of no cluster, which the cluster does not take in. *)
Example conflicts_are_needed : exists (W : World) (L : Lemmas W) s, reachable (but conflicts_join) s /\ ~ nothing_missed s.
Proof.
  exists (Toy changed_to_1), (Toy_obeys_the_lemmas changed_to_1).
  set (s := two changed_to_1 None None none_due).
  set (f := fun i => match i with
    | 0%nat => run_of changed_to_1 0%nat (own_of alone_0 0) none_due 2 s
    | _ => passes changed_to_1 (own_of alone_0 i) 2 (begin_batch s)
    end).
  exists (merged s alone_0 2 f none_due). split.
  - eapply then_one; [apply (two_apart (but conflicts_join) changed_to_1 None None not_before_the_change); intros t _; exact I|].
    apply batch.
    + apply accepted_batch; try (simpl; lra); try exact I.
      * intros [|a] H; [lia|reflexivity].
      * intros [|i]; [|apply none_acts; simpl; try lra; try tauto].
        -- apply run_steps; try reflexivity.
           ++ apply start; simpl.
              ** intros x. unfold put. bodies_of x. intros _. repeat split. discriminate.
              ** intros _ a b Lt _ Ca Cb. destruct a as [|a], b as [|[|b]]; try lia; try (destruct Cb as [Cb _]; discriminate).
                 split; [intros; off|]. right; right. split; [intros H; apply H; reflexivity|reflexivity].
              ** intros _ h [].
              ** intros x _ [T _]. left. bodies_of x; intros t _; exact I.
           ++ apply advance; simpl; try lra; try tauto.
              intros a _. unfold started, put. bodies_of a; auto.
        -- intros a. unfold own_of, alone_0. bodies_of a.
      * intros [|i]; reflexivity.
      * intros [|i] a O; simpl; unfold started, put; unfold own_of, alone_0 in O; bodies_of a; auto.
      * intros [|i]; simpl; tauto.
      * intros _ [|i] [|j] k l D _; simpl; try tauto; congruence.
    + intros h [].
    + intros _ [|i] h [].
  - apply (missed changed_to_1 _ 1 2%nat 1%nat false); simpl.
    + right. repeat split; lra.
    + right. repeat split; lra.
    + right. repeat split; lra.
    + unfold touch, changed_to_1. simpl. repeat split; try lra; discriminate.
Qed.

(* The two bodies change velocity, each in a cluster of its own. Before that they are absent; then they are present from
   time 1 on. *)
Definition both_changed (x : motion) (t : R) : Prop := snd x <> 1%nat /\ 1 <= t.
Definition one_each (a : body) : option nat := match a with 0%nat => Some 0%nat | 1%nat => Some 1%nat | _ => None end.
Example comparing_updates_is_needed :
  exists (W : World) (L : Lemmas W) s, reachable (but updates_are_compared) s /\ ~ nothing_missed s.
Proof.
  exists (Toy both_changed), (Toy_obeys_the_lemmas both_changed).
  set (s := two both_changed None None none_due).
  set (f := fun i => match i with
    | 0%nat => run_of both_changed 0%nat (own_of one_each 0) none_due 2 s
    | 1%nat => run_of both_changed 1%nat (own_of one_each 1) none_due 2 s
    | _ => passes both_changed (own_of one_each i) 2 (begin_batch s)
    end).
  assert (Run : forall i : nat, (i < 2)%nat ->
            steps (but updates_are_compared) (own_of one_each i) (begin_batch s) (run_of both_changed i (own_of one_each i) none_due 2 s)).
  { intros i Lt. apply run_steps; [destruct i as [|[|i]]; try lia; reflexivity|destruct i as [|[|i]]; try lia; reflexivity| |].
    - apply start; simpl.
      + intros x E. apply Nat.eqb_eq in E. subst x. unfold put. rewrite Nat.eqb_refl. destruct i as [|[|i]]; try lia;
          repeat split; discriminate.
      + intros _ a b Lt' _ Ca Cb. destruct a as [|a], b as [|[|b]]; try lia.
        * destruct i as [|[|i]]; try lia; (split; [reflexivity|left; split; [reflexivity|]]); simpl; unfold both_changed; simpl;
            intros t _ _ _; tauto.
        * destruct Cb as [Cb _]. destruct i as [|[|i]]; try lia; discriminate.
        * destruct Cb as [Cb _]. destruct i as [|[|i]]; try lia; discriminate.
      + intros _ h [].
      + intros x _ [T _]. left. destruct i as [|[|i]]; try lia; bodies_of x; intros t _; exact I.
    - apply advance; simpl; try lra; try tauto.
      intros a _. unfold started, put. destruct i as [|[|i]]; try lia; bodies_of a; auto. }
  exists (merged s one_each 2 f none_due). split.
  - eapply then_one.
    { apply (two_apart (but updates_are_compared) both_changed None None); [|intros t _; exact I].
      intros t [[H _] _]. apply H. reflexivity. }
    apply batch.
    + apply accepted_batch; try (simpl; lra); try exact I.
      * intros [|[|a]] H; [lia|lia|reflexivity].
      * intros [|[|i]]; [apply Run; lia|apply Run; lia|apply none_acts; simpl; try lra; try tauto].
        intros a. unfold own_of, one_each. bodies_of a.
      * intros [|[|i]]; reflexivity.
      * intros [|[|i]] a O; simpl; unfold started, put; unfold own_of, one_each in O; bodies_of a; auto.
      * intros [|[|i]]; simpl; tauto.
      * intros; off.
    + intros h [].
    + intros _ [|[|i]] h [].
  - apply (missed both_changed _ 1 2%nat 2%nat false); simpl.
    + right. repeat split; lra.
    + right. repeat split; lra.
    + right. repeat split; lra.
    + unfold touch, both_changed. simpl. repeat split; try lra; discriminate.
Qed.

(* A pair is due in the batch, but its bodies are in no cluster. *)
Example joining_is_needed : exists (W : World) (L : Lemmas W) s, reachable (but due_pairs_join) s /\ ~ nothing_missed s.
Proof.
  exists (Toy from_1), (Toy_obeys_the_lemmas from_1).
  set (s := two from_1 None None due_at_1).
  set (f := fun i : nat => passes from_1 (own_of (fun _ => None) i) 2 (begin_batch s)).
  exists (merged s (fun _ => None) 2 f none_due). split.
  - eapply then_one; [apply (due_at_1_reachable (but due_pairs_join) None)|]. apply batch.
    + split; try (simpl; lra); try (intros; reflexivity).
      * split; [|simpl; tauto]. intros a. simpl. bodies_of a; auto.
      * intros h -> _ _ H. off.
      * intros i. apply none_acts; simpl; try lra; try tauto; try (intros; discriminate).
        intros h -> _ [H|H]; discriminate.
      * intros i. split; [discriminate|simpl; tauto].
      * intros _ i j k l _ _ [].
    + intros h -> H. simpl in H. lra.
    + intros _ i h -> [H|[H|H]]; simpl in H; try lra; discriminate.
  - apply (missed from_1 _ 1 1%nat 1%nat false); simpl.
    + right. repeat split; lra.
    + right. repeat split; lra.
    + right. repeat split; lra.
    + unfold touch, from_1. lra.
Qed.

(* A cluster changes the velocity of a body and adds a certificate, which is lost when the batch is over. *)
Definition one_cluster (a : body) : option nat := if a <? 2 then Some 0%nat else None.
Definition due_after_the_change (h : entry) : Prop := h = Pair 1 (0%nat, 2%nat) (1%nat, 1%nat).
Example queues_are_needed : exists (W : World) (L : Lemmas W) s, reachable (but both_queues_are_kept) s /\ ~ nothing_missed s.
Proof.
  exists (Toy changed_to_1), (Toy_obeys_the_lemmas changed_to_1).
  set (s := two changed_to_1 None None none_due).
  set (f := fun i => match i with
    | 0%nat => run_of changed_to_1 0%nat (own_of one_cluster 0) due_after_the_change (1/2) s
    | _ => passes changed_to_1 (own_of one_cluster i) (1/2) (begin_batch s)
    end).
  apply (missed_later changed_to_1 _ (merged s one_cluster (1/2) f none_due) 2 1); simpl; try reflexivity; try lra.
  - eapply then_one.
    { apply (two_apart (but both_queues_are_kept) changed_to_1 None None not_before_the_change); intros t _; exact I. }
    apply batch.
    + apply accepted_batch; try (simpl; lra); try exact I.
      * intros [|[|a]] H; [lia|lia|reflexivity].
      * intros [|i]; [|apply none_acts; simpl; try lra; try tauto].
        -- apply run_steps; try reflexivity.
           ++ apply start; simpl.
              ** intros x. unfold put. bodies_of x. intros _. repeat split. discriminate.
              ** intros _ a b Lt _ Ca Cb. destruct a as [|a], b as [|[|b]]; try lia; try (destruct Cb as [Cb _]; discriminate).
                 split; [reflexivity|]. right; left.
                 exists (0%nat, 2%nat), (1%nat, 1%nat), (Some 1). simpl. repeat split.
                 --- intros t _ B [H _]. destruct (H eq_refl). lra.
                 --- right. exists 1. split; reflexivity.
              ** intros _ h [].
              ** intros x _ [T _]. left. bodies_of x; intros t _; exact I.
           ++ apply advance; simpl; try lra; try tauto.
              ** intros a _. unfold started, put. bodies_of a; auto.
              ** intros h _ -> _ _. simpl. lra.
        -- intros a. unfold own_of, one_cluster. bodies_of a.
      * intros [|i]; reflexivity.
      * intros [|i] a O; simpl; unfold started, put; unfold own_of, one_cluster in O; bodies_of a; auto.
      * intros [|i]; simpl; tauto.
      * intros _ [|i] [|j] k l D _; simpl; try tauto; congruence.
    + intros h [].
    + intros; off.
  - apply advance; simpl; try lra; try tauto.
    intros a _. unfold one_cluster, started, put. bodies_of a; auto.
  - unfold touch, changed_to_1. simpl. repeat split; try lra; discriminate.
Qed.

(* For each rule there is a world, in which all lemmas hold, with an engine that obeys the other rules and misses a
   contact or the end of one. *)
Theorem every_rule_is_needed r : exists (W : World) (L : Lemmas W) s, reachable (but r) s /\ ~ nothing_missed s.
Proof.
  destruct r.
  - exact search_is_needed.
  - exact links_are_needed.
  - exact dirty_is_needed.
  - exact old_certificates_are_needed.
  - exact earliest_is_needed.
  - exact windows_are_needed.
  - exact second_recheck_is_needed.
  - exact conflicts_are_needed.
  - exact comparing_updates_is_needed.
  - exact joining_is_needed.
  - exact queues_are_needed.
Qed.
