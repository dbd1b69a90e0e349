(* The hypotheses of the core's machine hold for balls that keep their promises between discontinuities: with safe regions
   as Core::stays and RegionCells compute them, and certificates from earliest_meeting in double precision or from the
   quick rejection. *)
From Coq Require Import Reals Lra List.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require floats inputs kernels earliest_meeting meeting_facts.
From Kinesphere Require Import core_machine.
From Kinesphere Require Import geometry_vectors geometry_motion geometry_bounds geometry_certificates geometry_rejection.
From Kinesphere Require Import geometry_knowledge geometry_regions contact_of_bodies.
Open Scope R_scope.
Notation B := (B2R (prec := 53) (emax := 1024)).

Section Balls.
(* Each body between two of its discontinuities has a promise and a true motion. *)
Variable limits : core_machine.motion -> body.
Variable moves : core_machine.motion -> motion.
Hypothesis no_radius_below_zero : forall x, 0 <= r (limits x).
Hypothesis no_acceleration_below_zero : forall x, 0 <= A (limits x).
Hypothesis no_error_below_zero : forall x, 0 <= e1 (limits x).
(* The filters: pairs that have nothing to do with each other. *)
Variable filtered : core_machine.motion -> core_machine.motion -> Prop.
(* The separation distance, at which a contact ends, and the walls: unit normals that point inwards, and offsets. *)
Variable separation : R.
Variable walls : list (vector * R).
Hypothesis normals_are_units : forall n offset, In (n, offset) walls -> norm n = 1.

Definition gap_of (x y : core_machine.motion) (t : R) : R := gap (limits x) (limits y) (moves x) (moves y) t.
Definition gap_to (wall : vector * R) (x : core_machine.motion) (t : R) : R :=
  dot (fst wall) (place (moves x) t) - snd wall - r (limits x).

(* A bound as it is at a time, and its centre and radius then. *)
Definition bound_at (p : body * report) (now : R) : bound := moved_on (bound_from (fst p) (snd p)) (now - at_time (snd p)).

(* A safe region: a ball for the centre of the body, and a reach that covers the body. *)
Record safe_region := { middle : vector; radius : R; reach : R }.

Definition stays_until (c : safe_region) (p : body * report) (now : R) (u : until) : Prop :=
  radius c + r (fst p) <= reach c /\
  match u with
  | Some v =>
    let b := bound_at p now in let room := radius c - (size b - r (fst p)) in let d := v - now in
    norm (start b - middle c) < room /\
    norm ((start b - middle c) + d * speed b) < room - (growth_speed b + / 2 * (growth b + norm_one (plan b)) * d) * d
  | None =>
    A (fst p) = 0 /\ e1 (fst p) = 0 /\ g (fst p) = zero /\ with_velocity (snd p) = zero /\
    norm (at_place (snd p) - middle c) + e0 (fst p) <= radius c
  end.

(* That a contact with a wall neither begins nor ends. *)
Definition clear_until (touches : bool) (p : body * report) (now : R) (u : until) : Prop :=
  forall t, now <= t -> before t u -> at_time (snd p) <= t ->
    let b := bound_from (fst p) (snd p) in let s := t - at_time (snd p) in
    if touches
    then exists n offset, In (n, offset) walls /\
           0 < offset - dot n (c b s) + (r (fst p) + e0 (fst p)) - growth_after b s + separation
    else forall n offset, In (n, offset) walls -> 0 < dot n (c b s) - rho b s - offset - 0.

(* Certificates that no contact begins: the answer of earliest_meeting, or the quick rejection for a span; and that none
   ends. *)
Definition meets_later (p q : body * report) (now : R) (u : until) : Prop :=
  exists (f h : inputs.bound) (from end_ distance : floats.double),
    describes f (fst p) (snd p) /\ describes h (fst q) (snd q) /\ meeting_facts.sound f from /\ meeting_facts.sound h from /\
    finite from /\ (finite end_ \/ end_ = floats.infinity) /\ B from = now /\ 0 <= B distance /\
    let answer := kernels.earliest_meeting f h from end_ distance in
    forall t, now <= t -> before t u ->
      answer = floats.infinity /\ (finite end_ -> t <= B end_) \/ finite answer /\ t < B answer.
Definition rejected (p q : body * report) (now : R) (u : until) : Prop :=
  exists v, u = Some v /\
    let a := bound_at p now in let b := bound_at q now in let T := v - now in
    let X := (start a - start b)%vector in let V := (speed a - speed b)%vector in
    let r0 := size a + size b in
    let rT := r0 + (growth_speed a + growth_speed b + / 2 * (growth a + growth b + norm_one (plan a - plan b)) * T) * T in
    straight_line_stays_out X V T rT \/
    (0 <= r0 /\ r0 * r0 < dot X X /\ 0 < dot X X + T * dot X V /\
     rT * rT * dot X X < (dot X X + T * dot X V) * (dot X X + T * dot X V)).
