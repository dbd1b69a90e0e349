(* The margins of the three coefficients, and a coefficient that is lowered by one. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic first_crossing errors.
From Kinesphere Require Import meeting_parts meeting_errors direction magnitudes meeting_facts.
Open Scope R_scope.
Local Opaque add sub mul div root neg magnitude widened capped B2R.

Section Coefficients.

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

Let loss_a := known_loss_a _ _ _ _ _ _ _ _ facts.
Let loss_b := known_loss_b _ _ _ _ _ _ _ _ facts.
Let L_pos : 0 <= L := proj1 loss_a.
Let K_pos : 0 <= K := proj1 loss_b.
Let LK_pos : 0 <= L + K := Rplus_le_le_0_compat _ _ L_pos K_pos.
Let H2 := half_close.
Let H47 := margin_close.
Let Cd : close d D D 0 := close_positive d d_pos.
Let Cs : close s S S 100 := known_s _ _ _ _ _ _ _ _ facts.
Let Cr : close r T T 100 := known_r _ _ _ _ _ _ _ _ facts.

(* The sums from which the margins are taken. *)
Notation length_sum := (whole_length P V G S Q W H T D).
Notation speed_sum := (whole_speed V G S W H T D).
Notation acceleration_sum := (whole_acceleration G H).

Ltac fact := first
  [ exact (known_sizes _ _ _ _ _ _ _ _ facts) | exact (known_times _ _ _ _ _ _ _ _ facts) | exact loss_a | exact loss_b
  | exact (known_plans _ _ _ _ _ _ _ _ facts) | exact (known_a _ _ _ _ _ _ _ _ facts) | exact (known_b _ _ _ _ _ _ _ _ facts) ].

Lemma sums_pos : 0 <= acceleration_sum /\ 0 <= speed_sum /\ 0 <= length_sum.
Proof.
  apply whole_pos; fact.
Qed.

Lemma length_margin :
  finite (margin * (size_then a b from d + magnitude distance))%float ->
  Rabs (B (margin * (size_then a b from d + magnitude distance))%float - 64 * u * (length_sum + Rabs (B distance)))
    <= u * (length_sum + Rabs (B distance)) + 20 * u * tiny.
Proof.
  intros F.
  destruct (sizes_finite _ _ _ _ size_finite) as (_ & _ & _ & _ & _ & EA & EV & EO & _ & _).
  destruct (known_sizes _ _ _ _ _ _ _ _ facts) as (PP & PV & PG & PQ & PW & PH).
  destruct (known_plans_a _ _ _ _ _ _ _ _ facts) as (_ & _ & _ & _ & HL).
  destruct (known_plans_b _ _ _ _ _ _ _ _ facts) as (_ & _ & _ & _ & HK).
  assert (HA := zero_sum _ _ L K L_pos K_pos HL HK).
  assert (HhA := zero_product half (plan_size a + plan_size b)%float (L + K) HA).
  generalize (close_positive _ PG) (close_positive _ PH) (close_positive _ PV) (close_positive _ PW)
    (close_positive _ PP) (close_positive _ PQ) (magnitude_close distance). intros CG CH CV CW CP CQ CD.
  assert (exists Y,
    close (margin * (size_then a b from d + magnitude distance))%float (64 * u * (length_sum + Rabs (B distance))) Y 1800 /\
    Y <= 64 * u * (2 * length_sum + 200 * tiny + Rabs (B distance)) + tiny) as (Y & C & HY).
  { unfold size_then. rewrite EO, EV, EA. unfold velocity_size_a, velocity_size_b.
    eexists. split; [eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths]|].
    - unfold whole_length. ring.
    - apply Rplus_le_compat_r. apply Rmult_le_compat_l; [rewrite u_value; lra|]. apply Rplus_le_compat_r.
      apply magnitudes_of_size; fact. }
  destruct (C F) as [E _]. eapply Rle_trans; [exact E|].
  change (roundoff (prec := 53)) with u.
  revert HY. generalize (Rabs_pos (B distance)) (proj2 (proj2 sums_pos)) tiny_pos.
  generalize (Rabs (B distance)) length_sum tiny. clear. intros. rewrite u_value in *. lra.
