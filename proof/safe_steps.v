(* advance_by_safe_steps: if each step that is offered is safe, so is the sum, however many rounds there are. *)
From Coq Require Import ZArith Reals Lra Lia Bool Psatz.
From Flocq Require Import Core BinarySingleNaN.
From Kinesphere Require Import floats inputs kernels rounding infinite sum_down.
Open Scope R_scope.

Section Rounds.

(* What holds, or does not, at the time x after the beginning. *)
Variable apart : R -> Prop.
Variable step : double -> double.

(* A step g at d: all is well from d on, for ever or for the time g. *)
Definition safe_step (d g : double) : Prop :=
  (g = infinity /\ forall x, B d <= x -> apart x) \/
  (finite g /\ 0 <= B g /\ forall x, B d <= x < B d + B g -> apart x).

Hypothesis steps_are_safe : forall d, finite d -> 0 <= B d -> safe_step d (step d).

Variables from until : double.
Hypothesis from_finite : finite from.
Hypothesis until_number : finite until \/ until = infinity.

(* The answer r: all is well from `from` to `until`, or before r. *)
Definition certified (r : double) : Prop :=
  (r = infinity /\ forall t, B from <= t -> (finite until -> t <= B until) -> apart (t - B from)) \/
  (finite r /\ B from <= B r /\ forall t, B from <= t < B r -> apart (t - B from)).

(* What is certain when the sum is d. *)
Definition reached (d : double) : Prop :=
  (finite d /\ 0 <= B d /\ forall x, 0 <= x < B d -> apart x) \/
  (d = infinity /\ forall x, 0 <= x -> apart x) \/ is_nan d = true.

Lemma sum_of_infinity (x : double) : finite x -> sum_down x infinity = infinity.
Proof. destruct x as [s|s| |s m e H]; try discriminate; reflexivity. Qed.

Lemma nan_or_number (x : double) : is_nan x = true \/ finite x \/ x = infinity \/ x = B754_infinity true.
Proof. destruct x as [s|[|]| |s m e H]; auto. Qed.

(* A sum may overflow: then it is no number, or minus infinity if it is negative. *)
Lemma sum_down_cases (x y : double) : finite x -> finite y ->
  is_nan (sum_down x y) = true \/ finite (sum_down x y) \/
  (sum_down x y = B754_infinity true /\ (B (x + y)%float < 0 \/ (x + y)%float = B754_infinity true)).
Proof.
  intros Fx Fy. unfold sum_down.
  assert (infinite x = false) as -> by (destruct x; try discriminate; reflexivity).
  assert (infinite y = false) as -> by (destruct y; try discriminate; reflexivity).
  cbv zeta. destruct (is_finite (x + y)%float) eqn:F.
  2: { destruct (x + y)%float as [s|[|]| |s m e H]; try discriminate F; [right; right|left|left; reflexivity].
       - split; [vm_compute; reflexivity|right; reflexivity].
       - vm_compute. reflexivity. }
  set (t := (x + y)%float) in *.
  assert (finite (magnitude t)) as Fa by (apply magnitude_finite; exact F).
  destruct (scaled_finite (magnitude t) (-52) Fa) as [Fm Sm]; [lia|].
  assert (Bsign (magnitude t) = false) as Sa by (destruct t; try discriminate; reflexivity).
  rewrite Sa in Sm.
  generalize (Bminus_correct 53 1024 _ _ mode_NE t (magnitude t * literal 1 (-52))%float F Fm).
  fold (sub t (magnitude t * literal 1 (-52))%float).
  case Rlt_bool_spec; intros O C; [right; left; tauto|].
  destruct C as [C S]. rewrite Sm in S. simpl in S. rewrite S in C. apply overflow_value in C.
  right; right. split; [exact C|].
  destruct (Rle_lt_or_eq_dec _ _ (sign_of_negative t S)) as [L|Z]; [left; exact L|].
  exfalso. revert O. apply Rlt_not_le.
  apply mul_finite in Fm. destruct Fm as (_ & _ & Em). rewrite Em, magnitude_value, Z, Rabs_R0, Rmult_0_l.
  rewrite rnd_0, Rminus_0_r, round_0, Rabs_R0 by apply valid_rnd_N. apply bpow_gt_0.
Qed.

Lemma sum_nonnegative (x y : double) : finite x -> finite y -> 0 <= B x -> 0 <= B y ->
  is_nan (sum_down x y) = true \/ (finite (sum_down x y) /\ 0 <= B (sum_down x y)).
