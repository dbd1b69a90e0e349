(* Example: in a world of two balls that meet, the core's machine reports the contact in time. So the theorems do not hold
   merely because no world satisfies their hypotheses. *)
From Coq Require Import Reals Lra Lia ZArith Bool Arith.
From Flocq Require Import Core BinarySingleNaN Operations.
From Kinesphere Require floats inputs kernels earliest_meeting meeting_facts.
From Kinesphere Require Import core_machine.
Open Scope R_scope.
Notation B := (B2R (prec := 53) (emax := 1024)).

(* Any world with two bodies, each of which stays in its region until `stop` and meets no wall before. A certificate of
   time 0 says that they do not meet before u, and one of time u that their contact does not end before `stop`. *)
Section Contact.
Context {W : World}.
Variables p q : core_machine.bound.
Variables held_p held_q : region.
Variable touching : relation.
Variables u stop : R.
Hypothesis p_known : keeps_to (0%nat, 1%nat) p 0.
Hypothesis q_known : keeps_to (1%nat, 1%nat) q 0.
Hypothesis times : 0 <= u <= stop.
Hypothesis p_stays : stays held_p p 0 (Some stop) /\ clears_walls apart p 0 (Some stop).
Hypothesis q_stays : stays held_q q 0 (Some stop) /\ clears_walls apart q 0 (Some stop).
Hypothesis nothing_begins : certifies apart p q 0 (Some u).
Hypothesis nothing_ends : certifies touching p q u (Some stop).
Hypothesis nothing_new : forall r : relation, only_ends r r.

Definition both (x : body) : bool := x <? 2.
Definition the_two (a b : body) : Prop := if (a =? 0) && (b =? 1) then True else False.
Definition no_pair (a b : body) : Prop := False.
Definition until_then (t : R) (a b : body) : until := if (a =? 0) && (b =? 1) then Some t else None.
Definition in_the_graph (r : relation) (a b : body) : relation := if (a =? 0) && (b =? 1) then r else apart.

Definition nobody : state :=
  mkState _ 0 (fun _ => mkBall _ false 0 false None held_p None None None None) no_pair (fun _ _ => apart) no_pair
    (fun _ _ => None) (fun _ _ _ _ => False) (fun _ _ _ => False) (fun _ _ _ _ => False).
Definition with_body (a : body) (k : core_machine.bound) (s : state) : state :=
  set_balls (put s a (changed (balls s a) true true (Some k))) (set_pairs (graph s) (news s) (sure s) s).
Definition added : state := with_body 1%nat q (with_body 0%nat p nobody).
(* The first ball is due when it may meet the second one, which it answers for. *)
Definition settled_balls (x : body) : Ball :=
  match x with
  | 0%nat => mkBall _ true 1 false (Some p) held_p (Some stop) (Some u) (Some stop) (Some 1%nat)
  | 1%nat => mkBall _ true 1 false (Some q) held_q (Some stop) (Some stop) (Some stop) None
  | _ => balls added x
  end.
Definition two : state :=
  mkState _ (now added) settled_balls the_two (graph added) no_pair (until_then u) (delivered added) (lived added) (stood added).
Definition passed (t : R) (s : state) : state :=
  mkState _ t (balls s) (listed s) (graph s) (news s) (sure s) (delivered s)
    (fun a w e => lived s a w e \/ (there (balls s a) = true /\ now s <= w < t /\ e = revision (balls s a)))
    (fun a b w r => stood s a b w r \/ (now s <= w < t /\ r = graph s a b)).
Definition rechecked (ka kb : Ball) (r : body -> body -> relation) (n : body -> body -> Prop) (t : R) (s : state) : state :=
  set_balls (fun x => if (x =? 0)%nat then ka else if (x =? 1)%nat then kb else balls s x) (set_pairs r n (until_then t) s).