Qed.

Definition speed_loss : R := ((M + L) + (N + K)) + (L + K).

Lemma speed_loss_small : 0 <= speed_loss <= few * V + few * W + 2 * (L + K).
Proof.
  destruct (known_loss_of_speeds _ _ _ _ _ _ _ _ facts) as [[M1 M2] [N1 N2]].
  generalize L_pos K_pos M1 M2 N1 N2. unfold speed_loss. generalize (few * V) (few * W). clear. intros. lra.
Qed.

Lemma speed_margin :
  finite (margin * (velocity_size a b from + acceleration_size a b * d))%float ->
  Rabs (B (margin * (velocity_size a b from + acceleration_size a b * d))%float - 64 * u * speed_sum)
    <= u * speed_sum + 50 * u * (L + K).
Proof.
  intros F.
  destruct (sizes_finite _ _ _ _ size_finite) as (_ & _ & _ & _ & _ & EA & EV & EO & _ & _).
  destruct (known_sizes _ _ _ _ _ _ _ _ facts) as (PP & PV & PG & PQ & PW & PH).
  destruct (known_plans_a _ _ _ _ _ _ _ _ facts) as (_ & _ & _ & _ & HL).
  destruct (known_plans_b _ _ _ _ _ _ _ _ facts) as (_ & _ & _ & _ & HK).
  destruct (known_speeds_a _ _ _ _ _ _ _ _ facts) as (_ & _ & _ & HM).
  destruct (known_speeds_b _ _ _ _ _ _ _ _ facts) as (_ & _ & _ & HN).
  destruct (known_loss_of_speeds _ _ _ _ _ _ _ _ facts) as [[PM _] [PN _]].
  assert (HA := zero_sum _ _ L K L_pos K_pos HL HK).
  assert (HVa := zero_sum _ _ M L PM L_pos HM (zero_product_l _ s L HL)).
  assert (HVb := zero_sum _ _ N K PN K_pos HN (zero_product_l _ r K HK)).
  assert (HV := zero_sum _ _ _ _ (Rplus_le_le_0_compat _ _ PM L_pos) (Rplus_le_le_0_compat _ _ PN K_pos) HVa HVb).
  assert (HVA := zero_sum _ _ _ _ (Rplus_le_le_0_compat _ _ (Rplus_le_le_0_compat _ _ PM L_pos) (Rplus_le_le_0_compat _ _ PN K_pos))
    LK_pos HV (zero_product_l _ d _ HA)).
  fold speed_loss in HVA. assert (PLV := proj1 speed_loss_small).
  generalize (close_positive _ PG) (close_positive _ PH) (close_positive _ PV) (close_positive _ PW). intros CG CH CV CW.
  assert (exists Y,
    close (margin * (velocity_size a b from + acceleration_size a b * d))%float (64 * u * speed_sum) Y 1000 /\
    Y <= 64 * u * (speed_sum + 4 * (L + K)) + speed_loss) as (Y & C & HY).
  { rewrite EV, EA. unfold velocity_size_a, velocity_size_b.
    eexists. split; [eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths]|].
    - unfold whole_speed. ring.
    - apply Rplus_le_compat_r. apply Rmult_le_compat_l; [rewrite u_value; lra|].
      unfold whole_speed. generalize L_pos K_pos. clear. intros. lra. }
  destruct (C F) as [E _]. eapply Rle_trans; [exact E|].
  change (roundoff (prec := 53)) with u.
  assert (few * V + few * W <= few * speed_sum) as FW.
  { rewrite <- Rmult_plus_distr_l. apply Rmult_le_compat_l; [apply bpow_ge_0|].
    destruct (known_times _ _ _ _ _ _ _ _ facts) as (PS & PT & PD).
    assert (0 <= G * S /\ 0 <= H * T /\ 0 <= (G + H) * D) as (Q1 & Q2 & Q3)
      by (repeat split; apply Rmult_le_pos; lra || (apply Rplus_le_le_0_compat; assumption) || assumption).
    unfold whole_speed. revert Q1 Q2 Q3. generalize (G * S) (H * T) ((G + H) * D). clear. intros. lra. }
  revert HY FW. generalize LK_pos (proj2 speed_loss_small) (proj1 (proj2 sums_pos)).
  generalize (few * V) (few * W) speed_loss speed_sum (L + K). rewrite few_value. clear. intros. rewrite u_value in *. lra.
