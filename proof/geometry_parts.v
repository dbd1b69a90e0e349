(* Certificates of bodies that are made of balls and capsules: in a direction, by a witness, and over all pairs of parts.
   *)
From Coq Require Import Reals Lra Psatz List Bool.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats rounding first_crossing safe_steps.
From Kinesphere Require Import geometry_vectors geometry_motion geometry_bounds geometry_certificates geometry_shapes
  geometry_knowledge geometry_turning.
Open Scope R_scope.

(* The axis between two ends: all their means. A part is all that is within its radius of its axis: a capsule, or a ball
   if the ends are the same. *)
Definition segment (a b : vector) : shape := fun p => exists k, 0 <= k <= 1 /\ p = mean k a b.
Record part : Type := Part { end_a : vector; end_b : vector; thickness : R }.
Definition on_axis (p : part) : shape := segment (end_a p) (end_b p).
Definition in_part (p : part) : shape := fun point => exists x, on_axis p x /\ in_ball point x (thickness p).

(* The gap of two bodies, given by their parts, is the least distance of points of two axes less both radii: it is above
   a distance, or below it. *)
Definition gap_above (distance : R) (P Q : list part) : Prop :=
  forall p q x y, In p P -> In q Q -> on_axis p x -> on_axis q y -> distance < norm (x - y) - thickness p - thickness q.
Definition gap_below (distance : R) (P Q : list part) : Prop :=
  exists p q x y, In p P /\ In q Q /\ on_axis p x /\ on_axis q y /\ norm (x - y) - thickness p - thickness q < distance.

(* So all points of the two bodies are farther apart. *)
Theorem points_of_parts_are_as_far_apart_as_the_gap (P Q : list part) (distance : R) (p q : part) (x y : vector) :
  gap_above distance P Q -> In p P -> In q Q -> in_part p x -> in_part q y -> distance < norm (x - y).
Proof.
  intros G Ip Iq (k & Hk & Ik) (l & Hl & Il). specialize (G p q k l Ip Iq Hk Hl). unfold in_ball in *.
  generalize (norm_by_way_of x k l) (norm_by_way_of y x l). rewrite (norm_symmetric k x). lra.
Qed.

(* The directional certificate. If both ends of an axis are more than D farther along n than both ends of another, any
   two points of the two axes are more than D apart: they are means of the ends. *)
Lemma dot_mean n k a b : dot n (mean k a b) = (1 - k) * dot n a + k * dot n b.
Proof. unfold mean. by_coordinates. Qed.
Lemma mean_above (k x y m : R) : 0 <= k <= 1 -> m < x -> m < y -> m < (1 - k) * x + k * y.
Proof.
  intros [P Q] Lx Ly. destruct (Rle_lt_or_eq_dec _ _ P) as [S| <-]; [|lra].
  assert (0 < k * (y - m)) by (apply Rmult_lt_0_compat; lra).
  assert (0 <= (1 - k) * (x - m)) by (apply Rmult_le_pos; lra). lra.
Qed.
Theorem axes_are_apart_along_a_direction (n a b a' b' p q : vector) (D : R) :
  norm n <= 1 ->
  D < dot n a - dot n a' -> D < dot n a - dot n b' -> D < dot n b - dot n a' -> D < dot n b - dot n b' ->
  segment a b p -> segment a' b' q -> D < norm (p - q).
Proof.
  intros Hn L1 L2 L3 L4 (k & Hk & ->) (l & Hl & ->). generalize (dot_at_most_norm n (mean k a b - mean l a' b') Hn).
  rewrite dot_minus, !dot_mean.
  generalize (mean_above k (dot n a - dot n a') (dot n b - dot n a') D Hk L1 L3)
    (mean_above k (dot n a - dot n b') (dot n b - dot n b') D Hk L2 L4). intros M1 M2.
  generalize (mean_above l _ _ D Hl M1 M2). lra.
Qed.

