(* Vectors in space: inner product, length, and what the other geometry files need of them. *)
From Coq Require Import Reals Lra Psatz List.
Open Scope R_scope.

Record vector : Type := Vector { x_of : R; y_of : R; z_of : R }.
Declare Scope vector_scope.
Delimit Scope vector_scope with vector.
Bind Scope vector_scope with vector.

Definition zero : vector := Vector 0 0 0.
Definition plus (u v : vector) : vector := Vector (x_of u + x_of v) (y_of u + y_of v) (z_of u + z_of v).
Definition minus (u v : vector) : vector := Vector (x_of u - x_of v) (y_of u - y_of v) (z_of u - z_of v).
Definition times (k : R) (v : vector) : vector := Vector (k * x_of v) (k * y_of v) (k * z_of v).
Infix "+" := plus : vector_scope.
Infix "-" := minus : vector_scope.
Infix "*" := times : vector_scope.

(* The inner product, the length, the sum of the magnitudes of the coordinates, and the cross product. *)
Definition dot (u v : vector) : R := x_of u * x_of v + y_of u * y_of v + z_of u * z_of v.
Definition norm (v : vector) : R := sqrt (dot v v).
Definition norm_one (v : vector) : R := Rabs (x_of v) + Rabs (y_of v) + Rabs (z_of v).
Definition cross (u v : vector) : vector :=
  Vector (y_of u * z_of v - z_of u * y_of v) (z_of u * x_of v - x_of u * z_of v) (x_of u * y_of v - y_of u * x_of v).

(* Equations between vectors, and between inner products of sums, hold coordinate by coordinate. *)
Ltac coordinates := unfold dot, cross, minus, plus, times, zero; cbn [x_of y_of z_of].
Ltac by_coordinates := intros; coordinates; try apply (f_equal3 Vector); ring.

Lemma dot_symmetric u v : dot u v = dot v u.
Proof. by_coordinates. Qed.
Lemma dot_plus n u v : dot n (u + v) = dot n u + dot n v.
Proof. by_coordinates. Qed.
Lemma dot_minus n u v : dot n (u - v) = dot n u - dot n v.
Proof. by_coordinates. Qed.
Lemma dot_times n k v : dot n (k * v) = k * dot n v.
Proof. by_coordinates. Qed.

Lemma dot_self v : 0 <= dot v v.
Proof. unfold dot. nra. Qed.
Lemma norm_positive v : 0 <= norm v.
Proof. apply sqrt_pos. Qed.
Lemma norm_square v : norm v * norm v = dot v v.
Proof. apply sqrt_sqrt, dot_self. Qed.

(* Comparing lengths is comparing squares. *)
Lemma norm_at_most v r : 0 <= r -> dot v v <= r * r -> norm v <= r.
Proof. intros Hr H. generalize (norm_positive v) (norm_square v). nra. Qed.
Lemma norm_more v r : r * r < dot v v -> r < norm v.
Proof. intros H. generalize (norm_positive v) (norm_square v). nra. Qed.

Lemma cauchy_schwarz_square u v : dot u v * dot u v + dot (cross u v) (cross u v) = dot u u * dot v v.
Proof. by_coordinates. Qed.
Lemma cauchy_schwarz u v : dot u v <= norm u * norm v.
Proof.
  generalize (cauchy_schwarz_square u v) (dot_self (cross u v)). rewrite <- (norm_square u), <- (norm_square v).
  generalize (norm_positive u) (norm_positive v). intros Hu Hv E C.
  assert (0 <= norm u * norm v) by nra. nra.
Qed.

(* Along a direction of length at most 1, a vector reaches no farther than its length. *)
Lemma dot_at_most_norm n v : norm n <= 1 -> dot n v <= norm v.
Proof. intros H. generalize (cauchy_schwarz n v) (norm_positive n) (norm_positive v). nra. Qed.

Lemma norm_plus u v : norm (u + v) <= norm u + norm v.
Proof.
  apply norm_at_most; [generalize (norm_positive u) (norm_positive v); lra|].
  generalize (cauchy_schwarz u v) (norm_square u) (norm_square v).
  replace (dot (u + v) (u + v)) with (dot u u + 2 * dot u v + dot v v) by by_coordinates. nra.
Qed.
Lemma norm_times k v : norm (k * v) = Rabs k * norm v.
Proof.
  unfold norm. replace (dot (k * v) (k * v)) with (k * k * dot v v) by by_coordinates.
  rewrite sqrt_mult by (try apply dot_self; nra). f_equal. apply sqrt_Rsqr_abs.
