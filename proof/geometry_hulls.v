(* Convex hulls of points, and all that is within a radius of one: apart along a direction, beyond a plane, and where points
   of a hull that turns are. *)
From Coq Require Import Reals Lra Psatz List.
From Kinesphere Require Import quadratic geometry_vectors geometry_motion geometry_bounds geometry_certificates
  geometry_shapes geometry_knowledge geometry_turning.
Open Scope R_scope.

(* The hull of some points: all their means. That of one point is the point, that of two is the segment between them. *)
Definition hull (points : list vector) : shape := fun p =>
  exists weights, (forall k x, In (k, x) weights -> 0 <= k /\ In x points) /\ total weights = 1 /\ p = weighted weights.

Lemma hull_beyond (n p : vector) (m : R) (points : list vector) :
  (forall x, In x points -> m < dot n x) -> hull points p -> m < dot n p.
Proof.
  intros H (weights & W & T & ->). destruct (weighted_beyond n m weights) as (_ & _ & S).
  - intros k x I. destruct (W k x I). auto.
  - rewrite T in S. generalize (S Rlt_0_1). lra.
Qed.

(* The directional certificate. If all points of a hull are more than D farther along n than all points of another, any two
   of their means are. *)
Lemma hulls_along_a_direction (n p q : vector) (P Q : list vector) (D : R) :
  (forall a b, In a P -> In b Q -> D < dot n a - dot n b) -> hull P p -> hull Q q -> D < dot n p - dot n q.
Proof.
  intros H Hp Hq. assert (D - dot n p < dot (-1 * n) q) as L.
  { apply (hull_beyond _ q _ Q); [|exact Hq]. intros b Ib. assert (D + dot n b < dot n p) as L.
    { apply (hull_beyond n p _ P); [|exact Hp]. intros a Ia. generalize (H a b Ia Ib). lra. }
    replace (dot (-1 * n) b) with (- dot n b) by by_coordinates. lra. }
  replace (dot (-1 * n) q) with (- dot n q) in L by by_coordinates. lra.
Qed.

(* So, along a direction of length 1 or less, they are more than D apart. *)
Theorem hulls_are_apart_along_a_direction (n p q : vector) (P Q : list vector) (D : R) :
  norm n <= 1 -> (forall a b, In a P -> In b Q -> D < dot n a - dot n b) -> hull P p -> hull Q q -> D < norm (p - q).
Proof.
  intros Hn H Hp Hq. generalize (hulls_along_a_direction n p q P Q D H Hp Hq) (dot_at_most_norm n (p - q) Hn).
  rewrite dot_minus. lra.
Qed.

(* Along any direction, with the radii r and s of the two: if their points leave a gap of more than D, it is the least
   distance of all points within the radii. So where min n.a - max n.b is above (r + s) |n|, nothing of the one touches the
   other, and what it is above that, divided by |n|, is a lower bound of their distance. *)
Theorem rounded_hulls_are_apart_along_a_direction (n p q x y : vector) (P Q : list vector) (r s D : R) :
  (forall a b, In a P -> In b Q -> (r + s + D) * norm n < dot n a - dot n b) ->
  hull P p -> hull Q q -> in_ball x p r -> in_ball y q s -> D < norm (x - y).
Proof.
  intros H Hp Hq Hx Hy. unfold in_ball in *.
  generalize (hulls_along_a_direction n p q P Q _ H Hp Hq) (cauchy_schwarz n (p - q)). rewrite dot_minus, (Rmult_comm (norm n)).
  intros L C. assert (r + s + D < norm (p - q)) as G.
  { apply Rmult_lt_reg_r with (norm n); [|lra]. destruct (norm_positive n) as [Z|Z]; [exact Z|]. rewrite <- Z in L, C. lra. }
  generalize (norm_by_way_of x p q) (norm_by_way_of y x q). rewrite (norm_symmetric p x). lra.
Qed.

(* The same with a plane: no point k of a shape has n.k above the offset, so that the shape may be a half-space, a box or
   a triangle. If all points of a hull are more than D beyond the plane, all their means are, and more than D from the shape.
   A shape that is carried counts from its carrier, and so does the hull. *)
Theorem hull_beyond_a_plane_is_apart (K : shape) (n carrier p : vector) (points : list vector) (offset D : R) :
  (forall k, K k -> dot n k <= offset) -> norm n <= 1 ->
  (forall a, In a points -> offset + D < dot n (a - carrier)) -> hull points p ->
  offset + D < dot n (p - carrier) /\ forall k, K k -> D < norm (p - (carrier + k)).
