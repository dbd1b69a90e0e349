(* The time at which two swept spheres are nearest, as it is computed, and what the test then says. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels errors direction fitting swept_spheres.
Open Scope R_scope.

Lemma p48 : bpow radix2 (-48) = / 281474976710656. Proof. reflexivity. Qed.
Lemma p18 : bpow radix2 (-18) = / 262144. Proof. reflexivity. Qed.
Lemma p60 : bpow radix2 60 = 1152921504606846976. Proof. reflexivity. Qed.
Lemma p120 : bpow radix2 120 = 1329227995784915872903807060280344576. Proof. reflexivity. Qed.
Lemma p127 : bpow radix2 127 = 170141183460469231731687303715884105728. Proof. reflexivity. Qed.
Lemma p128 : bpow radix2 128 = 340282366920938463463374607431768211456. Proof. reflexivity. Qed.

Lemma difference_of_stored (x y : single) (X Y : R) : stored x X -> stored y Y ->
  Rabs X <= bpow radix2 121 -> Rabs Y <= bpow radix2 121 ->
  finite (x - y)%float /\ Rabs (B (x - y)%float - (X - Y)) <= 201 / 100 * u * (Rabs X + Rabs Y + 2 * low).
Proof.
  intros Sx Sy LX LY.
  assert (finite (x - y)%float) as F.
  { apply sub_fits; [exact (stored_finite _ _ Sx)|exact (stored_finite _ _ Sy)|]. apply fits_small.
    destruct Sx as [_ Ex], Sy as [_ Ey].
    replace (B x - B y) with ((B x - X) + X - ((B y - Y) + Y)) by ring.
    assert (Rabs ((B x - X) + X - ((B y - Y) + Y)) <= Rabs (B x - X) + Rabs X + (Rabs (B y - Y) + Rabs Y)) as T.
    { unfold Rminus at 1. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp.
      apply Rplus_le_compat; apply Rabs_triang. }
    change (bpow radix2 121) with 2658455991569831745807614120560689152 in LX, LY. rewrite most_value.
    rewrite u_value, low_value in *. lra. }
  split; [exact F|].
  assert (close (x - y)%float (X - Y) (Rabs X + low + (Rabs Y + low)) 201) as C.
  { generalize (stored_close _ _ Sx) (stored_close _ _ Sy). intros Cx Cy.
    eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths]. }
  destruct (C F) as [E _]. eapply Rle_trans; [exact E|]. right. field.
Qed.

(* The time that is nearest, in floats, and the exact one. *)
Section Nearest.

Variables dx dy dz ux uy uz : single.
Hypothesis dx_finite : finite dx. Hypothesis dy_finite : finite dy. Hypothesis dz_finite : finite dz.
Hypothesis ux_finite : finite ux. Hypothesis uy_finite : finite uy. Hypothesis uz_finite : finite uz.

Definition DD : R := norm (B dx) (B dy) (B dz).
Definition UU : R := norm (B ux) (B uy) (B uz).
Hypothesis DD_small : DD <= bpow radix2 65.
Hypothesis UU_small : UU <= bpow radix2 61 * (11 / 10).

Definition approach_r : R := B dx * B ux + B dy * B uy + B dz * B uz.
Definition weight : R := UU * UU + B small.
Definition root_weight : R := sqrt weight.

Lemma root_weight_square : root_weight * root_weight = weight /\ UU <= root_weight /\
  / 1125899906842624 <= root_weight <= bpow radix2 62.
