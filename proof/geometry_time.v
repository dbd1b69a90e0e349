(* The least step of the Zeno guard: how much a gap can shrink in it (Lemma 7). *)
From Coq Require Import Reals Lra Psatz.
From Kinesphere Require Import quadratic geometry_vectors geometry_motion geometry_bounds geometry_certificates.
Open Scope R_scope.

(* The step in which a gap that shrinks by s d + a d^2 / 2 shrinks by `way`. *)
Definition least_step (way s a : R) : R := 2 * way / (s + sqrt (s * s + 2 * a * way)).

Lemma least_step_goes_no_farther (way s a d : R) : 0 < way -> 0 <= s -> 0 <= a -> 0 < s + a ->
  0 <= d <= least_step way s a -> s * d + a * (d * d / 2) <= way.
Proof.
  intros Hw Hs Ha P Hd. set (S := sqrt (s * s + 2 * a * way)) in *.
  assert (0 <= 2 * a * way) as Hq by (apply Rmult_le_pos; lra).
  assert (S * S = s * s + 2 * a * way) as E by (apply sqrt_sqrt; nra). assert (0 <= S) as HS by apply sqrt_pos.
  assert (0 < s + S) as H.
  { destruct (Rle_lt_or_eq_dec 0 s Hs) as [L|Z]; [lra|]. assert (0 < a * way) by (apply Rmult_lt_0_compat; lra). nra. }
  assert (d * (s + S) <= 2 * way) as L.
  { apply Rle_trans with (2 * way / (s + S) * (s + S)); [|right; field; lra].
    apply Rmult_le_compat_r; [lra|]. apply Hd. }
  (* One of the two factors of the quadratic way - s d - a d^2 / 2, times 4 way; the other is above zero. *)
  assert (0 <= (2 * way - s * d - S * d) * (2 * way - s * d + S * d)) as Q.
  { apply Rmult_le_pos; nra. }
  replace ((2 * way - s * d - S * d) * (2 * way - s * d + S * d))
    with (4 * way * (way - s * d) + (s * s - S * S) * (d * d)) in Q by ring.
  rewrite E in Q. replace (4 * way * (way - s * d) + (s * s - (s * s + 2 * a * way)) * (d * d))
    with (4 * way * (way - (s * d + a * (d * d / 2)))) in Q by field.
  apply Rnot_lt_le. intros N. assert (4 * way * (way - (s * d + a * (d * d / 2))) < 0) by nra. lra.
Qed.

(* Two bodies are rechecked at the time t. As reported, their gap is |X| less the radii r + e0, and they approach no
   faster than w, the speed that rounding may hide, along the line of their centres. With the sums of their velocity
   errors and w, and of their largest accelerations, the true gap shrinks below the reported one, until the least step
   is over, by no more than `way`: an eighth of the contact tolerance. *)
Theorem gap_shrinks_by_no_more_in_the_least_step (a b : body) (ma mb : motion) (t0 t1 t d w way : R)
  (pa qa pb qb : vector) :
  keeps_promise a ma t0 t1 -> keeps_promise b mb t0 t1 -> t0 <= t -> t + d <= t1 ->
  true_report a ma t pa qa -> true_report b mb t pb qb ->
  0 < way -> 0 <= w -> 0 <= e1 a -> 0 <= e1 b -> 0 <= A a -> 0 <= A b ->
  - w * norm (pa - pb) <= dot (pa - pb) (qa - qb) ->
  let s := e1 a + e1 b + w in
  let acceleration := (A a + norm (g a)) + (A b + norm (g b)) in
  0 < s + acceleration -> 0 <= d <= least_step way s acceleration ->
  (norm (pa - pb) - (r a + e0 a) - (r b + e0 b)) - way <= norm (place ma (t + d) - place mb (t + d)) - r a - r b.
