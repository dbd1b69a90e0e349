(* rounding::first_crossing is never late, for any doubles whatever. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core Relative Plus_error BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic.
Open Scope R_scope.

(* Powers of two as numbers, so that lra can compare them. *)
Definition least_normal : R := bpow radix2 (-1022).

Lemma lost_least_normal : lost * 4503599627370496 <= least_normal * / 2 /\ 0 < least_normal.
Proof.
  split; [|apply bpow_gt_0]. unfold lost, least_normal.
  replace (bpow radix2 (-1022)) with (bpow radix2 (-1075) * bpow radix2 53)
    by (rewrite <- bpow_plus; reflexivity).
  simpl (bpow radix2 53). generalize (bpow_gt_0 radix2 (-1075)). lra.
Qed.

(* The last lines of the kernel: a root, shortened. *)
Lemma shortened (t : double) :
  finite (t - t * literal 1 (-47))%float -> bpow radix2 (-975) < B (t - t * literal 1 (-47))%float ->
  finite t /\ bpow radix2 (-975) < B t /\ B (t - t * literal 1 (-47))%float <= B t * (1 - 62 * u).
Proof.
  intros F L. apply sub_finite in F. destruct F as (Ft & Fm & E).
  rewrite E in *. apply mul_finite in Fm. destruct Fm as (_ & _ & Em). rewrite Em in *.
  destruct (literal_power (-47)) as [_ V]; [lia|]. rewrite V in *.
  assert (bpow radix2 (-975) < B t - rnd64 (B t * bpow radix2 (-47))) as L'.
  { apply rnd_gt_bpow in L; [exact L|lia]. }
  assert (0 < B t) as P.
  { apply Rnot_le_lt. intros N.
    assert (rnd64 (B t) <= rnd64 (B t * bpow radix2 (-47))) as W.
    { apply rnd_le. simpl. lra. }
    rewrite rnd_value in W. generalize (bpow_gt_0 radix2 (-975)). lra. }
  assert (0 <= rnd64 (B t * bpow radix2 (-47))) as P'.
  { apply rnd_nonneg. generalize (bpow_gt_0 radix2 (-47)). nra. }
  assert (bpow radix2 (-975) < B t) as Lt by lra.
  split; [exact Ft|]. split; [exact Lt|].
  assert (rnd64 (B t * bpow radix2 (-47)) = B t * bpow radix2 (-47)) as X.
  { apply rnd_scaled. rewrite Rabs_pos_eq by (generalize (bpow_gt_0 radix2 (-47)); nra).
    replace (bpow radix2 (-1022)) with (bpow radix2 (-975) * bpow radix2 (-47)) by (rewrite <- bpow_plus; reflexivity).
    apply Rmult_le_compat_r; [apply bpow_ge_0|lra]. }
  rewrite X in *.
  assert (bpow radix2 (-47) = 64 * u) as K by (rewrite u_value; simpl; lra).
  rewrite K in *.
  assert (B t - B t * (64 * u) = B t * (1 - 64 * u)) as Q by ring.
  rewrite Q in *.
  assert (0 <= B t * (1 - 64 * u)) as NN by (rewrite u_value; lra).
  generalize (rnd_relative (B t * (1 - 64 * u))). rewrite (Rabs_pos_eq _ NN). intros R.
  assert (bpow radix2 (-1022) <= B t * (1 - 64 * u)) as G.
  { apply Rlt_le, Rle_lt_trans with (2 := L'). apply bpow_le. lia. }
  apply R in G. apply Rabs_le_inv in G. rewrite u_value in *. lra.
Qed.

Lemma least_double (x : double) : 0 < B x -> bpow radix2 (-1074) <= B x.
Proof.
  intros H. generalize (abs_B2R_ge_emin 53 1024 x). rewrite Rabs_pos_eq by lra. intros G. apply G.
  destruct x; simpl in *; auto; lra.
Qed.

(* A square root of a double is far from the least numbers. *)
Lemma rnd_root (x : double) : 0 <= B x -> Rabs (rnd64 (sqrt (B x)) - sqrt (B x)) <= u * sqrt (B x).
Proof.
  intros [P|Z].
  2: { rewrite <- Z, sqrt_0, rnd_0. rewrite Rminus_0_r, Rabs_R0. lra. }
  rewrite <- (Rabs_pos_eq (sqrt (B x))) at 3 by apply sqrt_pos.
  apply rnd_relative. rewrite Rabs_pos_eq by apply sqrt_pos.
  apply Rle_trans with (bpow radix2 (-537)); [apply bpow_le; lia|].
  rewrite <- (sqrt_square (bpow radix2 (-537))) by apply bpow_ge_0.
  apply sqrt_le_1_alt. rewrite <- bpow_plus. apply least_double. exact P.
Qed.

Lemma doubled (a : double) : finite (literal 2 0 * a)%float -> B (literal 2 0 * a)%float = 2 * B a.
Proof.
  intros F. apply mul_finite in F. destruct F as (_ & _ & E). rewrite E.
  rewrite (proj2 literal_2). rewrite Rmult_comm. change 2 with (bpow radix2 1).
  apply rnd_scaled_up. lia.
Qed.

(* Claim about the answer: it is early, or there is no root. *)
Definition early (c b a r : double) : Prop :=
  finite c /\ finite b /\ finite a /\ bpow radix2 (-975) < B c /\
  ((r = infinity /\ forall d, 0 <= d -> 0 < quadratic (B c) (B b) (B a) d) \/
   (finite r /\ 0 < B r /\ forall d, 0 <= d < B r -> 0 < quadratic (B c) (B b) (B a) d)).

(* b >= 0 > a *)
Lemma up_is_early (c b a t4 : double) (s : double) :
  let P := - (2 * B a * B c) in
  let D := B b * B b + P in
  0 < B c -> 0 <= B b -> B a < 0 ->
  0 <= B s <= sqrt D * (1 + 4 * u) ->
  let t6 := ((b + s) / - a)%float in
  let t7 := (t6 - t6 * literal 1 (-47))%float in
  finite t7 -> bpow radix2 (-975) < B t7 ->
  forall d, 0 <= d < B t7 -> 0 < quadratic (B c) (B b) (B a) d.
Proof.
  intros P D Hc Hb Ha [Hs Us] t6 t7 F7 L7 d [Hd Ld].
  destruct (shortened t6 F7 L7) as (F6 & L6 & E7). fold t7 in E7.
  assert (B t6 <> 0) as N6 by (generalize (bpow_gt_0 radix2 (-975)); lra).
  destruct (div_finite _ _ F6 N6) as (Fn & _ & _ & E6). fold t6 in E6.
  rewrite neg_value in E6.
  apply add_finite in Fn. destruct Fn as (_ & _ & En).
  assert (0 < P) as HP by (unfold P; nra).
  assert (0 < D) as HD by (unfold D; nra).
  assert (0 <= sqrt D) as HS by apply sqrt_pos.
  assert (sqrt D * sqrt D = D) as SS by (apply sqrt_sqrt; lra).
  generalize (rnd_sum b s). rewrite <- En.
  rewrite (Rabs_pos_eq (B b + B s)) by lra. intros Rn. apply Rabs_le_inv in Rn.
  set (n := B (b + s)%float) in *.
  assert (n <= (B b + sqrt D) * (1 + 6 * u)) as Un by (rewrite u_value in *; lra).
  assert (0 < / - B a) as Hi by (apply Rinv_0_lt_compat; lra).
  assert (B t6 <= n / - B a * (1 + u)) as U6.
  { generalize (rnd_relative (n / - B a)). rewrite <- E6. intros G.
    assert (bpow radix2 (-975) < n / - B a) as W by (apply rnd_gt_bpow; [lia|rewrite <- E6; exact L6]).
    generalize (bpow_gt_0 radix2 (-975)). intros.
    rewrite (Rabs_pos_eq (n / - B a)) in G by lra.
    assert (Rabs (B t6 - n / - B a) <= u * (n / - B a)) as G'.
    { apply G. apply Rlt_le, Rlt_trans with (2 := W). apply bpow_lt. lia. }
    apply Rabs_le_inv in G'. lra. }
  assert (n / - B a <= (B b + sqrt D) / - B a * (1 + 6 * u)) as Uq.
  { unfold Rdiv. apply (Rmult_le_compat_r (/ - B a)) in Un; [|lra]. lra. }
  set (x := (B b + sqrt D) / - B a) in *.
  assert (0 < x) as Hx by (unfold x, Rdiv; apply Rmult_lt_0_compat; [nra|lra]).
  assert (B t7 <= x) as U7.
  { rewrite u_value in *. lra. }
  apply (quadratic_before_root _ _ _ _ (sqrt D) Hc HS SS Hd).
  assert (B b < sqrt D) as BS.
  { apply Rnot_le_lt. intros L. assert (sqrt D * sqrt D <= B b * B b) by (apply Rmult_le_compat; lra).
    assert (D = B b * B b + P) by reflexivity. lra. }
  apply Rlt_le_trans with (x * (sqrt D - B b)).
  + apply Rmult_lt_compat_r; lra.
  + right. assert (x * (sqrt D - B b) = (sqrt D * sqrt D - B b * B b) * / - B a) as -> by (unfold x; field; lra).
    assert (sqrt D * sqrt D - B b * B b = P) as -> by (rewrite SS; unfold D; ring).
    unfold P. field. lra.
Qed.

(* b < 0 *)
Lemma down_is_early (c b a : double) :
  0 < B c -> B b < 0 -> finite b -> finite a -> finite c ->
  let t1 := (b * b)%float in
  let t2 := (literal 2 0 * a * c)%float in
  let t3 := (t1 - t2)%float in
  let t4 := (t3 + (literal 1 (-47) * (t1 + magnitude t2) + literal 1 (-1022)))%float in
  finite t4 ->
  let D := B b * B b - 2 * B a * B c in
  0 <= D -> D * (1 - u) <= B t4.
Proof.
  intros Hc Hb Fb Fa Fc t1 t2 t3 t4 F4 D HD.
  generalize lost_least_normal lost_pos. intros [Ln Pn] Pl.
  apply add_finite in F4. destruct F4 as (F3 & Fq & E4). fold t4 in E4.
  apply add_finite in Fq. destruct Fq as (Fm & Fu & Eq).
  apply mul_finite in Fm. destruct Fm as (_ & F5 & Em).
  apply add_finite in F5. destruct F5 as (F1 & F2 & E5). apply (proj1 (magnitude_finite _)) in F2.
  rewrite magnitude_value in E5.
  generalize (rnd_sum t3 (literal 1 (-47) * (t1 + magnitude t2) + literal 1 (-1022))%float).
  rewrite <- E4, Eq.
  generalize (rnd_sum (literal 1 (-47) * (t1 + magnitude t2))%float (literal 1 (-1022))).
  rewrite Em, E5, (proj2 (literal_power (-47) ltac:(lia))), (proj2 (literal_power (-1022) ltac:(lia))).
  fold least_normal.
  apply sub_finite in F3. destruct F3 as (_ & _ & E3). fold t3 in E3.
  generalize (rnd_sum t1 (magnitude t2)). rewrite magnitude_value.
  generalize (rnd_difference t1 t2). rewrite <- E3.
  apply mul_finite in F1. destruct F1 as (_ & _ & E1). fold t1 in E1.
  generalize (rnd_error (B b * B b)). rewrite <- E1.
  apply mul_finite in F2. destruct F2 as (F2a & _ & E2). fold t2 in E2.
  rewrite (doubled a F2a) in E2.
  generalize (rnd_error (2 * B a * B c)). rewrite <- E2.
  assert (bpow radix2 (-47) = 64 * u) as -> by (rewrite u_value; simpl; lra).
  unfold D in *. clear D.
  set (Q := 2 * B a * B c) in *. set (bb := B b * B b) in *.
  assert (0 <= bb) as Hbb by (unfold bb; nra).
  set (v1 := B t1) in *. set (v2 := B t2) in *. set (v3 := B t3) in *. set (v4 := B t4) in *.
  rewrite (Rabs_pos_eq bb Hbb).
  intros R2 R1 R3 R5 R6 R4.
  assert (0 <= v1) as Hv1 by (rewrite E1; apply rnd_nonneg; exact Hbb).
  set (A := Rabs Q) in *. assert (0 <= A) as HA by apply Rabs_pos.
  assert (- A <= Q <= A) as HQ by (apply Rabs_le_inv, Rle_refl).
  set (W := Rabs v2) in *. assert (0 <= W) as HW by apply Rabs_pos.
  assert (- W <= v2 <= W) as HvW by (apply Rabs_le_inv, Rle_refl).
  assert (A * (1 - u) - lost <= W <= A * (1 + u) + lost) as HWA.
  { assert (Rabs (W - A) <= u * A + lost) as G.
    { apply Rle_trans with (2 := R2). unfold W, A. apply Rabs_triang_inv2. }
    apply Rabs_le_inv in G. lra. }
  apply Rabs_le_inv in R1. apply Rabs_le_inv in R2.
  (* The difference. *)
  assert (Rabs (v1 - v2) <= v1 + W) as T by (apply Rabs_le; lra).
  assert (v3 >= bb - Q - 3 * u * (bb + A) - 3 * lost) as L3.
  { apply Rabs_le_inv in R3. rewrite u_value in *. lra. }
  (* What is added to it. *)
  rewrite (Rabs_pos_eq (v1 + W)) in R5 by lra. apply Rabs_le_inv in R5.
  set (v5 := rnd64 (v1 + W)) in *.
  assert (v5 >= (bb + A) * (1 - 3 * u) - 3 * lost) as L5 by (rewrite u_value in *; lra).
  assert (0 <= v5) as P5 by (apply rnd_nonneg; lra).
  generalize (rnd_lower (64 * u * v5)). intros R7.
  assert (0 <= 64 * u * v5) as P7 by (rewrite u_value; lra). apply R7 in P7. clear R7.
  assert (0 <= rnd64 (64 * u * v5)) as P8 by (apply rnd_nonneg; rewrite u_value; lra).
  set (v7 := rnd64 (64 * u * v5)) in *.
  assert (v7 >= 62 * u * (bb + A) - 2 * lost) as L7 by (rewrite u_value in *; lra).
  rewrite (Rabs_pos_eq (v7 + least_normal)) in R6 by lra. apply Rabs_le_inv in R6.
  set (v8 := rnd64 (v7 + least_normal)) in *.
  assert (v8 >= 61 * u * (bb + A) + 4 * lost) as L8 by (rewrite u_value in *; lra).
  assert (0 <= v3 + v8) as P9 by (rewrite u_value in *; lra).
  rewrite (Rabs_pos_eq _ P9) in R4. apply Rabs_le_inv in R4.
  rewrite u_value in *. lra.
Qed.

(* The discriminant never overflows downward. *)
Lemma discriminant_not_minus_infinity (b t2 : double) :
  let t1 := (b * b)%float in
  ((t1 - t2) + (literal 1 (-47) * (t1 + magnitude t2) + literal 1 (-1022)))%float <> B754_infinity true.
Proof.
  intros t1 E.
  assert (not_negative t1) as N1 by apply square_not_negative.
  assert (not_negative (magnitude t2)) as N2 by (destruct t2; try (right; reflexivity); left; reflexivity).
  assert (forall e, (-1074 <= e <= 1023)%Z -> not_negative (literal 1 e)) as NL.
  { intros e He. right. destruct (literal_power e He) as [F V].
    destruct (not_negative_value _ F) as [Z|S]; [rewrite V; apply bpow_ge_0| |exact S].
    rewrite V in Z. generalize (bpow_gt_0 radix2 e). lra. }
  assert (not_negative (literal 1 (-47) * (t1 + magnitude t2) + literal 1 (-1022))%float) as N3.
  { apply add_not_negative; [apply mul_not_negative; [|apply add_not_negative; assumption]|]; apply NL; lia. }
  destruct (is_finite (t1 - t2)%float) eqn:F.
  { exact (sum_not_minus_infinity _ _ F N3 E). }
  destruct (t1 - t2)%float as [s|[|]| |s m e H] eqn:D; try discriminate.
  - destruct (difference_minus_infinity _ _ N1 D) as [F1 ->].
    revert E. clear - F1. destruct t1 as [s|s| |s m e H]; try discriminate; vm_compute; discriminate.
  - revert E. generalize (literal 1 (-47) * (t1 + magnitude t2) + literal 1 (-1022))%float.
    intros [t|[|]| |t n f K]; discriminate.
Qed.

(* What is returned is finite. *)
Lemma shortened_finite (t : double) :
  less (literal 1 (-975)) (t - t * literal 1 (-47))%float = true -> finite (t - t * literal 1 (-47))%float.
Proof.
  intros L. destruct (t - t * literal 1 (-47))%float as [s|s| |s m e H] eqn:E; try reflexivity; try discriminate.
  exfalso. destruct s; [discriminate|]. clear L.
  destruct (is_finite t) eqn:F.
  2: { destruct t as [s|[|]| |s m e H]; try discriminate; vm_compute in E; discriminate. }
  destruct (scaled_finite t (-47) F) as [Fm Sm]; [lia|].
  generalize (Bminus_correct 53 1024 _ _ mode_NE t (t * literal 1 (-47))%float F Fm).
  fold (sub t (t * literal 1 (-47))%float). rewrite E.
  case Rlt_bool_spec; intros _ C; [destruct C as (_ & C & _); discriminate|].
  destruct C as [_ C]. rewrite Sm in C. destruct (Bsign t); discriminate.
Qed.

Lemma returned (t : double) :
  let r := (t - t * literal 1 (-47))%float in
  less (literal 1 (-975)) r = true -> finite r /\ bpow radix2 (-975) < B r.
Proof.
  intros r L. assert (finite r) as F by (apply shortened_finite; exact L).
  split; [exact F|]. destruct (literal_power (-975)) as [FL VL]; [lia|].
  rewrite <- VL. apply less_true; assumption.
Qed.

(* Without a number above it, the coefficient c is finite: in the branch in which the discriminant is not above zero. *)
Lemma discriminant_infinite (b a : double) :
  finite b -> finite a -> B a < 0 ->
  less (literal 0 0) (b * b - literal 2 0 * a * B754_infinity false - literal 1 (-1022))%float = true.
Proof.
  intros Fb Fa La.
  assert ((literal 2 0 * a * B754_infinity false)%float = B754_infinity true) as E.
  { assert (Bsign (literal 2 0 * a)%float = true /\
            ((literal 2 0 * a)%float = B754_infinity true \/ (finite (literal 2 0 * a)%float /\ B (literal 2 0 * a)%float <> 0))) as [S W].
    { assert (Bsign a = true) as Sa.
      { destruct (Bsign a) eqn:S; [reflexivity|]. generalize (value_not_negative a Fa S). lra. }
      generalize (Bmult_correct 53 1024 _ _ mode_NE (literal 2 0) a). fold (mul (literal 2 0) a).
      destruct Rlt_bool.
      - intros (_ & F & S). rewrite (proj1 literal_2), Fa in F. change (true && true)%bool with true in F.
        assert (Bsign (literal (prec := 53) (emax := 1024) 2 0) = false) as SL by (vm_compute; reflexivity).
        rewrite SL, Sa in S. split.
        + apply S, finite_not_nan. exact F.
        + right. split; [exact F|]. rewrite doubled by exact F. lra.
      - intros O. apply overflow_value in O. rewrite Sa in O.
        assert (Bsign (literal (prec := 53) (emax := 1024) 2 0) = false) as SL by (vm_compute; reflexivity).
        rewrite SL in O. simpl in O. rewrite O. auto. }
    destruct W as [-> | [F N]]; [reflexivity|].
    destruct (literal 2 0 * a)%float as [s|s| |s m e H]; try discriminate; simpl in *; try congruence; subst; try reflexivity.
    all: exfalso; apply N; reflexivity. }
  rewrite E.
  assert (not_negative (b * b)%float) as N by apply square_not_negative.
  assert (is_nan (b * b)%float = false) as NN.
  { generalize (Bmult_correct 53 1024 _ _ mode_NE b b). fold (mul b b). destruct Rlt_bool.
    - intros (_ & F & _). rewrite Fb in F. apply finite_not_nan. exact F.
    - intros O. apply overflow_value in O. rewrite O. reflexivity. }
  destruct (b * b)%float as [s|[|]| |s m e H].
  - vm_compute. reflexivity.
  - exfalso. destruct N; discriminate.
  - vm_compute. reflexivity.
  - discriminate.
  - vm_compute. reflexivity.
Qed.

Lemma up_discriminant (c b a : double) :
  let t4 := (b * b - literal 2 0 * a * c - literal 1 (-1022))%float in
  0 < B c -> B a < 0 -> finite t4 -> 0 < B t4 ->
  finite c /\ finite b /\ finite a /\ B t4 <= (B b * B b + - (2 * B a * B c)) * (1 + 4 * u).
Proof.
  intros t4 Hc Ha F4 P4.
  generalize lost_least_normal lost_pos. intros [Ln Pn] Pl.
  apply sub_finite in F4. destruct F4 as (F3 & _ & E4). fold t4 in E4.
  generalize (rnd_difference (b * b - literal 2 0 * a * c)%float (literal 1 (-1022))). rewrite <- E4.
  rewrite E4 in P4. apply rnd_pos_inv in P4.
  rewrite (proj2 (literal_power (-1022) ltac:(lia))) in *. fold least_normal in *.
  apply sub_finite in F3. destruct F3 as (F1 & F2 & E3).
  generalize (rnd_difference (b * b)%float (literal 2 0 * a * c)%float). rewrite <- E3. clear E3 E4.
  apply mul_finite in F1. destruct F1 as (Fb & _ & E1).
  generalize (rnd_error (B b * B b)). rewrite <- E1.
  apply mul_finite in F2. destruct F2 as (F2a & Fc & E2).
  rewrite (doubled a F2a) in E2. apply mul_finite in F2a. destruct F2a as (_ & Fa & _).
  generalize (rnd_error (2 * B a * B c)). rewrite <- E2.
  intros R2 R1 R3 R4. repeat (split; [assumption|]).
  assert (0 < - (2 * B a * B c)) as HQ by nra.
  assert (0 <= B b * B b) as Hb by nra.
  assert (B (literal 2 0 * a * c)%float <= 0) as N2.
  { rewrite E2. rewrite <- (rnd_0 (prec := 53) (emax := 1024)). apply rnd_le. lra. }
  assert (0 <= B (b * b)%float) as N1 by (rewrite E1; apply rnd_nonneg; exact Hb).
  set (Q := 2 * B a * B c) in *. set (bb := B b * B b) in *.
  set (v1 := B (b * b)%float) in *. set (v2 := B (literal 2 0 * a * c)%float) in *.
  set (v3 := B (b * b - literal 2 0 * a * c)%float) in *.
  rewrite (Rabs_left Q) in R2 by lra. rewrite (Rabs_pos_eq bb) in R1 by lra.
  rewrite (Rabs_pos_eq (v1 - v2)) in R3 by lra. rewrite (Rabs_pos_eq (v3 - least_normal)) in R4 by lra.
  apply Rabs_le_inv in R1. apply Rabs_le_inv in R2. apply Rabs_le_inv in R3. apply Rabs_le_inv in R4.
  rewrite u_value in *. lra.
Qed.

Theorem first_crossing_is_early (c b a : double) :
  let r := first_crossing c b a in
  r = literal 0 0 \/ early c b a r \/
  (r = infinity /\ c = infinity /\ finite b /\ finite a /\ 0 <= B b /\ 0 <= B a).
Proof.
  cbv zeta. unfold first_crossing.
  destruct (less (literal 1 (-975)) c) eqn:Lc; [|left; reflexivity].
  assert (finite c -> bpow radix2 (-975) < B c) as Gc.
  { destruct (literal_power (-975)) as [FL VL]; [lia|]. intros F. rewrite <- VL. apply less_true; assumption. }
  assert (finite c -> 0 < B c) as Pc.
  { intros F. apply Rlt_trans with (2 := Gc F). apply bpow_gt_0. }
  destruct (at_most (literal 0 0) b) eqn:Lb.
  - assert (finite b -> 0 <= B b) as Pb.
    { intros F. rewrite <- (proj2 literal_0). apply at_most_true; auto using (proj1 literal_0). }
    destruct (at_most (literal 0 0) a) eqn:La.
    { destruct (less (b + a)%float infinity) eqn:Ls; [right|left; reflexivity].
      assert (finite b /\ finite a) as [Fb Fa].
      { clear - Lb La Ls. destruct b as [?|[|]| |? ? ? ?], a as [?|[|]| |? ? ? ?];
          try discriminate; split; reflexivity. }
      assert (0 <= B a) as Pa.
      { rewrite <- (proj2 literal_0). apply at_most_true; auto using (proj1 literal_0). }
      destruct (is_finite c) eqn:Fc.
      - left. repeat (split; [auto; fail|]). left. split; [reflexivity|]. intros d Hd.
        apply quadratic_rising; auto.
      - right. split; [reflexivity|]. split; [|auto].
        destruct c as [?|[|]| |? ? ? ?]; try discriminate; reflexivity. }
    assert (finite a -> B a < 0) as Pa.
    { intros F. rewrite <- (proj2 literal_0). apply at_most_false; auto using (proj1 literal_0). }
    cbv zeta. set (t4 := (b * b - literal 2 0 * a * c - literal 1 (-1022))%float).
    destruct (less (literal 0 0) t4) eqn:L4.
    + set (t6 := ((b + root t4) / - a)%float).
      destruct (less (literal 1 (-975)) (t6 - t6 * literal 1 (-47))%float) eqn:L7; [|left; reflexivity].
      right; left. destruct (returned t6 L7) as [F7 V7].
      destruct (shortened t6 F7 V7) as (F6 & P6 & _).
      assert (B t6 <> 0) as N6 by (generalize (bpow_gt_0 radix2 (-975)); lra).
      destruct (div_finite _ _ F6 N6) as (Fn & Fa & _ & _). apply (proj1 (neg_finite _)) in Fa.
      apply add_finite in Fn. destruct Fn as (Fb & Fr & _).
      apply root_finite in Fr. destruct Fr as (F4 & P4 & Er).
      assert (0 < B t4) as Q4.
      { rewrite <- (proj2 literal_0). apply less_true; auto using (proj1 literal_0). }
      assert (finite c) as Fc.
      { clear - F4. apply sub_finite in F4. destruct F4 as (F & _). apply sub_finite in F.
        destruct F as (_ & F & _). apply mul_finite in F. tauto. }
      destruct (up_discriminant c b a (Pc Fc) (Pa Fa) F4 Q4) as (_ & _ & _ & U4). fold t4 in U4.
      repeat (split; [auto; fail|]). right. split; [exact F7|].
      split; [apply Rlt_trans with (2 := V7); apply bpow_gt_0|].
      intros d Hd. apply (up_is_early c b a t4 (root t4)); auto.
      rewrite Er. split; [apply rnd_nonneg, sqrt_pos|].
      generalize (rnd_root t4 P4). intros R. apply Rabs_le_inv in R.
      set (D := B b * B b + - (2 * B a * B c)) in *.
      assert (0 < D) as HD by (rewrite u_value in U4; lra).
      assert (sqrt (B t4) <= sqrt D * (1 + 2 * u)) as S.
      { rewrite <- (sqrt_square (1 + 2 * u)) by (rewrite u_value; lra).
        rewrite <- sqrt_mult by (try rewrite u_value; lra).
        apply sqrt_le_1_alt. apply Rle_trans with (1 := U4). apply Rmult_le_compat_l; [lra|].
        rewrite u_value. lra. }
      generalize (sqrt_pos D). rewrite u_value in *. lra.
    + set (t6 := ((b + root (literal 0 0)) / - a)%float).
      destruct (less (literal 1 (-975)) (t6 - t6 * literal 1 (-47))%float) eqn:L7; [|left; reflexivity].
      right; left. destruct (returned t6 L7) as [F7 V7].
      destruct (shortened t6 F7 V7) as (F6 & P6 & _).
      assert (B t6 <> 0) as N6 by (generalize (bpow_gt_0 radix2 (-975)); lra).
      destruct (div_finite _ _ F6 N6) as (Fn & Fa & _ & _). apply (proj1 (neg_finite _)) in Fa.
      apply add_finite in Fn. destruct Fn as (Fb & Fr & _).
      apply root_finite in Fr. destruct Fr as (_ & _ & Er).
      assert (finite c) as Fc.
      { destruct c as [s|[|]| |s m e H] eqn:Ec; try reflexivity; try discriminate Lc.
        exfalso. unfold t4 in L4. rewrite (discriminant_infinite b a Fb Fa (Pa Fa)) in L4. discriminate. }
      repeat (split; [auto; fail|]). right. split; [exact F7|].
      split; [apply Rlt_trans with (2 := V7); apply bpow_gt_0|].
      intros d Hd. apply (up_is_early c b a t4 (root (literal 0 0))); auto.
      rewrite Er, (proj2 literal_0), sqrt_0, rnd_0. split; [lra|].
      apply Rmult_le_pos; [apply sqrt_pos|rewrite u_value; lra].
  - cbv zeta.
    set (t4 := (b * b - literal 2 0 * a * c +
      (literal 1 (-47) * (b * b + magnitude (literal 2 0 * a * c)) + literal 1 (-1022)))%float).
    assert (finite t4 -> finite c /\ finite b /\ finite a) as Fall.
    { clear. intros F. apply add_finite in F. destruct F as (F & _). apply sub_finite in F.
      destruct F as (F1 & F2 & _). apply mul_finite in F1, F2. destruct F2 as (F2 & Fc & _).
      apply mul_finite in F2. tauto. }
    assert (finite b -> B b < 0) as Pb.
    { intros F. rewrite <- (proj2 literal_0). apply at_most_false; auto using (proj1 literal_0). }
    destruct (less t4 (literal 0 0)) eqn:L4.
    + assert (finite t4) as F4.
      { destruct t4 as [s|[|]| |s m e H] eqn:E4; try reflexivity; try discriminate L4.
        exfalso. exact (discriminant_not_minus_infinity b _ E4). }
      destruct (Fall F4) as (Fc & Fb & Fa).
      right; left. repeat (split; [auto; fail|]). left. split; [reflexivity|]. intros d Hd.
      apply quadratic_without_root; [auto|]. apply Rnot_le_lt. intros HD.
      generalize (down_is_early c b a (Pc Fc) (Pb Fb) Fb Fa Fc F4 HD). fold t4. intros G.
      assert (B t4 < 0) as N.
      { rewrite <- (proj2 literal_0). apply less_true; auto using (proj1 literal_0). }
      rewrite u_value in G. lra.
    + set (t5 := (literal 2 0 * c / (root t4 - b))%float).
      destruct (less (literal 1 (-975)) (t5 - t5 * literal 1 (-47))%float) eqn:L7; [|left; reflexivity].
      right; left. destruct (returned t5 L7) as [F7 V7].
      destruct (shortened t5 F7 V7) as (F5 & P5 & E7).
      assert (B t5 <> 0) as N5 by (generalize (bpow_gt_0 radix2 (-975)); lra).
      destruct (div_finite _ _ F5 N5) as (F2 & Fn & Nn & E5). fold t5 in E5.
      rewrite (doubled c F2) in E5.
      apply sub_finite in Fn. destruct Fn as (Fr & Fb & En).
      apply root_finite in Fr. destruct Fr as (F4 & P4 & Er).
      destruct (Fall F4) as (Fc & _ & Fa).
      repeat (split; [auto; fail|]). right. split; [exact F7|].
      split; [apply Rlt_trans with (2 := V7); apply bpow_gt_0|].
      intros d [Hd Ld]. specialize (Pc Fc). specialize (Pb Fb).
      destruct (Rlt_or_le (B b * B b - 2 * B a * B c) 0) as [HD|HD]; [apply quadratic_without_root; assumption|].
      generalize (down_is_early c b a Pc Pb Fb Fa Fc F4 HD). fold t4. intros U4.
      set (D := B b * B b - 2 * B a * B c) in *.
      generalize (rnd_root t4 P4). rewrite <- Er. intros R. apply Rabs_le_inv in R.
      assert (sqrt D * (1 - u) <= sqrt (B t4)) as S.
      { rewrite <- (sqrt_square (1 - u)) by (rewrite u_value; lra).
        rewrite <- sqrt_mult by (try rewrite u_value; lra).
        apply sqrt_le_1_alt. apply Rle_trans with (2 := U4). apply Rmult_le_compat_l; [lra|].
        rewrite u_value. lra. }
      assert (0 <= sqrt D) as HS by apply sqrt_pos.
      assert (sqrt D * (1 - 3 * u) <= B (root t4)) as S' by (rewrite u_value in *; lra).
      generalize (rnd_difference (root t4) b). rewrite <- En.
      rewrite (Rabs_pos_eq (B (root t4) - B b)) by (rewrite u_value in S'; lra).
      intros Rn. apply Rabs_le_inv in Rn. set (n := B (root t4 - b)%float) in *.
      assert ((sqrt D - B b) * (1 - 5 * u) <= n) as Ln by (rewrite u_value in *; lra).
      set (w := sqrt D - B b) in *. assert (0 < w) as Hw by (unfold w; lra).
      assert (0 < n) as Hn by (rewrite u_value in Ln; lra).
      assert (0 < 2 * B c / n) as Pq by (apply Rdiv_lt_0_compat; lra).
      generalize (rnd_relative (2 * B c / n)). rewrite <- E5, (Rabs_pos_eq (2 * B c / n)) by lra. intros G.
      assert (bpow radix2 (-975) < 2 * B c / n) as W by (apply rnd_gt_bpow; [lia|rewrite <- E5; exact P5]).
      assert (Rabs (B t5 - 2 * B c / n) <= u * (2 * B c / n)) as G'.
      { apply G. apply Rlt_le, Rlt_trans with (2 := W). apply bpow_lt. lia. }
      apply Rabs_le_inv in G'.
      set (q := 2 * B c / n) in *.
      assert (q * n = 2 * B c) as Eq by (unfold q; field; lra).
      apply (quadratic_before_root _ _ _ _ (sqrt D)); auto.
      { unfold D. apply sqrt_sqrt. exact HD. }
      fold w. apply Rlt_le_trans with (q * (1 - 60 * u) * w).
      * apply Rmult_lt_compat_r; [exact Hw|]. rewrite u_value in *. lra.
      * rewrite <- Eq. rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|].
        rewrite u_value in *. lra.
Qed.
