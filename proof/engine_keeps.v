(* Invariant of a cluster, or of a world in one cluster: each pair has a fact, and each swept sphere holds its body.
   Each step preserves it. *)
From Coq Require Import Reals Lra Lia Bool Arith.
From Kinesphere Require Import engine_machine.
Open Scope R_scope.

(* Splits on whether body x is the changed body a. *)
Ltac at_body x a := unfold put in *; destruct (Nat.eqb_spec x a); [subst|]; simpl in *.

Section Keeps.
Context {W : World} {L : Lemmas W}.
Variable on : rule -> Prop.
Hypothesis obeyed : forall r, on r.

Definition right_at (s : state) (a b : body) (t : R) : Prop :=
  ~ wrong (graph s a b) (motion_of s a) (motion_of s b) t.

(* The fact about a pair: an event about it is pending, or it does not change before a window ends, or not before a
   certificate fails. *)
Definition fact (s : state) (a b : body) : Prop :=
  news s a b \/
  (forall t, now s <= t -> before t (window (bodies s a)) -> before t (window (bodies s b)) -> right_at s a b t) \/
  (exists v, queue s (Pair v (motion_of s a) (motion_of s b)) /\ forall t, now s <= t < v -> right_at s a b t).

Definition some_of (own : body -> bool) (a b : body) : Prop := own a = true \/ own b = true.

Record keeps (own : body -> bool) (s : state) : Prop := {
  bounds_hold : forall a p, known (bodies s a) = Some p -> keeps_to (motion_of s a) p (now s);
  swept_spheres_are_right : forall a, clean s a -> forall t l,
    now s <= t -> before t (window (bodies s a)) -> fills (motion_of s a) t l -> holds (held (bodies s a)) t l;
  windows_will_end : forall a, own a = true -> clean s a -> will_renew s a;
  facts_hold : forall a b, (a < b)%nat -> some_of own a b -> clean s a -> clean s b -> fact s a b;
  past_is_right : forall a b t e f r, (a < b)%nat -> own a = true -> own b = true ->
    lived s a t e -> lived s b t f -> stood s a b t r -> ~ wrong r (a, e) (b, f) t;
  past_is_past : (forall a t e, lived s a t e -> t < now s) /\ (forall a b t r, stood s a b t r -> t < now s)
}.

Lemma covers_own own a b : own a = true -> own b = true -> covers own a b = true.
Proof. unfold covers. intros -> ->. reflexivity. Qed.

Lemma certified_fact s a b :
  (forall a p, known (bodies s a) = Some p -> keeps_to (motion_of s a) p (now s)) ->
  certified s a b -> fact s a b.
Proof.
  intros B (p & q & u & Kp & Kq & C & [S|(v & -> & G)]).
  - right; left. intros t N A A'. eapply certificates_are_early; eauto; apply S; assumption.
  - right; right. exists v. split; [exact G|]. intros t [N V]. eapply certificates_are_early; eauto.
Qed.

Lemma searched_fact s a b :
  (forall a, clean s a -> forall t l,
    now s <= t -> before t (window (bodies s a)) -> fills (motion_of s a) t l -> holds (held (bodies s a)) t l) ->
  clean s a -> clean s b -> graph s a b = apart ->
  left_out (held (bodies s a)) (held (bodies s b)) (now s) (window (bodies s a)) (window (bodies s b)) ->
  fact s a b.
Proof.
  intros C Ca Cb A O. right; left. intros t N Wa Wb V. rewrite A in V.
  destruct (apart_without_a_common_place _ _ _ V) as (l & Fa & Fb).
  eapply searches_are_complete; eauto.
Qed.

(* A body that is what it was, but for what is known of it. *)
Definition alike (x y : Body) : Prop :=
  there x = there y /\ revision x = revision y /\ dirty x = dirty y /\ held x = held y /\ window x = window y.

Lemma report_alike s a p x :
  alike (put s a (mkBody _ (there (bodies s a)) (revision (bodies s a)) (dirty (bodies s a))
                  (Some p) (held (bodies s a)) (window (bodies s a))) x) (bodies s x).
