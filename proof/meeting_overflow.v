(* The gap of a step is not +infinity where its other coefficients are finite and not below zero. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic first_crossing errors.
From Kinesphere Require Import meeting_parts meeting_errors direction magnitudes meeting_facts.
From Kinesphere Require Import meeting_margins meeting_coefficients upward.
Open Scope R_scope.
Local Opaque add sub mul div root neg magnitude widened capped B2R.

Section Infinite.

Variables a b : bound.
Variables from distance d : double.
Hypothesis sound_a : sound a from.
Hypothesis sound_b : sound b from.
Hypothesis d_finite : finite d.
Hypothesis d_pos : 0 <= B d.

Notation s := (elapsed_a a from).
Notation r := (elapsed_b b from).

Let us : upward s.
Proof. apply upward_elapsed, sound_a. Qed.
Let ur : upward r.
Proof. apply upward_elapsed, sound_b. Qed.
Let ud : upward d.
Proof. right; right. split; assumption. Qed.
Let uh : upward half.
Proof. apply upward_power. lia. Qed.
Let um : upward margin.
Proof. apply upward_power. lia. Qed.

Ltac upwards :=
  lazymatch goal with
  | |- upward (add _ _) => apply upward_add; upwards
  | |- upward (mul _ _) => apply upward_mul; upwards
  | |- upward (widened _) => apply upward_widened; upwards
  | |- upward (capped _) => apply upward_capped; upwards
  | |- upward (magnitude _) => apply upward_magnitude
  | |- upward (radius _) => apply upward_not_less; first [apply sound_a|apply sound_b]
  | |- upward (growth_speed _) => apply upward_not_less; first [apply sound_a|apply sound_b]
  | |- upward (acceleration_limit _) => apply upward_not_less; first [apply sound_a|apply sound_b]
  | |- upward _ => first [exact us|exact ur|exact ud|exact uh|exact um]
  end.

Lemma upward_plan_a : upward (plan_size a). Proof. unfold plan_size, sum_of_sizes. upwards. Qed.
Lemma upward_plan_b : upward (plan_size b). Proof. unfold plan_size, sum_of_sizes. upwards. Qed.
Lemma upward_speed_a : upward (velocity_size_a a from).
Proof. unfold velocity_size_a, speed_size, plan_size, sum_of_sizes. upwards. Qed.
Lemma upward_speed_b : upward (velocity_size_b b from).
Proof. unfold velocity_size_b, speed_size, plan_size, sum_of_sizes. upwards. Qed.
Lemma upward_growth : upward (growth a b from d).
Proof. unfold growth, growth_then, growth_now, growth_speed_now. upwards. Qed.
Lemma upward_faster : upward (faster a b from d).
Proof. unfold faster, growth_speed_then, growth_speed_now. upwards. Qed.
Lemma upward_radii : upward (a.(radius) + b.(radius))%float.
Proof. upwards. Qed.
Lemma upward_margin : upward (margin * (size_then a b from d + magnitude distance))%float.
Proof.
  unfold size_then, offset_size, velocity_size, acceleration_size, velocity_size_a, velocity_size_b,
    speed_size, plan_size, place_size, sum_of_sizes. upwards.
Qed.
Lemma upward_speed_margin : upward (margin * (velocity_size a b from + acceleration_size a b * d))%float.
Proof.
  unfold velocity_size, acceleration_size, velocity_size_a, velocity_size_b, speed_size, plan_size, sum_of_sizes. upwards.
Qed.
Lemma upward_acceleration_margin : upward (margin * acceleration_size a b)%float.
Proof. unfold acceleration_size, plan_size, sum_of_sizes. upwards. Qed.

(* Then the length is infinite, and all else is finite. *)
Lemma infinite_gap (l : double) : (finite l -> 0 <= B l <= bpow radix2 512) ->
  gap a b from distance d l = infinity -> finite (size_then a b from d) /\ l = infinity.
Proof.
  intros HL E. unfold gap in E.
  destruct (infinite_difference _ _ upward_margin E) as [Fm E1].
  destruct (infinite_difference _ _ upward_growth E1) as [Fg E2]. clear E E1.
  destruct (mul_finite _ _ Fm) as (_ & Fs & _). destruct (add_finite _ _ Fs) as (Ft & Fd & _).
  split; [exact Ft|]. apply (proj1 (magnitude_finite _)) in Fd.
  exact (infinite_reach _ _ _ upward_radii Fd HL E2).
Qed.

Lemma gap_not_infinite (x y z l : double) : (finite l -> 0 <= B l <= bpow radix2 512) ->
  (l = infinity -> l = length a b from d /\
     x = (place_x a b from d / l)%float /\ y = (place_y a b from d / l)%float /\ z = (place_z a b from d / l)%float) ->
  finite (speed a b from d x y z) -> 0 <= B (speed a b from d x y z) ->
  finite (acceleration a b x y z) -> 0 <= B (acceleration a b x y z) ->
  gap a b from distance d l <> infinity.
Proof.
  intros HL HI Fb Pb Fa Pa E.
  destruct (infinite_gap l HL E) as [Ft El]. clear E HL. destruct (HI El) as (ELl & -> & -> & ->). clear HI.
  rewrite El in ELl. subst l.
  destruct (all_known a b from d sound_a sound_b d_pos Ft) as (L & K & M & N & facts).
  unfold speed in *. unfold acceleration in *.
  destruct (sub_finite _ _ Fb) as (Fb1 & Fbm & _). destruct (sub_finite _ _ Fb1) as (Fb2 & Ff & Eb1).
  destruct (sub_finite _ _ Fa) as (Fa1 & Fam & _). destruct (sub_finite _ _ Fa1) as (Fa2 & Fg & Ea1).
  assert (forall u v w, finite (dot (place_x a b from d / infinity) (place_y a b from d / infinity) (place_z a b from d / infinity) u v w)%float ->
    finite (place_x a b from d) /\ finite (place_y a b from d) /\ finite (place_z a b from d) /\
    B (dot (place_x a b from d / infinity) (place_y a b from d / infinity) (place_z a b from d / infinity) u v w)%float = 0) as Dots.
  { intros u0 v0 w0 F. unfold dot in *. destruct (add_finite _ _ F) as (F1 & F2 & ->). destruct (add_finite _ _ F1) as (F3 & F4 & ->).
    destruct (quotient_by_infinity _ _ F2) as [G2 ->]. destruct (quotient_by_infinity _ _ F3) as [G3 ->].
    destruct (quotient_by_infinity _ _ F4) as [G4 ->].
    repeat (split; [assumption|]). rewrite !Rplus_0_r, !rnd_0. reflexivity. }
  destruct (Dots _ _ _ Fb2) as (Fx & Fy & Fz & Zb). destruct (Dots _ _ _ Fa2) as (_ & _ & _ & Za). clear Dots.
  assert (B (margin * (velocity_size a b from + acceleration_size a b * d))%float <= 0) as Nb.
  { apply (below_zero _ _ Fb Pb). rewrite Eb1, Zb. assert (0 <= B (faster a b from d)) by (apply upward_finite; [apply upward_faster|exact Ff]).
    apply rnd_nonpos. lra. }
  assert (B (margin * acceleration_size a b)%float <= 0) as Na.
  { apply (below_zero _ _ Fa Pa). rewrite Ea1, Za.
    assert (0 <= B (acceleration_limit a + acceleration_limit b)%float)
      by (apply upward_finite; [upwards|exact Fg]).
    apply rnd_nonpos. lra. }
  assert (Mb := speed_margin a b from d d_pos L K M N facts Ft Fbm).
  assert (Ma := acceleration_margin a b from d L K M N facts Ft Fam).
  destruct (sizes_finite a b from d Ft) as (_ & _ & _ & _ & _ & _ & _ & EO & _ & _).
  destruct (known_sizes _ _ _ _ _ _ _ _ facts) as (PP & PV & PG & PQ & PW & PH).
  destruct (known_times _ _ _ _ _ _ _ _ facts) as (PS & PT & PD).
  destruct (known_loss_a _ _ _ _ _ _ _ _ facts) as (L1 & L2 & L3).
  destruct (known_loss_b _ _ _ _ _ _ _ _ facts) as (K1 & K2 & K3).
  (* Nothing moves. *)
  apply Rabs_le_inv in Ma, Mb.
  assert (B (plan_size a) = 0 /\ B (plan_size b) = 0) as [ZG ZH].
  { unfold whole_acceleration in Ma. rewrite u_value in Ma. clear - Ma Na PG PH. lra. }
  rewrite ZG, Rmult_0_r in L3. rewrite ZH, Rmult_0_r in K3.
  assert (L = 0) as -> by (apply Rle_antisym; assumption). assert (K = 0) as -> by (apply Rle_antisym; assumption).
  assert (B (speed_size a) = 0 /\ B (speed_size b) = 0) as [ZV ZW].
  { unfold whole_speed in Mb. rewrite ZG, ZH, u_value in Mb. clear - Mb Nb PV PW. lra. }
  assert (B (place_size a) <= bpow radix2 480 /\ B (place_size b) <= bpow radix2 480) as [LP LQ].
  { assert (Fo : finite (offset_size a b from)).
    { unfold size_then in Ft. apply add_finite in Ft. tauto. }
    unfold offset_size in Fo. destruct (capped_finite _ Fo) as (_ & Fo1 & Lo).
    destruct (add_finite _ _ Fo1) as (F1 & F2 & _).
    assert (U1 : 0 <= B (velocity_size_a a from * s)%float).
    { apply upward_finite; [apply upward_mul; [apply upward_speed_a|exact us]|]. apply add_finite in F1. tauto. }
    assert (U2 : 0 <= B (velocity_size_b b from * r)%float).
    { apply upward_finite; [apply upward_mul; [apply upward_speed_b|exact ur]|]. apply add_finite in F2. tauto. }
    assert (Q1 := sum_above _ _ F1 U1). assert (Q2 := sum_above _ _ F2 U2).
    destruct (add_finite _ _ Fo1) as (_ & _ & Eo).
    assert (Q3 : B (place_size a + velocity_size_a a from * s)%float <= bpow radix2 480).
    { eapply Rle_trans; [apply (sum_above _ _ Fo1)|exact Lo]. apply Rle_trans with (1 := PQ). exact Q2. }
    assert (Q4 : B (place_size b + velocity_size_b b from * r)%float <= bpow radix2 480).
    { eapply Rle_trans; [|exact Lo]. rewrite Eo. rewrite <- (rnd_value (place_size b + velocity_size_b b from * r)%float) at 1.
      apply rnd_le. clear - Q1 PP. lra. }
    clear - Q1 Q2 Q3 Q4. lra. }
  assert (forall p v g q w h, (B g <> 0 -> tiny <= 0) -> (B h <> 0 -> tiny <= 0) ->
    Rabs (B p) <= 9 / 8 * bpow radix2 480 -> Rabs (B q) <= 9 / 8 * bpow radix2 480 ->
    Rabs (B v) <= 0 -> Rabs (B g) <= 0 -> Rabs (B w) <= 0 -> Rabs (B h) <= 0 ->
    finite (centre_then p v g s q w h r d) -> Rabs (B (centre_then p v g s q w h r d)) <= bpow radix2 490) as Small.
  { intros p v g q w h Hg Hh Lp Lq Zv Zg Zw Zh F.
    assert (forall t, Rabs t <= 0 -> Rabs t = 0) as Z by (intros t Hx; apply Rle_antisym; [exact Hx|apply Rabs_pos]).
    destruct (place_close a b from d d_pos 0 0 M N facts p v g q w h Hg Hh F) as [C1 C2].
    unfold into, into_centre, into_place, into_velocity in C1, C2.
    rewrite (Z _ Zv), (Z _ Zg), (Z _ Zw), (Z _ Zh) in C1, C2. rewrite !Rmult_0_l, !Rplus_0_l, !Rmult_0_l, !Rplus_0_l in C1, C2.
    change (roundoff (prec := 53)) with u in C1. rewrite u_value in C1.
    assert (tiny <= bpow radix2 480) as T1 by (apply bpow_le; lia).
    assert (bpow radix2 490 = 1024 * bpow radix2 480) as ->
      by (change 490%Z with (10 + 480)%Z; rewrite bpow_plus; reflexivity).
    revert C1 C2 T1 Lp Lq. generalize tiny_pos.
    match goal with |- context [Rabs (?x - ?X)] => generalize X; intros X0; generalize x; intros x0 end.
    generalize (Rabs (B p)) (Rabs (B q)) tiny (bpow radix2 480). clear. intros P Q t E Pt C1 C2 T1 Lp Lq.
    apply Rabs_le_inv in C1, C2. apply Rabs_le. lra. }
  destruct (known_a _ _ _ _ _ _ _ _ facts) as (A1 & A2 & A3). destruct (known_b _ _ _ _ _ _ _ _ facts) as (B1 & B2 & B3).
  destruct (known_radii _ _ _ _ _ _ _ _ facts) as [(RA & EA & CA) (RB & EB & CB)].
  rewrite ZV in A2. rewrite ZG in A3. rewrite ZW in B2. rewrite ZH in B3. rewrite Rmult_0_r in A2, A3, B2, B3.
  destruct (known_plans_a _ _ _ _ _ _ _ _ facts) as (HLx & HLy & HLz & _).
  destruct (known_plans_b _ _ _ _ _ _ _ _ facts) as (HKx & HKy & HKz & _).
  assert (forall x y z w t, Rabs x + Rabs y + Rabs z + w <= t -> 0 <= w -> Rabs x <= t /\ Rabs y <= t /\ Rabs z <= t) as Three.
  { intros x0 y0 z0 w0 t0 HS HW. generalize (Rabs_pos x0) (Rabs_pos y0) (Rabs_pos z0). lra. }
  assert (A1' := Rle_trans _ _ _ A1 (Rmult_le_compat_l (9 / 8) _ _ ltac:(lra) LP)).
  assert (B1' := Rle_trans _ _ _ B1 (Rmult_le_compat_l (9 / 8) _ _ ltac:(lra) LQ)).
  destruct (Three _ _ _ _ _ A1' RA) as (A11 & A12 & A13). destruct (Three _ _ _ _ _ A2 EA) as (A21 & A22 & A23).
  destruct (Three _ _ _ _ _ A3 CA) as (A31 & A32 & A33).
  destruct (Three _ _ _ _ _ B1' RB) as (B11 & B12 & B13). destruct (Three _ _ _ _ _ B2 EB) as (B21 & B22 & B23).
  destruct (Three _ _ _ _ _ B3 CB) as (B31 & B32 & B33).
  apply (small_length (place_x a b from d) (place_y a b from d) (place_z a b from d)); try assumption.
  - unfold place_x in *. apply Small; assumption.
  - unfold place_y in *. apply Small; assumption.
  - unfold place_z in *. apply Small; assumption.
  - unfold length in ELl. symmetry. exact ELl.
Qed.

End Infinite.
