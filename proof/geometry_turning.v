(* Bodies that turn: how far a point that is fixed in one accelerates (Lemma T), and so where it can be. *)
From Coq Require Import Reals Lra Psatz List.
From Kinesphere Require Import geometry_vectors geometry_motion geometry_bounds.
Open Scope R_scope.

(* A point that is fixed in a body is seen from the body's position along an arm, which turns with the body's angular
   velocity w: at all times between t0 and t1 it changes by w x arm. *)
Definition turns (w arm : R -> vector) (t0 t1 : R) : Prop :=
  continuous_during t0 t1 arm /\ forall t, t0 < t < t1 -> has_derivative arm t (cross (w t) (arm t)).

(* What a body promises of how it turns: with the angular speed W at most; and its angular velocity differs from an
   earlier one by no more than the largest angular acceleration a allows. *)
Definition keeps_spin (W a : R) (w : R -> vector) (t0 t1 : R) : Prop :=
  (forall t, t0 <= t <= t1 -> norm (w t) <= W) /\
  (forall s t, t0 <= s <= t -> t <= t1 -> norm (w t - w s) <= a * (t - s)).

(* The promise as users state it: the angular velocity has no jump, and its derivative is at most a. At finitely many
   times the angular acceleration may jump, and there it need not exist. *)
Theorem limited_angular_acceleration_keeps_the_spin (W a : R) (w acceleration : R -> vector) (jumps : list R) (t0 t1 : R) :
  continuous_during t0 t1 w ->
  (forall t, t0 < t < t1 -> ~ In t jumps -> has_derivative w t (acceleration t)) ->
  0 <= a -> (forall t, t0 < t < t1 -> ~ In t jumps -> norm (acceleration t) <= a) ->
  (forall t, t0 <= t <= t1 -> norm (w t) <= W) -> keeps_spin W a w t0 t1.
Proof.
  intros Cw Dw Pa L HW. split; [exact HW|]. intros s t [Hs Ht] Ht1.
  replace (a * (t - s)) with (a * (t - s) - a * (s - s)) by ring.
  apply (moves_no_farther w (fun c => if in_dec Req_EM_T c jumps then zero else acceleration c)
           (fun c => a * (c - s)) (fun _ => a) jumps); [exact Ht| | | |].
  - intros c e Hc He. destruct (Cw c e) as (d & Hd & G); [lra|lra|]. exists d. split; [exact Hd|].
    intros c' Hc'. apply G. lra.
  - intros c Hc N. destruct in_dec; [contradiction|]. apply Dw; [lra|exact N].
  - intros. apply derivative_of_line.
  - intros c Hc. destruct in_dec as [_|N]; [rewrite norm_zero; exact Pa|]. apply L; [lra|exact N].
Qed.

(* A body whose limit a is 0 keeps its angular velocity, so that W may be its present angular speed. *)
Theorem spin_without_growth_is_constant (W : R) (w : R -> vector) (t0 t1 t : R) :
  keeps_spin W 0 w t0 t1 -> t0 <= t <= t1 ->
  (forall s, t <= s <= t1 -> w s = w t) /\ keeps_spin (norm (w t)) 0 w t t1.
Proof.
  intros [_ L] Ht.
  assert (forall s, t <= s <= t1 -> w s = w t) as E.
  { intros s Hs. apply at_no_distance. generalize (L t s ltac:(lra) ltac:(lra)). lra. }
  split; [exact E|]. split.
  - intros s Hs. rewrite E by exact Hs. lra.
  - intros s s' Hs Hs'. apply L; lra.
Qed.

(* The arm keeps its length. *)
Theorem arm_keeps_its_length (w arm : R -> vector) (t0 t1 t : R) :
  turns w arm t0 t1 -> t0 <= t <= t1 -> norm (arm t) = norm (arm t0).
