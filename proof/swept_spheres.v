(* Swept spheres, the balls that they hold, and the test of a search in named parts. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels errors direction fitting.
Open Scope R_scope.

Notation B := (B2R (prec := 24) (emax := 128)).
Notation u := (roundoff (prec := 24)).
Notation low := (least (emax := 128)).
Notation rnd32 := (rnd (prec := 24) (emax := 128)).
Notation small := (literal (prec := 24) (emax := 128) 1 (-100)).

Lemma u_value : u = / 16777216.
Proof. reflexivity. Qed.
Lemma low_value : low = / 85070591730234615865843651857942052864.
Proof. reflexivity. Qed.

Transparent literal.
Lemma small_value : finite small /\ B small = / 1267650600228229401496703205376.
Proof.
  split; [reflexivity|]. unfold literal.
  generalize (binary_normalize_correct 24 128 _ _ mode_NE 1 (-100) false). cbv zeta.
  change (round_mode mode_NE) with ZnearestE.
  replace (F2R (Float radix2 1 (-100))) with (bpow radix2 (-100)) by (unfold F2R; simpl; ring).
  replace (round radix2 (SpecFloat.fexp 24 128) ZnearestE (bpow radix2 (-100))) with (bpow radix2 (-100)).
  2: { symmetry. apply round_generic; auto with typeclass_instances.
       apply generic_format_bpow. unfold SpecFloat.fexp, SpecFloat.emin. lia. }
  rewrite Rlt_bool_true.
  - intros (E & _). rewrite E. reflexivity.
  - rewrite Rabs_pos_eq by apply bpow_ge_0. apply bpow_lt. lia.
Qed.
Opaque literal.

(* A ball that moves straight on: its centre at the time 0, its velocity, its radius. *)
Record ball_in_motion := { X1 : R; X2 : R; X3 : R; V1 : R; V2 : R; V3 : R; reach : R }.

Definition distance_between (p q : ball_in_motion) (t : R) : R :=
  norm ((X1 p - X1 q) + (V1 p - V1 q) * t) ((X2 p - X2 q) + (V2 p - V2 q) * t) ((X3 p - X3 q) + (V3 p - V3 q) * t).

(* A number, rounded to single precision. *)
Definition stored (x : single) (X : R) : Prop := finite x /\ Rabs (B x - X) <= u * (Rabs X + low).

(* A swept sphere holds a ball until the time T, when all lengths that go into a search for it are at most S: it has a
   margin of 2^-48, and 2^-18 of its size. One with an infinite radius holds all. *)
Record holds (c : swept_sphere) (p : ball_in_motion) (S T : R) : Prop := {
  holds_x : stored c.(centre_x) (X1 p); holds_y : stored c.(centre_y) (X2 p); holds_z : stored c.(centre_z) (X3 p);
  holds_u : stored c.(motion_x) (V1 p); holds_v : stored c.(motion_y) (V2 p); holds_w : stored c.(motion_z) (V3 p);
  holds_size : Rabs (X1 p) + Rabs (X2 p) + Rabs (X3 p) + (Rabs (V1 p) + Rabs (V2 p) + Rabs (V3 p)) * T <= S;
  holds_reach : 0 <= reach p <= S;
  holds_speed : Rabs (V1 p) + Rabs (V2 p) + Rabs (V3 p) <= bpow radix2 60;
  holds_limit : S <= bpow radix2 120;
  holds_ball : (reach p + bpow radix2 (-48) + bpow radix2 (-18) * S) * (1 - u) <= B c.(ball)
}.

Section Search.

Variables other one : swept_sphere.
Variables from to : single.

Definition dx : single := (other.(centre_x) - one.(centre_x))%float.
Definition dy : single := (other.(centre_y) - one.(centre_y))%float.
Definition dz : single := (other.(centre_z) - one.(centre_z))%float.
Definition ux : single := (other.(motion_x) - one.(motion_x))%float.
Definition uy : single := (other.(motion_y) - one.(motion_y))%float.
Definition uz : single := (other.(motion_z) - one.(motion_z))%float.
Definition approach : single := (dx * ux + dy * uy + dz * uz)%float.
Definition speed : single := (ux * ux + uy * uy + uz * uz + small)%float.
Definition nearest : single := ((- approach) / speed)%float.
Definition radii : single := (other.(ball) + one.(ball))%float.
Definition limit : single := (radii * radii + small)%float.
Definition px (s : single) : single := (dx + ux * s)%float.
Definition py (s : single) : single := (dy + uy * s)%float.
Definition pz (s : single) : single := (dz + uz * s)%float.
Definition square (s : single) : single := (px s * px s + py s * py s + pz s * pz s)%float.

Lemma left_out_parts :
  left_out other one from to =
  if less from nearest then
    if less nearest to then if less limit (square nearest) then true else false
    else if less limit (square to) then true else false
  else
    if less from to then if less limit (square from) then true else false
    else if less limit (square to) then true else false.
Proof.
  cbv beta zeta delta [left_out square px py pz limit radii nearest speed approach dx dy dz ux uy uz].
  match goal with |- ?x = ?y => constr_eq x y end. reflexivity.
Qed.

Lemma left_out_test : left_out other one from to = true ->
  exists s, less limit (square s) = true /\
    ((less from nearest = true /\ less nearest to = true /\ s = nearest) \/
     (less from nearest = true /\ less nearest to = false /\ s = to) \/
     (less from nearest = false /\ less from to = true /\ s = from) \/
     (less from nearest = false /\ less from to = false /\ s = to)).
Proof.
  rewrite left_out_parts.
  destruct (less from nearest) eqn:A.
  - destruct (less nearest to) eqn:C.
    + destruct (less limit (square nearest)) eqn:T; [|discriminate]. exists nearest. split; [exact T|]. left. auto.
    + destruct (less limit (square to)) eqn:T; [|discriminate]. exists to. split; [exact T|]. right; left. auto.
  - destruct (less from to) eqn:C.
    + destruct (less limit (square from)) eqn:T; [|discriminate]. exists from. split; [exact T|]. right; right; left. auto.
    + destruct (less limit (square to)) eqn:T; [|discriminate]. exists to. split; [exact T|]. right; right; right. auto.
Qed.

(* A limit that something is above is finite. *)
Lemma limit_finite (y : single) : less limit y = true -> finite limit.
Proof.
  intros L. destruct limit as [s|[|]| |s m e H] eqn:E; try reflexivity; try discriminate.
  - exfalso. unfold limit in E.
    destruct (is_finite (radii * radii)%float) eqn:F.
    + generalize (Bplus_correct 24 128 _ _ mode_NE (radii * radii)%float small F (proj1 small_value)).
      fold (add (radii * radii)%float small). rewrite E.
      destruct Rlt_bool; intros C; [destruct C as (_ & C & _); discriminate|].
      destruct C as [C S]. apply overflow_to in C. injection C as C. rewrite <- C in S.
      assert (Bsign small = false) as Z by (vm_compute; reflexivity). rewrite Z in S. discriminate.
    + assert (N := square_not_below radii). destruct (radii * radii)%float as [s|[|]| |s m e H]; try discriminate.
      apply N. reflexivity.
  - exfalso. destruct y as [s|[|]| |s m e H]; discriminate.
Qed.

End Search.

(* Numbers that are near to each other. *)
Lemma stored_close (x : single) (X : R) : stored x X -> close x X (Rabs X + low) 100.
Proof. intros [_ E] _. split; [lra|]. generalize (least_pos (emax := 128)). lra. Qed.
Lemma stored_finite (x : single) (X : R) : stored x X -> finite x.
Proof. intros [F _]. exact F. Qed.

(* No sum or product of at most this magnitude overflows. *)
Definition most : R := bpow radix2 128 * (1 - 2 * u).

Lemma most_value : most = 340282326356119256160033759537265639424.
Proof.
  unfold most. rewrite u_value. change (bpow radix2 128) with 340282366920938463463374607431768211456. lra.
Qed.

Lemma fits_small (x : R) : Rabs x <= most -> fits (prec := 24) (emax := 128) x.
Proof.
  rewrite most_value. intros H. unfold fits. rewrite u_value, low_value.
  change (bpow radix2 128) with 340282366920938463463374607431768211456. lra.
Qed.