Proof.
  intros Fx Fy Px Py.
  assert (finite (x + y)%float -> 0 <= B (x + y)%float) as Ps.
  { intros F. apply add_finite in F. destruct F as (_ & _ & ->). apply rnd_nonneg. lra. }
  destruct (sum_down_cases x y Fx Fy) as [N|[F|[E L]]]; [left; exact N| |].
  2: { exfalso. destruct L as [L|L].
       - destruct (is_finite (x + y)%float) eqn:F; [specialize (Ps eq_refl); lra|].
         destruct (x + y)%float; try discriminate; simpl in L; lra.
       - generalize (Bplus_correct 53 1024 _ _ mode_NE x y Fx Fy). fold (add x y). rewrite L.
         case Rlt_bool_spec; intros O C; [destruct C as (_ & C & _); discriminate|].
         destruct C as [C S]. apply overflow_value in C. injection C as C. rewrite <- C in S.
         generalize (sign_of_negative x (eq_sym C)) (sign_of_negative y (eq_sym S)). intros.
         revert O. apply Rlt_not_le. assert (B x + B y = 0) as -> by lra.
         rewrite round_0, Rabs_R0 by apply valid_rnd_N. apply bpow_gt_0. }
  right. split; [exact F|]. revert F. unfold sum_down.
  assert (infinite x = false) as -> by (destruct x; try discriminate; reflexivity).
  assert (infinite y = false) as -> by (destruct y; try discriminate; reflexivity).
  cbv zeta. intros F. apply sub_finite in F. destruct F as (Ft & Fm & ->). specialize (Ps Ft).
  apply rnd_nonneg. apply mul_finite in Fm. destruct Fm as (_ & _ & ->).
  rewrite magnitude_value, (Rabs_pos_eq _ Ps), (proj2 (literal_power (-52) ltac:(lia))).
  assert (rnd64 (B (x + y)%float * bpow radix2 (-52)) <= rnd64 (B (x + y)%float)) as L.
  { apply rnd_le. simpl. lra. }
  rewrite rnd_value in L. lra.
Qed.

Lemma less_nan (x y : double) : is_nan y = true -> less x y = false.
Proof. destruct y; try discriminate. intros _. destruct x as [s|s| |s m e H]; try destruct s; reflexivity. Qed.

Lemma next_sum (d : double) : finite d -> 0 <= B d -> (forall x, 0 <= x < B d -> apart x) ->
  reached (sum_down d (step d)).
Proof.
  intros Fd Pd A. destruct (steps_are_safe d Fd Pd) as [[-> S]|(Fg & Pg & S)].
  - rewrite sum_of_infinity by exact Fd. right; left. split; [reflexivity|].
    intros x Hx. destruct (Rlt_or_le x (B d)); auto.
  - destruct (sum_nonnegative d (step d) Fd Fg Pd Pg) as [N|[F P]]; [right; right; exact N|].
    left. split; [exact F|]. split; [exact P|].
    destruct (sum_down_is_below _ _ F) as (_ & _ & L).
    intros x Hx. destruct (Rlt_or_le x (B d)); [apply A; lra|]. apply S. lra.
Qed.

Lemma goes_on (d g : double) : reached d -> less (d * literal 1 (-24))%float g = true ->
  finite g \/ g = infinity -> finite d /\ 0 <= B d /\ forall x, 0 <= x < B d -> apart x.
Proof.
  intros [R|[[-> _]|N]] L G; [exact R| |].
  - exfalso. revert L. destruct G as [F| ->]; [|vm_compute; discriminate].
    replace (infinity * literal 1 (-24))%float with (infinity (prec := 53) (emax := 1024)) by (vm_compute; reflexivity).
    destruct g as [s|[|]| |[|] m e H]; discriminate.
  - exfalso. destruct d; discriminate.
Qed.

Lemma gain_is_number (d : double) : finite d -> 0 <= B d -> finite (step d) \/ step d = infinity.
Proof. intros F P. destruct (steps_are_safe d F P) as [[E _]|[E _]]; auto. Qed.

