(* A computed length, and the direction that is divided by it. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic first_crossing errors.
From Kinesphere Require Import meeting_parts meeting_errors.
Open Scope R_scope.

Definition norm (x y z : R) : R := sqrt (x * x + y * y + z * z).

Lemma norm_square x y z : norm x y z * norm x y z = x * x + y * y + z * z /\ 0 <= norm x y z.
Proof. split; [apply sqrt_sqrt; nra|apply sqrt_pos]. Qed.

(* Cauchy and Schwarz. *)
Lemma norm_above x y z u v w : u * u + v * v + w * w <= 1 -> x * u + y * v + z * w <= norm x y z.
Proof.
  intros U. destruct (norm_square x y z) as [E P].
  apply Rnot_lt_le. intros L.
  assert (norm x y z * norm x y z < (x * u + y * v + z * w) * (x * u + y * v + z * w)) by nra.
  assert ((x * u + y * v + z * w) * (x * u + y * v + z * w) <= (x * x + y * y + z * z) * (u * u + v * v + w * w)).
  { assert (0 <= (x * v - y * u) * (x * v - y * u) + (y * w - z * v) * (y * w - z * v) + (z * u - x * w) * (z * u - x * w))
      by (generalize (Rle_0_sqr (x * v - y * u)) (Rle_0_sqr (y * w - z * v)) (Rle_0_sqr (z * u - x * w)); unfold Rsqr; lra).
    lra. }
  nra.
Qed.

Lemma norm_at_most x y z : norm x y z <= Rabs x + Rabs y + Rabs z.
Proof.
  destruct (norm_square x y z) as [E P]. generalize (Rabs_pos x) (Rabs_pos y) (Rabs_pos z). intros.
  apply Rnot_lt_le. intros L.
  assert (x * x = Rabs x * Rabs x /\ y * y = Rabs y * Rabs y /\ z * z = Rabs z * Rabs z) as (Ex & Ey & Ez).
  { repeat split; [rewrite <- (Rabs_pos_eq (x * x))|rewrite <- (Rabs_pos_eq (y * y))|rewrite <- (Rabs_pos_eq (z * z))];
      try nra; apply Rabs_mult. }
  nra.
Qed.

Lemma part_of_norm x y z : Rabs x <= norm x y z.
Proof.
  destruct (norm_square x y z) as [E P]. apply Rabs_le.
  split; apply Rnot_lt_le; intros L; nra.
Qed.

Lemma length_close (x y z : double) :
  finite (length_of x y z) -> less (literal 1 (-500)) (length_of x y z) = true ->
  let N := norm (B x) (B y) (B z) in
  finite x /\ finite y /\ finite z /\ bpow radix2 (-501) <= N /\ Rabs (B (length_of x y z) - N) <= 5 * u * N.
Proof.
  intros F L N. unfold length_of in *.
  destruct (literal_power (-500)) as [FL VL]; [lia|].
  apply less_true in L; [|exact FL|exact F]. rewrite VL in L.
  destruct (root_finite _ F) as (Fs & Ps & E).
  assert (finite x /\ finite y /\ finite z) as (Fx & Fy & Fz).
  { generalize Fs. intros F1. apply add_finite in F1. destruct F1 as (F1 & F3 & _). apply add_finite in F1.
    destruct F1 as (F1 & F2 & _). apply mul_finite in F1, F2, F3. tauto. }
  do 3 (split; [assumption|]).
  set (f := (x * x + y * y + z * z)%float) in *.
  generalize (rnd_root f Ps). rewrite <- E. intros R. apply Rabs_le_inv in R.
  assert (Rabs (B f - N * N) <= 304 * (u / 100) * (N * N + 3 * tiny)) as C.
  { destruct (norm_square (B x) (B y) (B z)) as [EN _]. fold N in EN. rewrite EN.
    assert (close f (B x * B x + B y * B y + B z * B z)
      (Rabs (B x) * Rabs (B x) + tiny + (Rabs (B y) * Rabs (B y) + tiny) + (Rabs (B z) * Rabs (B z) + tiny)) 304) as C.
    { unfold f. eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths]. }
    destruct (C Fs) as [C' _]. rewrite <- !Rabs_mult in C'.
    rewrite (Rabs_pos_eq (B x * B x)), (Rabs_pos_eq (B y * B y)), (Rabs_pos_eq (B z * B z)) in C' by nra.
    rewrite roundoff_u in C'. eapply Rle_trans; [exact C'|]. right. ring. }
  assert (0 <= sqrt (B f)) as PS by apply sqrt_pos.
  assert (sqrt (B f) * sqrt (B f) = B f) as SS by (apply sqrt_sqrt; exact Ps).
  destruct (norm_square (B x) (B y) (B z)) as [_ PN]. fold N in PN.
  assert (0 < bpow radix2 (-500)) as P0 by apply bpow_gt_0.
  assert (bpow radix2 (-500) * bpow radix2 (-500) = bpow radix2 (-1000)) as Q0 by (rewrite <- bpow_plus; reflexivity).
  assert (tiny * 1000 <= bpow radix2 (-1000)) as Q1.
  { unfold least. apply Rle_trans with (bpow radix2 (2 - 1024) * bpow radix2 10).
    - apply Rmult_le_compat_l; [apply bpow_ge_0|]. simpl. lra.
    - rewrite <- bpow_plus. apply bpow_le. lia. }
  assert (bpow radix2 (-501) = bpow radix2 (-500) * / 2) as Q2
    by (change (-501)%Z with (-500 + -1)%Z; rewrite bpow_plus; reflexivity).
  generalize tiny_pos. intros PT. apply Rabs_le_inv in C.
  assert (bpow radix2 (-500) * (999 / 1000) <= sqrt (B f)) as L1 by (rewrite u_value in R; lra).
  assert (bpow radix2 (-1000) * (998 / 1000) <= B f) as L2.
  { rewrite <- SS, <- Q0.
    assert (bpow radix2 (-500) * (999 / 1000) * (bpow radix2 (-500) * (999 / 1000)) <= sqrt (B f) * sqrt (B f))
      by (apply Rmult_le_compat; nra). nra. }
  assert (bpow radix2 (-1000) * (99 / 100) <= N * N) as L3 by (rewrite u_value in C; lra).
  assert (3 * tiny <= / 100 * (N * N)) as L4 by lra.
  assert (bpow radix2 (-501) <= N) as L5.
  { rewrite Q2. apply Rnot_lt_le. intros W.
    assert (N * N <= bpow radix2 (-500) * / 2 * (bpow radix2 (-500) * / 2)) by (apply Rmult_le_compat; lra).
    nra. }
  split; [exact L5|].
  assert (0 < N) as PN' by (generalize (bpow_gt_0 radix2 (-501)); lra).
  assert (- (31 / 10) * u * (N * N) <= B f - N * N <= 31 / 10 * u * (N * N)) as C'.
  { assert (304 * (u / 100) * (N * N + 3 * tiny) <= 304 * (u / 100) * (N * N * (101 / 100)))
      by (apply Rmult_le_compat_l; rewrite ?u_value; lra).
    rewrite u_value in *. lra. }
  assert (N * (1 - 31 / 10 * u) <= sqrt (B f) <= N * (1 + 31 / 10 * u)) as C2.
  { rewrite <- SS in C'. set (q := sqrt (B f)) in *. rewrite u_value in *.
    split; apply Rnot_lt_le; intros W.
    - assert (q * q <= N * (1 - 31 / 10 * / 9007199254740992) * N)
        by (apply Rmult_le_compat; lra). nra.
    - assert (N * (1 + 31 / 10 * / 9007199254740992) * N < q * q)
        by (apply Rmult_le_0_lt_compat; nra). nra. }
  apply Rabs_le. rewrite u_value in *. nra.
