(* The time-varying bound of a body contains it (Lemma 1), and that of a later report lies in that of an earlier
   one (Lemma 2). *)
From Coq Require Import Reals Lra Psatz List.
From Kinesphere Require Import geometry_vectors geometry_motion.
Open Scope R_scope.

(* The promise of a body: its radius r, its acceleration limit A, its planned acceleration g, and the largest errors
   e0 and e1 of positions and velocities that it reports. *)
Record body : Type := Body {
  r : R; A : R; g : vector; e0 : R; e1 : R }.

(* How a body moves: where its centre is at each time, and with which velocity. *)
Record motion : Type := Motion { place : R -> vector; velocity : R -> vector }.

(* From the time t0 to t1, between two discontinuities, the body goes on without a jump, and with its velocity; and
   its velocity never differs from what the plan makes of an earlier one by more than A allows. Where a discontinuity
   is, at t0 or t1, the path need have no derivative: its velocity there is the one from within. *)
Definition keeps_promise (b : body) (m : motion) (t0 t1 : R) : Prop :=
  continuous_during t0 t1 (place m) /\
  (forall t, t0 < t < t1 -> has_derivative (place m) t (velocity m t)) /\
  (forall s t, t0 <= s <= t -> t <= t1 ->
    norm (velocity m t - (velocity m s + (t - s) * g b)) <= A b * (t - s)).

(* The promise as users state it: the velocity has no jump, and there is an acceleration that differs from the plan
   by at most A. At finitely many times the acceleration may jump, and there it need not exist. *)
Theorem limited_acceleration_keeps_the_promise (b : body) (m : motion) (acceleration : R -> vector) (jumps : list R)
  (t0 t1 : R) :
  continuous_during t0 t1 (place m) -> continuous_during t0 t1 (velocity m) ->
  (forall t, t0 < t < t1 -> has_derivative (place m) t (velocity m t)) ->
  (forall t, t0 < t < t1 -> ~ In t jumps -> has_derivative (velocity m) t (acceleration t)) ->
  0 <= A b -> (forall t, t0 < t < t1 -> ~ In t jumps -> norm (acceleration t - g b) <= A b) ->
  keeps_promise b m t0 t1.
