(* Certificates of bodies that are made of balls, capsules and convex hulls: in a direction, by a witness, and over all pairs
   of parts. *)
From Coq Require Import Reals Lra Psatz List Bool.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats rounding quadratic first_crossing safe_steps.
From Kinesphere Require Import geometry_vectors geometry_motion geometry_bounds geometry_certificates geometry_advancement
  geometry_shapes geometry_knowledge geometry_turning geometry_hulls.
Open Scope R_scope.

(* A part is all that is within its radius of the hull of some points, its core: of a point if it is a ball, of an axis if
   it is a capsule. *)
Record part : Type := Part { points : list vector; thickness : R }.
Definition in_core (p : part) : shape := hull (points p).
Definition in_part (p : part) : shape := fun point => exists x, in_core p x /\ in_ball point x (thickness p).

(* The gap of two bodies, given by their parts, is the least distance of points of two cores less both radii: it is above
   a distance, or below it. *)
Definition gap_above (distance : R) (P Q : list part) : Prop :=
  forall p q x y, In p P -> In q Q -> in_core p x -> in_core q y -> distance < norm (x - y) - thickness p - thickness q.
Definition gap_below (distance : R) (P Q : list part) : Prop :=
  exists p q x y, In p P /\ In q Q /\ in_core p x /\ in_core q y /\ norm (x - y) - thickness p - thickness q < distance.

(* So all points of the two bodies are farther apart. *)
Theorem points_of_parts_are_as_far_apart_as_the_gap (P Q : list part) (distance : R) (p q : part) (x y : vector) :
  gap_above distance P Q -> In p P -> In q Q -> in_part p x -> in_part q y -> distance < norm (x - y).
Proof.
  intros G Ip Iq (k & Hk & Ik) (l & Hl & Il). specialize (G p q k l Ip Iq Hk Hl). unfold in_ball in *.
  generalize (norm_by_way_of x k l) (norm_by_way_of y x l). rewrite (norm_symmetric k x). lra.
Qed.

(* The directional certificate of two parts that move. Each of their points is a body of its own (Lemma T), with a bound
   from one of its reports. While all points of the one are ahead of all points of the other, the two are apart; whatever
   has been reported besides. *)
Theorem parts_with_points_ahead_are_not_met {I J : Type} (is : list I) (js : list J) (a : I -> body) (b : J -> body)
  (ma : I -> motion) (mb : J -> motion) (x : I -> report) (y : J -> report) (of_a : I -> list report) (of_b : J -> list report)
  (n : vector) (radius_a radius_b distance t0 t1 t : R) :
  norm n <= 1 -> (forall i, r (a i) = radius_a) -> (forall j, r (b j) = radius_b) ->
  (forall i, In i is -> possible (a i) t0 t1 (of_a i) (ma i) /\ In (x i) (of_a i) /\ at_time (x i) <= t) ->
  (forall j, In j js -> possible (b j) t0 t1 (of_b j) (mb j) /\ In (y j) (of_b j) /\ at_time (y j) <= t) -> t <= t1 ->
  (forall i j, In i is -> In j js ->
    ahead n distance t (bound_from (a i) (x i)) (bound_from (b j) (y j)) (at_time (x i)) (at_time (y j))) ->
  gap_above distance (Part (map (fun i => place (ma i) t) is) radius_a :: nil) (Part (map (fun j => place (mb j) t) js) radius_b :: nil).
Proof.
  intros Hn Ra Rb Ha Hb Ht L p q u v [<-|[]] [<-|[]] Hu Hv. cbn [thickness].
  assert (radius_a + radius_b + distance < norm (u - v)); [|lra].
  apply (hulls_are_apart_along_a_direction n u v _ _ _ Hn) with (2 := Hu) (3 := Hv). intros p q Ip Iq.
  apply in_map_iff in Ip. destruct Ip as (i & <- & Ii). apply in_map_iff in Iq. destruct Iq as (j & <- & Ij).
  destruct (Ha i Ii) as (Pa & Ia & Ta). destruct (Hb j Ij) as (Pb & Ib & Tb). rewrite <- (Ra i), <- (Rb j).
  apply (ahead_along n distance t t0 t1 (a i) (b j) (ma i) (mb j) (x i) (y j) (of_a i) (of_b j)); auto.