Proof.
  intros [C D] Ht. unfold norm. f_equal. set (f := fun s => dot (arm s) (arm s)). change (f t = f t0).
  assert (real_continuous_during t0 t f) as Cf.
  { intros s e Hs He. destruct (continuous_square_length t0 t1 arm C s e) as (d & Hd & G); [lra|exact He|].
    exists d. split; [exact Hd|]. intros s' Hs'. apply G. lra. }
  assert (forall s, t0 < s < t -> derivable_pt_lim f s 0) as Df.
  { intros s Hs. replace 0 with (2 * dot (arm s) (cross (w s) (arm s))) by (rewrite dot_cross; ring).
    apply derivative_of_square_length, D. lra. }
  apply Rle_antisym.
  - apply (not_rising f (fun _ => 0) nil); [lra|exact Cf|]. intros s Hs _. split; [apply Df; exact Hs|lra].
  - apply Ropp_le_cancel. apply (not_rising (fun s => - f s) (fun _ => 0) nil); [lra| |].
    + intros s e Hs He. destruct (Cf s e Hs He) as (d & Hd & G). exists d. split; [exact Hd|]. intros s' Hs' L.
      replace (- f s' - - f s) with (- (f s' - f s)) by ring. rewrite Rabs_Ropp. apply G; assumption.
    + intros s Hs _. split; [|lra]. replace 0 with (- 0) by ring. apply (derivable_pt_lim_opp f). apply Df. exact Hs.
Qed.

(* The way between two fixed points turns as well, and so does every mean of arms. *)
Lemma differences_turn (w a b : R -> vector) (t0 t1 : R) :
  turns w a t0 t1 -> turns w b t0 t1 -> turns w (fun t => a t - b t)%vector t0 t1.
Proof.
  intros [Ca Da] [Cb Db]. split; [apply continuous_minus; assumption|]. intros t Ht.
  replace (cross (w t) (a t - b t)) with (cross (w t) (a t) - cross (w t) (b t))%vector by by_coordinates.
  apply has_derivative_minus; [apply Da|apply Db]; exact Ht.
Qed.
(* Arms with weights, where they are at a time. *)
Definition placed (t : R) (arms : list (R * (R -> vector))) : list (R * vector) := map (fun arm => (fst arm, snd arm t)) arms.
Lemma means_turn (w : R -> vector) (t0 t1 : R) (arms : list (R * (R -> vector))) :
  (forall k arm, In (k, arm) arms -> turns w arm t0 t1) -> turns w (fun t => weighted (placed t arms)) t0 t1.
