(* Two bounds along a direction, as pairs of points of capsules and hulls are certified: the motion of the one relative to the
   other, as a bound, and its certificate beside a half-space. Until the time that it returns the two are apart along the
   direction. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic sum_down first_crossing safe_steps errors.
From Kinesphere Require Import meeting_parts meeting_errors direction magnitudes meeting_facts meeting_margins meeting_coefficients
  upward earliest_meeting wall_meeting.
Open Scope R_scope.

Lemma less_zero (x : double) : finite x -> finite (x - literal 0 0)%float /\ B (x - literal 0 0)%float = B x.
Proof.
  intros F. generalize (Bminus_correct 53 1024 _ _ mode_NE x (literal 0 0) F (proj1 literal_0)).
  fold (sub x (literal 0 0)). rewrite (proj2 literal_0), Rminus_0_r.
  change (round radix2 (SpecFloat.fexp 53 1024) (round_mode mode_NE) (B x)) with (rnd64 (B x)). rewrite rnd_value.
  rewrite Rlt_bool_true by apply abs_B2R_lt_emax. intros (E & Fs & _). split; assumption.
Qed.

Local Opaque add sub mul div root neg magnitude widened capped B2R first_crossing.

(* A sum of which the last part is a margin. *)
Lemma raised (x m : double) (X Y : R) (c : Z) (T' T'' : R) :
  finite (x + m)%float -> close x X Y c -> (0 <= c <= 1000)%Z -> Rabs (B m - 64 * u * T') <= u * T' + T'' -> 0 <= T' -> 0 <= T'' ->
  X + 60 * u * T' - 12 * u * Y - 2 * T'' <= B (x + m)%float.
Proof.
  intros F C [c1 c2] HM PT PT'. destruct (add_finite _ _ F) as (Fx & Fm & E). destruct (C Fx) as [E1 E2].
  generalize (rnd_sum x m). rewrite <- E. clear E. intros R. change (roundoff (prec := 53)) with u in E1. apply IZR_le in c1, c2.
  assert (0 <= Y) as PY by (apply Rle_trans with (2 := E2); apply Rabs_pos).
  assert (IZR c * (u / 100) * Y <= 10 * u * Y) as E3 by (apply Rmult_le_compat_r; [exact PY|]; rewrite u_value; lra).
  assert (Rabs (B x + B m) <= Y * (11 / 10) + T' / 10 + 2 * T'') as E4.
  { apply Rabs_le_inv in E1. apply Rabs_le_inv in E2. apply Rabs_le_inv in HM. apply Rabs_le. rewrite u_value in *. lra. }
  assert (u * Rabs (B x + B m) <= u * (Y * (11 / 10) + T' / 10 + 2 * T'')) as E5
    by (apply Rmult_le_compat_l; [rewrite u_value; lra|exact E4]).
  apply Rabs_le_inv in R. apply Rabs_le_inv in E1. apply Rabs_le_inv in HM. rewrite u_value in *. lra.
Qed.

(* What the numbers may be off by is less than the margins and what is to spare. *)
Lemma margins_are_enough (d D' D sl r' rr e' e A' A growth pos' vel' gra' PX VX GX MP Mg MV Me MA OS VS AS LK t : R) :
  0 <= d -> 0 <= LK -> LK <= 2 * t -> LK <= few * AS -> 0 <= OS -> 0 <= VS -> 0 <= AS -> 0 <= MP -> 0 <= MV -> 0 <= MA -> 0 <= rr ->
  D' + (r' + e' * d + / 2 * A' * (d * d)) + (6 * u * (r' + Rabs D') + 1000000 * u * t) < pos' + vel' * d + / 2 * gra' * (d * d) ->
  pos' <= PX + 10 * u * MP -> vel' <= VX + 6 * u * MV -> gra' <= GX + u * MA ->
  growth + 60 * u * OS - 12 * u * Mg - 2 * (100 * u * t) <= sl -> MP + Mg <= 3 / 2 * OS + 200 * t ->
  e + 60 * u * VS - 12 * u * Me - 2 * (100 * u * LK) <= e' -> MV + Me <= 3 / 2 * VS + 200 * LK ->
  A + 60 * u * AS - 12 * u * A - 2 * 0 <= A' -> MA + A <= 9 / 8 * AS ->
  Rabs (D' - (D + sl)) <= u * Rabs (D + sl) -> Rabs (r' - rr) <= u * rr ->
  D + (growth + rr + e * d + / 2 * A * (d * d)) + 3 * u * rr < PX + VX * d + / 2 * GX * (d * d).
Proof.
  intros Pd PL L1 L2 PO PV PA PMP PMV PMA Prr L HP HV HG HS HM HE HM2 HA HM3 HD HR.
  assert (Pdd : 0 <= d * d) by (apply Rmult_le_pos; exact Pd).
  assert (Rabs (D' - (D + sl)) <= 2 * u * Rabs D') as HD'.
  { generalize (Rabs_pos D') (Rabs_triang (D' - (D + sl)) (- D')) (Rabs_Ropp D') (Rabs_Ropp (D + sl)) HD.
    replace (D' - (D + sl) + - D') with (- (D + sl)) by ring. clear. intros. rewrite u_value in *. lra. }
  apply Rabs_le_inv in HD', HR. clear HD.
  assert (V1 := Rmult_le_compat_r d _ _ Pd HV). assert (E1 := Rmult_le_compat_r d _ _ Pd HE).
  assert (M1 := Rmult_le_compat_r d _ _ Pd HM2). assert (G1 := Rmult_le_compat_r (d * d) _ _ Pdd HG).
  assert (A1 := Rmult_le_compat_r (d * d) _ _ Pdd HA). assert (M3 := Rmult_le_compat_r (d * d) _ _ Pdd HM3).
  assert (K1 : LK * d <= LK * (1 + d * d)).
  { apply Rmult_le_compat_l; [exact PL|]. generalize (Rle_0_sqr (d - / 2)). unfold Rsqr. clear. intros. lra. }
  assert (K2 := Rmult_le_compat_r (d * d) _ _ Pdd L2).
  generalize (Rmult_le_pos _ _ PV Pd) (Rmult_le_pos _ _ PMV Pd) (Rmult_le_pos _ _ PA Pdd) (Rmult_le_pos _ _ PMA Pdd) (Rmult_le_pos _ _ PL Pd).
  clear HV HE HM2 HG HA HM3 L2. intros P1 P2 P3 P4 P5. rewrite few_value, u_value in *. generalize (Rabs_pos D'). intros. lra.
Qed.

Section Beside.

Variables a b : bound.
Variable from : double.
Notation s := (elapsed_a a from).
Notation r := (elapsed_b b from).

Definition growth_then : double := growth_now a.(growth_speed) a.(acceleration_limit) s b.(growth_speed) b.(acceleration_limit) r.
Definition faster_then : double :=
  growth_speed_now a.(growth_speed) a.(acceleration_limit) s b.(growth_speed) b.(acceleration_limit) r.

Lemma beside_parts :
  beside a b from = {|
    time := from;
    position_x := centre_now a.(position_x) a.(velocity_x) a.(plan_x) s b.(position_x) b.(velocity_x) b.(plan_x) r;
    position_y := centre_now a.(position_y) a.(velocity_y) a.(plan_y) s b.(position_y) b.(velocity_y) b.(plan_y) r;
    position_z := centre_now a.(position_z) a.(velocity_z) a.(plan_z) s b.(position_z) b.(velocity_z) b.(plan_z) r;
    velocity_x := velocity_now a.(velocity_x) a.(plan_x) s b.(velocity_x) b.(plan_x) r;
    velocity_y := velocity_now a.(velocity_y) a.(plan_y) s b.(velocity_y) b.(plan_y) r;
    velocity_z := velocity_now a.(velocity_z) a.(plan_z) s b.(velocity_z) b.(plan_z) r;
    plan_x := (a.(plan_x) - b.(plan_x))%float;
    plan_y := (a.(plan_y) - b.(plan_y))%float;
    plan_z := (a.(plan_z) - b.(plan_z))%float;
    radius := ((a.(radius) + b.(radius)) - literal 0 0)%float;
    growth_speed := (faster_then + margin * velocity_size a b from)%float;
    acceleration_limit := ((a.(acceleration_limit) + b.(acceleration_limit)) + margin * acceleration_size a b)%float |} /\
  slack_beside a b from = (growth_then + margin * offset_size a b from)%float.
Proof. split; reflexivity. Qed.

Hypothesis sound_a : sound a from.
Hypothesis sound_b : sound b from.

Lemma not_below_zero (x : double) : upward x -> less x (literal 0 0) = false.
Proof.
  intros [N|[->|[F P]]]; [destruct x; try discriminate; reflexivity|reflexivity|].
  destruct (less x (literal 0 0)) eqn:L; [|reflexivity]. apply less_true in L; [|exact F|exact (proj1 literal_0)].
  rewrite (proj2 literal_0) in L. lra.
Qed.

Let us : upward s := upward_elapsed _ _ (proj2 (proj2 (proj2 sound_a))).
Let ur : upward r := upward_elapsed _ _ (proj2 (proj2 (proj2 sound_b))).
Let um : upward margin := upward_power (-47) ltac:(lia).

Ltac upwards :=
  lazymatch goal with
  | |- upward (add _ _) => apply upward_add; upwards
  | |- upward (mul _ _) => apply upward_mul; upwards
  | |- upward (widened _) => apply upward_widened; upwards
  | |- upward (capped _) => apply upward_capped; upwards
  | |- upward (magnitude _) => apply upward_magnitude
  | |- upward (radius _) => apply upward_not_less; first [apply sound_a|apply sound_b]
  | |- upward (growth_speed _) => apply upward_not_less; first [apply sound_a|apply sound_b]
  | |- upward (acceleration_limit _) => apply upward_not_less; first [apply sound_a|apply sound_b]
  | |- upward _ => first [exact us|exact ur|exact um]
  end.

Lemma sound_beside : finite from -> sound (beside a b from) from.
Proof.
  intros F. rewrite (proj1 beside_parts). unfold sound. cbn [radius growth_speed acceleration_limit time].
  split; [|split; [|split]].
  - apply not_below_zero. assert (upward (a.(radius) + b.(radius))%float) as [N|[->|[Fr Pr]]] by upwards.
    + left. destruct (a.(radius) + b.(radius))%float; try discriminate. reflexivity.
    + right; left. reflexivity.
    + right; right. destruct (less_zero _ Fr) as [Fs E]. rewrite E. split; assumption.
  - apply not_below_zero. unfold faster_then, growth_speed_now, velocity_size, velocity_size_a, velocity_size_b, speed_size, plan_size,
      sum_of_sizes. upwards.
  - apply not_below_zero. unfold acceleration_size, plan_size, sum_of_sizes. upwards.
  - destruct (less from from) eqn:L; [|reflexivity]. apply less_true in L; try exact F. lra.
Qed.

(* At the time t: the motion of the centres along the direction, and the sum of the radii. *)
Variables x y z distance : double.
Definition centres_along (t : R) : R :=
  B x * (moved (B a.(position_x)) (B a.(velocity_x)) (B a.(plan_x)) (t - B a.(time)) -
         moved (B b.(position_x)) (B b.(velocity_x)) (B b.(plan_x)) (t - B b.(time))) +
  B y * (moved (B a.(position_y)) (B a.(velocity_y)) (B a.(plan_y)) (t - B a.(time)) -
         moved (B b.(position_y)) (B b.(velocity_y)) (B b.(plan_y)) (t - B b.(time))) +
  B z * (moved (B a.(position_z)) (B a.(velocity_z)) (B a.(plan_z)) (t - B a.(time)) -
         moved (B b.(position_z)) (B b.(velocity_z)) (B b.(plan_z)) (t - B b.(time))).
Definition apart_along (t : R) : Prop :=
  (all_finite a /\ all_finite b /\ finite distance) /\
  B distance + radius_at a t + radius_at b t + 3 * u * (B a.(radius) + B b.(radius)) < centres_along t.

Hypothesis short : Rabs (B x) <= 1 /\ Rabs (B y) <= 1 /\ Rabs (B z) <= 1.

Notation S := (B from - B a.(time)).
Notation T := (B from - B b.(time)).
Notation G := (B (plan_size a)).
Notation V := (B (speed_size a)).
Notation P := (B (place_size a)).
Notation H := (B (plan_size b)).
Notation W := (B (speed_size b)).
Notation Q := (B (place_size b)).

(* A number n times one that is wrong by no more than e. *)
Lemma part_off (n v v' e : R) : Rabs n <= 1 -> Rabs (v - v') <= e -> n * v <= n * v' + e.
Proof.
  intros Hn Hv. assert (Rabs (n * (v - v')) <= e) as A.
  { rewrite Rabs_mult. apply Rle_trans with (1 * Rabs (v - v')); [apply Rmult_le_compat_r; [apply Rabs_pos|exact Hn]|lra]. }
  apply Rabs_le_inv in A. lra.
Qed.

Lemma beside_is_apart (t : R) : finite from -> B from <= t ->
  beyond_wall (beside a b from) x y z (literal 0 0) (distance + slack_beside a b from)%float t -> apart_along t.
Proof.
  intros Ff Ht [[All [_ [_ [_ [_ Fd]]]]] L]. revert All L. unfold radius_at, to_spare.
  destruct (add_finite _ _ Fd) as (Fdist & Fslack & Ed). revert Fslack Ed. rewrite (proj1 beside_parts), (proj2 beside_parts).
  unfold all_finite. cbn [time position_x position_y position_z velocity_x velocity_y velocity_z plan_x plan_y plan_z radius
    growth_speed acceleration_limit].
  rewrite (proj2 literal_0), Rabs_R0. intros Fslack Ed (_ & (Fpx & Fpy & Fpz) & (Fvx & Fvy & Fvz) & (Fgx & Fgy & Fgz) & (Fr & Fe & Fc)) L.
  (* All numbers are finite. *)
  destruct (add_finite _ _ Fslack) as (Fg & Fmo & Es). destruct (mul_finite _ _ Fmo) as (_ & Fo & _).
  destruct (add_finite _ _ Fe) as (Ff' & Fmv & Ee). destruct (mul_finite _ _ Fmv) as (_ & Fv & _).
  destruct (add_finite _ _ Fc) as (FA & Fma & Ec). destruct (mul_finite _ _ Fma) as (_ & Fa & _).
  unfold offset_size in Fo. destruct (capped_finite _ Fo) as (EO & Fo1 & _). fold (offset_size a b from) in EO.
  unfold velocity_size in Fv. destruct (capped_finite _ Fv) as (EV & Fv1 & _). fold (velocity_size a b from) in EV.
  unfold acceleration_size in Fa. destruct (capped_finite _ Fa) as (EA & Fa1 & LA). fold (acceleration_size a b) in EA.
  destruct (add_finite _ _ Fo1) as (Fo2 & Fo3 & _). destruct (add_finite _ _ Fo2) as (FP & Fo4 & _).
  destruct (add_finite _ _ Fo3) as (FQ & Fo5 & _). destruct (mul_finite _ _ Fo4) as (_ & Fs & _).
  destruct (mul_finite _ _ Fo5) as (_ & Fr' & _). destruct (add_finite _ _ Fv1) as (Fv2 & Fv3 & _).
  unfold velocity_size_a in Fv2. unfold velocity_size_b in Fv3.
  destruct (add_finite _ _ Fv2) as (FV & _). destruct (add_finite _ _ Fv3) as (FW & _).
  destruct (add_finite _ _ Fa1) as (FG & FH & EA').
  destruct (bound_sizes a from sound_a FG FV FP) as
    ((PP & PV & PG) & (PR & PE & PC) & (SP & SV & SG) & (L0 & (L1 & L2 & L3) & HLx & HLy & HLz & HL & HLs) &
     (M & (M1 & M2) & HMx & HMy & HMz & HMs)).
  destruct (bound_sizes b from sound_b FH FW FQ) as
    ((PQ & PW & PH) & (PR' & PE' & PC') & (SQ & SW & SH) & (K & (K1 & K2 & K3) & HKx & HKy & HKz & HK & HKs) &
     (N & (N1 & N2) & HNx & HNy & HNz & HNs)).
  destruct (elapsed_close from a.(time) ltac:(apply sound_a) Fs) as (_ & Ta & PS & Cs).
  destruct (elapsed_close from b.(time) ltac:(apply sound_b) Fr') as (_ & Tb & PT & Cr). fold s in Cs. fold r in Cr.
  assert (G <= bpow radix2 480 /\ H <= bpow radix2 480) as [LG LH].
  { rewrite EA' in LA. split; (eapply Rle_trans; [|exact LA]).
    - rewrite <- (rnd_value (plan_size a)) at 1. apply rnd_le. lra.
    - rewrite <- (rnd_value (plan_size b)) at 1. apply rnd_le. lra. }
  assert (PY := tiny_pos). assert (H2 := half_close). assert (H47 := margin_close).
  assert (LKp := Rplus_le_le_0_compat _ _ L1 K1).
  assert (HAm := zero_sum _ _ L0 K L1 K1 HLs HKs).
  generalize (close_positive _ PP) (close_positive _ PQ) (close_positive _ PV) (close_positive _ PW) (close_positive _ PG)
    (close_positive _ PH) (close_positive _ PE) (close_positive _ PE') (close_positive _ PC) (close_positive _ PC').
  intros CP CQ CV CW CG CH CE CE' CC CC'.
  set (SA := S) in *. set (TB := T) in *.
  assert (ZC := zero_product half _ _ HL). assert (ZC' := zero_product half _ _ HK).
  (* The sums of sizes, and the margins that are taken from them. *)
  set (OS := P + (V + G * SA) * SA + (Q + (W + H * TB) * TB)). set (VS := V + G * SA + (W + H * TB)). set (AS := G + H).
  assert (PGS : 0 <= G * SA) by (apply Rmult_le_pos; assumption). assert (PHT : 0 <= H * TB) by (apply Rmult_le_pos; assumption).
  assert (PVS : 0 <= V * SA) by (apply Rmult_le_pos; assumption). assert (PWT : 0 <= W * TB) by (apply Rmult_le_pos; assumption).
  assert (PGSS : 0 <= G * (SA * SA)) by (repeat apply Rmult_le_pos; assumption).
  assert (PHTT : 0 <= H * (TB * TB)) by (repeat apply Rmult_le_pos; assumption).
  assert (LT := loss_and_time L0 G SA L1 PS L2 L3). assert (KT := loss_and_time K H TB K1 PT K2 K3).
  assert (POS : 0 <= OS) by (unfold OS; clear - PP PQ PVS PWT PGSS PHTT; lra).
  assert (PVV : 0 <= VS) by (unfold VS; clear - PV PW PGS PHT; lra). assert (PAS := Rplus_le_le_0_compat _ _ PG PH).
  assert (Mo : Rabs (B (margin * offset_size a b from)%float - 64 * u * OS) <= u * OS + 100 * u * tiny).
  { assert (exists Y, close (margin * offset_size a b from)%float (64 * u * OS) Y 1000 /\ Y <= 64 * u * (2 * OS + 4 * tiny) + tiny)
      as (Y & C & HY).
    { rewrite EO. unfold velocity_size_a, velocity_size_b.
      eexists. split; [eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths]|].
      - unfold OS. ring.
      - unfold OS. clear - LT KT PP PQ PVS PWT PGSS PHTT PY. rewrite few_value in *. rewrite u_value. lra. }
    destruct (C Fmo) as [E _]. eapply Rle_trans; [exact E|]. change (roundoff (prec := 53)) with u. clear - HY POS PY.
    rewrite u_value in *. lra. }
  assert (HVa := zero_sum _ _ M L0 M1 L1 HMs (zero_product_l _ s L0 HLs)).
  assert (HVb := zero_sum _ _ N K N1 K1 HNs (zero_product_l _ r K HKs)).
  assert (PML := Rplus_le_le_0_compat _ _ M1 L1). assert (PNK := Rplus_le_le_0_compat _ _ N1 K1).
  assert (HVV := zero_sum _ _ _ _ PML PNK HVa HVb). assert (PMN := Rplus_le_le_0_compat _ _ PML PNK).
  assert (Mv : Rabs (B (margin * velocity_size a b from)%float - 64 * u * VS) <= u * VS + 100 * u * (L0 + K)).
  { assert (exists Y, close (margin * velocity_size a b from)%float (64 * u * VS) Y 1000 /\
      Y <= 64 * u * (VS + (L0 + K)) + (M + L0 + (N + K))) as (Y & C & HY).
    { rewrite EV. unfold velocity_size_a, velocity_size_b.
      eexists. split; [eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths]|].
      - unfold VS. ring.
      - unfold VS. clear. rewrite u_value. lra. }
    destruct (C Fmv) as [E _]. eapply Rle_trans; [exact E|]. change (roundoff (prec := 53)) with u. unfold VS in *.
    clear - HY M2 N2 L1 K1 PV PW PGS PHT. rewrite few_value, u_value in *. lra. }
  assert (Ma : Rabs (B (margin * acceleration_size a b)%float - 64 * u * AS) <= u * AS).
  { assert (close (margin * acceleration_size a b)%float (64 * u * AS) (64 * u * AS + (L0 + K)) 400) as C.
    { rewrite EA. eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths]. }
    destruct (C Fma) as [E _]. eapply Rle_trans; [exact E|]. change (roundoff (prec := 53)) with u. unfold AS.
    clear - L3 K3 PG PH. rewrite few_value, u_value in *. lra. }
  (* What the numbers of the bound are off by. *)
  assert (forall p v g q w h, (B g <> 0 -> tiny <= L0) -> (B h <> 0 -> tiny <= K) ->
    close (centre_now p v g s q w h r)
      (moved (B p) (B v) (B g) SA - moved (B q) (B w) (B h) TB)
      (into_place (Rabs (B p)) (Rabs (B v)) (Rabs (B g)) SA L0 + into_place (Rabs (B q)) (Rabs (B w)) (Rabs (B h)) TB K) 1000) as Cpos.
  { intros p v g q w h Hg Hh. unfold centre_now, into_place. eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths].
    unfold moved. field. }
  assert (forall v g w h, (B g <> 0 -> tiny <= L0) -> (B h <> 0 -> tiny <= K) ->
    close (velocity_now v g s w h r) ((B v + B g * SA) - (B w + B h * TB))
      (into_velocity (Rabs (B v)) (Rabs (B g)) SA L0 + into_velocity (Rabs (B w)) (Rabs (B h)) TB K) 600) as Cvel.
  { intros v g w h Hg Hh. unfold velocity_now, into_velocity. eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths]. }
  assert (close growth_then
    (moved 0 (B a.(growth_speed)) (B a.(acceleration_limit)) SA + moved 0 (B b.(growth_speed)) (B b.(acceleration_limit)) TB)
    (into_part (B a.(growth_speed)) (B a.(acceleration_limit)) SA L0 + into_part (B b.(growth_speed)) (B b.(acceleration_limit)) TB K)
    1000) as Cgrowth.
  { unfold growth_then, growth_now, into_part. eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths]. unfold moved. field. }
  assert (close faster_then
    ((B a.(growth_speed) + B a.(acceleration_limit) * SA) + (B b.(growth_speed) + B b.(acceleration_limit) * TB))
    (into_velocity (B a.(growth_speed)) (B a.(acceleration_limit)) SA L0 +
     into_velocity (B b.(growth_speed)) (B b.(acceleration_limit)) TB K) 600) as Cfaster.
  { unfold faster_then, growth_speed_now, into_velocity. eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths]. }
  assert (Sizes := conj PP (conj PV (conj PG (conj PQ (conj PW PH))))). assert (Times := conj PS (conj PT (Rle_refl 0))).
  assert (LossA := conj L1 (conj L2 L3)). assert (LossB := conj K1 (conj K2 K3)).
  assert (OfA := conj SP (conj SV SG)). assert (OfB := conj SQ (conj SW SH)).
  assert (Parts := conj (conj (Rabs_pos (B a.(position_x))) (conj (Rabs_pos (B a.(position_y))) (conj (Rabs_pos (B a.(position_z)))
       (conj (Rabs_pos (B a.(velocity_x))) (conj (Rabs_pos (B a.(velocity_y))) (conj (Rabs_pos (B a.(velocity_z)))
       (conj (Rabs_pos (B a.(plan_x))) (conj (Rabs_pos (B a.(plan_y))) (Rabs_pos (B a.(plan_z)))))))))))
     (conj (conj PR (conj PE PC))
     (conj (conj (Rabs_pos (B b.(position_x))) (conj (Rabs_pos (B b.(position_y))) (conj (Rabs_pos (B b.(position_z)))
       (conj (Rabs_pos (B b.(velocity_x))) (conj (Rabs_pos (B b.(velocity_y))) (conj (Rabs_pos (B b.(velocity_z)))
       (conj (Rabs_pos (B b.(plan_x))) (conj (Rabs_pos (B b.(plan_y))) (Rabs_pos (B b.(plan_z)))))))))))
     (conj PR' (conj PE' PC'))))).
  assert (MG := magnitudes_of_gap P V G SA L0 Q W H TB K 0 Sizes Times LossA LossB (conj LG LH)
    _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ Parts OfA OfB).
  assert (0 <= few * V + few * W + 2 * (L0 + K)) as LV.
  { assert (0 <= few) as PF by apply bpow_ge_0. generalize (Rmult_le_pos _ _ PF PV) (Rmult_le_pos _ _ PF PW) LKp.
    generalize (few * V) (few * W) (L0 + K). clear. intros. lra. }
  assert (MS := magnitudes_of_speed P V G SA L0 Q W H TB K 0 Sizes Times LossA LossB (conj LG LH)
    _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ Parts OfA OfB 0 LV).
  (* The numbers themselves. *)
  assert (Slack := raised _ _ _ _ 1000 OS (100 * u * tiny) Fslack Cgrowth ltac:(split; discriminate) Mo POS
    ltac:(clear - PY; rewrite u_value; lra)).
  assert (Faster := raised _ _ _ _ 600 VS (100 * u * (L0 + K)) Fe Cfaster ltac:(split; discriminate) Mv PVV
    ltac:(clear - LKp; rewrite u_value; lra)).
  assert (Acc := raised _ _ (B a.(acceleration_limit) + B b.(acceleration_limit)) (B a.(acceleration_limit) + B b.(acceleration_limit))
    200 AS 0 Fc ltac:(eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths]) ltac:(split; discriminate)
    ltac:(rewrite Rplus_0_r; exact Ma) PAS (Rle_refl 0)).
  destruct short as (Sx & Sy & Sz).
  assert (forall p v g q w h n, (B g <> 0 -> tiny <= L0) -> (B h <> 0 -> tiny <= K) -> Rabs n <= 1 ->
    finite (centre_now p v g s q w h r) ->
    n * B (centre_now p v g s q w h r) <= n * (moved (B p) (B v) (B g) SA - moved (B q) (B w) (B h) TB) +
      10 * u * (into_place (Rabs (B p)) (Rabs (B v)) (Rabs (B g)) SA L0 + into_place (Rabs (B q)) (Rabs (B w)) (Rabs (B h)) TB K)) as Pos.
  { intros p v g q w h n Hg Hh Hn F. apply part_off; [exact Hn|]. destruct (Cpos p v g q w h Hg Hh F) as [E _].
    eapply Rle_trans; [exact E|]. change (roundoff (prec := 53)) with u. apply Req_le. field. }
  assert (forall v g w h n, (B g <> 0 -> tiny <= L0) -> (B h <> 0 -> tiny <= K) -> Rabs n <= 1 ->
    finite (velocity_now v g s w h r) ->
    n * B (velocity_now v g s w h r) <= n * ((B v + B g * SA) - (B w + B h * TB)) +
      6 * u * (into_velocity (Rabs (B v)) (Rabs (B g)) SA L0 + into_velocity (Rabs (B w)) (Rabs (B h)) TB K)) as Vel.
  { intros v g w h n Hg Hh Hn F. apply part_off; [exact Hn|]. destruct (Cvel v g w h Hg Hh F) as [E _].
    eapply Rle_trans; [exact E|]. change (roundoff (prec := 53)) with u. apply Req_le. field. }
  assert (forall g h n, Rabs n <= 1 -> finite (g - h)%float ->
    n * B (g - h)%float <= n * (B g - B h) + u * (Rabs (B g) + Rabs (B h))) as Plan.
  { intros g h n Hn F. apply part_off; [exact Hn|]. destruct (sub_finite _ _ F) as (_ & _ & ->).
    apply Rle_trans with (1 := rnd_difference g h). apply Rmult_le_compat_l; [rewrite u_value; lra|].
    replace (B g - B h) with (B g + - B h) by ring. rewrite <- (Rabs_Ropp (B h)). apply Rabs_triang. }
  assert (forall X M : R, Rabs X <= M -> 0 <= M) as Above by (intros X M' Z; apply Rle_trans with (2 := Z), Rabs_pos).
  assert (PMP := Rplus_le_le_0_compat _ _ (Rplus_le_le_0_compat _ _ (Above _ _ (proj2 (Cpos _ _ _ _ _ _ HLx HKx Fpx)))
    (Above _ _ (proj2 (Cpos _ _ _ _ _ _ HLy HKy Fpy)))) (Above _ _ (proj2 (Cpos _ _ _ _ _ _ HLz HKz Fpz)))).
  assert (PMV := Rplus_le_le_0_compat _ _ (Rplus_le_le_0_compat _ _ (Above _ _ (proj2 (Cvel _ _ _ _ HLx HKx Fvx)))
    (Above _ _ (proj2 (Cvel _ _ _ _ HLy HKy Fvy)))) (Above _ _ (proj2 (Cvel _ _ _ _ HLz HKz Fvz)))).
  generalize (Pos _ _ _ _ _ _ _ HLx HKx Sx Fpx) (Pos _ _ _ _ _ _ _ HLy HKy Sy Fpy) (Pos _ _ _ _ _ _ _ HLz HKz Sz Fpz)
    (Vel _ _ _ _ _ HLx HKx Sx Fvx) (Vel _ _ _ _ _ HLy HKy Sy Fvy) (Vel _ _ _ _ _ HLz HKz Sz Fvz)
    (Plan _ _ _ Sx Fgx) (Plan _ _ _ Sy Fgy) (Plan _ _ _ Sz Fgz).
  clear Pos Vel Plan. intros Px Py Pz Vx Vy Vz Gx Gy Gz.
  destruct (sub_finite _ _ Fr) as (Frr & _). destruct (less_zero _ Frr) as [_ Er]. rewrite Er in L.
  destruct (add_finite _ _ Frr) as (_ & _ & Esum).
  split.
  { destruct (sum_of_sizes_finite _ _ _ _ FG), (sum_of_sizes_finite _ _ _ _ FV), (sum_of_sizes_finite _ _ _ _ FP),
      (sum_of_sizes_finite _ _ _ _ FH), (sum_of_sizes_finite _ _ _ _ FW), (sum_of_sizes_finite _ _ _ _ FQ).
    unfold all_finite. repeat (split || assumption || (match goal with X : _ /\ _ |- _ => destruct X end)). }
  set (d := t - B from) in *.
  assert (Pd : 0 <= d) by (unfold d; clear - Ht; lra).
  set (grown_then := moved 0 (B a.(growth_speed)) (B a.(acceleration_limit)) SA + moved 0 (B b.(growth_speed)) (B b.(acceleration_limit)) TB) in *.
  set (e := (B a.(growth_speed) + B a.(acceleration_limit) * SA) + (B b.(growth_speed) + B b.(acceleration_limit) * TB)) in *.
  set (A := B a.(acceleration_limit) + B b.(acceleration_limit)) in *.
  set (PX := B x * (moved (B a.(position_x)) (B a.(velocity_x)) (B a.(plan_x)) SA - moved (B b.(position_x)) (B b.(velocity_x)) (B b.(plan_x)) TB) +
     B y * (moved (B a.(position_y)) (B a.(velocity_y)) (B a.(plan_y)) SA - moved (B b.(position_y)) (B b.(velocity_y)) (B b.(plan_y)) TB) +
     B z * (moved (B a.(position_z)) (B a.(velocity_z)) (B a.(plan_z)) SA - moved (B b.(position_z)) (B b.(velocity_z)) (B b.(plan_z)) TB)) in *.
  set (VX := B x * ((B a.(velocity_x) + B a.(plan_x) * SA) - (B b.(velocity_x) + B b.(plan_x) * TB)) +
     B y * ((B a.(velocity_y) + B a.(plan_y) * SA) - (B b.(velocity_y) + B b.(plan_y) * TB)) +
     B z * ((B a.(velocity_z) + B a.(plan_z) * SA) - (B b.(velocity_z) + B b.(plan_z) * TB))) in *.
  set (GX := B x * (B a.(plan_x) - B b.(plan_x)) +
     B y * (B a.(plan_y) - B b.(plan_y)) +
     B z * (B a.(plan_z) - B b.(plan_z))) in *.
  set (MP := (into_place (Rabs (B a.(position_x))) (Rabs (B a.(velocity_x))) (Rabs (B a.(plan_x))) SA L0 +
       into_place (Rabs (B b.(position_x))) (Rabs (B b.(velocity_x))) (Rabs (B b.(plan_x))) TB K) +
     (into_place (Rabs (B a.(position_y))) (Rabs (B a.(velocity_y))) (Rabs (B a.(plan_y))) SA L0 +
       into_place (Rabs (B b.(position_y))) (Rabs (B b.(velocity_y))) (Rabs (B b.(plan_y))) TB K) +
     (into_place (Rabs (B a.(position_z))) (Rabs (B a.(velocity_z))) (Rabs (B a.(plan_z))) SA L0 +
       into_place (Rabs (B b.(position_z))) (Rabs (B b.(velocity_z))) (Rabs (B b.(plan_z))) TB K)) in *.
  set (MV := (into_velocity (Rabs (B a.(velocity_x))) (Rabs (B a.(plan_x))) SA L0 +
       into_velocity (Rabs (B b.(velocity_x))) (Rabs (B b.(plan_x))) TB K) +
     (into_velocity (Rabs (B a.(velocity_y))) (Rabs (B a.(plan_y))) SA L0 +
       into_velocity (Rabs (B b.(velocity_y))) (Rabs (B b.(plan_y))) TB K) +
     (into_velocity (Rabs (B a.(velocity_z))) (Rabs (B a.(plan_z))) SA L0 +
       into_velocity (Rabs (B b.(velocity_z))) (Rabs (B b.(plan_z))) TB K)) in *.
  set (MA := (Rabs (B a.(plan_x)) + Rabs (B b.(plan_x))) +
     (Rabs (B a.(plan_y)) + Rabs (B b.(plan_y))) +
     (Rabs (B a.(plan_z)) + Rabs (B b.(plan_z)))) in *.
  set (Mg := into_part (B a.(growth_speed)) (B a.(acceleration_limit)) SA L0 + into_part (B b.(growth_speed)) (B b.(acceleration_limit)) TB K) in *.
  set (Me := into_velocity (B a.(growth_speed)) (B a.(acceleration_limit)) SA L0 +
     into_velocity (B b.(growth_speed)) (B b.(acceleration_limit)) TB K) in *.
  replace (centres_along t) with (PX + VX * d + / 2 * GX * (d * d))
    by (unfold centres_along, PX, VX, GX, moved, SA, TB, d; field).
  match goal with |- ?l < _ => replace l with
    (B distance + (grown_then + (B a.(radius) + B b.(radius)) + e * d + / 2 * A * (d * d)) + 3 * u * (B a.(radius) + B b.(radius)))
    by (unfold radius_at, grown_then, e, A, moved, SA, TB, d; field) end.
  assert (L' : B (distance + (growth_then + margin * offset_size a b from))%float +
    (B (a.(radius) + b.(radius))%float + B (faster_then + margin * velocity_size a b from)%float * d +
      / 2 * B (a.(acceleration_limit) + b.(acceleration_limit) + margin * acceleration_size a b)%float * (d * d)) +
    (6 * u * (B (a.(radius) + b.(radius))%float + Rabs (B (distance + (growth_then + margin * offset_size a b from))%float)) +
      1000000 * u * tiny) <
    (B x * B (centre_now a.(position_x) a.(velocity_x) a.(plan_x) s b.(position_x) b.(velocity_x) b.(plan_x) r) +
     B y * B (centre_now a.(position_y) a.(velocity_y) a.(plan_y) s b.(position_y) b.(velocity_y) b.(plan_y) r) +
     B z * B (centre_now a.(position_z) a.(velocity_z) a.(plan_z) s b.(position_z) b.(velocity_z) b.(plan_z) r)) +
    (B x * B (velocity_now a.(velocity_x) a.(plan_x) s b.(velocity_x) b.(plan_x) r) +
     B y * B (velocity_now a.(velocity_y) a.(plan_y) s b.(velocity_y) b.(plan_y) r) +
     B z * B (velocity_now a.(velocity_z) a.(plan_z) s b.(velocity_z) b.(plan_z) r)) * d +
    / 2 * (B x * B (a.(plan_x) - b.(plan_x))%float + B y * B (a.(plan_y) - b.(plan_y))%float + B z * B (a.(plan_z) - b.(plan_z))%float) *
      (d * d)) by (clear - L; unfold moved in L; lra).
  eapply (margins_are_enough d _ (B distance) _ _ (B a.(radius) + B b.(radius)) _ e _ A grown_then _ _ _ PX VX GX MP Mg MV Me MA OS VS AS
    (L0 + K) tiny Pd LKp) with (10 := L').
  - clear - L2 K2. lra.
  - unfold AS. clear - L3 K3. rewrite Rmult_plus_distr_l. lra.
  - exact POS.
  - exact PVV.
  - exact PAS.
  - exact PMP.
  - exact PMV.
  - unfold MA. generalize (Rabs_pos (B a.(plan_x))) (Rabs_pos (B a.(plan_y))) (Rabs_pos (B a.(plan_z))) (Rabs_pos (B b.(plan_x)))
      (Rabs_pos (B b.(plan_y))) (Rabs_pos (B b.(plan_z))). clear. intros. lra.
  - clear - PR PR'. lra.
  - unfold PX, MP. clear - Px Py Pz. lra.
  - unfold VX, MV. clear - Vx Vy Vz. lra.
  - unfold GX, MA. clear - Gx Gy Gz. lra.
  - exact Slack.
  - unfold MP, Mg, OS. revert MG. unfold into_centre, into_growth, whole_length. clear - PR PR' PY. intros. lra.
  - exact Faster.
  - unfold MV, Me, VS. revert MS. unfold into_speed, whole_speed. clear - LKp. intros. lra.
  - exact Acc.
  - unfold MA, A, AS. clear - SG SH. lra.
  - rewrite Ed. exact (rnd_sum _ _).
  - rewrite Esum. generalize (rnd_sum a.(radius) b.(radius)). rewrite (Rabs_pos_eq (B a.(radius) + B b.(radius))) by (clear - PR PR'; lra).
    exact (fun Z => Z).
Qed.

(* Until the answer of the certificate of two bounds along a direction, as for pairs of points of capsules and hulls, or until
   the end of the span, the two are apart by more than the distance along it; unless the first coefficient overflows. *)
Theorem pair_meeting_is_early (until : double) :
  finite from -> finite until \/ until = infinity ->
  let motion := beside a b from in let farther := (distance + slack_beside a b from)%float in
  wall_gap motion x y z (literal 0 0) from farther <> infinity ->
  certified (fun d => apart_along (B from + d)) from until (wall_meeting motion x y z (literal 0 0) from until farther).
Proof.
  intros Ff Fu motion farther NI.
  destruct (wall_meeting_is_early motion x y z (literal 0 0) from until farther (sound_beside Ff) short Ff Fu NI) as [[E C]|(F & L & C)].
  - left. split; [exact E|]. intros t Ht Hu. apply beside_is_apart; [exact Ff|lra|]. exact (C t Ht Hu).
  - right. split; [exact F|]. split; [exact L|]. intros t Ht. apply beside_is_apart; [exact Ff|lra|]. exact (C t Ht).
Qed.

End Beside.