Proof. unfold put. destruct (Nat.eqb_spec x a); subst; repeat split. Qed.

Lemma motion_start s set ends g k x :
  motion_of (mkState _ (now s) (epoch s) (started s set ends) (graph s) (news s) g k (delivered s) (lived s) (stood s)) x = motion_of s x.
Proof.
  unfold motion_of; simpl. unfold started. destruct (set x); [destruct (known (bodies s x))|]; reflexivity.
Qed.

(* If time may move on to t, each earlier time u lies before the end of the body's window. *)
Lemma window_lasts own s a t u :
  keeps own s -> own a = true -> clean s a -> reaches t (epoch s) ->
  (forall h, queue s h -> valid s h -> concerns own h -> t <= due h) ->
  u < t -> before u (window (bodies s a)).
Proof.
  intros K O C P D U. destruct (windows_will_end _ _ K a O C) as [N|(v & G & R)].
  - apply N. destruct (epoch s); simpl in *; lra || exact I.
  - assert (t <= v) by (apply (D (Renewal v (motion_of s a)) G); [reflexivity|exact O]).
    destruct (window (bodies s a)); simpl in *; [lra|exact I].
Qed.

Lemma fact_now own s a b t u :
  keeps own s -> (a < b)%nat -> some_of own a b -> clean s a -> clean s b -> ~ news s a b ->
  (forall h, queue s h -> valid s h -> concerns own h -> t <= due h) ->
  before u (window (bodies s a)) -> before u (window (bodies s b)) ->
  now s <= u < t -> right_at s a b u.
Proof.
  intros K Lt O Ca Cb N D Wa Wb U. destruct (facts_hold _ _ K a b Lt O Ca Cb) as [F|[F|(v & G & F)]].
  - contradiction.
  - apply F; tauto.
  - apply F. assert (t <= v) by (apply (D _ G); [split; reflexivity|exact O]). lra.
Qed.


Lemma step_keeps own s s' : step on own s s' -> keeps own s -> keeps own s'.
Proof.
  intros St K. destruct St as
    [s a p O Ob | s a k r n O Th Kn R N Oe d D | s a O | s set ends g P s' Se G Wn
    | s a b v r n g Lt Cv R N Oe G s' Ce | s a b r Lt Cv Ne R | s a b n Lt Cv N g G Gl
    | s a b n Lt Cv Nc N | s g G | s t Nt Cl Ns Wp D].
  - destruct K as [B C Wi F P T]. split; simpl.
    + intros x q. unfold motion_of; simpl. at_body x a; [intros [= <-]; exact Ob|]. apply B.
    + intros x [Tx Dx] t l. unfold motion_of in *; simpl in *. at_body x a; apply C; split; assumption.
    + intros x Ox [Tx Dx]. specialize (Wi x Ox). unfold clean, will_renew, motion_of in *; simpl in *.
      at_body x a; apply Wi; split; assumption.
    + intros x y Lt So [Tx Dx] [Ty Dy]. specialize (F x y Lt So). unfold fact, right_at, motion_of, clean in *; simpl in *.
      at_body x a; at_body y a; apply F; split; assumption.
    + exact P.
    + exact T.
  - destruct K as [B C Wi F P T]. specialize (D (obeyed _)). subst d. split; simpl.
    + intros x q. unfold motion_of; simpl. at_body x a; [apply Kn|]. apply B.
    + intros x [Tx Dx] t l. unfold motion_of in *; simpl in *. at_body x a; [discriminate|]. apply C; split; assumption.
    + intros x Ox [Tx Dx]. specialize (Wi x Ox). unfold clean, will_renew, motion_of in *; simpl in *.
      at_body x a; [discriminate|]. apply Wi; split; assumption.
    + intros x y Lt So [Tx Dx] [Ty Dy]. specialize (F x y Lt So). unfold fact, right_at, motion_of, clean in *; simpl in *.
      at_body x a; [discriminate|]. at_body y a; [discriminate|].
      rewrite R, N by (intros [[H|H] _]; congruence). apply F; split; assumption.
    + exact P.
    + exact T.
  - destruct K as [B C Wi F P T]. split; simpl.
    + intros x q. unfold motion_of; simpl. at_body x a; apply B.
    + intros x [Tx Dx] t l. unfold motion_of in *; simpl in *. at_body x a; [discriminate|]. apply C; split; assumption.
    + intros x Ox [Tx Dx]. specialize (Wi x Ox). unfold clean, will_renew, motion_of in *; simpl in *.
      at_body x a; [discriminate|]. apply Wi; split; assumption.
    + intros x y Lt So [Tx Dx] [Ty Dy]. specialize (F x y Lt So). unfold fact, right_at, motion_of, clean in *; simpl in *.
      at_body x a; [discriminate|]. at_body y a; [discriminate|]. apply F; split; assumption.
    + exact P.
    + exact T.
  - destruct K as [B C Wi F P0 T].
    assert (M : forall x, motion_of s' x = motion_of s x) by (intro; apply motion_start).
    assert (B' : forall x q, known (bodies s' x) = Some q -> keeps_to (motion_of s' x) q (now s')).
    { intros x q. rewrite M. simpl. unfold started. destruct (set x), (known (bodies s x)) eqn:Kx; simpl; try (intros [= <-]; apply B; exact Kx); try (intros Q; apply B; congruence).
      all: intros Q; apply B; congruence. }
    assert (C' : forall a, clean s' a -> forall t l,
      now s' <= t -> before t (window (bodies s' a)) -> fills (motion_of s' a) t l -> holds (held (bodies s' a)) t l).
    { intros x Cx t l Nt. rewrite M. revert Cx Nt. unfold clean. simpl. unfold started.
      destruct (set x) eqn:Sx; [|intros; eapply C; eauto]. destruct (P x Sx) as (_ & _ & Kx).
      destruct (known (bodies s x)) eqn:Q; [|congruence]. simpl. intros _ Nt Be Fi.
      eapply swept_spheres_hold; eauto. }
    split.
    + exact B'.
    + exact C'.
    + exact Wn.
    + intros x y Lt So Cx Cy. destruct (set x || set y) eqn:Sxy.
      * apply orb_prop in Sxy. destruct (Se (obeyed _) x y Lt Sxy Cx Cy) as [_ [[A O]|[Ce|[N _]]]].
        -- apply searched_fact; auto.
        -- apply certified_fact; auto.
        -- elim N. apply obeyed.
      * apply orb_false_iff in Sxy. destruct Sxy as [Sx Sy].
        assert (Ex : bodies s' x = bodies s x) by (simpl; unfold started; rewrite Sx; reflexivity).
        assert (Ey : bodies s' y = bodies s y) by (simpl; unfold started; rewrite Sy; reflexivity).
        unfold clean in Cx, Cy. rewrite Ex in Cx. rewrite Ey in Cy.
        destruct (F x y Lt So Cx Cy) as [H|[H|(v & H & Q)]].
        -- left. exact H.
        -- right; left. rewrite Ex, Ey. unfold right_at. rewrite !M. exact H.
        -- right; right. exists v. unfold right_at. rewrite !M. split; [|exact Q].
           destruct (G (obeyed _) _ H) as [|(? & ? & ? & _)]; [assumption|discriminate].
    + exact P0.
    + exact T.
  - destruct K as [B C Wi F P T]. split; try assumption.
    + intros x Ox Cx. destruct (Wi x Ox Cx) as [?|(w & H & Q)]; [left; assumption|right].
      exists w. split; [|exact Q]. destruct (G _ H); [assumption|discriminate].
    + intros x y Lt' So Cx Cy.
      assert (Dec : (x = a /\ y = b) \/ ~ (x = a /\ y = b)) by lia.
      destruct Dec as [[-> ->]|Ot].
      * destruct Ce as [Ce|Ne]; [|left; exact Ne]. apply certified_fact; auto.
      * specialize (F x y Lt' So Cx Cy). unfold fact, right_at, motion_of in *; simpl in *.
        rewrite R, N by exact Ot. destruct F as [H|[H|(w & H & Q)]]; [left|right; left|right; right]; trivial.
        exists w. split; [|exact Q]. destruct (G _ H) as [|Eq]; [assumption|].
        exfalso. apply Ot. injection Eq. tauto.
  - destruct K as [B C Wi F P T]. split; try assumption.
    intros x y Lt' So Cx Cy. assert (Dec : (x = a /\ y = b) \/ ~ (x = a /\ y = b)) by lia.
    destruct Dec as [[-> ->]|Ot]; [left; exact Ne|].
    specialize (F x y Lt' So Cx Cy). unfold fact, right_at, motion_of in *; simpl in *. rewrite R by exact Ot. exact F.
  - destruct K as [B C Wi F P T]. split; try assumption.
    + intros x Ox Cx. destruct (Wi x Ox Cx) as [?|(w & H & Q)]; [left; assumption|right].
      exists w. split; [|exact Q]. apply G, H.
    + intros x y Lt' So Cx Cy. assert (Dec : (x = a /\ y = b) \/ ~ (x = a /\ y = b)) by lia.
      destruct Dec as [[-> ->]|Ot].
      * right; right. exists (now s). split; [exact (Gl (obeyed _))|]. simpl. intros; lra.
      * specialize (F x y Lt' So Cx Cy). unfold fact, right_at, motion_of in *; simpl in *.
        rewrite N by exact Ot. destruct F as [H|[H|(w & H & Q)]]; [left|right; left|right; right]; trivial.
        exists w. auto.
  - destruct K as [B C Wi F P T]. split; try assumption.
    intros x y Lt' So Cx Cy. assert (Dec : (x = a /\ y = b) \/ ~ (x = a /\ y = b)) by lia.
    destruct Dec as [[-> ->]|Ot]; [elim Nc; split; assumption|].
    specialize (F x y Lt' So Cx Cy). unfold fact, right_at, motion_of in *; simpl in *. rewrite N by exact Ot. exact F.
  - destruct K as [B C Wi F P T]. split; try assumption.
    + intros x Ox Cx. destruct (Wi x Ox Cx) as [?|(w & H & Q)]; [left; assumption|right].
      exists w. split; [|exact Q]. destruct (G _ H) as [|[V|[_ V]]]; [assumption| |].
      * elim V. reflexivity.
      * elim V. exact Cx.
    + intros x y Lt' So Cx Cy. destruct (F x y Lt' So Cx Cy) as [H|[H|(w & H & Q)]];
        [left|right; left|right; right]; trivial.
      exists w. split; [|exact Q]. destruct (G _ H) as [|[V|[_ V]]]; [assumption| |].
      * elim V. split; reflexivity.
      * elim V. split; assumption.
  - assert (D' : forall h, queue s h -> valid s h -> concerns own h -> t <= due h).
    { intros h. apply D. destruct h; apply obeyed. }
    assert (Wp' := Wp (obeyed _)).
    assert (K0 := K). destruct K as [B C Wi F P [T1 T2]]. split; simpl.
    + intros x q Q. eapply bounds_last; eauto.
    + intros x Cx u l Nu. apply C; [exact Cx|]. lra.
    + exact Wi.
    + intros x y Lt' So Cx Cy. destruct (F x y Lt' So Cx Cy) as [H|[H|(w & H & Q)]];
        [left|right; left|right; right]; trivial.
      * simpl. intros u Nu. apply H. lra.
      * exists w. split; [exact H|]. simpl. intros u Nu. apply Q. lra.
    + intros x y u e f r Lt' Ox Oy [Lx|(_ & Tx & Ux & ->)] [Ly|(_ & Ty & Uy & ->)] [St|(_ & Us & ->)];
        repeat match goal with
        | H : lived s _ _ _ |- _ => apply T1 in H as ?; revert H
        | H : stood s _ _ _ _ |- _ => apply T2 in H as ?; revert H
        end; intros; try lra; [eapply P; eauto|].
      assert (Cx : clean s x) by (split; auto). assert (Cy : clean s y) by (split; auto).
      eapply (fact_now own s x y t u); eauto.
      * left; assumption.
      * apply Ns; auto. apply covers_own; assumption.
      * eapply window_lasts; eauto; tauto.
      * eapply window_lasts; eauto; tauto.
    + split.
      * intros x u e [H|H]; [apply T1 in H|]; lra.
      * intros x y u r [H|H]; [apply T2 in H|]; lra.
Qed.

(* Each relation that holds at time t was delivered in an event at t or before, but for ends since. *)
Definition known_of (s : state) (a b : body) (t : R) (r : relation) : Prop :=
  exists q, only_ends q r /\ (q = apart \/ exists u, u <= t /\ delivered s a b u q).
Definition delivers_begins (s : state) : Prop :=
  (forall a b, known_of s a b (now s) (graph s a b)) /\
  (forall a b t r, stood s a b t r -> known_of s a b t r).

Lemma known_later s s' a b t t' r r' :
  known_of s a b t r -> (forall u q, delivered s a b u q -> delivered s' a b u q) -> t <= t' -> only_ends r r' ->
  known_of s' a b t' r'.
Proof.
  intros (q & E & H) Tl N E'. exists q. split; [eapply ends_add_up; eauto|].
  destruct H as [H|(u & U & H)]; [left; exact H|right]. exists u. split; [lra|auto].
Qed.

Lemma step_delivers_begins own s s' : step on own s s' -> delivers_begins s -> delivers_begins s'.
Proof.
  assert (E : forall r, only_ends r r) by apply nothing_ends.
  intros St [B S]. destruct St as
    [s a p O Ob | s a k r n O Th Kn R N Oe d D | s a O | s set ends g P s' Se G Wn
    | s a b v r n g Lt Cv R N Oe G s' Ce | s a b r Lt Cv Ne R | s a b n Lt Cv N g G Gl
    | s a b n Lt Cv Nc N | s g G | s t Nt Cl Ns Wp D]; split; try assumption; simpl.
  - intros x y. eapply known_later; [apply B|auto|simpl; lra|apply Oe].
  - intros x y. assert (Dec : (x = a /\ y = b) \/ ~ (x = a /\ y = b)) by lia. destruct Dec as [[-> ->]|Ot].
    + eapply known_later; [apply B|auto|simpl; lra|exact Oe].
    + rewrite (R x y Ot). eapply known_later; [apply B|auto|simpl; lra|apply E].
  - intros x y. assert (Dec : (x = a /\ y = b) \/ ~ (x = a /\ y = b)) by lia. destruct Dec as [[-> ->]|Ot].
    + exists (r a b). split; [apply E|right]. exists (now s). split; [lra|right]. auto.
    + rewrite (R x y Ot). eapply known_later; [apply B|simpl; auto|simpl; lra|apply E].
  - intros x y t q H. eapply known_later; [apply S; exact H|simpl; auto|lra|apply E].
  - intros x y. eapply known_later; [apply B|auto|simpl; lra|apply E].
  - intros x y u r [H|(_ & U & ->)].
    + eapply known_later; [apply S; exact H|auto|lra|apply E].
    + eapply known_later; [apply B|auto|lra|apply E].
Qed.

Lemma steps_deliver_begins own s s' : steps on own s s' -> delivers_begins s -> delivers_begins s'.
Proof. induction 1; intros T; [exact T|]. eapply step_delivers_begins; eauto. Qed.

Lemma steps_keep own s s' : steps on own s s' -> keeps own s -> keeps own s'.
Proof. induction 1; intros K; [exact K|]. eapply step_keeps; eauto. Qed.

End Keeps.