Qed.

Lemma div_value (x y : double) : finite x -> B y <> 0 -> finite (x / y)%float -> B (x / y)%float = rnd64 (B x / B y).
Proof.
  intros Fx N F. generalize (Bdiv_correct 53 1024 _ _ mode_NE x y N). fold (div x y).
  destruct Rlt_bool; intros C; [tauto|]. apply overflow_infinite in C. congruence.
Qed.

Lemma direction_close (x l : double) (N : R) :
  finite x -> Rabs (B x) <= N -> 0 < N -> Rabs (B l - N) <= 5 * u * N -> close (x / l)%float (B x / N) 1 700.
Proof.
  intros Fx LX PN E F. apply Rabs_le_inv in E.
  assert (B l <> 0) as Nl by (rewrite u_value in E; lra).
  rewrite (div_value x l Fx Nl F). set (L := B l) in *.
  assert (Rabs (B x / N) <= 1) as L1.
  { unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ N)) by (apply Rlt_le, Rinv_0_lt_compat; exact PN).
    apply Rmult_le_reg_r with N; [exact PN|]. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  split; [|exact L1].
  assert (B x / L = B x / N * (N / L)) as -> by (field; split; lra).
  set (q := B x / N) in *.
  assert (1 - 55 / 10 * u <= N / L <= 1 + 55 / 10 * u) as [D1 D2].
  { assert (0 < L) by (rewrite u_value in E; lra).
    split; apply Rmult_le_reg_r with L; try assumption; unfold Rdiv; rewrite (Rmult_assoc N), Rinv_l by lra;
      rewrite u_value in *; lra. }
  generalize (rounded_error (prec := 53) (emax := 1024) (q * (N / L))).
  change (roundoff (prec := 53)) with u. intros R.
  assert (Rabs (q * (N / L) - q) <= 55 / 10 * u) as R1.
  { replace (q * (N / L) - q) with (q * (N / L - 1)) by ring. rewrite Rabs_mult.
    rewrite <- (Rmult_1_l (55 / 10 * u)).
    apply Rmult_le_compat; auto using Rabs_pos. apply Rabs_le. lra. }
  assert (Rabs (q * (N / L)) <= 101 / 100) as R2.
  { replace (q * (N / L)) with ((q * (N / L) - q) + q) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite u_value in R1. lra. }
  assert (tiny <= / 100) as R3.
  { unfold least. apply Rle_trans with (bpow radix2 (-7)); [apply bpow_le; lia|simpl; lra]. }
  replace (rnd64 (q * (N / L)) - q) with ((rnd64 (q * (N / L)) - q * (N / L)) + (q * (N / L) - q)) by ring.
  eapply Rle_trans; [apply Rabs_triang|].
  assert (u * (Rabs (q * (N / L)) + tiny) <= u * (102 / 100)) by (apply Rmult_le_compat_l; rewrite ?u_value; lra).
  change (roundoff (prec := 53)) with u. rewrite u_value in *. lra.
Qed.