(* The same with a plane: no point k of a shape has n.k above the offset, so that the shape may be a half-space, a box or
   a triangle. If both ends are more than D beyond the plane, all points of the axis are, and more than D from the shape.
   A shape that is carried counts from its carrier, and so do the ends. *)
Theorem axis_beyond_a_plane_is_apart (K : shape) (n a b carrier p : vector) (offset D : R) :
  (forall k, K k -> dot n k <= offset) -> norm n <= 1 ->
  offset + D < dot n (a - carrier) -> offset + D < dot n (b - carrier) -> segment a b p ->
  offset + D < dot n (p - carrier) /\ forall k, K k -> D < norm (p - (carrier + k)).
Proof.
  intros HK Hn La Lb (i & Hi & ->).
  assert (offset + D < dot n (mean i a b - carrier)) as L.
  { generalize (mean_above i _ _ _ Hi La Lb). rewrite !dot_minus, dot_mean. lra. }
  split; [exact L|]. intros k Hk. generalize (HK k Hk) (dot_at_most_norm n (mean i a b - (carrier + k)) Hn).
  replace (dot n (mean i a b - (carrier + k))) with (dot n (mean i a b - carrier) - dot n k) by by_coordinates. lra.
Qed.

(* Two bounds in a direction: n.C - R - distance, of which earliest_meeting takes the first root (Lemma 3), is above zero
   at the time t. *)
Definition ahead (n : vector) (distance t : R) (a b : body) (x y : report) : Prop :=
  0 < dot n (c (bound_from a x) (t - at_time x) - c (bound_from b y) (t - at_time y)) -
        (rho (bound_from a x) (t - at_time x) + rho (bound_from b y) (t - at_time y)) - distance.

Lemma ahead_along (n : vector) (distance t t0 t1 : R) (a b : body) (ma mb : motion) (x y : report) (of_a of_b : list report) :
  norm n <= 1 -> possible a t0 t1 of_a ma -> possible b t0 t1 of_b mb -> In x of_a -> In y of_b ->
  at_time x <= t <= t1 -> at_time y <= t -> ahead n distance t a b x y ->
  r a + r b + distance < dot n (place ma t) - dot n (place mb t).
Proof.
  intros Hn [Ka Ra] [Kb Rb] Ix Iy Hx Hy L. destruct (Ra x Ix) as [Hax Ta]. destruct (Rb y Iy) as [Hby Tb].
  generalize (centre_is_near a ma t0 t1 (at_time x) (at_place x) (with_velocity x) (t - at_time x) Ka)
    (centre_is_near b mb t0 t1 (at_time y) (at_place y) (with_velocity y) (t - at_time y) Kb).
  replace (at_time x + (t - at_time x)) with t by ring. replace (at_time y + (t - at_time y)) with t by ring. intros Na Nb.
  specialize (Na ltac:(lra) ltac:(lra) ltac:(lra) Ta). specialize (Nb ltac:(lra) ltac:(lra) ltac:(lra) Tb).
  revert L. unfold ahead. fold (bound_from a x) (bound_from b y) in *. rewrite dot_minus.
  set (ca := c (bound_from a x) (t - at_time x)) in *. set (cb := c (bound_from b y) (t - at_time y)) in *.
  generalize (dot_at_most_norm n (ca - place ma t) Hn) (dot_at_most_norm n (place mb t - cb) Hn).
  rewrite (norm_symmetric ca), !dot_minus. lra.
Qed.

(* So the axes of two capsules with the ends a false and a true, b false and b true, each a body of its own (Lemma T), are
   apart while each end of the one is ahead of each end of the other; whatever has been reported besides. *)