Proof.
  intros Cx Cv Dx Dv PA L. split; [exact Cx|]. split; [exact Dx|]. intros s t [Hs Ht] Ht1.
  set (w := fun c => (velocity m c - (velocity m s + (c - s) * g b + ((c - s) * (c - s) / 2) * zero))%vector).
  replace (velocity m t - (velocity m s + (t - s) * g b))%vector with (w t - w s)%vector
    by (unfold w; by_coordinates).
  replace (A b * (t - s)) with (A b * (t - s) - A b * (s - s)) by ring.
  apply (moves_no_farther w (fun c => if in_dec Req_EM_T c jumps then zero else (acceleration c - g b)%vector)
           (fun c => A b * (c - s)) (fun _ => A b) jumps); [exact Ht| | | |].
  - apply continuous_minus.
    + intros c e Hc He. destruct (Cv c e) as (d & Hd & G); [lra|lra|]. exists d. split; [exact Hd|].
      intros c' Hc'. apply G. lra.
    + apply continuous_where_derivable with (x' := fun c => (g b + (c - s) * zero)%vector).
      intros c _. apply has_derivative_plan.
  - intros c Hc N. destruct in_dec; [contradiction|].
    replace (acceleration c - g b)%vector with (acceleration c - (g b + (c - s) * zero))%vector by by_coordinates.
    apply has_derivative_minus; [apply Dv; [lra|exact N]|apply has_derivative_plan].
  - intros. apply derivative_of_line.
  - intros c Hc. destruct in_dec as [_|N]; [rewrite norm_zero; exact PA|]. apply L; [lra|exact N].
Qed.

(* A report of the place p and the velocity q at the time t is true if it errs by no more than has been promised. *)
Definition true_report (b : body) (m : motion) (t : R) (p q : vector) : Prop :=
  norm (p - place m t) <= e0 b /\ norm (q - velocity m t) <= e1 b.

(* The time-varying bound, s after its report: c(s) = x + v s + g s^2 / 2 and rho(s) = r + e0 + e1 s + A s^2 / 2. *)
Record bound : Type := Bound {
  start : vector; speed : vector; plan : vector; size : R; growth_speed : R; growth : R }.
Definition bound_of (b : body) (p q : vector) : bound := Bound p q (g b) (r b + e0 b) (e1 b) (A b).
Definition c (b : bound) (s : R) : vector := (start b + s * speed b + (s * s / 2) * plan b)%vector.
Definition rho (b : bound) (s : R) : R := size b + growth_speed b * s + growth b * (s * s / 2).

(* A place in a ball. *)
Definition in_ball (p centre : vector) (radius : R) : Prop := norm (p - centre) <= radius.

(* How far a body can have got from where its plan leads. *)
Lemma deviation_from_plan (b : body) (m : motion) (t0 t1 t s : R) :
  keeps_promise b m t0 t1 -> t0 <= t -> 0 <= s -> t + s <= t1 ->
  norm (place m (t + s) - (place m t + s * velocity m t + (s * s / 2) * g b)) <= A b * (s * s / 2).
Proof.
  intros (Cx & Dx & V) Ht Hs Ht1.
  set (w := fun d => (place m d - (place m t + (d - t) * velocity m t + ((d - t) * (d - t) / 2) * g b))%vector).
  replace (place m (t + s) - (place m t + s * velocity m t + (s * s / 2) * g b))%vector with (w (t + s)%R - w t)%vector
    by (unfold w; coordinates; apply (f_equal3 Vector); field).
  replace (A b * (s * s / 2)) with (A b * ((t + s - t) * (t + s - t) / 2) - A b * ((t - t) * (t - t) / 2)) by field.
  apply (moves_no_farther w (fun d => velocity m d - (velocity m t + (d - t) * g b))%vector
           (fun d => A b * ((d - t) * (d - t) / 2)) (fun d => A b * (d - t)) nil); [lra| | | |].
  - apply continuous_minus.
    + intros d e Hd He. destruct (Cx d e) as (k & Hk & G); [lra|lra|]. exists k. split; [exact Hk|].
      intros d' Hd'. apply G. lra.
    + apply continuous_where_derivable with (x' := fun d => (velocity m t + (d - t) * g b)%vector).
      intros d _. apply has_derivative_plan.
  - intros d Hd _. apply has_derivative_minus; [apply Dx; lra|apply has_derivative_plan].
  - intros d. apply derivative_of_square.
  - intros d Hd. apply V; lra.
Qed.

(* The centre of the body is that near to the centre of its bound. *)
Lemma centre_is_near (b : body) (m : motion) (t0 t1 t : R) (p q : vector) (s : R) :
  keeps_promise b m t0 t1 -> t0 <= t -> 0 <= s -> t + s <= t1 -> true_report b m t p q ->
  norm (place m (t + s) - c (bound_of b p q) s) <= rho (bound_of b p q) s - r b.
Proof.
  intros K Ht Hs Ht1 [P Q]. generalize (deviation_from_plan b m t0 t1 t s K Ht Hs Ht1). intros D.
  replace (place m (t + s) - c (bound_of b p q) s)%vector
    with ((place m (t + s) - (place m t + s * velocity m t + (s * s / 2) * g b)) +
          ((place m t - p) + s * (velocity m t - q)))%vector
    by (unfold c, bound_of; cbn [start speed plan]; by_coordinates).
  apply Rle_trans with (1 := norm_plus _ _).
  generalize (norm_plus (place m t - p) (s * (velocity m t - q))).
  rewrite norm_times, (Rabs_pos_eq s Hs), (norm_symmetric (place m t)), (norm_symmetric (velocity m t)). intros N.
  assert (s * norm (q - velocity m t) <= s * e1 b) by (apply Rmult_le_compat_l; assumption).
  unfold rho, bound_of. cbn [size growth_speed growth]. lra.
Qed.

(* Lemma 1. If a body keeps its promise from t0 to t1, and its report at the time t is true, all its points lie inside
   the sphere of radius rho(s) around c(s), for all s until t1. *)
Theorem body_lies_in_its_bound (b : body) (m : motion) (t0 t1 t : R) (p q : vector) (s : R) (point : vector) :
  keeps_promise b m t0 t1 -> t0 <= t -> 0 <= s -> t + s <= t1 -> true_report b m t p q ->
  in_ball point (place m (t + s)) (r b) -> in_ball point (c (bound_of b p q) s) (rho (bound_of b p q) s).
Proof.
  intros K Ht Hs Ht1 T I. generalize (centre_is_near b m t0 t1 t p q s K Ht Hs Ht1 T). unfold in_ball in *.
  generalize (norm_by_way_of (place m (t + s)) point (c (bound_of b p q) s)). lra.
Qed.

(* Lemma 2. Without errors, and if the body keeps its promise, the bound of a report at t + s lies inside that of the
   report at t, at all times d after the later one. *)
Theorem later_bound_lies_in_the_earlier (b : body) (m : motion) (t0 t1 t s d : R) (p q p' q' point : vector) :
  e0 b = 0 -> e1 b = 0 ->
  keeps_promise b m t0 t1 -> t0 <= t -> 0 <= s -> t + s <= t1 -> 0 <= d ->
  true_report b m t p q -> true_report b m (t + s) p' q' ->
  in_ball point (c (bound_of b p' q') d) (rho (bound_of b p' q') d) ->
  in_ball point (c (bound_of b p q) (s + d)) (rho (bound_of b p q) (s + d)).
Proof.
  intros E0 E1 K Ht Hs Ht1 Hd [P Q] [P' Q'] I. unfold in_ball in *.
  generalize (deviation_from_plan b m t0 t1 t s K Ht Hs Ht1). intros D.
  destruct K as (_ & _ & V). assert (norm (velocity m (t + s) - (velocity m t + (t + s - t) * g b)) <= A b * (t + s - t)) as W
    by (apply V; lra). clear V. replace (t + s - t) with s in W by ring.
  rewrite E0 in P, P'. rewrite E1 in Q, Q'.
  apply Rle_trans with (1 := norm_by_way_of (c (bound_of b p' q') d) _ _).
  set (x := place m t) in *. set (y := place m (t + s)) in *. set (v := velocity m t) in *.
  set (w := velocity m (t + s)) in *.
  assert (norm (c (bound_of b p' q') d - c (bound_of b p q) (s + d)) <= A b * (s * s / 2) + d * (A b * s)) as G.
  { replace (c (bound_of b p' q') d - c (bound_of b p q) (s + d))%vector
      with ((y - (x + s * v + (s * s / 2) * g b)) + (d * (w - (v + s * g b)) +
            (((p' - y) + d * (q' - w)) + ((x - p) + (s + d) * (v - q)))))%vector
      by (unfold c, bound_of; cbn [start speed plan]; coordinates; apply (f_equal3 Vector); field).
    apply Rle_trans with (1 := norm_plus _ _). apply Rplus_le_compat; [exact D|].
    apply Rle_trans with (1 := norm_plus _ _).
    generalize (norm_plus ((p' - y) + d * (q' - w)) ((x - p) + (s + d) * (v - q)))
      (norm_plus (p' - y) (d * (q' - w))) (norm_plus (x - p) ((s + d) * (v - q))).
    rewrite !norm_times, (Rabs_pos_eq d Hd), (Rabs_pos_eq (s + d)) by lra.
    rewrite (norm_symmetric x), (norm_symmetric v).
    assert (norm (q' - w) = 0) as -> by (generalize (norm_positive (q' - w)); lra).
    assert (norm (q - v) = 0) as -> by (generalize (norm_positive (q - v)); lra).
    assert (d * norm (w - (v + s * g b)) <= d * (A b * s)) by (apply Rmult_le_compat_l; assumption). lra. }
  revert I G. unfold rho, bound_of. cbn [size growth_speed growth]. rewrite E0, E1. intros. nra.
