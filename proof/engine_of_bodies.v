(* The hypotheses of the machine hold for balls that keep their promises between discontinuities, with certificates of
   contacts from earliest_meeting, and searches by the test of swept spheres, both in floating point. *)
From Coq Require Import Reals Lra Lia ZArith Bool Arith.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require floats inputs kernels rounding earliest_meeting meeting_facts swept_spheres left_out.
From Kinesphere Require Import engine_machine engine_misses_nothing.
From Kinesphere Require Import geometry_vectors geometry_motion geometry_bounds geometry_certificates geometry_search.
From Kinesphere Require Import geometry_knowledge contact_of_bodies.
Open Scope R_scope.
Notation B := (B2R (prec := 53) (emax := 1024)).

Section Bodies.
(* Each body between two of its discontinuities has a promise and a true motion. *)
Variable limits : engine_machine.motion -> body.
Variable moves : engine_machine.motion -> motion.
Hypothesis no_radius_below_zero : forall x, 0 <= r (limits x).
Hypothesis no_acceleration_below_zero : forall x, 0 <= A (limits x).
Hypothesis no_error_below_zero : forall x, 0 <= e1 (limits x).
(* The margin of swept spheres, and the separation distance, at which a contact ends. *)
Variables margin separation : R.
Hypothesis no_margin_below_zero : 0 <= margin.

Definition gap_of (x y : engine_machine.motion) (t : R) : R := gap (limits x) (limits y) (moves x) (moves y) t.

(* A ball that goes straight on from a place, at a time, with a velocity; or, for a window without an end, all places.
   *)
Record ball := { centre : vector; heading : vector; size_of : R; made : R }.
Definition centre_at (c : ball) (t : R) : vector := (centre c + (t - made c) * heading c)%vector.
Definition holds_place (c : option ball) (t : R) (l : vector) : Prop :=
  match c with Some c => in_ball l (centre_at c t) (size_of c) | None => True end.
Definition swept_sphere_for (p : body * report) (now : R) (end_ : until) : option ball :=
  match end_ with
  | Some e =>
    let m := Rmax now (at_time (snd p)) in
    let b := moved_on (bound_from (fst p) (snd p)) (m - at_time (snd p)) in
    Some {| centre := start b; heading := speed b; size_of := swept_sphere_radius b margin (e - m); made := m |}
  | None => None
  end.

(* The test of a search, in single precision, in some frame, with units of its own for times and lengths. *)
Definition test_leaves_out (c d : ball) (now : R) (u v : until) : Prop :=
  exists (zero_time time_unit length_unit : R) (other one : inputs.swept_sphere) (from to : floats.single)
    (p q : swept_spheres.ball_in_motion) (S1 S2 F T : R),
    0 < length_unit /\
    (forall t, swept_spheres.distance_between p q ((t - zero_time) / time_unit) * length_unit = norm (centre_at c t - centre_at d t)) /\
    swept_spheres.reach p * length_unit = size_of c /\ swept_spheres.reach q * length_unit = size_of d /\
    (forall t, now <= t -> before t u -> before t v -> F <= (t - zero_time) / time_unit <= T) /\
    left_out.contains other p S1 T /\ left_out.contains one q S2 T /\
    swept_spheres.stored from F /\ swept_spheres.stored to T /\ B2R from <= B2R to /\ 0 <= F /\ T <= 2 /\
    kernels.left_out other one from to = true.

(* A certificate that no contact begins, and one that none ends. *)
Definition no_begin (p q : body * report) (now : R) (u : until) : Prop :=
  exists (f h : inputs.bound) (from end_ distance : floats.double),
    describes f (fst p) (snd p) /\ describes h (fst q) (snd q) /\ meeting_facts.sound f from /\ meeting_facts.sound h from /\
    finite from /\ (finite end_ \/ end_ = floats.infinity) /\ B from = now /\ 0 <= B distance /\
    at_time (snd p) <= now /\ at_time (snd q) <= now /\
    let answer := kernels.earliest_meeting f h from end_ distance in
    forall t, now <= t -> before t u ->
      answer = floats.infinity /\ (finite end_ -> t <= B end_) \/ finite answer /\ t < B answer.
Definition no_end (p q : body * report) (now : R) (u : until) : Prop :=
  forall t, now <= t -> before t u -> at_time (snd p) <= t -> at_time (snd q) <= t ->
    let a := bound_from (fst p) (snd p) in let b := bound_from (fst q) (snd q) in
    norm (c a (t - at_time (snd p)) - c b (t - at_time (snd q))) +
      growth_after a (t - at_time (snd p)) + growth_after b (t - at_time (snd q)) <
      (r (fst p) + e0 (fst p)) + (r (fst q) + e0 (fst q)) + separation.

(* The contact graph says whether two bodies touch. It is wrong if it calls two bodies apart that have a gap of 0 or
   less, or in contact when their gap exceeds the separation distance. *)
Instance Bodies : World := {|
  engine_machine.place := vector;
  engine_machine.bound := body * report;
  swept_sphere := option ball;
  relation := bool;
  apart := false;
  only_ends r q := q = true -> r = true;
  static _ := false;
  fills x t l := in_ball l (place (moves x) t) (r (limits x) + margin);
  wrong r x y t := if r then separation + 2 * e0 (limits x) + 2 * e0 (limits y) < gap_of x y t else gap_of x y t <= 0;
  keeps_to x p s := fst p = limits x /\ at_time (snd p) <= s /\ forall t, keeps_since (limits x) (moves x) (snd p) t;
  holds := holds_place;
  swept_sphere_of := swept_sphere_for;
  left_out c d now u v := match c, d with Some c, Some d => test_leaves_out c d now u v | _, _ => False end;
  certifies r p q now u := if r then no_end p q now u else no_begin p q now u
|}.

