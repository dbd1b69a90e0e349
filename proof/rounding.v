(* Error bounds of single operations in double precision. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core Relative Plus_error BinarySingleNaN.
From Kinesphere Require Import floats.
Open Scope R_scope.

(* The unit roundoff, and half the least number there is: what an operation loses to underflow. *)
Definition u : R := bpow radix2 (-53).
Definition lost : R := bpow radix2 (-1075).

Notation fexp := (FLT_exp (-1074) 53).
Notation rnd64 := (rnd (prec := 53) (emax := 1024)).
Notation B := (B2R (prec := 53) (emax := 1024)).

Lemma rnd64_FLT x : rnd64 x = round radix2 fexp ZnearestE x.
Proof. reflexivity. Qed.

Lemma format (x : double) : generic_format radix2 fexp (B x).
Proof. exact (value_format (prec := 53) (emax := 1024) x). Qed.

Lemma u_value : u = / 9007199254740992.
Proof. reflexivity. Qed.
Lemma u_pos : 0 < u.
Proof. apply bpow_gt_0. Qed.
Lemma lost_pos : 0 < lost.
Proof. apply bpow_gt_0. Qed.

(* Any operation. *)
Lemma rnd_error x : Rabs (rnd64 x - x) <= u * Rabs x + lost.
Proof.
  destruct (error_N_FLT radix2 (-1074) 53 eq_refl (fun n => negb (Z.even n)) x) as (eps & eta & He & Ht & _ & E).
  rewrite rnd64_FLT, E.
  replace (x * (1 + eps) + eta - x) with (x * eps + eta) by ring.
  eapply Rle_trans; [apply Rabs_triang|].
  rewrite Rabs_mult. apply Rplus_le_compat.
  - rewrite Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos|].
    eapply Rle_trans; [exact He|]. unfold u, u_ro. simpl. lra.
  - eapply Rle_trans; [exact Ht|]. unfold lost. right.
    change (-1075)%Z with (-1 + -1074)%Z. rewrite bpow_plus. reflexivity.
Qed.

(* A result that is not tiny. *)
Lemma rnd_relative x : bpow radix2 (-1022) <= Rabs x -> Rabs (rnd64 x - x) <= u * Rabs x.
Proof.
  intros H. rewrite rnd64_FLT.
  eapply Rle_trans; [apply relative_error_N_FLT; [reflexivity|exact H]|].
  apply Rmult_le_compat_r; [apply Rabs_pos|]. unfold u. simpl. lra.
Qed.

(* A result that is a power of two or more is one of an operation that was. *)
Lemma rnd_ge_bpow x e : (-1074 <= e)%Z -> bpow radix2 e <= x -> bpow radix2 e <= rnd64 x.
Proof.
  intros He H. rewrite rnd64_FLT. apply round_ge_generic; auto with typeclass_instances.
  apply generic_format_bpow. unfold FLT_exp. lia.
Qed.
Lemma rnd_le_bpow x e : (-1074 <= e)%Z -> x <= bpow radix2 e -> rnd64 x <= bpow radix2 e.
Proof.
  intros He H. rewrite rnd64_FLT. apply round_le_generic; auto with typeclass_instances.
  apply generic_format_bpow. unfold FLT_exp. lia.
Qed.
Lemma rnd_gt_bpow x e : (-1074 <= e)%Z -> bpow radix2 e < rnd64 x -> bpow radix2 e < x.
Proof.
  intros He H. apply Rnot_le_lt. intros L. apply (rnd_le_bpow x e He) in L. lra.
Qed.

Lemma rnd_nonneg x : 0 <= x -> 0 <= rnd64 x.
Proof. intros H. rewrite <- (rnd_0 (prec := 53) (emax := 1024)). apply rnd_le. exact H. Qed.
Lemma rnd_pos_inv x : 0 < rnd64 x -> 0 < x.
Proof.
  intros H. apply Rnot_le_lt. intros L. apply (rnd_le (prec := 53) (emax := 1024)) in L.
  rewrite rnd_0 in L. lra.
Qed.

(* Sums lose nothing to underflow. *)
Lemma rnd_sum (x y : double) : Rabs (rnd64 (B x + B y) - (B x + B y)) <= u * Rabs (B x + B y).
Proof.
  destruct (FLT_plus_error_N_ex radix2 (-1074) 53 (fun n => negb (Z.even n)) (B x) (B y) (format x) (format y))
    as (eps & He & E).
  rewrite rnd64_FLT, E.
  replace ((B x + B y) * (1 + eps) - (B x + B y)) with (eps * (B x + B y)) by ring.
  rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|].
  eapply Rle_trans; [exact He|].
  assert (0 < u_ro radix2 53) by (unfold u_ro; simpl; lra).
  apply Rle_trans with (u_ro radix2 53).
  - apply Rmult_le_reg_r with (1 + u_ro radix2 53); [lra|].
    replace (u_ro radix2 53 / (1 + u_ro radix2 53) * (1 + u_ro radix2 53)) with (u_ro radix2 53) by (field; lra).
    nra.
  - unfold u_ro, u. simpl. lra.
