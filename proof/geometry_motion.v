(* Paths in space, and the mean value inequality: a path never faster than some speed gets no farther. *)
From Coq Require Import Reals Ranalysis Lra Psatz List.
From Kinesphere Require Import geometry_vectors.
Open Scope R_scope.

(* The path x has no jump from the time a to the time b; at these two it is taken from within. *)
Definition continuous_during (a b : R) (x : R -> vector) : Prop :=
  forall t e, a <= t <= b -> 0 < e ->
  exists d, 0 < d /\ forall s, a <= s <= b -> Rabs (s - t) < d -> norm (x s - x t) < e.

(* v is the derivative of the path x at the time t, coordinate by coordinate. *)
Definition has_derivative (x : R -> vector) (t : R) (v : vector) : Prop :=
  derivable_pt_lim (fun s => x_of (x s)) t (x_of v) /\
  derivable_pt_lim (fun s => y_of (x s)) t (y_of v) /\
  derivable_pt_lim (fun s => z_of (x s)) t (z_of v).

Definition clamp (a b t : R) : R := if Rle_dec t a then a else if Rle_dec b t then b else t.

Lemma clamp_inside a b t : a <= t <= b -> clamp a b t = t.
Proof. intros H. unfold clamp. repeat destruct Rle_dec; lra. Qed.
Lemma clamp_between a b t : a <= b -> a <= clamp a b t <= b.
Proof. intros H. unfold clamp. repeat destruct Rle_dec; lra. Qed.
Lemma clamp_closer a b s t : a <= t <= b -> Rabs (clamp a b s - t) <= Rabs (s - t).
Proof.
  intros H. apply Rabs_le. generalize (Rle_abs (s - t)) (Rle_abs (- (s - t))). rewrite Rabs_Ropp.
  unfold clamp. repeat destruct Rle_dec; lra.
Qed.

(* The mean value inequality for a number instead of a place. *)
Definition real_continuous_during (a b : R) (f : R -> R) : Prop :=
  forall t e, a <= t <= b -> 0 < e ->
  exists d, 0 < d /\ forall s, a <= s <= b -> Rabs (s - t) < d -> Rabs (f s - f t) < e.