Theorem capsules_with_ends_ahead_are_not_met (a b : bool -> body) (ma mb : bool -> motion) (x y : bool -> report)
  (of_a of_b : bool -> list report) (n : vector) (radius_a radius_b distance t0 t1 t : R) :
  norm n <= 1 -> (forall i, r (a i) = radius_a) -> (forall j, r (b j) = radius_b) ->
  (forall i, possible (a i) t0 t1 (of_a i) (ma i) /\ In (x i) (of_a i) /\ at_time (x i) <= t) ->
  (forall j, possible (b j) t0 t1 (of_b j) (mb j) /\ In (y j) (of_b j) /\ at_time (y j) <= t) -> t <= t1 ->
  (forall i j, ahead n distance t (a i) (b j) (x i) (y j)) ->
  gap_above distance (Part (place (ma false) t) (place (ma true) t) radius_a :: nil)
                     (Part (place (mb false) t) (place (mb true) t) radius_b :: nil).
Proof.
  intros Hn Ra Rb Ha Hb Ht L p q u v [<-|[]] [<-|[]] Hu Hv. cbn [thickness].
  assert (forall i j, radius_a + radius_b + distance < dot n (place (ma i) t) - dot n (place (mb j) t)) as W.
  { intros i j. destruct (Ha i) as (Pa & Ia & Ta). destruct (Hb j) as (Pb & Ib & Tb). rewrite <- (Ra i), <- (Rb j).
    apply (ahead_along n distance t t0 t1 (a i) (b j) (ma i) (mb j) (x i) (y j) (of_a i) (of_b j)); auto. }
  assert (radius_a + radius_b + distance < norm (u - v)); [|lra].
  apply (axes_are_apart_along_a_direction n _ _ _ _ u v _ Hn (W false false) (W false true) (W true false) (W true true));
    assumption.
Qed.

(* The witness: the gap of two bodies is at most that of any two points of their axes. *)
Lemma witnesses_are_a_gap (P Q : list part) (p q : part) (x y : vector) (distance : R) :
  In p P -> In q Q -> on_axis p x -> on_axis q y -> norm (x - y) - thickness p - thickness q < distance ->
  gap_below distance P Q.
Proof. intros. exists p, q, x, y. auto. Qed.

(* A point of an axis that is fixed in a body stays on the axis. *)
Lemma fixed_point_stays_on_its_axis (m : motion) (w a b p : R -> vector) (radius t0 t1 t : R) :
  turns w a t0 t1 -> turns w b t0 t1 -> turns w p t0 t1 -> segment (a t0) (b t0) (p t0) -> t0 <= t <= t1 ->
  on_axis (Part (place m t + a t) (place m t + b t) radius) (place m t + p t)%vector.
Proof.
  intros Ta Tb Tp (k & Hk & E) Ht. exists k. split; [exact Hk|]. cbn [end_a end_b].
  rewrite (fixed_point_keeps_its_place_between_two w a b p k t0 t1 t Ta Tb Tp Ht E). unfold mean. by_coordinates.
Qed.

(* While the farthest that the bounds of two fixed points allow is below the distance, so is the gap of the two bodies: of
   what is reported with errors, it is less than the distance and 2 e0 of each. Wherever the two points are on their axes. *)
Theorem witnesses_guard_the_contact (a b : body) (ma mb : motion) (wa wb a1 a2 p b1 b2 q : R -> vector)
  (Wa Wb growth_a growth_b da db radius_a radius_b t0 t1 t distance : R) (x y : report) (P Q : list part) :
  keeps_promise a ma t0 t1 -> keeps_spin Wa growth_a wa t0 t1 -> turns wa a1 t0 t1 -> turns wa a2 t0 t1 -> turns wa p t0 t1 ->
  keeps_promise b mb t0 t1 -> keeps_spin Wb growth_b wb t0 t1 -> turns wb b1 t0 t1 -> turns wb b2 t0 t1 -> turns wb q t0 t1 ->
  segment (a1 t0) (a2 t0) (p t0) -> segment (b1 t0) (b2 t0) (q t0) -> norm (p t0) <= da -> norm (q t0) <= db ->
  In (Part (place ma t + a1 t) (place ma t + a2 t) radius_a) P -> In (Part (place mb t + b1 t) (place mb t + b2 t) radius_b) Q ->
  t0 <= at_time x <= t -> t0 <= at_time y <= t -> t <= t1 ->
  let a' := fixed_point a Wa growth_a da radius_a in let b' := fixed_point b Wb growth_b db radius_b in
  true_report a' (motion_of_point ma wa p) (at_time x) (at_place x) (with_velocity x) ->
  true_report b' (motion_of_point mb wb q) (at_time y) (at_place y) (with_velocity y) ->
  norm (c (bound_from a' x) (t - at_time x) - c (bound_from b' y) (t - at_time y)) +
    growth_after (bound_from a' x) (t - at_time x) + growth_after (bound_from b' y) (t - at_time y) <
    (radius_a + e0 a) + (radius_b + e0 b) + distance ->
  gap_below (distance + 2 * e0 a + 2 * e0 b) P Q.
