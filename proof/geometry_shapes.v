(* Boxes and triangles: the planes that they lie behind, companions, and Lemma 4. *)
From Coq Require Import Reals Lra Psatz List.
From Kinesphere Require Import geometry_vectors geometry_motion geometry_bounds geometry_certificates.
Open Scope R_scope.

(* A shape is the set of its points. *)
Definition shape : Type := vector -> Prop.
Definition box (lower upper : vector) : shape := fun p =>
  x_of lower <= x_of p <= x_of upper /\ y_of lower <= y_of p <= y_of upper /\ z_of lower <= z_of p <= z_of upper.
(* The means of the corners, with weights from 0 to 1. *)
Definition triangle (a b c : vector) : shape := fun p =>
  exists i j k, 0 <= i /\ 0 <= j /\ 0 <= k /\ i + j + k = 1 /\ p = (i * a + j * b + k * c)%vector.

(* How far they reach in a direction n, over all corners. *)
Definition reach_of_box (lower upper n : vector) : R :=
  Rmax (x_of n * x_of lower) (x_of n * x_of upper) + Rmax (y_of n * y_of lower) (y_of n * y_of upper) +
  Rmax (z_of n * z_of lower) (z_of n * z_of upper).
Definition reach_of_triangle (a b c n : vector) : R := Rmax (Rmax (dot n a) (dot n b)) (dot n c).

Lemma product_at_most (n l u x : R) : l <= x <= u -> n * x <= Rmax (n * l) (n * u).
Proof.
  intros H. destruct (Rle_or_lt 0 n) as [P|N].
  - apply Rle_trans with (2 := Rmax_r _ _). apply Rmult_le_compat_l; lra.
  - apply Rle_trans with (2 := Rmax_l _ _). apply Rmult_le_compat_neg_l; lra.
Qed.

(* In each direction n the shape lies behind the plane with its support as offset. *)
Theorem box_lies_behind_its_plane (lower upper n p : vector) : box lower upper p -> dot n p <= reach_of_box lower upper n.
Proof.
  intros (Hx & Hy & Hz). unfold dot, reach_of_box.
  generalize (product_at_most (x_of n) _ _ _ Hx) (product_at_most (y_of n) _ _ _ Hy) (product_at_most (z_of n) _ _ _ Hz). lra.
Qed.
Theorem triangle_lies_behind_its_plane (a b c n p : vector) : triangle a b c p -> dot n p <= reach_of_triangle a b c n.
Proof.
  intros (i & j & k & Hi & Hj & Hk & E & ->). rewrite !dot_plus, !dot_times. unfold reach_of_triangle.
  set (m := Rmax (Rmax (dot n a) (dot n b)) (dot n c)).
  assert (dot n a <= m) by (apply Rle_trans with (2 := Rmax_l _ _), Rmax_l).
  assert (dot n b <= m) by (apply Rle_trans with (2 := Rmax_l _ _), Rmax_r).
  assert (dot n c <= m) by apply Rmax_r.
  replace m with (i * m + j * m + k * m) by (rewrite <- !Rmult_plus_distr_r, E; ring). nra.
Qed.

(* So a body that has not crossed the plane by more than a distance has not come so near to any point of the shape. *)
Theorem shape_behind_its_plane_is_not_met (K : shape) (b : body) (m : motion) (t0 t1 t s : R) (p q n : vector)
  (offset distance : R) :
  (forall k, K k -> dot n k <= offset) ->
  norm n <= 1 -> keeps_promise b m t0 t1 -> t0 <= t -> 0 <= s -> t + s <= t1 -> true_report b m t p q ->
  0 < dot n (c (bound_of b p q) s) - rho (bound_of b p q) s - offset - distance ->
  forall k, K k -> distance < norm (place m (t + s) - k) - r b.
