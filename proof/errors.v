(* Error bound of a term of sums and products: a number of unit roundoffs of the magnitudes that go into it. Each
   product adds its possible loss by underflow to these magnitudes. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core Relative Plus_error BinarySingleNaN.
From Kinesphere Require Import floats.
Open Scope R_scope.

Section Errors.

Context {prec emax : Z} {Hprec : Prec_gt_0 prec} {Hemax : Prec_lt_emax prec emax}.
Notation number := (binary_float prec emax).
Notation B := (B2R (prec := prec) (emax := emax)).
Notation rounded := (rnd (prec := prec) (emax := emax)).
Notation exponent := (FLT_exp (3 - emax - prec) prec).

(* Half a unit in the last place of 1, and the least number of full precision. *)
Definition roundoff : R := bpow radix2 (- prec).
Definition least : R := bpow radix2 (2 - emax).

Lemma roundoff_pos : 0 < roundoff.
Proof. apply bpow_gt_0. Qed.
Lemma least_pos : 0 < least.
Proof. apply bpow_gt_0. Qed.

Lemma rounded_FLT x : rounded x = round radix2 exponent ZnearestE x.
Proof. reflexivity. Qed.

Lemma u_ro_roundoff : u_ro radix2 prec = roundoff.
Proof.
  unfold u_ro, roundoff. replace (- prec + 1)%Z with (1 + - prec)%Z by ring.
  rewrite bpow_plus. change (bpow radix2 1) with 2. field.
Qed.

(* Any operation. *)
Lemma rounded_error x : Rabs (rounded x - x) <= roundoff * (Rabs x + least).
Proof.
  destruct (error_N_FLT radix2 (3 - emax - prec) prec Hprec (fun n => negb (Z.even n)) x)
    as (eps & eta & He & Ht & _ & E).
  rewrite rounded_FLT, E.
  replace (x * (1 + eps) + eta - x) with (x * eps + eta) by ring.
  rewrite Rmult_plus_distr_l.
  eapply Rle_trans; [apply Rabs_triang|].
  rewrite Rabs_mult. apply Rplus_le_compat.
  - rewrite Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos|]. rewrite <- u_ro_roundoff. exact He.
  - eapply Rle_trans; [exact Ht|]. unfold roundoff, least. rewrite <- bpow_plus. right.
    change (/ 2) with (bpow radix2 (-1)). rewrite <- bpow_plus. f_equal. ring.
Qed.

(* Sums lose nothing to underflow. *)
Lemma rounded_sum (x y : number) : Rabs (rounded (B x + B y) - (B x + B y)) <= roundoff * Rabs (B x + B y).
Proof.
  destruct (FLT_plus_error_N_ex radix2 (3 - emax - prec) prec (fun n => negb (Z.even n)) (B x) (B y)
    (value_format x) (value_format y)) as (eps & He & E).
  rewrite rounded_FLT, E.
  replace ((B x + B y) * (1 + eps) - (B x + B y)) with (eps * (B x + B y)) by ring.
  rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|].
  eapply Rle_trans; [exact He|].
  rewrite u_ro_roundoff. generalize roundoff_pos. intros P.
  apply Rmult_le_reg_r with (1 + roundoff); [lra|].
  replace (roundoff / (1 + roundoff) * (1 + roundoff)) with roundoff by (field; lra). nra.
Qed.

Lemma rounded_difference (x y : number) :
  Rabs (rounded (B x - B y) - (B x - B y)) <= roundoff * Rabs (B x - B y).
Proof. generalize (rounded_sum x (neg y)). rewrite neg_value. exact (fun H => H). Qed.

(* A float x, where it is finite, is the number X to within k hundredths of a roundoff of the magnitude M. *)
Definition close (x : number) (X M : R) (k : Z) : Prop :=
  finite x -> Rabs (B x - X) <= IZR k * (roundoff / 100) * M /\ Rabs X <= M.

Lemma close_exact x : close x (B x) (Rabs (B x)) 0.
Proof. intros _. rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. lra. Qed.