Qed.

Lemma rnd_difference (x y : double) : Rabs (rnd64 (B x - B y) - (B x - B y)) <= u * Rabs (B x - B y).
Proof.
  generalize (rnd_sum x (neg y)). rewrite neg_value. exact (fun H => H).
Qed.

(* Multiplication by a power of two is exact, unless the product is tiny. *)
Lemma rnd_scaled (x : double) e : bpow radix2 (-1022) <= Rabs (B x * bpow radix2 e) ->
  rnd64 (B x * bpow radix2 e) = B x * bpow radix2 e.
Proof.
  intros H. rewrite rnd64_FLT. apply round_generic; auto with typeclass_instances.
  assert (generic_format radix2 (FLX_exp 53) (B x)) as F.
  { apply (generic_format_FLX_FLT radix2 (-1074)). apply format. }
  apply generic_format_FLT_FLX; [exact H|].
  apply FLX_format_generic in F; [|reflexivity]. destruct F as [f Hf Hm].
  apply generic_format_FLX. exists (Float radix2 (Fnum f) (Fexp f + e)); [|exact Hm].
  rewrite Hf. unfold F2R. simpl. rewrite bpow_plus. ring.
Qed.

Lemma rnd_scaled_up (x : double) e : (0 <= e)%Z -> rnd64 (B x * bpow radix2 e) = B x * bpow radix2 e.
Proof.
  intros He. rewrite rnd64_FLT. apply round_generic; auto with typeclass_instances.
  generalize (format x). intros F. apply FLT_format_generic in F; [|reflexivity]. destruct F as [f Hf Hm Hx].
  apply generic_format_FLT. exists (Float radix2 (Fnum f) (Fexp f + e)).
  - rewrite Hf. unfold F2R. simpl. rewrite bpow_plus. ring.
  - exact Hm.
  - simpl. lia.
Qed.

(* Literals are what they say. *)
Lemma literal_power e : (-1074 <= e <= 1023)%Z ->
  finite (literal (prec := 53) (emax := 1024) 1 e) /\ B (literal 1 e) = bpow radix2 e.
Proof.
  intros He. unfold literal.
  generalize (binary_normalize_correct 53 1024 _ _ mode_NE 1 e false). cbv zeta.
  change (round_mode mode_NE) with ZnearestE.
  replace (F2R (Float radix2 1 e)) with (bpow radix2 e) by (unfold F2R; simpl; ring).
  replace (round radix2 (SpecFloat.fexp 53 1024) ZnearestE (bpow radix2 e)) with (bpow radix2 e).
  2: { symmetry. apply round_generic; auto with typeclass_instances.
       apply generic_format_bpow. unfold SpecFloat.fexp, SpecFloat.emin. lia. }
  case Rlt_bool_spec; [tauto|].
  rewrite Rabs_pos_eq by apply bpow_ge_0. intros H. apply le_bpow in H. lia.
Qed.

Lemma literal_0 : finite (literal (prec := 53) (emax := 1024) 0 0) /\ B (literal 0 0) = 0.
Proof. split; reflexivity. Qed.

Lemma literal_2 : finite (literal (prec := 53) (emax := 1024) 2 0) /\ B (literal 2 0) = 2.
Proof.
  assert (literal (prec := 53) (emax := 1024) 2 0 = literal 1 1) as E by (apply B2SF_inj; reflexivity).
  rewrite E. destruct (literal_power 1) as [F V]; [lia|]. split; [exact F|]. rewrite V. reflexivity.
Qed.

(* The error bound in its most used form. *)
Lemma rnd_upper x : 0 <= x -> rnd64 x <= x * (1 + u) + lost.
Proof.
  intros H. generalize (rnd_error x). rewrite (Rabs_pos_eq x H). intros E.
  apply Rabs_le_inv in E. lra.
Qed.
Lemma rnd_lower x : 0 <= x -> x * (1 - u) - lost <= rnd64 x.
Proof.
  intros H. generalize (rnd_error x). rewrite (Rabs_pos_eq x H). intros E.
  apply Rabs_le_inv in E. lra.
Qed.

(* From here on a literal is known by its value. *)
Global Opaque literal.
