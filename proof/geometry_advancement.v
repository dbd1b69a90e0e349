(* Step by step along linearised roots: what the geometry of Lemma 3, the root of a quadratic in double precision, and
   the sum of such steps give together. *)
From Coq Require Import Reals Lra Psatz List.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats rounding quadratic kernels first_crossing safe_steps.
From Kinesphere Require Import geometry_vectors geometry_motion geometry_bounds geometry_certificates.
Open Scope R_scope.

(* The double x is not above the real number e, or says nothing: it is no number, or minus infinity. *)
Definition lowered (x : double) (e : R) : Prop := x <> infinity /\ (finite x -> B x <= e).

(* The step at d is the root of a quadratic with coefficients not above those of Lemma 3, at that instant and for some
   direction. (Lemma 5, about rounding alone, shows it for the coefficients of the library.) *)
Definition linearised_step (a b : bound) (distance : R) (step : double -> double) : Prop :=
  forall d, finite d -> 0 <= B d -> exists n k l q, norm n <= 1 /\
    lowered k (constant (moved_on a (B d)) (moved_on b (B d)) n distance) /\
    lowered l (linear (moved_on a (B d)) (moved_on b (B d)) n) /\
    lowered q (square (moved_on a (B d)) (moved_on b (B d)) n) /\
    step d = first_crossing k l q.

Lemma linearised_step_is_safe (a b : bound) (distance : R) (step : double -> double) :
  linearised_step a b distance step -> forall d, finite d -> 0 <= B d ->
  safe_step (fun x => Rs a b x + distance < norm (C a b x)) d (step d).
Proof.
  intros S d Fd Pd. destruct (S d Fd Pd) as (n & k & l & q & Hn & [Nk Lk] & [Nl Ll] & [Nq Lq] & ->).
  assert (forall x, B d <= x -> finite k -> finite l -> finite q -> 0 < quadratic (B k) (B l) (B q) (x - B d) ->
            Rs a b x + distance < norm (C a b x)) as W.
  { intros x Hx Fk Fl Fq Q.
    generalize (linearised_is_below (moved_on a (B d)) (moved_on b (B d)) n distance (x - B d) Hn).
    unfold Rs, C. rewrite !c_moved_on, !rho_moved_on. replace (B d + (x - B d)) with x by ring.
    intros H. apply H. apply Rlt_le_trans with (1 := Q). apply quadratic_le; auto. lra. }
  destruct (first_crossing_is_early k l q) as [E|[(Fk & Fl & Fq & _ & [[E H]|(Fr & Pr & H)])|(_ & Hk & _)]].
  - right. rewrite E, (proj2 literal_0). split; [exact (proj1 literal_0)|]. split; [lra|]. intros x Hx. lra.
  - left. split; [exact E|]. intros x Hx. apply W; auto. apply H. lra.
  - right. split; [exact Fr|]. split; [lra|]. intros x Hx. apply W; auto; [lra|]. apply H. lra.
  - contradiction.
Qed.

(* Conservative advancement. Whatever directions are taken, and however many steps: until the time that is returned the
   two bounds are farther apart than the distance. *)
Theorem advancing_by_linearised_steps_is_early (a b : bound) (distance : R) (step : double -> double)
  (from until : double) :
  linearised_step a b distance step -> finite from -> finite until \/ until = infinity ->
  certified (fun d => Rs a b d + distance < norm (C a b d)) from until (advance_by_safe_steps step from until).
Proof.
  intros S F U. apply advance_by_safe_steps_is_early; [|exact F|exact U]. apply linearised_step_is_safe. exact S.
Qed.

(* The gap of the bodies stays above the distance until the returned time, as long as they keep their promises (until
   t1). *)
Theorem certified_time_is_before_the_contact (a b : body) (ma mb : motion) (t0 t1 ta tb : R) (pa qa pb qb : vector)
  (distance : R) (step : double -> double) (from until : double) :
  keeps_promise a ma t0 t1 -> keeps_promise b mb t0 t1 -> t0 <= ta <= B from -> t0 <= tb <= B from ->
  true_report a ma ta pa qa -> true_report b mb tb pb qb ->
  linearised_step (moved_on (bound_of a pa qa) (B from - ta)) (moved_on (bound_of b pb qb) (B from - tb)) distance step ->
  finite from -> finite until \/ until = infinity ->
  certified
    (fun d => B from + d <= t1 -> distance < norm (place ma (B from + d) - place mb (B from + d)) - r a - r b)
    from until (advance_by_safe_steps step from until).
