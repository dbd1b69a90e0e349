(* The step of earliest_meeting in parts with names, and its sums of sizes. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic first_crossing errors.
Open Scope R_scope.

(* The parts of the step. *)
Notation half := (literal (prec := 53) (emax := 1024) 1 (-1)).
Notation margin := (literal (prec := 53) (emax := 1024) 1 (-47)).

Definition velocity_now (v g s w h r : double) : double := ((v + g * s) - (w + h * r))%float.
Definition centre_now (p v g s q w h r : double) : double :=
  ((p + (v + g * (half * s)) * s) - (q + (w + h * (half * r)) * r))%float.
Definition centre_then (p v g s q w h r d : double) : double :=
  (centre_now p v g s q w h r + (velocity_now v g s w h r + (g - h) * (half * d)) * d)%float.
Definition velocity_then (v g s w h r d : double) : double := (velocity_now v g s w h r + (g - h) * d)%float.

Definition growth_now (e c s f k r : double) : double :=
  ((e + half * c * s) * s + (f + half * k * r) * r)%float.
Definition growth_speed_now (e c s f k r : double) : double := ((e + c * s) + (f + k * r))%float.
Definition growth_then (e c s f k r d : double) : double :=
  (growth_now e c s f k r + (growth_speed_now e c s f k r + half * (c + k) * d) * d)%float.
Definition growth_speed_then (e c s f k r d : double) : double := (growth_speed_now e c s f k r + (c + k) * d)%float.

Definition sum_of_sizes (x y z r : double) : double := widened (magnitude x + magnitude y + magnitude z + r)%float.
Definition plan_size (a : bound) : double :=
  sum_of_sizes a.(plan_x) a.(plan_y) a.(plan_z) a.(acceleration_limit).
Definition speed_size (a : bound) : double :=
  sum_of_sizes a.(velocity_x) a.(velocity_y) a.(velocity_z) a.(growth_speed).
Definition place_size (a : bound) : double :=
  sum_of_sizes a.(position_x) a.(position_y) a.(position_z) a.(radius).

Definition length_of (x y z : double) : double := root (x * x + y * y + z * z)%float.
Definition dot (x y z u v w : double) : double := (x * u + y * v + z * w)%float.

Section Parts.

Variables a b : bound.
Variables from distance d : double.

Definition elapsed_a : double := (from - a.(time))%float.
Definition elapsed_b : double := (from - b.(time))%float.
Notation s := elapsed_a.
Notation r := elapsed_b.

Definition acceleration_size : double := capped (plan_size a + plan_size b)%float.
Definition velocity_size_a : double := (speed_size a + plan_size a * s)%float.
Definition velocity_size_b : double := (speed_size b + plan_size b * r)%float.
Definition velocity_size : double := capped (velocity_size_a + velocity_size_b)%float.
Definition offset_size : double :=
  capped ((place_size a + velocity_size_a * s) + (place_size b + velocity_size_b * r))%float.
Definition size_then : double := (offset_size + (velocity_size + half * acceleration_size * d) * d)%float.

Definition place_x : double := centre_then a.(position_x) a.(velocity_x) a.(plan_x) s b.(position_x) b.(velocity_x) b.(plan_x) r d.
Definition place_y : double := centre_then a.(position_y) a.(velocity_y) a.(plan_y) s b.(position_y) b.(velocity_y) b.(plan_y) r d.
Definition place_z : double := centre_then a.(position_z) a.(velocity_z) a.(plan_z) s b.(position_z) b.(velocity_z) b.(plan_z) r d.
Definition speed_x : double := velocity_then a.(velocity_x) a.(plan_x) s b.(velocity_x) b.(plan_x) r d.
Definition speed_y : double := velocity_then a.(velocity_y) a.(plan_y) s b.(velocity_y) b.(plan_y) r d.
Definition speed_z : double := velocity_then a.(velocity_z) a.(plan_z) s b.(velocity_z) b.(plan_z) r d.

Definition reach : double := (a.(radius) + b.(radius) + distance)%float.
Definition growth : double := growth_then a.(growth_speed) a.(acceleration_limit) s b.(growth_speed) b.(acceleration_limit) r d.
Definition faster : double := growth_speed_then a.(growth_speed) a.(acceleration_limit) s b.(growth_speed) b.(acceleration_limit) r d.
Definition length : double := length_of place_x place_y place_z.

(* The coefficients, for a direction and the distance of the centres along it. *)
Definition gap (l : double) : double := (((l - reach) - growth) - margin * (size_then + magnitude distance))%float.
Definition speed (x y z : double) : double :=
  ((dot x y z speed_x speed_y speed_z - faster) - margin * (velocity_size + acceleration_size * d))%float.
Definition acceleration (x y z : double) : double :=
  ((dot x y z (a.(plan_x) - b.(plan_x)) (a.(plan_y) - b.(plan_y)) (a.(plan_z) - b.(plan_z))
    - (a.(acceleration_limit) + b.(acceleration_limit))) - margin * acceleration_size)%float.

Definition step_along (l x y z : double) : double := first_crossing (gap l) (speed x y z) (acceleration x y z).

Lemma meeting_step_parts :
  meeting_step a b from distance d =
  let o := literal 0 0 in
  if less (literal 1 (-500)) length then
    if less o length then
      step_along length (place_x / length)%float (place_y / length)%float (place_z / length)%float
    else step_along length o o o
  else step_along o o o o.
Proof.
  cbv beta zeta delta [meeting_step step_along gap speed acceleration dot length length_of faster growth reach
    speed_x speed_y speed_z place_x place_y place_z size_then offset_size velocity_size velocity_size_a
    velocity_size_b acceleration_size elapsed_a elapsed_b place_size speed_size plan_size sum_of_sizes
    growth_speed_then growth_then growth_speed_now growth_now velocity_then centre_then centre_now velocity_now].
  (* Compares the text first: reflexivity would compute for hours if the two differ. *)
  match goal with |- ?x = ?y => constr_eq x y end. reflexivity.
Qed.

End Parts.

(* Sizes. *)
Lemma magnitude_close (x : double) : close (magnitude x) (Rabs (B x)) (Rabs (B x)) 0.
Proof. intros _. rewrite magnitude_value, Rminus_diag_eq, Rabs_R0, Rabs_Rabsolu by reflexivity. lra. Qed.

Lemma not_less_0 (x : double) : finite x -> less x (literal 0 0) = false -> 0 <= B x.
Proof. intros F L. rewrite <- (proj2 literal_0). apply less_false; auto using (proj1 literal_0). Qed.

Lemma roundoff_u : roundoff (prec := 53) = u.
Proof. reflexivity. Qed.

Lemma widened_finite (x : double) : finite (widened x) -> finite x.
Proof. unfold widened. destruct less; intros F; apply add_finite in F; tauto. Qed.

Lemma widened_above (x : double) : finite (widened x) -> 0 <= B x ->
  B x <= B (widened x) /\ (0 < B x -> bpow radix2 (-480) <= B (widened x)) /\ (B x = 0 -> B (widened x) = 0).
Proof.
  intros F P. assert (finite x) as Fx by (apply widened_finite; exact F).
  destruct (literal_power (-480)) as [FL VL]; [lia|].
  revert F. unfold widened. destruct (less (literal 0 0) x) eqn:L.
  - intros F. apply less_true in L; [|exact (proj1 literal_0)|exact Fx]. rewrite (proj2 literal_0) in L.
    apply add_finite in F. destruct F as (_ & _ & ->). rewrite VL.
    generalize (bpow_gt_0 radix2 (-480)). intros G. split; [|split; [|lra]].
    + rewrite <- (rnd_value x) at 1. apply rnd_le. lra.
    + intros _. apply rnd_ge_bpow; [lia|lra].
  - intros F. apply less_false in L; [|exact (proj1 literal_0)|exact Fx]. rewrite (proj2 literal_0) in L.
    apply add_finite in F. destruct F as (_ & _ & ->). rewrite (proj2 literal_0), Rplus_0_r, rnd_value.
    repeat split; lra.
Qed.

(* The numbers that go into a sum are not more than it, by much, and where one is not zero it is not tiny. *)
Lemma sum_of_sizes_above (x y z r : double) :
  finite (sum_of_sizes x y z r) -> less r (literal 0 0) = false ->
  finite x /\ finite y /\ finite z /\ finite r /\ 0 <= B r /\
  Rabs (B x) + Rabs (B y) + Rabs (B z) + B r <= 9 / 8 * B (sum_of_sizes x y z r) /\
  (B x <> 0 \/ B y <> 0 \/ B z <> 0 \/ B r <> 0 -> bpow radix2 (-480) <= B (sum_of_sizes x y z r)) /\
  0 <= B (sum_of_sizes x y z r) /\
  (B (sum_of_sizes x y z r) = 0 \/ bpow radix2 (-480) <= B (sum_of_sizes x y z r)).
Proof.
  unfold sum_of_sizes. intros F N.
  assert (finite (magnitude x + magnitude y + magnitude z + r)%float) as Fs by (apply widened_finite; exact F).
  assert (finite x /\ finite y /\ finite z /\ finite r) as (Fx & Fy & Fz & Fr).
  { apply add_finite in Fs. destruct Fs as (Fs & Fr & _). apply add_finite in Fs. destruct Fs as (Fs & Fz & _).
    apply add_finite in Fs. destruct Fs as (Fx & Fy & _). rewrite !magnitude_finite in *. tauto. }
  assert (0 <= B r) as Pr by (apply not_less_0; assumption).
  do 4 (split; [assumption|]). split; [exact Pr|].
  assert (exists k, (0 <= k <= 1000)%Z /\
    close (magnitude x + magnitude y + magnitude z + r)%float (Rabs (B x) + Rabs (B y) + Rabs (B z) + B r)
    (Rabs (B x) + Rabs (B y) + Rabs (B z) + Rabs (B r)) k) as (k & Hk & C).
  { generalize (magnitude_close x) (magnitude_close y) (magnitude_close z). intros.
    eexists. split; [|find_close]. vm_compute. split; discriminate. }
  destruct (C Fs) as [E _]. rewrite (Rabs_pos_eq (B r)) in E by exact Pr.
  rewrite roundoff_u, u_value in E. destruct Hk as [K1 K2]. apply IZR_le in K1, K2.
  generalize (Rabs_pos (B x)) (Rabs_pos (B y)) (Rabs_pos (B z)). intros Px Py Pz.
  set (S := Rabs (B x) + Rabs (B y) + Rabs (B z) + B r) in *.
  set (f := B (magnitude x + magnitude y + magnitude z + r)%float) in *.
  assert (Rabs (f - S) <= / 100 * S) as E'.
  { apply Rle_trans with (1 := E). apply Rmult_le_compat_r; unfold S; lra. }
  apply Rabs_le_inv in E'.
  assert (0 <= f) as Pf by (unfold S in *; lra).
  destruct (widened_above _ F Pf) as (A1 & A2 & A3). fold f in A1, A2, A3. split; [lra|].
  split; [|split; [lra|destruct Pf as [Pf|Pf]; auto]].
  intros NZ. apply A2. assert (0 < S); [|lra].
  unfold S. destruct NZ as [Z|[Z|[Z|Z]]]; try (apply Rabs_pos_lt in Z; lra). lra.
Qed.

Lemma capped_finite (x : double) : finite (capped x) -> capped x = x /\ finite x /\ B x <= bpow radix2 480.
Proof.
  unfold capped. destruct (at_most x (literal 1 480)) eqn:L; intros F; [|discriminate].
  destruct (literal_power 480) as [FL VL]; [lia|].
  split; [reflexivity|]. split; [exact F|]. rewrite <- VL. apply at_most_true; assumption.
Qed.

Lemma half_close : close half (/ 2) (/ 2) 0.
Proof.
  destruct (literal_power (-1)) as [_ V]; [lia|]. intros _. rewrite V. change (bpow radix2 (-1)) with (/ 2).
  rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. rewrite Rabs_pos_eq by lra. lra.
Qed.
Lemma margin_close : close margin (64 * u) (64 * u) 0.
Proof.
  destruct (literal_power (-47)) as [_ V]; [lia|]. intros _. rewrite V.
  replace (bpow radix2 (-47)) with (64 * u) by (rewrite u_value; simpl; lra).
  rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. rewrite Rabs_pos_eq by (rewrite u_value; lra). lra.
Qed.
