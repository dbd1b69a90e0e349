(* Example: in a world of two balls that meet, the machine obeys all rules and reports the contact in time. So the
   theorems do not hold merely because no world satisfies their hypotheses. *)
From Coq Require Import Reals Lra Lia ZArith Bool Arith.
From Flocq Require Import Core BinarySingleNaN Operations.
From Kinesphere Require floats inputs kernels earliest_meeting meeting_facts.
From Kinesphere Require Import engine_machine.
Open Scope R_scope.
Notation B := (B2R (prec := 53) (emax := 1024)).

(* Any world with two bodies. A certificate of time 0 says that they do not meet before u, and one of time u that their
   contact does not end before v. After the contact has been reported, time goes on by a batch of an epoch, in which the
   two bodies are a cluster. *)
Section Contact.
Context {W : World}.
Variable on : rule -> Prop.
Variables p q : engine_machine.bound.
Variable touching : relation.
Variables u v stop : R.
Hypothesis p_known : keeps_to (0%nat, 1%nat) p 0.
Hypothesis q_known : keeps_to (1%nat, 1%nat) q 0.
Hypothesis times : 0 <= u <= stop /\ stop <= v.
Hypothesis nothing_begins : certifies apart p q 0 (Some u).
Hypothesis nothing_ends : certifies touching p q u (Some v).
Hypothesis nothing_new : forall r : relation, only_ends r r.
Hypothesis none_is_static : forall a, static a = false.

Definition no_swept_sphere : swept_sphere := swept_sphere_of p 0 None.
Definition at_rest : state :=
  mkState _ 0 None (fun _ => mkBody _ false 0 false None no_swept_sphere None) (fun _ _ => apart)
    (fun _ _ => False) (fun _ => False) (fun _ => False) (fun _ _ _ _ => False) (fun _ _ _ => False) (fun _ _ _ _ => False).
Definition with_body (a : body) (k : engine_machine.bound) (s : state) : state :=
  set_bodies (put s a (mkBody _ true (S (revision (bodies s a))) true (Some k) no_swept_sphere None))
    (set_pairs (graph s) (news s) (queue s) s).
Definition both (x : body) : bool := x <? 2.
Definition due_at (t : R) (h : entry) : Prop := h = Pair t (0%nat, 1%nat) (1%nat, 1%nat).
Definition no_entry (h : entry) : Prop := False.
Definition in_the_graph (r : relation) (a b : body) : relation := if (a =? 0) && (b =? 1) then r else apart.
Definition the_two (a b : body) : Prop := if (a =? 0) && (b =? 1) then True else False.
Definition no_news (a b : body) : Prop := False.

Definition two : state :=
  let s := with_body 1%nat q (with_body 0%nat p at_rest) in
  mkState _ (now s) (epoch s) (started s both (fun _ => None)) (graph s) (news s) (due_at u)
    (noted s both (fun _ => None)) (delivered s) (lived s) (stood s).
Definition passed (own : body -> bool) (t : R) (s : state) : state :=
  mkState _ t (epoch s) (bodies s) (graph s) (news s) (queue s) (updates s) (delivered s)
    (fun a w e => lived s a w e \/ (own a = true /\ there (bodies s a) = true /\ now s <= w < t /\ e = revision (bodies s a)))
    (fun a b w r => stood s a b w r \/ ((own a = true \/ own b = true) /\ now s <= w < t /\ r = graph s a b)).
Definition gone_on := passed everybody.
Definition rechecked : state := set_pairs (graph two) the_two no_entry (gone_on u two).
Definition reported : state := deliver_event 0%nat 1%nat touching (set_pairs (in_the_graph touching) the_two no_entry rechecked).
Definition seen_again : state := set_pairs (in_the_graph touching) no_news (due_at u) reported.
Definition guarded : state := set_pairs (in_the_graph touching) no_news (due_at v) seen_again.
(* The rest is a batch of an epoch, with one cluster of these two bodies. *)
Definition cluster (a : body) : option nat := if a <? 2 then Some 0%nat else None.
Definition run (i : nat) : state := passed (own_of cluster i) stop (begin_batch guarded).
Definition after_the_contact : state := merged guarded cluster stop run (due_at v).

