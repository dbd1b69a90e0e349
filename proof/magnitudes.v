(* The magnitudes that go into a coefficient are not more than the sums from which its margin is taken, by much. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic first_crossing errors.
From Kinesphere Require Import meeting_parts meeting_errors direction.
Open Scope R_scope.

(* Inequalities over the reals. *)
Definition few : R := bpow radix2 (-50).

Lemma few_value : few = / 1125899906842624.
Proof. reflexivity. Qed.

(* L is what is lost, of which the plans G make up for the rest. *)
Lemma loss_and_time L G x : 0 <= L -> 0 <= x -> L <= tiny -> L <= few * G -> L * x <= tiny + few * (G * (x * x)).
Proof.
  intros PL Px LT LG. assert (0 <= x * x) by (apply Rmult_le_pos; lra).
  assert (L * (x * x) <= few * G * (x * x)) by (apply Rmult_le_compat_r; assumption).
  assert (0 <= L * (1 - x + x * x)) by (apply Rmult_le_pos; nra). lra.
Qed.

Lemma tiny_and_time G x : 0 <= G <= bpow radix2 480 -> 0 <= x -> G * tiny * x <= tiny + few * (G * (x * x)).
Proof.
  intros [PG LG] Px. generalize tiny_pos. intros PT.
  assert (0 < few) as PF by apply bpow_gt_0.
  destruct (Rle_or_lt (G * x) 1) as [S|S].
  - assert (G * x * tiny <= 1 * tiny) by (apply Rmult_le_compat_r; lra).
    assert (0 <= few * (G * (x * x))) by (repeat apply Rmult_le_pos; lra). lra.
  - assert (tiny <= few * x) as W.
    { assert (0 < x) by nra.
      assert (bpow radix2 (-480) <= x).
      { apply Rmult_le_reg_l with (bpow radix2 480); [apply bpow_gt_0|]. rewrite <- bpow_plus.
        simpl (bpow radix2 (480 + -480)).
        assert (G * x <= bpow radix2 480 * x) by (apply Rmult_le_compat_r; lra). lra. }
      apply Rle_trans with (few * bpow radix2 (-480)); [|apply Rmult_le_compat_l; lra].
      unfold few, least. rewrite <- bpow_plus. apply bpow_le. lia. }
    assert (0 <= G * x) by lra.
    assert (G * x * tiny <= G * x * (few * x)) by (apply Rmult_le_compat_l; assumption). lra.
Qed.

(* The sizes of the two bodies, the times since their reports, and the time of the step. *)
Section Magnitudes.

Variables P V G S L Q W H T K D : R.
Hypothesis sizes_pos : 0 <= P /\ 0 <= V /\ 0 <= G /\ 0 <= Q /\ 0 <= W /\ 0 <= H.
Hypothesis times_pos : 0 <= S /\ 0 <= T /\ 0 <= D.
Hypothesis loss_a : 0 <= L /\ L <= tiny /\ L <= few * G.
Hypothesis loss_b : 0 <= K /\ K <= tiny /\ K <= few * H.
Hypothesis plans : G <= bpow radix2 480 /\ H <= bpow radix2 480.

Definition whole_acceleration : R := G + H.
Definition whole_speed : R := V + G * S + (W + H * T) + (G + H) * D.
Definition whole_length : R :=
  P + (V + G * S) * S + (Q + (W + H * T) * T) + (V + G * S + (W + H * T) + / 2 * (G + H) * D) * D.

Lemma whole_pos : 0 <= whole_acceleration /\ 0 <= whole_speed /\ 0 <= whole_length.
Proof.
  destruct sizes_pos as (PP & PV & PG & PQ & PW & PH), times_pos as (PS & PT & PD).
  unfold whole_acceleration, whole_speed, whole_length.
  assert (0 <= G * S /\ 0 <= H * T /\ 0 <= G * D /\ 0 <= H * D /\ 0 <= V * S /\ 0 <= W * T /\ 0 <= V * D /\ 0 <= W * D)
    by (repeat split; apply Rmult_le_pos; assumption).
  assert (0 <= G * S * S /\ 0 <= H * T * T /\ 0 <= G * S * D /\ 0 <= H * T * D /\ 0 <= G * D * D /\ 0 <= H * D * D)
    by (repeat split; repeat apply Rmult_le_pos; assumption).
  lra.
Qed.

Ltac product H x := let A := fresh in assert (A := Rmult_le_compat_r x _ _ ltac:(tauto) H).

Lemma magnitudes_of_size :
  P + ((V + (G * S + L)) * S + tiny) + (Q + ((W + (H * T + K)) * T + tiny))
  + ((V + (G * S + L) + (W + (H * T + K)) + ((/ 2 * (G + H) + (L + K)) * D + (L + K))) * D + tiny)
  <= 2 * whole_length + 200 * tiny.
Proof.
  destruct times_pos as (PS & PT & PD), sizes_pos as (PP & PV & PG & PQ & PW & PH).
  destruct loss_a as (L1 & L2 & L3), loss_b as (K1 & K2 & K3). generalize tiny_pos. intros PY.
  assert (0 <= S * S /\ 0 <= T * T /\ 0 <= D * D) as Squares by (repeat split; apply Rmult_le_pos; assumption).
  product L3 (D * D). product K3 (D * D).
  generalize (loss_and_time L G S L1 PS L2 L3) (loss_and_time L G D L1 PD L2 L3).
  generalize (loss_and_time K H T K1 PT K2 K3) (loss_and_time K H D K1 PD K2 K3).
  assert (0 <= G * (S * S) /\ 0 <= H * (T * T) /\ 0 <= G * (D * D) /\ 0 <= H * (D * D) /\ 0 <= G * (S * D) /\ 0 <= H * (T * D))
    as NN by (repeat split; repeat apply Rmult_le_pos; assumption).
  assert (0 <= V * S /\ 0 <= V * D /\ 0 <= W * T /\ 0 <= W * D) as NN2 by (repeat split; apply Rmult_le_pos; assumption).
  unfold whole_length. rewrite few_value in *. intros. lra.
Qed.

Variables px py pz vx vy vz gx gy gz r e c : R.
Variables qx qy qz wx wy wz hx hy hz r' f k : R.
Hypothesis parts_pos : (0 <= px /\ 0 <= py /\ 0 <= pz /\ 0 <= vx /\ 0 <= vy /\ 0 <= vz /\ 0 <= gx /\ 0 <= gy /\ 0 <= gz)
  /\ (0 <= r /\ 0 <= e /\ 0 <= c)
  /\ (0 <= qx /\ 0 <= qy /\ 0 <= qz /\ 0 <= wx /\ 0 <= wy /\ 0 <= wz /\ 0 <= hx /\ 0 <= hy /\ 0 <= hz)
  /\ (0 <= r' /\ 0 <= f /\ 0 <= k).
Hypothesis of_a : px + py + pz + r <= 9 / 8 * P /\ vx + vy + vz + e <= 9 / 8 * V /\ gx + gy + gz + c <= 9 / 8 * G.
Hypothesis of_b : qx + qy + qz + r' <= 9 / 8 * Q /\ wx + wy + wz + f <= 9 / 8 * W /\ hx + hy + hz + k <= 9 / 8 * H.

Lemma magnitudes_of_gap :
  into_centre px vx gx S L qx wx hx T K D + into_centre py vy gy S L qy wy hy T K D
  + into_centre pz vz gz S L qz wz hz T K D + (r + r') + into_growth e c S L f k T K D
  <= 3 / 2 * whole_length + 200 * tiny.
Proof.
  destruct of_a as (A1 & A2 & A3), of_b as (B1 & B2 & B3), times_pos as (PS & PT & PD), sizes_pos as (PP & PV & PG & PQ & PW & PH).
  destruct loss_a as (L1 & L2 & L3), loss_b as (K1 & K2 & K3).
  destruct parts_pos as (X1 & X2 & X3 & X4).
  generalize tiny_pos. intros PY.
  assert (0 <= tiny) as PY' by lra.
  assert (0 <= S * S /\ 0 <= T * T /\ 0 <= S * D /\ 0 <= T * D /\ 0 <= D * D) as Squares by (repeat split; apply Rmult_le_pos; assumption).
  assert (0 <= tiny * S /\ 0 <= tiny * T /\ 0 <= tiny * D) as Tinys by (repeat split; apply Rmult_le_pos; assumption).
  product A2 S. product A2 D. product A3 (S * S). product A3 (S * D). product A3 (D * D). product A3 (tiny * S). product A3 (tiny * D).
  product B2 T. product B2 D. product B3 (T * T). product B3 (T * D). product B3 (D * D). product B3 (tiny * T). product B3 (tiny * D).
  product L3 (S * S). product L3 (D * D). product K3 (T * T). product K3 (D * D).
  generalize (loss_and_time L G S L1 PS L2 L3) (loss_and_time L G D L1 PD L2 L3).
  generalize (loss_and_time K H T K1 PT K2 K3) (loss_and_time K H D K1 PD K2 K3).
  generalize (tiny_and_time G S ltac:(tauto) PS) (tiny_and_time G D ltac:(tauto) PD).
  generalize (tiny_and_time H T ltac:(tauto) PT) (tiny_and_time H D ltac:(tauto) PD).
  assert (0 <= G * (S * S) /\ 0 <= H * (T * T) /\ 0 <= G * (D * D) /\ 0 <= H * (D * D) /\ 0 <= G * (S * D) /\ 0 <= H * (T * D))
    as NN by (repeat split; apply Rmult_le_pos; tauto).
  assert (0 <= V * S /\ 0 <= V * D /\ 0 <= W * T /\ 0 <= W * D) as NN2 by (repeat split; apply Rmult_le_pos; tauto).
  assert (0 <= c * (S * S) /\ 0 <= k * (T * T) /\ 0 <= c * (tiny * S) /\ 0 <= c * (tiny * D) /\ 0 <= k * (tiny * T) /\ 0 <= k * (tiny * D)
    /\ 0 <= e * S /\ 0 <= f * T)
    as NN3 by (repeat split; apply Rmult_le_pos; tauto).
  assert (0 <= (gx + gy + gz) * (S * S) /\ 0 <= (hx + hy + hz) * (T * T)) as NN4
    by (split; apply Rmult_le_pos; lra).
  unfold whole_length, into_growth, into_centre, into_part, into_place, into_velocity.
  rewrite few_value in *. intros. lra.
Qed.

Lemma magnitudes_of_speed (LV : R) :
  LV <= few * V + few * W + 2 * (L + K) ->
  into_speed vx gx S L wx hx T K D + LV + (into_speed vy gy S L wy hy T K D + LV)
  + (into_speed vz gz S L wz hz T K D + LV) + into_speed e c S L f k T K D
  <= 3 / 2 * whole_speed + 200 * (L + K).
Proof.
  intros HL.
  destruct of_a as (A1 & A2 & A3), of_b as (B1 & B2 & B3), times_pos as (PS & PT & PD), sizes_pos as (PP & PV & PG & PQ & PW & PH).
  destruct loss_a as (L1 & L2 & L3), loss_b as (K1 & K2 & K3).
  product A3 S. product A3 D. product B3 T. product B3 D.
  assert (0 <= G * S /\ 0 <= H * T /\ 0 <= G * D /\ 0 <= H * D) by (repeat split; apply Rmult_le_pos; tauto).
  unfold whole_speed, into_speed, into_velocity. rewrite few_value in *. lra.
Qed.

Lemma magnitudes_of_acceleration :
  gx + hx + (L + K) + (gy + hy + (L + K)) + (gz + hz + (L + K)) + (c + k) <= 3 / 2 * whole_acceleration.
Proof.
  destruct of_a as (A1 & A2 & A3), of_b as (B1 & B2 & B3), loss_a as (L1 & L2 & L3), loss_b as (K1 & K2 & K3).
  unfold whole_acceleration. rewrite few_value in *. lra.
Qed.

End Magnitudes.
