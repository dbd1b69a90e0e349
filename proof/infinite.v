(* When operations give infinity, or no number. *)
From Coq Require Import ZArith Reals Lra Lia Bool.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats rounding.
Open Scope R_scope.

Lemma finite_not_nan (x : double) : finite x -> is_nan x = false.
Proof. destruct x; try discriminate; reflexivity. Qed.

Definition not_negative (x : double) : Prop := is_nan x = true \/ Bsign x = false.

Lemma overflow_value (x : double) s : B2SF x = binary_overflow 53 1024 mode_NE s -> x = B754_infinity s.
Proof.
  unfold binary_overflow. change (overflow_to_inf mode_NE s) with true. cbv iota.
  destruct x as [t|t| |t m e H]; simpl; intros E; try discriminate. injection E as ->. reflexivity.
Qed.

Lemma not_negative_value (x : double) : finite x -> 0 <= B x -> B x = 0 \/ Bsign x = false.
Proof.
  destruct x as [s|s| |[|] m e H]; simpl; intros F L; try discriminate; auto.
  exfalso. apply (Rlt_not_le _ _ (F2R_lt_0 radix2 (Float radix2 (Z.neg m) e) eq_refl)). exact L.
Qed.
Lemma value_not_negative (x : double) : finite x -> Bsign x = false -> 0 <= B x.
Proof.
  destruct x as [s|s| |[|] m e H]; simpl; intros F L; try discriminate; try lra.
  apply F2R_ge_0. simpl. lia.
Qed.

Lemma mul_not_negative (x y : double) : not_negative x -> not_negative y -> not_negative (x * y)%float.
Proof.
  intros [Nx|Sx] [Ny|Sy].
  1-3: left; destruct x, y; try discriminate; reflexivity.
  destruct (is_nan (x * y)%float) eqn:N; [left; exact N|right].
  generalize (Bmult_correct 53 1024 _ _ mode_NE x y). destruct Rlt_bool.
  - intros (_ & _ & E). fold (mul x y) in E. rewrite E by exact N. rewrite Sx, Sy. reflexivity.
  - intros E. apply overflow_value in E. fold (mul x y) in E. rewrite E, Sx, Sy. reflexivity.
Qed.
Lemma square_not_negative (x : double) : not_negative (x * x)%float.
Proof.
  destruct (is_nan (x * x)%float) eqn:N; [left; exact N|right].
  generalize (Bmult_correct 53 1024 _ _ mode_NE x x). destruct Rlt_bool.
  - intros (_ & _ & E). fold (mul x x) in E. rewrite E by exact N. apply xorb_nilpotent.
  - intros E. apply overflow_value in E. fold (mul x x) in E. rewrite E. apply xorb_nilpotent.
Qed.
Lemma add_not_negative (x y : double) : not_negative x -> not_negative y -> not_negative (x + y)%float.
Proof.
  intros [Nx|Sx] [Ny|Sy].
  1-3: left; destruct x, y; try discriminate; reflexivity.
  destruct (is_finite x) eqn:Fx; [destruct (is_finite y) eqn:Fy|].
  - right. generalize (Bplus_correct 53 1024 _ _ mode_NE x y Fx Fy). destruct Rlt_bool.
    + intros (_ & _ & E). fold (add x y) in E. rewrite E.
      assert (0 <= B x + B y) by (generalize (value_not_negative x Fx Sx) (value_not_negative y Fy Sy); lra).
      case Rcompare_spec; intros; try lra; try reflexivity. rewrite Sx, Sy. reflexivity.
    + intros [E _]. apply overflow_value in E. fold (add x y) in E. rewrite E, Sx. reflexivity.
  - right. destruct x as [s|s| |s m e H], y as [t|t| |t n f K]; try discriminate; simpl in *; try congruence; subst; reflexivity.
  - right. destruct x as [s|s| |s m e H], y as [t|t| |t n f K]; try discriminate; simpl in *; try congruence; subst; reflexivity.
Qed.

Lemma sum_not_minus_infinity (x y : double) :
  finite x -> not_negative y -> (x + y)%float <> B754_infinity true.