Lemma not_the_two {A} (yes no : A) a b : ~ (a = 0%nat /\ b = 1%nat) -> (if (a =? 0) && (b =? 1) then yes else no) = no.
Proof. destruct a as [|a], b as [|[|b]]; simpl; tauto. Qed.
Lemma none_is_dirty a : there (bodies two a) = true -> dirty (bodies two a) = false.
Proof. unfold two. simpl. destruct a as [|[|a]]; simpl; auto. Qed.

Lemma contact_is_reported : reachable on after_the_contact /\
  (forall t, 0 <= t < stop -> lived after_the_contact 0%nat t 1%nat /\ lived after_the_contact 1%nat t 1%nat) /\
  delivered after_the_contact 0%nat 1%nat u touching /\
  (forall t, 0 <= t < u -> stood after_the_contact 0%nat 1%nat t apart) /\
  (forall t, u <= t < stop -> stood after_the_contact 0%nat 1%nat t touching).
Proof.
  split; [|split; [|split; [|split]]].
  2: { intros t Ht. simpl. destruct (Rlt_or_le t u); split; [left|left|right|right]; try right; repeat split; auto; lra. }
  2: { simpl. left. right. auto. }
  2: { intros t Ht. simpl. left. right. unfold everybody. repeat split; auto; lra. }
  2: { intros t Ht. simpl. right. unfold everybody. repeat split; auto; lra. }
  eapply then_one; [eapply then_one; [eapply then_one; [eapply then_one; [eapply then_one; [eapply then_one; [eapply then_one;
    [eapply then_one; [eapply then_one; [apply (at_first on at_rest)|]|]|]|]|]|]|]|]|].
  - unfold empty. simpl. auto.
  - apply (come on at_rest 0%nat (Some p) no_swept_sphere None (fun _ _ => apart) (fun _ _ => False)); simpl; auto; try (intros ? ? _; reflexivity).
    intros k E. injection E as <-. exact p_known.
  - apply (come on (with_body 0%nat p at_rest) 1%nat (Some q) no_swept_sphere None (fun _ _ => apart) (fun _ _ => False)); simpl; auto; try (intros ? ? _; reflexivity).
    intros k E. injection E as <-. exact q_known.
  - apply alone. apply (start on everybody (with_body 1%nat q (with_body 0%nat p at_rest)) both (fun _ => None) (due_at u)).
    + intros [|[|x]]; simpl; try discriminate; repeat split; congruence.
    + intros _ a b Lt _ Ca Cb. destruct a as [|a], b as [|[|b]]; try lia; try (destruct Cb as [Cb _]; discriminate).
      split; [intros; reflexivity|]. right; left. exists p, q, (Some u). simpl. repeat split; auto.
      right. exists u. split; reflexivity.
    + simpl. intros _ h [].
    + intros x _ _. left. unfold no_later. simpl. destruct x as [|[|x]]; simpl; auto.
  - apply alone. apply (advance on everybody two u); simpl; try tauto; try lra.
    + intros a _. apply none_is_dirty.
    + intros h _ E _ _. change (due_at u h) in E. unfold due_at in E. subst h. simpl. lra.
  - apply alone. apply (recheck on everybody (gone_on u two) 0%nat 1%nat u (fun _ _ => apart) the_two no_entry); simpl; auto.
    + intros x y _. reflexivity.
    + intros x y Ot. apply (not_the_two True False x y Ot).
    + right. exact I.
  - apply alone. apply (deliver on everybody rechecked 0%nat 1%nat (in_the_graph touching)); simpl; auto.
    + exact I.
    + intros x y Ot. apply (not_the_two touching apart x y Ot).
  - apply alone. apply (recertify on everybody reported 0%nat 1%nat no_news) with (g := due_at u); simpl; auto.
    + intros x y Ot. symmetry. apply (not_the_two True False x y Ot).
    + intros h [].
    + intros _. reflexivity.
  - apply alone. apply (recheck on everybody seen_again 0%nat 1%nat u (in_the_graph touching) no_news (due_at v)); simpl; auto.
    + intros x y _. reflexivity.
    + intros x y _. reflexivity.
    + left. exists p, q, (Some v). simpl. repeat split; auto. right. exists v. split; reflexivity.
  - apply batch.
    + split; simpl; try tauto.
      * split; [intros a; apply none_is_dirty|intros; tauto].
      * intros a F. rewrite none_is_static in F. discriminate.
      * intros h E _ Lt. change (due_at v h) in E. unfold due_at in E. subst h. simpl in Lt. lra.
      * intros i. eapply one_more; [apply no_step|]. apply (advance on (own_of cluster i) (begin_batch guarded) stop); simpl; try tauto; try lra.
        -- intros a _. apply none_is_dirty.
        -- intros h _ E _ _. change (due_at v h) in E. unfold due_at in E. subst h. simpl. lra.
      * intros i. split; [intros a _; apply none_is_dirty|intros; tauto].
    + intros h H _. exact H.
    + intros _ i h H _. exact H.