Proof.
  assert (0 <= UU) as PU by apply sqrt_pos.
  assert (weight = UU * UU + / 1267650600228229401496703205376) as Ew
    by (unfold weight; rewrite (proj2 small_value); reflexivity).
  assert (0 <= UU * UU) as PUU by (apply Rmult_le_pos; exact PU).
  assert (root_weight * root_weight = weight) as E by (apply sqrt_sqrt; lra).
  assert (0 <= root_weight) as P by apply sqrt_pos.
  split; [exact E|]. split; [|split].
  - apply Rnot_lt_le. intros L. assert (root_weight * root_weight <= UU * UU) by (apply Rmult_le_compat; lra). lra.
  - apply Rnot_lt_le. intros L.
    assert (root_weight * root_weight < / 1125899906842624 * / 1125899906842624) by (apply Rmult_le_0_lt_compat; lra). lra.
  - change (bpow radix2 61) with 2305843009213693952 in UU_small. change (bpow radix2 62) with 4611686018427387904.
    apply Rnot_lt_le. intros L.
    assert (4611686018427387904 * 4611686018427387904 < root_weight * root_weight) by (apply Rmult_le_0_lt_compat; lra).
    assert (UU * UU <= 2305843009213693952 * (11 / 10) * (2305843009213693952 * (11 / 10))) by (apply Rmult_le_compat; lra).
    lra.
Qed.

Lemma products_small : Rabs (B dx * B ux) + Rabs (B dy * B uy) + Rabs (B dz * B uz) <= DD * UU /\ 0 <= DD * UU <= 11 / 10 * bpow radix2 126.
Proof.
  assert (0 <= UU) as PU by apply sqrt_pos. assert (0 <= DD) as PD by apply sqrt_pos.
  split; [apply norm_product|]. split; [apply Rmult_le_pos; assumption|].
  apply Rle_trans with (bpow radix2 65 * (bpow radix2 61 * (11 / 10))); [apply Rmult_le_compat; assumption|].
  rewrite <- Rmult_assoc, <- bpow_plus. change (65 + 61)%Z with 126%Z. generalize (bpow_gt_0 radix2 126). lra.
Qed.


Lemma mul_ok (x y : single) (b : R) : finite x -> finite y -> Rabs (B x * B y) <= b -> b <= most ->
  finite (x * y)%float /\ Rabs (B (x * y)%float) <= b * (1 + u) + u * low.
Proof.
  intros Fx Fy L Lb.
  assert (finite (x * y)%float) as F by (apply mul_fits; try assumption; apply fits_small; lra).
  split; [exact F|]. destruct (mul_finite _ _ F) as (_ & _ & ->).
  generalize (rounded_error (prec := 24) (emax := 128) (B x * B y)). intros E.
  replace (rnd32 (B x * B y)) with ((rnd32 (B x * B y) - B x * B y) + B x * B y) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite u_value in *. lra.
Qed.

Lemma add_ok (x y : single) (b : R) : finite x -> finite y -> Rabs (B x) + Rabs (B y) <= b -> b <= most ->
  finite (x + y)%float /\ Rabs (B (x + y)%float) <= b * (1 + u) + u * low.
