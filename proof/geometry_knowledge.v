(* A fact about two bodies speaks of their true motion, so it outlives every report. *)
From Coq Require Import Reals Lra List.
From Kinesphere Require Import geometry_vectors geometry_motion geometry_bounds geometry_certificates.
Open Scope R_scope.

Record report : Type := Report { at_time : R; at_place : vector; with_velocity : vector }.

(* A body may move so between two discontinuities, at t0 and t1, if it keeps its promise and all its reports from then
   are true. *)
Definition possible (b : body) (t0 t1 : R) (reports : list report) (m : motion) : Prop :=
  keeps_promise b m t0 t1 /\
  forall report, In report reports ->
    t0 <= at_time report <= t1 /\ true_report b m (at_time report) (at_place report) (with_velocity report).

(* A fact about two bodies is certain if it holds however they may move. *)
Definition certain (a b : body) (t0 t1 : R) (of_a of_b : list report) (fact : motion -> motion -> Prop) : Prop :=
  forall ma mb, possible a t0 t1 of_a ma -> possible b t0 t1 of_b mb -> fact ma mb.

(* A certain fact stays certain, whatever is reported later. *)
Theorem fact_outlives_every_report (a b : body) (t0 t1 : R) (of_a of_b later_of_a later_of_b : list report)
  (fact : motion -> motion -> Prop) :
  certain a b t0 t1 of_a of_b fact -> certain a b t0 t1 (later_of_a ++ of_a) (later_of_b ++ of_b) fact.
Proof.
  intros H ma mb [Ka Ra] [Kb Rb]. apply H; split; auto; intros x I; [apply Ra|apply Rb]; apply in_or_app; auto.
Qed.

(* The bound that comes of a report, t - its time later. *)
Definition bound_from (b : body) (x : report) : bound := bound_of b (at_place x) (with_velocity x).

(* A body lies in the bounds of all its reports at once. *)
Theorem body_obeys_all_its_reports (b : body) (t0 t1 : R) (reports : list report) (m : motion) (t : R) (point : vector) :
  possible b t0 t1 reports m -> in_ball point (place m t) (r b) -> forall x, In x reports -> at_time x <= t <= t1 ->
  in_ball point (c (bound_from b x) (t - at_time x)) (rho (bound_from b x) (t - at_time x)).
Proof.
  intros [K R] I x Hx Ht. destruct (R x Hx) as [H T].
  apply (body_lies_in_its_bound b m t0 t1 (at_time x)); auto; try lra.
  replace (at_time x + (t - at_time x)) with t by ring. exact I.
Qed.

(* A certificate: from a time on, until another or the next discontinuity of one of them, the bounds of two reports are
   farther apart than a distance. However old these reports are, and whatever has been or will be reported besides, the
   gap of the two bodies is above the distance until then. *)
Theorem certificate_outlives_every_report (a b : body) (t0 t1 from until : R) (x y : report) (of_a of_b : list report)
  (distance : R) :
  In x of_a -> In y of_b -> at_time x <= from -> at_time y <= from ->
  (forall t, from <= t < until ->
    rho (bound_from a x) (t - at_time x) + rho (bound_from b y) (t - at_time y) + distance <
      norm (c (bound_from a x) (t - at_time x) - c (bound_from b y) (t - at_time y))) ->
  certain a b t0 t1 of_a of_b (fun ma mb =>
    forall t, from <= t < until -> t <= t1 -> distance < norm (place ma t - place mb t) - r a - r b).
Proof.
  intros Ix Iy Hx Hy L ma mb [Ka Ra] [Kb Rb] t Ht Ht1.
  destruct (Ra x Ix) as [Hax Ta]. destruct (Rb y Iy) as [Hby Tb].
  apply (bodies_are_as_far_apart_as_their_bounds a b ma mb t0 t1 (at_time x) (at_time y) t (at_place x) (with_velocity x)
           (at_place y) (with_velocity y) distance Ka Kb);
    try exact Ta; try exact Tb; try lra.
  apply L. lra.
Qed.

(* A report that keeps the promise never raises a bound violation: `broken_promise` compares with the most that two true
   reports, s apart, can differ by. *)
Theorem true_reports_do_not_contradict (b : body) (m : motion) (t0 t1 t s : R) (p q p' q' : vector) :
  keeps_promise b m t0 t1 -> t0 <= t -> 0 <= s -> t + s <= t1 ->
  true_report b m t p q -> true_report b m (t + s) p' q' ->
  norm (p' - c (bound_of b p q) s) <= rho (bound_of b p q) s - r b + e0 b /\
  norm (q' - (q + s * g b)) <= A b * s + e1 b + e1 b.
Proof.
  intros K Ht Hs Ht1 T [P' Q']. split.
  - generalize (centre_is_near b m t0 t1 t p q s K Ht Hs Ht1 T)
      (norm_by_way_of (place m (t + s)) p' (c (bound_of b p q) s)). lra.
  - destruct K as (_ & _ & V). destruct T as [_ Q].
    assert (norm (velocity m (t + s) - (velocity m t + (t + s - t) * g b)) <= A b * (t + s - t)) as W by (apply V; lra).
    replace (t + s - t) with s in W by ring.
    replace (q' - (q + s * g b))%vector with ((q' - velocity m (t + s)) +
      ((velocity m (t + s) - (velocity m t + s * g b)) + (velocity m t - q)))%vector by by_coordinates.
    apply Rle_trans with (1 := norm_plus _ _).
    generalize (norm_plus (velocity m (t + s) - (velocity m t + s * g b)) (velocity m t - q)).
    rewrite (norm_symmetric (velocity m t) q). lra.
Qed.

(* A contact that is reported is real. It is reported where the gap, according to the reports, is at most the tolerance:
   then the true gap is at most the tolerance, and twice the position errors more. *)
Theorem reported_contact_is_real (a b : body) (ma mb : motion) (t tolerance : R) (pa qa pb qb : vector) :
  true_report a ma t pa qa -> true_report b mb t pb qb ->
  norm (pa - pb) - (r a + e0 a) - (r b + e0 b) <= tolerance ->
  norm (place ma t - place mb t) - r a - r b <= tolerance + 2 * e0 a + 2 * e0 b.
Proof.
  intros [Pa _] [Pb _] H. generalize (norm_by_way_of pa (place ma t) (place mb t)) (norm_by_way_of pb pa (place mb t)).
  rewrite (norm_symmetric (place ma t) pa). lra.
Qed.
