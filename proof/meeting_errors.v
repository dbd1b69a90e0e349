(* Error bounds of the parts of the step. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite quadratic first_crossing errors.
From Kinesphere Require Import meeting_parts.
Open Scope R_scope.

Notation tiny := (least (emax := 1024)).

Lemma tiny_pos : 0 < tiny.
Proof. apply least_pos. Qed.
Lemma lost_tiny : lost = u * tiny.
Proof. unfold lost, u, least. rewrite <- bpow_plus. reflexivity. Qed.

(* The magnitudes that go into them. V and G are those of a velocity and a plan, s the time since the
   report, L what a product with the plan loses to underflow. *)
Definition into_place (P V G s L : R) : R := P + ((V + (G * (/ 2 * s + tiny) + L)) * s + tiny).
Definition into_velocity (V G s L : R) : R := V + (G * s + L).
Definition into_centre (P V G s L Q W H r K D : R) : R :=
  (into_place P V G s L + into_place Q W H r K)
  + ((into_velocity V G s L + into_velocity W H r K + ((G + H) * (/ 2 * D + tiny) + (L + K))) * D + tiny).
Definition into_speed (V G s L W H r K D : R) : R :=
  into_velocity V G s L + into_velocity W H r K + ((G + H) * D + (L + K)).
Definition into_part (E C s L : R) : R := (E + ((/ 2 * C + L) * s + L)) * s + tiny.
Definition into_growth (E C s L F M r K D : R) : R :=
  (into_part E C s L + into_part F M r K)
  + ((into_velocity E C s L + into_velocity F M r K + ((/ 2 * (C + M) + (L + K)) * D + (L + K))) * D + tiny).

Lemma zero_sum (x y : double) (L K : R) : 0 <= L -> 0 <= K ->
  (B x <> 0 -> tiny <= L) -> (B y <> 0 -> tiny <= K) -> B (x + y)%float <> 0 -> tiny <= L + K.
Proof.
  intros PL PK HL HK N. destruct (is_finite (x + y)%float) eqn:F.
  2: { destruct (x + y)%float; try discriminate; simpl in N; lra. }
  destruct (add_finite _ _ F) as (_ & _ & E). rewrite E in N.
  destruct (Req_dec (B x) 0) as [Zx|Nx]; [|specialize (HL Nx); lra].
  destruct (Req_dec (B y) 0) as [Zy|Ny]; [|specialize (HK Ny); lra].
  exfalso. apply N. rewrite Zx, Zy, Rplus_0_r. apply rnd_0.
Qed.
Lemma zero_difference (x y : double) (L K : R) : 0 <= L -> 0 <= K ->
  (B x <> 0 -> tiny <= L) -> (B y <> 0 -> tiny <= K) -> B (x - y)%float <> 0 -> tiny <= L + K.
Proof.
  intros PL PK HL HK N. destruct (is_finite (x - y)%float) eqn:F.
  2: { destruct (x - y)%float; try discriminate; simpl in N; lra. }
  destruct (sub_finite _ _ F) as (_ & _ & E). rewrite E in N.
  destruct (Req_dec (B x) 0) as [Zx|Nx]; [|specialize (HL Nx); lra].
  destruct (Req_dec (B y) 0) as [Zy|Ny]; [|specialize (HK Ny); lra].
  exfalso. apply N. rewrite Zx, Zy, Rminus_0_r. apply rnd_0.
Qed.
Lemma zero_product (x y : double) (L : R) : (B y <> 0 -> tiny <= L) -> B (x * y)%float <> 0 -> tiny <= L.
Proof.
  intros HL N. destruct (is_finite (x * y)%float) eqn:F.
  2: { destruct (x * y)%float; try discriminate; simpl in N; lra. }
  destruct (mul_finite _ _ F) as (_ & _ & E). rewrite E in N.
  apply HL. intros Z. apply N. rewrite Z, Rmult_0_r. apply rnd_0.
Qed.
Lemma zero_product_l (x y : double) (L : R) : (B x <> 0 -> tiny <= L) -> B (x * y)%float <> 0 -> tiny <= L.
Proof.
  intros HL N. destruct (is_finite (x * y)%float) eqn:F.
  2: { destruct (x * y)%float; try discriminate; simpl in N; lra. }
  destruct (mul_finite _ _ F) as (_ & _ & E). rewrite E in N.
  apply HL. intros Z. apply N. rewrite Z, Rmult_0_l. apply rnd_0.
Qed.

Section Close.

Variables s r d : double.
Variables S T D L K : R.
Hypothesis s_close : close s S S 100.
Hypothesis r_close : close r T T 100.
Hypothesis d_close : close d D D 0.
Hypothesis L_pos : 0 <= L.
Hypothesis K_pos : 0 <= K.

Let LK_pos : 0 <= L + K.
Proof. lra. Qed.
Let H2 := half_close.

Lemma centre_then_close (p v g q w h : double) :
  (B g <> 0 -> tiny <= L) -> (B h <> 0 -> tiny <= K) ->
  close (centre_then p v g s q w h r d)
    ((B p + (B v + B g * (/ 2 * S)) * S) - (B q + (B w + B h * (/ 2 * T)) * T)
     + (((B v + B g * S) - (B w + B h * T)) + (B g - B h) * (/ 2 * D)) * D)
    (into_centre (Rabs (B p)) (Rabs (B v)) (Rabs (B g)) S L (Rabs (B q)) (Rabs (B w)) (Rabs (B h)) T K D) 1000.
Proof.
  intros Hg Hh. assert (Hd := zero_difference g h L K L_pos K_pos Hg Hh).
  unfold centre_then, centre_now, velocity_now.
  eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths].
