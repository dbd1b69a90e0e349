(* Bodies that a search leaves out do not touch. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels errors direction fitting swept_spheres nearest_time.
Open Scope R_scope.

Definition contains (c : swept_sphere) (p : ball_in_motion) (S T : R) : Prop := c.(ball) = infinity \/ holds c p S T.

(* Error of a length by underflow. *)
Definition tiny_length : R := / 1152921504606846976.

(* One component of what goes wrong on the way to a difference of centres. *)
Lemma component (d' U u' s t m n T : R) (D : R) :
  Rabs (d' - D) <= 201 / 100 * u * (m + 2 * low) -> Rabs (u' - U) <= 201 / 100 * u * (n + 2 * low) -> Rabs U <= n ->
  Rabs (s - t) <= u * (T + low) -> Rabs s <= T + u * (T + low) -> 0 <= T ->
  Rabs ((d' + u' * s) - (D + U * t)) <=
    201 / 100 * u * (m + 2 * low) + 201 / 100 * u * (n + 2 * low) * (T + u * (T + low)) + n * (u * (T + low)).
Proof.
  intros Ed Eu Ln Es Ls PT.
  replace ((d' + u' * s) - (D + U * t)) with ((d' - D) + (u' - U) * s + U * (s - t)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. apply Rplus_le_compat.
  - eapply Rle_trans; [apply Rabs_triang|]. apply Rplus_le_compat; [exact Ed|].
    rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos.
  - rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos.
Qed.

Lemma moved_component (x w c : single) (b : R) : finite x -> finite w -> finite c ->
  Rabs (B x) <= b -> Rabs (B w) <= b -> b <= bpow radix2 120 -> Rabs (B c) <= 3 ->
  finite (x + w * c)%float /\
  Rabs (B (x + w * c)%float - (B x + B w * B c)) <= 202 / 100 * u * (Rabs (B x) + Rabs (B w) * Rabs (B c) + low).
Proof.
  intros Fx Fw Fc Lx Lw Lb Lc. change (bpow radix2 120) with 1329227995784915872903807060280344576 in Lb.
  assert (Mv := most_value).
  assert (Rabs (B w * B c) <= b * 3) as L1 by (rewrite Rabs_mult; apply Rmult_le_compat; auto using Rabs_pos).
  destruct (mul_ok w c _ Fw Fc L1 ltac:(lra)) as [F1 L2]. rewrite u_value, low_value in L2.
  destruct (add_ok x (w * c)%float _ Fx F1 (Rle_refl _) ltac:(lra)) as [F2 _].
  split; [exact F2|].
  assert (close (x + w * c)%float (B x + B w * B c) (Rabs (B x) + (Rabs (B w) * Rabs (B c) + low)) 202) as C
    by (eapply close_as; [find_close|reflexivity|intros _; apply Rle_refl|hundredths]).
  destruct (C F2) as [E _]. eapply Rle_trans; [exact E|]. right. field.
Qed.

Lemma sum_of_radii (x y : single) (b : R) : finite (x + y)%float -> 0 <= b -> b <= B x + B y -> b * (1 - u) <= B (x + y)%float.
Proof.
  intros F Pb L. destruct (add_finite _ _ F) as (_ & _ & E). generalize (rounded_sum (prec := 24) (emax := 128) x y).
  rewrite <- E, (Rabs_pos_eq (B x + B y)) by lra. intros R. apply Rabs_le_inv in R. rewrite u_value in *. lra.
Qed.

(* Balls p and q are in their swept spheres until the end T of the span from F, which is asked about as from and to. If
   the search leaves the one swept sphere out, the two do not touch in the span. *)
Theorem left_out_is_apart (other one : swept_sphere) (from to : single) (p q : ball_in_motion) (S1 S2 F T : R) :
  contains other p S1 T -> contains one q S2 T ->
  stored from F -> stored to T -> B from <= B to -> 0 <= F -> T <= 2 ->
  left_out other one from to = true ->
  forall t, F <= t <= T -> reach p + reach q < distance_between p q t.
Proof.
  intros Cp Cq Sf St Lft PF LT Left t Ht.
  destruct (left_out_test other one from to Left) as (c & Lc & Hc). clear Left.
  assert (Fl := limit_finite other one _ Lc).
  assert (Fl' := Fl). unfold limit in Fl'. destruct (add_finite _ _ Fl') as (Fr2 & _ & _). clear Fl'.
  destruct (mul_finite _ _ Fr2) as (Fr & _ & Er2).
  assert (Fr' := Fr). unfold radii in Fr'. destruct (add_finite _ _ Fr') as (Fb1 & Fb2 & _). clear Fr'.
  destruct Cp as [I|Hp]; [rewrite I in Fb1; discriminate|]. destruct Cq as [I|Hq]; [rewrite I in Fb2; discriminate|].
  apply Rnot_le_lt. intros Touch.
  destruct Hp as [Px Py Pz Pu Pv Pw Psize Preach Pspeed Plimit Pball].
  destruct Hq as [Qx Qy Qz Qu Qv Qw Qsize Qreach Qspeed Qlimit Qball].
  rewrite p48, p18 in Pball, Qball. rewrite p60 in Pspeed, Qspeed. rewrite p120 in Plimit, Qlimit.
  assert (0 <= T) as PT by lra.
  generalize (Rabs_pos (X1 p)) (Rabs_pos (X2 p)) (Rabs_pos (X3 p)) (Rabs_pos (V1 p)) (Rabs_pos (V2 p)) (Rabs_pos (V3 p)).
  intros PX1 PX2 PX3 PV1 PV2 PV3.
  generalize (Rabs_pos (X1 q)) (Rabs_pos (X2 q)) (Rabs_pos (X3 q)) (Rabs_pos (V1 q)) (Rabs_pos (V2 q)) (Rabs_pos (V3 q)).
  intros QX1 QX2 QX3 QV1 QV2 QV3.
  assert (0 <= (Rabs (V1 p) + Rabs (V2 p) + Rabs (V3 p)) * T) as PVT by (apply Rmult_le_pos; lra).
  assert (0 <= (Rabs (V1 q) + Rabs (V2 q) + Rabs (V3 q)) * T) as QVT by (apply Rmult_le_pos; lra).
  assert (L121 : bpow radix2 121 = 2658455991569831745807614120560689152) by reflexivity.
  destruct (difference_of_stored _ _ _ _ Px Qx ltac:(lra) ltac:(lra)) as [Fdx Edx]. fold (dx other one) in *.
  destruct (difference_of_stored _ _ _ _ Py Qy ltac:(lra) ltac:(lra)) as [Fdy Edy]. fold (dy other one) in *.
  destruct (difference_of_stored _ _ _ _ Pz Qz ltac:(lra) ltac:(lra)) as [Fdz Edz]. fold (dz other one) in *.
  destruct (difference_of_stored _ _ _ _ Pu Qu ltac:(lra) ltac:(lra)) as [Fux Eux]. fold (ux other one) in *.
  destruct (difference_of_stored _ _ _ _ Pv Qv ltac:(lra) ltac:(lra)) as [Fuy Euy]. fold (uy other one) in *.
  destruct (difference_of_stored _ _ _ _ Pw Qw ltac:(lra) ltac:(lra)) as [Fuz Euz]. fold (uz other one) in *.
  clear Px Py Pz Pu Pv Pw Qx Qy Qz Qu Qv Qw.
  (* Sums of magnitudes. *)
  set (m1 := Rabs (X1 p) + Rabs (X1 q)) in *. set (m2 := Rabs (X2 p) + Rabs (X2 q)) in *. set (m3 := Rabs (X3 p) + Rabs (X3 q)) in *.
  set (n1 := Rabs (V1 p) + Rabs (V1 q)) in *. set (n2 := Rabs (V2 p) + Rabs (V2 q)) in *. set (n3 := Rabs (V3 p) + Rabs (V3 q)) in *.
  set (Sum := S1 + S2).
  assert (m1 + m2 + m3 + (n1 + n2 + n3) * T <= Sum) as Size by (unfold m1, m2, m3, n1, n2, n3, Sum; lra).
  assert (n1 + n2 + n3 <= 2305843009213693952) as Speed by (unfold n1, n2, n3; lra).
  assert (0 <= m1 /\ 0 <= m2 /\ 0 <= m3 /\ 0 <= n1 /\ 0 <= n2 /\ 0 <= n3) as (Pm1 & Pm2 & Pm3 & Pn1 & Pn2 & Pn3)
    by (unfold m1, m2, m3, n1, n2, n3; lra).
  assert (D1 : Rabs (X1 p - X1 q) <= m1) by (unfold m1, Rminus; rewrite <- (Rabs_Ropp (X1 q)); apply Rabs_triang).
  assert (D2 : Rabs (X2 p - X2 q) <= m2) by (unfold m2, Rminus; rewrite <- (Rabs_Ropp (X2 q)); apply Rabs_triang).
  assert (D3 : Rabs (X3 p - X3 q) <= m3) by (unfold m3, Rminus; rewrite <- (Rabs_Ropp (X3 q)); apply Rabs_triang).
  assert (U1 : Rabs (V1 p - V1 q) <= n1) by (unfold n1, Rminus; rewrite <- (Rabs_Ropp (V1 q)); apply Rabs_triang).
  assert (U2 : Rabs (V2 p - V2 q) <= n2) by (unfold n2, Rminus; rewrite <- (Rabs_Ropp (V2 q)); apply Rabs_triang).
  assert (U3 : Rabs (V3 p - V3 q) <= n3) by (unfold n3, Rminus; rewrite <- (Rabs_Ropp (V3 q)); apply Rabs_triang).
  (* The radii. *)
  set (Reach := reach p + reach q) in *. set (r := radii other one) in *.
  assert (Pr : (Reach + / 140737488355328 + 64 * u * Sum) * (1 - 2 * u) <= B r).
  { set (b := (reach p + / 281474976710656 + / 262144 * S1) * (1 - u) + (reach q + / 281474976710656 + / 262144 * S2) * (1 - u)).
    assert (0 <= b) as Pb.
    { unfold b. rewrite <- Rmult_plus_distr_r. apply Rmult_le_pos; [lra|rewrite u_value; lra]. }
    assert (H := sum_of_radii other.(ball) one.(ball) b Fr Pb ltac:(unfold b; lra)). fold (radii other one) in H. fold r in H.
    unfold b in H, Pb. unfold Reach, Sum. rewrite u_value in *. lra. }
  assert (PReach : 0 <= Reach <= Sum) by (unfold Reach, Sum; lra).
  assert (Lr : B r <= 18446744073709551616 * (101 / 100)).
  { assert (Lq : Rabs (B (r * r)%float) < bpow radix2 128) by apply abs_B2R_lt_emax.
    rewrite p128, Er2 in Lq. generalize (rounded_error (prec := 24) (emax := 128) (B r * B r)). intros E.
    assert (0 <= B r * B r) as P2 by (generalize (Rle_0_sqr (B r)); unfold Rsqr; lra).
    rewrite (Rabs_pos_eq _ P2) in E. apply Rabs_def2 in Lq. apply Rabs_le_inv in E.
    assert (B r * B r <= 340282366920938463463374607431768211456 * (101 / 100)) as L2 by (rewrite u_value, low_value in *; lra).
    apply Rnot_lt_le. intros L.
    assert (18446744073709551616 * (101 / 100) * (18446744073709551616 * (101 / 100)) < B r * B r)
      by (apply Rmult_le_0_lt_compat; lra). lra. }
  assert (LR : Reach + 64 * u * Sum <= 18446744073709551616 * (102 / 100)) by (rewrite u_value in *; lra).
  clear Pball Qball Preach Qreach Psize Qsize PVT QVT Plimit Qlimit Pspeed Qspeed.
  clearbody m1 m2 m3 n1 n2 n3 Sum Reach.
  (* The differences as computed. *)
  assert (Up : forall x X m, Rabs (x - X) <= 201 / 100 * u * (m + 2 * low) -> Rabs X <= m -> Rabs x <= m * (1001 / 1000) + low).
  { intros x X m E L. replace x with ((x - X) + X) by ring. eapply Rle_trans; [apply Rabs_triang|].
    generalize (Rabs_pos X). rewrite u_value, low_value in *. lra. }
  assert (Bdx := Up _ _ _ Edx D1). assert (Bdy := Up _ _ _ Edy D2). assert (Bdz := Up _ _ _ Edz D3).
  assert (Bux := Up _ _ _ Eux U1). assert (Buy := Up _ _ _ Euy U2). assert (Buz := Up _ _ _ Euz U3). clear Up.
  assert (PVT : 0 <= (n1 + n2 + n3) * T) by (apply Rmult_le_pos; lra).
  assert (VT2 : (n1 + n2 + n3) * T <= 2305843009213693952 * 2) by (apply Rmult_le_compat; lra).
  assert (HDD : DD (dx other one) (dy other one) (dz other one) <= Sum * (1001 / 1000) + 3 * low).
  { unfold DD. eapply Rle_trans; [apply norm_at_most|]. lra. }
  assert (HUU : UU (ux other one) (uy other one) (uz other one) <= bpow radix2 61 * (11 / 10)).
  { unfold UU. eapply Rle_trans; [apply norm_at_most|]. change (bpow radix2 61) with 2305843009213693952.
    rewrite low_value in *. lra. }
  assert (HDD2 : DD (dx other one) (dy other one) (dz other one) <= bpow radix2 65).
  { unfold DD. change (bpow radix2 65) with 36893488147419103232.
    replace (B (dx other one)) with (((X1 p - X1 q) + (V1 p - V1 q) * t) + ((B (dx other one) - (X1 p - X1 q)) - (V1 p - V1 q) * t)) by ring.
    replace (B (dy other one)) with (((X2 p - X2 q) + (V2 p - V2 q) * t) + ((B (dy other one) - (X2 p - X2 q)) - (V2 p - V2 q) * t)) by ring.
    replace (B (dz other one)) with (((X3 p - X3 q) + (V3 p - V3 q) * t) + ((B (dz other one) - (X3 p - X3 q)) - (V3 p - V3 q) * t)) by ring.
    eapply Rle_trans; [apply norm_triangle|]. fold (distance_between p q t).
    eapply Rle_trans; [apply Rplus_le_compat; [exact Touch|apply norm_at_most]|].
    assert (forall e U n, Rabs U <= n -> Rabs (e - U * t) <= Rabs e + n * T) as One.
    { intros e U n L. unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, Rabs_mult.
      apply Rplus_le_compat_l. rewrite (Rabs_pos_eq t) by lra. apply Rmult_le_compat; try lra. apply Rabs_pos. }
    generalize (One (B (dx other one) - (X1 p - X1 q)) _ _ U1) (One (B (dy other one) - (X2 p - X2 q)) _ _ U2)
      (One (B (dz other one) - (X3 p - X3 q)) _ _ U3). intros O1 O2 O3.
    rewrite u_value, low_value in *. lra. }
  (* The time that is chosen. *)
  destruct (nearest_of_floats _ _ _ _ _ _ Fdx Fdy Fdz Fux Fuy Fuz HDD2 HUU) as [Ft Et].
  fold (speed other one) in Ft, Et. fold (approach other one) in Ft, Et. fold (nearest other one) in Ft, Et.
  destruct Sf as [Ff Ef], St as [Fto Eto]. rewrite (Rabs_pos_eq F PF) in Ef. rewrite (Rabs_pos_eq T PT) in Eto.
  apply Rabs_le_inv in Ef, Eto.
  assert (exists s, B from <= s <= B to /\ Rabs (s - t) <= u * (T + low)) as (s & Hs & Es).
  { destruct (Rle_or_lt t (B from)); [exists (B from)|destruct (Rle_or_lt t (B to)); [exists t|exists (B to)]].
    - split; [lra|]. apply Rabs_le. rewrite u_value, low_value in *. lra.
    - split; [lra|]. rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. rewrite u_value, low_value. lra.
    - split; [lra|]. apply Rabs_le. rewrite u_value, low_value in *. lra. }
  assert (Span : forall x, B from <= x <= B to -> Rabs x <= T + u * (T + low)).
  { intros x Hx. apply Rabs_le. rewrite u_value, low_value in *. lra. }
  assert (finite c /\
    ((B from <= B (nearest other one) <= B to /\ B c = B (nearest other one)) \/
     (B to <= B (nearest other one) /\ B c = B to) \/ (B (nearest other one) <= B from /\ B c = B from))) as [Fc Choice].
  { destruct Hc as [(A1 & A2 & ->)|[(A1 & A2 & ->)|[(A1 & A2 & ->)|(A1 & A2 & ->)]]].
    - split; [exact Ft|]. left. apply less_true in A1; try assumption. apply less_true in A2; try assumption. lra.
    - split; [exact Fto|]. right; left. apply less_false in A2; try assumption. lra.
    - split; [exact Ff|]. right; right. apply less_false in A1; try assumption. lra.
    - split; [exact Fto|]. right; right. apply less_false in A1; try assumption. apply less_false in A2; try assumption. lra. }
  assert (Hcs : B from <= B c <= B to) by (destruct Choice as [[A ->]|[[A ->]|[A ->]]]; lra).
  assert (Lcs := Span _ Hcs). assert (Lss := Span _ Hs). clear Span.
  set (s1 := - (approach_r (dx other one) (dy other one) (dz other one) (ux other one) (uy other one) (uz other one)
    / weight (ux other one) (uy other one) (uz other one))) in *.
  assert (Near := near_the_nearest s1 (B (nearest other one)) (B from) (B to) s _ (Rle_refl _) Hs (B c) Choice).
  assert (s * s <= 5) as S5.
  { assert (Rabs s * Rabs s <= (201 / 100) * (201 / 100)) by (apply Rmult_le_compat; auto using Rabs_pos; rewrite u_value, low_value in *; lra).
    rewrite <- Rabs_mult, Rabs_pos_eq in H by (generalize (Rle_0_sqr s); unfold Rsqr; lra). lra. }
  assert (Chosen := chosen_distance _ _ _ _ _ _ HUU (B c) s _ _ Near (Rabs_pos _) Et S5).
  (* The error up to that term. *)
  assert (Way : norm (B (dx other one) + B (ux other one) * s) (B (dy other one) + B (uy other one) * s) (B (dz other one) + B (uz other one) * s)
    <= Reach + 32 / 10 * u * Sum + tiny_length).
  { generalize (component _ _ _ _ _ _ _ _ _ Edx Eux U1 Es Lss PT) (component _ _ _ _ _ _ _ _ _ Edy Euy U2 Es Lss PT)
      (component _ _ _ _ _ _ _ _ _ Edz Euz U3 Es Lss PT). intros K1 K2 K3.
    replace (B (dx other one) + B (ux other one) * s) with (((X1 p - X1 q) + (V1 p - V1 q) * t) +
      (B (dx other one) + B (ux other one) * s - ((X1 p - X1 q) + (V1 p - V1 q) * t))) by ring.
    replace (B (dy other one) + B (uy other one) * s) with (((X2 p - X2 q) + (V2 p - V2 q) * t) +
      (B (dy other one) + B (uy other one) * s - ((X2 p - X2 q) + (V2 p - V2 q) * t))) by ring.
    replace (B (dz other one) + B (uz other one) * s) with (((X3 p - X3 q) + (V3 p - V3 q) * t) +
      (B (dz other one) + B (uz other one) * s - ((X3 p - X3 q) + (V3 p - V3 q) * t))) by ring.
    eapply Rle_trans; [apply norm_triangle|]. fold (distance_between p q t).
    eapply Rle_trans; [apply Rplus_le_compat; [exact Touch|apply norm_at_most]|].
    revert K1 K2 K3. unfold tiny_length.
    match goal with |- Rabs ?x <= _ -> Rabs ?y <= _ -> Rabs ?z <= _ -> _ => generalize (Rabs x) (Rabs y) (Rabs z) end.
    clear - Size Speed PVT Pm1 Pm2 Pm3 Pn1 Pn2 Pn3 PT LT VT2. intros k1 k2 k3 K1 K2 K3.
    rewrite u_value, low_value in *. lra. }
  (* The difference itself. *)
  assert (Rabs (B c) <= 3) as Lc3 by (rewrite u_value, low_value in *; lra).
  assert (Lbig : Sum * (1001 / 1000) + 2305843009213693952 * 2 + 1 <= bpow radix2 120) by (rewrite p120, u_value in *; lra).
  set (Big := Sum * (1001 / 1000) + 2305843009213693952 * 2 + 1) in *.
  destruct (moved_component (dx other one) (ux other one) c Big Fdx Fux Fc
    ltac:(unfold Big; rewrite low_value in *; lra) ltac:(unfold Big; rewrite low_value in *; lra) Lbig Lc3) as [Fpx Epx].
  destruct (moved_component (dy other one) (uy other one) c Big Fdy Fuy Fc
    ltac:(unfold Big; rewrite low_value in *; lra) ltac:(unfold Big; rewrite low_value in *; lra) Lbig Lc3) as [Fpy Epy].
  destruct (moved_component (dz other one) (uz other one) c Big Fdz Fuz Fc
    ltac:(unfold Big; rewrite low_value in *; lra) ltac:(unfold Big; rewrite low_value in *; lra) Lbig Lc3) as [Fpz Epz].
  fold (px other one c) in Fpx, Epx. fold (py other one c) in Fpy, Epy. fold (pz other one c) in Fpz, Epz.
  assert (Short : norm (B (px other one c)) (B (py other one c)) (B (pz other one c)) <= Reach + 16 * u * Sum + / 200000000000000).
  { replace (B (px other one c)) with ((B (dx other one) + B (ux other one) * B c) + (B (px other one c) - (B (dx other one) + B (ux other one) * B c))) by ring.
    replace (B (py other one c)) with ((B (dy other one) + B (uy other one) * B c) + (B (py other one c) - (B (dy other one) + B (uy other one) * B c))) by ring.
    replace (B (pz other one c)) with ((B (dz other one) + B (uz other one) * B c) + (B (pz other one c) - (B (dz other one) + B (uz other one) * B c))) by ring.
    eapply Rle_trans; [apply norm_triangle|].
    eapply Rle_trans; [apply Rplus_le_compat; [exact Chosen|apply norm_at_most]|].
    assert (Prod : forall b n, 0 <= b <= n * (1001 / 1000) + low -> 0 <= n ->
      b * Rabs (B c) <= (n * (1001 / 1000) + low) * (T + u * (T + low))) by
      (intros b n [Hb1 Hb2] Hn; apply Rmult_le_compat; auto using Rabs_pos).
    generalize (Prod _ _ (conj (Rabs_pos _) Bux) Pn1) (Prod _ _ (conj (Rabs_pos _) Buy) Pn2) (Prod _ _ (conj (Rabs_pos _) Buz) Pn3).
    intros R1 R2 R3. clear Prod.
    revert Epx Epy Epz R1 R2 R3 Way HDD Bdx Bdy Bdz. unfold tiny_length.
    repeat match goal with |- context [Rabs (B (?f other one c) - ?x)] => generalize (Rabs (B (f other one c) - x)); intro end.
    match goal with |- context [norm (B (dx other one) + ?x * s) ?y ?z] => generalize (norm (B (dx other one) + x * s) y z); intro end.
    generalize (Rabs (B (ux other one)) * Rabs (B c)) (Rabs (B (uy other one)) * Rabs (B c)) (Rabs (B (uz other one)) * Rabs (B c)).
    generalize (Rabs (B (dx other one))) (Rabs (B (dy other one))) (Rabs (B (dz other one))) (DD (dx other one) (dy other one) (dz other one)).
    clear - Size Speed PVT Pm1 Pm2 Pm3 Pn1 Pn2 Pn3 PT LT VT2. intros.
    rewrite u_value, low_value in *. lra. }
  assert (Out : less (limit other one) (square other one c) = false).
  { unfold limit, square. apply not_left_out; try assumption.
    - clear - Pr PReach. change (radii other one) with r. rewrite u_value in *. lra.
    - change (radii other one) with r. clear - Short Pr PReach. rewrite u_value in *. lra. }
  rewrite Out in Lc. discriminate.
Qed.

(* It does say something: a ball at the origin, and one that is 128 away and comes nearer with a speed of 1, are left
   out for the span from 0 to 1. *)
Section Example.
Local Transparent literal.
Lemma power_in_single (e : Z) : (-100 <= e <= 100)%Z -> finite (literal 1 e : single) /\ B (literal 1 e) = bpow radix2 e.
Proof.
  intros He. unfold literal.
  generalize (binary_normalize_correct 24 128 _ _ mode_NE 1 e false). cbv zeta.
  change (round_mode mode_NE) with ZnearestE.
  replace (F2R (Float radix2 1 e)) with (bpow radix2 e) by (unfold F2R; simpl; ring).
  replace (round radix2 (SpecFloat.fexp 24 128) ZnearestE (bpow radix2 e)) with (bpow radix2 e).
  2: { symmetry. apply round_generic; auto with typeclass_instances.
       apply generic_format_bpow. unfold SpecFloat.fexp, SpecFloat.emin. lia. }
  rewrite Rlt_bool_true.
  - intros (E & F & _). auto.
  - rewrite Rabs_pos_eq by apply bpow_ge_0. apply bpow_lt. lia.
Qed.
Lemma stored_zero : stored (literal 0 0) 0.
Proof.
  split; [reflexivity|]. replace (B (literal 0 0)) with 0 by reflexivity.
  rewrite Rminus_diag_eq, Rabs_R0, u_value, low_value by reflexivity. lra.
Qed.
Lemma stored_power (e : Z) : (-100 <= e <= 100)%Z -> stored (literal 1 e) (bpow radix2 e).
Proof.
  intros He. destruct (power_in_single e He) as [F E]. split; [exact F|].
  rewrite E, Rminus_diag_eq, Rabs_R0, u_value, low_value by reflexivity. generalize (Rabs_pos (bpow radix2 e)). lra.
Qed.
Lemma stored_minus_one : stored (neg (literal 1 0)) (-1).
Proof.
  destruct (stored_power 0) as [F E]; [lia|]. split; [apply neg_finite; exact F|]. rewrite neg_value.
  change (-1) with (- (1)). rewrite (Rabs_Ropp 1). replace (- B (literal 1 0) - - (1)) with (- (B (literal 1 0) - 1)) by ring.
  rewrite Rabs_Ropp. exact E.
Qed.
End Example.

Theorem somebody_is_left_out : exists (other one : swept_sphere) (p q : ball_in_motion) (S : R),
  0 < reach p /\ 0 < reach q /\ contains other p S 1 /\ contains one q S 1 /\ V1 p <> V1 q /\
  stored (literal 0 0) 0 /\ stored (literal 1 0) 1 /\ left_out other one (literal 0 0) (literal 1 0) = true.
Proof.
  set (o := literal 0 0 : single).
  exists {| centre_x := literal 1 7; centre_y := o; centre_z := o; motion_x := neg (literal 1 0); motion_y := o; motion_z := o; ball := literal 1 1 |}.
  exists {| centre_x := o; centre_y := o; centre_z := o; motion_x := o; motion_y := o; motion_z := o; ball := literal 1 1 |}.
  exists {| X1 := 128; X2 := 0; X3 := 0; V1 := -1; V2 := 0; V3 := 0; reach := 1 |}.
  exists {| X1 := 0; X2 := 0; X3 := 0; V1 := 0; V2 := 0; V3 := 0; reach := 1 |}, 256.
  assert (L1 := proj2 (power_in_single 1 ltac:(lia))). change (bpow radix2 1) with 2 in L1.
  assert (H7 := stored_power 7 ltac:(lia)). assert (H0 := stored_power 0 ltac:(lia)).
  assert (E1 : Rabs (-1) = 1) by (rewrite Rabs_left; lra). assert (E7 : Rabs 128 = 128) by (apply Rabs_pos_eq; lra).
  split; [simpl; lra|]. split; [simpl; lra|]. split; [right|split; [right|]].
  1, 2: split; cbn [X1 X2 X3 V1 V2 V3 reach ball centre_x centre_y centre_z motion_x motion_y motion_z];
    auto using stored_zero, stored_minus_one; rewrite ?L1, ?p18, ?p48, ?p60, ?p120, ?Rabs_R0, ?E1, ?E7, ?u_value; lra.
  simpl. split; [lra|]. split; [exact stored_zero|]. split; [exact H0|]. vm_compute. reflexivity.
Qed.
