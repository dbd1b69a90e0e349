(* Why certificates are true: Lemma 3, half-spaces, and what guards the end of a contact. *)
From Coq Require Import Reals Lra Psatz List.
From Kinesphere Require Import quadratic geometry_vectors geometry_motion geometry_bounds.
Open Scope R_scope.

(* A bound seen from a later instant: s later it is the bound that it was, with times counted from there. *)
Definition moved_on (b : bound) (s : R) : bound :=
  Bound (c b s) (speed b + s * plan b) (plan b) (rho b s) (growth_speed b + growth b * s) (growth b).

Lemma c_moved_on b s d : c (moved_on b s) d = c b (s + d).
Proof. unfold moved_on, c. cbn [start speed plan]. coordinates. apply (f_equal3 Vector); field. Qed.
Lemma rho_moved_on b s d : rho (moved_on b s) d = rho b (s + d).
Proof. unfold moved_on, rho. cbn [size growth_speed growth]. field. Qed.

(* The difference C of centres and the sum Rs of radii of two bounds, the time d after one instant. *)
Definition C (a b : bound) (d : R) : vector := (c a d - c b d)%vector.
Definition Rs (a b : bound) (d : R) : R := rho a d + rho b d.

(* The quadratic n.C(d) - R(d) - distance, by its coefficients. *)
Definition constant (a b : bound) (n : vector) (distance : R) : R := dot n (start a - start b) - (size a + size b) - distance.
Definition linear (a b : bound) (n : vector) : R := dot n (speed a - speed b) - (growth_speed a + growth_speed b).
Definition square (a b : bound) (n : vector) : R := dot n (plan a - plan b) - (growth a + growth b).

Lemma linearised (a b : bound) (n : vector) (distance d : R) :
  dot n (C a b d) - Rs a b d - distance = quadratic (constant a b n distance) (linear a b n) (square a b n) d.
Proof. unfold C, Rs, c, rho, quadratic, constant, linear, square. coordinates. field. Qed.

(* Where the quadratic is above zero the bounds are farther apart than the distance. A unit vector is not needed: one
   that is not longer will do, and so will none. *)
Lemma linearised_is_below (a b : bound) (n : vector) (distance d : R) : norm n <= 1 ->
  0 < quadratic (constant a b n distance) (linear a b n) (square a b n) d -> Rs a b d + distance < norm (C a b d).
Proof. intros Hn. rewrite <- linearised. generalize (dot_at_most_norm n (C a b d) Hn). lra. Qed.

(* Where a quadratic that begins above zero is not above it at m, its first root, in the form that does not cancel, is
   at m or before. *)
Lemma first_root (k b a m : R) : 0 < k -> 0 <= m -> quadratic k b a m <= 0 ->
  let d := 2 * k / (sqrt (b * b - 2 * a * k) - b) in
  0 <= b * b - 2 * a * k /\ 0 < d <= m /\ quadratic k b a d = 0 /\
  forall e, 0 <= e < d -> 0 < quadratic k b a e.
Proof.
  intros Hk Hm Q d.
  assert (0 <= b * b - 2 * a * k) as P.
  { apply Rnot_lt_le. intros N. generalize (quadratic_without_root k b a m Hk N). lra. }
  set (S := sqrt (b * b - 2 * a * k)) in *.
  assert (S * S = b * b - 2 * a * k) as E by (apply sqrt_sqrt; exact P). assert (0 <= S) as HS by apply sqrt_pos.
  assert (2 * k <= m * (S - b)) as L.
  { apply Rnot_lt_le. intros N. generalize (quadratic_before_root k b a m S Hk HS E Hm N). lra. }
  assert (0 < S - b) as H by nra.
  assert (d * (S - b) = 2 * k) as Ed by (unfold d; field; lra).
  split; [exact P|]. split; [split; [apply Rdiv_lt_0_compat; lra|nra]|]. split.
  - unfold quadratic. apply Rmult_eq_reg_l with ((S - b) * (S - b)); [|nra].
    replace ((S - b) * (S - b) * (k + b * d + / 2 * a * (d * d)))
      with (k * ((S - b) * (S - b)) + b * (d * (S - b)) * (S - b) + / 2 * a * ((d * (S - b)) * (d * (S - b)))) by ring.
    rewrite Ed. replace ((S - b) * (S - b)) with (S * S - 2 * b * S + b * b) by ring. rewrite E. field.
  - intros e He. apply (quadratic_before_root k b a e S Hk HS E); nra.
