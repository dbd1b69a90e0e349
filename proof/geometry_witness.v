(* Witnesses of a contact that slide along two hulls: means of pairs of points, with weights that change at constant rates. *)
From Coq Require Import Reals Lra Psatz List.
From Kinesphere Require Import geometry_vectors geometry_shapes geometry_hulls.
Open Scope R_scope.

(* A pair of points of two hulls, s after the beginning: how far the first is from the second then and with which velocity it
   moved relative to it, both at the beginning; its weight at the beginning, and the rate at which that changes. *)
Record pair : Type := Pair {
  first : vector; second : vector; offset : vector; speed : vector; weight : R; rate : R }.
Definition mean_of (weight_of : pair -> R) (of : pair -> vector) (pairs : list pair) : vector :=
  weighted (map (fun p => (weight_of p, of p)) pairs).
Definition sum_of (weight_of : pair -> R) (pairs : list pair) : R := total (map (fun p => (weight_of p, p)) pairs).
Definition weight_at (s : R) (p : pair) : R := weight p + rate p * s.

(* The motion of the one mean relative to the other, with a plan g that all pairs have. *)
Definition motion_of_means (g : vector) (s : R) (pairs : list pair) : vector :=
  (mean_of weight offset pairs + s * (mean_of weight speed pairs + mean_of rate offset pairs) +
   (s * s / 2) * (g + 2 * mean_of rate speed pairs))%vector.

Lemma means_are_near (g : vector) (s growth : R) (pairs : list pair) :
  (forall p, In p pairs -> 0 <= weight_at s p /\
    norm (first p - second p - (offset p + s * speed p + (s * s / 2) * g)) <= growth) ->
  let all := sum_of weight pairs + s * sum_of rate pairs in
  0 <= all /\
  norm (mean_of (weight_at s) first pairs - mean_of (weight_at s) second pairs -
        (mean_of weight offset pairs + s * (mean_of weight speed pairs + mean_of rate offset pairs) +
         (s * s / 2) * (all * g + 2 * mean_of rate speed pairs))) <= all * growth.
Proof.
  unfold mean_of, sum_of. induction pairs as [|p pairs IH]; intros H; cbn [map weighted total].
  - split; [lra|]. match goal with |- norm ?v <= _ => replace v with zero by by_coordinates end. rewrite norm_zero. lra.
  - destruct IH as [P L]; [intros q I; apply H; right; exact I|]. destruct (H p (or_introl eq_refl)) as [Pp Lp].
    set (W := total (map (fun p => (weight p, p)) pairs)) in *. set (R' := total (map (fun p => (rate p, p)) pairs)) in *.
    set (F := weighted (map (fun p => (weight_at s p, first p)) pairs)) in *.
    set (S := weighted (map (fun p => (weight_at s p, second p)) pairs)) in *.
    set (O := weighted (map (fun p => (weight p, offset p)) pairs)) in *.
    set (V := weighted (map (fun p => (weight p, speed p)) pairs)) in *.
    set (O' := weighted (map (fun p => (rate p, offset p)) pairs)) in *.
    set (V' := weighted (map (fun p => (rate p, speed p)) pairs)) in *.
    split; [unfold weight_at in Pp; lra|].
    match goal with |- norm ?v <= _ => replace v with
      (weight_at s p * (first p - second p - (offset p + s * speed p + (s * s / 2) * g)) +
       (F - S - (O + s * (V + O') + (s * s / 2) * ((W + s * R') * g + 2 * V'))))%vector end.
    + apply Rle_trans with (1 := norm_plus _ _). rewrite norm_times, (Rabs_pos_eq _ Pp).
      assert (weight_at s p * norm (first p - second p - (offset p + s * speed p + (s * s / 2) * g)) <= weight_at s p * growth)
        by (apply Rmult_le_compat_l; assumption).
      unfold weight_at in *. lra.
    + unfold weight_at. coordinates. apply (f_equal3 Vector); field.
Qed.

Lemma mean_is_in_hull (s : R) (of : pair -> vector) (pairs : list pair) :
  (forall p, In p pairs -> 0 <= weight_at s p) -> sum_of weight pairs = 1 -> sum_of rate pairs = 0 ->
  hull (map of pairs) (mean_of (weight_at s) of pairs).
Proof.
  intros H W R'. exists (map (fun p => (weight_at s p, of p)) pairs). split; [|split; [|reflexivity]].
  - intros k x I. apply in_map_iff in I. destruct I as (p & [= <- <-] & I). split; [exact (H p I)|]. apply in_map. exact I.
  - rewrite <- (Rplus_0_r 1), <- W, <- (Rmult_0_r s), <- R' at 1. clear. unfold sum_of.
    induction pairs as [|p pairs IH]; cbn [map total]; [ring|]. rewrite IH. unfold weight_at. ring.
Qed.

(* While no weight is negative, the sum of the weights being 1 and that of their rates 0, both means are in their hulls; and
   they are no farther apart than their motion and the growth of the pairs say. So the gap of the two hulls is no larger. *)
Theorem sliding_witnesses_guard_the_contact (g : vector) (s growth radius_a radius_b distance : R) (pairs : list pair) :
  (forall p, In p pairs -> 0 <= weight_at s p /\
    norm (first p - second p - (offset p + s * speed p + (s * s / 2) * g)) <= growth) ->
  sum_of weight pairs = 1 -> sum_of rate pairs = 0 ->
  norm (motion_of_means g s pairs) + growth < radius_a + radius_b + distance ->
  exists x y, hull (map first pairs) x /\ hull (map second pairs) y /\ norm (x - y) - radius_a - radius_b < distance.
Proof.
  intros H W R' L. exists (mean_of (weight_at s) first pairs), (mean_of (weight_at s) second pairs).
  split; [|split]; [apply mean_is_in_hull; auto; intros p I; apply (H p I)..|].
  destruct (means_are_near g s growth pairs H) as [_ N]. cbv zeta in N. rewrite W, R', Rmult_0_r, Rplus_0_r, Rmult_1_l in N.
  replace (1 * g)%vector with g in N by (destruct g; by_coordinates). fold (motion_of_means g s pairs) in N.
  generalize (norm_minus (mean_of (weight_at s) first pairs - mean_of (weight_at s) second pairs) (motion_of_means g s pairs)). lra.
Qed.