Definition seen : state := rechecked (settled_balls 0%nat) (settled_balls 1%nat) (graph added) the_two u (passed u two).
Definition reported : state := deliver_event 0%nat 1%nat touching (set_pairs (in_the_graph touching) the_two (sure seen) seen).
(* Nothing more to answer for. *)
Definition postponed_ball : Ball := mkBall _ true 1 false (Some p) held_p (Some stop) (Some stop) (Some stop) None.
Definition guarded : state := rechecked postponed_ball (settled_balls 1%nat) (in_the_graph touching) no_pair stop reported.
Definition after_the_contact : state := passed stop guarded.

Lemma not_the_two {A} (yes no : A) a b : ~ (a = 0%nat /\ b = 1%nat) -> (if (a =? 0) && (b =? 1) then yes else no) = no.
Proof. destruct a as [|a], b as [|[|b]]; simpl; tauto. Qed.
Lemma no_later_than (t v : R) : t <= v -> no_later (Some t) (Some v).
Proof. intros L w. simpl. lra. Qed.

Lemma contact_is_reported : reachable after_the_contact /\
  (forall t, 0 <= t < stop -> lived after_the_contact 0%nat t 1%nat /\ lived after_the_contact 1%nat t 1%nat) /\
  delivered after_the_contact 0%nat 1%nat u touching /\
  (forall t, 0 <= t < u -> stood after_the_contact 0%nat 1%nat t apart) /\
  (forall t, u <= t < stop -> stood after_the_contact 0%nat 1%nat t touching).
Proof.
  split; [|split; [|split; [|split]]].
  2: { intros t Ht. simpl. destruct (Rlt_or_le t u); split; [left|left|right|right]; try right; repeat split; auto; lra. }
  2: { simpl. right. auto. }
  2: { intros t Ht. simpl. left. right. repeat split; auto; lra. }
  2: { intros t Ht. simpl. right. repeat split; auto; lra. }
  eapply then_one; [eapply then_one; [eapply then_one; [eapply then_one; [eapply then_one; [eapply then_one; [eapply then_one;
    [eapply then_one; [apply (at_first nobody)|]|]|]|]|]|]|]|].
  - unfold empty. simpl. repeat split; auto.
  - apply (change nobody 0%nat (Some p) (fun _ _ => apart) no_pair); try (intros ? ? _; reflexivity); simpl; auto.
    intros k E. injection E as <-. exact p_known.
  - apply (change (with_body 0%nat p nobody) 1%nat (Some q) (fun _ _ => apart) no_pair); try (intros ? ? _; reflexivity); simpl; auto.
    intros k E. injection E as <-. exact q_known.
  - apply (settle added both settled_balls the_two no_pair (until_then u)).
    + intros [|[|x]]; simpl; try discriminate; reflexivity.
    + intros [|[|x]]; simpl; try discriminate; repeat split; reflexivity.
    + intros x y Hx Hy. destruct x as [|[|x]], y as [|[|y]]; try discriminate Hx; try discriminate Hy. repeat split; reflexivity.
    + intros [|[|x]] Sx _; try discriminate Sx; simpl.
      * split; [apply no_later_than; lra|]. split; [apply no_later_than; lra|]. exists p, (Some stop).
        split; [reflexivity|]. split; [apply p_stays|]. split; [apply no_later_than; lra|].
        right. exists (Some stop). split; [apply p_stays|apply no_later_than; lra].
      * split; [apply no_later_than; lra|]. split; [apply no_later_than; lra|]. exists q, (Some stop).
        split; [reflexivity|]. split; [apply q_stays|]. split; [apply no_later_than; lra|].
        right. exists (Some stop). split; [apply q_stays|apply no_later_than; lra].
    + intros a b Lt _ Ca Cb. left. destruct a as [|a], b as [|[|b]]; try lia; try (destruct Cb as [Cb _]; discriminate Cb).
      exact I.
    + intros a b Lt _ Ca Cb _. right. left. destruct a as [|a], b as [|[|b]]; try lia; try (destruct Cb as [Cb _]; discriminate Cb).
      split; [exists p, q; split; [reflexivity|]; split; [reflexivity|exact nothing_begins]|].
      left. apply no_later_than. simpl. lra.
  - apply (advance two u); simpl; try lra.
    + intros [|[|a]]; simpl; auto.
    + intros a b _ _ _ [].
    + intros [|[|a]] C; simpl; try exact I; lra.
  - apply (recheck (passed u two) 0%nat 1%nat (settled_balls 0%nat) (settled_balls 1%nat) (graph added) the_two (until_then u)); simpl; auto.
    + left. reflexivity.
    + left. reflexivity.
    + intros x y _. reflexivity.
    + intros x y Ot. apply (not_the_two True False x y Ot).
    + intros x y _. reflexivity.
    + left. exact I.
  - apply (deliver seen 0%nat 1%nat (in_the_graph touching)); simpl; auto.
    + exact I.
    + intros x y Ot. apply (not_the_two touching apart x y Ot).
  - apply (recheck reported 0%nat 1%nat postponed_ball (settled_balls 1%nat) (in_the_graph touching) no_pair (until_then stop)); simpl; auto.
    + right. split; [reflexivity|]. exists (Some stop), None. split; [reflexivity|]. right. split; reflexivity.
    + left. reflexivity.
    + intros x y _. reflexivity.
    + intros x y Ot. symmetry. apply (not_the_two True False x y Ot).
    + intros x y Ot. unfold until_then. rewrite !(not_the_two _ _ x y Ot). reflexivity.
    + right. split; [exists p, q; split; [reflexivity|]; split; [reflexivity|exact nothing_ends]|].
      left. apply no_later_than. simpl. lra.
  - apply (advance guarded stop); simpl; try lra.
    + intros [|[|a]]; simpl; auto.
    + intros a b _ _ _ [].
    + intros [|[|a]] C; simpl; try exact I; lra.