Qed.

(* Lemma 3. Let n be a unit vector (or shorter), and let the quadratic n.C(d) - R(d) - distance be above zero now, at
   d = 0. If the two bounds come within the distance of each other at some time m, then the quadratic has a first root,
   which is not later than m; and before it the bounds are farther apart than the distance. *)
Theorem first_root_is_not_later_than_the_meeting (a b : bound) (n : vector) (distance m : R) :
  norm n <= 1 -> 0 <= m -> 0 < dot n (C a b 0) - Rs a b 0 - distance -> norm (C a b m) <= Rs a b m + distance ->
  exists d1, 0 < d1 <= m /\ dot n (C a b d1) - Rs a b d1 - distance = 0 /\
    forall d, 0 <= d < d1 -> 0 < dot n (C a b d) - Rs a b d - distance /\ Rs a b d + distance < norm (C a b d).
Proof.
  intros Hn Hm. rewrite linearised. intros H0 M.
  assert (0 < constant a b n distance) as P by (unfold quadratic in H0; lra).
  assert (quadratic (constant a b n distance) (linear a b n) (square a b n) m <= 0) as Q.
  { apply Rnot_lt_le. intros N. generalize (linearised_is_below a b n distance m Hn N). lra. }
  destruct (first_root _ _ _ m P Hm Q) as (_ & D & Z & B). eexists. split; [exact D|].
  rewrite linearised. split; [exact Z|]. intros d Hd. rewrite linearised.
  split; [apply B; exact Hd|]. apply (linearised_is_below a b n); [exact Hn|]. apply B. exact Hd.
Qed.

(* While the bounds are farther apart than a distance, so are the surfaces of the bodies, whatever they do. The reports
   are from the times ta and tb, and t is any later one. *)
Lemma bodies_are_as_far_apart_as_their_bounds (a b : body) (ma mb : motion) (t0 t1 ta tb t : R) (pa qa pb qb : vector)
  (distance : R) :
  keeps_promise a ma t0 t1 -> keeps_promise b mb t0 t1 -> t0 <= ta <= t -> t0 <= tb <= t -> t <= t1 ->
  true_report a ma ta pa qa -> true_report b mb tb pb qb ->
  rho (bound_of a pa qa) (t - ta) + rho (bound_of b pb qb) (t - tb) + distance <
    norm (c (bound_of a pa qa) (t - ta) - c (bound_of b pb qb) (t - tb)) ->
  distance < norm (place ma t - place mb t) - r a - r b.
Proof.
  intros Ka Kb Ha Hb Ht Ta Tb L.
  generalize (centre_is_near a ma t0 t1 ta pa qa (t - ta) Ka) (centre_is_near b mb t0 t1 tb pb qb (t - tb) Kb).
  replace (ta + (t - ta)) with t by ring. replace (tb + (t - tb)) with t by ring. intros Na Nb.
  specialize (Na ltac:(lra) ltac:(lra) ltac:(lra) Ta). specialize (Nb ltac:(lra) ltac:(lra) ltac:(lra) Tb).
  set (ca := c (bound_of a pa qa) (t - ta)) in *. set (cb := c (bound_of b pb qb) (t - tb)) in *.
  generalize (norm_by_way_of (place ma t) ca cb) (norm_by_way_of (place mb t) (place ma t) cb).
  rewrite (norm_symmetric ca (place ma t)). lra.
Qed.

