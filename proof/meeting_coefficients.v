(* Each coefficient is below the exact one, by enough. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic first_crossing errors.
From Kinesphere Require Import meeting_parts meeting_errors direction magnitudes meeting_facts.
From Kinesphere Require Import meeting_margins.
Open Scope R_scope.
Local Opaque add sub mul div root neg magnitude widened capped B2R.

(* A centre along one axis, or a radius, at a time after the report. *)
Definition moved (x v g t : R) : R := x + v * t + / 2 * g * (t * t).

(* The length of the computed difference of centres is near to how far the exact one goes in its direction. *)
Lemma length_along (x y z : double) (X Y Z M1 M2 M3 : R) :
  close x X M1 1000 -> close y Y M2 1000 -> close z Z M3 1000 ->
  finite (length_of x y z) -> less (literal 1 (-500)) (length_of x y z) = true ->
  exists n1 n2 n3, n1 * n1 + n2 * n2 + n3 * n3 <= 1 /\
    close (x / length_of x y z)%float n1 1 700 /\ close (y / length_of x y z)%float n2 1 700 /\
    close (z / length_of x y z)%float n3 1 700 /\
    close (length_of x y z) (n1 * X + n2 * Y + n3 * Z) (M1 + M2 + M3) 1600.
Proof.
  intros C1 C2 C3 F L.
  destruct (length_close x y z F L) as (Fx & Fy & Fz & LN & E).
  destruct (norm_square (B x) (B y) (B z)) as [EN PN].
  generalize (norm_at_most (B x) (B y) (B z)). intros UN.
  generalize (part_of_norm (B x) (B y) (B z)). intros P1.
  assert (Rabs (B y) <= norm (B x) (B y) (B z)) as P2.
  { replace (norm (B x) (B y) (B z)) with (norm (B y) (B x) (B z)) by (unfold norm; f_equal; ring). apply part_of_norm. }
  assert (Rabs (B z) <= norm (B x) (B y) (B z)) as P3.
  { replace (norm (B x) (B y) (B z)) with (norm (B z) (B y) (B x)) by (unfold norm; f_equal; ring). apply part_of_norm. }
  set (N := norm (B x) (B y) (B z)) in *.
  assert (0 < N) as PN' by (apply Rlt_le_trans with (2 := LN); apply bpow_gt_0).
  clear LN.
  assert (D1 := direction_close x _ N Fx P1 PN' E).
  assert (D2 := direction_close y _ N Fy P2 PN' E).
  assert (D3 := direction_close z _ N Fz P3 PN' E).
  exists (B x / N), (B y / N), (B z / N).
  assert (forall v, Rabs v <= N -> Rabs (v / N) <= 1) as One.
  { intros v Hv. unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ N)) by (apply Rlt_le, Rinv_0_lt_compat; exact PN').
    apply Rmult_le_reg_r with N; [exact PN'|]. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  assert (A1 := One _ P1). assert (A2 := One _ P2). assert (A3 := One _ P3). clear One.
  assert (B x / N * B x + B y / N * B y + B z / N * B z = N) as EL.
  { transitivity ((B x * B x + B y * B y + B z * B z) / N); [field; lra|]. rewrite <- EN. field. lra. }
  split.
  { right. transitivity ((B x * B x + B y * B y + B z * B z) / (N * N)); [field; lra|]. rewrite <- EN. field. lra. }
  do 3 (split; [assumption|]).
  intros _.
  destruct (C1 Fx) as [E1 U1], (C2 Fy) as [E2 U2], (C3 Fz) as [E3 U3].
  change (roundoff (prec := 53)) with u in *.
  assert (forall n v V' M, Rabs n <= 1 -> Rabs (v - V') <= 1000 * (u / 100) * M ->
    Rabs (n * v - n * V') <= 1000 * (u / 100) * M) as Part.
  { intros n v V' M Hn Hv. rewrite <- Rmult_minus_distr_l, Rabs_mult.
    generalize (Rabs_pos (v - V')) (Rabs_pos n). intros.
    apply Rle_trans with (1 * Rabs (v - V')); [apply Rmult_le_compat_r; lra|lra]. }
  assert (Q1 := Part _ _ _ _ A1 E1). assert (Q2 := Part _ _ _ _ A2 E2). assert (Q3 := Part _ _ _ _ A3 E3). clear Part.
  assert (forall v V' M, Rabs (v - V') <= 1000 * (u / 100) * M -> Rabs V' <= M -> Rabs v <= M * (101 / 100)) as Up.
  { intros v V' M H1 H2. replace v with ((v - V') + V') by ring. eapply Rle_trans; [apply Rabs_triang|].
    generalize (Rabs_pos V'). rewrite u_value in *. lra. }
  assert (W1 := Up _ _ _ E1 U1). assert (W2 := Up _ _ _ E2 U2). assert (W3 := Up _ _ _ E3 U3). clear Up.
  assert (N <= (M1 + M2 + M3) * (101 / 100)) as UN' by lra.
  assert (forall n V' M, Rabs n <= 1 -> Rabs V' <= M -> Rabs (n * V') <= M) as Small.
  { intros n V' M Hn HV. rewrite Rabs_mult. generalize (Rabs_pos V') (Rabs_pos n). intros.
    apply Rle_trans with (1 * Rabs V'); [apply Rmult_le_compat_r; lra|lra]. }
  assert (S1 := Small _ _ _ A1 U1). assert (S2 := Small _ _ _ A2 U2). assert (S3 := Small _ _ _ A3 U3). clear Small.
  set (n1 := B x / N) in *. set (n2 := B y / N) in *. set (n3 := B z / N) in *.
  apply Rabs_le_inv in E, Q1, Q2, Q3, S1, S2, S3.
  split; apply Rabs_le; rewrite u_value in *; lra.
Qed.

(* The coefficients along a direction. *)
Section Along.

Variables a b : bound.
Variables from distance d : double.
Hypothesis d_pos : 0 <= B d.

Notation s := (elapsed_a a from).
Notation r := (elapsed_b b from).
Notation S := (B from - B a.(time)).
Notation T := (B from - B b.(time)).
Notation D := (B d).
Notation G := (B (plan_size a)).
Notation V := (B (speed_size a)).
Notation P := (B (place_size a)).
Notation H := (B (plan_size b)).
Notation W := (B (speed_size b)).
Notation Q := (B (place_size b)).

Variables L K M N : R.
Hypothesis facts : known a b from d L K M N.
Hypothesis size_finite : finite (size_then a b from d).

Notation length_sum := (whole_length P V G S Q W H T D).
Notation speed_sum := (whole_speed V G S W H T D).
Notation acceleration_sum := (whole_acceleration G H).

Definition axis (p v g q w h t : R) : R := moved p v g (S + t) - moved q w h (T + t).
Definition axis_speed (v g w h t : R) : R := (v + g * (S + t)) - (w + h * (T + t)).
Definition radii (t : R) : R :=
  moved (B a.(radius)) (B a.(growth_speed)) (B a.(acceleration_limit)) (S + t)
  + moved (B b.(radius)) (B b.(growth_speed)) (B b.(acceleration_limit)) (T + t).
Definition radii_speed (t : R) : R :=
  (B a.(growth_speed) + B a.(acceleration_limit) * (S + t)) + (B b.(growth_speed) + B b.(acceleration_limit) * (T + t)).

Definition into (p v g q w h : double) : R :=
  into_centre (Rabs (B p)) (Rabs (B v)) (Rabs (B g)) S L (Rabs (B q)) (Rabs (B w)) (Rabs (B h)) T K D.
Definition into_speeds (v g w h : double) : R :=
  into_speed (Rabs (B v)) (Rabs (B g)) S L (Rabs (B w)) (Rabs (B h)) T K D.

Let loss_a := known_loss_a _ _ _ _ _ _ _ _ facts.
Let loss_b := known_loss_b _ _ _ _ _ _ _ _ facts.
Let L_pos : 0 <= L := proj1 loss_a.
Let K_pos : 0 <= K := proj1 loss_b.
Let LK_pos : 0 <= L + K := Rplus_le_le_0_compat _ _ L_pos K_pos.
Let Cd : close d D D 0 := close_positive d d_pos.
Let Cs : close s S S 100 := known_s _ _ _ _ _ _ _ _ facts.
Let Cr : close r T T 100 := known_r _ _ _ _ _ _ _ _ facts.

Lemma place_close (p v g q w h : double) :
  (B g <> 0 -> tiny <= L) -> (B h <> 0 -> tiny <= K) ->
  close (centre_then p v g s q w h r d) (axis (B p) (B v) (B g) (B q) (B w) (B h) D) (into p v g q w h) 1000.
Proof.
  intros Hg Hh. eapply close_as; [apply (centre_then_close s r d S T D L K Cs Cr Cd L_pos K_pos p v g q w h Hg Hh)
    | |intros _; apply Rle_refl|hundredths].
  unfold axis, moved. field.
Qed.

Lemma parts_positive :
  ((0 <= Rabs (B a.(position_x)) /\ 0 <= Rabs (B a.(position_y)) /\ 0 <= Rabs (B a.(position_z)) /\
    0 <= Rabs (B a.(velocity_x)) /\ 0 <= Rabs (B a.(velocity_y)) /\ 0 <= Rabs (B a.(velocity_z)) /\
    0 <= Rabs (B a.(plan_x)) /\ 0 <= Rabs (B a.(plan_y)) /\ 0 <= Rabs (B a.(plan_z)))
   /\ (0 <= B a.(radius) /\ 0 <= B a.(growth_speed) /\ 0 <= B a.(acceleration_limit))
   /\ (0 <= Rabs (B b.(position_x)) /\ 0 <= Rabs (B b.(position_y)) /\ 0 <= Rabs (B b.(position_z)) /\
    0 <= Rabs (B b.(velocity_x)) /\ 0 <= Rabs (B b.(velocity_y)) /\ 0 <= Rabs (B b.(velocity_z)) /\
    0 <= Rabs (B b.(plan_x)) /\ 0 <= Rabs (B b.(plan_y)) /\ 0 <= Rabs (B b.(plan_z)))
   /\ (0 <= B b.(radius) /\ 0 <= B b.(growth_speed) /\ 0 <= B b.(acceleration_limit))).
Proof.
  destruct (known_radii _ _ _ _ _ _ _ _ facts) as [RA RB].
  split; [repeat split; apply Rabs_pos|]. split; [exact RA|]. split; [repeat split; apply Rabs_pos|exact RB].
Qed.

Ltac fact := first
  [ exact (known_sizes _ _ _ _ _ _ _ _ facts) | exact (known_times _ _ _ _ _ _ _ _ facts) | exact loss_a | exact loss_b
  | exact (known_plans _ _ _ _ _ _ _ _ facts) | exact (known_a _ _ _ _ _ _ _ _ facts) | exact (known_b _ _ _ _ _ _ _ _ facts)
  | exact parts_positive ].

Definition into_places : R :=
  into a.(position_x) a.(velocity_x) a.(plan_x) b.(position_x) b.(velocity_x) b.(plan_x)
  + into a.(position_y) a.(velocity_y) a.(plan_y) b.(position_y) b.(velocity_y) b.(plan_y)
  + into a.(position_z) a.(velocity_z) a.(plan_z) b.(position_z) b.(velocity_z) b.(plan_z).

Lemma gap_below (l : double) (X : R) :
  close l X into_places 1600 -> finite (gap a b from distance d l) ->
  let T' := length_sum + Rabs (B distance) in
  B (gap a b from distance d l) <= X - (radii D + B distance) - 25 * u * T' + 20000 * u * tiny /\
  B (gap a b from distance d l) <= 2 * T' + 1000 * tiny.
Proof.
  intros C F T'. unfold gap in *.
  destruct (sub_finite _ _ F) as (_ & Fm & _).
  assert (HM := length_margin a b from distance d d_pos L K M N facts size_finite Fm).
  destruct (known_radii _ _ _ _ _ _ _ _ facts) as [(RA & EA & CA) (RB & EB & CB)].
  destruct (known_plans_a _ _ _ _ _ _ _ _ facts) as (_ & _ & _ & HL & _).
  destruct (known_plans_b _ _ _ _ _ _ _ _ facts) as (_ & _ & _ & HK & _).
  assert (CG := growth_then_close s r d S T D L K Cs Cr Cd L_pos K_pos
    a.(growth_speed) a.(acceleration_limit) b.(growth_speed) b.(acceleration_limit) HL HK).
  rewrite (Rabs_pos_eq _ EA), (Rabs_pos_eq _ EB), (Rabs_pos_eq _ CA), (Rabs_pos_eq _ CB) in CG.
  fold (growth a b from d) in CG.
  generalize (close_positive _ RA) (close_positive _ RB) (close_exact distance). intros CRA CRB CD.
  assert (CR : close (reach a b distance) (B a.(radius) + B b.(radius) + B distance)
    (B a.(radius) + B b.(radius) + Rabs (B distance)) 202)
    by (unfold reach; eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths]).
  assert (PT' : 0 <= T').
  { apply Rplus_le_le_0_compat; [|apply Rabs_pos]. apply (proj2 (proj2 (sums_pos a b from d L K M N facts))). }
  assert (PY := tiny_pos).
  assert (X1 := lowered (l - reach a b distance - growth a b from d)%float
    (margin * (size_then a b from d + magnitude distance))%float
    (X - (radii D + B distance))
    (into_places + (B a.(radius) + B b.(radius) + Rabs (B distance)) +
     into_growth (B a.(growth_speed)) (B a.(acceleration_limit)) S L (B b.(growth_speed)) (B b.(acceleration_limit)) T K D)
    1900 T' (4000 * u * tiny) F).
  destruct X1 as [X1 X2].
  - eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths].
    unfold radii, moved. field.
  - split; discriminate.
  - eapply Rle_trans; [exact HM|]. unfold T'. generalize (length_sum + Rabs (B distance)).
    revert PY. generalize tiny. clear. intros. rewrite u_value. lra.
  - replace (4000 * u * tiny / (20 * u)) with (200 * tiny) by (rewrite u_value; field).
    assert (MG : into_places + (B (radius a) + B (radius b)) +
       into_growth (B a.(growth_speed)) (B a.(acceleration_limit)) S L (B b.(growth_speed)) (B b.(acceleration_limit)) T K D
      <= 3 / 2 * length_sum + 200 * tiny) by (unfold into_places, into; eapply magnitudes_of_gap; fact).
    revert MG. unfold T'. generalize (Rabs_pos (B distance)).
    match goal with |- context [into_growth ?a ?b ?c ?d ?e ?f ?g ?h ?i] => generalize (into_growth a b c d e f g h i) end.
    generalize into_places (Rabs (B distance)) length_sum tiny (B (radius a)) (B (radius b)). clear. intros. lra.
  - exact PT'.
  - apply Rmult_le_pos; [rewrite u_value; lra|lra].
  - replace (4000 * u * tiny / (4 * u)) with (1000 * tiny) in X2 by (rewrite u_value; field).
    split; [|exact X2]. eapply Rle_trans; [exact X1|]. apply Req_le. ring.
Qed.

Lemma velocity_loss (v g w h : double) :
  (B v <> 0 -> tiny <= M) -> (B w <> 0 -> tiny <= N) -> (B g <> 0 -> tiny <= L) -> (B h <> 0 -> tiny <= K) ->
  B (velocity_then v g s w h r d) <> 0 -> tiny <= speed_loss L K M N.
Proof.
  intros Hv Hw Hg Hh.
  destruct (known_loss_of_speeds _ _ _ _ _ _ _ _ facts) as [[PM _] [PN _]].
  assert (HVa := zero_sum _ _ M L PM L_pos Hv (zero_product_l _ s L Hg)).
  assert (HVb := zero_sum _ _ N K PN K_pos Hw (zero_product_l _ r K Hh)).
  assert (HV := zero_difference _ _ _ _ (Rplus_le_le_0_compat _ _ PM L_pos) (Rplus_le_le_0_compat _ _ PN K_pos) HVa HVb).
  assert (HA := zero_difference _ _ L K L_pos K_pos Hg Hh).
  exact (zero_sum _ _ _ _ (Rplus_le_le_0_compat _ _ (Rplus_le_le_0_compat _ _ PM L_pos) (Rplus_le_le_0_compat _ _ PN K_pos))
    LK_pos HV (zero_product_l _ d _ HA)).
Qed.

Lemma speed_close (v g w h : double) :
  (B g <> 0 -> tiny <= L) -> (B h <> 0 -> tiny <= K) ->
  close (velocity_then v g s w h r d) (axis_speed (B v) (B g) (B w) (B h) D) (into_speeds v g w h) 600.
Proof.
  intros Hg Hh. eapply close_as; [apply (velocity_then_close s r d S T D L K Cs Cr Cd L_pos K_pos v g w h Hg Hh)
    | |intros _; apply Rle_refl|hundredths].
  unfold axis_speed. ring.
Qed.

Variables x y z : double.
Variables n1 n2 n3 : R.
Hypothesis x_close : close x n1 1 700.
Hypothesis y_close : close y n2 1 700.
Hypothesis z_close : close z n3 1 700.

Definition along_speed (t : R) : R :=
  n1 * axis_speed (B a.(velocity_x)) (B a.(plan_x)) (B b.(velocity_x)) (B b.(plan_x)) t
  + n2 * axis_speed (B a.(velocity_y)) (B a.(plan_y)) (B b.(velocity_y)) (B b.(plan_y)) t
  + n3 * axis_speed (B a.(velocity_z)) (B a.(plan_z)) (B b.(velocity_z)) (B b.(plan_z)) t.

Lemma speed_below :
  finite (speed a b from d x y z) ->
  B (speed a b from d x y z) <= along_speed D - radii_speed D - 25 * u * speed_sum + 20000 * u * (L + K).
Proof.
  intros F. unfold speed in *.
  destruct (sub_finite _ _ F) as (_ & Fm & _).
  assert (HM := speed_margin a b from d d_pos L K M N facts size_finite Fm).
  destruct (known_radii _ _ _ _ _ _ _ _ facts) as [(RA & EA & CA) (RB & EB & CB)].
  destruct (known_plans_a _ _ _ _ _ _ _ _ facts) as (HLx & HLy & HLz & HL & _).
  destruct (known_plans_b _ _ _ _ _ _ _ _ facts) as (HKx & HKy & HKz & HK & _).
  destruct (known_speeds_a _ _ _ _ _ _ _ _ facts) as (HMx & HMy & HMz & _).
  destruct (known_speeds_b _ _ _ _ _ _ _ _ facts) as (HNx & HNy & HNz & _).
  assert (CG := growth_speed_then_close s r d S T D L K Cs Cr Cd L_pos K_pos
    a.(growth_speed) a.(acceleration_limit) b.(growth_speed) b.(acceleration_limit) HL HK).
  rewrite (Rabs_pos_eq _ EA), (Rabs_pos_eq _ EB), (Rabs_pos_eq _ CA), (Rabs_pos_eq _ CB) in CG.
  fold (faster a b from d) in CG.
  assert (C1 := speed_close a.(velocity_x) _ b.(velocity_x) _ HLx HKx). assert (V1 := velocity_loss _ _ _ _ HMx HNx HLx HKx).
  assert (C2 := speed_close a.(velocity_y) _ b.(velocity_y) _ HLy HKy). assert (V2 := velocity_loss _ _ _ _ HMy HNy HLy HKy).
  assert (C3 := speed_close a.(velocity_z) _ b.(velocity_z) _ HLz HKz). assert (V3 := velocity_loss _ _ _ _ HMz HNz HLz HKz).
  fold (speed_x a b from d) in C1, V1. fold (speed_y a b from d) in C2, V2. fold (speed_z a b from d) in C3, V3.
  assert (PLV := proj1 (speed_loss_small a b from d L K M N facts)).
  assert (PT' : 0 <= speed_sum) by apply (proj1 (proj2 (sums_pos a b from d L K M N facts))).
  assert (X1 := lowered (dot x y z (speed_x a b from d) (speed_y a b from d) (speed_z a b from d) - faster a b from d)%float
    (margin * (velocity_size a b from + acceleration_size a b * d))%float
    (along_speed D - radii_speed D)
    (1 * into_speeds a.(velocity_x) a.(plan_x) b.(velocity_x) b.(plan_x) + speed_loss L K M N
     + (1 * into_speeds a.(velocity_y) a.(plan_y) b.(velocity_y) b.(plan_y) + speed_loss L K M N)
     + (1 * into_speeds a.(velocity_z) a.(plan_z) b.(velocity_z) b.(plan_z) + speed_loss L K M N)
     + into_speed (B a.(growth_speed)) (B a.(acceleration_limit)) S L (B b.(growth_speed)) (B b.(acceleration_limit)) T K D)
    1900 speed_sum (4000 * u * (L + K)) F).
  destruct X1 as [X1 _].
  - unfold dot. eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths].
    unfold along_speed, radii_speed. ring.
  - split; discriminate.
  - eapply Rle_trans; [exact HM|]. generalize LK_pos. generalize speed_sum (L + K). clear. intros. rewrite u_value. lra.
  - replace (4000 * u * (L + K) / (20 * u)) with (200 * (L + K)) by (rewrite u_value; field).
    rewrite !Rmult_1_l. unfold into_speeds. eapply magnitudes_of_speed; try fact.
    apply (speed_loss_small a b from d L K M N facts).
  - exact PT'.
  - apply Rmult_le_pos; [rewrite u_value; lra|exact LK_pos].
  - eapply Rle_trans; [exact X1|]. apply Req_le. ring.
Qed.

Definition along_acceleration : R :=
  n1 * (B a.(plan_x) - B b.(plan_x)) + n2 * (B a.(plan_y) - B b.(plan_y)) + n3 * (B a.(plan_z) - B b.(plan_z)).

Lemma acceleration_below :
  finite (acceleration a b x y z) ->
  B (acceleration a b x y z) <=
    along_acceleration - (B a.(acceleration_limit) + B b.(acceleration_limit)) - 25 * u * acceleration_sum.
Proof.
  intros F. unfold acceleration in *.
  destruct (sub_finite _ _ F) as (_ & Fm & _).
  assert (HM := acceleration_margin a b from d L K M N facts size_finite Fm).
  destruct (known_radii _ _ _ _ _ _ _ _ facts) as [(RA & EA & CA) (RB & EB & CB)].
  destruct (known_plans_a _ _ _ _ _ _ _ _ facts) as (HLx & HLy & HLz & HL & _).
  destruct (known_plans_b _ _ _ _ _ _ _ _ facts) as (HKx & HKy & HKz & HK & _).
  assert (V1 := zero_difference _ _ L K L_pos K_pos HLx HKx).
  assert (V2 := zero_difference _ _ L K L_pos K_pos HLy HKy).
  assert (V3 := zero_difference _ _ L K L_pos K_pos HLz HKz).
  generalize (close_positive _ CA) (close_positive _ CB). intros CCA CCB.
  assert (PT' : 0 <= acceleration_sum) by apply (proj1 (sums_pos a b from d L K M N facts)).
  assert (X1 := lowered (dot x y z (plan_x a - plan_x b)%float (plan_y a - plan_y b)%float (plan_z a - plan_z b)%float
      - (acceleration_limit a + acceleration_limit b))%float
    (margin * acceleration_size a b)%float
    (along_acceleration - (B a.(acceleration_limit) + B b.(acceleration_limit)))
    (1 * (Rabs (B a.(plan_x)) + Rabs (B b.(plan_x))) + (L + K) + (1 * (Rabs (B a.(plan_y)) + Rabs (B b.(plan_y))) + (L + K))
     + (1 * (Rabs (B a.(plan_z)) + Rabs (B b.(plan_z))) + (L + K)) + (B a.(acceleration_limit) + B b.(acceleration_limit)))
    1400 acceleration_sum 0 F).
  destruct X1 as [X1 _].
  - unfold dot. eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths].
  - split; discriminate.
  - rewrite Rplus_0_r. exact HM.
  - replace (0 / (20 * u)) with 0 by (rewrite u_value; field). rewrite !Rmult_1_l, Rplus_0_r.
    eapply magnitudes_of_acceleration; fact.
  - exact PT'.
  - apply Rle_refl.
  - eapply Rle_trans; [exact X1|]. apply Req_le. ring.
Qed.

Definition along (t : R) : R :=
  n1 * axis (B a.(position_x)) (B a.(velocity_x)) (B a.(plan_x)) (B b.(position_x)) (B b.(velocity_x)) (B b.(plan_x)) t
  + n2 * axis (B a.(position_y)) (B a.(velocity_y)) (B a.(plan_y)) (B b.(position_y)) (B b.(velocity_y)) (B b.(plan_y)) t
  + n3 * axis (B a.(position_z)) (B a.(velocity_z)) (B a.(plan_z)) (B b.(position_z)) (B b.(velocity_z)) (B b.(plan_z)) t.

(* With these coefficients the quadratic is below the gap along the direction. *)
Lemma quadratic_below (l : double) (e : R) :
  close l (along D) into_places 1600 ->
  finite (gap a b from distance d l) -> finite (speed a b from d x y z) -> finite (acceleration a b x y z) ->
  bpow radix2 (-975) < B (gap a b from distance d l) -> 0 <= e ->
  quadratic (B (gap a b from distance d l)) (B (speed a b from d x y z)) (B (acceleration a b x y z)) e
    <= along (D + e) - (radii (D + e) + B distance) - 3 * u * (B a.(radius) + B b.(radius)).
Proof.
  intros C Fc Fb Fa Lc Pe.
  assert (RT : 0 <= B a.(radius) + B b.(radius) <= 9 / 8 * (length_sum + Rabs (B distance))).
  { destruct parts_positive as (_ & (R1 & _) & _ & (R2 & _)). split; [lra|].
    destruct (known_a _ _ _ _ _ _ _ _ facts) as [A1 _]. destruct (known_b _ _ _ _ _ _ _ _ facts) as [B1 _].
    assert (P + Q <= length_sum).
    { destruct (known_sizes _ _ _ _ _ _ _ _ facts) as (? & ? & ? & ? & ? & ?).
      destruct (known_times _ _ _ _ _ _ _ _ facts) as (? & ? & ?). unfold whole_length.
      repeat match goal with |- context [?x * ?y] =>
        assert (0 <= x * y) by (repeat first [assumption | apply Rplus_le_le_0_compat | apply Rmult_le_pos | lra]);
        generalize dependent (x * y); intros end. lra. }
    generalize (Rabs_pos (B distance)) (Rabs_pos (B a.(position_x))) (Rabs_pos (B a.(position_y))) (Rabs_pos (B a.(position_z)))
      (Rabs_pos (B b.(position_x))) (Rabs_pos (B b.(position_y))) (Rabs_pos (B b.(position_z))). lra. }
  destruct (gap_below l _ C Fc) as [Uc Lower]. assert (Ub := speed_below Fb). assert (Ua := acceleration_below Fa).
  assert (quadratic (along D - (radii D + B distance)) (along_speed D - radii_speed D)
    (along_acceleration - (B a.(acceleration_limit) + B b.(acceleration_limit))) e
    = along (D + e) - (radii (D + e) + B distance)) as <-.
  { unfold quadratic, along, along_speed, along_acceleration, radii, radii_speed, axis, axis_speed, moved. field. }
  assert (tiny * 70368744177664 <= bpow radix2 (-975) * / 2) as Tiny.
  { unfold least. replace 70368744177664 with (bpow radix2 46) by reflexivity.
    change (/ 2) with (bpow radix2 (-1)). rewrite <- !bpow_plus. apply bpow_le. lia. }
  assert (PY := tiny_pos).
  assert (PS := proj1 (proj2 (sums_pos a b from d L K M N facts))).
  destruct (known_sizes _ _ _ _ _ _ _ _ facts) as (_ & _ & PG & _ & _ & PH).
  assert (LK1 : L + K <= 2 * tiny) by (generalize (proj1 (proj2 loss_a)) (proj1 (proj2 loss_b)); generalize tiny; clear; intros t I1 I2; lra).
  assert (LK2 : L + K <= few * acceleration_sum).
  { unfold whole_acceleration. generalize (proj2 (proj2 loss_a)) (proj2 (proj2 loss_b)). generalize G H few. clear.
    intros x1 x2 x3 I1 I2. lra. }
  assert (PA : 0 <= acceleration_sum) by (apply Rplus_le_le_0_compat; assumption).
  revert RT Uc Lower Ub Ua Lc LK1 LK2 PS PA Tiny PY. generalize LK_pos (B a.(radius) + B b.(radius)).
  generalize (along D - (radii D + B distance)) (along_speed D - radii_speed D)
    (along_acceleration - (B a.(acceleration_limit) + B b.(acceleration_limit))).
  generalize (B (gap a b from distance d l)) (B (speed a b from d x y z)) (B (acceleration a b x y z)).
  generalize (length_sum + Rabs (B distance)) speed_sum acceleration_sum (L + K) tiny (bpow radix2 (-975)).
  clear - Pe.
  intros T1 T2 T3 LK t q c0 b0 a0 c1 b1 a1 LKp radii' RT Uc Lower Ub Ua Lc LK1 LK2 PS PA Tiny PY.
  rewrite few_value in LK2.
  assert (c0 <= c1 - 100000000 * u * t - 3 * u * radii') as C1 by (rewrite u_value in *; lra).
  assert (b0 * e <= (b1 + 20000 * u * LK) * e) as B1.
  { apply Rmult_le_compat_r; [exact Pe|]. rewrite u_value in *. lra. }
  assert (0 <= e * e) as Pee by (apply Rmult_le_pos; exact Pe).
  assert (a0 * (e * e) <= (a1 - 25 * u * T3) * (e * e)) as A1 by (apply Rmult_le_compat_r; assumption).
  assert (LK * e <= LK * (1 + e * e)) as E1.
  { apply Rmult_le_compat_l; [exact LKp|]. generalize (Rle_0_sqr (e - / 2)). unfold Rsqr. lra. }
  assert (LK * (e * e) <= / 1125899906842624 * T3 * (e * e)) as E2 by (apply Rmult_le_compat_r; assumption).
  assert (0 <= T3 * (e * e)) as E3 by (apply Rmult_le_pos; assumption).
  unfold quadratic. rewrite u_value in *. lra.
Qed.

End Along.
