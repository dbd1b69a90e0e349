(* rounding::sum_down is never above the exact sum, and rounding::sum_up never below it. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core Relative Plus_error BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding.
Open Scope R_scope.

Theorem sum_down_is_below (a b : double) :
  finite (sum_down a b) -> finite a /\ finite b /\ B (sum_down a b) <= B a + B b.
Proof.
  unfold sum_down. cbv zeta.
  destruct (infinite a) eqn:Ia.
  { intros H. apply add_finite in H. destruct a; try discriminate. destruct H; discriminate. }
  destruct (infinite b) eqn:Ib.
  { intros H. apply add_finite in H. destruct b; try discriminate. destruct H as (_ & H & _). discriminate. }
  intros H. apply sub_finite in H. destruct H as (Fs & Ft & E).
  rewrite E. clear E.
  apply mul_finite in Ft. destruct Ft as (_ & _ & Et). rewrite Et, magnitude_value. clear Et.
  destruct (literal_power (-52)) as [_ ->]; [lia|].
  apply add_finite in Fs. destruct Fs as (Fa & Fb & Es). split; [exact Fa|]. split; [exact Fb|].
  generalize (format (add a b)). rewrite Es. set (x := B a + B b). set (s := rnd64 x). intros Gs.
  assert (0 <= rnd64 (Rabs s * bpow radix2 (-52))) as Pt.
  { apply rnd_nonneg. apply Rmult_le_pos; [apply Rabs_pos|apply bpow_ge_0]. }
  assert (rnd64 s = s) as Rs by (rewrite rnd64_FLT; apply round_generic; auto with typeclass_instances).
  destruct (Rle_or_lt (Rabs x) (bpow radix2 (-1021))) as [Small|Large].
  - assert (s = x) as Ex.
    { unfold s. rewrite rnd64_FLT. apply round_generic; auto with typeclass_instances.
      apply FLT_format_plus_small; auto with typeclass_instances; apply format. }
    rewrite <- Ex. rewrite <- Rs at 3. apply rnd_le. lra.
  - assert (bpow radix2 (-1022) <= Rabs s) as Ls.
    { generalize (rnd_relative x). fold s. intros G.
      assert (Rabs (s - x) <= u * Rabs x) as Er.
      { apply G. apply Rlt_le, Rle_lt_trans with (2 := Large). apply bpow_le. lia. }
      assert (Rabs x - Rabs s <= Rabs (s - x)) by (rewrite Rabs_minus_sym; apply Rabs_triang_inv).
      replace (bpow radix2 (-1022)) with (bpow radix2 (-1021) * / 2)
        by (change (-1022)%Z with (-1021 + -1)%Z; rewrite bpow_plus; reflexivity).
      rewrite u_value in *. generalize (bpow_ge_0 radix2 (-1021)). lra. }
    assert (ulp radix2 fexp s <= rnd64 (Rabs s * bpow radix2 (-52))) as Lt.
    { assert (rnd64 (ulp radix2 fexp s) = ulp radix2 fexp s) as <-.
      { rewrite rnd64_FLT; apply round_generic; auto with typeclass_instances.
        apply generic_format_ulp; auto with typeclass_instances. }
      apply rnd_le. apply ulp_FLT_le. exact Ls. }
    assert (s - ulp radix2 fexp s <= pred radix2 fexp s) as Lp.
    { unfold pred. generalize (succ_le_plus_ulp radix2 fexp (- s)).
      rewrite ulp_opp. unfold Rminus. lra. }
    assert (generic_format radix2 fexp (pred radix2 fexp s)) as Gp
      by (apply generic_format_pred; auto with typeclass_instances).
    assert (rnd64 (pred radix2 fexp s) = pred radix2 fexp s) as Rp
      by (rewrite rnd64_FLT; apply round_generic; auto with typeclass_instances).
    apply Rle_trans with (pred radix2 fexp s).
    + rewrite <- Rp. apply rnd_le. lra.
    + apply Rnot_lt_le. intros L.
      assert (s <= pred radix2 fexp s) as W.
      { rewrite <- Rp at 1. apply (rnd_le (prec := 53) (emax := 1024) x). lra. }
      assert (pred radix2 fexp s < s); [|lra].
      apply pred_lt_id. intros Z. rewrite Z, Rabs_R0 in Ls. generalize (bpow_gt_0 radix2 (-1022)). lra.
Qed.

Theorem sum_up_is_above (a b : double) :
  finite (sum_up a b) -> finite a /\ finite b /\ B a + B b <= B (sum_up a b).
Proof.
  assert (sum_up a b = neg (sum_down (neg a) (neg b))) as ->.
  { unfold sum_up, sum_down. cbv zeta. destruct (infinite (neg a)); [reflexivity|]. destruct (infinite (neg b)); reflexivity. }
  rewrite neg_finite. intros F. destruct (sum_down_is_below _ _ F) as (Fa & Fb & L). rewrite !neg_finite in *.
  rewrite !neg_value in *. split; [exact Fa|]. split; [exact Fb|]. lra.
Qed.