Proof.
  intros HK Hn H Hp. assert (offset + D < dot n (p - carrier)) as L.
  { rewrite dot_minus. assert (offset + D + dot n carrier < dot n p); [|lra].
    apply (hull_beyond n p _ points); [|exact Hp]. intros a Ia. generalize (H a Ia). rewrite dot_minus. lra. }
  split; [exact L|]. intros k Hk. generalize (HK k Hk) (dot_at_most_norm n (p - (carrier + k)) Hn).
  replace (dot n (p - (carrier + k))) with (dot n (p - carrier) - dot n k) by by_coordinates. lra.
Qed.

(* A point that is fixed in a body, and in the hull of other fixed points, stays in their hull. *)
Lemma weights_of_arms (arms : list (R -> vector)) (t : R) : forall weights,
  (forall k x, In (k, x) weights -> 0 <= k /\ In x (map (fun arm => arm t) arms)) ->
  exists of_arms, weights = placed t of_arms /\ forall k arm, In (k, arm) of_arms -> 0 <= k /\ In arm arms.
Proof.
  induction weights as [|[k x] weights IH]; intros H.
  - exists nil. split; [reflexivity|]. intros k arm [].
  - destruct IH as (rest & -> & Hr); [intros k' x' I; apply H; right; exact I|].
    destruct (H k x (or_introl eq_refl)) as [Pk Ix]. apply in_map_iff in Ix. destruct Ix as (arm & <- & Ia).
    exists ((k, arm) :: rest). split; [reflexivity|]. intros k' arm' [E|I]; [injection E as <- <-; auto|exact (Hr k' arm' I)].
Qed.
Definition moved_by (v : vector) (weights : list (R * vector)) : list (R * vector) := map (fun w => (fst w, v + snd w)%vector) weights.
Lemma weighted_moved_by (v : vector) (weights : list (R * vector)) :
  weighted (moved_by v weights) = (total weights * v + weighted weights)%vector /\ total (moved_by v weights) = total weights.
Proof.
  induction weights as [|[k x] weights [IH IT]]; cbn [moved_by map fst snd weighted total]; [split; [by_coordinates|reflexivity]|].
  fold (moved_by v weights). rewrite IH, IT. split; [by_coordinates|reflexivity].
Qed.
Lemma total_placed (t : R) (arms : list (R * (R -> vector))) : total (placed t arms) = total arms.
Proof. induction arms as [|[k arm] arms IH]; cbn [placed map fst snd total]; [|fold (placed t arms); rewrite IH]; reflexivity. Qed.

Theorem fixed_point_stays_in_its_hull (v : vector) (w p : R -> vector) (arms : list (R -> vector)) (t0 t1 t : R) :
  (forall arm, In arm arms -> turns w arm t0 t1) -> turns w p t0 t1 -> hull (map (fun arm => arm t0) arms) (p t0) ->
  t0 <= t <= t1 -> hull (map (fun arm => v + arm t)%vector arms) (v + p t)%vector.