Qed.

Lemma velocity_then_close (v g w h : double) :
  (B g <> 0 -> tiny <= L) -> (B h <> 0 -> tiny <= K) ->
  close (velocity_then v g s w h r d)
    (((B v + B g * S) - (B w + B h * T)) + (B g - B h) * D)
    (into_speed (Rabs (B v)) (Rabs (B g)) S L (Rabs (B w)) (Rabs (B h)) T K D) 600.
Proof.
  intros Hg Hh. assert (Hd := zero_difference g h L K L_pos K_pos Hg Hh).
  unfold velocity_then, velocity_now.
  eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths].
Qed.

Lemma growth_then_close (e c f k : double) :
  (B c <> 0 -> tiny <= L) -> (B k <> 0 -> tiny <= K) ->
  close (growth_then e c s f k r d)
    ((B e + / 2 * B c * S) * S + (B f + / 2 * B k * T) * T
     + (((B e + B c * S) + (B f + B k * T)) + / 2 * (B c + B k) * D) * D)
    (into_growth (Rabs (B e)) (Rabs (B c)) S L (Rabs (B f)) (Rabs (B k)) T K D) 1100.
Proof.
  intros Hc Hk. assert (Hs := zero_sum c k L K L_pos K_pos Hc Hk).
  assert (Hhc := zero_product half c L Hc). assert (Hhk := zero_product half k K Hk).
  assert (Hhs := zero_product half (c + k)%float (L + K) Hs).
  unfold growth_then, growth_now, growth_speed_now.
  eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths].
Qed.

Lemma growth_speed_then_close (e c f k : double) :
  (B c <> 0 -> tiny <= L) -> (B k <> 0 -> tiny <= K) ->
  close (growth_speed_then e c s f k r d)
    (((B e + B c * S) + (B f + B k * T)) + (B c + B k) * D)
    (into_speed (Rabs (B e)) (Rabs (B c)) S L (Rabs (B f)) (Rabs (B k)) T K D) 600.
Proof.
  intros Hc Hk. assert (Hs := zero_sum c k L K L_pos K_pos Hc Hk).
  unfold growth_speed_then, growth_speed_now.
  eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths].
Qed.

End Close.