(* A half-space: no point p in it has n.p below the offset. Where n.c(s) - rho(s) is above the offset and a distance, so
   is the gap, and so all points of the body are on this side. *)
Theorem wall_is_not_met (b : body) (m : motion) (t0 t1 t s : R) (p q n : vector) (offset distance : R) :
  norm n = 1 -> keeps_promise b m t0 t1 -> t0 <= t -> 0 <= s -> t + s <= t1 -> true_report b m t p q ->
  0 < dot n (c (bound_of b p q) s) - rho (bound_of b p q) s - offset - distance ->
  distance < dot n (place m (t + s)) - offset - r b /\
  forall point, in_ball point (place m (t + s)) (r b) -> offset + distance < dot n point.
Proof.
  intros Hn K Ht Hs Ht1 T L. generalize (centre_is_near b m t0 t1 t p q s K Ht Hs Ht1 T). intros N.
  set (x := place m (t + s)) in *. set (y := c (bound_of b p q) s) in *.
  assert (dot n y - dot n x <= norm (x - y)) as W.
  { rewrite <- dot_minus, norm_symmetric. apply dot_at_most_norm. lra. }
  split; [lra|]. intros point I. unfold in_ball in I.
  assert (dot n x - dot n point <= norm (point - x)); [|lra].
  rewrite <- dot_minus, norm_symmetric. apply dot_at_most_norm. lra.
Qed.

(* No certificate can be better: where it is not above zero, a point of the bound is not beyond the distance. *)
Theorem wall_certificate_is_exact (b : bound) (s : R) (n : vector) (offset distance : R) :
  norm n = 1 -> 0 <= rho b s -> dot n (c b s) - rho b s - offset - distance <= 0 ->
  exists point, in_ball point (c b s) (rho b s) /\ dot n point <= offset + distance.
Proof.
  intros Hn Hr L. exists (c b s - rho b s * n)%vector. split.
  - unfold in_ball. replace (c b s - rho b s * n - c b s)%vector with ((- rho b s) * n)%vector by by_coordinates.
    rewrite norm_times, Rabs_Ropp, Rabs_pos_eq, Hn by exact Hr. lra.
  - rewrite dot_minus, dot_times, <- norm_square, Hn. lra.
Qed.

(* The end of a contact. S(d) = R(0) + distance - growth(d): while |C(d)| is below it, the gap is below the distance.
   With errors, positions and radii count as they are reported, r + e0: then the true gap may be larger by 2 e0 of each.
   *)
Definition growth_after (b : bound) (s : R) : R := growth_speed b * s + growth b * (s * s / 2).
Lemma rho_of b p q s : rho (bound_of b p q) s = r b + e0 b + growth_after (bound_of b p q) s.
Proof. unfold rho, growth_after, bound_of. cbn [size growth_speed growth]. ring. Qed.

Theorem bodies_have_not_parted (a b : body) (ma mb : motion) (t0 t1 ta tb t : R) (pa qa pb qb : vector) (distance : R) :
  keeps_promise a ma t0 t1 -> keeps_promise b mb t0 t1 -> t0 <= ta <= t -> t0 <= tb <= t -> t <= t1 ->
  true_report a ma ta pa qa -> true_report b mb tb pb qb ->
  norm (c (bound_of a pa qa) (t - ta) - c (bound_of b pb qb) (t - tb)) +
    growth_after (bound_of a pa qa) (t - ta) + growth_after (bound_of b pb qb) (t - tb) <
    (r a + e0 a) + (r b + e0 b) + distance ->
  norm (place ma t - place mb t) - r a - r b < distance + 2 * e0 a + 2 * e0 b.