Definition parts_later (p q : body * report) (now : R) (u : until) : Prop :=
  forall t, now <= t -> before t u -> at_time (snd p) <= t -> at_time (snd q) <= t ->
    let a := bound_from (fst p) (snd p) in let b := bound_from (fst q) (snd q) in
    norm (c a (t - at_time (snd p)) - c b (t - at_time (snd q))) +
      growth_after a (t - at_time (snd p)) + growth_after b (t - at_time (snd q)) <
      (r (fst p) + e0 (fst p)) + (r (fst q) + e0 (fst q)) + separation.

(* The contact graph says whether two bodies touch. It is wrong if it calls two bodies apart that have a gap of 0 or
   less, or in contact when their gap exceeds the separation distance. The same of a body and the walls: it is wrong if
   it says that the body touches none, and the gap of one is 0 or less, or that it touches some when all gaps exceed the
   distance. *)
Instance Balls : World := {|
  core_machine.bound := body * report;
  region := safe_region;
  relation := bool;
  apart := false;
  only_ends r q := q = true -> r = true;
  lies_in x t c := norm (place (moves x) t - middle c) <= radius c /\ radius c + r (limits x) <= reach c;
  wrong r x y t := ~ filtered x y /\
    if r then separation + 2 * e0 (limits x) + 2 * e0 (limits y) < gap_of x y t else gap_of x y t <= 0;
  wrong_at_walls r x t :=
    if r then forall w, In w walls -> separation + 2 * e0 (limits x) < gap_to w x t
    else exists w, In w walls /\ gap_to w x t <= 0;
  keeps_to x p s := fst p = limits x /\ at_time (snd p) <= s /\ forall t, keeps_since (limits x) (moves x) (snd p) t;
  strangers := filtered;
  stays := stays_until;
  clears_walls := clear_until;
  out_of_reach c d := reach c + reach d < norm (middle c - middle d);
  certifies r p q now u := if r then parts_later p q now u else meets_later p q now u \/ rejected p q now u
|}.

Lemma bounds_apart_from_now (p q : body * report) (x y : core_machine.motion) (now t : R) :
  fst p = limits x -> fst q = limits y -> at_time (snd p) <= now -> at_time (snd q) <= now -> now <= t ->
  keeps_since (limits x) (moves x) (snd p) t -> keeps_since (limits y) (moves y) (snd q) t ->
  Rs (bound_at p now) (bound_at q now) (t - now) < norm (C (bound_at p now) (bound_at q now) (t - now)) ->
  0 < gap_of x y t.
Proof.
  intros Ex Ey Lp Lq Ln Kx Ky H. unfold gap_of.
  apply (bounds_apart_bodies_apart (limits x) (limits y) (moves x) (moves y) (snd p) (snd q) 0 t Kx Ky); try lra.
  unfold Rs, C, bound_at in H. rewrite !c_moved_on, !rho_moved_on, Ex, Ey in H.
  replace (now - at_time (snd p) + (t - now)) with (t - at_time (snd p)) in H by ring.
  replace (now - at_time (snd q) + (t - now)) with (t - at_time (snd q)) in H by ring. lra.
Qed.

Lemma growth_is_not_below_zero (p : body * report) (x : core_machine.motion) (now : R) :
  fst p = limits x -> at_time (snd p) <= now ->
  0 <= growth_speed (bound_at p now) /\ 0 <= growth (bound_at p now).
Proof.
  intros E L. unfold bound_at, moved_on, bound_from, bound_of. cbn [growth_speed growth]. rewrite E.
  generalize (no_acceleration_below_zero x) (no_error_below_zero x). intros PA P1. split; [|exact PA].
  apply Rplus_le_le_0_compat; [exact P1|]. apply Rmult_le_pos; lra.
Qed.

