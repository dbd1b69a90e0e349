(* The growth of the bound of a point that is fixed in a turning body, in double precision, is that of Lemma T or more. *)
From Coq Require Import Reals Lra Lia Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats rounding kernels geometry_vectors.
Open Scope R_scope.

(* What underflow may take from a length: its square loses 8 lost at most. *)
Notation tiny := (bpow radix2 (-536)).
Lemma tiny_square : tiny * tiny = 8 * lost.
Proof. unfold lost. change 8 with (bpow radix2 3). rewrite <- !bpow_plus. reflexivity. Qed.
Lemma tiny_pos : 0 < tiny.
Proof. apply bpow_gt_0. Qed.
Lemma lost_at_most_tiny : lost <= tiny * u.
Proof. unfold lost, u. rewrite <- bpow_plus. apply bpow_le. discriminate. Qed.

Lemma product_from_below (a b : double) : finite (a * b)%float -> 0 <= B a * B b ->
  finite a /\ finite b /\ 0 <= B (a * b)%float /\ B a * B b * (1 - u) - lost <= B (a * b)%float.
Proof.
  intros F P. destruct (mul_finite _ _ F) as (Fa & Fb & E). rewrite E. auto using rnd_nonneg, rnd_lower.
Qed.
Lemma sum_from_below (a b : double) : finite (a + b)%float -> 0 <= B a + B b ->
  finite a /\ finite b /\ 0 <= B (a + b)%float /\ (B a + B b) * (1 - u) <= B (a + b)%float.
Proof.
  intros F P. destruct (add_finite _ _ F) as (Fa & Fb & E). rewrite E. split; [exact Fa|]. split; [exact Fb|].
  split; [apply rnd_nonneg; exact P|]. generalize (rnd_sum a b). rewrite (Rabs_pos_eq _ P). intros L. apply Rabs_le_inv in L. lra.
Qed.

(* The factor 1 + 2^-47 is exact. *)
Lemma factor (f : double) : f = (literal 1 0 + literal 1 (-47))%float -> finite f -> B f = 1 + 64 * u.
Proof.
  intros E F. rewrite E in F. destruct (add_finite _ _ F) as (_ & _ & V). rewrite E. rewrite V.
  rewrite (proj2 (literal_power 0 ltac:(lia))), (proj2 (literal_power (-47) ltac:(lia))), rnd64_FLT.
  replace (bpow radix2 0 + bpow radix2 (-47)) with (1 + 64 * u) by (unfold u; cbn; lra).
  apply round_generic; [apply valid_rnd_N|]. apply generic_format_FLT.
  exists (Float radix2 140737488355329 (-47)); [unfold F2R, u; cbn; lra|reflexivity|discriminate].
Qed.

(* The length of an arm. *)
Lemma root_of_squares (d s : R) : 0 <= d -> 0 <= s -> d * d * ((1 - u) * (1 - u) * (1 - u)) - 3 * lost <= s ->
  d * (1 - 2 * u) - tiny <= sqrt s.
Proof.
  intros Pd Ps H. destruct (Rle_or_lt (d * (1 - 2 * u)) tiny) as [L|L]; [generalize (sqrt_pos s); lra|].
  rewrite <- (sqrt_square (d * (1 - 2 * u) - tiny)) by lra. apply sqrt_le_1_alt.
  generalize tiny_square tiny_pos lost_pos. intros T P Q. set (e := tiny) in *.
  assert (d * d * ((1 - 2 * u) * (1 - 2 * u)) <= d * d * ((1 - u) * (1 - u) * (1 - u))).
  { apply Rmult_le_compat_l; [nra|]. rewrite u_value. lra. }
  assert (e * e <= e * (d * (1 - 2 * u))) by (apply Rmult_le_compat_l; lra). nra.
Qed.

Theorem growth_of_point_is_enough (limit spin_growth spin x y z : double) :
  finite (growth_of_point limit spin_growth spin x y z) -> 0 <= B limit -> 0 <= B spin_growth ->
  let d := norm (Vector (B x) (B y) (B z)) in let turning := B spin_growth + B spin * B spin in
  B limit + turning * d <= B (growth_of_point limit spin_growth spin x y z) * (1 + 2 * u) +
    bpow radix2 (-534) * (1 + turning + d).
