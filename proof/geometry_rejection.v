(* Which pairs may be left out: the quick rejection of two bounds, and the ball that goes straight on and holds a body. *)
From Coq Require Import Reals Lra Psatz.
From Kinesphere Require Import quadratic geometry_vectors geometry_motion geometry_bounds geometry_certificates.
Open Scope R_scope.

(* The straight line X + U s, when it is nearest to the origin, and how near. *)
Lemma square_on_line (X U : vector) (s : R) :
  dot (X + s * U) (X + s * U) = dot X X + 2 * s * dot X U + s * s * dot U U.
Proof. by_coordinates. Qed.
Lemma square_and_cross (X U : vector) (s : R) :
  dot (X + s * U) (X + s * U) * dot U U = dot (cross X U) (cross X U) + (dot X U + s * dot U U) * (dot X U + s * dot U U).
Proof. generalize (cauchy_schwarz_square X U). rewrite square_on_line. nra. Qed.

(* The three cases of the quick rejection, with the squares that it compares: X and V the differences of the centres and
   velocities now, and a sphere of radius R around the origin. *)
Definition straight_line_stays_out (X V : vector) (T R : R) : Prop :=
  R * R < dot X X /\
  (0 <= dot X V \/
   (dot V V * T <= - dot X V /\ R * R < dot (X + T * V) (X + T * V)) \/
   (R * R * dot V V < dot (cross X V) (cross X V))).

Lemma straight_line_is_out (X V : vector) (T R d : R) :
  straight_line_stays_out X V T R -> 0 <= d <= T -> R < norm (X + d * V).
Proof.
  intros [H0 H] Hd. apply norm_more. generalize (dot_self V). intros P. destruct H as [H|[[N H]|H]].
  - rewrite square_on_line. assert (0 <= d * dot X V) by nra. assert (0 <= d * d * dot V V) by nra. lra.
  - rewrite square_on_line in *. assert (0 <= (T - d) * (- 2 * dot X V - (T + d) * dot V V)); [|nra].
    apply Rmult_le_pos; [lra|]. assert (d * dot V V <= T * dot V V) by nra. nra.
  - generalize (square_and_cross X V d) (Rle_0_sqr (dot X V + d * dot V V)). unfold Rsqr. intros E Q.
    destruct P as [P|P]; [|rewrite <- P in *; generalize (dot_self (cross X V)); lra].
    apply Rmult_lt_reg_r with (dot V V); lra.
Qed.

(* The case with radii as they grow. The centres are at least as far apart as their distance along the line on which
   they are now, which changes at a constant rate; less the radii, it is a concave function of time. So if it is
   positive now and at the end T, it is positive throughout. Squares are compared, without a root or a division. *)
Lemma line_of_centres_is_out (X V : vector) (T r0 speed half d : R) :
  0 <= r0 -> 0 <= speed -> 0 <= half -> r0 * r0 < dot X X -> 0 < dot X X + T * dot X V ->
  (r0 + (speed + half * T) * T) * (r0 + (speed + half * T) * T) * dot X X < (dot X X + T * dot X V) * (dot X X + T * dot X V) ->
  0 <= d <= T -> r0 + (speed + half * d) * d < norm (X + d * V).
