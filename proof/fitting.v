(* What an operation gives that does not overflow, in any precision, and lengths of vectors. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats errors direction.
Open Scope R_scope.

Section Forward.

Context {prec emax : Z} {Hprec : Prec_gt_0 prec} {Hemax : Prec_lt_emax prec emax}.
Notation number := (binary_float prec emax).
Notation B := (B2R (prec := prec) (emax := emax)).
Notation rounded := (rnd (prec := prec) (emax := emax)).
Notation v := (roundoff (prec := prec)).
Notation low := (least (emax := emax)).

(* A result of at most this much is finite. *)
Definition fits (x : R) : Prop := Rabs x + v * (Rabs x + low) < bpow radix2 emax.

Lemma fits_rounded x : fits x -> Rabs (rounded x) < bpow radix2 emax.
Proof.
  unfold fits. intros H. generalize (rounded_error (prec := prec) (emax := emax) x). intros E.
  replace (rounded x) with ((rounded x - x) + x) by ring.
  eapply Rle_lt_trans; [apply Rabs_triang|]. lra.
Qed.

Lemma add_fits (x y : number) : finite x -> finite y -> fits (B x + B y) -> finite (add x y).
Proof.
  intros Fx Fy H. generalize (Bplus_correct prec emax _ _ mode_NE x y Fx Fy).
  change (round_mode mode_NE) with ZnearestE. apply fits_rounded in H.
  rewrite Rlt_bool_true by exact H. tauto.
Qed.
Lemma sub_fits (x y : number) : finite x -> finite y -> fits (B x - B y) -> finite (sub x y).
Proof.
  intros Fx Fy H. generalize (Bminus_correct prec emax _ _ mode_NE x y Fx Fy).
  change (round_mode mode_NE) with ZnearestE. apply fits_rounded in H.
  rewrite Rlt_bool_true by exact H. tauto.
Qed.
Lemma mul_fits (x y : number) : finite x -> finite y -> fits (B x * B y) -> finite (mul x y).
Proof.
  intros Fx Fy H. generalize (Bmult_correct prec emax _ _ mode_NE x y).
  change (round_mode mode_NE) with ZnearestE. apply fits_rounded in H.
  rewrite Rlt_bool_true by exact H. rewrite Fx, Fy. tauto.
Qed.
Lemma div_fits (x y : number) : finite x -> B y <> 0 -> fits (B x / B y) ->
  finite (div x y) /\ B (div x y) = rounded (B x / B y).
Proof.
  intros Fx Ny H. generalize (Bdiv_correct prec emax _ _ mode_NE x y Ny).
  change (round_mode mode_NE) with ZnearestE. apply fits_rounded in H.
  rewrite Rlt_bool_true by exact H. intros (E & F & _). fold (div x y) in *. rewrite F. auto.
Qed.

Lemma overflow_to (x : number) s : B2SF x = binary_overflow prec emax mode_NE s -> x = B754_infinity s.
Proof.
  unfold binary_overflow. change (overflow_to_inf mode_NE s) with true. cbv iota.
  destruct x as [t|t| |t m e H]; simpl; intros E; try discriminate. injection E as ->. reflexivity.
Qed.

Lemma square_not_below (x : number) : mul x x <> B754_infinity true.
Proof.
  intros E. generalize (Bmult_correct prec emax _ _ mode_NE x x). fold (mul x x). rewrite E.
  destruct Rlt_bool; intros C.
  - destruct C as (_ & F & _). destruct x as [s|s| |s m e H]; try discriminate E; try discriminate F; destruct s; discriminate E.
  - apply overflow_to in C. destruct (Bsign x); discriminate C.
Qed.

End Forward.

(* Vectors. *)
Lemma norm_triangle x y z x' y' z' : norm (x + x') (y + y') (z + z') <= norm x y z + norm x' y' z'.
Proof.
  destruct (norm_square (x + x') (y + y') (z + z')) as [E P].
  destruct (norm_square x y z) as [E1 P1]. destruct (norm_square x' y' z') as [E2 P2].
  assert (x * x' + y * y' + z * z' <= norm x y z * norm x' y' z') as C.
  { destruct (Rle_lt_or_eq_dec _ _ P2) as [L|Z].
    - set (N := norm x' y' z') in *.
      assert (x * (x' / N) + y * (y' / N) + z * (z' / N) <= norm x y z) as A.
      { apply norm_above. right. transitivity ((x' * x' + y' * y' + z' * z') / (N * N)); [field; lra|].
        rewrite <- E2. field. lra. }
      apply (Rmult_le_compat_r N) in A; [|lra].
      replace ((x * (x' / N) + y * (y' / N) + z * (z' / N)) * N) with (x * x' + y * y' + z * z') in A by (field; lra).
      lra.
    - rewrite <- Z in E2. assert (x' = 0 /\ y' = 0 /\ z' = 0) as (-> & -> & ->) by (repeat split; nra).
      rewrite <- Z. lra. }
  apply Rnot_lt_le. intros L.
  assert (norm (x + x') (y + y') (z + z') * norm (x + x') (y + y') (z + z') >
    (norm x y z + norm x' y' z') * (norm x y z + norm x' y' z')) by nra.
  nra.
Qed.

Lemma norm_abs x y z : norm (Rabs x) (Rabs y) (Rabs z) = norm x y z.
Proof. unfold norm. f_equal. rewrite <- !Rabs_mult. rewrite !Rabs_pos_eq by nra. reflexivity. Qed.

Lemma norm_product x y z x' y' z' : Rabs (x * x') + Rabs (y * y') + Rabs (z * z') <= norm x y z * norm x' y' z'.
Proof.
  rewrite <- (norm_abs x), <- (norm_abs x'), !Rabs_mult.
  generalize (Rabs x) (Rabs y) (Rabs z) (Rabs x') (Rabs y') (Rabs z'). clear. intros x y z x' y' z'.
  destruct (norm_square x y z) as [E1 P1]. destruct (norm_square x' y' z') as [E2 P2].
  destruct (Rle_lt_or_eq_dec _ _ P2) as [L|Z].
  - set (N := norm x' y' z') in *.
    assert (x * (x' / N) + y * (y' / N) + z * (z' / N) <= norm x y z) as A.
    { apply norm_above. right. transitivity ((x' * x' + y' * y' + z' * z') / (N * N)); [field; lra|].
      rewrite <- E2. field. lra. }
    apply (Rmult_le_compat_r N) in A; [|lra].
    replace ((x * (x' / N) + y * (y' / N) + z * (z' / N)) * N) with (x * x' + y * y' + z * z') in A by (field; lra).
    lra.
  - rewrite <- Z in E2. assert (x' = 0 /\ y' = 0 /\ z' = 0) as (-> & -> & ->) by (repeat split; nra).
    rewrite <- Z. lra.
Qed.

(* The time at which g is least, within a span, and one that is taken a little beside it. *)
Lemma near_the_nearest (s1 t8 from to s delta : R) :
  Rabs (t8 - s1) <= delta -> from <= s <= to ->
  forall chosen, (from <= t8 <= to /\ chosen = t8) \/ (to <= t8 /\ chosen = to) \/ (t8 <= from /\ chosen = from) ->
  (chosen - s1) * (chosen - s1) <= (s - s1) * (s - s1) + delta * delta.
Proof.
  intros D S c H. apply Rabs_le_inv in D.
  assert (0 <= (s - s1) * (s - s1)) as Q by (generalize (Rle_0_sqr (s - s1)); unfold Rsqr; lra).
  assert (0 <= delta * delta) as Q2 by (generalize (Rle_0_sqr delta); unfold Rsqr; lra).
  destruct H as [[H ->]|[[H ->]|[H ->]]].
  - assert ((t8 - s1) * (t8 - s1) <= delta * delta) by nra. lra.
  - destruct (Rle_or_lt to s1).
    + assert ((to - s1) * (to - s1) <= (s - s1) * (s - s1)) by nra. lra.
    + assert ((to - s1) * (to - s1) <= delta * delta) by nra. lra.
  - destruct (Rle_or_lt s1 from).
    + assert ((from - s1) * (from - s1) <= (s - s1) * (s - s1)) by nra. lra.
    + assert ((from - s1) * (from - s1) <= delta * delta) by nra. lra.
Qed.