Proof.
  intros Fx Fy L Lb. assert (T := Rabs_triang (B x) (B y)).
  assert (finite (x + y)%float) as F by (apply add_fits; try assumption; apply fits_small; lra).
  split; [exact F|]. destruct (add_finite _ _ F) as (_ & _ & ->).
  generalize (rounded_error (prec := 24) (emax := 128) (B x + B y)). intros E.
  replace (rnd32 (B x + B y)) with ((rnd32 (B x + B y) - (B x + B y)) + (B x + B y)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite u_value in *. lra.
Qed.

(* A sum of three products. *)
Lemma three_products (x y z x' y' z' : single) (b : R) :
  finite x -> finite y -> finite z -> finite x' -> finite y' -> finite z' ->
  Rabs (B x * B x') + Rabs (B y * B y') + Rabs (B z * B z') <= b -> b <= most * (1 - 6 * u) ->
  finite (x * x' + y * y' + z * z')%float /\
  Rabs (B (x * x' + y * y' + z * z')%float - (B x * B x' + B y * B y' + B z * B z')) <= 303 / 100 * u * (b + 3 * low).
Proof.
  intros Fx Fy Fz Fx' Fy' Fz' L Lb.
  assert (Mv := most_value).
  generalize (Rabs_pos (B x * B x')) (Rabs_pos (B y * B y')) (Rabs_pos (B z * B z')). intros P1 P2 P3.
  rewrite Mv, u_value in Lb.
  destruct (mul_ok x x' _ Fx Fx' (Rle_refl _) ltac:(lra)) as [F1 L1].
  destruct (mul_ok y y' _ Fy Fy' (Rle_refl _) ltac:(lra)) as [F2 L2].
  destruct (mul_ok z z' _ Fz Fz' (Rle_refl _) ltac:(lra)) as [F3 L3].
  rewrite u_value, low_value in L1, L2, L3.
  destruct (add_ok _ _ _ F1 F2 (Rle_refl _) ltac:(lra)) as [F4 L5].
  rewrite u_value, low_value in L5.
  destruct (add_ok _ _ _ F4 F3 (Rle_refl _) ltac:(lra)) as [F5 _].
  split; [exact F5|].
  assert (close (x * x' + y * y' + z * z')%float (B x * B x' + B y * B y' + B z * B z')
    (Rabs (B x) * Rabs (B x') + low + (Rabs (B y) * Rabs (B y') + low) + (Rabs (B z) * Rabs (B z') + low)) 303) as C
    by (eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths]).
  destruct (C F5) as [E _]. rewrite <- !Rabs_mult in E. eapply Rle_trans; [exact E|].
  rewrite u_value, low_value in *. lra.
Qed.

Lemma speed_of_floats :
  let m := (ux * ux + uy * uy + uz * uz + small)%float in
  finite m /\ Rabs (B m - weight) <= 41 / 10 * u * weight.
Proof.
  intros m. assert (0 <= UU) as PU by apply sqrt_pos.
  assert (UU * UU = B ux * B ux + B uy * B uy + B uz * B uz) as EU.
  { apply (proj1 (norm_square (B ux) (B uy) (B uz))). }
  assert (UU * UU <= 2305843009213693952 * (11 / 10) * (2305843009213693952 * (11 / 10))) as LU.
  { change (bpow radix2 61) with 2305843009213693952 in UU_small. apply Rmult_le_compat; lra. }
  assert (forall x, 0 <= B x * B x) as Sq by (intros x; nra).
  destruct (three_products ux uy uz ux uy uz (UU * UU)) as [F E]; try assumption.
  { rewrite !Rabs_pos_eq by apply Sq. lra. }
  { rewrite most_value, u_value. lra. }
  rewrite <- EU in E. set (f := (ux * ux + uy * uy + uz * uz)%float) in *.
  assert (0 <= UU * UU) as PUU by (apply Rmult_le_pos; exact PU).
  assert (weight = UU * UU + / 1267650600228229401496703205376) as Ew
    by (unfold weight; rewrite (proj2 small_value); reflexivity).
  apply Rabs_le_inv in E.
  destruct small_value as [Fs Vs].
  destruct (add_ok f small (11 / 10 * weight) F Fs) as [Fm _].
  { rewrite Vs, Ew, (Rabs_pos_eq (/ _)) by lra.
    assert (Rabs (B f) <= UU * UU + 303 / 100 * u * (UU * UU + 3 * low)) by (apply Rabs_le; rewrite u_value, low_value in *; lra).
    rewrite u_value, low_value in *. lra. }
  { rewrite most_value. lra. }
  split; [exact Fm|]. destruct (add_finite _ _ Fm) as (_ & _ & Em). unfold m. rewrite Em.
  generalize (rounded_sum (prec := 24) (emax := 128) f small). rewrite Vs. intros E2.
  assert (0 <= B f + / 1267650600228229401496703205376) as Pf by (rewrite u_value, low_value in *; lra).
  rewrite (Rabs_pos_eq _ Pf) in E2. apply Rabs_le_inv in E2. apply Rabs_le.
  rewrite u_value, low_value in *. lra.
Qed.

Lemma nearest_of_floats :
  let t := ((- (dx * ux + dy * uy + dz * uz)) / (ux * ux + uy * uy + uz * uz + small))%float in
  finite t /\ Rabs (B t - - (approach_r / weight)) * root_weight <= 9 * u * DD + / 1208925819614629174706176.
Proof.
  intros t.
  destruct speed_of_floats as [Fm Em]. cbv zeta in Fm, Em. set (m := (ux * ux + uy * uy + uz * uz + small)%float) in *.
  destruct products_small as [PS [PD0 PD]].
  destruct (three_products dx dy dz ux uy uz (DD * UU)) as [Fa Ea]; try assumption.
  { rewrite most_value, u_value. change (bpow radix2 126) with 85070591730234615865843651857942052864 in PD. lra. }
  set (a := (dx * ux + dy * uy + dz * uz)%float) in *. fold approach_r in Ea.
  destruct root_weight_square as (EW & UW & LW & HW).
  set (W := root_weight) in *. set (w := weight) in *.
  assert (0 <= UU) as PU by apply sqrt_pos. assert (0 <= DD) as PD1 by apply sqrt_pos.
  assert (DD * UU <= DD * W) as DW by (apply Rmult_le_compat_l; assumption).
  assert (Rabs approach_r <= DD * UU) as LA.
  { unfold approach_r. eapply Rle_trans; [apply Rabs_triang|]. eapply Rle_trans; [|exact PS].
    apply Rplus_le_compat_r. apply Rabs_triang. }
  assert (0 < w) as Pw by (rewrite <- EW; apply Rmult_lt_0_compat; lra).
  apply Rabs_le_inv in Em.
  assert (w * (999 / 1000) <= B m) as Lm by (rewrite u_value in *; lra).
  set (Q := - B a / B m).
  assert (Rabs (Q - - (approach_r / w)) * B m <= 303 / 100 * u * (DD * UU + 3 * low) + 41 / 10 * u * (DD * UU)) as X1.
  { rewrite <- (Rabs_pos_eq (B m)) by lra. rewrite <- Rabs_mult.
    replace ((Q - - (approach_r / w)) * B m) with (- (B a - approach_r) + approach_r / w * (B m - w))
      by (unfold Q; field; split; lra).
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. apply Rplus_le_compat; [exact Ea|].
    unfold Rdiv. rewrite Rmult_assoc, Rabs_mult.
    assert (Rabs (/ w * (B m - w)) <= 41 / 10 * u) as X2.
    { rewrite Rabs_mult, (Rabs_pos_eq (/ w)) by (apply Rlt_le, Rinv_0_lt_compat; exact Pw).
      apply Rmult_le_reg_l with w; [exact Pw|]. rewrite <- Rmult_assoc, Rinv_r, Rmult_1_l by lra.
      apply Rabs_le. lra. }
    rewrite (Rmult_comm (41 / 10 * u)). apply Rmult_le_compat; auto using Rabs_pos. }
  assert (Rabs (Q - - (approach_r / w)) * W <= 72 / 10 * u * DD + 10 * u * low * 1125899906842624) as X3.
  { apply Rmult_le_reg_r with W; [lra|]. rewrite Rmult_assoc, EW.
    assert (Rabs (Q - - (approach_r / w)) * (w * (999 / 1000)) <= Rabs (Q - - (approach_r / w)) * B m)
      by (apply Rmult_le_compat_l; [apply Rabs_pos|exact Lm]).
    assert (10 * u * low * 1 <= 10 * u * low * (1125899906842624 * W)) as X4.
    { apply Rmult_le_compat_l; [rewrite u_value, low_value; lra|]. lra. }
    rewrite u_value, low_value in *. lra. }
  assert (Rabs (approach_r / w) * W <= DD) as X5.
  { apply Rmult_le_reg_r with W; [lra|]. rewrite Rmult_assoc, EW. unfold Rdiv.
    rewrite Rabs_mult, (Rabs_pos_eq (/ w)) by (apply Rlt_le, Rinv_0_lt_compat; exact Pw).
    rewrite Rmult_assoc, Rinv_l by lra. lra. }
  assert (Rabs Q * W <= DD * (11 / 10) + 10 * u * low * 1125899906842624) as X6.
  { replace Q with ((Q - - (approach_r / w)) + - (approach_r / w)) by ring.
    apply Rle_trans with ((Rabs (Q - - (approach_r / w)) + Rabs (approach_r / w)) * W).
    - apply Rmult_le_compat_r; [lra|]. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra.
    - rewrite u_value, low_value in *. lra. }
  assert (Rabs Q <= most) as X7.
  { apply Rmult_le_reg_r with W; [lra|]. rewrite most_value. change (bpow radix2 65) with 36893488147419103232 in DD_small.
    rewrite u_value, low_value in X6. lra. }
  destruct (div_fits (neg a) m) as [Ft Et].
  - apply neg_finite. exact Fa.
  - lra.
  - rewrite neg_value. apply fits_small. exact X7.
  - split; [exact Ft|]. unfold t. rewrite Et, neg_value. fold Q.
    generalize (rounded_error (prec := 24) (emax := 128) Q). intros E.
    replace (rnd32 Q - - (approach_r / w)) with ((rnd32 Q - Q) + (Q - - (approach_r / w))) by ring.
    apply Rle_trans with ((Rabs (rnd32 Q - Q) + Rabs (Q - - (approach_r / w))) * W).
    + apply Rmult_le_compat_r; [lra|]. apply Rabs_triang.
    + assert (Rabs (rnd32 Q - Q) * W <= u * (Rabs Q + low) * W) by (apply Rmult_le_compat_r; lra).
      assert (low * W <= low * 4611686018427387904) as X8.
      { apply Rmult_le_compat_l; [rewrite low_value; lra|]. change 4611686018427387904 with (bpow radix2 62). exact HW. }
      replace (u * (Rabs Q + low) * W) with (u * (Rabs Q * W) + u * (low * W)) in H by ring.
      rewrite u_value, low_value in *. lra.
Qed.

(* The distance at the time that is chosen, and at one at which another is nearest. *)
Lemma chosen_distance (c s delta eta : R) :
  let s1 := - (approach_r / weight) in
  (c - s1) * (c - s1) <= (s - s1) * (s - s1) + delta * delta -> 0 <= delta -> delta * root_weight <= eta -> s * s <= 5 ->
  norm (B dx + B ux * c) (B dy + B uy * c) (B dz + B uz * c)
    <= norm (B dx + B ux * s) (B dy + B uy * s) (B dz + B uz * s) + eta + / 281474976710656.
Proof.
  intros s1 Hc Pd He Hs.
  destruct root_weight_square as (EW & _ & LW & _).
  assert (0 < weight) as Pw by (rewrite <- EW; apply Rmult_lt_0_compat; lra).
  assert (weight * s1 = - approach_r) as E1 by (unfold s1; field; lra).
  destruct (norm_square (B ux) (B uy) (B uz)) as [EU _]. fold UU in EU.
  destruct (norm_square (B dx + B ux * c) (B dy + B uy * c) (B dz + B uz * c)) as [Ec Pc].
  destruct (norm_square (B dx + B ux * s) (B dy + B uy * s) (B dz + B uz * s)) as [Es Ps].
  set (Nc := norm (B dx + B ux * c) (B dy + B uy * c) (B dz + B uz * c)) in *.
  set (Ns := norm (B dx + B ux * s) (B dy + B uy * s) (B dz + B uz * s)) in *.
  assert (Ew : weight = UU * UU + / 1267650600228229401496703205376)
    by (unfold weight; rewrite (proj2 small_value); reflexivity).
  set (l := / 1267650600228229401496703205376) in *. assert (0 < l) as Pl by (unfold l; lra).
  assert (Nc * Nc = Ns * Ns + l * (s * s - c * c) + weight * ((c - s1) * (c - s1) - (s - s1) * (s - s1))) as Q.
  { assert (forall t, (B dx + B ux * t) * (B dx + B ux * t) + (B dy + B uy * t) * (B dy + B uy * t) + (B dz + B uz * t) * (B dz + B uz * t)
      = B dx * B dx + B dy * B dy + B dz * B dz + 2 * approach_r * t + (weight - l) * (t * t)) as P.
    { intros t. replace (weight - l) with (UU * UU) by lra. rewrite EU. unfold approach_r. ring. }
    rewrite Ec, Es, !P. replace approach_r with (- (weight * s1)) by lra. ring. }
  assert (weight * ((c - s1) * (c - s1) - (s - s1) * (s - s1)) <= weight * (delta * delta)) as Q1
    by (apply Rmult_le_compat_l; lra).
  assert (0 <= delta * root_weight) as P0 by (apply Rmult_le_pos; lra).
  assert (weight * (delta * delta) <= eta * eta) as Q2.
  { rewrite <- EW. replace (root_weight * root_weight * (delta * delta)) with (delta * root_weight * (delta * root_weight)) by ring.
    apply Rmult_le_compat; assumption. }
  assert (0 <= c * c) as Pcc by nra.
  assert (l * (s * s - c * c) <= l * 5) as Q3 by (apply Rmult_le_compat_l; lra).
  assert (l * 5 <= / 281474976710656 * / 281474976710656) as Q4 by (unfold l; lra).
  set (h := / 281474976710656) in *. assert (0 < h) as Ph by (unfold h; lra).
  assert (0 <= eta) as Pe by lra. clearbody h l Nc Ns.
  apply Rnot_lt_le. intros L.
  assert ((Ns + eta + h) * (Ns + eta + h) < Nc * Nc) by (apply Rmult_le_0_lt_compat; lra).
  assert (0 <= Ns * eta /\ 0 <= Ns * h /\ 0 <= eta * h) by (repeat split; apply Rmult_le_pos; lra).
  lra.
Qed.

End Nearest.

(* A difference that is clearly shorter than the radii is not left out. *)
Lemma not_left_out (x y z r : single) : finite x -> finite y -> finite z -> finite (r * r + small)%float ->
  / 281474976710656 <= B r -> norm (B x) (B y) (B z) * (1 + 8 * u) <= B r ->
  less (r * r + small)%float (x * x + y * y + z * z)%float = false.
Proof.
  intros Fx Fy Fz Fl Lr Ln.
  destruct (norm_square (B x) (B y) (B z)) as [EN PN]. set (N := norm (B x) (B y) (B z)) in *.
  destruct (add_finite _ _ Fl) as (Fr & _ & El). destruct (mul_finite _ _ Fr) as (_ & _ & Er).
  assert (Lq : Rabs (B (r * r)%float) < bpow radix2 128) by apply abs_B2R_lt_emax.
  rewrite p128 in Lq.
  generalize (rounded_error (prec := 24) (emax := 128) (B r * B r)). rewrite <- Er.
  assert (/ 281474976710656 * / 281474976710656 <= B r * B r) as L2 by (apply Rmult_le_compat; lra).
  rewrite (Rabs_pos_eq (B r * B r)) by lra. intros E.
  assert (N * (1 + 8 * u) * (N * (1 + 8 * u)) <= B r * B r) as LN2 by (apply Rmult_le_compat; rewrite ?u_value in *; lra).
  assert (0 <= N * N) as PNN by (apply Rmult_le_pos; exact PN).
  assert (N * N * (1 + 15 * u) <= B r * B r) as LN3 by (rewrite u_value in *; lra).
  clear LN2. apply Rabs_le_inv in Lq || apply Rabs_def2 in Lq. apply Rabs_le_inv in E.
  assert (forall t, 0 <= B t * B t) as Sq by (intros t; nra).
  destruct (three_products x y z x y z (N * N)) as [Fs Es]; try assumption.
  { rewrite !Rabs_pos_eq by apply Sq. lra. }
  { rewrite most_value. rewrite u_value, low_value in *. lra. }
  rewrite <- EN in Es. apply Rabs_le_inv in Es.
  unfold less. rewrite Bltb_correct by assumption. apply Rlt_bool_false.
  apply Rle_trans with (B (r * r)%float).
  - rewrite u_value, low_value in *. lra.
  - rewrite El. rewrite <- (rnd_value (r * r)%float) at 1. apply rnd_le. rewrite (proj2 small_value). lra.
Qed.