Lemma beyond (d : double) : reached d -> less until (sum_down from d) = true -> certified infinity.
Proof.
  intros R L. left. split; [reflexivity|]. intros t Ht Hu.
  destruct R as [(F & P & A)|[[-> A]|N]].
  - destruct (sum_down_cases from d from_finite F) as [N|[Fs|[E _]]].
    { exfalso. rewrite (less_nan until _ N) in L. discriminate. }
    2: { exfalso. rewrite E in L. destruct until as [s|s| |s m e H]; try discriminate; destruct s; discriminate. }
    destruct until_number as [U| ->].
    2: { exfalso. destruct (sum_down from d) as [s|s| |s m e H]; try discriminate; destruct s; discriminate. }
    apply less_true in L; [|assumption|assumption].
    destruct (sum_down_is_below _ _ Fs) as (_ & _ & B1). specialize (Hu U). apply A. lra.
  - apply A. lra.
  - exfalso. assert (is_nan (sum_down from d) = true) as Q.
    { destruct d; try discriminate. destruct from; try discriminate; reflexivity. }
    destruct (sum_down from d); try discriminate.
    destruct until as [s|s| |s m e H]; try discriminate; destruct s; discriminate.
Qed.

Lemma ends (d : double) : reached d ->
  certified (if less from (sum_down from d) then sum_down from d else from).
Proof.
  intros R. destruct (less from (sum_down from d)) eqn:L.
  2: { right. split; [exact from_finite|]. split; [lra|]. intros t Ht. lra. }
  destruct R as [(F & P & A)|[[-> A]|N]].
  - destruct (sum_down_cases from d from_finite F) as [N|[Fs|[E _]]].
    { exfalso. rewrite (less_nan from _ N) in L. discriminate. }
    2: { exfalso. rewrite E in L. destruct from as [s|s| |s m e H]; try discriminate; destruct s; discriminate. }
    right. split; [exact Fs|]. apply less_true in L; [|assumption|assumption].
    split; [lra|]. destruct (sum_down_is_below _ _ Fs) as (_ & _ & B1). intros t Ht. apply A. lra.
  - rewrite sum_of_infinity by exact from_finite. left. split; [reflexivity|]. intros t Ht _. apply A. lra.
  - exfalso. assert (is_nan (sum_down from d) = true) as Q.
    { destruct d; try discriminate. destruct from; try discriminate; reflexivity. }
    destruct (sum_down from d); try discriminate.
    destruct from as [s|s| |s m e H]; try discriminate; destruct s; discriminate.
Qed.

Lemma beyond_at (d t : double) : t = sum_down from d -> reached d -> less until t = true -> certified infinity.
Proof. intros ->. apply beyond. Qed.
Lemma ends_at (d t : double) : t = sum_down from d -> reached d -> certified (if less from t then t else from).
Proof. intros ->. apply ends. Qed.

(* One round. Each number gets a name, or terms would double with each round. *)
Ltac round_of R :=
  let F := fresh "F" in let P := fresh "P" in let A := fresh "A" in let S := fresh "S" in
  let L := fresh "L" in let g := fresh "g" in let s := fresh "s" in let t := fresh "t" in
  let Eg := fresh "Eg" in let Es := fresh "Es" in let Et := fresh "Et" in let G := fresh "G" in
  destruct R as (F & P & A);
  match goal with |- certified (let x := ?e in @?rest x) =>
    remember e as g eqn:Eg; change (certified (rest g)); cbv beta end;
  match goal with |- certified (let x := ?e in @?rest x) =>
    remember e as s eqn:Es; change (certified (rest s)); cbv beta end;
  match goal with |- certified (let x := ?e in @?rest x) =>
    remember e as t eqn:Et; change (certified (rest t)); cbv beta end;
  match type of Eg with _ = step ?d =>
    assert (S : reached s) by (rewrite Es, Eg; apply (next_sum d F P A));
    assert (G : finite g \/ g = infinity) by (rewrite Eg; exact (gain_is_number d F P)) end;
  match goal with |- certified (if ?c then _ else _) => destruct c eqn:L end;
  [exact (beyond_at s t Et S L)|clear L];
  match goal with |- certified (if ?c then _ else _) => destruct c eqn:L end;
  [lazymatch goal with
   | |- certified (let x := _ in _) => generalize (goes_on s g S L G); clear F P A S L G Et Es Eg; intros R
   | _ => exact (ends_at s t Et S) end
  |exact (ends_at s t Et S)].

Theorem advance_by_safe_steps_is_early : certified (advance_by_safe_steps step from until).
Proof.
  cbv beta delta [advance_by_safe_steps].
  assert (finite (literal (prec := 53) (emax := 1024) 0 0) /\ 0 <= B (literal 0 0) /\
          forall x, 0 <= x < B (literal 0 0) -> apart x) as R0.
  { rewrite (proj2 literal_0). split; [exact (proj1 literal_0)|]. split; [lra|]. intros x Hx. lra. }
  set (d0 := literal 0 0) in *. clearbody d0.
  do 16 round_of R0.
Qed.
End Rounds.