Lemma close_as x X M k X' M' k' :
  close x X M k -> X = X' -> (finite x -> M <= M') -> (0 <= k <= k')%Z -> close x X' M' k'.
Proof.
  intros C <- LM [Pk Lk] F. specialize (LM F). destruct (C F) as [C1 C2]. split; [|lra].
  generalize roundoff_pos. intros P. apply IZR_le in Lk, Pk.
  apply Rle_trans with (1 := C1). generalize (Rabs_pos X). intros.
  apply Rmult_le_compat; try lra; [apply Rmult_le_pos; lra|]. apply Rmult_le_compat_r; lra.
Qed.

Hypothesis precise : (24 <= prec)%Z.

Lemma roundoff_small : roundoff <= / 16777216.
Proof.
  replace (/ 16777216) with (bpow radix2 (-24)) by reflexivity. apply bpow_le. lia.
Qed.

Lemma in_range k : (0 <= k <= 6400)%Z -> 0 <= IZR k <= 6400.
Proof. intros [L U]. apply IZR_le in L, U. split; assumption. Qed.

Lemma close_sum x y X Y M N k j s :
  (finite s -> finite x /\ finite y /\ B s = rounded (B x + B y)) ->
  close x X M k -> close y Y N j -> (0 <= k <= 6400)%Z -> (0 <= j <= 6400)%Z ->
  close s (X + Y) (M + N) (Z.max k j + 101).
Proof.
  intros S Cx Cy Hk Hj F. destruct (S F) as (Fx & Fy & ->). destruct (Cx Fx) as [Ex Mx], (Cy Fy) as [Ey My].
  assert (0 <= Z.max k j <= 6400)%Z as Hm by lia.
  assert (IZR k <= IZR (Z.max k j)) as Lk by (apply IZR_le; lia).
  assert (IZR j <= IZR (Z.max k j)) as Lj by (apply IZR_le; lia).
  rewrite plus_IZR. apply in_range in Hm, Hk, Hj.
  set (m := IZR (Z.max k j)) in *.
  generalize roundoff_pos roundoff_small (Rabs_pos X) (Rabs_pos Y). intros P Q PX PY.
  assert (Rabs (B x + B y - (X + Y)) <= m * (roundoff / 100) * (M + N)) as E.
  { replace (B x + B y - (X + Y)) with ((B x - X) + (B y - Y)) by ring.
    eapply Rle_trans; [apply Rabs_triang|].
    assert (IZR k * (roundoff / 100) * M <= m * (roundoff / 100) * M)
      by (repeat apply Rmult_le_compat_r; lra).
    assert (IZR j * (roundoff / 100) * N <= m * (roundoff / 100) * N)
      by (repeat apply Rmult_le_compat_r; lra).
    lra. }
  assert (Rabs (X + Y) <= M + N) as EM by (generalize (Rabs_triang X Y); lra).
  split; [|exact EM].
  assert (m * (roundoff / 100) * (M + N) <= / 100 * (M + N)) as Sm.
  { apply Rmult_le_compat_r; [lra|]. apply Rle_trans with (6400 * (roundoff / 100)); [|lra].
    apply Rmult_le_compat_r; lra. }
  assert (Rabs (B x + B y) <= (M + N) * (101 / 100)) as T.
  { replace (B x + B y) with ((B x + B y - (X + Y)) + (X + Y)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. lra. }
  replace (rounded (B x + B y) - (X + Y)) with ((rounded (B x + B y) - (B x + B y)) + (B x + B y - (X + Y))) by ring.
  eapply Rle_trans; [apply Rabs_triang|].
  generalize (rounded_sum x y). intros R.
  assert (roundoff * Rabs (B x + B y) <= roundoff * ((M + N) * (101 / 100))) by (apply Rmult_le_compat_l; lra).
  lra.
Qed.

Lemma close_add x y X Y M N k j :
  close x X M k -> close y Y N j -> (0 <= k <= 6400)%Z -> (0 <= j <= 6400)%Z ->
  close (add x y) (X + Y) (M + N) (Z.max k j + 101).
Proof. apply close_sum. apply add_finite. Qed.

Lemma close_neg x X M k : close x X M k -> close (neg x) (- X) M k.
Proof.
  intros C F. apply (proj1 (neg_finite _)) in F. destruct (C F) as [E M1]. rewrite neg_value, Rabs_Ropp.
  split; [|exact M1]. replace (- B x - - X) with (- (B x - X)) by ring. rewrite Rabs_Ropp. exact E.
Qed.

Lemma close_sub x y X Y M N k j :
  close x X M k -> close y Y N j -> (0 <= k <= 6400)%Z -> (0 <= j <= 6400)%Z ->
  close (sub x y) (X - Y) (M + N) (Z.max k j + 101).
Proof.
  intros Cx Cy Hk Hj. apply close_sum with x (neg y); try assumption.
  - intros F. destruct (sub_finite _ _ F) as (Fx & Fy & E). rewrite neg_value.
    repeat split; [exact Fx|apply neg_finite; exact Fy|exact E].
  - apply close_neg. exact Cy.
Qed.

(* L is what the product may lose to underflow: nothing, if a factor is zero. *)
Lemma close_mul x y X Y M N L k j :
  close x X M k -> close y Y N j -> (B x <> 0 -> B y <> 0 -> least <= L) -> 0 <= L ->
  (0 <= k <= 6400)%Z -> (0 <= j <= 6400)%Z ->
  close (mul x y) (X * Y) (M * N + L) (k + j + 101).
Proof.
  intros Cx Cy HL PL Hk Hj F. destruct (mul_finite _ _ F) as (Fx & Fy & ->).
  destruct (Cx Fx) as [Ex Mx], (Cy Fy) as [Ey My].
  rewrite !plus_IZR. apply in_range in Hk, Hj. set (k' := IZR k) in *. set (j' := IZR j) in *.
  generalize roundoff_pos roundoff_small (Rabs_pos X) (Rabs_pos Y). intros P Q PX PY.
  assert (0 <= M * N) as PMN by (apply Rmult_le_pos; lra).
  assert (Rabs (X * Y) <= M * N) as MXY by (rewrite Rabs_mult; apply Rmult_le_compat; lra).
  split; [|lra].
  set (v := roundoff / 100) in *.
  assert (0 < v <= / 1677721600) as [Pv Sv] by (unfold v; lra).
  assert (0 <= k' * v <= / 100000) as [Pkv Skv].
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (6400 * v); [apply Rmult_le_compat_r|]; lra. }
  assert (0 <= j' * v <= / 100000) as [Pjv Sjv].
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (6400 * v); [apply Rmult_le_compat_r|]; lra. }
  assert (Rabs (B x * B y - X * Y) <= (k' + j' + / 10) * v * (M * N)) as E.
  { replace (B x * B y - X * Y) with ((B x - X) * Y + X * (B y - Y) + (B x - X) * (B y - Y)) by ring.
    eapply Rle_trans; [apply Rabs_triang|].
    assert (Rabs ((B x - X) * (B y - Y)) <= k' * v * M * (j' * v * N)).
    { rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos. }
    assert (Rabs ((B x - X) * Y + X * (B y - Y)) <= k' * v * M * N + M * (j' * v * N)).
    { eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult.
      apply Rplus_le_compat; apply Rmult_le_compat; auto using Rabs_pos. }
    assert (k' * v * M * (j' * v * N) <= / 10 * v * (M * N)).
    { replace (k' * v * M * (j' * v * N)) with (k' * (j' * v) * (v * (M * N))) by ring.
      assert (0 <= v * (M * N)) by (apply Rmult_le_pos; lra).
      rewrite (Rmult_assoc (/ 10)). apply Rmult_le_compat_r; [assumption|].
      apply Rle_trans with (6400 * / 100000); [|lra]. apply Rmult_le_compat; lra. }
    lra. }
  assert ((k' + j' + / 10) * v * (M * N) <= / 1000 * (M * N)) as SE by (apply Rmult_le_compat_r; lra).
  destruct (Req_dec (B x) 0) as [Zx|Nx].
  { rewrite Zx in *. rewrite Rmult_0_l in *. rewrite rnd_0.
    eapply Rle_trans; [exact E|].
    assert (0 <= v * (M * N)) by (apply Rmult_le_pos; lra).
    assert (0 <= (k' + j' + 101) * v * L) by (repeat apply Rmult_le_pos; lra).
    lra. }
  destruct (Req_dec (B y) 0) as [Zy|Ny].
  { rewrite Zy in *. rewrite Rmult_0_r in *. rewrite rnd_0.
    eapply Rle_trans; [exact E|].
    assert (0 <= v * (M * N)) by (apply Rmult_le_pos; lra).
    assert (0 <= (k' + j' + 101) * v * L) by (repeat apply Rmult_le_pos; lra).
    lra. }
  specialize (HL Nx Ny).
  assert (Rabs (B x * B y) <= (M * N) * (1001 / 1000)) as T.
  { replace (B x * B y) with ((B x * B y - X * Y) + X * Y) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. lra. }
  replace (rounded (B x * B y) - X * Y) with ((rounded (B x * B y) - B x * B y) + (B x * B y - X * Y)) by ring.
  eapply Rle_trans; [apply Rabs_triang|].
  generalize (rounded_error (B x * B y)). intros R.
  assert (roundoff * (Rabs (B x * B y) + least) <= 100 * v * (M * N * (1001 / 1000) + L)).
  { replace roundoff with (100 * v) by (unfold v; field). apply Rmult_le_compat_l; lra. }
  assert (0 <= v * (M * N)) by (apply Rmult_le_pos; lra).
  assert (0 <= v * L) by (apply Rmult_le_pos; lra).
  assert (0 <= k' * v * L) by (apply Rmult_le_pos; lra).
  assert (0 <= j' * v * L) by (apply Rmult_le_pos; lra).
  lra.
Qed.

End Errors.

(* Numerals of hundredths as they come from the rules. *)
Ltac hundredths := vm_compute; repeat split; discriminate.

(* Finds what a term is close to. A product loses L if there is a hypothesis that says so of a factor. *)
Ltac find_loss :=
  first
    [ match goal with H : B2R ?x <> 0 -> least <= _ |- B2R ?x <> 0 -> _ => let A := fresh in intros A _; exact (H A) end
    | match goal with H : B2R ?y <> 0 -> least <= _ |- _ -> B2R ?y <> 0 -> _ => let A := fresh in intros _ A; exact (H A) end
    | intros _ _; apply Rle_refl ].
Ltac find_close :=
  first
    [ match goal with H : close ?x _ _ _ |- close ?x _ _ _ => exact H end
    | lazymatch goal with
      | |- close (add _ _) _ _ _ => eapply close_add; [hundredths|find_close|find_close|hundredths|hundredths]
      | |- close (sub _ _) _ _ _ => eapply close_sub; [hundredths|find_close|find_close|hundredths|hundredths]
      | |- close (mul _ _) _ _ _ =>
          eapply close_mul; [hundredths|find_close|find_close|find_loss|first [assumption|apply Rlt_le, least_pos]|hundredths|hundredths]
      | |- close (neg _) _ _ _ => eapply close_neg; find_close
      | |- close _ _ _ _ => apply close_exact
      end ].
