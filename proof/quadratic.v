(* Where c + b d + 1/2 a d^2 stays above zero, over the real numbers. *)
From Coq Require Import Reals Lra Psatz.
Open Scope R_scope.

Definition quadratic (c b a d : R) : R := c + b * d + / 2 * a * (d * d).

Lemma quadratic_rising c b a d : 0 < c -> 0 <= b -> 0 <= a -> 0 <= d -> 0 < quadratic c b a d.
Proof.
  intros. unfold quadratic. assert (0 <= b * d) by (apply Rmult_le_pos; lra).
  assert (0 <= a * (d * d)) by (apply Rmult_le_pos; nra). lra.
Qed.

Lemma quadratic_without_root c b a d : 0 < c -> b * b - 2 * a * c < 0 -> 0 < quadratic c b a d.
Proof.
  intros Hc Hd. unfold quadratic.
  assert (0 < a) by nra.
  assert (0 < a * (c + b * d + / 2 * a * (d * d))).
  { replace (a * (c + b * d + / 2 * a * (d * d)))
      with (/ 2 * ((a * d + b) * (a * d + b) - (b * b - 2 * a * c))) by field.
    generalize (Rle_0_sqr (a * d + b)). unfold Rsqr. lra. }
  apply Rmult_lt_reg_l with a; [assumption|]. lra.
Qed.

(* The first root is 2 c / (sqrt(b^2 - 2 a c) - b): before it, the quadratic is above zero. *)
Lemma quadratic_before_root c b a d S :
  0 < c -> 0 <= S -> S * S = b * b - 2 * a * c -> 0 <= d -> d * (S - b) < 2 * c -> 0 < quadratic c b a d.
Proof.
  intros Hc HS E Hd L. unfold quadratic.
  assert (0 < (2 * c + b * d - S * d) * (2 * c + b * d + S * d)) as P.
  { assert (0 <= S * d) by nra. apply Rmult_lt_0_compat; lra. }
  replace ((2 * c + b * d - S * d) * (2 * c + b * d + S * d))
    with (4 * c * (c + b * d) + (b * b - S * S) * (d * d)) in P by ring.
  rewrite E in P. nra.
Qed.

(* A quadratic with lower coefficients is lower. *)
Lemma quadratic_le c b a c' b' a' d :
  c <= c' -> b <= b' -> a <= a' -> 0 <= d -> quadratic c b a d <= quadratic c' b' a' d.
Proof.
  intros. unfold quadratic. assert (0 <= d * d) by nra.
  assert (b * d <= b' * d) by nra. assert (a * (d * d) <= a' * (d * d)) by nra. lra.
Qed.