Qed.
End Contact.

(* Two unit balls that go towards each other with a speed of 1, may accelerate by 1/8, but do not: at the time 2 they
   touch. That they may meet is expected before, by earliest_meeting, in double precision. *)
From Kinesphere Require Import geometry_vectors geometry_motion geometry_bounds geometry_certificates geometry_knowledge.
From Kinesphere Require Import contact_of_bodies engine_of_bodies.

Definition unit_ball : body := {| r := 1; A := / 8; g := zero; e0 := 0; e1 := 0 |}.
Definition straight (x v : R) : motion :=
  Motion (fun t => Vector x 0 0 + (t - 0) * Vector v 0 0 + ((t - 0) * (t - 0) / 2) * zero)%vector
         (fun t => Vector v 0 0 + (t - 0) * zero)%vector.
Definition at_first_seen (x v : R) : report := Report 0 (Vector x 0 0) (Vector v 0 0).
Definition ways (x : engine_machine.motion) : motion := if fst x =? 0 then straight (-3) 1 else straight 3 (-1).
Definition Balls : World := Bodies (fun _ => unit_ball) ways 0 1.

Lemma goes_straight x v t : keeps_since unit_ball (straight x v) (at_first_seen x v) t.
Proof.
  split; [split; [|split]|split]; cbn [place velocity straight at_time at_place with_velocity at_first_seen g A e0 e1 unit_ball].
  - apply continuous_where_derivable with (x' := fun t => (Vector v 0 0 + (t - 0) * zero)%vector). intros. apply has_derivative_plan.
  - intros. apply has_derivative_plan.
  - intros s t' Hs Ht'.
    replace (Vector v 0 0 + (t' - 0) * zero - (Vector v 0 0 + (s - 0) * zero + (t' - s) * zero))%vector with zero by by_coordinates.
    rewrite norm_zero. lra.
  - replace (Vector x 0 0 - (Vector x 0 0 + (0 - 0) * Vector v 0 0 + (0 - 0) * (0 - 0) / 2 * zero))%vector with zero
      by (coordinates; apply (f_equal3 Vector); field). rewrite norm_zero. lra.
  - replace (Vector v 0 0 - (Vector v 0 0 + (0 - 0) * zero))%vector with zero by by_coordinates. rewrite norm_zero. lra.
Qed.

