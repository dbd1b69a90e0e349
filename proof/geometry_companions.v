(* Nearest points of boxes and triangles, and companions: points that go along with a centre and stay in a shape. *)
From Coq Require Import Reals Lra Psatz.
From Kinesphere Require Import quadratic geometry_vectors geometry_motion geometry_bounds geometry_certificates geometry_shapes.
Open Scope R_scope.

(* A point q of a shape is the nearest one to a place p if all of the shape lies behind the plane through q that is
   normal to the way from q to p. *)
Theorem point_is_nearest_if_the_shape_is_behind_its_plane (K : shape) (p q : vector) :
  K q -> (forall k, K k -> dot (p - q) k <= dot (p - q) q) -> distance_from K p (norm (p - q)).
Proof.
  intros Hq H. split; [|intros d' L; apply L; exact Hq]. intros k Hk. specialize (H k Hk).
  assert (norm (p - q) * norm (p - q) <= dot (p - q) (p - k)) as L by (rewrite norm_square, !dot_minus; lra).
  generalize (cauchy_schwarz (p - q) (p - k)). intros C.
  destruct (norm_positive (p - q)) as [P|Z]; [apply Rmult_le_reg_l with (norm (p - q)); lra|].
  rewrite <- Z. apply norm_positive.
Qed.

(* For a triangle it is enough that its corners are. *)
Theorem point_of_a_triangle_is_nearest_if_the_corners_are_behind (a b c p q : vector) :
  triangle a b c q -> dot (p - q) a <= dot (p - q) q -> dot (p - q) b <= dot (p - q) q -> dot (p - q) c <= dot (p - q) q ->
  distance_from (triangle a b c) p (norm (p - q)).
Proof.
  intros Hq Ha Hb Hc. apply point_is_nearest_if_the_shape_is_behind_its_plane; [exact Hq|]. intros k Hk.
  apply Rle_trans with (1 := triangle_lies_behind_its_plane a b c (p - q) k Hk). unfold reach_of_triangle.
  repeat apply Rmax_lub; assumption.
Qed.

(* The nearest point of a box has each coordinate of the place, moved to the nearer end where it is outside. *)
Theorem clamped_place_is_nearest_in_the_box (lower upper p : vector) :
  x_of lower <= x_of upper -> y_of lower <= y_of upper -> z_of lower <= z_of upper ->
  let q := Vector (clamp (x_of lower) (x_of upper) (x_of p)) (clamp (y_of lower) (y_of upper) (y_of p))
    (clamp (z_of lower) (z_of upper) (z_of p)) in
  distance_from (box lower upper) p (norm (p - q)).
Proof.
  intros Hx Hy Hz q. apply point_is_nearest_if_the_shape_is_behind_its_plane.
  - unfold box, q. cbn [x_of y_of z_of]. auto using clamp_between.
  - intros k (Kx & Ky & Kz).
    assert (forall l u x y, l <= y <= u -> (x - clamp l u x) * y <= (x - clamp l u x) * clamp l u x) as W.
    { intros l u x y Hy'. unfold clamp. repeat destruct Rle_dec; nra. }
    unfold dot, q, minus. cbn [x_of y_of z_of].
    generalize (W _ _ (x_of p) _ Kx) (W _ _ (y_of p) _ Ky) (W _ _ (z_of p) _ Kz). lra.
Qed.

(* On an axis a companion in a box moves with the centre, from x with the velocity v and the acceleration a. As long as
   both quadratics, of its ways to the two ends, are not below zero it is between these. (On other axes it stands.) *)
Theorem companion_stays_in_the_box (lower upper x v a d : R) :
  0 <= quadratic (x - lower) v a d -> 0 <= quadratic (upper - x) (- v) (- a) d ->
  lower <= x + d * v + d * d / 2 * a <= upper.
Proof. unfold quadratic. lra. Qed.

(* One on the side from a to b is a part of the way from a to b: as long as that part is between 0 and 1 it is in the
   triangle. *)
Theorem companion_stays_on_the_side (a b c : vector) (part v w d : R) :
  0 <= quadratic part v w d -> 0 <= quadratic (1 - part) (- v) (- w) d ->
  triangle a b c ((a + part * (b - a)) + d * (v * (b - a)) + (d * d / 2) * (w * (b - a)))%vector.
Proof.
  unfold quadratic. intros H0 H1. set (k := part + d * v + d * d / 2 * w).
  exists (1 - k), k, 0. unfold k. repeat (split; [lra|]). coordinates. apply (f_equal3 Vector); field.
Qed.

(* The frame of a triangle: its origin, at one end of the longest side, and the directions along that side and across
   it. The corners have there the coordinates (0, 0), (length, 0) and (foot, height). How far a place lies beyond each
   side, up to the positive factor that makes the direction of the side one of length 1: *)
Definition beyond_first (y : R) : R := - y.
Definition beyond_second (length foot height x y : R) : R := height * (x - length) - (foot - length) * y.
Definition beyond_third (foot height x y : R) : R := - height * (x - foot) + foot * (y - height).

(* A place of the plane that lies beyond none of the three sides is in the triangle: so a companion on the face stays in
   it as long as these three numbers, quadratics in time, are not above zero. *)
Theorem place_beyond_no_side_is_in_the_triangle (origin along across : vector) (length foot height x y : R) :
  0 < length -> 0 < height ->
  beyond_first y <= 0 -> beyond_second length foot height x y <= 0 -> beyond_third foot height x y <= 0 ->
  triangle origin (origin + length * along) (origin + foot * along + height * across) (origin + x * along + y * across)%vector.
Proof.
  unfold beyond_first, beyond_second, beyond_third. intros L H B1 B2 B3.
  assert (0 < / (length * height)) as P by (apply Rinv_0_lt_compat, Rmult_lt_0_compat; assumption).
  exists ((length * height - height * x + (foot - length) * y) * / (length * height)),
    ((height * x - foot * y) * / (length * height)), (length * y * / (length * height)).
  split; [apply Rmult_le_pos; lra|]. split; [apply Rmult_le_pos; lra|].
  split; [apply Rmult_le_pos; [apply Rmult_le_pos; lra|lra]|]. split; [field; lra|].
  coordinates. apply (f_equal3 Vector); field; lra.
Qed.

(* Above the face, the foot of a place is its nearest point. *)
Theorem foot_on_the_face_is_nearest (origin along across p : vector) (length foot height x y : R) :
  0 < length -> 0 < height ->
  beyond_first y <= 0 -> beyond_second length foot height x y <= 0 -> beyond_third foot height x y <= 0 ->
  let q := (origin + x * along + y * across)%vector in
  dot (p - q) along = 0 -> dot (p - q) across = 0 ->
  distance_from (triangle origin (origin + length * along) (origin + foot * along + height * across)) p (norm (p - q)).
Proof.
  intros L H B1 B2 B3 q A1 A2.
  assert (dot (p - q) q = dot (p - q) origin) as E.
  { revert A1 A2. generalize (p - q)%vector. intros n A1 A2. unfold q. rewrite !dot_plus, !dot_times, A1, A2. ring. }
  apply point_of_a_triangle_is_nearest_if_the_corners_are_behind.
  - apply place_beyond_no_side_is_in_the_triangle; assumption.
  - lra.
  - rewrite E, dot_plus, dot_times, A1. lra.
  - rewrite E, !dot_plus, !dot_times, A1, A2. lra.
Qed.