Qed.
Lemma norm_symmetric u v : norm (u - v) = norm (v - u).
Proof. unfold norm. f_equal. by_coordinates. Qed.

(* The triangle inequality, by way of w. *)
Lemma norm_by_way_of w u v : norm (u - v) <= norm (u - w) + norm (w - v).
Proof.
  replace (u - v)%vector with ((u - w) + (w - v))%vector by by_coordinates. apply norm_plus.
Qed.
Lemma norm_minus u v : norm u - norm v <= norm (u - v).
Proof.
  generalize (norm_plus (u - v) v). replace ((u - v) + v)%vector with u by (destruct u; by_coordinates). lra.
Qed.
Lemma norm_zero : norm zero = 0.
Proof. unfold norm. replace (dot zero zero) with 0 by by_coordinates. apply sqrt_0. Qed.

Lemma norm_one_positive v : 0 <= norm_one v.
Proof. unfold norm_one. generalize (Rabs_pos (x_of v)) (Rabs_pos (y_of v)) (Rabs_pos (z_of v)). lra. Qed.
Lemma norm_at_most_norm_one v : norm v <= norm_one v.
Proof.
  apply norm_at_most; [apply norm_one_positive|]. unfold norm_one, dot.
  generalize (Rabs_pos (x_of v)) (Rabs_pos (y_of v)) (Rabs_pos (z_of v)).
  generalize (Rsqr_abs (x_of v)) (Rsqr_abs (y_of v)) (Rsqr_abs (z_of v)). unfold Rsqr. nra.
Qed.

Lemma abs_at_most (x k : R) : Rabs x <= k -> - k <= x <= k.
Proof. intros H. generalize (Rle_abs x) (Rle_abs (- x)). rewrite Rabs_Ropp. lra. Qed.

(* The cross product is no longer than the product of the lengths, and at right angles to the second factor. *)
Lemma norm_cross u v : norm (cross u v) <= norm u * norm v.
Proof.
  generalize (norm_positive u) (norm_positive v). intros Hu Hv. apply norm_at_most; [nra|].
  generalize (cauchy_schwarz_square u v). rewrite <- (norm_square u), <- (norm_square v). nra.
Qed.
Lemma dot_cross u v : dot v (cross u v) = 0.
Proof. by_coordinates. Qed.
Lemma at_no_distance u v : norm (u - v) <= 0 -> u = v.
Proof.
  intros H. generalize (norm_positive (u - v)) (norm_square (u - v)). intros P Q.
  assert (dot (u - v) (u - v) = 0) as Z by nra. revert Z. clear. unfold dot.
  destruct u as [x y z], v as [x' y' z']. coordinates. intros Z.
  assert (forall k, k * k = 0 -> k = 0) as S by (intros k E; destruct (Rmult_integral _ _ E); assumption).
  apply (f_equal3 Vector); apply Rminus_diag_uniq, S;
    generalize (Rle_0_sqr (x - x')) (Rle_0_sqr (y - y')) (Rle_0_sqr (z - z')); unfold Rsqr; lra.
Qed.
(* A sum of points with weights, and the sum of its weights: a mean of the points, if no weight is below zero and their sum
   is 1. *)
Fixpoint weighted (points : list (R * vector)) : vector :=
  match points with nil => zero | (k, x) :: rest => (k * x + weighted rest)%vector end.
Fixpoint total {point : Type} (points : list (R * point)) : R :=
  match points with nil => 0 | (k, _) :: rest => k + total rest end.

(* A mean lies as far along a direction as one of its points, or farther. *)
Lemma weighted_beyond (n : vector) (m : R) (points : list (R * vector)) :
  (forall k x, In (k, x) points -> 0 <= k /\ m < dot n x) ->
  0 <= total points /\ m * total points <= dot n (weighted points) /\
  (0 < total points -> m * total points < dot n (weighted points)).
Proof.
  induction points as [|[k x] points IH]; intros H; cbn [total weighted].
  - replace (dot n zero) with 0 by by_coordinates. repeat split; lra.
  - destruct IH as (P & L & S); [intros; apply H; right; assumption|].
    destruct (H k x (or_introl eq_refl)) as [Pk Lx]. rewrite dot_plus, dot_times.
    destruct (Rle_lt_or_eq_dec _ _ Pk) as [K|<-].
    + assert (k * m < k * dot n x) by (apply Rmult_lt_compat_l; assumption). repeat split; lra.
    + rewrite Rmult_0_l, !Rplus_0_l. auto.
Qed.