Proof.
  intros P0 Ps Ph H0 L H Hd. set (RT := r0 + (speed + half * T) * T) in *.
  assert (0 <= RT) by (unfold RT; assert (0 <= half * T) by nra; nra).
  generalize (norm_square X) (norm_positive X) (norm_more X r0 H0). intros E PN N0. set (N := norm X) in *.
  rewrite <- E in *. set (p := dot X V) in *.
  assert (RT * N < N * N + T * p).
  { apply Rsqr_incrst_0; unfold Rsqr; nra. }
  assert (N * (N + d * (p / N)) <= N * norm (X + d * V)).
  { replace (N * (N + d * (p / N))) with (dot X (X + d * V)).
    - unfold N. apply cauchy_schwarz.
    - rewrite dot_plus, dot_times, <- E. fold p. field. lra. }
  assert (N + d * (p / N) <= norm (X + d * V)) by (apply Rmult_le_reg_l with N; lra).
  assert (RT < N + T * (p / N)).
  { apply Rmult_lt_reg_l with N; [lra|]. replace (N * (N + T * (p / N))) with (N * N + T * p) by (field; lra). lra. }
  set (m := p / N) in *.
  destruct (Req_dec T 0) as [Z|Z]; [assert (d = 0) as -> by lra; lra|].
  assert (0 < T) by lra.
  assert (T * (r0 + (speed + half * d) * d) < T * (N + d * m)); [|assert (r0 + (speed + half * d) * d < N + d * m) by (apply Rmult_lt_reg_l with T; lra); lra].
  assert (T * (N + d * m) - T * (r0 + (speed + half * d) * d) =
          (T - d) * (N - r0) + d * (N + T * m - RT) + half * (d * (T * (T - d)))) as F by (unfold RT; ring).
  assert (0 <= half * (d * (T * (T - d)))) by (repeat apply Rmult_le_pos; lra).
  destruct (Rle_lt_or_eq_dec d T) as [Q|Q]; [lra| |].
  - assert (0 < (T - d) * (N - r0)) by nra. assert (0 <= d * (N + T * m - RT)) by nra. lra.
  - assert (0 < d * (N + T * m - RT)) by nra. assert (0 <= (T - d) * (N - r0)) by nra. lra.
Qed.

(* The relative motion is nearly a straight line: what the difference of the plans turns it by is at most this. *)
Lemma nearly_straight (a b : bound) (d : R) :
  norm (start a - start b + d * (speed a - speed b)) - d * d / 2 * norm_one (plan a - plan b) <= norm (C a b d).
Proof.
  set (X := (start a - start b)%vector). set (V := (speed a - speed b)%vector). set (G := (plan a - plan b)%vector).
  replace (C a b d) with ((X + d * V) - (- (d * d / 2)) * G)%vector
    by (unfold C, c, X, V, G; coordinates; apply (f_equal3 Vector); field).
  generalize (norm_minus (X + d * V) ((- (d * d / 2)) * G)).
  rewrite norm_times, Rabs_Ropp, Rabs_pos_eq by nra.
  generalize (norm_at_most_norm_one G). assert (0 <= d * d / 2) by nra. nra.
Qed.

(* The quick rejection: `stay_apart`, over the real numbers. Radii count as they are at the end, with a distance, and
   with half of what the difference G of the plans can turn the centres by then. If the straight line then stays out,
   the two bounds stay farther apart than the distance during all of the time T: a pair that is left alone cannot meet
   in it. *)
Theorem quick_rejection_leaves_out_only_what_cannot_meet (a b : bound) (T distance : R) :
  0 <= growth_speed a + growth_speed b -> 0 <= growth a + growth b ->
  straight_line_stays_out (start a - start b) (speed a - speed b) T
    (size a + size b + distance +
     (growth_speed a + growth_speed b + / 2 * (growth a + growth b + norm_one (plan a - plan b)) * T) * T) ->
  forall d, 0 <= d <= T -> Rs a b d + distance < norm (C a b d).
Proof.
  intros P1 P2 H d Hd. generalize (straight_line_is_out _ _ _ _ d H Hd) (nearly_straight a b d).
  generalize (norm_at_most_norm_one (plan a - plan b)) (norm_positive (plan a - plan b)). unfold Rs, rho.
  set (K := norm_one (plan a - plan b)). intros N1 N2 L1 L2.
  assert ((growth_speed a + growth_speed b) * d <= (growth_speed a + growth_speed b) * T) by (apply Rmult_le_compat_l; lra).
  assert (d * d <= T * T) by nra.
  assert ((growth a + growth b) * (d * d) <= (growth a + growth b) * (T * T)) by (apply Rmult_le_compat_l; lra).
  assert (d * d / 2 * K <= T * T / 2 * K) by (apply Rmult_le_compat_r; lra).
  nra.
Qed.

