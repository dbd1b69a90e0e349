(* Bodies with a constant angular velocity: the rotation that the library computes is the one that they make. The formulas
   are those of rigid_body.cpp, over the real numbers. *)
From Coq Require Import Reals Lra Psatz.
From Kinesphere Require Import geometry_vectors geometry_motion geometry_turning.
Open Scope R_scope.

Record quaternion : Type := Quaternion { scalar_of : R; vector_of : vector }.
Definition rotation_by (turn : vector) : quaternion :=
  let angle := norm turn in
  if Req_EM_T angle 0 then Quaternion 1 zero else Quaternion (cos (/ 2 * angle)) ((sin (/ 2 * angle) / angle) * turn).
Definition rotated (q : quaternion) (v : vector) : vector :=
  let twice := (2 * cross (vector_of q) v)%vector in (v + scalar_of q * twice + cross (vector_of q) twice)%vector.

(* The rotation `second` after `first`: the product of the two, brought to length 1. *)
Definition product (second first : quaternion) : quaternion :=
  Quaternion (scalar_of second * scalar_of first - dot (vector_of second) (vector_of first))
    (scalar_of second * vector_of first + scalar_of first * vector_of second + cross (vector_of second) (vector_of first)).
Definition square_of (q : quaternion) : R := scalar_of q * scalar_of q + dot (vector_of q) (vector_of q).
Definition after (second first : quaternion) : quaternion :=
  let p := product second first in let length := sqrt (square_of p) in
  Quaternion (scalar_of p / length) ((/ length) * vector_of p).

Lemma rotated_by_unit (q : quaternion) (v : vector) : square_of q = 1 ->
  rotated q v = ((scalar_of q * scalar_of q - dot (vector_of q) (vector_of q)) * v +
                 ((2 * dot (vector_of q) v) * vector_of q + (2 * scalar_of q) * cross (vector_of q) v))%vector.
Proof.
  unfold square_of, rotated. destruct q as [s u]. cbn [scalar_of vector_of]. intros E.
  replace (s * s - dot u u) with (1 - 2 * dot u u) by lra. destruct u, v. by_coordinates.
Qed.

Theorem after_turns_by_one_after_the_other (second first : quaternion) (v : vector) :
  square_of second = 1 -> square_of first = 1 ->
  square_of (after second first) = 1 /\ rotated (after second first) v = rotated second (rotated first v).
Proof.
  intros E2 E1.
  assert (square_of (product second first) = 1) as E.
  { replace (square_of (product second first)) with (square_of second * square_of first); [rewrite E2, E1; ring|].
    unfold square_of, product. destruct second as [s u], first as [t w]. cbn [scalar_of vector_of]. coordinates. ring. }
  assert (after second first = product second first) as ->.
  { unfold after. rewrite E, sqrt_1. destruct (product second first) as [s [x y z]]. cbn [scalar_of vector_of]. f_equal; [field|].
    coordinates. apply (f_equal3 Vector); field. }
  split; [exact E|]. rewrite (rotated_by_unit _ _ E), (rotated_by_unit _ _ E1), (rotated_by_unit _ _ E2).
  unfold product. destruct second as [s [x2 y2 z2]], first as [t [x1 y1 z1]], v as [x y z]. cbn [scalar_of vector_of].
  by_coordinates.
Qed.

(* Turned on for the time s with the angular velocity w. *)
Lemma rotation_in_time (w : vector) (s : R) : 0 < norm w -> 0 <= s ->
  rotation_by (s * w) = Quaternion (cos (norm w / 2 * s)) ((sin (norm w / 2 * s) / norm w) * w).
Proof.
  intros P Hs. unfold rotation_by. rewrite norm_times, (Rabs_pos_eq s Hs). destruct Req_EM_T as [Z|N].
  - assert (s = 0) as -> by nra. rewrite Rmult_0_r, cos_0, sin_0. f_equal. unfold Rdiv. by_coordinates.
  - replace (/ 2 * (s * norm w)) with (norm w / 2 * s) by field. f_equal. set (k := sin _).
    coordinates. apply (f_equal3 Vector); field; nra.