(* All hypotheses of the machine. *)
Theorem the_lemmas_of_the_core_hold_of_balls : Lemmas Balls.
Proof.
  split.
  - simpl. auto.
  - simpl. auto.
  - simpl. intros [|] H; [discriminate (H eq_refl)|reflexivity].
  - simpl. intros x p s t (E & Le & K) Lt. split; [exact E|]. split; [lra|exact K].
  - intros k p now u x t [Re H] (E & Le & K) Ln Bt. simpl in *. rewrite E in Re. split; [|exact Re].
    destruct u as [v|].
    + simpl in Bt. destruct H as [H0 Hd]. rewrite E in H0, Hd. apply Rlt_le.
      apply (body_stays_in_its_safe_region (limits x) (moves x) (snd p) now t (v - now)); auto; try lra;
        unfold bound_at in *; rewrite E in *; assumption.
    + destruct H as (ZA & Z1 & Zg & Zv & H). rewrite E in *.
      apply (body_at_rest_stays_in_its_safe_region (limits x) (moves x) (snd p)); auto; lra.
  - intros [|] p now u x t Cl (E & Le & K) Ln Bt; simpl in *.
    + intros Wr. destruct (Cl t Ln Bt ltac:(lra)) as (n & offset & I & H).
      generalize (Wr (n, offset) I). unfold gap_to. cbn [fst snd].
      destruct (K t) as [Kt Tr]. rewrite E in H.
      generalize (wall_has_not_been_left (limits x) (moves x) (at_time (snd p)) t (at_time (snd p)) (t - at_time (snd p))
        (at_place (snd p)) (with_velocity (snd p)) n offset separation (normals_are_units n offset I) Kt ltac:(lra)
        ltac:(lra) ltac:(lra) Tr H).
      replace (at_time (snd p) + (t - at_time (snd p))) with t by ring. lra.
    + intros ((n & offset) & I & Wr). unfold gap_to in Wr. cbn [fst snd] in Wr.
      generalize (Cl t Ln Bt ltac:(lra) n offset I). rewrite E. intros H. destruct (K t) as [Kt Tr].
      generalize (wall_is_not_met (limits x) (moves x) (at_time (snd p)) t (at_time (snd p)) (t - at_time (snd p))
        (at_place (snd p)) (with_velocity (snd p)) n offset 0 (normals_are_units n offset I) Kt ltac:(lra) ltac:(lra)
        ltac:(lra) Tr H).
      intros [G _]. replace (at_time (snd p) + (t - at_time (snd p))) with t in G by ring. lra.
  - simpl. intros k l x y t O [Ix Rx] [Iy Ry] [_ Wr].
    generalize (bodies_in_regions_out_of_reach_are_apart _ _ _ _ (r (limits x)) (r (limits y)) _ _ (reach k) (reach l) 0 Ix Iy
      ltac:(lra) ltac:(lra) O). unfold gap_of, gap in Wr. lra.
  - simpl. intros x y t F [N _]. exact (N F).
  - intros [|] [a p] [b q] now u x y t Ce (Ea & La & Ka) (Eb & Lb & Kb) Ln Bt; simpl in *; subst a b; intros [_ Wr].
    + specialize (Ce t Ln Bt ltac:(simpl; lra) ltac:(simpl; lra)). simpl in Ce.
      generalize (near_its_bound _ _ p t (Ka t) ltac:(lra)) (near_its_bound _ _ q t (Kb t) ltac:(lra)).
      unfold gap_of, gap in Wr. unfold bound_from in *. rewrite !rho_of.
      set (ca := c _ (t - at_time p)) in *. set (cb := c _ (t - at_time q)) in *.
      generalize (norm_by_way_of ca (place (moves x) t) (place (moves y) t))
        (norm_by_way_of cb ca (place (moves y) t)).
      rewrite (norm_symmetric cb (place (moves y) t)). lra.
    + destruct Ce as [Ce|(v & -> & Ce)].
      * destruct Ce as (f & h & from & end_ & distance & Df & Dh & Sf & Sh & Ff & Fu & <- & Pd & An). simpl in *.
        generalize (answer_is_before_the_contact (limits x) (limits y) (moves x) (moves y) p q f h from end_ distance t
          Df Dh Sf Sh Ff Fu La Lb (Ka t) (Kb t) Ln (An t Ln Bt)).
        unfold gap_of in Wr. lra.
      * simpl in Bt. set (P := (limits x, p)) in *. set (Q := (limits y, q)) in *.
        destruct (growth_is_not_below_zero P x now eq_refl La) as [G1 G2].
        destruct (growth_is_not_below_zero Q y now eq_refl Lb) as [G3 G4].
        assert (0 < gap_of x y t); [|lra].
        apply (bounds_apart_from_now P Q x y now t); auto.
        replace (Rs (bound_at P now) (bound_at Q now) (t - now)) with (Rs (bound_at P now) (bound_at Q now) (t - now) + 0) by ring.
        destruct Ce as [Ce|(P0 & H0 & H1 & H2)].
        -- apply (quick_rejection_leaves_out_only_what_cannot_meet _ _ (v - now) 0); try lra. rewrite Rplus_0_r. exact Ce.
        -- apply (quick_rejection_along_the_line_of_centres _ _ (v - now) 0); rewrite ?Rplus_0_r; try lra; assumption.
Qed.

End Balls.