Qed.

(* No smaller sphere would do: in each direction n some body that keeps its promise, with a true report, has a point on
   the sphere's surface. *)
Theorem no_smaller_bound_would_do (b : body) (p q n : vector) (s : R) :
  0 <= r b -> 0 <= A b -> 0 <= e0 b -> 0 <= e1 b -> norm n = 1 -> 0 <= s ->
  exists m point, keeps_promise b m 0 s /\ true_report b m 0 p q /\ in_ball point (place m s) (r b) /\
    (point - c (bound_of b p q) s)%vector = (rho (bound_of b p q) s * n)%vector.
Proof.
  intros Hr HA H0 H1 Hn Hs.
  set (x := (p + e0 b * n)%vector). set (v := (q + e1 b * n)%vector). set (a := (g b + A b * n)%vector).
  exists (Motion (fun t => x + (t - 0) * v + ((t - 0) * (t - 0) / 2) * a)%vector (fun t => v + (t - 0) * a)%vector).
  exists ((x + (s - 0) * v + ((s - 0) * (s - 0) / 2) * a) + r b * n)%vector.
  assert (forall k, 0 <= k -> norm (k * n) <= k) as L by (intros k Hk; rewrite norm_times, Rabs_pos_eq, Hn by exact Hk; lra).
  split; [|split; [|split]].
  - split; [|split]; cbn [place velocity].
    + apply continuous_where_derivable with (x' := fun t => (v + (t - 0) * a)%vector). intros. apply has_derivative_plan.
    + intros. apply has_derivative_plan.
    + intros t t' Ht Ht'. replace (v + (t' - 0) * a - (v + (t - 0) * a + (t' - t) * g b))%vector with ((A b * (t' - t)) * n)%vector
        by (unfold a; by_coordinates).
      apply L. apply Rmult_le_pos; lra.
  - split; cbn [place velocity].
    + replace (p - (x + (0 - 0) * v + ((0 - 0) * (0 - 0) / 2) * a))%vector with (p - x)%vector
        by (coordinates; apply (f_equal3 Vector); field).
      rewrite norm_symmetric. replace (x - p)%vector with (e0 b * n)%vector by (unfold x; by_coordinates). apply L. exact H0.
    + replace (q - (v + (0 - 0) * a))%vector with (q - v)%vector by by_coordinates.
      rewrite norm_symmetric. replace (v - q)%vector with (e1 b * n)%vector by (unfold v; by_coordinates). apply L. exact H1.
  - unfold in_ball. cbn [place].
    replace (x + (s - 0) * v + (s - 0) * (s - 0) / 2 * a + r b * n - (x + (s - 0) * v + (s - 0) * (s - 0) / 2 * a))%vector
      with (r b * n)%vector by by_coordinates.
    apply L. exact Hr.
  - unfold x, v, a, c, rho, bound_of. cbn [start speed plan size growth_speed growth]. coordinates.
    apply (f_equal3 Vector); field.
Qed.