Lemma not_rising_smooth (f f' : R -> R) (a b : R) :
  a <= b -> real_continuous_during a b f -> (forall t, a < t < b -> derivable_pt_lim f t (f' t) /\ f' t <= 0) ->
  f b <= f a.
Proof.
  intros [L| ->]; [|lra]. intros Cf D.
  set (h := fun s => f (clamp a b s)).
  assert (forall c, a < c < b -> derivable_pt_lim h c (f' c)) as Dh.
  { intros c Hc. apply (derivable_pt_lim_locally_ext f h c a b); [lra| |apply D; lra].
    intros z Hz. unfold h. rewrite clamp_inside; [reflexivity|lra]. }
  assert (forall c, a < c < b -> derivable_pt h c) as P by (intros c Hc; exists (f' c); exact (Dh c Hc)).
  assert (forall c, a < c < b -> derivable_pt id c) as Pid by (intros; apply derivable_pt_id).
  destruct (MVT h id a b P Pid L) as (c & Pc & E).
  - intros c Hc e He. destruct (Cf c e) as (d & Hd & G); [lra|lra|]. exists d. split; [exact Hd|].
    intros s [_ Hs]. simpl in *. unfold R_dist, h in *. rewrite (clamp_inside a b c) by lra.
    apply G; [apply clamp_between; lra|]. apply Rle_lt_trans with (2 := Hs). apply clamp_closer. lra.
  - intros. apply derivable_continuous_pt, derivable_pt_id.
  - rewrite (derive_pt_eq_0 h c (f' c) (P c Pc) (Dh c Pc)) in E.
    rewrite (derive_pt_eq_0 id c 1 (Pid c Pc) (derivable_pt_lim_id c)) in E.
    unfold h, id in E. rewrite !clamp_inside in E by lra. destruct (D c Pc). nra.
Qed.

(* At finitely many times there may be no derivative. *)
Lemma not_rising (f f' : R -> R) (jumps : list R) : forall a b,
  a <= b -> real_continuous_during a b f ->
  (forall t, a < t < b -> ~ In t jumps -> derivable_pt_lim f t (f' t) /\ f' t <= 0) -> f b <= f a.
Proof.
  induction jumps as [|c jumps IH]; intros a b L Cf D.
  - apply (not_rising_smooth f f'); auto.
  - destruct (Rlt_or_le a c) as [Ha|Ha]; [destruct (Rlt_or_le c b) as [Hb|Hb]|].
    + assert (f c <= f a /\ f b <= f c); [|lra]. split; apply IH; try lra.
      * intros t e Ht He. destruct (Cf t e) as (d & Hd & G); [lra|lra|]. exists d. split; [lra|].
        intros s Hs. apply G. lra.
      * intros t Ht N. apply D; [lra|]. intros [E|I]; [lra|exact (N I)].
      * intros t e Ht He. destruct (Cf t e) as (d & Hd & G); [lra|lra|]. exists d. split; [lra|].
        intros s Hs. apply G. lra.
      * intros t Ht N. apply D; [lra|]. intros [E|I]; [lra|exact (N I)].
    + apply IH; auto. intros t Ht N. apply D; [lra|]. intros [E|I]; [lra|exact (N I)].
    + apply IH; auto. intros t Ht N. apply D; [lra|]. intros [E|I]; [lra|exact (N I)].
Qed.

Lemma derivative_along (n : vector) (x : R -> vector) (t : R) (v : vector) :
  has_derivative x t v -> derivable_pt_lim (fun s => dot n (x s)) t (dot n v).
Proof.
  intros (Hx & Hy & Hz). unfold dot.
  apply (derivable_pt_lim_plus (fun s => x_of n * x_of (x s) + y_of n * y_of (x s)) (fun s => z_of n * z_of (x s)));
    [apply (derivable_pt_lim_plus (fun s => x_of n * x_of (x s)) (fun s => y_of n * y_of (x s)))|];
    apply (derivable_pt_lim_scal (fun s => _ (x s))); assumption.
Qed.

(* The mean value inequality: if x moves no faster than f grows, it gets no farther than f grows. Seen along the
   direction from where it was to where it is, it is one about numbers. *)
Lemma moves_no_farther (x x' : R -> vector) (f f' : R -> R) (jumps : list R) (a b : R) :
  a <= b -> continuous_during a b x ->
  (forall t, a < t < b -> ~ In t jumps -> has_derivative x t (x' t)) ->
  (forall t, derivable_pt_lim f t (f' t)) ->
  (forall t, a < t < b -> norm (x' t) <= f' t) ->
  norm (x b - x a) <= f b - f a.
Proof.
  intros L Cx Dx Df S. set (n := (x b - x a)%vector).
  assert (dot n (x b) - norm n * f b <= dot n (x a) - norm n * f a) as G.
  { apply (not_rising (fun t => dot n (x t) - norm n * f t) (fun t => dot n (x' t) - norm n * f' t) jumps).
    - exact L.
    - intros t e Ht He.
      assert (continuity_pt f t) as Cf by (apply derivable_continuous_pt; exists (f' t); apply Df).
      set (k := e / (2 * (norm n + 1))).
      assert (0 < k) as Hk.
      { apply Rdiv_lt_0_compat; [lra|]. generalize (norm_positive n). lra. }
      destruct (Cx t k Ht Hk) as (d1 & H1 & G1). destruct (Cf k Hk) as (d2 & H2 & G2).
      exists (Rmin d1 d2). split; [apply Rmin_pos; lra|]. intros s Hs Hd.
      assert (norm (x s - x t) < k) as K1 by (apply G1; [lra|apply Rlt_le_trans with (1 := Hd), Rmin_l]).
      assert (Rabs (f s - f t) < k) as K2.
      { destruct (Req_dec t s) as [->|N]; [rewrite Rminus_diag_eq, Rabs_R0 by reflexivity; lra|].
        apply G2. split; [split; [constructor|exact N]|]. simpl. unfold R_dist.
        apply Rlt_le_trans with (1 := Hd), Rmin_r. }
      replace (dot n (x s) - norm n * f s - (dot n (x t) - norm n * f t))
        with (dot n (x s - x t) - norm n * (f s - f t)) by (rewrite dot_minus; ring).
      assert (Rabs (dot n (x s - x t)) <= norm n * norm (x s - x t)) as K3.
      { apply Rabs_le. split; [|apply cauchy_schwarz].
        generalize (cauchy_schwarz n (x t - x s)). rewrite (norm_symmetric (x t)), !dot_minus. lra. }
      generalize (norm_positive n). intros P.
      assert (Rabs (norm n * (f s - f t)) <= norm n * k) as K4.
      { rewrite Rabs_mult, (Rabs_pos_eq _ P). apply Rmult_le_compat_l; lra. }
      assert (norm n * norm (x s - x t) <= norm n * k) as K5 by (apply Rmult_le_compat_l; lra).
      apply Rle_lt_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp.
      assert (2 * (norm n + 1) * k = e) as E by (unfold k; field; lra). nra.
    - intros t Ht N. split.
      + apply (derivable_pt_lim_minus (fun t => dot n (x t)) (fun t => norm n * f t)).
        * apply derivative_along. auto.
        * apply (derivable_pt_lim_scal f). apply Df.
      + generalize (cauchy_schwarz n (x' t)) (S t Ht) (norm_positive n). nra. }
  assert (norm n * norm n <= norm n * (f b - f a)) as Q.
  { rewrite norm_square. replace (dot n n) with (dot n (x b) - dot n (x a)) by (rewrite <- dot_minus; reflexivity). lra. }
  destruct (norm_positive n) as [P|Z]; [apply Rmult_le_reg_l in Q; assumption|].
  rewrite <- Z. assert (f b - f a >= 0); [|lra].
  assert (- f b <= - f a); [|lra].
  apply (not_rising (fun t => - f t) (fun t => - f' t) nil); [exact L| |].
  - intros t e Ht He.
    assert (continuity_pt f t) as Cf by (apply derivable_continuous_pt; exists (f' t); apply Df).
    destruct (Cf e He) as (d & H & G'). exists d. split; [exact H|]. intros s Hs Hd.
    replace (- f s - - f t) with (- (f s - f t)) by ring. rewrite Rabs_Ropp.
    destruct (Req_dec t s) as [->|N]; [rewrite Rminus_diag_eq, Rabs_R0 by reflexivity; lra|].
    apply G'. split; [split; [constructor|exact N]|exact Hd].
  - intros t Ht _. split; [apply (derivable_pt_lim_opp f), Df|]. generalize (S t Ht) (norm_positive (x' t)). lra.
Qed.

(* What quadratics in time need. *)
Lemma derivative_of_square (k t0 t : R) : derivable_pt_lim (fun s => k * ((s - t0) * (s - t0) / 2)) t (k * (t - t0)).
Proof.
  assert (derivable_pt_lim (fun s => s - t0) t 1) as D.
  { replace 1 with (1 - 0) by ring.
    apply (derivable_pt_lim_minus id (fun _ => t0)); [apply derivable_pt_lim_id|apply derivable_pt_lim_const]. }
  replace (k * (t - t0)) with (k / 2 * (1 * (t - t0) + (t - t0) * 1)) by field.
  apply (derivable_pt_lim_ext (fun s => k / 2 * ((s - t0) * (s - t0)))); [intros; field|].
  apply (derivable_pt_lim_scal (fun s => (s - t0) * (s - t0))).
  apply (derivable_pt_lim_mult (fun s => s - t0) (fun s => s - t0)); exact D.
Qed.
Lemma derivative_of_line (k t0 t : R) : derivable_pt_lim (fun s => k * (s - t0)) t k.
Proof.
  assert (derivable_pt_lim (fun s => s - t0) t (1 - 0)) as D.
  { apply (derivable_pt_lim_minus id (fun _ => t0)); [apply derivable_pt_lim_id|apply derivable_pt_lim_const]. }
  apply (derivable_pt_lim_scal _ k) in D. replace (k * (1 - 0)) with k in D by ring. exact D.
Qed.

Lemma has_derivative_minus (x y : R -> vector) (t : R) (v w : vector) :
  has_derivative x t v -> has_derivative y t w -> has_derivative (fun s => x s - y s)%vector t (v - w)%vector.
Proof.
  intros (H1 & H2 & H3) (K1 & K2 & K3). unfold has_derivative. coordinates.
  repeat split; apply (derivable_pt_lim_minus (fun s => _ (x s)) (fun s => _ (y s))); assumption.
Qed.
Lemma has_derivative_plus (x y : R -> vector) (t : R) (v w : vector) :
  has_derivative x t v -> has_derivative y t w -> has_derivative (fun s => x s + y s)%vector t (v + w)%vector.
Proof.
  intros (H1 & H2 & H3) (K1 & K2 & K3). unfold has_derivative. coordinates.
  repeat split; apply (derivable_pt_lim_plus (fun s => _ (x s)) (fun s => _ (y s))); assumption.
Qed.
Lemma has_derivative_times (k : R) (x : R -> vector) (t : R) (v : vector) :
  has_derivative x t v -> has_derivative (fun s => k * x s)%vector t (k * v)%vector.
Proof.
  intros (H1 & H2 & H3). unfold has_derivative. coordinates.
  repeat split; apply (derivable_pt_lim_scal (fun s => _ (x s))); assumption.
Qed.
Lemma has_derivative_cross (x y : R -> vector) (t : R) (v w : vector) :
  has_derivative x t v -> has_derivative y t w ->
  has_derivative (fun s => cross (x s) (y s)) t (cross v (y t) + cross (x t) w)%vector.
Proof.
  intros (H1 & H2 & H3) (K1 & K2 & K3).
  assert (forall p q p' q' a b a' b', derivable_pt_lim p t a -> derivable_pt_lim q t b -> derivable_pt_lim p' t a' ->
    derivable_pt_lim q' t b' -> derivable_pt_lim (fun s => p s * q s - p' s * q' s) t
      (a * q t - a' * q' t + (p t * b - p' t * b'))) as D.
  { intros p q p' q' a b a' b' Dp Dq Dp' Dq'.
    replace (a * q t - a' * q' t + (p t * b - p' t * b')) with ((a * q t + p t * b) - (a' * q' t + p' t * b')) by ring.
    apply (derivable_pt_lim_minus (fun s => p s * q s) (fun s => p' s * q' s));
      apply (derivable_pt_lim_mult _ _ t); assumption. }
  unfold has_derivative. coordinates.
  repeat split; apply (D (fun s => _ (x s)) (fun s => _ (y s)) (fun s => _ (x s)) (fun s => _ (y s))); assumption.
Qed.
Lemma derivative_of_square_length (x : R -> vector) (t : R) (v : vector) :
  has_derivative x t v -> derivable_pt_lim (fun s => dot (x s) (x s)) t (2 * dot (x t) v).
Proof.
  intros (H1 & H2 & H3).
  assert (forall p a, derivable_pt_lim p t a -> derivable_pt_lim (fun s => p s * p s) t (2 * (p t * a))) as D.
  { intros p a Dp. replace (2 * (p t * a)) with (a * p t + p t * a) by ring. apply (derivable_pt_lim_mult p p); exact Dp. }
  unfold dot. rewrite !Rmult_plus_distr_l.
  apply (derivable_pt_lim_plus (fun s => x_of (x s) * x_of (x s) + y_of (x s) * y_of (x s)) (fun s => z_of (x s) * z_of (x s)));
    [apply (derivable_pt_lim_plus (fun s => x_of (x s) * x_of (x s)) (fun s => y_of (x s) * y_of (x s)))|];
    apply (D (fun s => _ (x s))); assumption.
Qed.
(* The way of a body that follows a plan exactly. *)
Lemma has_derivative_plan (p q g : vector) (t0 t : R) :
  has_derivative (fun s => p + (s - t0) * q + ((s - t0) * (s - t0) / 2) * g)%vector t (q + (t - t0) * g)%vector.
Proof.
  assert (forall p q g : R,
    derivable_pt_lim (fun s => p + (s - t0) * q + (s - t0) * (s - t0) / 2 * g) t (q + (t - t0) * g)) as D.
  { intros a b c.
    apply (derivable_pt_lim_ext (fun s => a + b * (s - t0) + c * ((s - t0) * (s - t0) / 2))); [intros; ring|].
    replace (b + (t - t0) * c) with (0 + b + c * (t - t0)) by ring.
    apply (derivable_pt_lim_plus (fun s => a + b * (s - t0)) (fun s => c * ((s - t0) * (s - t0) / 2))).
    - apply (derivable_pt_lim_plus (fun _ => a) (fun s => b * (s - t0)));
        [apply derivable_pt_lim_const|apply derivative_of_line].
    - apply derivative_of_square. }
  unfold has_derivative. coordinates. repeat split; apply D.
Qed.

Lemma norm_below_coordinates v e : 0 < e ->
  Rabs (x_of v) < e / 2 -> Rabs (y_of v) < e / 2 -> Rabs (z_of v) < e / 2 -> norm v < e.
Proof.
  intros He Hx Hy Hz. apply Rabs_def2 in Hx. apply Rabs_def2 in Hy. apply Rabs_def2 in Hz.
  apply Rle_lt_trans with (sqrt 3 / 2 * e).
  - assert (0 <= sqrt 3) by apply sqrt_pos. assert (sqrt 3 * sqrt 3 = 3) as E by (apply sqrt_sqrt; lra).
    apply norm_at_most; [nra|]. replace (sqrt 3 / 2 * e * (sqrt 3 / 2 * e)) with (3 / 4 * (e * e)).
    2: { replace (sqrt 3 / 2 * e * (sqrt 3 / 2 * e)) with (sqrt 3 * sqrt 3 / 4 * (e * e)) by field. rewrite E. field. }
    unfold dot. nra.
  - assert (sqrt 3 < 2); [|nra]. rewrite <- (sqrt_square 2) by lra. apply sqrt_lt_1; lra.
Qed.
Lemma continuous_where_derivable (a b : R) (x : R -> vector) (x' : R -> vector) :
  (forall t, a <= t <= b -> has_derivative x t (x' t)) -> continuous_during a b x.
Proof.
  intros D t e Ht He. destruct (D t Ht) as (H1 & H2 & H3).
  assert (forall f l, derivable_pt_lim f t l ->
    exists d, 0 < d /\ forall s, Rabs (s - t) < d -> Rabs (f s - f t) < e / 2) as C.
  { intros f l Hf. assert (continuity_pt f t) as Cf by (apply derivable_continuous_pt; exists l; exact Hf).
    destruct (Cf (e / 2)) as (d & Hd & G); [lra|]. exists d. split; [exact Hd|]. intros s Hs.
    destruct (Req_dec t s) as [->|N]; [rewrite Rminus_diag_eq, Rabs_R0 by reflexivity; lra|].
    apply G. split; [split; [constructor|exact N]|exact Hs]. }
  destruct (C _ _ H1) as (d1 & P1 & G1). destruct (C _ _ H2) as (d2 & P2 & G2). destruct (C _ _ H3) as (d3 & P3 & G3).
  exists (Rmin d1 (Rmin d2 d3)). split; [repeat apply Rmin_pos; lra|]. intros s _ Hs.
  generalize (Rmin_l d1 (Rmin d2 d3)) (Rmin_r d1 (Rmin d2 d3)) (Rmin_l d2 d3) (Rmin_r d2 d3). intros.
  apply norm_below_coordinates; [lra| | |]; unfold minus; cbn [x_of y_of z_of]; [apply G1|apply G2|apply G3]; lra.
Qed.
Lemma continuous_minus (a b : R) (x y : R -> vector) :
  continuous_during a b x -> continuous_during a b y -> continuous_during a b (fun t => x t - y t)%vector.
Proof.
  intros Cx Cy t e Ht He. destruct (Cx t (e / 2)) as (d1 & P1 & G1); [lra|lra|].
  destruct (Cy t (e / 2)) as (d2 & P2 & G2); [lra|lra|].
  exists (Rmin d1 d2). split; [apply Rmin_pos; lra|]. intros s Hs Hd.
  generalize (Rmin_l d1 d2) (Rmin_r d1 d2). intros.
  replace (x s - y s - (x t - y t))%vector with ((x s - x t) + (y t - y s))%vector by by_coordinates.
  apply Rle_lt_trans with (1 := norm_plus _ _). rewrite (norm_symmetric (y t)).
  assert (norm (x s - x t) < e / 2) by (apply G1; [lra|lra]).
  assert (norm (y s - y t) < e / 2) by (apply G2; [lra|lra]). lra.
Qed.
Lemma continuous_plus (a b : R) (x y : R -> vector) :
  continuous_during a b x -> continuous_during a b y -> continuous_during a b (fun t => x t + y t)%vector.
Proof.
  intros Cx Cy t e Ht He. destruct (Cx t (e / 2)) as (d1 & P1 & G1); [lra|lra|].
  destruct (Cy t (e / 2)) as (d2 & P2 & G2); [lra|lra|].
  exists (Rmin d1 d2). split; [apply Rmin_pos; lra|]. intros s Hs Hd.
  generalize (Rmin_l d1 d2) (Rmin_r d1 d2). intros.
  replace (x s + y s - (x t + y t))%vector with ((x s - x t) + (y s - y t))%vector by by_coordinates.
  apply Rle_lt_trans with (1 := norm_plus _ _).
  assert (norm (x s - x t) < e / 2) by (apply G1; [lra|lra]).
  assert (norm (y s - y t) < e / 2) by (apply G2; [lra|lra]). lra.
Qed.
Lemma continuous_times (k a b : R) (x : R -> vector) :
  continuous_during a b x -> continuous_during a b (fun t => k * x t)%vector.
Proof.
  intros Cx t e Ht He. generalize (Rabs_pos k). intros Pk.
  destruct (Cx t (e / (Rabs k + 1))) as (d & P & G); [lra|apply Rdiv_lt_0_compat; lra|].
  exists d. split; [exact P|]. intros s Hs Hd.
  replace (k * x s - k * x t)%vector with (k * (x s - x t))%vector by by_coordinates. rewrite norm_times.
  apply Rle_lt_trans with ((Rabs k + 1) * norm (x s - x t)); [generalize (norm_positive (x s - x t)); nra|].
  apply Rlt_le_trans with ((Rabs k + 1) * (e / (Rabs k + 1))); [|right; field; lra].
  apply Rmult_lt_compat_l; [lra|]. apply G; assumption.
Qed.
Lemma continuous_square_length (a b : R) (x : R -> vector) :
  continuous_during a b x -> real_continuous_during a b (fun t => dot (x t) (x t)).
Proof.
  intros Cx t e Ht He. generalize (norm_positive (x t)). intros P.
  set (k := Rmin 1 (e / (2 * (norm (x t) + 1)))).
  assert (0 < k) as Hk by (apply Rmin_pos; [lra|apply Rdiv_lt_0_compat; lra]).
  destruct (Cx t k Ht Hk) as (d & Hd & G). exists d. split; [exact Hd|]. intros s Hs Hst. specialize (G s Hs Hst).
  replace (dot (x s) (x s) - dot (x t) (x t)) with (dot (x s - x t) (x s - x t) + 2 * dot (x t) (x s - x t)) by by_coordinates.
  rewrite <- norm_square. set (l := norm (x s - x t)) in *. assert (0 <= l) as Pl by apply norm_positive.
  assert (Rabs (dot (x t) (x s - x t)) <= norm (x t) * l) as L.
  { apply Rabs_le. split; [|apply cauchy_schwarz].
    generalize (cauchy_schwarz (x t) (x t - x s)). rewrite (norm_symmetric (x t)), !dot_minus. fold l. lra. }
  apply abs_at_most in L.
  assert (k <= 1) by apply Rmin_l.
  assert (k * (2 * (norm (x t) + 1)) <= e) as Ke.
  { apply Rle_trans with (e / (2 * (norm (x t) + 1)) * (2 * (norm (x t) + 1))); [|right; field; lra].
    apply Rmult_le_compat_r; [lra|apply Rmin_r]. }
  apply Rabs_def1; nra.
Qed.