Proof.
  intros Ka Kb Ha Hb Ht Ta Tb L.
  generalize (centre_is_near a ma t0 t1 ta pa qa (t - ta) Ka) (centre_is_near b mb t0 t1 tb pb qb (t - tb) Kb).
  replace (ta + (t - ta)) with t by ring. replace (tb + (t - tb)) with t by ring. intros Na Nb.
  specialize (Na ltac:(lra) ltac:(lra) ltac:(lra) Ta). specialize (Nb ltac:(lra) ltac:(lra) ltac:(lra) Tb).
  rewrite rho_of in Na, Nb.
  set (ca := c (bound_of a pa qa) (t - ta)) in *. set (cb := c (bound_of b pb qb) (t - tb)) in *.
  generalize (norm_by_way_of ca (place ma t) (place mb t)) (norm_by_way_of cb ca (place mb t)).
  rewrite (norm_symmetric cb (place mb t)). lra.
Qed.

(* A body has not left a wall while its bound's farthest is nearer than the distance. *)
Theorem wall_has_not_been_left (b : body) (m : motion) (t0 t1 t s : R) (p q n : vector) (offset distance : R) :
  norm n = 1 -> keeps_promise b m t0 t1 -> t0 <= t -> 0 <= s -> t + s <= t1 -> true_report b m t p q ->
  0 < offset - dot n (c (bound_of b p q) s) + (r b + e0 b) - growth_after (bound_of b p q) s + distance ->
  dot n (place m (t + s)) - offset - r b < distance + 2 * e0 b.
Proof.
  intros Hn K Ht Hs Ht1 T L. generalize (centre_is_near b m t0 t1 t p q s K Ht Hs Ht1 T). intros N.
  assert (dot n (place m (t + s)) - dot n (c (bound_of b p q) s) <= norm (place m (t + s) - c (bound_of b p q) s)) as W.
  { rewrite <- dot_minus. apply dot_at_most_norm. lra. }
  rewrite rho_of in N. lra.
Qed.

(* One step of the certificate of separation. Seen from an instant, let S(e) = s0 - s1 e - a e^2 / 2, with s0 > 0, and
   C(e) = X + V e + G e^2 / 2. The quartic S(e)^2 - |C(e)|^2 has these coefficients: *)
Definition q0 (s0 : R) (X : vector) : R := s0 * s0 - dot X X.
Definition q1 (s0 s1 : R) (X V : vector) : R := - 2 * (s0 * s1 + dot X V).
Definition q2 (s0 s1 a : R) (X V G : vector) : R := s1 * s1 - s0 * a - dot V V - dot X G.
Definition q3 (s1 a : R) (V G : vector) : R := s1 * a - dot V G.
Definition q4 (a : R) (G : vector) : R := / 4 * (a * a - dot G G).

Lemma separation_quartic (s0 s1 a e : R) (X V G : vector) :
  let S := s0 - s1 * e - a * (e * e / 2) in let Ce := (X + e * V + (e * e / 2) * G)%vector in
  S * S - dot Ce Ce = q0 s0 X + q1 s0 s1 X V * e + q2 s0 s1 a X V G * (e * e) + q3 s1 a V G * (e * e * e) +
    q4 a G * (e * e * e * e).
Proof. cbv zeta. unfold q0, q1, q2, q3, q4. coordinates. field. Qed.

(* For a range k, replace the cubic and quartic terms by their least values there, - (fall3 + fall4 k) k e^2. As long as
   the quadratic that is left stays above zero, and within the range, |C(e)| < S(e): the two have not parted. *)
Theorem separation_step_is_safe (s0 s1 a k step fall3 fall4 : R) (X V G : vector) :
  0 < s0 -> step <= k -> 0 <= fall3 -> - q3 s1 a V G <= fall3 -> 0 <= fall4 -> - q4 a G <= fall4 ->
  (forall e, 0 <= e < step ->
    0 < q0 s0 X + q1 s0 s1 X V * e + (q2 s0 s1 a X V G - (fall3 + fall4 * k) * k) * (e * e)) ->
  forall e, 0 <= e < step -> norm (X + e * V + (e * e / 2) * G)%vector < s0 - s1 * e - a * (e * e / 2).
Proof.
  intros P Hk F3 Q3 F4 Q4 Q.
  set (S := fun e => s0 - s1 * e - a * (e * e / 2)).
  assert (forall e, 0 <= e < step -> 0 < S e * S e - dot (X + e * V + (e * e / 2) * G) (X + e * V + (e * e / 2) * G)) as L.
  { intros e He. unfold S. rewrite separation_quartic. specialize (Q e He).
    assert (0 <= e * e) as E2 by nra. assert (0 <= e * e * e) as E3 by nra. assert (0 <= e * e * e * e) as E4 by nra.
    assert (- fall3 * (e * e * e) <= q3 s1 a V G * (e * e * e)) by nra.
    assert (- fall4 * (e * e * e * e) <= q4 a G * (e * e * e * e)) by nra.
    assert (fall3 * (e * e * e) <= fall3 * (k * (e * e))) by (apply Rmult_le_compat_l; nra).
    assert (fall4 * (e * e * e * e) <= fall4 * (k * k * (e * e))).
    { apply Rmult_le_compat_l; [exact F4|].
      replace (e * e * e * e) with (e * e * (e * e)) by ring. apply Rmult_le_compat_r; nra. }
    lra. }
  (* S is positive at first, and cannot pass zero while its square is above another. *)
  assert (forall e, 0 <= e < step -> 0 < S e) as PS.
  { intros e He. apply Rnot_le_lt. intros N.
    destruct (IVT_cor (fun x => - S x) 0 e) as (z & Hz & Z).
    - unfold S. apply derivable_continuous. reg.
    - lra.
    - unfold S at 1. nra.
    - specialize (L z ltac:(lra)). assert (S z = 0) as E by lra. rewrite E in L.
      generalize (dot_self (X + z * V + (z * z / 2) * G)). lra. }
  intros e He. specialize (L e He). specialize (PS e He). fold (S e).
  generalize (norm_positive (X + e * V + (e * e / 2) * G)) (norm_square (X + e * V + (e * e / 2) * G)). nra.
Qed.

(* Of two that go straight on, C + V d, and grow by g + s d + a d^2 / 2: if the distance of the centres with the growth
   is below a reach now and at some time, it is so until then, since it is a convex function. *)
Theorem two_that_go_straight_stay_within (C V : vector) (g s a reach T : R) :
  0 <= a -> 0 < T -> norm C + g < reach -> norm (C + T * V)%vector + (g + s * T + a * (T * T / 2)) < reach ->
  forall d, 0 <= d <= T -> norm (C + d * V)%vector + (g + s * d + a * (d * d / 2)) < reach.
Proof.
  intros A HT B E d Hd.
  set (k := d / T). assert (d = k * T) as D by (unfold k; field; lra).
  assert (0 <= k) as K0 by (unfold k; apply Rmult_le_pos; [lra | left; apply Rinv_0_lt_compat; lra]).
  assert (k <= 1) as K1 by nra.
  assert (C + d * V = (1 - k) * C + k * (C + T * V))%vector as W by (rewrite D; by_coordinates).
  generalize (norm_plus ((1 - k) * C) (k * (C + T * V))). rewrite <- W, !norm_times.
  rewrite (Rabs_pos_eq (1 - k)), (Rabs_pos_eq k) by lra. intros N.
  assert (d * d <= k * (T * T)) as Q.
  { rewrite D. assert (0 <= k * (1 - k) * (T * T)) by (apply Rmult_le_pos; [nra | nra]). nra. }
  assert (a * (d * d / 2) <= k * (a * (T * T / 2))) as G by nra.
  set (now := norm C + g) in *. set (later := norm (C + T * V)%vector + (g + s * T + a * (T * T / 2))) in *.
  apply Rle_lt_trans with ((1 - k) * now + k * later).
  - unfold now, later. rewrite D in *. lra.
  - destruct (Rle_lt_or_eq_dec k 1 K1) as [L | ->]; [|lra].
    assert (0 < (1 - k) * (reach - now)) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= k * (reach - later)) by (apply Rmult_le_pos; lra). lra.
Qed.