Qed.

(* The witness: the gap of two bodies is at most that of any two points of their cores. *)
Lemma witnesses_are_a_gap (P Q : list part) (p q : part) (x y : vector) (distance : R) :
  In p P -> In q Q -> in_core p x -> in_core q y -> norm (x - y) - thickness p - thickness q < distance ->
  gap_below distance P Q.
Proof. intros. exists p, q, x, y. auto. Qed.

(* A part of a body that turns: the points of its core are fixed in the body. *)
Definition turned_part (m : motion) (arms : list (R -> vector)) (radius t : R) : part :=
  Part (map (fun arm => place m t + arm t)%vector arms) radius.

(* While the farthest that the bounds of two fixed points allow is below the distance, so is the gap of the two bodies: of
   what is reported with errors, it is less than the distance and 2 e0 of each. Wherever the two points are in their cores. *)
Theorem witnesses_guard_the_contact (a b : body) (ma mb : motion) (wa wb p q : R -> vector) (as_ bs : list (R -> vector))
  (Wa Wb growth_a growth_b da db radius_a radius_b t0 t1 t distance : R) (x y : report) (P Q : list part) :
  keeps_promise a ma t0 t1 -> keeps_spin Wa growth_a wa t0 t1 -> (forall arm, In arm as_ -> turns wa arm t0 t1) -> turns wa p t0 t1 ->
  keeps_promise b mb t0 t1 -> keeps_spin Wb growth_b wb t0 t1 -> (forall arm, In arm bs -> turns wb arm t0 t1) -> turns wb q t0 t1 ->
  hull (map (fun arm => arm t0) as_) (p t0) -> hull (map (fun arm => arm t0) bs) (q t0) -> norm (p t0) <= da -> norm (q t0) <= db ->
  In (turned_part ma as_ radius_a t) P -> In (turned_part mb bs radius_b t) Q ->
  t0 <= at_time x <= t -> t0 <= at_time y <= t -> t <= t1 ->
  let a' := fixed_point a Wa growth_a da radius_a in let b' := fixed_point b Wb growth_b db radius_b in
  true_report a' (motion_of_point ma wa p) (at_time x) (at_place x) (with_velocity x) ->
  true_report b' (motion_of_point mb wb q) (at_time y) (at_place y) (with_velocity y) ->
  norm (c (bound_from a' x) (t - at_time x) - c (bound_from b' y) (t - at_time y)) +
    growth_after (bound_from a' x) (t - at_time x) + growth_after (bound_from b' y) (t - at_time y) <
    (radius_a + e0 a) + (radius_b + e0 b) + distance ->
  gap_below (distance + 2 * e0 a + 2 * e0 b) P Q.
Proof.
  intros Ka Sa Ta Tp Kb Sb Tb Tq Hp Hq Da Db IP IQ Hx Hy Ht a' b' Ra Rb L.
  apply (witnesses_are_a_gap P Q _ _ (place ma t + p t) (place mb t + q t) _ IP IQ).
  - apply (fixed_point_stays_in_its_hull _ wa p as_ t0 t1 t); auto. lra.
  - apply (fixed_point_stays_in_its_hull _ wb q bs t0 t1 t); auto. lra.
  - exact (bodies_have_not_parted a' b' (motion_of_point ma wa p) (motion_of_point mb wb q) t0 t1 (at_time x) (at_time y) t
             (at_place x) (with_velocity x) (at_place y) (with_velocity y) distance
             (fixed_point_keeps_its_promise a ma wa p Wa growth_a da radius_a t0 t1 Ka Sa Tp Da)
             (fixed_point_keeps_its_promise b mb wb q Wb growth_b db radius_b t0 t1 Kb Sb Tq Db) Hx Hy Ht Ra Rb L).
Qed.

