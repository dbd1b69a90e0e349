(* The core keeps its invariants (H, N and D of src/core/core.hpp), and so no sequence of its steps lets time pass a begin
   or an end of a contact that the contact graph does not know of. *)
From Coq Require Import Reals Lra Lia Bool Arith Classical.
From Kinesphere Require Import core_machine.
Open Scope R_scope.

(* Splits on whether body x is the changed body a. *)
Ltac at_ball x a := unfold put in *; destruct (Nat.eqb_spec x a); [subst|]; simpl in *.

Section Keeps.
Context {W : World} {L : Lemmas W}.

Definition right_at (s : state) (a b : body) (t : R) : Prop :=
  ~ wrong (graph s a b) (motion_of s a) (motion_of s b) t.
Definition right_until (s : state) (a b : body) (u : until) : Prop :=
  forall t, now s <= t -> before t u -> right_at s a b t.

Record keeps (s : state) : Prop := {
  bounds_hold : forall a p, known (balls s a) = Some p -> keeps_to (motion_of s a) p (now s);
  due_in_time : forall a, clean s a ->
    no_later (due (balls s a)) (second (balls s a)) /\ no_later (second (balls s a)) (own (balls s a));
  (* H *)
  lies_in_its_region : forall a t, clean s a -> now s <= t -> before t (own (balls s a)) ->
    lies_in (motion_of s a) t (held (balls s a));
  meets_no_wall : forall a, clean s a -> news s a a \/
    forall t, now s <= t -> before t (own (balls s a)) -> ~ wrong_at_walls (graph s a a) (motion_of s a) t;
  (* N *)
  neighbours_are_listed : forall a b, (a < b)%nat -> clean s a -> clean s b ->
    listed s a b \/ out_of_reach (held (balls s a)) (held (balls s b)) \/ strangers (motion_of s a) (motion_of s b);
  (* D *)
  one_is_due_in_time : forall a b, (a < b)%nat -> clean s a -> clean s b -> concerned s a b ->
    news s a b \/ (right_until s a b (sure s a b) /\ one_is_due s a b);
  past_is_right : nothing_missed s;
  past_is_past : (forall a t e, lived s a t e -> t < now s) /\ (forall a b t r, stood s a b t r -> t < now s)
}.

Lemma no_later_trans u v w : no_later u v -> no_later v w -> no_later u w.
Proof. unfold no_later. auto. Qed.
Lemma no_later_refl u : no_later u u.
Proof. unfold no_later. auto. Qed.

Lemma answers_later k b : no_later (due k) (second k) -> no_later (due k) (answers_until k b).
Proof. unfold answers_until. destruct (is_about k b); [intros _; apply no_later_refl|trivial]. Qed.

(* A certified pair has what D asks for. *)
Lemma certified_is_right s a b :
  (forall x p, known (balls s x) = Some p -> keeps_to (motion_of s x) p (now s)) ->
  certified s a b -> right_until s a b (sure s a b) /\ one_is_due s a b.
Proof.
  intros B [(p & q & Kp & Kq & Ce) E]. split; [|exact E]. intros t Nt Bt. eapply certificates_are_early; eauto.
Qed.

(* What a pair that nobody looks at relies upon. *)
Lemma unlisted_is_right s a b t :
  keeps s -> (a < b)%nat -> clean s a -> clean s b -> ~ listed s a b -> graph s a b = apart ->
  now s <= t -> before t (own (balls s a)) -> before t (own (balls s b)) -> right_at s a b t.
Proof.
  intros K Lt Ca Cb Nl A Nt Ba Bb. unfold right_at. rewrite A.
  destruct (neighbours_are_listed _ K a b Lt Ca Cb) as [H|[H|H]]; [contradiction| |apply strangers_never_meet; exact H].
  eapply searches_are_complete; [exact H| |]; apply (lies_in_its_region _ K); assumption.
Qed.

