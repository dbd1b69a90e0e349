(* Safe regions. A body stays in a ball of space whose border its bound does not reach (Core::stays), and two bodies whose
   regions are out of reach of each other are apart (RegionCells). *)
From Coq Require Import Reals Lra Psatz.
From Kinesphere Require Import geometry_vectors geometry_motion geometry_bounds geometry_certificates geometry_knowledge.
From Kinesphere Require Import contact_of_bodies.
Open Scope R_scope.

(* A line that is in a ball which shrinks, at both ends of a span, is in it throughout: the way to the border is a
   concave function of time. *)
Lemma line_stays_in_a_shrinking_ball (q v : vector) (room rate limit d e : R) :
  0 <= limit -> 0 <= e <= d ->
  norm q < room -> norm (q + d * v) < room - (rate + / 2 * limit * d) * d ->
  norm (q + e * v) < room - (rate + / 2 * limit * e) * e.
Proof.
  intros P [P0 Le] H0 Hd. destruct (Req_dec d 0) as [Z|Z].
  - assert (e = 0) by lra. subst e. replace (q + 0 * v)%vector with q by (destruct q, v; by_coordinates). lra.
  - set (k := e / d). assert (0 <= k <= 1) as [K0 K1].
    { unfold k. split; [apply Rmult_le_pos; [exact P0|apply Rlt_le, Rinv_0_lt_compat; lra]|].
      apply (Rmult_le_reg_r d); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by exact Z. lra. }
    assert (e = k * d) as E by (unfold k; field; exact Z).
    replace (q + e * v)%vector with ((1 - k) * q + k * (q + d * v))%vector by (rewrite E; by_coordinates).
    apply Rle_lt_trans with (1 := norm_plus _ _). rewrite !norm_times, !Rabs_pos_eq by lra.
    assert ((1 - k) * norm q + k * norm (q + d * v) < (1 - k) * room + k * (room - (rate + / 2 * limit * d) * d)) as S.
    { destruct (Req_dec k 0) as [->|]; [lra|].
      assert (k * norm (q + d * v) < k * (room - (rate + / 2 * limit * d) * d)) by (apply Rmult_lt_compat_l; lra).
      assert ((1 - k) * norm q <= (1 - k) * room) by (apply Rmult_le_compat_l; lra). lra. }
    apply Rlt_le_trans with (1 := S). rewrite E.
    assert (0 <= / 2 * limit * (d * d) * (k * (1 - k))).
    { apply Rmult_le_pos; [|apply Rmult_le_pos; lra]. apply Rmult_le_pos; [lra|nra]. }
    lra.
Qed.

(* Core::stays. If the bound as it is now, without what it can still grow, has not reached the border of the region now
   nor after a time d, its centre is in the region until then. What the plan bends its way by counts as growth. *)
Theorem body_stays_in_its_safe_region (b : body) (m : motion) (x : report) (now t d radius : R) (middle : vector) :
  0 <= A b -> keeps_since b m x t -> at_time x <= now <= t -> t <= now + d ->
  let p := moved_on (bound_from b x) (now - at_time x) in
  let room := radius - (size p - r b) in
  norm (start p - middle) < room ->
  norm ((start p - middle) + d * speed p) <
    room - (growth_speed p + / 2 * (growth p + norm_one (plan p)) * d) * d ->
  norm (place m t - middle) < radius.
Proof.
  intros PA K Hx Ht p room H0 Hd. set (e := t - now).
  assert (t - at_time x = (now - at_time x) + e) as E by (unfold e; ring).
  generalize (near_its_bound b m x t K ltac:(lra)). rewrite E, <- c_moved_on, <- rho_moved_on. fold p. intros N.
  assert (0 <= growth p + norm_one (plan p)) as P by (apply Rplus_le_le_0_compat; [exact PA|apply norm_one_positive]).
  generalize (line_stays_in_a_shrinking_ball _ _ room (growth_speed p) _ d e P ltac:(unfold e; lra) H0 Hd). intros S.
  assert (norm (c p e - middle) <= norm ((start p - middle) + e * speed p) + e * e / 2 * norm_one (plan p)) as Bend.
  { replace (c p e - middle)%vector with (((start p - middle) + e * speed p) + (e * e / 2) * plan p)%vector
      by (unfold c; by_coordinates).
    apply Rle_trans with (1 := norm_plus _ _). rewrite norm_times, Rabs_pos_eq by nra.
    apply Rplus_le_compat_l, Rmult_le_compat_l; [nra|apply norm_at_most_norm_one]. }
  generalize (norm_by_way_of (c p e) (place m t) middle). unfold rho in N. unfold room in S. nra.
Qed.

(* A body that stands still, as it has promised, stays where it is. *)
Theorem body_at_rest_stays_in_its_safe_region (b : body) (m : motion) (x : report) (t radius : R) (middle : vector) :
  A b = 0 -> e1 b = 0 -> g b = zero -> with_velocity x = zero ->
  keeps_since b m x t -> at_time x <= t -> norm (at_place x - middle) + e0 b <= radius ->
  norm (place m t - middle) <= radius.
Proof.
  intros ZA Z1 Zg Zv K Hx H. generalize (near_its_bound b m x t K Hx). unfold bound_from, bound_of, c, rho.
  cbn [start speed plan size growth_speed growth]. rewrite ZA, Z1, Zg, Zv.
  replace (at_place x + (t - at_time x) * zero + (t - at_time x) * (t - at_time x) / 2 * zero)%vector with (at_place x)
    by (destruct (at_place x); by_coordinates).
  generalize (norm_by_way_of (at_place x) (place m t) middle). lra.
Qed.

(* A region's reach covers the body: regions out of reach of each other hold bodies that are apart by more than a
   distance, if the reaches contain it. *)
Theorem bodies_in_regions_out_of_reach_are_apart (x y middle_x middle_y : vector) (rx ry radius_x radius_y reach_x reach_y : R)
  (distance : R) :
  norm (x - middle_x) <= radius_x -> norm (y - middle_y) <= radius_y ->
  radius_x + rx + distance / 2 <= reach_x -> radius_y + ry + distance / 2 <= reach_y ->
  reach_x + reach_y < norm (middle_x - middle_y) ->
  distance < norm (x - y) - rx - ry.
Proof.
  intros Hx Hy Rx Ry H. generalize (norm_by_way_of x middle_x middle_y) (norm_by_way_of y x middle_y).
  rewrite (norm_symmetric middle_x x). lra.
Qed.