Proof.
  intros Fx Ny E. destruct (is_finite y) eqn:Fy.
  2: { destruct x as [s|s| |s m e H], y as [t|t| |t n f K]; try discriminate; simpl in *;
       destruct Ny as [N|N]; simpl in N; try discriminate; subst; discriminate. }
  destruct Ny as [N|Sy]; [destruct y; discriminate|].
  generalize (value_not_negative y Fy Sy). intros Py.
  generalize (Bplus_correct 53 1024 _ _ mode_NE x y Fx Fy). fold (add x y). rewrite E.
  case Rlt_bool_spec; intros _ C; [destruct C as (_ & C & _); discriminate|].
  destruct C as [C S]. rewrite Sy in S. rewrite S in C. discriminate.
Qed.

Lemma difference_minus_infinity (x y : double) :
  not_negative x -> (x - y)%float = B754_infinity true -> finite x /\ y = B754_infinity false.
Proof.
  intros Nx E.
  destruct (is_finite x) eqn:Fx; [destruct (is_finite y) eqn:Fy|].
  - exfalso. destruct Nx as [N|Sx]; [destruct x; discriminate|].
    generalize (Bminus_correct 53 1024 _ _ mode_NE x y Fx Fy). fold (sub x y). rewrite E.
    case Rlt_bool_spec; intros _ C; [destruct C as (_ & C & _); discriminate|].
    destruct C as [C _]. rewrite Sx in C. discriminate.
  - split; [reflexivity|].
    destruct x as [s|s| |s m e H], y as [[|]|[|]| |[|] n f K]; try discriminate; reflexivity.
  - exfalso. destruct x as [s|s| |s m e H], y as [t|t| |t n f K]; try discriminate; simpl in *;
      destruct Nx as [N|N]; simpl in N; try discriminate; subst; try discriminate; destruct t; discriminate.
Qed.

Lemma literal_sign e : (-1074 <= e <= 1023)%Z -> Bsign (literal (prec := 53) (emax := 1024) 1 e) = false.
Proof.
  intros He. destruct (literal_power e He) as [F V].
  destruct (not_negative_value _ F) as [Z|S]; [rewrite V; apply bpow_ge_0| |exact S].
  rewrite V in Z. generalize (bpow_gt_0 radix2 e). lra.
Qed.

(* A part of a finite number is finite. *)
Lemma scaled_finite (t : double) e : finite t -> (-1074 <= e <= 0)%Z ->
  finite (t * literal 1 e)%float /\ Bsign (t * literal 1 e)%float = Bsign t.
Proof.
  intros F He. destruct (literal_power e) as [FL VL]; [lia|].
  generalize (Bmult_correct 53 1024 _ _ mode_NE t (literal 1 e)). fold (mul t (literal 1 e)).
  case Rlt_bool_spec.
  - intros _ (_ & Fm & Sm). rewrite F, FL in Fm. change (true && true)%bool with true in Fm.
    split; [exact Fm|]. rewrite Sm by (apply finite_not_nan; exact Fm).
    rewrite literal_sign by lia. apply xorb_false_r.
  - intros O _. exfalso. rewrite VL in O. revert O. apply Rlt_not_le.
    apply Rle_lt_trans with (Rabs (B t)); [|apply abs_B2R_lt_emax].
    change (round radix2 (SpecFloat.fexp 53 1024) (round_mode mode_NE) (B t * bpow radix2 e))
      with (rnd64 (B t * bpow radix2 e)).
    rewrite rnd64_FLT. apply abs_round_le_generic; auto with typeclass_instances.
    + apply generic_format_abs, format.
    + rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 e)) by apply bpow_ge_0.
      assert (bpow radix2 e <= 1) by (change 1 with (bpow radix2 0); apply bpow_le; lia).
      generalize (Rabs_pos (B t)). generalize (bpow_ge_0 radix2 e). nra.
Qed.

Lemma sign_of_negative (t : double) : Bsign t = true -> B t <= 0.
Proof.
  destruct t as [s|s| |[|] m e H]; simpl; intros E; try lra; try discriminate.
  apply F2R_le_0. simpl. lia.
Qed.