Proof.
  intros Ka Sa T1 T2 Tp Kb Sb U1 U2 Uq Hp Hq Da Db IP IQ Hx Hy Ht a' b' Ra Rb L.
  apply (witnesses_are_a_gap P Q _ _ (place ma t + p t) (place mb t + q t) _ IP IQ).
  - apply (fixed_point_stays_on_its_axis ma wa a1 a2 p radius_a t0 t1 t); auto. lra.
  - apply (fixed_point_stays_on_its_axis mb wb b1 b2 q radius_b t0 t1 t); auto. lra.
  - exact (bodies_have_not_parted a' b' (motion_of_point ma wa p) (motion_of_point mb wb q) t0 t1 (at_time x) (at_time y) t
             (at_place x) (with_velocity x) (at_place y) (with_velocity y) distance
             (fixed_point_keeps_its_promise a ma wa p Wa growth_a da radius_a t0 t1 Ka Sa Tp Da)
             (fixed_point_keeps_its_promise b mb wb q Wb growth_b db radius_b t0 t1 Kb Sb Uq Db) Hx Hy Ht Ra Rb L).
Qed.

(* A pair of parts is left out that cannot close its gap in the time T: the distance of the centres of two balls, less both
   radii, is more than the speed of approach and growth and the accelerations can take from it. *)
Theorem parts_too_far_to_close_are_not_met (a b : bound) (T distance : R) :
  0 <= growth_speed a + growth_speed b -> 0 <= growth a + growth b ->
  (norm (speed a - speed b) + growth_speed a + growth_speed b +
    / 2 * (growth a + norm (plan a) + (growth b + norm (plan b))) * T) * T <
    norm (start a - start b) - (size a + size b) - distance ->
  forall d, 0 <= d <= T -> Rs a b d + distance < norm (C a b d).
Proof.
  intros P1 P2 L d Hd.
  set (X := (start a - start b)%vector) in *. set (V := (speed a - speed b)%vector) in *.
  assert (norm X <= norm (C a b d) + (d * norm V + d * d / 2 * (norm (plan a) + norm (plan b)))) as N.
  { replace X with (C a b d + ((- d) * V + ((- (d * d / 2)) * plan a + (d * d / 2) * plan b)))%vector at 1
      by (unfold C, c, X, V; coordinates; apply (f_equal3 Vector); field).
    apply Rle_trans with (1 := norm_plus _ _).
    generalize (norm_plus ((- d) * V) ((- (d * d / 2)) * plan a + (d * d / 2) * plan b))
      (norm_plus ((- (d * d / 2)) * plan a) ((d * d / 2) * plan b)).
    rewrite !norm_times, !Rabs_Ropp, (Rabs_pos_eq d), (Rabs_pos_eq (d * d / 2)) by nra. lra. }
  unfold Rs, rho. revert N L. generalize (norm_positive V) (norm_positive (plan a)) (norm_positive (plan b)).
  set (v := norm V). set (ga := norm (plan a)). set (gb := norm (plan b)). intros Pv Pa Pb N L.
  assert (d * d <= T * T) as Q by nra.
  assert ((v + growth_speed a + growth_speed b) * d <= (v + growth_speed a + growth_speed b) * T)
    by (apply Rmult_le_compat_l; lra).
  assert ((growth a + growth b + ga + gb) * (d * d) <= (growth a + growth b + ga + gb) * (T * T))
    by (apply Rmult_le_compat_l; lra).
  lra.
