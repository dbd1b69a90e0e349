(* The Zeno guard's step of bodies with several points: along a direction that turns at a constant rate, all points keep
   their distances until the quadratics of all pairs of points are zero. *)
From Coq Require Import Reals Lra Psatz List.
From Kinesphere Require Import quadratic geometry_vectors geometry_motion geometry_bounds geometry_certificates
  geometry_shapes geometry_knowledge geometry_turning geometry_hulls.
Open Scope R_scope.

(* The direction `normal + s turn`; the turn is at right angles to the normal, whose length is 1. *)
Definition turned (normal turn : vector) (s : R) : vector := (normal + s * turn)%vector.

Lemma length_of_turned (normal turn : vector) (s : R) :
  norm normal = 1 -> dot normal turn = 0 ->
  1 <= norm (turned normal turn s) <= 1 + norm turn * norm turn * (s * s) / 2.
Proof.
  intros N M. generalize (norm_square normal) (norm_square turn). rewrite N. intros EN EM.
  assert (dot (turned normal turn s) (turned normal turn s) = 1 + norm turn * norm turn * (s * s)) as E.
  { replace (dot (turned normal turn s) (turned normal turn s))
      with (dot normal normal + 2 * s * dot normal turn + s * s * dot turn turn) by (unfold turned; by_coordinates).
    rewrite M, <- EN, <- EM. ring. }
  assert (0 <= norm turn * norm turn * (s * s)) as P by (generalize (norm_positive turn); intros; nra).
  split.
  - generalize (norm_positive (turned normal turn s)) (norm_square (turned normal turn s)). rewrite E. intros. nra.
  - apply norm_at_most; [lra|]. rewrite E. nra.
Qed.

(* A point has the position P, the velocity V and the plan G relative to another, both known with an error that grows with
   the speed e and the acceleration a. While its quadratic is above zero, it is more than the distance d along the turning
   direction, for the length of that direction. K bounds the distance with the growth up to the time T. *)
Theorem point_keeps_its_distance_along_a_turning_direction (normal turn P V G X : vector) (d e a K T s : R) :
  norm normal = 1 -> dot normal turn = 0 -> 0 <= e -> 0 <= a -> 0 <= s <= T ->
  d + e * T + a * (T * T) / 2 <= K -> 0 <= K ->
  norm (X - (P + s * V + (s * s / 2) * G)) <= e * s + a * (s * s) / 2 ->
  0 < (dot normal P - d) + (dot normal V + dot turn P - e) * s +
    (dot normal G + 2 * dot turn V - (a + norm turn * norm G * T + norm turn * norm turn * K)) * (s * s) / 2 ->
  d * norm (turned normal turn s) < dot (turned normal turn s) X.
