(* The grid of a level: a search reads the cell of every swept sphere with corners that meet its own (Lemma 10). *)
From Coq Require Import ZArith Reals Lra Lia.
From Flocq Require Import Core.
Open Scope R_scope.

(* Numbers of cells are cut off at these. *)
Definition most_cells : Z := 2 ^ 29.
Definition cut (k : Z) : Z := Z.max (- most_cells) (Z.min k most_cells).
(* The cell of the coordinate x, counted in edges of cells. *)
Definition cell_of (x : R) : Z := cut (Zfloor x).

(* On an axis the grid has the cells first0 to first0 + count - 1. Where it is folded, each stands also for those that
   differ from it by a multiple of count. This is the place of a cell in the grid. *)
Definition place_in_grid (first0 count cell : Z) : Z := ((cell - first0) mod count)%Z.

(* The places that a search from the cell `first` to the cell `last` reads. *)
Definition looks_at (folded : bool) (first0 count first last place : Z) : Prop :=
  if folded then
    if (last - first + 1 <? count)%Z then
      exists k, (0 <= k < last - first + 1)%Z /\ place = ((place_in_grid first0 count first + k) mod count)%Z
    else (0 <= place < count)%Z
  else (Z.max (first - first0) 0 <= place < Z.min (last - first0 + 1) count)%Z.

Lemma cell_between (first last i : Z) (lo hi : R) :
  (- most_cells <= i <= most_cells)%Z -> first = cell_of lo -> last = cell_of hi ->
  lo < IZR i + 1 -> IZR i <= hi -> (first <= i <= last)%Z.
Proof.
  intros Hi -> -> L H. unfold cell_of, cut.
  assert (Zfloor lo <= i)%Z.
  { assert (IZR (Zfloor lo) < IZR (i + 1)) as W by (rewrite plus_IZR; generalize (Zfloor_lb lo); lra).
    apply lt_IZR in W. lia. }
  assert (i <= Zfloor hi)%Z by (apply Zfloor_lub; exact H). lia.
Qed.

(* Lemma 10, on one axis. A swept sphere stands in the cell i, in the representative from which its looseness is
   measured: its corners [p1, p2] reach out of it by no more than the reach. The corners of the search are [q1, q2], and
   with the reach added, counted in edges, they are computed as lo and hi: less, and not less, than they are for the
   part of the search that counts. If the two have a point in common, the search reads the place of i. On an axis that
   is not folded, i is one of the existing cells. *)
Theorem search_looks_at_the_cell (folded : bool) (first0 count i : Z) (edge reach p1 p2 q1 q2 lo hi point : R) :
  0 < edge -> (0 < count)%Z -> (- most_cells <= i <= most_cells)%Z ->
  (folded = false -> (first0 <= i < first0 + count)%Z) ->
  IZR i * edge - reach <= p1 -> p2 <= (IZR i + 1) * edge + reach ->
  lo * edge < q1 - reach -> q2 + reach <= hi * edge ->
  p1 <= point <= p2 -> q1 <= point <= q2 ->
  looks_at folded first0 count (cell_of lo) (cell_of hi) (place_in_grid first0 count i).
Proof.
  intros He Hc Hi Hf P1 P2 L H Hp Hq.
  assert (lo < IZR i + 1) as L' by (apply Rmult_lt_reg_r with edge; lra).
  assert (IZR i <= hi) as H' by (apply Rmult_le_reg_r with edge; lra).
  generalize (cell_between _ _ i lo hi Hi eq_refl eq_refl L' H'). clear - Hc Hf.
  generalize (cell_of lo) (cell_of hi). intros first last B. unfold looks_at, place_in_grid.
  destruct folded.
  - destruct Z.ltb eqn:E; [|apply Z.mod_pos_bound; exact Hc].
    exists (i - first)%Z. split; [lia|]. rewrite Zplus_mod_idemp_l. f_equal. ring.
  - specialize (Hf eq_refl). rewrite Z.mod_small by lia. lia.
Qed.