Local Transparent floats.literal.
Definition o : floats.double := floats.literal 0 0.
Definition answer : floats.double := kernels.earliest_meeting (earliest_meeting.one_of_two (-3) 1) (earliest_meeting.one_of_two 3 (-1)) o floats.infinity o.
Lemma value_of (m e : Z) : (Z.abs m < 8)%Z -> (-10 <= e <= 10)%Z ->
  B (floats.literal m e) = IZR m * bpow radix2 e.
Proof.
  intros Hm He. unfold floats.literal.
  generalize (binary_normalize_correct 53 1024 _ _ mode_NE m e false). cbv zeta.
  change (IZR m * bpow radix2 e) with (F2R (Float radix2 m e)).
  replace (round radix2 _ _ (F2R (Float radix2 m e))) with (F2R (Float radix2 m e)).
  2: { symmetry. apply round_generic; [apply valid_rnd_round_mode|]. apply (generic_format_FLT radix2 (3 - 1024 - 53) 53).
       exists (Float radix2 m e); simpl; [reflexivity|lia|lia]. }
  rewrite Rlt_bool_true.
  - intros (E & _). exact E.
  - apply Rlt_le_trans with (bpow radix2 (3 + e)); [|apply bpow_le; lia]. rewrite <- F2R_abs. unfold F2R. simpl Fnum. simpl Fexp.
    rewrite bpow_plus. apply Rmult_lt_compat_r; [apply bpow_gt_0|]. apply (IZR_lt _ 8). exact Hm.
Qed.
Lemma whole_numbers : B o = 0 /\ B (floats.literal 1 0) = 1 /\ B (floats.literal 3 0) = 3 /\ B (floats.literal (-1) 0) = -1 /\
  B (floats.literal (-3) 0) = -3 /\ B (floats.literal 1 (-3)) = / 8 /\ B (floats.literal 7 (-2)) = 7 / 4 /\ B (floats.literal 2 0) = 2.
Proof. unfold o. rewrite !value_of by (simpl; lia). simpl bpow. repeat split; lra. Qed.
Lemma answer_between : finite answer /\ 7 / 4 < B answer < 2.
Proof.
  assert (finite answer) as F by (vm_compute; reflexivity). split; [exact F|].
  destruct whole_numbers as (_ & _ & _ & _ & _ & _ & E7 & E2). rewrite <- E7, <- E2.
  split.
  - apply floats.less_true; [vm_compute; reflexivity|exact F|vm_compute; reflexivity].
  - apply floats.less_true; [exact F|vm_compute; reflexivity|vm_compute; reflexivity].
Qed.
Lemma seen_as (x v : Z) (x' v' : R) : B (floats.literal x 0) = x' -> B (floats.literal v 0) = v' ->
  describes (earliest_meeting.one_of_two x v) unit_ball (at_first_seen x' v').
Proof.
  intros Ex Ev. destruct whole_numbers as (E0 & E1 & _ & _ & _ & E8 & _). unfold o in E0.
  unfold describes, earliest_meeting.one_of_two. cbn -[B2R floats.literal]. rewrite Ex, Ev, E0, E1, E8. unfold zero. repeat split; lra.
Qed.

(* All rules are obeyed and all lemmas hold. The two balls touch at time 2. An event reports the contact by then, at
   most a quarter of a unit of time early. *)
Theorem machine_can_report_a_contact : exists (W : World) (L : Lemmas W) (s : state) (u : R) (touching : relation),
  reachable (fun _ => True) s /\ 2 - / 4 <= u <= 2 /\ delivered s 0%nat 1%nat u touching /\
  lived s 0%nat 2 1%nat /\ lived s 1%nat 2 1%nat /\ wrong apart (0%nat, 1%nat) (1%nat, 1%nat) 2 /\
  stood s 0%nat 1%nat 2 touching /\ touching <> apart /\ ~ wrong apart (0%nat, 1%nat) (1%nat, 1%nat) 1 /\
  stood s 0%nat 1%nat 1 apart.
