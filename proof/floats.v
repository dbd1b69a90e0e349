(* Numbers of IEEE 754 with every operation rounded to nearest, ties to even, as Flocq defines them, and
   what a finite result says about the real numbers behind it. *)
From Coq Require Import ZArith Reals Lra Bool.
From Flocq Require Import Core.Core IEEE754.BinarySingleNaN.

Global Instance double_prec : Prec_gt_0 53 := eq_refl.
Global Instance double_emax : Prec_lt_emax 53 1024 := eq_refl.

Notation double := (binary_float 53 1024).

Section Format.

Context {prec emax : Z} {Hprec : Prec_gt_0 prec} {Hemax : Prec_lt_emax prec emax}.
Notation number := (binary_float prec emax).

(* The names that kernels.v uses. *)
Definition add (x y : number) : number := Bplus mode_NE x y.
Definition sub (x y : number) : number := Bminus mode_NE x y.
Definition mul (x y : number) : number := Bmult mode_NE x y.
Definition div (x y : number) : number := Bdiv mode_NE x y.
Definition root (x : number) : number := Bsqrt mode_NE x.
Definition neg (x : number) : number := Bopp x.
Definition magnitude (x : number) : number := Babs x.
Definition less (x y : number) : bool := Bltb x y.
Definition at_most (x y : number) : bool := Bleb x y.
Definition equal (x y : number) : bool := Beqb x y.
Definition infinite (x : number) : bool :=
  match x with B754_infinity _ => true | _ => false end.
Definition infinity : number := B754_infinity false.
(* The number nearest to m 2^e. *)
Definition literal (m e : Z) : number := binary_normalize prec emax _ _ mode_NE m e false.

Notation fexp := (SpecFloat.fexp prec emax).
Definition rnd (x : R) : R := round radix2 fexp ZnearestE x.
Notation finite x := (is_finite x = true).

Lemma overflow_infinite (x : number) s : B2SF x = binary_overflow prec emax mode_NE s -> is_finite x = false.
Proof. destruct x; simpl; try discriminate; reflexivity. Qed.

Lemma add_finite x y : finite (add x y) -> finite x /\ finite y /\ B2R (add x y) = rnd (B2R x + B2R y).
Proof.
  intros H.
  assert (finite x /\ finite y) as [Hx Hy].
  { destruct x as [s|s| |s m e b], y as [t|t| |t n f c]; simpl in *; auto; try discriminate;
      destruct s, t; simpl in *; try discriminate; auto. }
  generalize (Bplus_correct prec emax _ _ mode_NE x y Hx Hy).
  destruct Rlt_bool; intros C; [tauto|].
  destruct C as [C _]. apply overflow_infinite in C. unfold add in H. congruence.
Qed.

Lemma sub_finite x y : finite (sub x y) -> finite x /\ finite y /\ B2R (sub x y) = rnd (B2R x - B2R y).
Proof.
  intros H.
  assert (finite x /\ finite y) as [Hx Hy].
  { destruct x as [s|s| |s m e b], y as [t|t| |t n f c]; simpl in *; auto; try discriminate;
      destruct s, t; simpl in *; try discriminate; auto. }
  generalize (Bminus_correct prec emax _ _ mode_NE x y Hx Hy).
  destruct Rlt_bool; intros C; [tauto|].
  destruct C as [C _]. apply overflow_infinite in C. unfold sub in H. congruence.
Qed.

Lemma mul_finite x y : finite (mul x y) -> finite x /\ finite y /\ B2R (mul x y) = rnd (B2R x * B2R y).
Proof.
  intros H.
  generalize (Bmult_correct prec emax _ _ mode_NE x y).
  destruct Rlt_bool; intros C.
  - destruct C as (E & F & _). unfold mul in *. rewrite F in H. apply andb_prop in H. tauto.
  - apply overflow_infinite in C. unfold mul in H. congruence.
Qed.

(* A quotient by infinity is zero. *)
Lemma div_finite x y : finite (div x y) -> B2R (div x y) <> 0%R ->
  finite x /\ finite y /\ B2R y <> 0%R /\ B2R (div x y) = rnd (B2R x / B2R y).