Qed.
End Contact.

(* Two unit balls that go towards each other with a speed of 1, may accelerate by 1/8, but do not: at the time 2 they
   touch. That they may meet is expected before, by earliest_meeting, in double precision. *)
From Kinesphere Require Import geometry_vectors geometry_motion geometry_bounds geometry_certificates geometry_knowledge.
From Kinesphere Require Import contact_of_bodies core_of_balls.

Definition unit_ball : body := {| r := 1; A := / 8; g := zero; e0 := 0; e1 := 0 |}.
Definition straight (x v : R) : motion :=
  Motion (fun t => Vector x 0 0 + (t - 0) * Vector v 0 0 + ((t - 0) * (t - 0) / 2) * zero)%vector
         (fun t => Vector v 0 0 + (t - 0) * zero)%vector.
Definition at_first_seen (x v : R) : report := Report 0 (Vector x 0 0) (Vector v 0 0).
Definition ways (x : core_machine.motion) : motion := if fst x =? 0 then straight (-3) 1 else straight 3 (-1).
Definition Meeting : World := Balls (fun _ => unit_ball) ways (fun _ _ => False) 1 nil.
(* They stay in such a region around where they were seen first. *)
Definition wide_region (x : R) : safe_region := {| middle := Vector x 0 0; radius := 8; reach := 9 |}.

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

Lemma stays_wide (x v : R) : Rabs v <= 1 ->
  stays_until (wide_region x) (unit_ball, at_first_seen x v) 0 (Some 3).
Proof.
  intros L. unfold stays_until, wide_region, bound_at, moved_on, bound_from, bound_of, at_first_seen, unit_ball.
  cbn [middle radius reach fst snd at_time at_place with_velocity r A g e0 e1 start speed plan size growth_speed growth].
  unfold c, rho. cbn [start speed plan size growth_speed growth].
  assert (norm_one zero = 0) as -> by (unfold norm_one, zero; cbn [x_of y_of z_of]; rewrite Rabs_R0; lra).
  split; [lra|]. split.
  - match goal with |- norm ?w < _ => replace w with zero by (coordinates; apply (f_equal3 Vector); field) end.
    rewrite norm_zero. lra.
  - match goal with |- norm ?w < _ => replace w with ((3 * v) * Vector 1 0 0)%vector by (coordinates; apply (f_equal3 Vector); field) end.
    rewrite norm_times, Rabs_mult, (Rabs_pos_eq 3) by lra.
    assert (norm (Vector 1 0 0) <= 1) by (apply norm_at_most; [lra|unfold dot; cbn [x_of y_of z_of]; lra]).
    generalize (norm_positive (Vector 1 0 0)) (Rabs_pos v). nra.