Qed.

(* Bodies of many parts. An answer is +infinity or finite, and until then, or until the end of the span, something is
   certain. *)
Definition certain_until (fact : R -> Prop) (from until answer : double) : Prop :=
  (answer = infinity \/ finite answer) /\
  forall t, B from <= t -> (finite until -> t <= B until) -> (finite answer -> t < B answer) -> fact t.
Lemma certified_is_certain (fact : R -> Prop) (from until answer : double) :
  certified (fun d => fact (B from + d)) from until answer -> certain_until fact from until answer.
Proof.
  assert (forall t, B from + (t - B from) = t) as E by (intros; ring).
  intros [[-> H]|(F & _ & H)]; (split; [auto|]); intros t Ht Hu Ha; rewrite <- E; apply H; auto.
Qed.

(* std::min and std::max. *)
Definition smaller (a b : double) : double := if less b a then b else a.
Definition larger (a b : double) : double := if less a b then b else a.
Definition infinite_or_finite (x : double) : Prop := x = infinity \/ finite x.

Lemma less_infinity (x y : double) : infinite_or_finite x -> infinite_or_finite y -> less x y = true ->
  finite x /\ (finite y -> B x < B y).
Proof.
  intros [->|Fx] [->|Fy] L; try discriminate.
  - destruct y as [s|s| |s m e H]; try destruct s; discriminate.
  - split; [exact Fx|discriminate].
  - split; [exact Fx|]. intros _. apply less_true; assumption.
Qed.
Lemma not_less_infinity (x y : double) : infinite_or_finite x -> infinite_or_finite y -> less x y = false -> finite x ->
  finite y /\ B y <= B x.
Proof.
  intros _ [->|Fy] L Fx; [destruct x as [s|s| |s m e H]; try destruct s; discriminate|].
  split; [exact Fy|apply less_false; assumption].
Qed.
Lemma smaller_is_both (x y : double) (t : R) : infinite_or_finite x -> infinite_or_finite y ->
  (finite (smaller x y) -> t < B (smaller x y)) -> (finite x -> t < B x) /\ (finite y -> t < B y).
Proof.
  intros Ix Iy. unfold smaller. destruct (less y x) eqn:L.
  - destruct (less_infinity y x Iy Ix L) as [Fy H]. intros Ht. specialize (Ht Fy). split; [|auto]. intros F. specialize (H F). lra.
  - intros Ht. split; [exact Ht|]. intros Fy. destruct (not_less_infinity y x Iy Ix L Fy) as [Fx H]. specialize (Ht Fx). lra.
Qed.

(* The first meeting: each certificate is asked until the first one so far. It may answer +infinity for a pair that is
   left out, which does not meet until then. *)
Definition first_of (certificates : list (double -> double)) (until : double) : double :=
  fold_left (fun first certificate => smaller first (certificate (smaller first until))) certificates infinity.

(* Two bodies meet no earlier than the first two of their parts. *)
Theorem first_of_all_pairs_is_early (pairs : list ((R -> Prop) * (double -> double))) (from until : double) :
  infinite_or_finite until ->
  (forall apart certificate limit, In (apart, certificate) pairs -> infinite_or_finite limit ->
    certain_until apart from limit (certificate limit)) ->
  certain_until (fun t => forall apart certificate, In (apart, certificate) pairs -> apart t) from until
    (first_of (map snd pairs) until).