Proof.
  intros H N.
  assert (B2R y <> 0%R) as Hy.
  { intros Z. destruct x as [s|s| |s m e b], y as [t|t| |t n f c]; simpl in *; try discriminate; try congruence.
    all: apply eq_0_F2R in Z; destruct t; discriminate. }
  generalize (Bdiv_correct prec emax _ _ mode_NE x y Hy).
  destruct Rlt_bool; intros C.
  - destruct C as (E & F & _). unfold div in *. rewrite F in H.
    repeat split; auto. destruct y; simpl in *; auto; congruence.
  - apply overflow_infinite in C. unfold div in H. congruence.
Qed.

Lemma root_finite x : finite (root x) -> finite x /\ (0 <= B2R x)%R /\ B2R (root x) = rnd (sqrt (B2R x)).
Proof.
  intros H. destruct (Bsqrt_correct prec emax _ _ mode_NE x) as (E & F & _).
  unfold root in *. rewrite F in H. split; [|split; [|exact E]].
  - destruct x as [s|s| |s m e b]; try discriminate; auto.
  - destruct x as [s|s| |[|] m e b]; try discriminate; simpl; try apply Rle_refl.
    apply F2R_ge_0. simpl. apply Zle_0_pos.
Qed.

Lemma neg_finite x : finite (neg x) <-> finite x.
Proof. unfold neg. rewrite is_finite_Bopp. tauto. Qed.
Lemma neg_value x : B2R (neg x) = (- B2R x)%R.
Proof. apply B2R_Bopp. Qed.
Lemma magnitude_finite x : finite (magnitude x) <-> finite x.
Proof. unfold magnitude. rewrite is_finite_Babs. tauto. Qed.
Lemma magnitude_value x : B2R (magnitude x) = Rabs (B2R x).
Proof. apply B2R_Babs. Qed.

Lemma less_true x y : finite x -> finite y -> less x y = true -> (B2R x < B2R y)%R.
Proof.
  intros Hx Hy H. unfold less in H. rewrite Bltb_correct in H by assumption.
  revert H. case Rlt_bool_spec; [auto|discriminate].
Qed.
Lemma less_false x y : finite x -> finite y -> less x y = false -> (B2R y <= B2R x)%R.
Proof.
  intros Hx Hy H. unfold less in H. rewrite Bltb_correct in H by assumption.
  revert H. case Rlt_bool_spec; [discriminate|auto].
Qed.
Lemma at_most_true x y : finite x -> finite y -> at_most x y = true -> (B2R x <= B2R y)%R.
Proof.
  intros Hx Hy H. unfold at_most in H. rewrite Bleb_correct in H by assumption.
  revert H. case Rle_bool_spec; [auto|discriminate].
Qed.
Lemma at_most_false x y : finite x -> finite y -> at_most x y = false -> (B2R y < B2R x)%R.
Proof.
  intros Hx Hy H. unfold at_most in H. rewrite Bleb_correct in H by assumption.
  revert H. case Rle_bool_spec; [discriminate|auto].
Qed.

Lemma value_format (x : number) : generic_format radix2 fexp (B2R x).
Proof. apply generic_format_B2R. Qed.

Lemma rnd_value (x : number) : rnd (B2R x) = B2R x.
Proof. apply round_generic; [apply valid_rnd_N|apply value_format]. Qed.

Instance fexp_valid : Valid_exp fexp.
Proof. apply (fexp_correct prec emax). exact Hprec. Qed.

Lemma rnd_le x y : (x <= y)%R -> (rnd x <= rnd y)%R.
Proof. apply round_le; [apply fexp_valid|apply valid_rnd_N]. Qed.

Lemma rnd_0 : rnd 0 = 0%R.
Proof. apply round_0. apply valid_rnd_N. Qed.

End Format.

Notation finite x := (is_finite x = true).

Declare Scope float_scope.
Delimit Scope float_scope with float.
Infix "+" := add : float_scope.
Infix "-" := sub : float_scope.
Infix "*" := mul : float_scope.
Infix "/" := div : float_scope.
Notation "- x" := (neg x) : float_scope.
Infix "<?" := less : float_scope.
Infix "<=?" := at_most : float_scope.
Infix "=?" := equal : float_scope.
