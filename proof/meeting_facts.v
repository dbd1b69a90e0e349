(* The sizes of two bounds limit all numbers in them. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic first_crossing errors.
From Kinesphere Require Import meeting_parts meeting_errors direction magnitudes.
Open Scope R_scope.
Local Opaque add sub mul div root neg magnitude widened capped B2R.

(* Precondition of a bound and of the time from which it is used: no radius or growth is below zero, and the report is
   not from the future. NaNs pass. *)
Definition sound (a : bound) (from : double) : Prop :=
  less a.(radius) (literal 0 0) = false /\ less a.(growth_speed) (literal 0 0) = false /\
  less a.(acceleration_limit) (literal 0 0) = false /\ less from a.(time) = false.

Lemma elapsed_close (from t : double) : less from t = false -> finite (from - t)%float ->
  finite from /\ finite t /\ 0 <= B from - B t /\ close (from - t)%float (B from - B t) (B from - B t) 100.
Proof.
  intros L F. destruct (sub_finite _ _ F) as (Ff & Ft & E). apply less_false in L; try assumption.
  repeat (split; [assumption || lra|]). intros _. rewrite E. generalize (rnd_difference from t).
  rewrite (Rabs_pos_eq (B from - B t)) by lra. change (roundoff (prec := 53)) with u. lra.
Qed.

(* A bound, when its sizes are finite. *)
Lemma bound_sizes (a : bound) (from : double) :
  sound a from -> finite (plan_size a) -> finite (speed_size a) -> finite (place_size a) ->
  let G := B (plan_size a) in let V := B (speed_size a) in let P := B (place_size a) in
  (0 <= P /\ 0 <= V /\ 0 <= G) /\
  (0 <= B a.(radius) /\ 0 <= B a.(growth_speed) /\ 0 <= B a.(acceleration_limit)) /\
  (Rabs (B a.(position_x)) + Rabs (B a.(position_y)) + Rabs (B a.(position_z)) + B a.(radius) <= 9 / 8 * P /\
   Rabs (B a.(velocity_x)) + Rabs (B a.(velocity_y)) + Rabs (B a.(velocity_z)) + B a.(growth_speed) <= 9 / 8 * V /\
   Rabs (B a.(plan_x)) + Rabs (B a.(plan_y)) + Rabs (B a.(plan_z)) + B a.(acceleration_limit) <= 9 / 8 * G) /\
  (exists L, (0 <= L /\ L <= tiny /\ L <= few * G) /\
    (B a.(plan_x) <> 0 -> tiny <= L) /\ (B a.(plan_y) <> 0 -> tiny <= L) /\ (B a.(plan_z) <> 0 -> tiny <= L) /\
    (B a.(acceleration_limit) <> 0 -> tiny <= L) /\ (B (plan_size a) <> 0 -> tiny <= L)) /\
  (exists L, (0 <= L /\ L <= few * V) /\
    (B a.(velocity_x) <> 0 -> tiny <= L) /\ (B a.(velocity_y) <> 0 -> tiny <= L) /\ (B a.(velocity_z) <> 0 -> tiny <= L) /\
    (B (speed_size a) <> 0 -> tiny <= L)).
Proof.
  intros (N1 & N2 & N3 & _) FG FV FP G V P.
  destruct (sum_of_sizes_above _ _ _ _ FG N3) as (_ & _ & _ & _ & PC & SG & ZG & PG & CG).
  destruct (sum_of_sizes_above _ _ _ _ FV N2) as (_ & _ & _ & _ & PE & SV & ZV & PV & CV).
  destruct (sum_of_sizes_above _ _ _ _ FP N1) as (_ & _ & _ & _ & PR & SP & _ & PP & _).
  fold (plan_size a) in *. fold (speed_size a) in *. fold (place_size a) in *.
  fold G in SG, ZG, PG, CG. fold V in SV, ZV, PV, CV. fold P in SP, PP.
  generalize tiny_pos. intros PT.
  assert (0 < bpow radix2 (-480)) as P480 by apply bpow_gt_0.
  assert (tiny <= few * bpow radix2 (-480)) as T480.
  { unfold few, least. rewrite <- bpow_plus. apply bpow_le. lia. }
  assert (0 < few) as PF by apply bpow_gt_0.
  set (q := bpow radix2 (-480)) in *. set (w := few) in *. set (z := tiny) in *. fold G V P.
  clearbody q w z G V P.
  split; [tauto|]. split; [tauto|]. split; [tauto|]. split.
  - destruct CG as [C|C].
    + exists 0. rewrite C, Rmult_0_r. split; [lra|].
      do 4 (split; [intros N; assert (q <= G) by (apply ZG; auto); lra|]).
      intros N. exfalso. apply N. reflexivity.
    + exists z. split; [|repeat (split; [intros _; lra|]); intros _; lra].
      assert (w * q <= w * G) by (apply Rmult_le_compat_l; lra). lra.
  - destruct CV as [C|C].
    + exists 0. rewrite C, Rmult_0_r. split; [lra|].
      do 3 (split; [intros N; assert (q <= V) by (apply ZV; auto); lra|]).
      intros N. exfalso. apply N. reflexivity.
    + exists z. split; [|repeat (split; [intros _; lra|]); intros _; lra].
      assert (w * q <= w * V) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Lemma close_positive (x : double) : 0 <= B x -> close x (B x) (B x) 0.
Proof. intros P. rewrite <- (Rabs_pos_eq (B x) P) at 2. apply close_exact. Qed.

Section Step.

Variables a b : bound.
Variables from distance d : double.
Hypothesis sound_a : sound a from.
Hypothesis sound_b : sound b from.
Hypothesis d_finite : finite d.
Hypothesis d_pos : 0 <= B d.

Notation s := (elapsed_a a from).
Notation r := (elapsed_b b from).
Notation S := (B from - B a.(time)).
Notation T := (B from - B b.(time)).
Notation D := (B d).
Notation G := (B (plan_size a)).
Notation V := (B (speed_size a)).
Notation P := (B (place_size a)).
Notation H := (B (plan_size b)).
Notation W := (B (speed_size b)).
Notation Q := (B (place_size b)).

Lemma sizes_finite : finite (size_then a b from d) ->
  (finite (plan_size a) /\ finite (speed_size a) /\ finite (place_size a)) /\
  (finite (plan_size b) /\ finite (speed_size b) /\ finite (place_size b)) /\
  finite s /\ finite r /\ finite d /\
  acceleration_size a b = (plan_size a + plan_size b)%float /\
  velocity_size a b from = (velocity_size_a a from + velocity_size_b b from)%float /\
  offset_size a b from = ((place_size a + velocity_size_a a from * s) + (place_size b + velocity_size_b b from * r))%float /\
  finite (acceleration_size a b) /\ B (plan_size a + plan_size b)%float <= bpow radix2 480.
Proof.
  unfold size_then. intros F.
  destruct (add_finite _ _ F) as (F1 & F2 & _). destruct (mul_finite _ _ F2) as (F3 & Fd & _).
  destruct (add_finite _ _ F3) as (F4 & F5 & _). destruct (mul_finite _ _ F5) as (F6 & _ & _).
  destruct (mul_finite _ _ F6) as (_ & F7 & _).
  destruct (capped_finite _ F1) as (E1 & F8 & _). destruct (capped_finite _ F4) as (E4 & F9 & _).
  destruct (capped_finite _ F7) as (E7 & F10 & L7).
  apply add_finite in F10. destruct F10 as (FG & FH & _).
  apply add_finite in F9. destruct F9 as (FVa & FVb & _).
  apply add_finite in FVa. destruct FVa as (FV & FVs & _). apply add_finite in FVb. destruct FVb as (FW & FWr & _).
  apply mul_finite in FVs. apply mul_finite in FWr.
  apply add_finite in F8. destruct F8 as (FPa & FPb & _).
  apply add_finite in FPa. destruct FPa as (FP & _). apply add_finite in FPb. destruct FPb as (FQ & _).
  split; [auto|]. split; [auto|]. split; [apply FVs|]. split; [apply FWr|]. split; [exact Fd|].
  split; [exact E7|]. split; [exact E4|]. split; [exact E1|]. split; [exact F7|exact L7].
Qed.

(* All facts that the proof of the coefficients uses. *)
Record known (L K M N : R) : Prop := {
  known_times : 0 <= S /\ 0 <= T /\ 0 <= D;
  known_s : close s S S 100;
  known_r : close r T T 100;
  known_sizes : 0 <= P /\ 0 <= V /\ 0 <= G /\ 0 <= Q /\ 0 <= W /\ 0 <= H;
  known_radii : (0 <= B a.(radius) /\ 0 <= B a.(growth_speed) /\ 0 <= B a.(acceleration_limit)) /\
    (0 <= B b.(radius) /\ 0 <= B b.(growth_speed) /\ 0 <= B b.(acceleration_limit));
  known_a :
    Rabs (B a.(position_x)) + Rabs (B a.(position_y)) + Rabs (B a.(position_z)) + B a.(radius) <= 9 / 8 * P /\
    Rabs (B a.(velocity_x)) + Rabs (B a.(velocity_y)) + Rabs (B a.(velocity_z)) + B a.(growth_speed) <= 9 / 8 * V /\
    Rabs (B a.(plan_x)) + Rabs (B a.(plan_y)) + Rabs (B a.(plan_z)) + B a.(acceleration_limit) <= 9 / 8 * G;
  known_b :
    Rabs (B b.(position_x)) + Rabs (B b.(position_y)) + Rabs (B b.(position_z)) + B b.(radius) <= 9 / 8 * Q /\
    Rabs (B b.(velocity_x)) + Rabs (B b.(velocity_y)) + Rabs (B b.(velocity_z)) + B b.(growth_speed) <= 9 / 8 * W /\
    Rabs (B b.(plan_x)) + Rabs (B b.(plan_y)) + Rabs (B b.(plan_z)) + B b.(acceleration_limit) <= 9 / 8 * H;
  known_loss_a : 0 <= L /\ L <= tiny /\ L <= few * G;
  known_loss_b : 0 <= K /\ K <= tiny /\ K <= few * H;
  known_plans_a : (B a.(plan_x) <> 0 -> tiny <= L) /\ (B a.(plan_y) <> 0 -> tiny <= L) /\ (B a.(plan_z) <> 0 -> tiny <= L) /\
    (B a.(acceleration_limit) <> 0 -> tiny <= L) /\ (B (plan_size a) <> 0 -> tiny <= L);
  known_plans_b : (B b.(plan_x) <> 0 -> tiny <= K) /\ (B b.(plan_y) <> 0 -> tiny <= K) /\ (B b.(plan_z) <> 0 -> tiny <= K) /\
    (B b.(acceleration_limit) <> 0 -> tiny <= K) /\ (B (plan_size b) <> 0 -> tiny <= K);
  known_loss_of_speeds : (0 <= M /\ M <= few * V) /\ (0 <= N /\ N <= few * W);
  known_speeds_a : (B a.(velocity_x) <> 0 -> tiny <= M) /\ (B a.(velocity_y) <> 0 -> tiny <= M) /\
    (B a.(velocity_z) <> 0 -> tiny <= M) /\ (B (speed_size a) <> 0 -> tiny <= M);
  known_speeds_b : (B b.(velocity_x) <> 0 -> tiny <= N) /\ (B b.(velocity_y) <> 0 -> tiny <= N) /\
    (B b.(velocity_z) <> 0 -> tiny <= N) /\ (B (speed_size b) <> 0 -> tiny <= N);
  known_plans : G <= bpow radix2 480 /\ H <= bpow radix2 480
}.

Lemma all_known : finite (size_then a b from d) -> exists L K M N, known L K M N.
Proof.
  intros F. destruct (sizes_finite F) as ((FG & FV & FP) & (FH & FW & FQ) & Fs & Fr & _ & EA & EV & EO & FA & LA).
  destruct (bound_sizes a from sound_a FG FV FP) as (X1 & X2 & X3 & (L & L1 & L2) & (M & M1 & M2)).
  destruct (bound_sizes b from sound_b FH FW FQ) as (Y1 & Y2 & Y3 & (K & K1 & K2) & (N & N1 & N2)).
  destruct (elapsed_close from a.(time) ltac:(apply sound_a) Fs) as (_ & _ & PS & CS).
  destruct (elapsed_close from b.(time) ltac:(apply sound_b) Fr) as (_ & _ & PT & CT).
  exists L, K, M, N.
  refine (Build_known _ _ _ _ (conj PS (conj PT d_pos)) CS CT _ (conj X2 Y2) X3 Y3 L1 K1 L2 K2 (conj M1 N1) M2 N2 _).
  { destruct X1 as (? & ? & ?), Y1 as (? & ? & ?). auto 10. }
  rewrite EA in FA. apply add_finite in FA. destruct FA as (_ & _ & EA').
  rewrite EA' in LA.
  split; (eapply Rle_trans; [|exact LA]).
  - rewrite <- (rnd_value (plan_size a)) at 1. apply rnd_le. lra.
  - rewrite <- (rnd_value (plan_size b)) at 1. apply rnd_le. lra.
Qed.

End Step.