Proof.
  intros Ta Tp (weights & W & T & E) Ht. destruct (weights_of_arms arms t0 weights W) as (of_arms & -> & Ho).
  rewrite total_placed in T.
  assert (p t = weighted (placed t of_arms)) as Et.
  { apply (fixed_point_keeps_its_place_among_others w p of_arms t0 t1 t); auto. intros k arm I. apply Ta, (Ho k arm I). }
  exists (moved_by v (placed t of_arms)). destruct (weighted_moved_by v (placed t of_arms)) as [Ew Es].
  rewrite Ew, Es, total_placed, T, Et. split; [|split; [reflexivity|by_coordinates]].
  intros k x I. apply in_map_iff in I. destruct I as ((k' & y) & [= <- <-] & I).
  apply in_map_iff in I. destruct I as ((k'' & arm) & [= <- <-] & I). destruct (Ho _ _ I) as [Pk Ia].
  split; [exact Pk|]. apply in_map_iff. exists arm. split; [reflexivity|exact Ia].
Qed.

(* Two bounds in a direction: n.C - R - distance, of which earliest_meeting takes the first root (Lemma 3), is above zero
   at the time t. *)
Definition ahead (n : vector) (distance t : R) (a b : bound) (s s' : R) : Prop :=
  0 < dot n (c a (t - s) - c b (t - s')) - (rho a (t - s) + rho b (t - s')) - distance.

Lemma ahead_along (n : vector) (distance t t0 t1 : R) (a b : body) (ma mb : motion) (x y : report) (of_a of_b : list report) :
  norm n <= 1 -> possible a t0 t1 of_a ma -> possible b t0 t1 of_b mb -> In x of_a -> In y of_b ->
  at_time x <= t <= t1 -> at_time y <= t -> ahead n distance t (bound_from a x) (bound_from b y) (at_time x) (at_time y) ->
  r a + r b + distance < dot n (place ma t) - dot n (place mb t).
Proof.
  intros Hn [Ka Ra] [Kb Rb] Ix Iy Hx Hy L. destruct (Ra x Ix) as [Hax Ta]. destruct (Rb y Iy) as [Hby Tb].
  generalize (centre_is_near a ma t0 t1 (at_time x) (at_place x) (with_velocity x) (t - at_time x) Ka)
    (centre_is_near b mb t0 t1 (at_time y) (at_place y) (with_velocity y) (t - at_time y) Kb).
  replace (at_time x + (t - at_time x)) with t by ring. replace (at_time y + (t - at_time y)) with t by ring. intros Na Nb.
  specialize (Na ltac:(lra) ltac:(lra) ltac:(lra) Ta). specialize (Nb ltac:(lra) ltac:(lra) ltac:(lra) Tb).
  revert L. unfold ahead. fold (bound_from a x) (bound_from b y) in *. rewrite dot_minus.
  set (ca := c (bound_from a x) (t - at_time x)) in *. set (cb := c (bound_from b y) (t - at_time y)) in *.
  generalize (dot_at_most_norm n (ca - place ma t) Hn) (dot_at_most_norm n (place mb t - cb) Hn).
  rewrite (norm_symmetric ca), !dot_minus. lra.
Qed.

(* Pairs of points are left out that are far enough along the direction at both ends of a time T: between them n.C - R is
   below the straight line by no more than an eighth of its bend, times the square of T. *)
Theorem points_ahead_at_both_ends_are_ahead_between (k l q bend T d : R) :
  q <= bend -> 0 <= bend -> 0 <= d <= T ->
  bend * (T * T) / 8 < quadratic k l q 0 -> bend * (T * T) / 8 < quadratic k l q T -> 0 < quadratic k l q d.
Proof.
  intros Hq Hb Hd L0 LT. destruct (Rle_lt_or_eq_dec 0 T ltac:(lra)) as [PT|<-].
  - apply Rmult_lt_reg_l with T; [exact PT|]. rewrite Rmult_0_r.
    replace (T * quadratic k l q d) with ((T - d) * quadratic k l q 0 + d * quadratic k l q T - / 2 * T * (q * (d * (T - d))))
      by (unfold quadratic; field).
    set (e := bend * (T * T) / 8) in *. set (f := quadratic k l q 0) in *. set (g := quadratic k l q T) in *.
    assert (0 <= d * (T - d)) as P by (apply Rmult_le_pos; lra).
    assert (d * (T - d) <= T * T / 4) as Q by (generalize (Rle_0_sqr (T - 2 * d)); unfold Rsqr; lra).
    assert (q * (d * (T - d)) <= bend * (T * T / 4)) as R.
    { apply Rle_trans with (bend * (d * (T - d))); [apply Rmult_le_compat_r|apply Rmult_le_compat_l]; assumption. }
    assert (/ 2 * T * (q * (d * (T - d))) <= T * e) as S.
    { replace (T * e) with (/ 2 * T * (bend * (T * T / 4))) by (unfold e; field). apply Rmult_le_compat_l; lra. }
    assert ((T - d) * e <= (T - d) * f) by (apply Rmult_le_compat_l; lra).
    assert (d * e <= d * g) by (apply Rmult_le_compat_l; lra).
    assert (T * e < (T - d) * f + d * g); [|lra].
    destruct (Rle_lt_or_eq_dec 0 d ltac:(lra)) as [Pd|<-].
    + assert (d * e < d * g) by (apply Rmult_lt_compat_l; assumption). lra.
    + assert (T * e < T * f) by (apply Rmult_lt_compat_l; assumption). lra.
  - assert (d = 0) as -> by lra. lra.
Qed.

(* They are ahead where the quadratic of Lemma 3 is above zero, which counts time from any instant. *)
Lemma ahead_from (from : R) (n : vector) (distance t s s' : R) (a b : bound) :
  let a' := moved_on a (from - s) in let b' := moved_on b (from - s') in
  0 < quadratic (constant a' b' n distance) (linear a' b' n) (square a' b' n) (t - from) -> ahead n distance t a b s s'.
Proof.
  cbv zeta. rewrite <- linearised. unfold ahead, C, Rs. rewrite !c_moved_on, !rho_moved_on.
  replace (from - s + (t - from)) with (t - s) by ring. replace (from - s' + (t - from)) with (t - s') by ring. exact (fun H => H).
Qed.