Proof.
  intros Ka Kb Ha Hb Ta Tb S F U.
  generalize (advancing_by_linearised_steps_is_early _ _ distance step from until S F U).
  assert (forall d, 0 <= d ->
    Rs (moved_on (bound_of a pa qa) (B from - ta)) (moved_on (bound_of b pb qb) (B from - tb)) d + distance <
      norm (C (moved_on (bound_of a pa qa) (B from - ta)) (moved_on (bound_of b pb qb) (B from - tb)) d) ->
    B from + d <= t1 -> distance < norm (place ma (B from + d) - place mb (B from + d)) - r a - r b) as W.
  { intros d Hd. unfold Rs, C. rewrite !c_moved_on, !rho_moved_on. intros L Ht.
    apply (bodies_are_as_far_apart_as_their_bounds a b ma mb t0 t1 ta tb (B from + d) pa qa pb qb); auto; try lra.
    replace (B from + d - ta) with (B from - ta + d) by ring. replace (B from + d - tb) with (B from - tb + d) by ring.
    exact L. }
  intros [[E H]|(Fr & L & H)].
  - left. split; [exact E|]. intros t Ht Hu. apply W; [lra|]. apply H; assumption.
  - right. split; [exact Fr|]. split; [exact L|]. intros t Ht. apply W; [lra|]. apply H. lra.
Qed.

(* For a wall one quadratic is enough. *)
Definition time_of_crossing (from until k l q : double) : double :=
  let time := sum_down from (first_crossing k l q) in
  if less until time then infinity else if less from time then time else from.

Lemma crossing_is_reached (k l q : double) (k' l' q' : R) : lowered k k' -> lowered l l' -> lowered q q' ->
  reached (fun d => 0 < quadratic k' l' q' d) (first_crossing k l q).
Proof.
  intros [Nk Lk] [Nl Ll] [Nq Lq].
  assert (forall d, 0 <= d -> finite k -> finite l -> finite q -> 0 < quadratic (B k) (B l) (B q) d ->
            0 < quadratic k' l' q' d) as W.
  { intros d Hd Fk Fl Fq Q. apply Rlt_le_trans with (1 := Q). apply quadratic_le; auto. }
  destruct (first_crossing_is_early k l q) as [E|[(Fk & Fl & Fq & _ & [[E H]|(Fr & Pr & H)])|(_ & Hk & _)]].
  - left. rewrite E, (proj2 literal_0). split; [exact (proj1 literal_0)|]. split; [lra|]. intros x Hx. lra.
  - right; left. split; [exact E|]. intros x Hx. apply W; auto.
  - left. split; [exact Fr|]. split; [lra|]. intros x Hx. apply W; auto. lra.
  - contradiction.
Qed.

(* So until the time that is returned a quadratic stays above zero whose coefficients are not below those given. *)
Lemma time_of_crossing_is_early (from until k l q : double) (k' l' q' : R) :
  lowered k k' -> lowered l l' -> lowered q q' -> finite from -> finite until \/ until = infinity ->
  certified (fun d => 0 < quadratic k' l' q' d) from until (time_of_crossing from until k l q).
Proof.
  intros Lk Ll Lq F U. generalize (crossing_is_reached _ _ _ _ _ _ Lk Ll Lq). intros R.
  unfold time_of_crossing. cbv zeta. destruct (less until _) eqn:E; [eapply beyond|eapply ends]; eauto.
Qed.

(* A wall: no point p of it has n.p above the offset. If the coefficients are not above those of n.c(d) - rho(d) -
   offset - distance, the gap of body and wall is above the distance until the time that is returned. *)
Theorem certified_time_is_before_the_wall (b : body) (m : motion) (t0 t1 t : R) (p q n : vector) (offset distance : R)
  (from until k l s : double) :
  norm n = 1 -> keeps_promise b m t0 t1 -> t0 <= t <= B from -> true_report b m t p q ->
  let now := moved_on (bound_of b p q) (B from - t) in
  lowered k (dot n (start now) - size now - offset - distance) ->
  lowered l (dot n (speed now) - growth_speed now) -> lowered s (dot n (plan now) - growth now) ->
  finite from -> finite until \/ until = infinity ->
  certified (fun d => B from + d <= t1 -> distance < dot n (place m (B from + d)) - offset - r b)
    from until (time_of_crossing from until k l s).
Proof.
  intros Hn K Ht T now Lk Ll Ls F U.
  generalize (time_of_crossing_is_early from until _ _ _ _ _ _ Lk Ll Ls F U). intros W.
  assert (forall d, 0 <= d -> 0 < quadratic (dot n (start now) - size now - offset - distance)
            (dot n (speed now) - growth_speed now) (dot n (plan now) - growth now) d ->
            B from + d <= t1 -> distance < dot n (place m (B from + d)) - offset - r b) as G.
  { intros d Hd Q Hd1.
    destruct (wall_is_not_met b m t0 t1 t (B from - t + d) p q n offset distance Hn K) as [H _]; try tauto; try lra.
    - rewrite <- c_moved_on, <- rho_moved_on. fold now.
      replace (dot n (c now d) - rho now d - offset - distance) with (quadratic (dot n (start now) - size now - offset - distance)
        (dot n (speed now) - growth_speed now) (dot n (plan now) - growth now) d); [exact Q|].
      unfold quadratic, c, rho. rewrite !dot_plus, !dot_times. field.
    - replace (t + (B from - t + d)) with (B from + d) in H by ring. exact H. }
  destruct W as [[E H]|(Fr & L & H)].
  - left. split; [exact E|]. intros x Hx Hu. apply G; [lra|]. apply H; assumption.
  - right. split; [exact Fr|]. split; [exact L|]. intros x Hx. apply G; [lra|]. apply H. exact Hx.
Qed.
