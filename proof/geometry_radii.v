(* Balls whose radii change with time lie in bounds that grow by the rates of their radii as well. *)
From Coq Require Import Reals Lra Psatz.
From Kinesphere Require Import quadratic geometry_vectors geometry_motion geometry_bounds geometry_certificates.
Open Scope R_scope.

(* From t0 to t1 a radius grows by no more than k per time; where k is below zero it falls at least so fast. And it falls by
   no more than k per time. *)
Definition grows_by_at_most (k : R) (radius : R -> R) (t0 t1 : R) : Prop :=
  forall s t, t0 <= s <= t -> t <= t1 -> radius t <= radius s + k * (t - s).
Definition falls_by_at_most (k : R) (radius : R -> R) (t0 t1 : R) : Prop :=
  forall s t, t0 <= s <= t -> t <= t1 -> radius s - k * (t - s) <= radius t.

(* The radius that ChangingRadius::at gives: r at one time, from which on it changes at the rate k; or 0. *)
Definition radius_at (r since k t : R) : R := Rmax (r + k * (t - since)) 0.

Theorem radius_changes_by_at_most_its_rate (r since k t0 t1 : R) :
  grows_by_at_most (Rabs k) (radius_at r since k) t0 t1 /\ falls_by_at_most (Rabs k) (radius_at r since k) t0 t1.
Proof.
  assert (forall s t, s <= t -> - (Rabs k * (t - s)) <= k * (t - s) <= Rabs k * (t - s) /\ 0 <= Rabs k * (t - s)) as L.
  { intros s t H. generalize (Rle_abs k) (Rle_abs (- k)) (Rabs_pos k). rewrite Rabs_Ropp. intros.
    assert (k * (t - s) <= Rabs k * (t - s)) by (apply Rmult_le_compat_r; lra).
    assert (- k * (t - s) <= Rabs k * (t - s)) by (apply Rmult_le_compat_r; lra).
    assert (0 <= Rabs k * (t - s)) by (apply Rmult_le_pos; lra). lra. }
  split; intros s t Hs _; generalize (L s t ltac:(lra)); unfold radius_at;
    replace (k * (t - since)) with (k * (s - since) + k * (t - s)) by ring; unfold Rmax; repeat destruct Rle_dec; lra.
Qed.
(* Until the ball is a point, its radius falls as fast as the rate says. *)
Theorem radius_changes_at_its_rate_until_it_is_zero (r since k t0 t1 : R) :
  (forall t, t0 <= t <= t1 -> 0 <= r + k * (t - since)) -> grows_by_at_most k (radius_at r since k) t0 t1.
Proof.
  intros H s t Hs Ht. generalize (H s ltac:(lra)) (H t ltac:(lra)). unfold radius_at.
  replace (k * (t - since)) with (k * (s - since) + k * (t - s)) by ring. unfold Rmax. repeat destruct Rle_dec; lra.
Qed.

(* What the engine knows of such a body from its last report: the radius that it had then, and a velocity error with the
   rate in it. *)
Definition changing (b : body) (radius k : R) : body := Body radius (A b) (g b) (e0 b) (e1 b + k).

(* Lemma 1 for a radius that changes. *)
Lemma changing_ball_is_near (b : body) (m : motion) (radius : R -> R) (k t0 t1 t s : R) (p q : vector) :
  keeps_promise b m t0 t1 -> grows_by_at_most k radius t0 t1 -> t0 <= t -> 0 <= s -> t + s <= t1 -> true_report b m t p q ->
  let bound := bound_of (changing b (radius t) k) p q in
  norm (place m (t + s) - c bound s) + radius (t + s) <= rho bound s.
Proof.
  intros K G Ht Hs Ht1 T bound. generalize (centre_is_near b m t0 t1 t p q s K Ht Hs Ht1 T) (G t (t + s) ltac:(lra) Ht1).
  change (c (bound_of b p q) s) with (c bound s). unfold bound, rho, changing, bound_of. cbn [size growth_speed growth r A e0 e1].
  lra.
Qed.
Theorem changing_ball_lies_in_its_bound (b : body) (m : motion) (radius : R -> R) (k t0 t1 t s : R) (p q point : vector) :
  keeps_promise b m t0 t1 -> grows_by_at_most k radius t0 t1 -> t0 <= t -> 0 <= s -> t + s <= t1 -> true_report b m t p q ->
  in_ball point (place m (t + s)) (radius (t + s)) ->
  let bound := bound_of (changing b (radius t) k) p q in in_ball point (c bound s) (rho bound s).
Proof.
  intros K G Ht Hs Ht1 T I bound. generalize (changing_ball_is_near b m radius k t0 t1 t s p q K G Ht Hs Ht1 T). cbv zeta. fold bound.
  unfold in_ball in *. generalize (norm_by_way_of (place m (t + s)) point (c bound s)). lra.
Qed.

(* While the bounds are farther apart than a distance, so are the surfaces of the balls. *)
Lemma changing_balls_are_as_far_apart_as_their_bounds (a b : body) (ma mb : motion) (ra rb : R -> R)
  (ka kb t0 t1 ta tb t : R) (pa qa pb qb : vector) (distance : R) :
  keeps_promise a ma t0 t1 -> keeps_promise b mb t0 t1 -> grows_by_at_most ka ra t0 t1 -> grows_by_at_most kb rb t0 t1 ->
  t0 <= ta <= t -> t0 <= tb <= t -> t <= t1 -> true_report a ma ta pa qa -> true_report b mb tb pb qb ->
  let bound_a := bound_of (changing a (ra ta) ka) pa qa in let bound_b := bound_of (changing b (rb tb) kb) pb qb in
  rho bound_a (t - ta) + rho bound_b (t - tb) + distance < norm (c bound_a (t - ta) - c bound_b (t - tb)) ->
  distance < norm (place ma t - place mb t) - ra t - rb t.
