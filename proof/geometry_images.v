(* Periodic space: the image in which two bodies can meet (Lemma 6). *)
From Coq Require Import ZArith Reals Lra Lia.
Open Scope R_scope.

(* On an axis with the period L: for the way w that has been found from the middle of one box to that of the other, the
   other body's image with this many periods added is named. *)
Definition named_image (L w : R) : Z :=
  if Rlt_dec (L / 2) w then (-1)%Z else if Rlt_dec w (- (L / 2)) then 1%Z else 0%Z.

(* The middles ma and mb of the two boxes are both in the primary box, and the way between them is found to within
   L/1024. Each box is narrower, on the axis, than (1/2 - 1/1024) L - h - 4 e for the position error e of its body. If,
   with k periods added to the second, a point of the first box is within h + 2 ea + 2 eb of one of the second, then k
   is the image that is named. Of boxes that overlap that is so with the same point in both; and of bodies that touch,
   or are within a sensor distance, with the points of both boxes that are nearest to the other body. *)
Theorem image_in_which_two_meet_is_named (L lower ma mb found wa wb h ea eb x y : R) (k : Z) :
  lower <= ma < lower + L -> lower <= mb < lower + L -> Rabs (found - (mb - ma)) < L / 1024 ->
  0 <= h -> 0 <= ea -> 0 <= eb ->
  wa < (/ 2 - / 1024) * L - h - 4 * ea -> wb < (/ 2 - / 1024) * L - h - 4 * eb ->
  Rabs (x - ma) <= wa / 2 -> Rabs (y - mb) <= wb / 2 -> Rabs (x - (y + IZR k * L)) <= h + 2 * ea + 2 * eb ->
  k = named_image L found.
Proof.
  intros Ha Hb Hf Hh Hea Heb Wa Wb Hx Hy Hk.
  assert (forall z b, Rabs z <= b -> - b <= z <= b) as U.
  { intros z b H. generalize (Rle_abs z) (Rle_abs (- z)). rewrite Rabs_Ropp. lra. }
  apply U in Hx. apply U in Hy. apply U in Hk. apply Rabs_def2 in Hf. clear U.
  assert (- (/ 2 - / 1024) * L < mb - ma + IZR k * L < (/ 2 - / 1024) * L) as M by lra.
  assert (- 2 < IZR k < 2) as K by (split; apply Rmult_lt_reg_r with L; lra).
  assert ((-2 < k < 2)%Z) as K' by (split; apply lt_IZR; lra).
  assert (k = (-1)%Z \/ k = 0%Z \/ k = 1%Z) as [->|[->| ->]] by lia; unfold named_image;
    repeat destruct Rlt_dec; reflexivity || (exfalso; lra).
Qed.