Proof.
  intros B Hn Kp Ht Hs Ht1 T L k Hk. generalize (centre_is_near b m t0 t1 t p q s Kp Ht Hs Ht1 T) (B k Hk).
  generalize (dot_at_most_norm n (c (bound_of b p q) s - k) Hn). rewrite dot_minus.
  generalize (norm_by_way_of (place m (t + s)) (c (bound_of b p q) s) k).
  rewrite (norm_symmetric (c (bound_of b p q) s) (place m (t + s))). lra.
Qed.

(* From plane to plane: if each certificate holds from where the one before ends, then all is well to where the last
   ends. *)
Fixpoint in_turn (apart : R -> Prop) (from : R) (times : list R) : Prop :=
  match times with
  | nil => True
  | next :: rest => (forall t, from <= t < next -> apart t) /\ in_turn apart next rest
  end.
Fixpoint end_of (from : R) (times : list R) : R :=
  match times with nil => from | next :: rest => end_of next rest end.
Theorem certificates_from_plane_to_plane_add_up (apart : R -> Prop) (times : list R) : forall from,
  in_turn apart from times -> forall t, from <= t < end_of from times -> apart t.
Proof.
  induction times as [|next rest IH]; intros from H t Ht; [simpl in Ht; lra|]. destruct H as [H Hs].
  destruct (Rlt_or_le t next) as [L|L]; [apply H; lra|]. apply (IH next Hs). simpl in Ht. lra.
Qed.

(* A companion is a point k of the shape at that time: while it is near, the body has not parted from the shape. *)
Theorem companion_guards_the_contact (K : shape) (b : body) (m : motion) (t0 t1 t s : R) (p q k : vector) (distance : R) :
  K k -> keeps_promise b m t0 t1 -> t0 <= t -> 0 <= s -> t + s <= t1 -> true_report b m t p q ->
  norm (c (bound_of b p q) s - k) + growth_after (bound_of b p q) s < r b + e0 b + distance ->
  exists k, K k /\ norm (place m (t + s) - k) - r b < distance + 2 * e0 b.
Proof.
  intros Hk Kp Ht Hs Ht1 T L. exists k. split; [exact Hk|].
  generalize (centre_is_near b m t0 t1 t p q s Kp Ht Hs Ht1 T). rewrite rho_of.
  generalize (norm_by_way_of (c (bound_of b p q) s) (place m (t + s)) k). lra.
Qed.

(* While the bound of the centre alone, without the radius, is in a box, so is the centre, and the body touches the box.
   *)
Theorem centre_stays_in_the_box (lower upper : vector) (b : body) (m : motion) (t0 t1 t s : R) (p q : vector) :
  keeps_promise b m t0 t1 -> t0 <= t -> 0 <= s -> t + s <= t1 -> true_report b m t p q ->
  let depth := rho (bound_of b p q) s - r b in
  let y := c (bound_of b p q) s in
  x_of lower + depth <= x_of y <= x_of upper - depth -> y_of lower + depth <= y_of y <= y_of upper - depth ->
  z_of lower + depth <= z_of y <= z_of upper - depth ->
  box lower upper (place m (t + s)).
Proof.
  intros Kp Ht Hs Ht1 T depth y Hx Hy Hz.
  generalize (centre_is_near b m t0 t1 t p q s Kp Ht Hs Ht1 T). fold y. fold depth. intros N.
  set (x := place m (t + s)) in *.
  assert (forall n, norm n = 1 -> Rabs (dot n x - dot n y) <= depth) as W.
  { intros n Hn. apply Rabs_le. rewrite <- dot_minus.
    generalize (dot_at_most_norm n (x - y) ltac:(lra)) (dot_at_most_norm n (y - x) ltac:(lra)).
    rewrite (norm_symmetric y x), !dot_minus. lra. }
  assert (norm (Vector 1 0 0) = 1 /\ norm (Vector 0 1 0) = 1 /\ norm (Vector 0 0 1) = 1) as (E1 & E2 & E3).
  { unfold norm, dot. cbn [x_of y_of z_of]. rewrite !Rmult_1_l, !Rmult_0_l, ?Rplus_0_l, ?Rplus_0_r. now rewrite sqrt_1. }
  generalize (abs_at_most _ _ (W _ E1)) (abs_at_most _ _ (W _ E2)) (abs_at_most _ _ (W _ E3)).
  unfold dot. cbn [x_of y_of z_of]. unfold box. lra.