(* A pair of parts, or a part and the ball around the other body, is left out if along a direction that is fixed in space, no
   longer than 1, its gap is above the distance now and at the end of the time T, at which it is at least the quadratic that
   the speeds along the direction and all accelerations leave. The quadratic is concave, so it is above zero between. *)
Theorem parts_apart_along_a_direction_are_not_met (a b : bound) (n : vector) (T distance : R) :
  norm n <= 1 -> 0 <= growth a + growth b ->
  0 < constant a b n distance ->
  0 < constant a b n distance +
    (linear a b n - / 2 * (growth a + norm (plan a) + (growth b + norm (plan b))) * T) * T ->
  forall d x y, 0 <= d <= T -> in_ball x (c a d) (rho a d) -> in_ball y (c b d) (rho b d) -> distance < norm (x - y).
Proof.
  intros Hn Pg L0 LT d x y Hd Ix Iy.
  set (closing := growth a + norm (plan a) + (growth b + norm (plan b))) in LT.
  assert (0 <= closing) as Pc by (unfold closing; generalize (norm_positive (plan a)) (norm_positive (plan b)); lra).
  assert (- closing <= square a b n) as S.
  { unfold square, closing. rewrite dot_minus.
    generalize (dot_at_most_norm n (plan b) Hn) (dot_at_most_norm n ((-1) * plan a) Hn).
    rewrite dot_times, norm_times, Rabs_left by lra. lra. }
  assert (Rs a b d + distance < norm (C a b d)) as L.
  { apply (linearised_is_below a b n distance d Hn).
    apply Rlt_le_trans with (quadratic (constant a b n distance) (linear a b n) (- closing) d).
    - apply (points_ahead_at_both_ends_are_ahead_between _ _ _ 0 T); try exact Hd; unfold quadratic; lra.
    - unfold quadratic. assert (0 <= d * d) by nra.
      assert (- closing * (d * d) <= square a b n * (d * d)) by (apply Rmult_le_compat_r; assumption). lra. }
  unfold in_ball, Rs, C in *. generalize (norm_by_way_of x (c a d) (c b d)) (norm_by_way_of y x (c b d)).
  rewrite (norm_symmetric (c a d) x). lra.
Qed.

(* Bodies of many parts. An answer is +infinity or finite, and until then, or until the end of the span, something is
   certain. *)
Definition certain_until (fact : R -> Prop) (from until answer : double) : Prop :=
  (answer = infinity \/ finite answer) /\
  forall t, B from <= t -> (finite until -> t <= B until) -> (finite answer -> t < B answer) -> fact t.
Lemma certified_is_certain (apart : R -> Prop) (from until answer : double) :
  certified apart from until answer -> certain_until (fun t => apart (t - B from)) from until answer.
Proof. intros [[-> H]|(F & _ & H)]; (split; [auto|]); intros t Ht Hu Ha; apply H; auto. Qed.

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

(* Two hulls that turn, in double precision. In a direction n the code asks some pairs of their points for the time of the
   root of n.C - R - distance, with coefficients that are not above the exact ones (Lemma 5, about rounding alone, shows it
   for those of the library). All other pairs are ahead until the answer, the least of these times. So the gap of the two is
   above the distance until then, whatever they do within their promises (until t1). *)
