(* Until the time that earliest_meeting returns the two bodies do not touch. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic sum_down first_crossing.
From Kinesphere Require Import safe_steps errors.
From Kinesphere Require Import meeting_parts meeting_errors direction magnitudes meeting_facts.
From Kinesphere Require Import meeting_margins meeting_coefficients upward meeting_overflow.
Open Scope R_scope.
Local Opaque add sub mul div root neg magnitude widened capped B2R first_crossing.

(* At the time t: the radius of a bound, and the distance of the centres of two, exactly. With
     moved x v g s = x + v s + 1/2 g s^2  and  norm x y z = sqrt (x^2 + y^2 + z^2). *)
Definition radius_at (a : bound) (t : R) : R :=
  moved (B a.(radius)) (B a.(growth_speed)) (B a.(acceleration_limit)) (t - B a.(time)).
Definition distance_at (a b : bound) (t : R) : R :=
  norm (moved (B a.(position_x)) (B a.(velocity_x)) (B a.(plan_x)) (t - B a.(time))
        - moved (B b.(position_x)) (B b.(velocity_x)) (B b.(plan_x)) (t - B b.(time)))
       (moved (B a.(position_y)) (B a.(velocity_y)) (B a.(plan_y)) (t - B a.(time))
        - moved (B b.(position_y)) (B b.(velocity_y)) (B b.(plan_y)) (t - B b.(time)))
       (moved (B a.(position_z)) (B a.(velocity_z)) (B a.(plan_z)) (t - B a.(time))
        - moved (B b.(position_z)) (B b.(velocity_z)) (B b.(plan_z)) (t - B b.(time))).
(* Apart by the distance, and by a little more, so that each radius may be a sum that was rounded.
   No number is infinite or none: [B] makes zero of these, so nothing is said about them. *)
Definition all_finite (a : bound) : Prop :=
  finite a.(time) /\
  (finite a.(position_x) /\ finite a.(position_y) /\ finite a.(position_z)) /\
  (finite a.(velocity_x) /\ finite a.(velocity_y) /\ finite a.(velocity_z)) /\
  (finite a.(plan_x) /\ finite a.(plan_y) /\ finite a.(plan_z)) /\
  (finite a.(radius) /\ finite a.(growth_speed) /\ finite a.(acceleration_limit)).
Definition apart (a b : bound) (distance : double) (t : R) : Prop :=
  (all_finite a /\ all_finite b /\ finite distance) /\
  radius_at a t + radius_at b t + B distance + 3 * u * (B a.(radius) + B b.(radius)) < distance_at a b t.

Lemma sum_of_sizes_finite (x y z r : double) : finite (sum_of_sizes x y z r) -> (finite x /\ finite y /\ finite z) /\ finite r.
Proof.
  unfold sum_of_sizes. intros F. apply widened_finite in F. destruct (add_finite _ _ F) as (F1 & Fr & _).
  destruct (add_finite _ _ F1) as (F2 & Fz & _). destruct (add_finite _ _ F2) as (Fx & Fy & _).
  rewrite magnitude_finite in Fx, Fy, Fz. auto.
Qed.

Lemma inputs_finite (a b : bound) (from distance d l : double) : sound a from -> sound b from ->
  finite (gap a b from distance d l) -> all_finite a /\ all_finite b /\ finite distance.
Proof.
  intros Sa Sb F. unfold gap in F. destruct (sub_finite _ _ F) as (_ & F1 & _). destruct (mul_finite _ _ F1) as (_ & F2 & _).
  destruct (add_finite _ _ F2) as (Ft & Fd & _). rewrite magnitude_finite in Fd.
  destruct (sizes_finite a b from d Ft) as ((G & V & P) & (H & W & Q) & Fs & Fr & _).
  destruct (elapsed_close from a.(time) ltac:(apply Sa) Fs) as (_ & Ta & _).
  destruct (elapsed_close from b.(time) ltac:(apply Sb) Fr) as (_ & Tb & _).
  unfold all_finite.
  destruct (sum_of_sizes_finite _ _ _ _ G), (sum_of_sizes_finite _ _ _ _ V), (sum_of_sizes_finite _ _ _ _ P),
    (sum_of_sizes_finite _ _ _ _ H), (sum_of_sizes_finite _ _ _ _ W), (sum_of_sizes_finite _ _ _ _ Q). tauto.
Qed.

Lemma along_apart (a b : bound) (from distance : double) (n1 n2 n3 t : R) :
  all_finite a /\ all_finite b /\ finite distance -> n1 * n1 + n2 * n2 + n3 * n3 <= 1 ->
  0 < along a b from n1 n2 n3 t - (radii a b from t + B distance) - 3 * u * (B a.(radius) + B b.(radius)) ->
  apart a b distance (B from + t).
Proof.
  intros Hf Hn Hp. split; [exact Hf|]. unfold distance_at, radius_at.
  replace (B from + t - B a.(time)) with (B from - B a.(time) + t) by ring.
  replace (B from + t - B b.(time)) with (B from - B b.(time) + t) by ring.
  unfold along, axis, radii in Hp.
  eapply Rlt_le_trans; [|apply (norm_above _ _ _ n1 n2 n3 Hn)]. lra.
Qed.

Section Step.

Variables a b : bound.
Variables from distance d : double.
Hypothesis sound_a : sound a from.
Hypothesis sound_b : sound b from.
Hypothesis d_finite : finite d.
Hypothesis d_pos : 0 <= B d.

Definition safe (g : double) : Prop :=
  (g = infinity /\ forall t, B from + B d <= t -> apart a b distance t) \/
  (finite g /\ 0 <= B g /\ forall t, B from + B d <= t < B from + B d + B g -> apart a b distance t).

Lemma zero_is_safe : safe (literal 0 0).
Proof.
  right. split; [exact (proj1 literal_0)|]. rewrite (proj2 literal_0). split; [lra|]. intros t Ht. lra.
Qed.

Lemma step_along_safe (l x y z : double) :
  (finite l -> 0 <= B l <= bpow radix2 512) ->
  (l = infinity -> l = length a b from d /\
     x = (place_x a b from d / l)%float /\ y = (place_y a b from d / l)%float /\ z = (place_z a b from d / l)%float) ->
  (forall L K M N, known a b from d L K M N -> finite l -> exists n1 n2 n3, n1 * n1 + n2 * n2 + n3 * n3 <= 1 /\
     close x n1 1 700 /\ close y n2 1 700 /\ close z n3 1 700 /\
     close l (along a b from n1 n2 n3 (B d)) (into_places a b from d L K) 1600) ->
  safe (step_along a b from distance d l x y z).
Proof.
  intros HL HI HD. unfold step_along.
  destruct (first_crossing_is_early (gap a b from distance d l) (speed a b from d x y z) (acceleration a b x y z))
    as [E|[E|(_ & Ec & Fb & Fa & Pb & Pa)]].
  - rewrite E. exact zero_is_safe.
  - destruct E as (Fc & Fb & Fa & Lc & E).
    assert (finite (size_then a b from d)) as Ft.
    { unfold gap in Fc. destruct (sub_finite _ _ Fc) as (_ & F & _). destruct (mul_finite _ _ F) as (_ & F1 & _).
      destruct (add_finite _ _ F1) as (F2 & _). exact F2. }
    assert (finite l) as Fl.
    { unfold gap in Fc. destruct (sub_finite _ _ Fc) as (F & _). destruct (sub_finite _ _ F) as (F1 & _).
      destruct (sub_finite _ _ F1) as (F2 & _). exact F2. }
    destruct (all_known a b from d sound_a sound_b d_pos Ft) as (L & K & M & N & facts).
    destruct (HD L K M N facts Fl) as (n1 & n2 & n3 & Hn & Cx & Cy & Cz & Cl).
    assert (forall e, 0 <= e -> 0 < quadratic (B (gap a b from distance d l)) (B (speed a b from d x y z)) (B (acceleration a b x y z)) e ->
      apart a b distance (B from + (B d + e))) as Ok.
    { intros e Pe Q. apply (along_apart a b from distance n1 n2 n3); [exact (inputs_finite a b from distance d l sound_a sound_b Fc)|exact Hn|].
      eapply Rlt_le_trans; [exact Q|].
      apply (quadratic_below a b from distance d d_pos L K M N facts Ft x y z n1 n2 n3 Cx Cy Cz l e Cl Fc Fb Fa Lc Pe). }
    destruct E as [[-> E]|(Fr & Pr & E)]; [left|right].
    + split; [reflexivity|]. intros t Ht. replace t with (B from + (B d + (t - B from - B d))) by ring.
      apply Ok; [lra|]. apply E. lra.
    + split; [exact Fr|]. split; [lra|]. intros t Ht. replace t with (B from + (B d + (t - B from - B d))) by ring.
      apply Ok; [lra|]. apply E. lra.
  - exfalso. exact (gap_not_infinite a b from distance d sound_a sound_b d_finite d_pos x y z l HL HI Fb Pb Fa Pa Ec).
Qed.

(* Where there is no direction, the distance is not below zero. *)
Lemma no_direction_safe : safe (step_along a b from distance d (literal 0 0) (literal 0 0) (literal 0 0) (literal 0 0)).
Proof.
  apply step_along_safe.
  - intros _. rewrite (proj2 literal_0). split; [lra|apply bpow_ge_0].
  - intros E. exfalso. assert (F := proj1 literal_0). rewrite E in F. discriminate.
  - intros L K M N facts _. exists 0, 0, 0. split; [lra|].
    assert (close (literal (prec := 53) (emax := 1024) 0 0) 0 1 700) as C.
    { intros _. rewrite (proj2 literal_0), Rminus_0_r, Rabs_R0. change (roundoff (prec := 53)) with u.
      rewrite u_value. lra. }
    repeat (split; [exact C|]). intros _.
    rewrite (proj2 literal_0). unfold along. rewrite !Rmult_0_l, !Rplus_0_r, Rminus_0_r, Rabs_R0.
    assert (0 <= into_places a b from d L K) as P.
    { destruct (known_times _ _ _ _ _ _ _ _ facts) as (PS & PT & PD).
      destruct (known_loss_a _ _ _ _ _ _ _ _ facts) as (L1 & _). destruct (known_loss_b _ _ _ _ _ _ _ _ facts) as (K1 & _).
      assert (PY := tiny_pos).
      unfold into_places, into, into_centre, into_place, into_velocity.
      repeat first [assumption | apply Rabs_pos | apply Rlt_le, PY | lra | apply Rplus_le_le_0_compat | apply Rmult_le_pos]. }
    change (roundoff (prec := 53)) with u. split; [|exact P]. rewrite u_value. lra.
Qed.

Theorem meeting_step_is_early : safe (meeting_step a b from distance d).
Proof.
  rewrite meeting_step_parts. cbv zeta.
  destruct (less (literal 1 (-500)) (length a b from d)) eqn:L1; [|exact no_direction_safe].
  destruct (less (literal 0 0) (length a b from d)) eqn:L2.
  - apply step_along_safe.
    + apply length_not_more.
    + intros _. repeat split.
    + intros L K M N facts Fl.
      destruct (known_plans_a _ _ _ _ _ _ _ _ facts) as (HLx & HLy & HLz & _).
      destruct (known_plans_b _ _ _ _ _ _ _ _ facts) as (HKx & HKy & HKz & _).
      exact (length_along _ _ _ _ _ _ _ _ _
        (place_close a b from d d_pos L K M N facts a.(position_x) a.(velocity_x) a.(plan_x) b.(position_x) b.(velocity_x) b.(plan_x) HLx HKx)
        (place_close a b from d d_pos L K M N facts a.(position_y) a.(velocity_y) a.(plan_y) b.(position_y) b.(velocity_y) b.(plan_y) HLy HKy)
        (place_close a b from d d_pos L K M N facts a.(position_z) a.(velocity_z) a.(plan_z) b.(position_z) b.(velocity_z) b.(plan_z) HLz HKz)
        Fl L1).
  - exfalso. destruct (literal_power (-500)) as [FL VL]; [lia|].
    destruct (is_finite (length a b from d)) eqn:F.
    + apply less_true in L1; try assumption. apply less_false in L2; [|exact (proj1 literal_0)|exact F].
      rewrite VL in L1. rewrite (proj2 literal_0) in L2. generalize (bpow_gt_0 radix2 (-500)). lra.
    + destruct (length a b from d) as [q|[|]| |q m e HH]; discriminate.
Qed.

End Step.

(* Until the answer, or until the end of the span that is asked about, the two do not come within the distance. *)
Theorem earliest_meeting_is_early (a b : bound) (from until distance : double) :
  sound a from -> sound b from -> finite from -> finite until \/ until = infinity ->
  let r := earliest_meeting a b from until distance in
  (r = infinity /\ forall t, B from <= t -> (finite until -> t <= B until) -> apart a b distance t) \/
  (finite r /\ B from <= B r /\ forall t, B from <= t < B r -> apart a b distance t).
Proof.
  intros Sa Sb Ff Hu r.
  assert (certified (fun x => apart a b distance (B from + x)) from until r) as C.
  { apply advance_by_safe_steps_is_early; try assumption.
    intros d Fd Pd. destruct (meeting_step_is_early a b from distance d Sa Sb Fd Pd) as [[E H]|(F & P & H)]; [left|right].
    - split; [exact E|]. intros x Hx. apply H. lra.
    - split; [exact F|]. split; [exact P|]. intros x Hx. apply H. lra. }
  assert (forall t, B from + (t - B from) = t) as Back by (intros t; ring).
  destruct C as [[E H]|(F & P & H)]; [left|right].
  - split; [exact E|]. intros t H1 H2. specialize (H t H1 H2). rewrite Back in H. exact H.
  - split; [exact F|]. split; [exact P|]. intros t Ht. specialize (H t Ht). rewrite Back in H. exact H.
Qed.

(* It does say something. Two unit balls, 6 apart, that go towards each other with a speed of 1, may accelerate by
   1/8, and are reported at the time 0. If they do, they meet when 4 - 2 t - t^2 / 8 = 0, at 1.7980; the answer is
   above 1.797. *)
Local Transparent add sub mul div root neg magnitude widened capped first_crossing.
Definition one_of_two (x v : Z) : bound :=
  let o := literal 0 0 in
  {| time := o; position_x := literal x 0; position_y := o; position_z := o;
     velocity_x := literal v 0; velocity_y := o; velocity_z := o; plan_x := o; plan_y := o; plan_z := o;
     radius := literal 1 0; growth_speed := o; acceleration_limit := literal 1 (-3) |}.
Theorem a_meeting_is_found :
  let a := one_of_two (-3) 1 in let b := one_of_two 3 (-1) in let o := literal 0 0 in
  let r := earliest_meeting a b o infinity o in
  sound a o /\ sound b o /\ less (literal 1797 0 / literal 1000 0)%float r = true /\ less r (literal 1799 0 / literal 1000 0)%float = true.
Proof. vm_compute. repeat split. Qed.