Qed.

Lemma acceleration_margin :
  finite (margin * acceleration_size a b)%float ->
  Rabs (B (margin * acceleration_size a b)%float - 64 * u * acceleration_sum) <= u * acceleration_sum.
Proof.
  intros F.
  destruct (sizes_finite _ _ _ _ size_finite) as (_ & _ & _ & _ & _ & EA & EV & EO & _ & _).
  destruct (known_sizes _ _ _ _ _ _ _ _ facts) as (PP & PV & PG & PQ & PW & PH).
  destruct (known_plans_a _ _ _ _ _ _ _ _ facts) as (_ & _ & _ & _ & HL).
  destruct (known_plans_b _ _ _ _ _ _ _ _ facts) as (_ & _ & _ & _ & HK).
  assert (HA := zero_sum _ _ L K L_pos K_pos HL HK).
  generalize (close_positive _ PG) (close_positive _ PH). intros CG CH.
  assert (close (margin * acceleration_size a b)%float (64 * u * acceleration_sum)
    (64 * u * acceleration_sum + (L + K)) 400) as C.
  { rewrite EA. eapply close_as; [find_close| |intros _; apply Rle_refl|hundredths]. reflexivity. }
  destruct (C F) as [E _]. eapply Rle_trans; [exact E|].
  change (roundoff (prec := 53)) with u.
  generalize (proj2 (proj2 loss_a)) (proj2 (proj2 loss_b)). intros L3 K3. unfold whole_acceleration.
  generalize L3 K3 PG PH. rewrite few_value. generalize G H. clear. intros.
  rewrite u_value in *. lra.
Qed.

(* A difference of which the last part is a margin. *)
Lemma lowered (x m : double) (X Y : R) (c : Z) (T' T'' : R) :
  finite (x - m)%float -> close x X Y c -> (0 <= c <= 2000)%Z ->
  Rabs (B m - 64 * u * T') <= u * T' + T'' -> Y <= 3 / 2 * T' + T'' / (20 * u) -> 0 <= T' -> 0 <= T'' ->
  B (x - m)%float <= X - 25 * u * T' + 5 * T'' /\ B (x - m)%float <= 2 * T' + T'' / (4 * u).
Proof.
  intros F C [c1 c2] HM HY PT PT'. destruct (sub_finite _ _ F) as (Fx & Fm & E).
  destruct (C Fx) as [E1 E2]. generalize (rnd_difference x m). rewrite <- E. clear E. intros R.
  change (roundoff (prec := 53)) with u in E1. apply IZR_le in c1, c2.
  assert (0 <= Y) as PY by (apply Rle_trans with (2 := E2); apply Rabs_pos).
  assert (IZR c * (u / 100) * Y <= 20 * u * Y) as E3.
  { apply Rmult_le_compat_r; [exact PY|]. rewrite u_value. lra. }
  assert (Rabs (B x - B m) <= Y * (11 / 10) + T' / 10 + T'') as E4.
  { eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp.
    replace (B x) with ((B x - X) + X) by ring. replace (B m) with ((B m - 64 * u * T') + 64 * u * T') by ring.
    eapply Rle_trans; [apply Rplus_le_compat; apply Rabs_triang|].
    rewrite (Rabs_pos_eq (64 * u * T')) by (rewrite u_value; lra). rewrite u_value in *. lra. }
  assert (u * Rabs (B x - B m) <= u * (Y * (11 / 10) + T' / 10 + T'')) as E5
    by (apply Rmult_le_compat_l; [rewrite u_value; lra|exact E4]).
  apply Rabs_le_inv in R. apply Rabs_le_inv in E1. apply Rabs_le_inv in E2. apply Rabs_le_inv in HM.
  rewrite u_value in *. split; lra.
Qed.

End Coefficients.