Proof.
  intros Iu. unfold first_of.
  assert (forall rest first, infinite_or_finite first ->
    (forall apart certificate limit, In (apart, certificate) rest -> infinite_or_finite limit ->
      certain_until apart from limit (certificate limit)) ->
    let answer := fold_left (fun first certificate => smaller first (certificate (smaller first until))) (map snd rest) first in
    infinite_or_finite answer /\
    forall t, B from <= t -> (finite until -> t <= B until) -> (finite answer -> t < B answer) ->
      (finite first -> t < B first) /\ forall apart certificate, In (apart, certificate) rest -> apart t) as W.
  { induction rest as [|[apart certificate] rest IH]; intros first If H; cbn [map fold_left snd].
    - split; [exact If|]. intros t _ _ Ht. split; [exact Ht|]. intros apart certificate [].
    - set (limit := smaller first until). assert (infinite_or_finite limit) as Il by (unfold limit, smaller; destruct less; assumption).
      destruct (H apart certificate limit (or_introl eq_refl) Il) as [In' Hn]. set (next := certificate limit) in *.
      assert (infinite_or_finite (smaller first next)) as Is by (unfold smaller; destruct less; assumption).
      destruct (IH (smaller first next) Is) as [Ia Ha]; [intros; apply H; [right|]; assumption|].
      split; [exact Ia|]. intros t Ht Hu Hans. destruct (Ha t Ht Hu Hans) as [Hm Hr].
      destruct (smaller_is_both first next t If In' Hm) as [Hf Hx]. split; [exact Hf|].
      intros apart' certificate' [E|I]; [|exact (Hr apart' certificate' I)]. injection E as <- <-.
      apply Hn; [exact Ht| |exact Hx]. unfold limit, smaller. destruct less; [exact Hu|]. intros F. specialize (Hf F). lra. }
  intros H. destruct (W pairs infinity (or_introl eq_refl) H) as [Ia Ha]. split; [exact Ia|].
  intros t Ht Hu Hans. apply (Ha t Ht Hu Hans).
Qed.

(* They are in touch at least until the last certain time of two of their parts. *)
Definition last_of (answers : list double) (from : double) : double := fold_left larger answers from.
Theorem contact_lasts_as_long_as_that_of_two_parts (pairs : list ((R -> Prop) * double)) (from until : double) :
  finite from ->
  (forall touching answer, In (touching, answer) pairs -> certain_until touching from until answer) ->
  certain_until (fun t => exists touching answer, In (touching, answer) pairs /\ touching t) from until
    (last_of (map snd pairs) from).
Proof.
  intros Ff. unfold last_of.
  assert (forall rest last, infinite_or_finite last ->
    (forall touching answer, In (touching, answer) rest -> certain_until touching from until answer) ->
    let answer := fold_left larger (map snd rest) last in
    infinite_or_finite answer /\ forall t, B from <= t -> (finite until -> t <= B until) -> (finite answer -> t < B answer) ->
      (finite last -> t < B last) \/ exists touching answer, In (touching, answer) rest /\ touching t) as W.
  { induction rest as [|[touching answer] rest IH]; intros last Il H; cbn [map fold_left snd].
    - split; [exact Il|]. intros t _ _ Ht. left. exact Ht.
    - destruct (H touching answer (or_introl eq_refl)) as [Ia Ha].
      assert (infinite_or_finite (larger last answer)) as Im by (unfold larger; destruct less; assumption).
      destruct (IH (larger last answer) Im) as [Ie He]; [intros; apply H; right; assumption|].
      split; [exact Ie|]. intros t Ht Hu Hans. destruct (He t Ht Hu Hans) as [Hm|(touching' & answer' & I & T)].
      + revert Hm. unfold larger. destruct less; intros Hm; [|left; exact Hm].
        right. exists touching, answer. split; [left; reflexivity|]. apply Ha; assumption.
      + right. exists touching', answer'. split; [right; exact I|exact T]. }
  intros H. destruct (W pairs from (or_intror Ff) H) as [Ia Ha]. split; [exact Ia|].
  intros t Ht Hu Hans. destruct (Ha t Ht Hu Hans) as [L|E]; [|exact E]. specialize (L Ff). lra.
Qed.