Qed.

(* All lemmas hold. The two balls touch at time 2. An event reports the contact by then, at most a quarter of a unit of time
   early. *)
Theorem core_can_report_a_contact : exists (W : World) (L : Lemmas W) (s : state) (u : R) (touching : relation),
  reachable s /\ 2 - / 4 <= u <= 2 /\ delivered s 0%nat 1%nat u touching /\
  lived s 0%nat 2 1%nat /\ lived s 1%nat 2 1%nat /\ wrong apart (0%nat, 1%nat) (1%nat, 1%nat) 2 /\
  stood s 0%nat 1%nat 2 touching /\ touching <> apart /\ ~ wrong apart (0%nat, 1%nat) (1%nat, 1%nat) 1 /\
  stood s 0%nat 1%nat 1 apart.
Proof.
  assert (Lemmas Meeting) as L.
  { apply the_lemmas_of_the_core_hold_of_balls; try (intros; simpl; lra). intros n offset []. }
  destruct answer_between as [F An]. destruct whole_numbers as (E0 & E1 & E3 & N1 & N3 & _).
  set (p := (unit_ball, at_first_seen (-3) 1)). set (q := (unit_ball, at_first_seen 3 (-1))).
  assert (forall k : geometry_bounds.body * report, clear_until 1 nil false k 0 (Some 3)) as Cl by (intros k t _ _ _ b s n offset []).
  destruct (@contact_is_reported Meeting p q (wide_region (-3)) (wide_region 3) true (B answer) 3) as (R & Li & To & S1 & S2).
  - split; [reflexivity|]. split; [simpl; lra|]. apply goes_straight.
  - split; [reflexivity|]. split; [simpl; lra|]. apply goes_straight.
  - lra.
  - split; [apply stays_wide; unfold Rabs; destruct Rcase_abs; lra|apply Cl].
  - split; [apply stays_wide; unfold Rabs; destruct Rcase_abs; lra|apply Cl].
  - left. exists (earliest_meeting.one_of_two (-3) 1), (earliest_meeting.one_of_two 3 (-1)), o, floats.infinity, o. cbn [fst snd p q].
    destruct earliest_meeting.a_meeting_is_found as (Sa & Sb & _). rewrite E0.
    split; [apply seen_as; assumption|]. split; [apply seen_as; assumption|]. split; [exact Sa|]. split; [exact Sb|].
    split; [reflexivity|]. split; [right; reflexivity|]. split; [reflexivity|]. split; [lra|].
    intros t _ Lt. right. split; [exact F|exact Lt].
  - intros t Ht Lt _ _. cbn [before] in Lt. unfold p, q, growth_after, bound_from, bound_of, c.
    cbn [fst snd at_time at_place with_velocity at_first_seen unit_ball r A g e0 e1 start speed plan size growth_speed growth].
    replace (Vector (-3) 0 0 + (t - 0) * Vector 1 0 0 + (t - 0) * (t - 0) / 2 * zero -
      (Vector 3 0 0 + (t - 0) * Vector (-1) 0 0 + (t - 0) * (t - 0) / 2 * zero))%vector with (Vector (2 * t - 6) 0 0)
      by (coordinates; apply (f_equal3 Vector); field).
    assert (norm (Vector (2 * t - 6) 0 0) <= 6 - 2 * t) by (apply norm_at_most; [lra|unfold dot; cbn [x_of y_of z_of]; nra]).
    nra.
  - simpl. auto.
  - clear F. revert An R Li To S1 S2. generalize (B answer). intros u An R Li To S1 S2.
    exists Meeting, L, (@after_the_contact Meeting p q (wide_region (-3)) (wide_region 3) true u 3), u, true.
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
    split; [cbn; rewrite G; [tauto||lra|lra]|]. split; [exact (S2 2 ltac:(lra))|]. split; [discriminate|].
    split; [cbn; rewrite G; [lra|lra]|]. exact (S1 1 ltac:(lra)).
Qed.