Proof.
  unfold growth_of_point. cbv zeta. intros F PA Pa. set (d := norm _). set (turning := B spin_growth + B spin * B spin).
  assert (0 <= d) as Pd by apply norm_positive. assert (0 <= B spin * B spin) as Pw by apply Rle_0_sqr.
  destruct (add_finite _ _ F) as (_ & FX & _). destruct (mul_finite _ _ FX) as (FK & Ff & _). generalize (factor _ eq_refl Ff).
  set (f := (literal 1 0 + literal 1 (-47))%float) in *. intros Ef.
  destruct (mul_finite _ _ FK) as (Fk & FR & _). destruct (mul_finite _ _ FR) as (Fn & _ & _).
  destruct (root_finite _ Fn) as (Fs & _ & En).
  set (k := (spin_growth + spin * spin)%float) in *. set (S := (x * x + y * y + z * z)%float) in *.
  generalize u_pos lost_pos tiny_pos lost_at_most_tiny. intros Pu Pl Pt Lt.
  (* a + w^2 *)
  assert (0 <= B k /\ turning * (1 - 2 * u) - lost <= B k) as [Pk Lk].
  { destruct (add_finite _ _ Fk) as (_ & Fq & _). destruct (product_from_below spin spin Fq Pw) as (_ & _ & Pq & Lq).
    destruct (sum_from_below _ _ Fk) as (_ & _ & P & L); [lra|]. fold k in P, L. split; [exact P|]. apply Rle_trans with (2 := L). unfold turning.
    rewrite u_value in *. lra. }
  (* d *)
  assert (0 <= B S /\ d * d * ((1 - u) * (1 - u) * (1 - u)) - 3 * lost <= B S) as [PS LS].
  { destruct (add_finite _ _ Fs) as (F2 & Fz & _). destruct (add_finite _ _ F2) as (Fx & Fy & _).
    destruct (product_from_below x x Fx (Rle_0_sqr _)) as (_ & _ & Px & Lx).
    destruct (product_from_below y y Fy (Rle_0_sqr _)) as (_ & _ & Py & Ly).
    destruct (product_from_below z z Fz (Rle_0_sqr _)) as (_ & _ & Pz & Lz).
    destruct (sum_from_below _ _ F2) as (_ & _ & P2 & L2); [lra|]. destruct (sum_from_below _ _ Fs) as (_ & _ & P & L); [lra|]. fold S in P, L.
    split; [exact P|]. apply Rle_trans with (2 := L). unfold d. rewrite norm_square. unfold dot. cbn [x_of y_of z_of].
    generalize (Rle_0_sqr (B x)) (Rle_0_sqr (B y)) (Rle_0_sqr (B z)). unfold Rsqr in *.
    revert Px Lx Py Ly Pz Lz P2 L2 L. rewrite u_value. clear - Pl. intros. lra. }
  set (n := root S) in *.
  assert (0 <= B n /\ d * (1 - 3 * u) - 2 * tiny <= B n) as [Pn Ln].
  { rewrite En. split; [apply rnd_nonneg, sqrt_pos|]. generalize (rnd_lower (sqrt (B S)) (sqrt_pos _)) (root_of_squares d (B S) Pd PS LS).
    revert Lt. rewrite u_value. intros. lra. }
  assert (0 <= 1 + 64 * u) as Pf by (rewrite u_value; lra).
  assert (0 <= B (n * f)%float /\ d * (1 + 50 * u) - 3 * tiny <= B (n * f)%float) as [PR LR].
  { destruct (product_from_below n f FR) as (_ & _ & P & L); [rewrite Ef; apply Rmult_le_pos; assumption|]. split; [exact P|].
    rewrite Ef in L. apply Rle_trans with (2 := L). revert Ln Lt. rewrite u_value. clear - Pd Pt. intros. lra. }
  set (reach := (n * f)%float) in *.
  assert (turning * d * (1 + 40 * u) - 3 * tiny * turning - 2 * lost * d <= B k * B reach) as LK.
  { assert (0 <= turning) as PT by (unfold turning; lra). assert (0 <= B k * B reach) as PKR by (apply Rmult_le_pos; assumption).
    assert (0 <= turning * d) as PTd by (apply Rmult_le_pos; assumption).
    destruct (Rle_or_lt 0 (turning * (1 - 2 * u) - lost)) as [L1|L1].
    - destruct (Rle_or_lt 0 (d * (1 + 50 * u) - 3 * tiny)) as [L2|L2].
      + apply Rle_trans with ((turning * (1 - 2 * u) - lost) * (d * (1 + 50 * u) - 3 * tiny)); [|apply Rmult_le_compat; assumption].
        assert (0 <= lost * tiny) by (apply Rmult_le_pos; lra). assert (0 <= tiny * turning) by (apply Rmult_le_pos; lra).
        assert (0 <= lost * d) by (apply Rmult_le_pos; lra). rewrite u_value in *. lra.
      + assert (turning * (d * (1 + 50 * u)) <= turning * (3 * tiny)) by (apply Rmult_le_compat_l; lra).
        assert (0 <= lost * d) by (apply Rmult_le_pos; lra). rewrite u_value in *. lra.
    - assert (turning * (1 - 2 * u) * d <= lost * d) by (apply Rmult_le_compat_r; lra).
      assert (0 <= tiny * turning) by (apply Rmult_le_pos; lra). rewrite u_value in *. lra. }
  destruct (product_from_below k reach FK) as (_ & _ & PKp & LKp); [apply Rmult_le_pos; assumption|].
  destruct (product_from_below (k * reach)%float f FX) as (_ & _ & PX & LX); [rewrite Ef; apply Rmult_le_pos; assumption|].
  rewrite Ef in LX.
  destruct (sum_from_below _ _ F) as (_ & _ & _ & L); [lra|].
  assert (bpow radix2 (-534) = 4 * tiny) as E4 by (change 4 with (bpow radix2 2); rewrite <- bpow_plus; reflexivity).
  rewrite E4. set (X := B (k * reach * f)%float) in *.
  assert (turning * d - 3 * tiny * turning - 2 * lost * d - 3 * lost <= X) as HX.
  { assert (0 <= B k * B reach) by (apply Rmult_le_pos; assumption).
    assert (0 <= turning * d) by (apply Rmult_le_pos; [unfold turning; lra|assumption]). rewrite u_value in *. lra. }
  assert (lost * d <= tiny * d) by (apply Rmult_le_compat_r; [assumption|]; rewrite u_value in Lt; lra).
  assert (0 <= tiny * turning) by (apply Rmult_le_pos; [lra|unfold turning; lra]).
  assert (0 <= tiny * d) by (apply Rmult_le_pos; lra).
  revert L. set (res := B (limit + k * reach * f)%float). intros L. rewrite u_value in *. lra.
Qed.