Theorem certified_time_is_before_two_hulls_meet (a b : body) (ma mb : motion) (wa wb : R -> vector) (as_ bs : list (R -> vector))
  (x y : (R -> vector) -> report) (Wa Wb growth_a growth_b radius_a radius_b t0 t1 distance : R) (n : vector)
  (asked : list ((R -> vector) * (R -> vector))) (certificate : (R -> vector) * (R -> vector) -> double -> double)
  (from until : double) :
  norm n <= 1 -> finite from -> infinite_or_finite until ->
  keeps_promise a ma t0 t1 -> keeps_spin Wa growth_a wa t0 t1 -> keeps_promise b mb t0 t1 -> keeps_spin Wb growth_b wb t0 t1 ->
  let a' arm := fixed_point a Wa growth_a (norm (arm t0)) radius_a in
  let b' arm := fixed_point b Wb growth_b (norm (arm t0)) radius_b in
  let bound_a arm := bound_from (a' arm) (x arm) in let bound_b arm := bound_from (b' arm) (y arm) in
  (forall arm, In arm as_ -> turns wa arm t0 t1 /\ t0 <= at_time (x arm) <= B from /\
    true_report (a' arm) (motion_of_point ma wa arm) (at_time (x arm)) (at_place (x arm)) (with_velocity (x arm))) ->
  (forall arm, In arm bs -> turns wb arm t0 t1 /\ t0 <= at_time (y arm) <= B from /\
    true_report (b' arm) (motion_of_point mb wb arm) (at_time (y arm)) (at_place (y arm)) (with_velocity (y arm))) ->
  (forall p, In p asked -> exists k l q,
    let now_a := moved_on (bound_a (fst p)) (B from - at_time (x (fst p))) in
    let now_b := moved_on (bound_b (snd p)) (B from - at_time (y (snd p))) in
    lowered k (constant now_a now_b n distance) /\ lowered l (linear now_a now_b n) /\ lowered q (square now_a now_b n) /\
    forall limit, certificate p limit = time_of_crossing from limit k l q) ->
  let answer := first_of (map certificate asked) until in
  (forall p q, In p as_ -> In q bs -> In (p, q) asked \/
    forall t, B from <= t -> (finite until -> t <= B until) -> (finite answer -> t < B answer) ->
      ahead n distance t (bound_a p) (bound_b q) (at_time (x p)) (at_time (y q))) ->
  certain_until
    (fun t => t <= t1 -> gap_above distance (turned_part ma as_ radius_a t :: nil) (turned_part mb bs radius_b t :: nil))
    from until answer.
Proof.
  intros Hn Ff Iu Ka Sa Kb Sb a' b' bound_a bound_b Ha Hb Asked answer Other.
  set (apart := fun p t => ahead n distance t (bound_a (fst p)) (bound_b (snd p)) (at_time (x (fst p))) (at_time (y (snd p)))).
  destruct (first_of_all_pairs_is_early (map (fun p => (apart p, certificate p)) asked) from until Iu) as [Ia H].
  { intros fact cert limit I Il. apply in_map_iff in I. destruct I as (p & [= <- <-] & Ip).
    destruct (Asked p Ip) as (k & l & q & Lk & Ll & Lq & ->). unfold apart.
    destruct (certified_is_certain _ _ _ _
      (time_of_crossing_is_early from limit _ _ _ _ _ _ Lk Ll Lq Ff (proj1 (or_comm _ _) Il))) as [If C].
    split; [exact If|]. intros t Ht Hu Hc. apply (ahead_from (B from)). apply C; assumption. }
  rewrite map_map in Ia, H. cbn [snd] in Ia, H. fold answer in Ia, H. split; [exact Ia|]. intros t Ht Hu Hans Ht1.
  apply (parts_with_points_ahead_are_not_met as_ bs a' b' (motion_of_point ma wa) (motion_of_point mb wb) x y
           (fun arm => x arm :: nil) (fun arm => y arm :: nil) n radius_a radius_b distance t0 t1 t Hn); auto.
  - intros arm I. destruct (Ha arm I) as (T & Hx & R). split; [|split; [left; reflexivity|lra]]. split.
    + apply fixed_point_keeps_its_promise; auto. lra.
    + intros report [<-|[]]. split; [lra|exact R].
  - intros arm I. destruct (Hb arm I) as (T & Hy & R). split; [|split; [left; reflexivity|lra]]. split.
    + apply fixed_point_keeps_its_promise; auto. lra.
    + intros report [<-|[]]. split; [lra|exact R].
  - intros p q Ip Iq. destruct (Other p q Ip Iq) as [I|O]; [|apply O; assumption].
    apply (H t Ht Hu Hans (apart (p, q)) (certificate (p, q))). apply in_map_iff. exists (p, q). auto.
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
