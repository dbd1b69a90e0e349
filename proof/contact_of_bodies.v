(* From doubles to bodies: what earliest_meeting and the search compute, operation by operation, says how two bodies
   move, whatever they do within their promises. *)
From Coq Require Import Reals Lra.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require floats errors inputs kernels sum_down direction meeting_coefficients earliest_meeting meeting_parts meeting_errors meeting_facts wall_meeting
  pair_meeting.
From Kinesphere Require Import rounding geometry_vectors geometry_motion geometry_bounds geometry_certificates geometry_knowledge
  geometry_radii.
Open Scope R_scope.
Notation finite x := (is_finite x = true).

(* The numbers of a bound are a report, and the promise of the body. Radius and limits may have been rounded up; and the
   radius may be the rounded sum of the body's radius and of the error of its position, as bound_of makes it. *)
Definition describes (f : inputs.bound) (b : body) (x : report) : Prop :=
  B (inputs.time f) = at_time x /\
  Vector (B (inputs.position_x f)) (B (inputs.position_y f)) (B (inputs.position_z f)) = at_place x /\
  Vector (B (inputs.velocity_x f)) (B (inputs.velocity_y f)) (B (inputs.velocity_z f)) = with_velocity x /\
  Vector (B (inputs.plan_x f)) (B (inputs.plan_y f)) (B (inputs.plan_z f)) = g b /\
  r b + e0 b <= B (inputs.radius f) * (1 + 3 * u) /\ e1 b <= B (inputs.growth_speed f) /\ A b <= B (inputs.acceleration_limit f).

Lemma rounded_radius (x y : floats.double) : 0 <= B x + B y -> finite (floats.add x y) -> B x + B y <= B (floats.add x y) * (1 + 3 * u).
Proof.
  intros P F. destruct (floats.add_finite _ _ F) as (_ & _ & E). generalize (errors.rounded_sum (prec := 53) (emax := 1024) x y).
  rewrite <- E, (Rabs_pos_eq _ P). change (errors.roundoff (prec := 53)) with u. intros R. apply Rabs_le_inv in R.
  rewrite u_value in *. lra.
Qed.

(* Since its report a body keeps its promise, and the report is true. *)
Definition keeps_since (b : body) (m : motion) (x : report) (until : R) : Prop :=
  keeps_promise b m (at_time x) until /\ true_report b m (at_time x) (at_place x) (with_velocity x).

Definition gap (a b : body) (ma mb : motion) (t : R) : R := norm (place ma t - place mb t) - r a - r b.

Lemma near_its_bound (b : body) (m : motion) (x : report) (t : R) :
  keeps_since b m x t -> at_time x <= t ->
  norm (place m t - c (bound_from b x) (t - at_time x)) <= rho (bound_from b x) (t - at_time x) - r b.
Proof.
  intros [K T] H. generalize (centre_is_near b m (at_time x) t (at_time x) (at_place x) (with_velocity x) (t - at_time x) K).
  replace (at_time x + (t - at_time x)) with t by ring. intros N. apply N; auto; lra.
Qed.

Lemma bounds_apart_bodies_apart (a b : body) (ma mb : motion) (x y : report) (distance t : R) :
  keeps_since a ma x t -> keeps_since b mb y t -> at_time x <= t -> at_time y <= t ->
  rho (bound_from a x) (t - at_time x) + rho (bound_from b y) (t - at_time y) + distance <
    norm (c (bound_from a x) (t - at_time x) - c (bound_from b y) (t - at_time y)) ->
  distance < gap a b ma mb t.
Proof.
  intros Ka Kb Ha Hb L. generalize (near_its_bound a ma x t Ka Ha) (near_its_bound b mb y t Kb Hb). unfold gap.
  set (ca := c (bound_from a x) (t - at_time x)) in *. set (cb := c (bound_from b y) (t - at_time y)) in *.
  generalize (norm_by_way_of (place ma t) ca cb) (norm_by_way_of (place mb t) (place ma t) cb).
  rewrite (norm_symmetric ca (place ma t)). lra.
Qed.

(* The same of two balls whose radii change, with the rates of their radii in the bounds. *)
Lemma changing_ball_near_its_bound (b : body) (m : motion) (radius : R -> R) (k : R) (x : report) (t : R) :
  keeps_since b m x t -> grows_by_at_most k radius (at_time x) t -> at_time x <= t ->
  let bound := bound_from (changing b (radius (at_time x)) k) x in
  norm (place m t - c bound (t - at_time x)) + radius t <= rho bound (t - at_time x).
Proof.
  intros [K T] G H bound.
  generalize (changing_ball_is_near b m radius k (at_time x) t (at_time x) (t - at_time x) (at_place x) (with_velocity x) K G).
  replace (at_time x + (t - at_time x)) with t by ring. intros N. apply N; auto; lra.
Qed.

Lemma distance_of_bounds (f h : inputs.bound) (a b : body) (x y : report) (t : R) :
  describes f a x -> describes h b y ->
  earliest_meeting.distance_at f h t = norm (c (bound_from a x) (t - at_time x) - c (bound_from b y) (t - at_time y)).
Proof.
  intros (T & P & V & G & _) (T' & P' & V' & G' & _).
  unfold earliest_meeting.distance_at, direction.norm, norm, bound_from, bound_of, c. cbn [start speed plan].
  rewrite <- P, <- V, <- G, <- P', <- V', <- G', <- T, <- T'. unfold meeting_coefficients.moved. f_equal. coordinates. field.
Qed.
Lemma radius_of_bound (f : inputs.bound) (b : body) (x : report) (t : R) :
  describes f b x -> at_time x <= t ->
  rho (bound_from b x) (t - at_time x) <= earliest_meeting.radius_at f t + 3 * u * B (inputs.radius f).
Proof.
  intros (T & _ & _ & _ & H0 & H1 & H2) Ht. unfold earliest_meeting.radius_at, meeting_coefficients.moved, bound_from, bound_of, rho.
  cbn [size growth_speed growth]. rewrite T. set (s := t - at_time x). assert (0 <= s) as P by (unfold s; lra).
  assert (e1 b * s <= B (inputs.growth_speed f) * s) by (apply Rmult_le_compat_r; assumption).
  assert (A b * (s * s) <= B (inputs.acceleration_limit f) * (s * s)) by (apply Rmult_le_compat_r; nra). lra.
Qed.

(* Until the answer of earliest_meeting, or the end of the span, two bounds are farther apart than the distance that was
   asked about. *)
Lemma bounds_are_apart_before_the_answer (a b : body) (x y : report) (f h : inputs.bound)
  (from until distance : floats.double) (t : R) :
  describes f a x -> describes h b y -> meeting_facts.sound f from -> meeting_facts.sound h from ->
  finite from -> finite until \/ until = floats.infinity -> at_time x <= B from -> at_time y <= B from ->
  let answer := kernels.earliest_meeting f h from until distance in
  B from <= t -> answer = floats.infinity /\ (finite until -> t <= B until) \/ finite answer /\ t < B answer ->
  rho (bound_from a x) (t - at_time x) + rho (bound_from b y) (t - at_time y) + B distance <
    norm (c (bound_from a x) (t - at_time x) - c (bound_from b y) (t - at_time y)).
Proof.
  intros Df Dh Sf Sh Ff Fu Hx Hy answer Ht Hr.
  assert (earliest_meeting.apart f h distance t) as [_ L].
  { destruct (earliest_meeting.earliest_meeting_is_early f h from until distance Sf Sh Ff Fu) as [[E H]|(F & _ & H)];
      fold answer in E, H || fold answer in F, H.
    - destruct Hr as [[_ Hu]|[F _]]; [apply H; assumption|]. rewrite E in F. discriminate.
    - destruct Hr as [[E _]|[_ Lt]]; [rewrite E in F; discriminate|]. apply H. lra. }
  rewrite <- (distance_of_bounds f h a b x y t Df Dh).
  generalize (radius_of_bound f a x t Df ltac:(lra)) (radius_of_bound h b y t Dh ltac:(lra)). lra.
Qed.

(* So is the gap of two bodies, whatever they do: all rounding included. *)
Theorem answer_is_before_the_contact (a b : body) (ma mb : motion) (x y : report) (f h : inputs.bound)
  (from until distance : floats.double) (t : R) :
  describes f a x -> describes h b y -> meeting_facts.sound f from -> meeting_facts.sound h from ->
  finite from -> finite until \/ until = floats.infinity ->
  at_time x <= B from -> at_time y <= B from -> keeps_since a ma x t -> keeps_since b mb y t ->
  let answer := kernels.earliest_meeting f h from until distance in
  B from <= t -> answer = floats.infinity /\ (finite until -> t <= B until) \/ finite answer /\ t < B answer ->
  B distance < gap a b ma mb t.
Proof.
  intros Df Dh Sf Sh Ff Fu Hx Hy Ka Kb answer Ht Hr.
  apply (bounds_apart_bodies_apart a b ma mb x y (B distance) t Ka Kb); try lra.
  exact (bounds_are_apart_before_the_answer a b x y f h from until distance t Df Dh Sf Sh Ff Fu Hx Hy Ht Hr).
Qed.

(* Two balls whose radii change, each no faster than at the rate that is in its bound, are apart until then as well. *)
Theorem answer_is_before_changing_balls_touch (a b : body) (ma mb : motion) (ra rb : R -> R) (ka kb : R) (x y : report)
  (f h : inputs.bound) (from until distance : floats.double) (t : R) :
  describes f (changing a (ra (at_time x)) ka) x -> describes h (changing b (rb (at_time y)) kb) y ->
  meeting_facts.sound f from -> meeting_facts.sound h from -> finite from -> finite until \/ until = floats.infinity ->
  at_time x <= B from -> at_time y <= B from -> keeps_since a ma x t -> keeps_since b mb y t ->
  grows_by_at_most ka ra (at_time x) t -> grows_by_at_most kb rb (at_time y) t ->
  let answer := kernels.earliest_meeting f h from until distance in
  B from <= t -> answer = floats.infinity /\ (finite until -> t <= B until) \/ finite answer /\ t < B answer ->
  B distance < norm (place ma t - place mb t) - ra t - rb t.
Proof.
  intros Df Dh Sf Sh Ff Fu Hx Hy Ka Kb Ga Gb answer Ht Hr.
  generalize (bounds_are_apart_before_the_answer _ _ x y f h from until distance t Df Dh Sf Sh Ff Fu Hx Hy Ht Hr)
    (changing_ball_near_its_bound a ma ra ka x t Ka Ga ltac:(lra)) (changing_ball_near_its_bound b mb rb kb y t Kb Gb ltac:(lra)).
  cbv zeta. set (ca := c _ (t - at_time x)). set (cb := c _ (t - at_time y)).
  generalize (norm_by_way_of (place ma t) ca cb) (norm_by_way_of (place mb t) (place ma t) cb).
  rewrite (norm_symmetric ca (place ma t)). lra.
Qed.

(* Until the answer of earliest_meeting of a bound and a half-space, the gap of the body and the half-space is above the
   distance that was asked about. No point p of the half-space has n.p above the offset. *)
Lemma coordinates_at_most (n : vector) : norm n <= 1 -> Rabs (x_of n) <= 1 /\ Rabs (y_of n) <= 1 /\ Rabs (z_of n) <= 1.
Proof.
  intros H. generalize (norm_positive n) (norm_square n). unfold dot. intros P E.
  assert (x_of n * x_of n + y_of n * y_of n + z_of n * z_of n <= 1) by nra.
  repeat split; apply Rabs_le; split; nra.
Qed.
Theorem answer_is_before_the_wall (b : body) (m : motion) (x : report) (f : inputs.bound)
  (nx ny nz offset from until distance : floats.double) (t : R) :
  let n := Vector (B nx) (B ny) (B nz) in
  describes f b x -> meeting_facts.sound f from -> norm n <= 1 -> finite from -> finite until \/ until = floats.infinity ->
  at_time x <= B from -> keeps_since b m x t -> wall_meeting.wall_gap f nx ny nz offset from distance <> floats.infinity ->
  let answer := kernels.wall_meeting f nx ny nz offset from until distance in
  B from <= t -> answer = floats.infinity /\ (finite until -> t <= B until) \/ finite answer /\ t < B answer ->
  B distance < dot n (place m t) - B offset - r b.
Proof.
  intros n Df Sf Hn Ff Fu Hx Kb NI answer Ht Hr.
  assert (wall_meeting.beyond_wall f nx ny nz offset distance t) as [[(_ & _ & _ & _ & Fr & _) _] L].
  { replace t with (B from + (t - B from)) by ring.
    destruct (wall_meeting.wall_meeting_is_early f nx ny nz offset from until distance Sf (coordinates_at_most n Hn) Ff Fu NI)
      as [[E H]|(F & _ & H)]; fold answer in E, H || fold answer in F, H.
    - destruct Hr as [[_ Hu]|[F _]]; [apply H; assumption|]. rewrite E in F. discriminate.
    - destruct Hr as [[E _]|[_ Lt]]; [rewrite E in F; discriminate|]. apply H. lra. }
  generalize (near_its_bound b m x t Kb ltac:(lra)) (radius_of_bound f b x t Df ltac:(lra)).
  assert (0 <= B (inputs.radius f)) as Pr by (apply meeting_parts.not_less_0; [exact Fr|apply Sf]).
  generalize (Rabs_pos (B offset)) (Rabs_pos (B distance)) meeting_errors.tiny_pos.
  unfold wall_meeting.to_spare in L. set (y := c (bound_from b x) (t - at_time x)).
  assert (dot n y = B nx * meeting_coefficients.moved (B (inputs.position_x f)) (B (inputs.velocity_x f)) (B (inputs.plan_x f)) (t - B (inputs.time f)) +
    B ny * meeting_coefficients.moved (B (inputs.position_y f)) (B (inputs.velocity_y f)) (B (inputs.plan_y f)) (t - B (inputs.time f)) +
    B nz * meeting_coefficients.moved (B (inputs.position_z f)) (B (inputs.velocity_z f)) (B (inputs.plan_z f)) (t - B (inputs.time f))) as E.
  { destruct Df as (T & P & V & G & _). unfold y, n, c, bound_from, bound_of. cbn [start speed plan].
    rewrite <- P, <- V, <- G, <- T. unfold meeting_coefficients.moved. coordinates. field. }
  generalize (dot_at_most_norm n (y - place m t) Hn). rewrite dot_minus, E, (norm_symmetric y). rewrite u_value in *. lra.
Qed.

(* The same of two points along a direction, each the centre of a ball, as the points of two hulls are (Lemma T): until the
   answer the one ball is farther along it than the other. So all hulls of such points are apart
   (hulls_are_apart_along_a_direction). *)
Theorem answer_is_before_two_points_meet_along (a b : body) (ma mb : motion) (x y : report) (f h : inputs.bound)
  (nx ny nz from until distance : floats.double) (t : R) :
  let n := Vector (B nx) (B ny) (B nz) in
  describes f a x -> describes h b y -> meeting_facts.sound f from -> meeting_facts.sound h from -> norm n <= 1 ->
  finite from -> finite until \/ until = floats.infinity -> at_time x <= B from -> at_time y <= B from ->
  keeps_since a ma x t -> keeps_since b mb y t ->
  let motion := kernels.beside f h from in let farther := floats.add distance (kernels.slack_beside f h from) in
  wall_meeting.wall_gap motion nx ny nz (floats.literal 0 0) from farther <> floats.infinity ->
  let answer := kernels.wall_meeting motion nx ny nz (floats.literal 0 0) from until farther in
  B from <= t -> answer = floats.infinity /\ (finite until -> t <= B until) \/ finite answer /\ t < B answer ->
  r a + r b + B distance < dot n (place ma t) - dot n (place mb t).
Proof.
  intros n Df Dh Sf Sh Hn Ff Fu Hx Hy Ka Kb motion farther NI answer Ht Hr.
  assert (pair_meeting.apart_along f h nx ny nz distance t) as [_ L].
  { replace t with (B from + (t - B from)) by ring.
    destruct (pair_meeting.pair_meeting_is_early f h from Sf Sh nx ny nz distance (coordinates_at_most n Hn) until Ff Fu NI)
      as [[E H]|(F & _ & H)]; fold motion farther answer in E, H || fold motion farther answer in F, H.
    - destruct Hr as [[_ Hu]|[F _]]; [apply H; assumption|]. rewrite E in F. discriminate.
    - destruct Hr as [[E _]|[_ Lt]]; [rewrite E in F; discriminate|]. apply H. lra. }
  generalize (near_its_bound a ma x t Ka ltac:(lra)) (near_its_bound b mb y t Kb ltac:(lra))
    (radius_of_bound f a x t Df ltac:(lra)) (radius_of_bound h b y t Dh ltac:(lra)).
  set (ca := c (bound_from a x) (t - at_time x)). set (cb := c (bound_from b y) (t - at_time y)).
  assert (dot n ca - dot n cb = pair_meeting.centres_along f h nx ny nz t) as E.
  { destruct Df as (T & P & V & G & _), Dh as (T' & P' & V' & G' & _). unfold ca, cb, n, c, bound_from, bound_of.
    cbn [start speed plan]. rewrite <- P, <- V, <- G, <- T, <- P', <- V', <- G', <- T'.
    unfold pair_meeting.centres_along, meeting_coefficients.moved. coordinates. field. }
  generalize (dot_at_most_norm n (ca - place ma t) Hn) (dot_at_most_norm n (place mb t - cb) Hn).
  rewrite !dot_minus, (norm_symmetric ca). lra.
Qed.

Lemma no_rate (k : floats.double) : floats.equal k (floats.literal 0 0) = true -> B k = 0.
Proof.
  intros E. destruct (is_finite k) eqn:F; [|destruct k; try discriminate; reflexivity].
  unfold floats.equal in E. rewrite Beqb_correct in E by (exact F || exact (proj1 literal_0)).
  revert E. rewrite (proj2 literal_0). case Req_bool_spec; [auto|discriminate].
Qed.

(* bound_of computes this bound from a report and the promise, also of a ball whose radius changes at the rate k. *)
Theorem bound_describes_the_body (r' limit gx gy gz e0' e1' k x y z vx vy vz t : floats.double) :
  let f := kernels.bound_of r' limit gx gy gz e0' e1' k x y z vx vy vz t in
  0 <= B r' -> 0 <= B e0' -> finite (inputs.radius f) -> finite (inputs.growth_speed f) ->
  describes f
    (changing {| r := 0; A := B limit; g := Vector (B gx) (B gy) (B gz); e0 := B e0'; e1 := B e1' |} (B r') (Rabs (B k)))
    {| at_time := B t; at_place := Vector (B x) (B y) (B z); with_velocity := Vector (B vx) (B vy) (B vz) |}.
Proof.
  unfold describes, kernels.bound_of. destruct (floats.equal k (floats.literal 0 0)) eqn:E; cbv zeta;
    cbn [inputs.time inputs.position_x inputs.position_y inputs.position_z inputs.velocity_x inputs.velocity_y inputs.velocity_z
      inputs.plan_x inputs.plan_y inputs.plan_z inputs.radius inputs.growth_speed inputs.acceleration_limit changing
      r A g e0 e1 at_time at_place with_velocity]; intros P0 P1 F FG;
    assert (0 <= B r' + B e0') as P by lra; generalize (rounded_radius r' e0' P F); intros L.
  - rewrite (no_rate k E), Rabs_R0. repeat split; lra.
  - destruct (sum_down.sum_up_is_above _ _ FG) as (_ & _ & G). rewrite floats.magnitude_value in G. repeat split; lra.
Qed.