Qed.

Lemma derivative_of_combination (a b : R -> R) (a' b' t : R) (v x y : vector) :
  derivable_pt_lim a t a' -> derivable_pt_lim b t b' ->
  has_derivative (fun s => v + a s * x + b s * y)%vector t (a' * x + b' * y)%vector.
Proof.
  intros Da Db.
  assert (forall p q r : R, derivable_pt_lim (fun s => p + a s * q + b s * r) t (a' * q + b' * r)) as D.
  { intros p q r. apply (derivable_pt_lim_ext (fun s => p + q * a s + r * b s)); [intros; ring|].
    replace (a' * q + b' * r) with (0 + q * a' + r * b') by ring.
    apply (derivable_pt_lim_plus (fun s => p + q * a s) (fun s => r * b s)); [|apply (derivable_pt_lim_scal b); exact Db].
    apply (derivable_pt_lim_plus (fun _ => p) (fun s => q * a s)); [apply derivable_pt_lim_const|].
    apply (derivable_pt_lim_scal a). exact Da. }
  unfold has_derivative. coordinates. repeat split; apply D.
Qed.

(* Such a rotation turns each vector with that angular velocity. *)
Lemma rotation_turns (w v : vector) (t0 t1 : R) : 0 < norm w ->
  turns (fun _ => w) (fun t => rotated (Quaternion (cos (norm w / 2 * (t - t0))) ((sin (norm w / 2 * (t - t0)) / norm w) * w)) v) t0 t1.