Proof.
  intros N M He Ha Hs HK K0 HX H. destruct (length_of_turned normal turn s N M) as [L U].
  set (n := turned normal turn s) in *. set (C := (P + s * V + (s * s / 2) * G)%vector) in *.
  set (growth := e * s + a * (s * s) / 2) in *.
  assert (dot n C - norm n * growth <= dot n X) as A.
  { generalize (cauchy_schwarz n (C - X)). rewrite dot_minus, (norm_symmetric C X).
    assert (norm n * norm (X - C) <= norm n * growth) by (apply Rmult_le_compat_l; [lra|exact HX]). lra. }
  assert (dot n C = dot normal P + (dot normal V + dot turn P) * s + (dot normal G + 2 * dot turn V) * (s * s) / 2 +
    dot turn G * (s * s * s) / 2) as E by (unfold n, C, turned; coordinates; field).
  assert (- (norm turn * norm G * T * (s * s) / 2) <= dot turn G * (s * s * s) / 2) as B.
  { generalize (cauchy_schwarz turn ((-1) * G)). rewrite dot_times, norm_times, (Rabs_left (-1)) by lra. intros Q.
    generalize (norm_positive turn) (norm_positive G). intros Pt PG.
    assert (0 <= norm turn * norm G) by (apply Rmult_le_pos; assumption). assert (0 <= s * s) by nra.
    assert (norm turn * norm G * (s * s * s) <= norm turn * norm G * (T * (s * s))).
    { apply Rmult_le_compat_l; [assumption|]. rewrite (Rmult_comm T). apply Rmult_le_compat_l; lra. }
    assert (0 <= s * s * s) by nra. assert (- (norm turn * norm G) <= dot turn G) by lra. nra. }
  assert (norm n * (d + growth) <= d + growth + norm turn * norm turn * K * (s * s) / 2) as W.
  { assert (d + growth <= K) as LK.
    { unfold growth. assert (e * s <= e * T) by (apply Rmult_le_compat_l; lra).
      assert (a * (s * s) <= a * (T * T)) by (apply Rmult_le_compat_l; [lra|]; nra). lra. }
    assert (0 <= norm turn * norm turn * (s * s)) as Z by (generalize (norm_positive turn); intros; nra).
    destruct (Rle_lt_dec (d + growth) 0) as [F|F].
    - assert (norm n * (d + growth) <= 1 * (d + growth)) by nra.
      assert (0 <= norm turn * norm turn * (s * s) * K) by (apply Rmult_le_pos; assumption). lra.
    - assert (norm n * (d + growth) <= (1 + norm turn * norm turn * (s * s) / 2) * (d + growth))
        by (apply Rmult_le_compat_r; lra).
      assert (norm turn * norm turn * (s * s) * (d + growth) <= norm turn * norm turn * (s * s) * K)
        by (apply Rmult_le_compat_l; assumption). lra. }
  unfold growth in *. lra.
Qed.

(* Two parts with the radii r and q. If the quadratics of all pairs of their points are above zero, each with a distance of
   at least D beyond the radii, no gap between the parts is below D, whatever the direction and its turn. *)
Theorem parts_sink_no_deeper (normal turn p q x y : vector) (A B : list vector) (r1 r2 D s : R) :
  (forall a b, In a A -> In b B -> exists P V G d e a' K T,
    D <= d /\ norm normal = 1 /\ dot normal turn = 0 /\ 0 <= e /\ 0 <= a' /\ 0 <= s <= T /\
    r1 + r2 + d + e * T + a' * (T * T) / 2 <= K /\ 0 <= K /\
    norm ((a - b) - (P + s * V + (s * s / 2) * G)) <= e * s + a' * (s * s) / 2 /\
    0 < (dot normal P - (r1 + r2 + d)) + (dot normal V + dot turn P - e) * s +
      (dot normal G + 2 * dot turn V - (a' + norm turn * norm G * T + norm turn * norm turn * K)) * (s * s) / 2) ->
  hull A p -> hull B q -> in_ball x p r1 -> in_ball y q r2 -> D < norm (x - y).
Proof.
  intros H Hp Hq Hx Hy.
  apply (rounded_hulls_are_apart_along_a_direction (turned normal turn s) p q x y A B r1 r2 D); auto.
  intros a b Ia Ib. destruct (H a b Ia Ib) as (P & V & G & d & e & a' & K & T & HD & N & M & He & Ha & Hs & HK & K0 & X & Q).
  generalize (point_keeps_its_distance_along_a_turning_direction normal turn P V G (a - b) (r1 + r2 + d) e a' K T s
    N M He Ha Hs HK K0 X Q). rewrite dot_minus.
  assert ((r1 + r2 + D) * norm (turned normal turn s) <= (r1 + r2 + d) * norm (turned normal turn s))
    by (apply Rmult_le_compat_r; [apply norm_positive|lra]). lra.
Qed.

(* Where the fastest of all points moves relative to any other by no more than a way, the gap of two bodies shrinks by no
   more than that way, however many points they have. *)
Theorem gap_shrinks_by_no_more_than_points_move (x y x' y' : vector) (way gap : R) :
  norm ((x' - y') - (x - y)) <= way -> gap <= norm (x - y) -> gap - way <= norm (x' - y').
Proof.
  intros W G. generalize (norm_minus (x - y) (x' - y')). rewrite (norm_symmetric (x - y) (x' - y')). lra.
Qed.