Proof.
  intros Ka Kb Ht Ht1 Ta Tb Hway Hw Ea Eb Aa Ab W s acceleration Hs Hd.
  assert (s * d + acceleration * (d * d / 2) <= way) as L.
  { apply least_step_goes_no_farther; auto; unfold s, acceleration;
      generalize (norm_positive (g a)) (norm_positive (g b)); lra. }
  generalize (centre_is_near a ma t0 t1 t pa qa d Ka Ht ltac:(lra) Ht1 Ta)
    (centre_is_near b mb t0 t1 t pb qb d Kb Ht ltac:(lra) Ht1 Tb).
  set (ca := c (bound_of a pa qa) d). set (cb := c (bound_of b pb qb) d).
  generalize (norm_by_way_of (place ma (t + d)) ca cb) (norm_by_way_of (place mb (t + d)) (place ma (t + d)) cb).
  rewrite (norm_symmetric ca (place ma (t + d))), !rho_of. unfold growth_after, bound_of. cbn [growth_speed growth].
  assert (norm (pa - pb) - w * d - (norm (g a) + norm (g b)) * (d * d / 2) <= norm (ca - cb)) as N.
  { replace (ca - cb)%vector with (((pa - pb) + d * (qa - qb)) - (- (d * d / 2)) * (g a - g b))%vector
      by (unfold ca, cb, c, bound_of; cbn [start speed plan]; coordinates; apply (f_equal3 Vector); field).
    generalize (norm_minus ((pa - pb) + d * (qa - qb)) ((- (d * d / 2)) * (g a - g b))).
    rewrite norm_times, Rabs_Ropp, Rabs_pos_eq by nra.
    assert (norm (g a - g b) <= norm (g a) + norm (g b)) as G.
    { generalize (norm_by_way_of zero (g a) (g b)). replace (g a - zero)%vector with (g a) by (destruct (g a); by_coordinates).
      rewrite (norm_symmetric zero). replace (g b - zero)%vector with (g b) by (destruct (g b); by_coordinates). lra. }
    assert (norm (pa - pb) - w * d <= norm ((pa - pb) + d * (qa - qb))) as M.
    { set (X := (pa - pb)%vector) in *. set (V := (qa - qb)%vector) in *.
      generalize (cauchy_schwarz X (X + d * V)). rewrite dot_plus, dot_times, <- norm_square. intros Q.
      assert (d * (- w * norm X) <= d * dot X V) by (apply Rmult_le_compat_l; lra).
      destruct (norm_positive X) as [P|Z].
      - apply Rmult_le_reg_l with (norm X); [exact P|]. lra.
      - rewrite <- Z. generalize (norm_positive (X + d * V)). assert (0 <= w * d) by (apply Rmult_le_pos; lra). lra. }
    assert (d * d / 2 * norm (g a - g b) <= d * d / 2 * (norm (g a) + norm (g b))) by (apply Rmult_le_compat_l; nra).
    lra. }
  unfold s, acceleration in L. lra.
Qed.

(* How far a certificate lies ahead. Of two bounds with a gap beyond the distance let the direction n be that of the way
   between their centres. If speeds, with the growth of radii, sum up to no more than s, and accelerations to no more
   than a, the quadratic of Lemma 3 stays above zero for as long as the gap needs to close with these. *)
Theorem certificate_lies_ahead (x y : bound) (n : vector) (distance s a d : R) :
  norm n = 1 -> (start x - start y)%vector = (norm (start x - start y) * n)%vector ->
  let gap := norm (start x - start y) - size x - size y - distance in
  0 < gap -> 0 <= s -> 0 <= a -> 0 < s + a ->
  norm (speed x - speed y) + growth_speed x + growth_speed y <= s ->
  norm (plan x - plan y) + growth x + growth y <= a ->
  0 <= d < least_step gap s a ->
  0 < dot n (C x y d) - Rs x y d - distance.
Proof.
  intros Hn Dn gap Hg Hs Ha P Ls La Hd. rewrite linearised.
  assert (constant x y n distance = gap) as E.
  { unfold constant, gap. rewrite Dn at 1. rewrite dot_times, <- norm_square, Hn. ring. }
  assert (- s <= linear x y n) as L1.
  { unfold linear. generalize (cauchy_schwarz n (speed y - speed x)).
    rewrite Hn, (norm_symmetric (speed y)), !dot_minus. lra. }
  assert (- a <= square x y n) as L2.
  { unfold square. generalize (cauchy_schwarz n (plan y - plan x)).
    rewrite Hn, (norm_symmetric (plan y)), !dot_minus. lra. }
  assert (exists e, d < e /\ e <= least_step gap s a) as (e & He & Le)
    by (exists ((d + least_step gap s a) / 2); lra).
  generalize (least_step_goes_no_farther gap s a e Hg Hs Ha P (conj (Rle_trans _ _ _ (proj1 Hd) (Rlt_le _ _ He)) Le)).
  intros W. rewrite E. apply Rlt_le_trans with (quadratic gap (- s) (- a) d); [|apply quadratic_le; lra].
  unfold quadratic. assert (d * d < e * e) as Q by nra.
  assert (s * d <= s * e) by (apply Rmult_le_compat_l; lra).
  assert (a * (d * d) <= a * (e * e)) by (apply Rmult_le_compat_l; lra).
  destruct (Rle_lt_or_eq_dec 0 s Hs) as [S|Z].
  - assert (s * d < s * e) by (apply Rmult_lt_compat_l; assumption). lra.
  - assert (a * (d * d) < a * (e * e)) by (apply Rmult_lt_compat_l; [lra|exact Q]). lra.
Qed.