Proof.
  induction arms as [|[k arm] arms IH]; intros H.
  - assert (forall t, has_derivative (fun _ : R => zero) t zero) as D by (intros; repeat split; apply derivable_pt_lim_const).
    split; [apply continuous_where_derivable with (x' := fun _ => zero); intros; apply D|].
    intros t _. cbn [placed map weighted]. replace (cross (w t) zero) with zero by by_coordinates. apply D.
  - destruct (H k arm (or_introl eq_refl)) as [Ca Da]. destruct IH as [Cr Dr]; [intros k' arm' I; apply (H k'); right; exact I|].
    change (turns w (fun t => k * arm t + weighted (placed t arms))%vector t0 t1).
    split; [apply continuous_plus; [apply continuous_times; exact Ca|exact Cr]|]. intros t Ht.
    replace (cross (w t) (k * arm t + weighted (placed t arms)))
      with (k * cross (w t) (arm t) + cross (w t) (weighted (placed t arms)))%vector by by_coordinates.
    apply has_derivative_plus; [apply has_derivative_times, Da|apply Dr]; exact Ht.
Qed.

(* Points that are fixed in a body keep their distances: the body is rigid. *)
Theorem fixed_points_keep_their_distance (w a b : R -> vector) (t0 t1 t : R) :
  turns w a t0 t1 -> turns w b t0 t1 -> t0 <= t <= t1 -> norm (a t - b t) = norm (a t0 - b t0).
Proof. intros Ta Tb Ht. exact (arm_keeps_its_length w _ t0 t1 t (differences_turn w a b t0 t1 Ta Tb) Ht). Qed.

(* A fixed point that is a mean of others once is so always: a point of the axis of a capsule, or of a hull, stays where it
   is in it. *)
Theorem fixed_point_keeps_its_place_among_others (w p : R -> vector) (arms : list (R * (R -> vector))) (t0 t1 t : R) :
  (forall k arm, In (k, arm) arms -> turns w arm t0 t1) -> turns w p t0 t1 -> t0 <= t <= t1 ->
  p t0 = weighted (placed t0 arms) -> p t = weighted (placed t arms).
Proof.
  intros Ta Tp Ht E.
  generalize (fixed_points_keep_their_distance w p _ t0 t1 t Tp (means_turn w t0 t1 arms Ta) Ht). cbv beta.
  rewrite <- E. replace (p t0 - p t0)%vector with zero by by_coordinates. rewrite norm_zero. intros N.
  apply at_no_distance. lra.
Qed.

(* Lemma T, where accelerations exist: a point that is fixed in a body, at the distance d from its position or nearer,
   has the velocity v + w x arm, and that has a derivative, which differs from the plan g by at most A + (a + W^2) d. *)
Theorem fixed_point_accelerates_by_at_most (v w arm : R -> vector) (t A W a d : R) (acceleration angular g : vector) :
  has_derivative v t acceleration -> has_derivative w t angular -> has_derivative arm t (cross (w t) (arm t)) ->
  norm (acceleration - g) <= A -> norm angular <= a -> norm (w t) <= W -> norm (arm t) <= d ->
  let total := (acceleration + (cross angular (arm t) + cross (w t) (cross (w t) (arm t))))%vector in
  has_derivative (fun s => v s + cross (w s) (arm s))%vector t total /\ norm (total - g) <= A + (a + W * W) * d.
Proof.
  intros Dv Dw Dr HA Ha HW Hd total. split; [apply has_derivative_plus, has_derivative_cross; assumption|].
  replace (total - g)%vector with ((acceleration - g) + (cross angular (arm t) + cross (w t) (cross (w t) (arm t))))%vector
    by (unfold total; by_coordinates).
  apply Rle_trans with (1 := norm_plus _ _).
  generalize (norm_plus (cross angular (arm t)) (cross (w t) (cross (w t) (arm t)))) (norm_cross angular (arm t))
    (norm_cross (w t) (cross (w t) (arm t))) (norm_cross (w t) (arm t)).
  generalize (norm_positive angular) (norm_positive (w t)) (norm_positive (arm t)) (norm_positive (cross (w t) (arm t))).
  intros P1 P2 P3 P4 N1 N2 N3 N4.
  assert (norm angular * norm (arm t) <= a * d) by (apply Rmult_le_compat; assumption).
  assert (norm (w t) * norm (arm t) <= W * d) as L by (apply Rmult_le_compat; assumption).
  assert (norm (w t) * norm (cross (w t) (arm t)) <= W * (W * d)) by (apply Rmult_le_compat; lra). lra.
Qed.

(* The ball of a radius around a point that is fixed in a body, as a body of its own: its promise, and how it moves. *)
Definition fixed_point (b : body) (W a d radius : R) : body := Body radius (A b + (a + W * W) * d) (g b) (e0 b) (e1 b).
Definition motion_of_point (m : motion) (w arm : R -> vector) : motion :=
  Motion (fun t => place m t + arm t)%vector (fun t => velocity m t + cross (w t) (arm t))%vector.

Lemma arm_moves_no_farther (w arm : R -> vector) (W t0 t1 s t : R) :
  turns w arm t0 t1 -> (forall c, t0 <= c <= t1 -> norm (w c) <= W) -> t0 <= s <= t -> t <= t1 ->
  norm (arm t - arm s) <= W * norm (arm t0) * (t - s).
Proof.
  intros T HW Hs Ht. set (d := norm (arm t0)).
  replace (W * d * (t - s)) with (W * d * (t - s) - W * d * (s - s)) by ring.
  apply (moves_no_farther arm (fun c => cross (w c) (arm c)) (fun c => W * d * (c - s)) (fun _ => W * d) nil); [lra| | | |].
  - intros c e Hc He. destruct T as [C _]. destruct (C c e) as (k & Hk & G); [lra|lra|]. exists k. split; [exact Hk|].
    intros c' Hc'. apply G. lra.
  - intros c Hc _. apply T. lra.
  - intros. apply derivative_of_line.
  - intros c Hc. apply Rle_trans with (1 := norm_cross _ _).
    rewrite (arm_keeps_its_length w arm t0 t1 c T) by lra.
    apply Rmult_le_compat_r; [apply norm_positive|]. apply HW. lra.
Qed.

(* Lemma T. If a body and its angular velocity keep their promises, a point that is fixed in it, at the distance d from
   its position or nearer, moves as the promise of that point says: it differs from the plan by at most
   A + (a + W^2) d. So all that is certain of bodies is certain of balls around such points. *)
Theorem fixed_point_keeps_its_promise (b : body) (m : motion) (w arm : R -> vector) (W a d radius t0 t1 : R) :
  keeps_promise b m t0 t1 -> keeps_spin W a w t0 t1 -> turns w arm t0 t1 -> norm (arm t0) <= d ->
  keeps_promise (fixed_point b W a d radius) (motion_of_point m w arm) t0 t1.
Proof.
  intros (Cx & Dx & V) [HW Ha] T Hd. split; [|split]; cbn [place velocity motion_of_point fixed_point A g].
  - apply continuous_plus; [exact Cx|apply T].
  - intros t Ht. apply has_derivative_plus; [apply Dx; exact Ht|apply T; exact Ht].
  - intros s t Hs Ht. unfold motion_of_point. cbn [place velocity].
    replace (velocity m t + cross (w t) (arm t) - (velocity m s + cross (w s) (arm s) + (t - s) * g b))%vector
      with ((velocity m t - (velocity m s + (t - s) * g b)) +
            (cross (w t - w s) (arm t) + cross (w s) (arm t - arm s)))%vector by by_coordinates.
    apply Rle_trans with (1 := norm_plus _ _).
    generalize (norm_plus (cross (w t - w s) (arm t)) (cross (w s) (arm t - arm s))) (norm_cross (w t - w s) (arm t))
      (norm_cross (w s) (arm t - arm s)) (arm_moves_no_farther w arm W t0 t1 s t T HW Hs Ht) (V s t Hs Ht) (Ha s t Hs Ht)
      (HW s ltac:(lra)).
    rewrite (arm_keeps_its_length w arm t0 t1 t T) by lra.
    generalize (norm_positive (w t - w s)) (norm_positive (w s)) (norm_positive (arm t0)) (norm_positive (arm t - arm s)).
    intros P1 P2 P3 P4 N N1 N2 M L1 L2 L3.
    assert (norm (w t - w s) * norm (arm t0) <= a * (t - s) * d) by (apply Rmult_le_compat; assumption).
    assert (0 <= W * (t - s)) by (apply Rmult_le_pos; lra).
    assert (W * norm (arm t0) * (t - s) <= W * d * (t - s)) by nra.
    assert (norm (w s) * norm (arm t - arm s) <= W * (W * d * (t - s))) by (apply Rmult_le_compat; lra). lra.
Qed.

(* Lemmas 1 and T. After a true report of the place p and velocity q of the body, of the arm and of the angular velocity,
   with the errors e0 and e1 for the point, all points of the ball around the fixed point are in this bound. *)
Theorem fixed_point_lies_in_its_bound (b : body) (m : motion) (w arm : R -> vector) (W a d radius t0 t1 t s : R)
  (p q reported_arm reported_w point : vector) :
  keeps_promise b m t0 t1 -> keeps_spin W a w t0 t1 -> turns w arm t0 t1 -> norm (arm t0) <= d ->
  t0 <= t -> 0 <= s -> t + s <= t1 ->
  norm (p + reported_arm - (place m t + arm t)) <= e0 b ->
  norm (q + cross reported_w reported_arm - (velocity m t + cross (w t) (arm t))) <= e1 b ->
  in_ball point (place m (t + s) + arm (t + s)) radius ->
  let its_bound := Bound (p + reported_arm) (q + cross reported_w reported_arm) (g b) (radius + e0 b) (e1 b)
                     (A b + (a + W * W) * d) in
  in_ball point (c its_bound s) (rho its_bound s).
Proof.
  intros K S T Hd Ht Hs Ht1 Hp Hq I.
  exact (body_lies_in_its_bound (fixed_point b W a d radius) (motion_of_point m w arm) t0 t1 t (p + reported_arm)
           (q + cross reported_w reported_arm) s point (fixed_point_keeps_its_promise b m w arm W a d radius t0 t1 K S T Hd)
           Ht Hs Ht1 (conj Hp Hq) I).
Qed.

(* The ball around a body contains it however it turns: the ball around a fixed point, at every time. *)
Theorem ball_around_a_body_contains_it (b : body) (m : motion) (w arm : R -> vector) (radius t0 t1 t : R) (point : vector) :
  turns w arm t0 t1 -> norm (arm t0) + radius <= r b -> t0 <= t <= t1 ->
  in_ball point (place m t + arm t) radius -> in_ball point (place m t) (r b).
Proof.
  intros T L Ht I. unfold in_ball in *. generalize (norm_by_way_of (place m t + arm t) point (place m t)).
  replace (place m t + arm t - place m t)%vector with (arm t) by (destruct (arm t), (place m t); coordinates; apply (f_equal3 Vector); ring).
  rewrite (arm_keeps_its_length w arm t0 t1 t T Ht). lra.
Qed.