(* The same in the case with radii as they grow. *)
Theorem quick_rejection_along_the_line_of_centres (a b : bound) (T distance : R) :
  let X := (start a - start b)%vector in let V := (speed a - speed b)%vector in
  let r0 := size a + size b + distance in
  let rT := r0 + (growth_speed a + growth_speed b + / 2 * (growth a + growth b + norm_one (plan a - plan b)) * T) * T in
  0 <= r0 -> 0 <= growth_speed a + growth_speed b -> 0 <= growth a + growth b ->
  r0 * r0 < dot X X -> 0 < dot X X + T * dot X V -> rT * rT * dot X X < (dot X X + T * dot X V) * (dot X X + T * dot X V) ->
  forall d, 0 <= d <= T -> Rs a b d + distance < norm (C a b d).
Proof.
  intros X V r0 rT P0 P1 P2 H0 L H d Hd.
  generalize (norm_at_most_norm_one (plan a - plan b)) (norm_positive (plan a - plan b)) (nearly_straight a b d).
  fold X V. set (K := norm_one (plan a - plan b)) in *. intros N1 N2 N3.
  assert (0 <= / 2 * (growth a + growth b + K)) as Ph by lra.
  generalize (line_of_centres_is_out X V T r0 _ _ d P0 P1 Ph H0 L H Hd). unfold Rs, rho, r0. nra.
Qed.

(* Where centres go straight on, F(d) = |X + V d|^2 - R(d)^2. *)
Definition F (X V : vector) (R0 R1 R2 d : R) : R :=
  dot (X + d * V) (X + d * V) - quadratic R0 R1 R2 d * quadratic R0 R1 R2 d.
(* Its derivative. *)
Definition F' (X V : vector) (R0 R1 R2 d : R) : R :=
  2 * (dot X V + d * dot V V - quadratic R0 R1 R2 d * (R1 + R2 * d)).