Lemma common_place (X Y : vector) (k l : R) : 0 <= k -> 0 <= l -> norm (X - Y) <= k + l ->
  exists p, norm (p - X) <= k /\ norm (p - Y) <= l.
Proof.
  intros Pk Pl H. destruct (Rle_or_lt (k + l) 0) as [N|P].
  - exists X. replace (X - X)%vector with zero by by_coordinates. rewrite norm_zero. lra.
  - exists (X - (k / (k + l)) * (X - Y))%vector.
    replace (X - k / (k + l) * (X - Y) - X)%vector with ((- (k / (k + l))) * (X - Y))%vector by by_coordinates.
    replace (X - k / (k + l) * (X - Y) - Y)%vector with ((l / (k + l)) * (X - Y))%vector
      by (coordinates; apply (f_equal3 Vector); field; lra).
    rewrite !norm_times, Rabs_Ropp.
    assert (forall m, 0 <= m -> Rabs (m / (k + l)) * norm (X - Y) <= m) as W.
    { intros m Pm. assert (0 <= m / (k + l)) as Q by (apply Rmult_le_pos; [exact Pm|apply Rlt_le, Rinv_0_lt_compat, P]).
      rewrite Rabs_pos_eq by exact Q. apply Rle_trans with (m / (k + l) * (k + l)).
      - apply Rmult_le_compat_l; assumption.
      - right. field. lra. }
    split; apply W; assumption.
Qed.

(* All hypotheses of the machine. *)
Theorem the_lemmas_hold_of_bodies : Lemmas Bodies.
Proof.
  split.
  - simpl. auto.
  - simpl. auto.
  - simpl. intros [|] H; [discriminate (H eq_refl)|reflexivity].
  - simpl. intros x p s t (E & L & K) Le. split; [exact E|]. split; [lra|exact K].
  - simpl. unfold gap_of, gap, in_ball. intros x y t H.
    destruct (common_place (place (moves x) t) (place (moves y) t) (r (limits x)) (r (limits y)))
      as (l & Hx & Hy); auto; try lra. exists l. lra.
  - intros x [b q] s now [e|] t l (E & Lq & K) Ls Ln Lt I; [|exact Logic.I]. simpl in *. subst b.
    set (m := Rmax now (at_time q)). assert (now <= m /\ at_time q <= m <= t) as (M1 & M2 & M3).
    { unfold m. generalize (Rmax_l now (at_time q)) (Rmax_r now (at_time q)). intros.
      repeat split; auto. apply Rmax_lub; lra. }
    destruct (K t) as [Kt Tr]. unfold centre_at. simpl. fold m.
    apply (body_stays_in_its_swept_sphere (limits x) (moves x) (at_time q) t (at_time q) (m - at_time q) (e - m) (t - m) margin);
      auto; try lra.
    replace (at_time q + (m - at_time q) + (t - m)) with t by ring. exact I.
  - intros [c|] [d|] now u v t l H Ln Lu Lv Hc Hd; try contradiction.
    destruct H as (z & w & k & other & one & from & to & p & q & S1 & S2 & F & T & Pk & E & Ep & Eq & Sp & C1 & C2 & St1 & St2 & Le & P0 & T2 & Out).
    simpl in Hc, Hd. unfold in_ball in Hc, Hd.
    generalize (left_out.left_out_is_apart other one from to p q S1 S2 F T C1 C2 St1 St2 Le P0 T2 Out _ (Sp t Ln Lu Lv)). intros L.
    apply (Rmult_lt_compat_r k _ _ Pk) in L. rewrite E, Rmult_plus_distr_r, Ep, Eq in L.
    generalize (norm_by_way_of l (centre_at c t) (centre_at d t)). rewrite (norm_symmetric (centre_at c t) l). lra.
  - intros [|] [a p] [b q] now u x y s s' t Ce (Ea & La & Ka) (Eb & Lb & Kb) L1 L2 Ln Lu; simpl in *; subst a b; intros Wr.
    + specialize (Ce t Ln Lu ltac:(simpl; lra) ltac:(simpl; lra)). simpl in Ce.
      generalize (near_its_bound _ _ p t (Ka t) ltac:(lra)) (near_its_bound _ _ q t (Kb t) ltac:(lra)).
      unfold gap_of, gap in Wr. unfold bound_from in *. rewrite !rho_of.
      set (ca := c _ (t - at_time p)) in *. set (cb := c _ (t - at_time q)) in *.
      generalize (norm_by_way_of ca (place (moves x) t) (place (moves y) t))
        (norm_by_way_of cb ca (place (moves y) t)).
      rewrite (norm_symmetric cb (place (moves y) t)). lra.
    + destruct Ce as (f & h & from & end_ & distance & Df & Dh & Sf & Sh & Ff & Fu & <- & Pd & Ha & Hb & An). simpl in *.
      generalize (answer_is_before_the_contact (limits x) (limits y) (moves x) (moves y) p q f h from end_ distance t
        Df Dh Sf Sh Ff Fu Ha Hb (Ka t) (Kb t) Ln (An t Ln Lu)).
      unfold gap_of in Wr. lra.
Qed.

End Bodies.