(* After a step that makes one ball dirty or removes it, and changes no pairs but its own. *)
Lemma changed_keeps s a th di k r n :
  keeps s -> (th = true -> di = true) ->
  (forall p, k = Some p -> keeps_to (a, S (revision (balls s a))) p (now s)) ->
  same_but_of a r (graph s) -> same_but_of a n (news s) ->
  keeps (set_balls (put s a (changed (balls s a) th di k)) (set_pairs r n (sure s) s)).
Proof.
  intros K Td Kn Gr Ne. destruct K as [B T H M N D P Pp].
  assert (Nc : forall x, clean (set_balls (put s a (changed (balls s a) th di k)) (set_pairs r n (sure s) s)) x ->
                 x <> a /\ clean s x).
  { intros x [Tx Dx]. simpl in *. at_ball x a; [rewrite Td in Dx by exact Tx; discriminate|]. split; [assumption|split; assumption]. }
  assert (E : forall x, x <> a -> put s a (changed (balls s a) th di k) x = balls s x).
  { intros x X. unfold put. apply Nat.eqb_neq in X. rewrite X. reflexivity. }
  split; simpl.
  - intros x p. unfold motion_of; simpl. at_ball x a; [apply Kn|]. apply B.
  - intros x C. destruct (Nc x C) as [X C']. rewrite E by exact X. apply T; exact C'.
  - intros x t C Nt Bt. destruct (Nc x C) as [X C']. unfold motion_of; simpl. rewrite E in * by exact X. apply H; assumption.
  - intros x C. destruct (Nc x C) as [X C']. unfold motion_of; simpl. rewrite E, Ne, Gr by exact X. apply M; exact C'.
  - intros x y Lt Cx Cy. destruct (Nc x Cx) as [X Cx'], (Nc y Cy) as [Y Cy']. unfold motion_of; simpl.
    rewrite !E by assumption. apply N; assumption.
  - intros x y Lt Cx Cy. destruct (Nc x Cx) as [X Cx'], (Nc y Cy) as [Y Cy']. unfold concerned; simpl.
    rewrite Ne, Gr by assumption. intros Co. destruct (D x y Lt Cx' Cy' Co) as [F|[F I]]; [left; exact F|right]. split.
    + intros t Nt Bt. unfold right_at, motion_of. simpl. rewrite !E, Gr by assumption. apply F; assumption.
    + unfold one_is_due in *. simpl in *. rewrite (E x X), (E y Y) in *. exact I.
  - exact P.
  - exact Pp.
Qed.

Lemma step_keeps s s' : step s s' -> keeps s -> keeps s'.
Proof.
  intros St K. destruct St as
    [s a p Ob | s a k r n Kn G Ne Oe | s a r n G Ne Oe
    | s set f l n v s' Fx Fs Fl Ho Nb Dd | s a b ka kb r n v Lt Pa Pb G Ne Sv Oe s' Ce
    | s a b r Le Nw G | s a b n Le Nc Ne | s t Nt Cl Ns Du].
  - (* report *)
    destruct K as [B T H M N D P Pp].
    assert (E : forall x, let k := put s a (with_known (balls s a) (Some p)) x in
              there k = there (balls s x) /\ revision k = revision (balls s x) /\ dirty k = dirty (balls s x) /\
              held k = held (balls s x) /\ own k = own (balls s x) /\ due k = due (balls s x) /\
              second k = second (balls s x) /\ about k = about (balls s x)).
    { intros x. simpl. unfold put. destruct (Nat.eqb_spec x a); subst; repeat split. }
    assert (Ec : forall x, clean (set_balls (put s a (with_known (balls s a) (Some p))) s) x -> clean s x).
    { intros x. unfold clean. simpl. destruct (E x) as (-> & _ & -> & _). trivial. }
    assert (Em : forall x, motion_of (set_balls (put s a (with_known (balls s a) (Some p))) s) x = motion_of s x).
    { intros x. unfold motion_of. simpl. destruct (E x) as (_ & -> & _). reflexivity. }
    assert (Ea : forall x y, answers_until (put s a (with_known (balls s a) (Some p)) x) y = answers_until (balls s x) y).
    { intros x y. unfold answers_until, is_about. destruct (E x) as (_ & _ & _ & _ & _ & -> & -> & ->). reflexivity. }
    split; simpl.
    + intros x q. rewrite Em. at_ball x a; [intros [= <-]; exact Ob|apply B].
    + intros x C. destruct (E x) as (_ & _ & _ & _ & -> & -> & -> & _). apply T, Ec, C.
    + intros x t C. rewrite Em. destruct (E x) as (_ & _ & _ & -> & -> & _). apply H, Ec, C.
    + intros x C. rewrite Em. destruct (E x) as (_ & _ & _ & _ & -> & _). apply M, Ec, C.
    + intros x y Lt Cx Cy. rewrite !Em. destruct (E x) as (_ & _ & _ & -> & _), (E y) as (_ & _ & _ & -> & _).
      apply N; [exact Lt|apply Ec, Cx|apply Ec, Cy].
    + intros x y Lt Cx Cy Co. unfold one_is_due, right_until, right_at. simpl. rewrite !Ea.
      destruct (E x) as (_ & _ & _ & _ & -> & _), (E y) as (_ & _ & _ & _ & -> & _). setoid_rewrite Em. apply D; [exact Lt|apply Ec, Cx|apply Ec, Cy|exact Co].
    + exact P.
    + exact Pp.
  - apply changed_keeps; trivial; auto.
  - apply changed_keeps; trivial; try discriminate.
  - (* settle *)
    destruct K as [B T H M N D P Pp].
    assert (Em : forall x, motion_of s' x = motion_of s x).
    { intros x. unfold motion_of, s'. simpl. destruct (set x) eqn:S; [destruct (Fs x S) as (_ & -> & _); reflexivity|].
      rewrite (Fx x S). reflexivity. }
    assert (Ec : forall x, set x = false -> clean s' x -> clean s x).
    { intros x S. unfold clean, s'. simpl. rewrite (Fx x S). trivial. }
    assert (B' : forall x p, known (balls s' x) = Some p -> keeps_to (motion_of s' x) p (now s')).
    { intros x p. rewrite Em. unfold s'. simpl. destruct (set x) eqn:S.
      - destruct (Fs x S) as (_ & _ & ->). apply B.
      - rewrite (Fx x S). apply B. }
    assert (T' : forall x, clean s' x ->
      no_later (due (balls s' x)) (second (balls s' x)) /\ no_later (second (balls s' x)) (own (balls s' x))).
    { intros x C. destruct (set x) eqn:S.
      - destruct (Ho x S C) as (Q1 & Q2 & _). split; assumption.
      - unfold s'. simpl. rewrite (Fx x S). apply T, Ec; assumption. }
    split.
    + exact B'.
    + exact T'.
    + intros x t C Nt Bt. destruct (set x) eqn:S.
      * destruct (Ho x S C) as (_ & _ & p & u & Kp & Sy & Ou & _). unfold s' in *. simpl in *.
        eapply regions_hold; [exact Sy|apply (B' x p); exact Kp|exact Nt|apply Ou; exact Bt].
      * rewrite Em. unfold s' in *. simpl in *. rewrite (Fx x S) in *. apply H; trivial. apply Ec; assumption.
    + intros x C. destruct (set x) eqn:S.
      * destruct (Ho x S C) as (_ & _ & p & u & Kp & _ & _ & [Q|(w & Cw & Ov)]); [left; exact Q|right].
        intros t Nt Bt. unfold s' in *. simpl in *.
        eapply walls_are_clear; [exact Cw|apply (B' x p); exact Kp|exact Nt|apply Ov; exact Bt].
      * rewrite Em. unfold s' in *. simpl in *. destruct (Fl x x S S) as (_ & -> & _). rewrite (Fx x S) in *.
        apply M, Ec; assumption.
    + intros x y Lt Cx Cy. rewrite !Em. destruct (set x || set y) eqn:S.
      * apply orb_true_iff in S. unfold s'. simpl. apply Nb; assumption.
      * apply orb_false_iff in S. destruct S as [Sx Sy]. unfold s'. simpl. destruct (Fl x y Sx Sy) as (-> & _).
        rewrite (Fx x Sx), (Fx y Sy). apply N; trivial; apply Ec; assumption.
    + intros x y Lt Cx Cy Co. destruct (set x || set y) eqn:S.
      * apply orb_true_iff in S. destruct (Dd x y Lt S Cx Cy Co) as [Q|[Q|Q]]; [left; exact Q|right|right].
        { apply certified_is_right; assumption. }
        destruct Q as (Cx' & Cy' & Co' & Nn & Es & I). split; [|exact I].
        destruct (D x y Lt Cx' Cy' Co') as [Q|[Q _]]; [contradiction|].
        rewrite Es. unfold right_until, right_at. rewrite !Em. exact Q.
      * apply orb_false_iff in S. destruct S as [Sx Sy]. revert Co. unfold concerned, one_is_due, right_until, right_at. rewrite !Em. unfold s'. simpl.
        destruct (Fl x y Sx Sy) as (-> & -> & ->). rewrite (Fx x Sx), (Fx y Sy). apply D; trivial; apply Ec; assumption.
    + exact P.
    + exact Pp.
  - (* recheck *)
    destruct K as [B T H M N D P Pp].
    assert (F : forall k k' c, postponed k k' c -> (no_later (due k) (second k)) ->
              there k' = there k /\ revision k' = revision k /\ dirty k' = dirty k /\ known k' = known k /\
              held k' = held k /\ own k' = own k /\ second k' = second k /\ no_later (due k') (second k') /\
              forall d, d <> c -> answers_until k' d = answers_until k d).
    { intros k k' c [->|(A & u & m & -> & Q)] Dk; [repeat split; trivial|]. simpl. repeat (split; [reflexivity|]). split.
      - destruct Q as [[_ Q]|[_ ->]]; [exact Q|apply no_later_refl].
      - intros d X. unfold answers_until, is_about in *. simpl. destruct (about k) as [e|]; [|discriminate].
        apply Nat.eqb_eq in A. subst e. assert (X' : (c =? d) = false) by (apply Nat.eqb_neq; congruence). rewrite X'.
        destruct Q as [[-> _]|[-> _]]; [rewrite X'|]; reflexivity. }
    assert (E : forall x, let k := balls s' x in
              there k = there (balls s x) /\ revision k = revision (balls s x) /\ dirty k = dirty (balls s x) /\
              known k = known (balls s x) /\ held k = held (balls s x) /\ own k = own (balls s x) /\
              second k = second (balls s x)).
    { intros x. unfold s'. simpl. destruct (Nat.eqb_spec x a) as [->|]; [|destruct (Nat.eqb_spec x b) as [->|]; [|repeat split]].
      - destruct Pa as [->|(_ & u & m & -> & _)]; repeat split.
      - destruct Pb as [->|(_ & u & m & -> & _)]; repeat split. }
    assert (Ec : forall x, clean s' x -> clean s x).
    { intros x. unfold clean. destruct (E x) as (-> & _ & -> & _). trivial. }
    assert (Em : forall x, motion_of s' x = motion_of s x).
    { intros x. unfold motion_of. destruct (E x) as (_ & -> & _). reflexivity. }
    assert (B' : forall x p, known (balls s' x) = Some p -> keeps_to (motion_of s' x) p (now s')).
    { intros x p. rewrite Em. destruct (E x) as (_ & _ & _ & -> & _). apply B. }
    assert (T' : forall x, clean s' x ->
      no_later (due (balls s' x)) (second (balls s' x)) /\ no_later (second (balls s' x)) (own (balls s' x))).
    { intros x C. destruct (T x (Ec x C)) as [Q1 Q2]. destruct (E x) as (_ & _ & _ & _ & _ & -> & Es).
      split; [|rewrite Es; exact Q2]. unfold s'. simpl.
      destruct (Nat.eqb_spec x a) as [->|]; [|destruct (Nat.eqb_spec x b) as [->|]; [|exact Q1]].
      - apply (F _ _ _ Pa Q1).
      - apply (F _ _ _ Pb Q1). }
    assert (Ea : forall x y, clean s' x -> ~ (x = a /\ y = b) -> ~ (x = b /\ y = a) ->
              answers_until (balls s' x) y = answers_until (balls s x) y).
    { intros x y C N1 N2. destruct (T x (Ec x C)) as [Q1 _]. unfold s'. simpl.
      destruct (Nat.eqb_spec x a) as [->|]; [|destruct (Nat.eqb_spec x b) as [->|]; [|reflexivity]].
      - apply (F _ _ _ Pa Q1). tauto.
      - apply (F _ _ _ Pb Q1). tauto. }
    assert (Wl : forall x, graph s' x x = graph s x x /\ news s' x x = news s x x).
    { intros x. unfold s'. simpl. rewrite G, Ne by lia. split; reflexivity. }
    split.
    + exact B'.
    + exact T'.
    + intros x t C. rewrite Em. destruct (E x) as (_ & _ & _ & _ & -> & -> & _). apply H, Ec, C.
    + intros x C. rewrite Em. destruct (Wl x) as [-> ->]. destruct (E x) as (_ & _ & _ & _ & _ & -> & _). apply M, Ec, C.
    + intros x y Lxy Cx Cy. rewrite !Em. destruct (E x) as (_ & _ & _ & _ & -> & _), (E y) as (_ & _ & _ & _ & -> & _).
      apply N; [exact Lxy|apply Ec, Cx|apply Ec, Cy].
    + intros x y Lxy Cx Cy Co.
      destruct (Nat.eq_dec x a) as [Ex|Nx], (Nat.eq_dec y b) as [Ey|Ny].
      { subst x y. destruct Ce as [Q|Q]; [left; exact Q|right; apply certified_is_right; assumption]. }
      all: assert (Np : ~ (x = a /\ y = b)) by tauto.
      all: assert (Ax : answers_until (balls s' x) y = answers_until (balls s x) y) by (apply Ea; [exact Cx|tauto|lia]).
      all: assert (Ay : answers_until (balls s' y) x = answers_until (balls s y) x) by (apply Ea; [exact Cy|lia|tauto]).
      all: revert Co; unfold concerned, one_is_due, right_until, right_at; rewrite Ax, Ay, !Em;
           destruct (E x) as (_ & _ & _ & _ & _ & -> & _), (E y) as (_ & _ & _ & _ & _ & -> & _); unfold s'; simpl;
           rewrite G, Ne, Sv by exact Np; intros Co; apply D; trivial; apply Ec; assumption.
    + exact P.
    + exact Pp.
  - (* deliver *)
    destruct K as [B T H M N D P Pp]. split; simpl; try assumption.
    + intros x C. destruct (Nat.eq_dec x a) as [Ex|Nx], (Nat.eq_dec x b) as [Ey|Ny].
      { left. subst a b. exact Nw. }
      all: rewrite G by tauto; apply M; exact C.
    + intros x y Lxy Cx Cy Co. destruct (Nat.eq_dec x a) as [Ex|Nx], (Nat.eq_dec y b) as [Ey|Ny].
      { left. subst x y. exact Nw. }
      all: assert (Np : ~ (x = a /\ y = b)) by tauto; revert Co; unfold concerned, one_is_due, right_until, right_at; simpl;
           rewrite G by exact Np; intros Co; apply D; trivial.
  - (* drop_news *)
    destruct K as [B T H M N D P Pp]. split; simpl; try assumption.
    + intros x C. rewrite Ne; [apply M; exact C|]. intros [<- <-]. apply Nc. split; exact C.
    + intros x y Lxy Cx Cy Co. rewrite Ne; [apply D; assumption|]. intros [<- <-]. apply Nc. split; assumption.
  - (* advance *)
    destruct K as [B T H M N D P Pp].
    assert (Later : forall a u, clean s a -> now s <= u < t -> before u (due (balls s a)) /\ before u (own (balls s a))).
    { intros a u C U. assert (Bd : before u (due (balls s a))).
      { generalize (Du a C). destruct (due (balls s a)); simpl; [lra|trivial]. }
      split; [exact Bd|]. destruct (T a C) as [Q1 Q2]. apply Q2, Q1, Bd. }
    assert (Right : forall a b u, (a < b)%nat -> clean s a -> clean s b -> now s <= u < t -> right_at s a b u).
    { intros a b u Lt Ca Cb U. destruct (Later a u Ca U) as [Da Oa], (Later b u Cb U) as [Db Ob].
      destruct (classic (concerned s a b)) as [Co|Co].
      - destruct (T a Ca) as [Qa _], (T b Cb) as [Qb _]. destruct (D a b Lt Ca Cb Co) as [F|[F I]].
        + elim (Ns a b ltac:(lia) Ca Cb F).
        + apply F; [lra|]. destruct I as [I|[I|[I|I]]]; apply I; trivial; apply answers_later; assumption.
      - unfold concerned in Co. apply unlisted_is_right; trivial; try lra.
        + split; assumption.
        + tauto.
        + apply NNPP. tauto. }
    split; simpl; try assumption.
    + intros a p Kp. eapply bounds_last; [apply B; exact Kp|exact Nt].
    + intros a u C Nu. apply H; [exact C|lra].
    + intros a C. destruct (M a C) as [Q|Q]; [left; exact Q|right]. intros u Nu. apply Q. lra.
    + intros a b Lt Ca Cb Co. destruct (D a b Lt Ca Cb Co) as [F|[F I]]; [left; exact F|right]. split; [|exact I].
      intros u Nu. apply F. simpl in Nu. lra.
    + destruct P as [P1 P2]. split; simpl.
      * intros a b u e f r Lt [Ha|(Ta & Ua & ->)] [Hb|(Tb & Ub & ->)] [Hr|[Ur ->]].
        { eapply P1; eassumption. }
        all: try (generalize (proj1 Pp _ _ _ Ha); lra); try (generalize (proj1 Pp _ _ _ Hb); lra);
             try (generalize (proj2 Pp _ _ _ _ Hr); lra).
        apply Right; trivial; split; auto.
      * intros a u e r [Ha|(Ta & Ua & ->)] [Hr|[Ur ->]].
        { eapply P2; eassumption. }
        all: try (generalize (proj1 Pp _ _ _ Ha); lra); try (generalize (proj2 Pp _ _ _ _ Hr); lra).
        assert (C : clean s a) by (split; auto). destruct (M a C) as [Q|Q]; [elim (Ns a a (le_n a) C C Q)|].
        apply Q; [lra|]. apply Later; [exact C|exact Ua].
    + destruct Pp as [P1 P2]. split.
      * intros a u e [Ha|(_ & U & _)]; [apply P1 in Ha; lra|lra].
      * intros a b u r [Ha|[U _]]; [apply P2 in Ha; lra|lra].
Qed.

Lemma empty_keeps s : empty s -> keeps s.
Proof.
  intros (Th & Gr & Lv & St).
  assert (Nc : forall a, ~ clean s a) by (intros a [T _]; destruct (Th a); congruence).
  split; try (intros a *; elim (Nc a); assumption); try (intros a b Lt C; elim (Nc a C)).
  - intros a p Q. destruct (Th a). congruence.
  - intros a C. elim (Nc a C).
  - intros a t C. elim (Nc a C).
  - intros a C. elim (Nc a C).
  - split; [intros a b t e f r _ H; elim (Lv _ _ _ H)|intros a t e r H; elim (Lv _ _ _ H)].
  - split; [intros a t e H; elim (Lv _ _ _ H)|intros a b t r H; elim (St _ _ _ _ H)].
Qed.

(* Who looks out for whom: of two, the one that has changed last, by counts of changes; of two with the same count, as
   those that change together may have, the one with the higher number. *)
Definition looks_out (count : body -> nat) (a b : body) : Prop :=
  (count b < count a)%nat \/ (count a = count b /\ (b < a)%nat).
Definition pair_of (P : body -> body -> Prop) (a b : body) : Prop := P (Nat.min a b) (Nat.max a b).

(* It is enough for D that each ball of the set scans those that it looks out for. Balls that have changed (`noted`) count
   as later than their neighbours outside of the set; of the others, whoever looks out for them answers as before. *)
Theorem scans_by_counts_are_enough s s' (set noted : body -> bool) count :
  (forall a b, noted a = true -> set b = false -> pair_of (concerned s') a b -> (count b < count a)%nat) ->
  (forall a b, set a = true -> pair_of (concerned s') a b -> looks_out count a b ->
     pair_of (fun a b => news s' a b \/ certified s' a b) a b) ->
  (forall a b, set a = true -> noted a = false -> set b = false -> pair_of (concerned s') a b -> looks_out count b a ->
     pair_of (keep_certificate s s') a b) ->
  forall a b, (a < b)%nat -> set a = true \/ set b = true -> concerned s' a b ->
  news s' a b \/ certified s' a b \/ keep_certificate s s' a b.
Proof.
  intros Last Scan Kept.
  assert (One : forall a b, a <> b -> set a = true -> pair_of (concerned s') a b ->
    pair_of (fun a b => news s' a b \/ certified s' a b \/ keep_certificate s s' a b) a b).
  { intros a b Ne Sa Co. assert (Or : looks_out count a b \/ looks_out count b a) by (unfold looks_out; lia).
    destruct Or as [Lo|Lo]; [destruct (Scan a b Sa Co Lo); unfold pair_of; tauto|].
    destruct (set b) eqn:Sb.
    - assert (Co' : pair_of (concerned s') b a) by (unfold pair_of; rewrite Nat.min_comm, Nat.max_comm; exact Co).
      generalize (Scan b a Sb Co' Lo). unfold pair_of. rewrite Nat.min_comm, Nat.max_comm. tauto.
    - destruct (noted a) eqn:No; [generalize (Last a b No Sb Co); unfold looks_out in Lo; lia|].
      right. right. exact (Kept a b Sa No Sb Co Lo). }
  intros a b Lt S Co. assert (Mi : Nat.min a b = a) by lia. assert (Ma : Nat.max a b = b) by lia.
  destruct S as [S|S].
  - generalize (One a b ltac:(lia) S). unfold pair_of. rewrite Mi, Ma. tauto.
  - generalize (One b a ltac:(lia) S). unfold pair_of. rewrite (Nat.min_comm b), (Nat.max_comm b), Mi, Ma. tauto.
Qed.

(* H, N and D hold in each reachable state. *)
Theorem core_keeps_its_invariants s : reachable s -> keeps s.
Proof. induction 1; [apply empty_keeps; assumption|eapply step_keeps; eauto]. Qed.

(* At no past time was the contact graph wrong about a pair, or about a body and the walls. *)
Theorem core_misses_nothing s : reachable s -> nothing_missed s.
Proof. intros R. apply past_is_right, core_keeps_its_invariants, R. Qed.

(* Each time that a step passes is on record for each pair of present bodies, with the revisions and the relation in force
   at that time. *)
Theorem no_step_of_the_core_passes_a_contact s s' a b t :
  reachable s -> step s s' -> (a < b)%nat -> there (balls s a) = true -> there (balls s b) = true ->
  now s <= t < now s' ->
  exists e h r, lived s' a t e /\ lived s' b t h /\ stood s' a b t r /\ ~ wrong r (a, e) (b, h) t.
Proof.
  intros R St Lt Ta Tb U.
  assert (Rec : exists e h r, lived s' a t e /\ lived s' b t h /\ stood s' a b t r).
  { destruct St; simpl in *; try lra.
    exists (revision (balls s a)), (revision (balls s b)), (graph s a b).
    split; [|split]; right; auto. }
  destruct Rec as (e & h & r & H1 & H2 & H3). exists e, h, r. repeat split; trivial.
  apply (proj1 (core_misses_nothing s' (then_one _ _ R St)) a b t e h r Lt H1 H2 H3).
Qed.

(* What the contact graph says of a pair has been reported, but for what has ended since. *)
Definition reported (s : state) (a b : body) (t : R) (r : relation) : Prop :=
  exists q, only_ends q r /\ (q = apart \/ exists u, u <= t /\ delivered s a b u q).
Definition reports_begins (s : state) : Prop :=
  (forall a b, reported s a b (now s) (graph s a b)) /\ (forall a b t r, stood s a b t r -> reported s a b t r).

Lemma reported_later s s' a b t t' r r' :
  reported s a b t r -> (forall u q, delivered s a b u q -> delivered s' a b u q) -> t <= t' -> only_ends r r' ->
  reported s' a b t' r'.
Proof.
  intros (q & E & Q) D Le O. exists q. split; [eapply ends_add_up; eassumption|].
  destruct Q as [Q|(u & Nu & Q)]; [left; exact Q|right]. exists u. split; [lra|apply D; exact Q].
Qed.

Lemma step_reports_begins s s' : step s s' -> reports_begins s -> reports_begins s'.
Proof.
  intros St [B S]. assert (E : forall r, only_ends r r) by apply nothing_ends.
  destruct St as
    [s a p Ob | s a k r n Kn G Ne Oe | s a r n G Ne Oe
    | s set f l n v s' Fx Fs Fl Ho Nb Dd | s a b ka kb r n v Lt Pa Pb G Ne Sv Oe s' Ce
    | s a b r Le Nw G | s a b n Le Nc Ne | s t Nt Cl Ns Du]; split;
    try exact S; try exact B; simpl.
  1-2: intros x y; eapply reported_later; [apply B|auto|simpl; lra|apply Oe].
  - intros x y. destruct (Nat.eq_dec x a) as [Ex|Nx], (Nat.eq_dec y b) as [Ey|Ny].
    { subst x y. eapply reported_later; [apply B|auto|simpl; lra|exact Oe]. }
    all: rewrite G by tauto; apply B.
  - intros x y. destruct (Nat.eq_dec x a) as [Ex|Nx], (Nat.eq_dec y b) as [Ey|Ny].
    { subst x y. exists (r a b). split; [apply E|]. right. exists (now s). split; [lra|]. right. auto. }
    all: rewrite (G x y) by tauto; eapply reported_later; [apply B|simpl; auto|simpl; lra|apply E].
  - intros x y t q H. eapply reported_later; [apply S; exact H|simpl; auto|lra|apply E].
  - intros x y. eapply reported_later; [apply B|auto|simpl; lra|apply E].
  - intros x y u q [H|[U ->]]; [eapply reported_later; [apply S; exact H|auto|lra|apply E]|].
    eapply reported_later; [apply B|auto|lra|apply E].
Qed.

(* If it would be wrong to call two bodies apart, because they touch or one senses the other, an event has reported that
   by then: each contact is reported, and none is late. *)
Theorem every_contact_of_the_core_is_reported s s' a b t e h :
  reachable s -> step s s' -> (a < b)%nat -> there (balls s a) = true -> there (balls s b) = true ->
  now s <= t < now s' -> lived s' a t e -> lived s' b t h -> wrong apart (a, e) (b, h) t ->
  exists r u q, stood s' a b t r /\ r <> apart /\ u <= t /\ delivered s' a b u q /\ only_ends q r.
Proof.
  intros R St Lt Ta Tb U Ha Hb V.
  destruct (no_step_of_the_core_passes_a_contact s s' a b t R St Lt Ta Tb U) as (_ & _ & r & _ & _ & H3 & _).
  assert (R' := then_one _ _ R St).
  assert (Ne : r <> apart).
  { intros ->. exact (proj1 (core_misses_nothing s' R') a b t e h apart Lt Ha Hb H3 V). }
  assert (Rb : reports_begins s').
  { clear - R' L. induction R' as [s (_ & Gr & _ & St)|s s' R I St]; [|eapply step_reports_begins; eauto]. split.
    - intros a b. exists apart. rewrite Gr. split; [apply nothing_ends|left; reflexivity].
    - intros a b t r H. elim (St _ _ _ _ H). }
  destruct (proj2 Rb a b t r H3) as (q & E & [->|(u & Nu & H)]).
  - elim Ne. apply nothing_ends_twice. exact E.
  - exists r, u, q. auto.
Qed.

End Keeps.