(* If |V|^2 is not below R'^2 + R R'' at d0, F is convex until then: it lies above each of its tangents. *)
Lemma above_the_tangent (X V : vector) (R0 R1 R2 d0 t d : R) :
  0 <= R0 -> 0 <= R1 -> 0 <= R2 -> 0 <= t <= d0 -> 0 <= d <= d0 ->
  (R1 + R2 * d0) * (R1 + R2 * d0) + quadratic R0 R1 R2 d0 * R2 <= dot V V ->
  F X V R0 R1 R2 t + F' X V R0 R1 R2 t * (d - t) <= F X V R0 R1 R2 d.
Proof.
  intros P0 P1 P2 Ht Hd K.
  assert (F X V R0 R1 R2 d - F X V R0 R1 R2 t - F' X V R0 R1 R2 t * (d - t) =
    (d - t) * (d - t) * (dot V V - (R1 * R1 + R0 * R2 + R1 * R2 * (d + 2 * t) +
      / 4 * (R2 * R2) * (d * d + 2 * d * t + 3 * (t * t))))) as E.
  { unfold F, F', quadratic. rewrite !square_on_line. field. }
  assert (0 <= dot V V - (R1 * R1 + R0 * R2 + R1 * R2 * (d + 2 * t) +
      / 4 * (R2 * R2) * (d * d + 2 * d * t + 3 * (t * t)))) as Q.
  { assert (R1 * R2 * (d + 2 * t) <= R1 * R2 * (3 * d0)) by (apply Rmult_le_compat_l; nra).
    assert (R2 * R2 * (d * d + 2 * d * t + 3 * (t * t)) <= R2 * R2 * (6 * (d0 * d0))).
    { apply Rmult_le_compat_l; [nra|]. assert (d * d <= d0 * d0) by nra. assert (d * t <= d0 * d0) by nra.
      assert (t * t <= d0 * d0) by nra. lra. }
    unfold quadratic in K. nra. }
  generalize (Rmult_le_pos _ _ (Rle_0_sqr (d - t)) Q). unfold Rsqr. lra.
Qed.

(* A tangent that falls, taken at any t until d0, meets zero no later than F does first. At the root d0 that F would
   have were the growth steady, and at the time where the tangent there meets zero: two tangents, two earlier times. *)
Theorem tangent_meets_zero_early (X V : vector) (R0 R1 R2 d0 t : R) :
  0 <= R0 -> 0 <= R1 -> 0 <= R2 -> 0 <= t <= d0 ->
  (R1 + R2 * d0) * (R1 + R2 * d0) + quadratic R0 R1 R2 d0 * R2 <= dot V V ->
  F' X V R0 R1 R2 t < 0 ->
  forall d, 0 <= d <= d0 -> d < t - F X V R0 R1 R2 t / F' X V R0 R1 R2 t ->
  quadratic R0 R1 R2 d < norm (X + d * V).
Proof.
  intros P0 P1 P2 Ht K N d Hd L. apply norm_more.
  generalize (above_the_tangent X V R0 R1 R2 d0 t d P0 P1 P2 Ht Hd K).
  assert (0 < F X V R0 R1 R2 t + F' X V R0 R1 R2 t * (d - t)) as Q.
  { set (f := F X V R0 R1 R2 t) in *. set (s := F' X V R0 R1 R2 t) in *.
    assert (f / s * s = f) by (field; lra). nra. }
  unfold F at 2. lra.
Qed.

(* `BoundAt::radius_after`: the radius R + margin + (b + (a + |g|_1) T / 2) T. A ball of that radius that goes straight on
   from X with V holds, from now until T later, the bound, and with it the body, with its margin. *)
Definition radius_after (b : bound) (margin T : R) : R :=
  size b + margin + (growth_speed b + (growth b + norm_one (plan b)) * T / 2) * T.

Lemma bound_stays_near_its_straight_way (b : bound) (margin T d : R) : 0 <= growth_speed b -> 0 <= growth b -> 0 <= d <= T ->
  norm (c b d - (start b + d * speed b)) + rho b d + margin <= radius_after b margin T.
Proof.
  intros P1 P2 Hd.
  replace (c b d - (start b + d * speed b))%vector with ((d * d / 2) * plan b)%vector by (unfold c; by_coordinates).
  rewrite norm_times, Rabs_pos_eq by nra. unfold rho, radius_after.
  generalize (norm_at_most_norm_one (plan b)) (norm_one_positive (plan b)) (norm_positive (plan b)). intros N1 N2 N3.
  set (K := norm_one (plan b)) in *.
  assert (d * d <= T * T) by nra.
  assert (growth_speed b * d <= growth_speed b * T) by (apply Rmult_le_compat_l; lra).
  assert (growth b * (d * d) <= growth b * (T * T)) by (apply Rmult_le_compat_l; lra).
  assert (d * d / 2 * norm (plan b) <= T * T / 2 * K) by (apply Rmult_le_compat; nra).
  lra.
Qed.

Theorem body_stays_near_its_straight_way (b : body) (m : motion) (t0 t1 t s T d margin : R) (p q point : vector) :
  0 <= e1 b -> 0 <= A b -> keeps_promise b m t0 t1 -> t0 <= t -> 0 <= s -> 0 <= d <= T -> t + s + d <= t1 ->
  true_report b m t p q ->
  let now := moved_on (bound_of b p q) s in
  in_ball point (place m (t + s + d)) (r b + margin) ->
  in_ball point (start now + d * speed now) (radius_after now margin T).
Proof.
  intros P1 P2 K Ht Hs Hd Ht1 Tr now I. unfold in_ball in *.
  assert (0 <= growth_speed now) as G1 by (unfold now; cbn; nra).
  generalize (bound_stays_near_its_straight_way now margin T d G1 P2 Hd).
  generalize (centre_is_near b m t0 t1 t p q (s + d) K Ht ltac:(lra) ltac:(lra) Tr).
  replace (t + (s + d)) with (t + s + d) by ring.
  assert (rho now d = rho (bound_of b p q) (s + d)) as -> by (apply rho_moved_on).
  replace (c (bound_of b p q) (s + d)) with (c now d) by (apply c_moved_on).
  generalize (norm_by_way_of (place m (t + s + d)) point (start now + d * speed now))
    (norm_by_way_of (c now d) (place m (t + s + d)) (start now + d * speed now)). lra.
Qed.