Proof.
  intros P. set (k := fun t => sin (norm w / 2 * (t - t0)) / norm w). set (c := fun t => cos (norm w / 2 * (t - t0))).
  set (x := cross w v). set (y := cross w x).
  assert (forall t, rotated (Quaternion (c t) (k t * w)) v = v + (2 * (c t * k t)) * x + (2 * (k t * k t)) * y)%vector as E
    by (intros t; unfold rotated, y, x; cbn [scalar_of vector_of]; by_coordinates).
  assert (forall t, derivable_pt_lim k t (c t / 2)) as Dk.
  { intros t. unfold k, Rdiv at 1.
    apply (derivable_pt_lim_ext (fun s => / norm w * sin (norm w / 2 * (s - t0)))); [intros; ring|].
    replace (c t / 2) with (/ norm w * (c t * (norm w / 2))) by (field; lra).
    apply (derivable_pt_lim_scal (fun s => sin (norm w / 2 * (s - t0)))).
    apply (derivable_pt_lim_comp (fun s => norm w / 2 * (s - t0)) sin); [apply derivative_of_line|apply derivable_pt_lim_sin]. }
  assert (forall t, derivable_pt_lim c t (- (norm w * norm w) * k t / 2)) as Dc.
  { intros t. unfold k. replace (- (norm w * norm w) * (sin (norm w / 2 * (t - t0)) / norm w) / 2)
      with (- sin (norm w / 2 * (t - t0)) * (norm w / 2)) by (field; lra).
    apply (derivable_pt_lim_comp (fun s => norm w / 2 * (s - t0)) cos); [apply derivative_of_line|apply derivable_pt_lim_cos]. }
  assert (forall t, c t * c t + norm w * norm w * (k t * k t) = 1) as One.
  { intros t. unfold c, k. generalize (sin2_cos2 (norm w / 2 * (t - t0))). unfold Rsqr. intros H. rewrite <- H. field. lra. }
  assert (forall t, has_derivative (fun s => rotated (Quaternion (c s) (k s * w)) v) t (cross w (rotated (Quaternion (c t) (k t * w)) v))) as D.
  { intros t. rewrite E.
    replace (cross w (v + (2 * (c t * k t)) * x + (2 * (k t * k t)) * y))
      with ((2 * (- (norm w * norm w) * k t / 2 * k t + c t * (c t / 2))) * x + (2 * (c t / 2 * k t + k t * (c t / 2))) * y)%vector.
    - assert (has_derivative (fun s => v + (2 * (c s * k s)) * x + (2 * (k s * k s)) * y)%vector t
        ((2 * (- (norm w * norm w) * k t / 2 * k t + c t * (c t / 2))) * x + (2 * (c t / 2 * k t + k t * (c t / 2))) * y)%vector) as G.
      { apply (derivative_of_combination (fun s => 2 * (c s * k s)) (fun s => 2 * (k s * k s))).
        - apply (derivable_pt_lim_scal (fun s => c s * k s)), (derivable_pt_lim_mult c k); [apply Dc|apply Dk].
        - apply (derivable_pt_lim_scal (fun s => k s * k s)), (derivable_pt_lim_mult k k); apply Dk. }
      destruct G as (G1 & G2 & G3). unfold has_derivative.
      repeat split; [eapply derivable_pt_lim_ext; [|exact G1]|eapply derivable_pt_lim_ext; [|exact G2]|eapply derivable_pt_lim_ext; [|exact G3]];
        intros s; cbv beta; rewrite E; reflexivity.
    - generalize (One t). unfold y, x. rewrite norm_square. generalize (c t) (k t). clear. intros c k One.
      replace (cross w (v + (2 * (c * k)) * cross w v + (2 * (k * k)) * cross w (cross w v)))
        with ((1 - 2 * (dot w w * (k * k))) * cross w v + (2 * (c * k)) * cross w (cross w v))%vector by by_coordinates.
      replace 1 with (c * c + dot w w * (k * k)) at 1. coordinates. apply (f_equal3 Vector); field. }
  split; [|intros t _; apply D].
  apply continuous_where_derivable with (x' := fun t => cross w (rotated (Quaternion (c t) (k t * w)) v)). intros t _. apply D.
Qed.

(* While its angular velocity is constant, a body has turned by this rotation at the time t since t0. *)
Theorem constant_spin_turns_by_this_rotation (w arm : R -> vector) (t0 t1 t : R) :
  (forall s, t0 <= s <= t1 -> w s = w t0) -> turns w arm t0 t1 -> t0 <= t <= t1 ->
  arm t = rotated (rotation_by ((t - t0) * w t0)) (arm t0).
Proof.
  intros K T Ht.
  destruct (norm_positive (w t0)) as [P|Z].
  - rewrite rotation_in_time by lra.
    set (turned := fun s => rotated (Quaternion (cos (norm (w t0) / 2 * (s - t0))) ((sin (norm (w t0) / 2 * (s - t0)) / norm (w t0)) * w t0)) (arm t0)).
    change (arm t = turned t).
    assert (turns w turned t0 t1) as T'.
    { destruct (rotation_turns (w t0) (arm t0) t0 t1 P) as [C D]. split; [exact C|]. intros s Hs. rewrite K by lra. exact (D s Hs). }
    apply at_no_distance. rewrite (fixed_points_keep_their_distance w arm turned t0 t1 t T T' Ht).
    replace (turned t0) with (arm t0); [replace (arm t0 - arm t0)%vector with zero by by_coordinates; rewrite norm_zero; lra|].
    unfold turned. rewrite Rminus_diag_eq, Rmult_0_r, cos_0, sin_0 by reflexivity. unfold rotated, Rdiv. cbn [scalar_of vector_of].
    destruct (arm t0). by_coordinates.
  - assert (norm (arm t - arm t0) <= 0) as L.
    { generalize (arm_moves_no_farther w arm 0 t0 t1 t0 t T).
      intros H. apply Rle_trans with (0 * norm (arm t0) * (t - t0)); [apply H; try lra|lra].
      intros s Hs. rewrite K by exact Hs. lra. }
    rewrite (at_no_distance _ _ L). unfold rotation_by. rewrite norm_times, <- Z, Rmult_0_r. destruct Req_EM_T; [|contradiction].
    unfold rotated. cbn [scalar_of vector_of]. destruct (arm t0). by_coordinates.
Qed.
