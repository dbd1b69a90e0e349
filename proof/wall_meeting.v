(* earliest_meeting of a bound and a half-space, which certifies walls, planes, and pairs of points of hulls along a direction:
   until the time that it returns the bound is beyond the plane. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic sum_down first_crossing safe_steps errors.
From Kinesphere Require Import meeting_parts meeting_errors direction magnitudes meeting_facts meeting_margins meeting_coefficients
  earliest_meeting.
Open Scope R_scope.
Local Opaque add sub mul div root neg magnitude widened capped B2R first_crossing.

(* The parts of the function. *)
Section Parts.

Variable a : bound.
Variables x y z offset from distance : double.
Notation s := (elapsed_a a from).

Definition place_along : double := dot x y z a.(position_x) a.(position_y) a.(position_z).
Definition velocity_along : double := dot x y z a.(velocity_x) a.(velocity_y) a.(velocity_z).
Definition plan_along : double := dot x y z a.(plan_x) a.(plan_y) a.(plan_z).
Definition place_now : double := (place_along + (velocity_along + half * plan_along * s) * s)%float.
Definition grown : double := ((a.(growth_speed) + half * a.(acceleration_limit) * s) * s)%float.

Definition plan_cap : double := capped (plan_size a).
Definition speed_cap : double := capped (speed_size a + plan_cap * s)%float.
Definition place_cap : double := capped (place_size a + speed_cap * s)%float.
Definition wall_size : double := (place_cap + magnitude offset + magnitude distance)%float.

Definition wall_gap : double := (((((place_now - offset) - a.(radius)) - grown) - distance) - margin * wall_size)%float.
Definition wall_speed : double :=
  (((velocity_along + plan_along * s) - (a.(growth_speed) + a.(acceleration_limit) * s)) - margin * speed_cap)%float.
Definition wall_acceleration : double := ((plan_along - a.(acceleration_limit)) - margin * plan_cap)%float.

Lemma wall_meeting_parts (until : double) :
  wall_meeting a x y z offset from until distance =
  let time := sum_down from (first_crossing wall_gap wall_speed wall_acceleration) in
  if less until time then infinity else if less from time then time else from.
Proof.
  cbv beta zeta delta [wall_meeting wall_gap wall_speed wall_acceleration wall_size place_cap speed_cap plan_cap grown place_now
    plan_along velocity_along place_along dot elapsed_a place_size speed_size plan_size sum_of_sizes].
  match goal with |- ?x = ?y => constr_eq x y end. reflexivity.
Qed.

(* The exact numbers, at the time t after `from'. *)
Notation S := (B from - B a.(time)).
Definition centre_along (t : R) : R :=
  B x * moved (B a.(position_x)) (B a.(velocity_x)) (B a.(plan_x)) (S + t) +
  B y * moved (B a.(position_y)) (B a.(velocity_y)) (B a.(plan_y)) (S + t) +
  B z * moved (B a.(position_z)) (B a.(velocity_z)) (B a.(plan_z)) (S + t).
Definition size_now (t : R) : R := moved (B a.(radius)) (B a.(growth_speed)) (B a.(acceleration_limit)) (S + t).

Hypothesis sound_a : sound a from.

Lemma wall_inputs_finite : finite wall_gap ->
  (all_finite a /\ finite x /\ finite y /\ finite z /\ finite offset /\ finite distance) /\
  (finite (plan_size a) /\ finite (speed_size a) /\ finite (place_size a)) /\ finite s /\
  plan_cap = plan_size a /\ speed_cap = (speed_size a + plan_size a * s)%float /\
  place_cap = (place_size a + (speed_size a + plan_size a * s) * s)%float.
Proof.
  unfold wall_gap. intros F. destruct (sub_finite _ _ F) as (F1 & Fm & _). destruct (mul_finite _ _ Fm) as (_ & Fs & _).
  unfold wall_size in Fs. destruct (add_finite _ _ Fs) as (Fs1 & Fd & _). destruct (add_finite _ _ Fs1) as (Fc & Fo & _).
  apply (proj1 (magnitude_finite _)) in Fd, Fo. unfold place_cap in *. destruct (capped_finite _ Fc) as (E3 & Fc1 & _).
  destruct (add_finite _ _ Fc1) as (FP & Fc2 & _). destruct (mul_finite _ _ Fc2) as (Fc3 & Fe & _).
  unfold speed_cap in *. destruct (capped_finite _ Fc3) as (E2 & Fc4 & _). destruct (add_finite _ _ Fc4) as (FV & Fc5 & _).
  destruct (mul_finite _ _ Fc5) as (Fc6 & _ & _). unfold plan_cap in *. destruct (capped_finite _ Fc6) as (E1 & FG & _).
  rewrite E1 in *. rewrite E2 in *. rewrite E3 in *.
  destruct (sub_finite _ _ F1) as (F2 & _). destruct (sub_finite _ _ F2) as (F3 & _). destruct (sub_finite _ _ F3) as (F4 & _).
  destruct (sub_finite _ _ F4) as (F5 & _). unfold place_now in F5. destruct (add_finite _ _ F5) as (F6 & _).
  unfold place_along, dot in F6. destruct (add_finite _ _ F6) as (F7 & F8 & _). destruct (add_finite _ _ F7) as (F9 & F10 & _).
  apply mul_finite in F8, F9, F10. destruct (elapsed_close from a.(time) ltac:(apply sound_a) Fe) as (_ & Ta & _).
  destruct (sum_of_sizes_finite _ _ _ _ FG), (sum_of_sizes_finite _ _ _ _ FV), (sum_of_sizes_finite _ _ _ _ FP).
  unfold all_finite. tauto.
Qed.

Hypothesis short : Rabs (B x) <= 1 /\ Rabs (B y) <= 1 /\ Rabs (B z) <= 1.

(* What is to spare: some roundoffs of the radius, the offset and the distance, and of what underflow may take. *)
Definition to_spare : R := 6 * u * (B a.(radius) + Rabs (B offset) + Rabs (B distance)) + 1000000 * u * tiny.

(* With these coefficients the quadratic is below how far the bound is beyond the plane, and the distance. *)
Lemma wall_quadratic_below (e : R) :
  finite wall_gap -> finite wall_speed -> finite wall_acceleration -> bpow radix2 (-975) < B wall_gap -> 0 <= e ->
  quadratic (B wall_gap) (B wall_speed) (B wall_acceleration) e <=
    centre_along e - (size_now e + B offset + B distance) - to_spare.
Proof.
  intros Fc Fb Fa Lc Pe. destruct (wall_inputs_finite Fc) as (_ & (FG & FV & FP) & Fs & EG & EV & EP).
  destruct (bound_sizes a from sound_a FG FV FP) as
    ((PP & PV & PG) & (PR & PE & PC) & (SP & SV & SG) & (L & (L1 & L2 & L3) & HLx & HLy & HLz & HL & HLs) &
     (M & (M1 & M2) & HMx & HMy & HMz & HMs)).
  destruct (elapsed_close from a.(time) ltac:(apply sound_a) Fs) as (_ & _ & PS & Cs). fold s in Cs.
  set (T := S) in *. set (G := B (plan_size a)) in *. set (V := B (speed_size a)) in *. set (P := B (place_size a)) in *.
  change (B (plan_size a) <> 0 -> tiny <= L) in HLs. change (B (speed_size a) <> 0 -> tiny <= M) in HMs.
  assert (PY := tiny_pos). assert (H2 := half_close). assert (H47 := margin_close).
  assert (Cx : close x (B x) 1 0) by (intros _; rewrite Rminus_diag_eq, Rabs_R0 by reflexivity; split; [lra|tauto]).
  assert (Cy : close y (B y) 1 0) by (intros _; rewrite Rminus_diag_eq, Rabs_R0 by reflexivity; split; [lra|tauto]).
  assert (Cz : close z (B z) 1 0) by (intros _; rewrite Rminus_diag_eq, Rabs_R0 by reflexivity; split; [lra|tauto]).
  assert (PL2 := Rplus_le_le_0_compat _ _ L1 L1). assert (PL3 := Rplus_le_le_0_compat _ _ PL2 L1).
  assert (PML := Rplus_le_le_0_compat _ _ M1 L1).
  assert (ZG : B plan_along <> 0 -> tiny <= L + L + L).
  { unfold plan_along, dot. apply zero_sum; [exact PL2|exact L1|apply zero_sum; try exact L1|]; apply zero_product; assumption. }
  assert (ZhG := zero_product half _ _ ZG). assert (ZhC := zero_product half _ _ HL).
  generalize (close_positive _ PR) (close_positive _ PE) (close_positive _ PC) (close_positive _ PP) (close_positive _ PV)
    (close_positive _ PG) (close_exact offset) (close_exact distance) (magnitude_close offset) (magnitude_close distance).
  fold G V P. intros CR CE CC CP CV CG CO CD CmO CmD.
  assert (LT := loss_and_time L G T L1 PS L2 L3).
  assert (PVT : 0 <= V * T) by (apply Rmult_le_pos; assumption). assert (PGT : 0 <= G * T) by (apply Rmult_le_pos; assumption).
  assert (PTT : 0 <= T * T) by (apply Rmult_le_pos; assumption).
  assert (PGTT : 0 <= G * (T * T)) by (apply Rmult_le_pos; assumption).
  assert (LT1 : L * T <= few * (G * T)) by (rewrite <- (Rmult_assoc few); apply Rmult_le_compat_r; assumption).
  assert (LTT : L * (T * T) <= few * (G * (T * T))) by (rewrite <- (Rmult_assoc few); apply Rmult_le_compat_r; assumption).
  assert (MT : M * T <= few * (V * T)) by (rewrite <- (Rmult_assoc few); apply Rmult_le_compat_r; assumption).
  assert (SVT := Rmult_le_compat_r T _ _ PS SV). assert (SGT := Rmult_le_compat_r T _ _ PS SG).
  assert (SGTT := Rmult_le_compat_r (T * T) _ _ PTT SG).
  generalize (Rabs_pos (B offset)) (Rabs_pos (B distance)). intros PO PD.
  set (T1 := P + (V + G * T) * T + Rabs (B offset) + Rabs (B distance)). set (T2 := V + G * T).
  assert (PT1 : 0 <= T1) by (unfold T1; clear - PP PVT PGTT PO PD; lra).
  assert (PT2 : 0 <= T2) by (apply Rplus_le_le_0_compat; assumption).
  (* The first coefficient. *)
  assert (Uc : B wall_gap <= centre_along 0 - (size_now 0 + B offset + B distance) - 25 * u * T1 + 20000 * u * tiny /\
    B wall_gap <= 2 * T1 + 1000 * tiny).
  { unfold wall_gap in *. destruct (sub_finite _ _ Fc) as (_ & Fm & _).
    assert (exists Y, close (margin * wall_size)%float (64 * u * T1) Y 1000 /\ Y <= 64 * u * (2 * T1 + 2 * tiny) + tiny) as (Ym & Cm & HYm).
    { unfold wall_size. rewrite EP. eexists. split; [eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths]|].
      - unfold T1. ring.
      - unfold T1. clear - LT PVT PGTT PP PO PD PY. rewrite few_value in LT. rewrite u_value. lra. }
    assert (exists Y, close ((((place_now - offset) - a.(radius)) - grown) - distance)%float
      (centre_along 0 - (size_now 0 + B offset + B distance)) Y 1900 /\ Y <= 3 / 2 * T1 + 200 * tiny) as (Yc & Cc & HYc).
    { unfold place_now, grown, place_along. unfold dot at 1. unfold velocity_along. unfold dot at 1.
      assert (close plan_along (B x * B a.(plan_x) + B y * B a.(plan_y) + B z * B a.(plan_z))
        (1 * Rabs (B a.(plan_x)) + L + (1 * Rabs (B a.(plan_y)) + L) + (1 * Rabs (B a.(plan_z)) + L)) 400) as Cpl
        by (unfold plan_along, dot; eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths]).
      eexists. split; [eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths]|].
      - unfold centre_along, size_now, moved. fold T. field.
      - unfold T1. clear - SP SVT SGTT MT LT LTT PVT PGTT PP PO PD PY. rewrite few_value in *. lra. }
    destruct (lowered _ _ _ Yc 1900 T1 (4000 * u * tiny) Fc Cc) as [X1 X2].
    - split; discriminate.
    - destruct (Cm Fm) as [E _]. eapply Rle_trans; [exact E|]. change (roundoff (prec := 53)) with u. clear - HYm PT1 PY.
      rewrite u_value in *. lra.
    - replace (4000 * u * tiny / (20 * u)) with (200 * tiny) by (rewrite u_value; field). exact HYc.
    - exact PT1.
    - clear - PY. rewrite u_value. lra.
    - replace (4000 * u * tiny / (4 * u)) with (1000 * tiny) in X2 by (rewrite u_value; field). split; [|exact X2].
      clear - X1. lra. }
  (* The second. *)
  assert (Ub : B wall_speed <= B x * (B a.(velocity_x) + B a.(plan_x) * T) + B y * (B a.(velocity_y) + B a.(plan_y) * T) +
      B z * (B a.(velocity_z) + B a.(plan_z) * T) - (B a.(growth_speed) + B a.(acceleration_limit) * T) - 25 * u * T2 + 20000 * u * L).
  { unfold wall_speed in *. destruct (sub_finite _ _ Fb) as (_ & Fm & _). rewrite EV in *.
    assert (ZV := zero_sum _ _ M L M1 L1 HMs (zero_product_l _ s L HLs)).
    assert (exists Y, close (margin * (speed_size a + plan_size a * s))%float (64 * u * T2) Y 500 /\
      Y <= 64 * u * (T2 + L) + (M + L)) as (Ym & Cm & HYm).
    { eexists. split; [eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths]|].
      - unfold T2. ring.
      - unfold T2. clear. rewrite u_value. lra. }
    assert (exists Y, close ((velocity_along + plan_along * s) - (a.(growth_speed) + a.(acceleration_limit) * s))%float
      (B x * (B a.(velocity_x) + B a.(plan_x) * T) + B y * (B a.(velocity_y) + B a.(plan_y) * T) +
       B z * (B a.(velocity_z) + B a.(plan_z) * T) - (B a.(growth_speed) + B a.(acceleration_limit) * T)) Y 1900 /\
      Y <= 3 / 2 * T2 + 200 * L) as (Yc & Cc & HYc).
    { assert (close plan_along (B x * B a.(plan_x) + B y * B a.(plan_y) + B z * B a.(plan_z))
        (1 * Rabs (B a.(plan_x)) + L + (1 * Rabs (B a.(plan_y)) + L) + (1 * Rabs (B a.(plan_z)) + L)) 400) as Cpl
        by (unfold plan_along, dot; eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths]).
      unfold velocity_along, dot. eexists. split; [eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths]|].
      - ring.
      - unfold T2. clear - SV SGT M2 L1 LT1 PV PGT. rewrite few_value in *. lra. }
    destruct (lowered _ _ _ Yc 1900 T2 (4000 * u * L) Fb Cc) as [X1 _].
    - split; discriminate.
    - destruct (Cm Fm) as [E _]. eapply Rle_trans; [exact E|]. change (roundoff (prec := 53)) with u.
      unfold T2 in *. clear - HYm M2 L1 PV PGT. rewrite few_value, u_value in *. lra.
    - replace (4000 * u * L / (20 * u)) with (200 * L) by (rewrite u_value; field). exact HYc.
    - exact PT2.
    - clear - L1. rewrite u_value. lra.
    - clear - X1. lra. }
  (* The third. *)
  assert (Ua : B wall_acceleration <= B x * B a.(plan_x) + B y * B a.(plan_y) + B z * B a.(plan_z) - B a.(acceleration_limit)
      - 25 * u * G).
  { unfold wall_acceleration in *. destruct (sub_finite _ _ Fa) as (_ & Fm & _). rewrite EG in *.
    assert (close (margin * plan_size a)%float (64 * u * G) (64 * u * G + L) 200) as Cm
      by (eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths]).
    destruct (lowered (plan_along - a.(acceleration_limit))%float (margin * plan_size a)%float
      (B x * B a.(plan_x) + B y * B a.(plan_y) + B z * B a.(plan_z) - B a.(acceleration_limit))
      (1 * Rabs (B a.(plan_x)) + L + (1 * Rabs (B a.(plan_y)) + L) + (1 * Rabs (B a.(plan_z)) + L) + B a.(acceleration_limit))
      600 G 0 Fa) as [X1 _].
    - unfold plan_along, dot. eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths].
    - split; discriminate.
    - destruct (Cm Fm) as [E _]. eapply Rle_trans; [exact E|]. change (roundoff (prec := 53)) with u. clear - L3 PG.
      rewrite few_value, u_value in *. lra.
    - replace (0 / (20 * u)) with 0 by (rewrite u_value; field). clear - SG L3 PG. rewrite few_value in *. lra.
    - exact PG.
    - apply Rle_refl.
    - clear - X1. lra. }
  (* The quadratic. *)
  destruct Uc as [Uc Lower].
  assert (quadratic (centre_along 0 - (size_now 0 + B offset + B distance))
    (B x * (B a.(velocity_x) + B a.(plan_x) * T) + B y * (B a.(velocity_y) + B a.(plan_y) * T) +
      B z * (B a.(velocity_z) + B a.(plan_z) * T) - (B a.(growth_speed) + B a.(acceleration_limit) * T))
    (B x * B a.(plan_x) + B y * B a.(plan_y) + B z * B a.(plan_z) - B a.(acceleration_limit)) e
    = centre_along e - (size_now e + B offset + B distance)) as <- by (unfold quadratic, centre_along, size_now, moved; fold T; field).
  assert (tiny * 70368744177664 <= bpow radix2 (-975) * / 2) as Tiny.
  { unfold least. replace 70368744177664 with (bpow radix2 46) by reflexivity.
    change (/ 2) with (bpow radix2 (-1)). rewrite <- !bpow_plus. apply bpow_le. lia. }
  assert (RT : 0 <= B a.(radius) + Rabs (B offset) + Rabs (B distance) <= 9 / 8 * T1).
  { split; [clear - PR PO PD; lra|]. generalize (Rabs_pos (B a.(position_x))) (Rabs_pos (B a.(position_y))) (Rabs_pos (B a.(position_z))).
    unfold T1. clear - SP PVT PGTT PP PO PD. lra. }
  revert RT Uc Lower Ub Ua Lc L1 L2 L3 PT2 PG Tiny PY.
  generalize (centre_along 0 - (size_now 0 + B offset + B distance))
    (B x * (B a.(velocity_x) + B a.(plan_x) * T) + B y * (B a.(velocity_y) + B a.(plan_y) * T) +
      B z * (B a.(velocity_z) + B a.(plan_z) * T) - (B a.(growth_speed) + B a.(acceleration_limit) * T))
    (B x * B a.(plan_x) + B y * B a.(plan_y) + B z * B a.(plan_z) - B a.(acceleration_limit)).
  unfold to_spare.
  generalize (B wall_gap) (B wall_speed) (B wall_acceleration) (B a.(radius) + Rabs (B offset) + Rabs (B distance)) T1 T2 G L tiny (bpow radix2 (-975)). clear - Pe.
  intros c0 b0 a0 r T1 T2 G L t q c1 b1 a1 RT Uc Lower Ub Ua Lc L1 L2 L3 PT2 PG Tiny PY. rewrite few_value in L3.
  assert (c0 <= c1 - 100000000 * u * t - 6 * u * r) as C1 by (rewrite u_value in *; lra).
  assert (b0 * e <= (b1 + 20000 * u * L) * e) as B1 by (apply Rmult_le_compat_r; [exact Pe|]; rewrite u_value in *; lra).
  assert (0 <= e * e) as Pee by (apply Rmult_le_pos; exact Pe).
  assert (a0 * (e * e) <= (a1 - 25 * u * G) * (e * e)) as A1 by (apply Rmult_le_compat_r; assumption).
  assert (L * e <= L * (1 + e * e)) as E1.
  { apply Rmult_le_compat_l; [exact L1|]. generalize (Rle_0_sqr (e - / 2)). unfold Rsqr. lra. }
  assert (L * (e * e) <= / 1125899906842624 * G * (e * e)) as E2 by (apply Rmult_le_compat_r; assumption).
  assert (0 <= G * (e * e)) as E3 by (apply Rmult_le_pos; assumption).
  unfold quadratic. rewrite u_value in *. lra.
Qed.

End Parts.

(* At the time t the bound is beyond the plane and the distance, and by a little more, so that radius and distance may be sums
   that were rounded. *)
Definition beyond_wall (a : bound) (x y z offset distance : double) (t : R) : Prop :=
  (all_finite a /\ finite x /\ finite y /\ finite z /\ finite offset /\ finite distance) /\
  B offset + B distance + radius_at a t + to_spare a offset distance <
    B x * moved (B a.(position_x)) (B a.(velocity_x)) (B a.(plan_x)) (t - B a.(time)) +
    B y * moved (B a.(position_y)) (B a.(velocity_y)) (B a.(plan_y)) (t - B a.(time)) +
    B z * moved (B a.(position_z)) (B a.(velocity_z)) (B a.(plan_z)) (t - B a.(time)).

(* Until the answer, or until the end of the span, it is, in the direction that is given, whatever its length; unless the
   distance from the plane overflows. *)
Theorem wall_meeting_is_early (a : bound) (x y z offset from until distance : double) :
  sound a from -> Rabs (B x) <= 1 /\ Rabs (B y) <= 1 /\ Rabs (B z) <= 1 ->
  finite from -> finite until \/ until = infinity -> wall_gap a x y z offset from distance <> infinity ->
  certified (fun d => beyond_wall a x y z offset distance (B from + d)) from until
    (wall_meeting a x y z offset from until distance).
Proof.
  intros Sa Hn Ff Fu NI. rewrite wall_meeting_parts. cbv zeta.
  set (k := wall_gap a x y z offset from distance) in *. set (l := wall_speed a x y z from). set (q := wall_acceleration a x y z).
  assert (finite k -> finite l -> finite q -> bpow radix2 (-975) < B k -> forall d, 0 <= d -> 0 < quadratic (B k) (B l) (B q) d ->
    beyond_wall a x y z offset distance (B from + d)) as W.
  { intros Fk Fl Fq Lk d Hd Q. split; [exact (proj1 (wall_inputs_finite a x y z offset from distance Sa Fk))|].
    generalize (wall_quadratic_below a x y z offset from distance Sa Hn d Fk Fl Fq Lk Hd). fold k l q.
    unfold centre_along, size_now, radius_at. replace (B from + d - B a.(time)) with (B from - B a.(time) + d) by ring. lra. }
  assert (reached (fun d => beyond_wall a x y z offset distance (B from + d)) (first_crossing k l q)) as R.
  { destruct (first_crossing_is_early k l q) as [E|[(Fk & Fl & Fq & Lk & [[E H]|(Fr & Pr & H)])|(_ & Hk & _)]].
    - left. rewrite E, (proj2 literal_0). split; [exact (proj1 literal_0)|]. split; [lra|]. intros d Hd. lra.
    - right; left. split; [exact E|]. intros d Hd. apply W; auto.
    - left. split; [exact Fr|]. split; [lra|]. intros d Hd. apply W; auto. lra.
    - contradiction. }
  destruct (less until _) eqn:E; [eapply beyond|eapply ends]; eauto.
Qed.