Proof.
  intros Ka Kb Ga Gb Ha Hb Ht Ta Tb bound_a bound_b L.
  generalize (changing_ball_is_near a ma ra ka t0 t1 ta (t - ta) pa qa Ka Ga)
    (changing_ball_is_near b mb rb kb t0 t1 tb (t - tb) pb qb Kb Gb).
  replace (ta + (t - ta)) with t by ring. replace (tb + (t - tb)) with t by ring. intros Na Nb.
  specialize (Na ltac:(lra) ltac:(lra) ltac:(lra) Ta). specialize (Nb ltac:(lra) ltac:(lra) ltac:(lra) Tb).
  cbv zeta in Na, Nb. fold bound_a in Na. fold bound_b in Nb. set (ca := c bound_a (t - ta)) in *. set (cb := c bound_b (t - tb)) in *.
  generalize (norm_by_way_of (place ma t) ca cb) (norm_by_way_of (place mb t) (place ma t) cb).
  rewrite (norm_symmetric ca (place ma t)). lra.
Qed.

(* The certificate (Lemma 3) from two reports of one time t. The speed at which the gap may close along n has both velocity
   errors and the rates of both radii in it: while the quadratic is above zero, the gap of the two balls is above the
   distance. The rates may be the true ones, also below zero, until one of the two is a point; or their magnitudes. *)
Theorem certificate_with_both_rates_is_early (a b : body) (ma mb : motion) (ra rb : R -> R) (ka kb t0 t1 t d : R)
  (pa qa pb qb n : vector) (distance : R) :
  keeps_promise a ma t0 t1 -> keeps_promise b mb t0 t1 -> grows_by_at_most ka ra t0 t1 -> grows_by_at_most kb rb t0 t1 ->
  t0 <= t -> 0 <= d -> t + d <= t1 -> true_report a ma t pa qa -> true_report b mb t pb qb -> norm n <= 1 ->
  0 < quadratic (dot n (pa - pb) - ((ra t + e0 a) + (rb t + e0 b)) - distance)
        (dot n (qa - qb) - ((e1 a + ka) + (e1 b + kb))) (dot n (g a - g b) - (A a + A b)) d ->
  distance < norm (place ma (t + d) - place mb (t + d)) - ra (t + d) - rb (t + d).
Proof.
  intros Ka Kb Ga Gb Ht Hd Ht1 Ta Tb Hn Q.
  apply (changing_balls_are_as_far_apart_as_their_bounds a b ma mb ra rb ka kb t0 t1 t t (t + d) pa qa pb qb); auto; try lra.
  replace (t + d - t) with d by ring.
  exact (linearised_is_below (bound_of (changing a (ra t) ka) pa qa) (bound_of (changing b (rb t) kb) pb qb) n distance d Hn Q).
Qed.

(* The end of a contact: the same of what the radii may have fallen. *)
Theorem changing_balls_have_not_parted (a b : body) (ma mb : motion) (ra rb : R -> R) (ka kb t0 t1 ta tb t : R)
  (pa qa pb qb : vector) (distance : R) :
  keeps_promise a ma t0 t1 -> keeps_promise b mb t0 t1 -> falls_by_at_most ka ra t0 t1 -> falls_by_at_most kb rb t0 t1 ->
  t0 <= ta <= t -> t0 <= tb <= t -> t <= t1 -> true_report a ma ta pa qa -> true_report b mb tb pb qb ->
  let bound_a := bound_of (changing a (ra ta) ka) pa qa in let bound_b := bound_of (changing b (rb tb) kb) pb qb in
  norm (c bound_a (t - ta) - c bound_b (t - tb)) + growth_after bound_a (t - ta) + growth_after bound_b (t - tb) <
    (ra ta + e0 a) + (rb tb + e0 b) + distance ->
  norm (place ma t - place mb t) - ra t - rb t < distance + 2 * e0 a + 2 * e0 b.
Proof.
  intros Ka Kb Fa Fb Ha Hb Ht Ta Tb bound_a bound_b L. generalize (Fa ta t Ha Ht) (Fb tb t Hb Ht). intros La Lb.
  set (fallen := ka * (t - ta) + kb * (t - tb)).
  assert (norm (place ma t - place mb t) - ra ta - rb tb < distance - fallen + 2 * e0 a + 2 * e0 b); [|unfold fallen in *; lra].
  apply (bodies_have_not_parted (changing a (ra ta) 0) (changing b (rb tb) 0) ma mb t0 t1 ta tb t pa qa pb qb); auto.
  - destruct Ta as [P Q]. split; [exact P|]. cbn [changing e1]. lra.
  - destruct Tb as [P Q]. split; [exact P|]. cbn [changing e1]. lra.
  - revert L. unfold growth_after, fallen, bound_a, bound_b, changing, bound_of, c.
    cbn [start speed plan growth_speed growth r A g e0 e1]. lra.
Qed.