Proof.
  assert (Lemmas Balls) as L by (apply the_lemmas_hold_of_bodies; intros; simpl; lra).
  destruct answer_between as [F An]. destruct whole_numbers as (E0 & E1 & E3 & N1 & N3 & _).
  set (p := (unit_ball, at_first_seen (-3) 1)). set (q := (unit_ball, at_first_seen 3 (-1))).
  destruct (@contact_is_reported Balls (fun _ => True) p q true (B answer) 3 3) as (R & Li & To & S1 & S2).
  - split; [reflexivity|]. split; [simpl; lra|]. apply goes_straight.
  - split; [reflexivity|]. split; [simpl; lra|]. apply goes_straight.
  - lra.
  - exists (earliest_meeting.one_of_two (-3) 1), (earliest_meeting.one_of_two 3 (-1)), o, floats.infinity, o. cbn [fst snd p q at_time at_first_seen].
    destruct earliest_meeting.a_meeting_is_found as (Sa & Sb & _). rewrite E0.
    split; [apply seen_as; assumption|]. split; [apply seen_as; assumption|]. split; [exact Sa|]. split; [exact Sb|].
    split; [reflexivity|]. split; [right; reflexivity|]. split; [reflexivity|]. do 3 (split; [simpl; lra|]).
    intros t _ Lt. right. split; [exact F|exact Lt].
  - intros t Ht Lt _ _. cbn [before] in Lt. unfold p, q, growth_after, bound_from, bound_of, c.
    cbn [fst snd at_time at_place with_velocity at_first_seen unit_ball r A g e0 e1 start speed plan size growth_speed growth].
    replace (Vector (-3) 0 0 + (t - 0) * Vector 1 0 0 + (t - 0) * (t - 0) / 2 * zero -
      (Vector 3 0 0 + (t - 0) * Vector (-1) 0 0 + (t - 0) * (t - 0) / 2 * zero))%vector with (Vector (2 * t - 6) 0 0)
      by (coordinates; apply (f_equal3 Vector); field).
    assert (norm (Vector (2 * t - 6) 0 0) <= 6 - 2 * t) by (apply norm_at_most; [lra|unfold dot; cbn [x_of y_of z_of]; nra]).
    nra.
  - simpl. auto.
  - reflexivity.
  - clear F. revert An R Li To S1 S2. generalize (B answer). intros u An R Li To S1 S2.
    exists Balls, L, (@after_the_contact Balls p q true u 3 3), u, true.
    assert (forall t, 0 <= t <= 3 -> gap_of (fun _ => unit_ball) ways (0%nat, 1%nat) (1%nat, 1%nat) t = 6 - 2 * t - 2) as G.
    { intros t Ht. unfold gap_of, gap, ways, straight. cbn [fst place r unit_ball Nat.eqb].
      replace (Vector (-3) 0 0 + (t - 0) * Vector 1 0 0 + (t - 0) * (t - 0) / 2 * zero -
        (Vector 3 0 0 + (t - 0) * Vector (-1) 0 0 + (t - 0) * (t - 0) / 2 * zero))%vector with (Vector (2 * t - 6) 0 0)
        by (coordinates; apply (f_equal3 Vector); field).
      assert (norm (Vector (2 * t - 6) 0 0) = 6 - 2 * t); [|lra].
      unfold norm, dot. cbn [x_of y_of z_of]. replace ((2 * t - 6) * (2 * t - 6) + 0 * 0 + 0 * 0) with ((6 - 2 * t) * (6 - 2 * t)) by ring.
      apply sqrt_square. lra. }
    split; [exact R|]. split; [lra|]. split; [exact To|].
    destruct (Li 2 ltac:(lra)) as [L0 L1]. split; [exact L0|]. split; [exact L1|].
    split; [cbn; rewrite G; lra|]. split; [exact (S2 2 ltac:(lra))|]. split; [discriminate|].
    split; [cbn; rewrite G; lra|]. exact (S1 1 ltac:(lra)).
Qed.