Qed.

(* The distance of a place from a shape is the greatest number that is not above the distance of any of its points. *)
Definition distance_from (K : shape) (p : vector) (d : R) : Prop :=
  (forall k, K k -> d <= norm (p - k)) /\ forall d', (forall k, K k -> d' <= norm (p - k)) -> d' <= d.

Theorem triangle_has_a_distance (a b c p : vector) : exists d, 0 <= d /\ distance_from (triangle a b c) p d.
Proof.
  destruct (completeness (fun d => forall k, triangle a b c k -> d <= norm (p - k))) as (d & U & L).
  - exists (norm (p - a)). intros d H. apply H. exists 1, 0, 0.
    repeat (split; [lra|]). destruct a; by_coordinates.
  - exists 0. intros k _. apply norm_positive.
  - exists d. split; [apply U; intros k _; apply norm_positive|]. split.
    + intros k Hk. apply L. intros d' H. apply H. exact Hk.
    + intros d' H. apply U. exact H.
Qed.

(* Lemma 4. A place is moved by no more than w, and the corners of a triangle by no more than v each: its distance from
   the triangle changes by no more than w + v. *)
Lemma distance_grows_by_at_most (a b c a' b' c' p p' : vector) (d d' w v : R) :
  distance_from (triangle a b c) p d -> distance_from (triangle a' b' c') p' d' ->
  norm (p' - p) <= w -> norm (a' - a) <= v -> norm (b' - b) <= v -> norm (c' - c) <= v -> d' <= d + (w + v).
Proof.
  intros [_ G] [D _] Hw Ha Hb Hc. assert (d' - (w + v) <= d); [|lra]. apply G.
  intros q (i & j & k & Hi & Hj & Hk & E & ->).
  set (q := (i * a + j * b + k * c)%vector). set (q' := (i * a' + j * b' + k * c')%vector).
  assert (d' <= norm (p' - q')) as L by (apply D; exists i, j, k; auto 6).
  assert (norm (q - q') <= v) as M.
  { rewrite norm_symmetric.
    replace (q' - q)%vector with (i * (a' - a) + j * (b' - b) + k * (c' - c))%vector by (unfold q, q'; by_coordinates).
    apply Rle_trans with (1 := norm_plus _ _).
    generalize (norm_plus (i * (a' - a)) (j * (b' - b))). rewrite !norm_times, !Rabs_pos_eq by assumption.
    replace v with (i * v + j * v + k * v) by (rewrite <- !Rmult_plus_distr_r, E; ring).
    assert (i * norm (a' - a) <= i * v) by (apply Rmult_le_compat_l; assumption).
    assert (j * norm (b' - b) <= j * v) by (apply Rmult_le_compat_l; assumption).
    assert (k * norm (c' - c) <= k * v) by (apply Rmult_le_compat_l; assumption). lra. }
  generalize (norm_by_way_of p p' q') (norm_by_way_of q p q'). lra.
Qed.
Theorem distance_from_a_triangle_changes_by_no_more (a b c a' b' c' p p' : vector) (d d' w v : R) :
  distance_from (triangle a b c) p d -> distance_from (triangle a' b' c') p' d' ->
  norm (p' - p) <= w -> norm (a' - a) <= v -> norm (b' - b) <= v -> norm (c' - c) <= v -> Rabs (d' - d) <= w + v.
Proof.
  intros D D' Hw Ha Hb Hc. apply Rabs_le.
  generalize (distance_grows_by_at_most _ _ _ _ _ _ _ _ _ _ w v D D' Hw Ha Hb Hc).
  rewrite norm_symmetric in Hw, Ha, Hb, Hc.
  generalize (distance_grows_by_at_most _ _ _ _ _ _ _ _ _ _ w v D' D Hw Ha Hb Hc). lra.
Qed.
