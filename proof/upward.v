(* Numbers that are not below zero, infinity and what is no number among them; and when operations overflow. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic first_crossing errors.
From Kinesphere Require Import meeting_parts meeting_errors direction magnitudes meeting_facts.
From Kinesphere Require Import meeting_margins meeting_coefficients.
Open Scope R_scope.

(* Not below zero, or not a number. *)
Definition upward (x : double) : Prop := is_nan x = true \/ x = infinity \/ (finite x /\ 0 <= B x).

Lemma upward_finite (x : double) : upward x -> finite x -> 0 <= B x.
Proof. intros [N|[->|[_ P]]] F; [destruct x; discriminate|discriminate|exact P]. Qed.

Lemma sign_zero (x : double) : 0 <= B x -> Bsign x = true -> B x = 0.
Proof. intros P S. apply sign_of_negative in S. lra. Qed.

Lemma upward_add (x y : double) : upward x -> upward y -> upward (x + y)%float.
Proof.
  intros [Nx|[->|[Fx Px]]] [Ny|[->|[Fy Py]]].
  1-3: left; destruct x; try discriminate; try (destruct y; reflexivity); reflexivity.
  1: left; destruct y; try discriminate; reflexivity.
  1: right; left; reflexivity.
  1: right; left; destruct y; try discriminate; reflexivity.
  1: left; destruct y; try discriminate; destruct x; reflexivity.
  1: right; left; destruct x; try discriminate; reflexivity.
  generalize (Bplus_correct 53 1024 _ _ mode_NE x y Fx Fy). fold (add x y). case Rlt_bool_spec.
  - intros _ (E & F & _). right; right. split; [exact F|]. rewrite E. apply rnd_nonneg. lra.
  - intros O (E & S). right; left. destruct (Bsign x) eqn:Sx; [|apply overflow_value in E; exact E].
    exfalso. rewrite (sign_zero x Px Sx), (sign_zero y Py (eq_sym S)), Rplus_0_r, round_0, Rabs_R0 in O by apply valid_rnd_N.
    generalize (bpow_gt_0 radix2 1024). lra.
Qed.

Lemma infinity_times (y : double) : finite y -> 0 <= B y ->
  is_nan (infinity * y)%float = true \/ (infinity * y)%float = infinity.
Proof.
  destruct y as [s|s| |[|] m e H]; intros F P; try discriminate.
  - left; reflexivity.
  - exfalso. apply (Rlt_not_le _ _ (F2R_lt_0 radix2 (Float radix2 (Z.neg m) e) eq_refl)). exact P.
  - right; reflexivity.
Qed.

Lemma upward_mul (x y : double) : upward x -> upward y -> upward (x * y)%float.
Proof.
  intros [Nx|[->|[Fx Px]]] [Ny|[->|[Fy Py]]].
  1-3: left; destruct x; try discriminate; try (destruct y; reflexivity); reflexivity.
  1: left; destruct y; try discriminate; reflexivity.
  1: right; left; reflexivity.
  1: destruct (infinity_times y Fy Py) as [N|N]; [left; exact N|right; left; exact N].
  1: left; destruct y; try discriminate; destruct x; reflexivity.
  - destruct x as [s|s| |[|] m e H]; try discriminate; [left; reflexivity| |right; left; reflexivity].
    exfalso. apply (Rlt_not_le _ _ (F2R_lt_0 radix2 (Float radix2 (Z.neg m) e) eq_refl)). exact Px.
  - generalize (Bmult_correct 53 1024 _ _ mode_NE x y). fold (mul x y). case Rlt_bool_spec.
    + intros _ (E & F & _). rewrite Fx, Fy in F. right; right. split; [exact F|]. rewrite E.
      apply rnd_nonneg. apply Rmult_le_pos; assumption.
    + intros O E. right; left. apply overflow_value in E. rewrite E.
      assert (B x * B y <> 0) as NZ.
      { intros Z. rewrite Z, round_0, Rabs_R0 in O by apply valid_rnd_N. generalize (bpow_gt_0 radix2 1024). lra. }
      assert (Bsign x = false) as ->.
      { destruct (Bsign x) eqn:S; [|reflexivity]. exfalso. apply NZ. rewrite (sign_zero x Px S). ring. }
      assert (Bsign y = false) as ->.
      { destruct (Bsign y) eqn:S; [|reflexivity]. exfalso. apply NZ. rewrite (sign_zero y Py S). ring. }
      reflexivity.
Qed.

Lemma upward_not_less (x : double) : less x (literal 0 0) = false -> upward x.
Proof.
  intros L. destruct (is_finite x) eqn:F; [right; right; split; [exact F|apply not_less_0; assumption]|].
  destruct x as [s|[|]| |s m e H]; try discriminate; [right; left|left]; reflexivity.
Qed.

Lemma upward_power e : (-1074 <= e <= 1023)%Z -> upward (literal 1 e).
Proof. intros He. destruct (literal_power e He) as [F V]. right; right. rewrite V. split; [exact F|apply bpow_ge_0]. Qed.

Lemma upward_magnitude (x : double) : upward (magnitude x).
Proof.
  destruct (is_finite x) eqn:F.
  - right; right. rewrite magnitude_value. split; [apply magnitude_finite; exact F|apply Rabs_pos].
  - destruct x; try discriminate; [right; left|left]; reflexivity.
Qed.

Lemma upward_elapsed (from t : double) : less from t = false -> upward (from - t)%float.
Proof.
  intros L. destruct (is_finite from) eqn:Ff; [destruct (is_finite t) eqn:Ft|].
  - apply less_false in L; try assumption.
    generalize (Bminus_correct 53 1024 _ _ mode_NE from t Ff Ft). fold (sub from t). case Rlt_bool_spec.
    + intros _ (E & F & _). right; right. split; [exact F|]. rewrite E. apply rnd_nonneg. lra.
    + intros O (E & S). right; left. destruct (Bsign from) eqn:Sf; [|apply overflow_value in E; exact E].
      exfalso. apply sign_of_negative in Sf. assert (0 <= B t).
      { apply value_not_negative; [exact Ft|]. destruct (Bsign t); [discriminate|reflexivity]. }
      assert (B from - B t = 0) as Z by lra.
      rewrite Z, round_0, Rabs_R0 in O by apply valid_rnd_N. generalize (bpow_gt_0 radix2 1024). lra.
  - destruct from as [s|s| |s m e H], t as [q|[|]| |q n f K]; try discriminate;
      solve [left; reflexivity | right; left; reflexivity | destruct s; discriminate].
  - destruct from as [s|[|]| |s m e H], t as [q|[|]| |q n f K]; try discriminate;
      solve [left; reflexivity | right; left; reflexivity].
Qed.

Lemma upward_widened (x : double) : upward x -> upward (widened x).
Proof.
  intros U. unfold widened. destruct less; apply upward_add; try exact U; [apply upward_power; lia|].
  right; right. split; [reflexivity|rewrite (proj2 literal_0); lra].
Qed.

Lemma upward_capped (x : double) : upward x -> upward (capped x).
Proof. intros U. unfold capped. destruct at_most; [exact U|right; left; reflexivity]. Qed.

(* A difference that is +infinity. *)
Lemma infinite_difference (x y : double) : upward y -> (x - y)%float = infinity -> finite y /\ x = infinity.
Proof.
  intros U E. assert (finite y) as Fy.
  { destruct U as [N|[->|[F _]]]; [| |exact F]; exfalso.
    - destruct y; try discriminate. destruct x; discriminate.
    - destruct x as [s|[|]| |s m e H]; discriminate. }
  split; [exact Fy|].
  destruct (is_finite x) eqn:Fx.
  2: { destruct x as [s|[|]| |s m e H]; try discriminate; [|reflexivity]. destruct y; discriminate. }
  exfalso. assert (Py := upward_finite y U Fy).
  generalize (Bminus_correct 53 1024 _ _ mode_NE x y Fx Fy). fold (sub x y). rewrite E.
  case Rlt_bool_spec; intros O C; [destruct C as (_ & C & _); discriminate|].
  destruct C as [C S]. destruct (Bsign x) eqn:Sx; [discriminate C|].
  assert (Bsign y = true) as Sy by (destruct (Bsign y); [reflexivity|discriminate]).
  rewrite (sign_zero y Py Sy), Rminus_0_r in O. revert O. apply Rlt_not_le.
  change (Rabs (rnd64 (B x)) < bpow radix2 1024). rewrite rnd_value. apply abs_B2R_lt_emax.
Qed.

(* The largest number. *)
Lemma hardly_more (x : double) (e : R) : 0 <= e <= bpow radix2 960 -> finite x -> B x <= 0 ->
  rnd64 (e - B x) < bpow radix2 1024.
Proof.
  intros [Pe Le] F Nx.
  set (m := bpow radix2 1024 - bpow radix2 (1024 - 53)).
  assert (- B x <= m) as LM.
  { generalize (abs_B2R_le_emax_minus_prec 53 1024 _ x). rewrite Rabs_left1 by exact Nx. auto. }
  assert (generic_format radix2 fexp m) as FM.
  { replace m with (F2R (Float radix2 (2 ^ 53 - 1) (1024 - 53))).
    - apply generic_format_F2R. intros _. unfold cexp.
      rewrite mag_F2R by discriminate.
      replace (mag radix2 (IZR (2 ^ 53 - 1)) : Z) with 53%Z; [unfold FLT_exp; lia|].
      symmetry. apply mag_unique. rewrite Rabs_pos_eq by (apply IZR_le; lia).
      rewrite <- !IZR_Zpower by lia. split; [apply IZR_le|apply IZR_lt]; simpl; lia.
    - change (IZR (2 ^ 53 - 1) * bpow radix2 (1024 - 53) = m). unfold m.
      assert (IZR (2 ^ 53 - 1) = bpow radix2 53 - 1) as -> by (simpl; lra).
      rewrite Rmult_minus_distr_r, Rmult_1_l, <- bpow_plus. reflexivity. }
  assert (0 < bpow radix2 960 /\ bpow radix2 960 * 4 <= bpow radix2 (1024 - 53)) as [P9 L9].
  { split; [apply bpow_gt_0|]. change 4 with (bpow radix2 2). rewrite <- bpow_plus. apply bpow_le. lia. }
  destruct (Rle_or_lt (e - B x) m) as [L|L].
  - apply Rle_lt_trans with m; [|unfold m; lra].
    rewrite rnd64_FLT. apply round_le_generic; auto with typeclass_instances.
  - destruct (round_N_pt radix2 fexp (fun n => negb (Z.even n)) (e - B x)) as [_ Near].
    specialize (Near m FM). rewrite rnd64_FLT.
    apply Rabs_le_inv in Near. unfold m in *.
    assert (Rabs (bpow radix2 1024 - bpow radix2 (1024 - 53) - (e - B x)) <= e).
    { rewrite Rabs_left1; lra. }
    lra.
Qed.

Lemma length_not_more (x y z : double) : finite (length_of x y z) -> 0 <= B (length_of x y z) <= bpow radix2 512.
Proof.
  intros F. destruct (root_finite _ F) as (Fs & Ps & E). unfold length_of. rewrite E.
  split; [apply rnd_nonneg, sqrt_pos|]. apply rnd_le_bpow; [lia|].
  rewrite <- (sqrt_square (bpow radix2 512)) by apply bpow_ge_0. apply sqrt_le_1_alt.
  rewrite <- bpow_plus. apply Rlt_le. eapply Rle_lt_trans; [apply Rle_abs|]. apply abs_B2R_lt_emax.
Qed.

(* A sum that is not above by much. *)
Lemma infinite_reach (x y l : double) : upward x -> finite y -> (finite l -> 0 <= B l <= bpow radix2 512) ->
  (l - (x + y))%float = infinity -> l = infinity.
Proof.
  intros Ux Fy HL E2.
  assert (finite (x + y)%float) as Fr.
  { destruct (is_finite (x + y)%float) eqn:F; [reflexivity|exfalso].
    destruct Ux as [N|[->|[Fx Px]]].
    - destruct x; try discriminate. destruct l; discriminate.
    - destruct y as [q|q| |q m e HH]; try discriminate; destruct l as [p|[|]| |p n f K]; discriminate.
    - generalize (Bplus_correct 53 1024 _ _ mode_NE x y Fx Fy). fold (add x y).
      case Rlt_bool_spec; intros O C; [destruct C as (_ & C & _); rewrite C in F; discriminate|].
      destruct C as [C S]. apply overflow_value in C. rewrite C in E2. destruct (Bsign x) eqn:Sx.
      + rewrite (sign_zero _ Px Sx), Rplus_0_l in O. revert O. apply Rlt_not_le.
        change (Rabs (rnd64 (B y)) < bpow radix2 1024). rewrite rnd_value. apply abs_B2R_lt_emax.
      + destruct l as [q|[|]| |q m e HH]; discriminate. }
  set (q := (x + y)%float) in *. clearbody q.
  destruct (is_finite l) eqn:Fl.
  2: { destruct l as [p|[|]| |p m e HH]; try discriminate; try reflexivity; destruct q; discriminate. }
  exfalso. specialize (HL eq_refl).
  generalize (Bminus_correct 53 1024 _ _ mode_NE l q Fl Fr). fold (sub l q). rewrite E2.
  case Rlt_bool_spec; intros O C; [destruct C as (_ & C & _); discriminate|].
  destruct C as [C S]. destruct (Bsign l) eqn:Sl; [discriminate C|].
  assert (Bsign q = true) as Sq by (destruct (Bsign q); [reflexivity|discriminate]).
  apply sign_of_negative in Sq. revert O. apply Rlt_not_le.
  change (Rabs (rnd64 (B l - B q)) < bpow radix2 1024).
  rewrite Rabs_pos_eq by (apply rnd_nonneg; lra). apply hardly_more; [|exact Fr|exact Sq].
  split; [lra|]. apply Rle_trans with (bpow radix2 512); [lra|apply bpow_le; lia].
Qed.

Lemma below_zero (x m : double) : finite (x - m)%float -> 0 <= B (x - m)%float -> B x <= 0 -> B m <= 0.
Proof.
  intros F P N. destruct (sub_finite _ _ F) as (_ & _ & E). rewrite E in P.
  apply Rnot_lt_le. intros L.
  assert (rnd64 (B x - B m) <= rnd64 (B (neg m))) as W by (apply rnd_le; rewrite neg_value; lra).
  rewrite rnd_value, neg_value in W. lra.
Qed.

Lemma sum_above (x y : double) : finite (x + y)%float -> 0 <= B y -> B x <= B (x + y)%float.
Proof.
  intros F P. destruct (add_finite _ _ F) as (_ & _ & E). rewrite E. rewrite <- (rnd_value x) at 1. apply rnd_le. lra.
Qed.

(* What is left of a product with a quotient by infinity. *)
Lemma quotient_by_infinity (x w : double) : finite (x / infinity * w)%float -> finite x /\ B (x / infinity * w)%float = 0.
Proof.
  intros F. destruct (mul_finite _ _ F) as (Fq & _ & E). rewrite E.
  assert (finite x /\ B (x / infinity)%float = 0) as [Fx Z].
  { clear E F. destruct x as [q|q| |q m e HH]; try discriminate; split; reflexivity. }
  split; [exact Fx|]. rewrite Z, Rmult_0_l. apply rnd_0.
Qed.

Lemma small_product (x y : double) : finite x -> finite y -> Rabs (B x) <= bpow radix2 490 -> Rabs (B y) <= bpow radix2 490 ->
  finite (x * y)%float /\ Rabs (B (x * y)%float) <= bpow radix2 980.
Proof.
  intros Fx Fy Lx Ly.
  assert (Rabs (rnd64 (B x * B y)) <= bpow radix2 980) as W.
  { rewrite rnd64_FLT. apply abs_round_le_generic; auto with typeclass_instances.
    - apply generic_format_bpow. unfold FLT_exp. lia.
    - change 980%Z with (490 + 490)%Z. rewrite bpow_plus, Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos. }
  generalize (Bmult_correct 53 1024 _ _ mode_NE x y). fold (mul x y). case Rlt_bool_spec.
  - intros _ (E & F & _). rewrite Fx, Fy in F. split; [exact F|]. rewrite E. exact W.
  - intros O _. exfalso. revert O. apply Rlt_not_le. eapply Rle_lt_trans; [exact W|]. apply bpow_lt. lia.
Qed.

Lemma small_sum (x y : double) e : (-1074 <= e <= 1000)%Z -> finite x -> finite y -> Rabs (B x) <= bpow radix2 e ->
  Rabs (B y) <= bpow radix2 e -> finite (x + y)%float /\ Rabs (B (x + y)%float) <= bpow radix2 (1 + e).
Proof.
  intros He Fx Fy Lx Ly.
  assert (Rabs (rnd64 (B x + B y)) <= bpow radix2 (1 + e)) as W.
  { rewrite rnd64_FLT. apply abs_round_le_generic; auto with typeclass_instances.
    - apply generic_format_bpow. unfold FLT_exp. lia.
    - rewrite bpow_plus. change (bpow radix2 1) with 2. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  generalize (Bplus_correct 53 1024 _ _ mode_NE x y Fx Fy). fold (add x y). case Rlt_bool_spec.
  - intros _ (E & F & _). split; [exact F|]. rewrite E. exact W.
  - intros O _. exfalso. revert O. apply Rlt_not_le. eapply Rle_lt_trans; [exact W|]. apply bpow_lt. lia.
Qed.

Lemma small_length (x y z : double) : finite x -> finite y -> finite z -> Rabs (B x) <= bpow radix2 490 ->
  Rabs (B y) <= bpow radix2 490 -> Rabs (B z) <= bpow radix2 490 -> length_of x y z <> infinity.
Proof.
  intros Fx Fy Fz Lx Ly Lz E.
  destruct (small_product x x) as [F1 L1]; try assumption. destruct (small_product y y) as [F2 L2]; try assumption.
  destruct (small_product z z) as [F3 L3]; try assumption.
  destruct (small_sum (x * x)%float (y * y)%float 980) as [F4 L4]; try assumption; [lia|].
  destruct (small_sum (x * x + y * y)%float (z * z)%float 981) as [F5 _]; try assumption; [lia| |].
  { eapply Rle_trans; [exact L3|]. apply bpow_le. lia. }
  unfold length_of in E.
  destruct (Bsqrt_correct 53 1024 _ _ mode_NE (x * x + y * y + z * z)%float) as (_ & F & _). fold (root (x * x + y * y + z * z)%float) in F.
  rewrite E in F. destruct (x * x + y * y + z * z)%float as [q|q| |[|] m e HH]; try discriminate.
Qed.


Lemma rnd_nonpos (x : R) : x <= 0 -> rnd64 x <= 0.
Proof.
  intros N. apply (rnd_le (prec := 53) (emax := 1024)) in N. rewrite rnd_0 in N. exact N.
Qed.
