(* The bookkeeping of the core as an abstract machine: safe regions, lists of neighbours, due times, and the contact
   graph. proof/README.md says which function of src/core and src/processor each step stands for.

   The machine decides by what the core knows (bounds, safe regions, times). What is true of the bodies stands in
   [World], and no step but a report or a change by the caller refers to it. *)
From Coq Require Import Reals Bool Arith.
Open Scope R_scope.

(* A time, or never. *)
Definition until := option R.
Definition before (t : R) (u : until) : Prop := match u with Some v => t < v | None => True end.
Definition reaches (t : R) (u : until) : Prop := match u with Some v => t <= v | None => True end.
Definition no_later (u v : until) : Prop := forall t, before t u -> before t v.

Definition body := nat.
(* A body with its revision: its motion, from one discontinuity to the next. *)
Definition motion := (body * nat)%type.

Class World := {
  bound : Type;     (* what is known of a body since its last report *)
  region : Type;    (* a place and a reach *)
  relation : Type;  (* what the contact graph says of a pair: touching or not, and within which sensor distances *)
  apart : relation; (* neither touching nor within a sensor distance *)
  only_ends : relation -> relation -> Prop; (* from the first to the second one nothing begins *)

  (* The truth. *)
  lies_in : motion -> R -> region -> Prop; (* the body, with all that it senses around it, is within the region's reach *)
  wrong : relation -> motion -> motion -> R -> Prop; (* the contact graph would miss a begin or an end at this time *)
  wrong_at_walls : relation -> motion -> R -> Prop;  (* the same of a body and the walls *)
  keeps_to : motion -> bound -> R -> Prop;           (* from this time on the motion lies in the bound *)

  (* Computed values. *)
  strangers : motion -> motion -> Prop;                   (* the filters keep the two from having to do with each other *)
  stays : region -> bound -> R -> until -> Prop;          (* a time from now on for which a bound stays in a region *)
  clears_walls : relation -> bound -> R -> until -> Prop; (* ... for which nothing happens between it and the walls *)
  out_of_reach : region -> region -> Prop;                (* a search does not find one by the other *)
  certifies : relation -> bound -> bound -> R -> until -> Prop  (* ... for which nothing happens between two *)
}.

(* Properties of bounds, regions, searches and certificates: the lemmas of docs/guarantee.md. *)
Class Lemmas (W : World) : Prop := {
  nothing_ends r : only_ends r r;
  ends_add_up r q p : only_ends r q -> only_ends q p -> only_ends r p;
  nothing_ends_twice r : only_ends apart r -> r = apart;
  bounds_last x p s t : keeps_to x p s -> s <= t -> keeps_to x p t;
  regions_hold c p now u x t :
    stays c p now u -> keeps_to x p now -> now <= t -> before t u -> lies_in x t c;
  walls_are_clear r p now u x t :
    clears_walls r p now u -> keeps_to x p now -> now <= t -> before t u -> ~ wrong_at_walls r x t;
  searches_are_complete c d x y t :
    out_of_reach c d -> lies_in x t c -> lies_in y t d -> ~ wrong apart x y t;
  strangers_never_meet x y t : strangers x y -> ~ wrong apart x y t;
  certificates_are_early r p q now u x y t :
    certifies r p q now u -> keeps_to x p now -> keeps_to y q now -> now <= t -> before t u -> ~ wrong r x y t
}.

(* A body as the core keeps it. *)
Record Ball `{World} := mkBall {
  there : bool;
  revision : nat;
  dirty : bool;         (* it waits for settle() *)
  known : option bound; (* none after a discontinuity, until a report *)
  held : region;        (* its safe region *)
  own : until;          (* until then it stays in its safe region, and meets no wall *)
  due : until;
  second : until;       (* the same without the neighbour that `due` is about *)
  about : option body
}.

Record state `{World} := mkState {
  now : R;
  balls : body -> Ball;
  listed : body -> body -> Prop;        (* the two are neighbours; by the smaller number, and the larger one *)
  graph : body -> body -> relation;     (* likewise; of a body with itself: of the body and the walls *)
  news : body -> body -> Prop;          (* events to be delivered, or delivered and not looked at again *)
  sure : body -> body -> until;         (* nothing happens between the two before: when their certificate ends *)
  delivered : body -> body -> R -> relation -> Prop; (* delivered events, and what the contact graph says since *)
  (* History, for the theorem: the revision with which a body left a time, and what the contact graph then said. *)
  lived : body -> R -> nat -> Prop;
  stood : body -> body -> R -> relation -> Prop
}.

Section Machine.
Context {W : World}.

Definition motion_of (s : state) (a : body) : motion := (a, revision (balls s a)).
Definition clean (s : state) (a : body) : Prop := there (balls s a) = true /\ dirty (balls s a) = false.

(* Until when a ball answers for what happens between it and another one: it is due by then. *)
Definition is_about (k : Ball) (b : body) : bool := match about k with Some c => c =? b | None => false end.
Definition answers_until (k : Ball) (b : body) : until := if is_about k b then due k else second k.

(* Pairs that somebody has to look at: neighbours, and those that touch or sense each other. *)
Definition concerned (s : state) (a b : body) : Prop := listed s a b \/ graph s a b <> apart.

(* One of two is due by the end of their certificate. It may be due for itself: what is certain of two no longer than they
   stay in their safe regions ends with the own time of one, which need not be the one that looks out for the other. *)
Definition one_is_due (s : state) (a b : body) : Prop :=
  no_later (answers_until (balls s a) b) (sure s a b) \/ no_later (answers_until (balls s b) a) (sure s a b) \/
  no_later (own (balls s a)) (sure s a b) \/ no_later (own (balls s b)) (sure s a b).

(* Two get a certificate, from their present bounds. *)
Definition certified (s : state) (a b : body) : Prop :=
  (exists p q, known (balls s a) = Some p /\ known (balls s b) = Some q /\
     certifies (graph s a b) p q (now s) (sure s a b)) /\ one_is_due s a b.

(* Two keep the certificate that they had. If one now stays in its safe region for longer, nobody may be due by the end
   of it any more: then they need another. *)
Definition keep_certificate (s s' : state) (a b : body) : Prop :=
  clean s a /\ clean s b /\ concerned s a b /\ ~ news s a b /\ sure s' a b = sure s a b /\ one_is_due s' a b.

Definition put (s : state) (a : body) (v : Ball) : body -> Ball := fun x => if x =? a then v else balls s x.
Definition set_balls (f : body -> Ball) (s : state) : state :=
  mkState _ (now s) f (listed s) (graph s) (news s) (sure s) (delivered s) (lived s) (stood s).
Definition set_pairs (r : body -> body -> relation) (n : body -> body -> Prop) (v : body -> body -> until) (s : state) : state :=
  mkState _ (now s) (balls s) (listed s) r n v (delivered s) (lived s) (stood s).
Definition deliver_event (a b : body) (r : relation) (s : state) : state :=
  mkState _ (now s) (balls s) (listed s) (graph s) (news s) (sure s)
    (fun x y t q => delivered s x y t q \/ (x = a /\ y = b /\ t = now s /\ q = r)) (lived s) (stood s).

(* Nothing changes except pairs of one body, or except one pair. *)
Definition same_but_of {A} (a : body) (f g : body -> body -> A) : Prop :=
  forall x y, x <> a -> y <> a -> f x y = g x y.
Definition same_but {A} (a b : body) (f g : body -> body -> A) : Prop :=
  forall x y, ~ (x = a /\ y = b) -> f x y = g x y.

(* What nothing but settle() and rechecks changes. *)
Definition with_known (k : Ball) (p : option bound) : Ball :=
  mkBall _ (there k) (revision k) (dirty k) p (held k) (own k) (due k) (second k) (about k).
Definition changed (k : Ball) (is_there is_dirty : bool) (p : option bound) : Ball :=
  mkBall _ is_there (S (revision k)) is_dirty p (held k) (own k) (due k) (second k) (about k).

(* The ball that was due about another one is due later: at the given time, or when it would be without the other. *)
Definition postponed (k k' : Ball) (b : body) : Prop :=
  k' = k \/
  (is_about k b = true /\
   exists u m, k' = mkBall _ (there k) (revision k) (dirty k) (known k) (held k) (own k) u (second k) m /\
               ((m = Some b /\ no_later u (second k)) \/ (m = None /\ u = second k))).

(* The steps of a world. *)
Inductive step : state -> state -> Prop :=

  (* A report that keeps the promise. *)
  | report s a p :
      keeps_to (motion_of s a) p (now s) ->
      step s (set_balls (put s a (with_known (balls s a) (Some p))) s)

  (* A discontinuity: a velocity change, a change by the caller, or a report that breaks the promise. It may end
     contacts of the body. If the new state is not known, a report is needed first. So it is with a body that is added or
     enabled. *)
  | change s a k r n :
      (forall p, k = Some p -> keeps_to (a, S (revision (balls s a))) p (now s)) ->
      same_but_of a r (graph s) -> same_but_of a n (news s) ->
      (forall x y, only_ends (graph s x y) (r x y)) ->
      step s (set_balls (put s a (changed (balls s a) true true k)) (set_pairs r n (sure s) s))

  (* A body is removed or disabled. *)
  | go s a r n :
      same_but_of a r (graph s) -> same_but_of a n (news s) ->
      (forall x y, only_ends (graph s x y) (r x y)) ->
      step s (set_balls (put s a (changed (balls s a) false false None)) (set_pairs r n (sure s) s))

  (* Balls of a set are settled: those that have changed, or one that may leave its safe region or meet a wall, and
     whoever has to look at these. They may get other safe regions, for which a search finds the neighbours, own times
     and due times. Each pair of theirs is certified, or keeps its certificate, or its event waits. *)
  | settle s (set : body -> bool) f l n v :
      let s' := mkState _ (now s) f l (graph s) n v (delivered s) (lived s) (stood s) in
      (forall x, set x = false -> f x = balls s x) ->
      (forall x, set x = true ->
         there (f x) = there (balls s x) /\ revision (f x) = revision (balls s x) /\ known (f x) = known (balls s x)) ->
      (forall x y, set x = false -> set y = false -> l x y = listed s x y /\ n x y = news s x y /\ v x y = sure s x y) ->
      (* H: each gets an own time, and is due no later. *)
      (forall x, set x = true -> clean s' x ->
         no_later (due (f x)) (second (f x)) /\ no_later (second (f x)) (own (f x)) /\
         exists p u, known (f x) = Some p /\ stays (held (f x)) p (now s) u /\ no_later (own (f x)) u /\
           (n x x \/ exists w, clears_walls (graph s x x) p (now s) w /\ no_later (own (f x)) w)) ->
      (* N: whoever is not found is out of reach. *)
      (forall a b, (a < b)%nat -> set a = true \/ set b = true -> clean s' a -> clean s' b ->
         l a b \/ out_of_reach (held (f a)) (held (f b)) \/ strangers (motion_of s a) (motion_of s b)) ->
      (* D: all neighbours, and all that touch or sense each other, are scanned, by one of the two: by this one, or the
         other has done so before. *)
      (forall a b, (a < b)%nat -> set a = true \/ set b = true -> clean s' a -> clean s' b -> concerned s' a b ->
         n a b \/ certified s' a b \/ keep_certificate s s' a b) ->
      step s s'

  (* The pair that is due is rechecked: it is certified anew, or its event waits. A contact may end without an event
     (ContactRule::Change::release). *)
  | recheck s a b ka kb r n v :
      (a < b)%nat -> postponed (balls s a) ka b -> postponed (balls s b) kb a ->
      same_but a b r (graph s) -> same_but a b n (news s) -> same_but a b v (sure s) -> only_ends (graph s a b) (r a b) ->
      let s' := set_balls (fun x => if x =? a then ka else if x =? b then kb else balls s x) (set_pairs r n v s) in
      n a b \/ certified s' a b ->
      step s s'

  (* An event of a pair, or of a body and the walls (a = b), is delivered, and the contact graph takes over its
     relation. The pair is looked at again before time moves on. *)
  | deliver s a b r :
      (a <= b)%nat -> news s a b -> same_but a b r (graph s) ->
      step s (deliver_event a b (r a b) (set_pairs r (news s) (sure s) s))

  (* A pending event of a body that has become dirty is dropped. *)
  | drop_news s a b n :
      (a <= b)%nat -> ~ (clean s a /\ clean s b) -> same_but a b n (news s) ->
      step s (set_pairs (graph s) n (sure s) s)

  (* Time moves on, at most to the earliest due time. No body is dirty, and no event waits. *)
  | advance s t :
      now s <= t ->
      (forall a, there (balls s a) = true -> dirty (balls s a) = false) ->
      (forall a b, (a <= b)%nat -> clean s a -> clean s b -> ~ news s a b) ->
      (forall a, clean s a -> reaches t (due (balls s a))) ->
      step s
        (mkState _ t (balls s) (listed s) (graph s) (news s) (sure s) (delivered s)
           (fun a u e => lived s a u e \/
                         (there (balls s a) = true /\ now s <= u < t /\ e = revision (balls s a)))
           (fun a b u r => stood s a b u r \/ (now s <= u < t /\ r = graph s a b))).

(* A world without bodies. *)
Definition empty (s : state) : Prop :=
  (forall a, there (balls s a) = false /\ known (balls s a) = None) /\
  (forall a b, graph s a b = apart) /\
  (forall a t e, ~ lived s a t e) /\ (forall a b t r, ~ stood s a b t r).

Inductive reachable : state -> Prop :=
  | at_first s : empty s -> reachable s
  | then_one s s' : reachable s -> step s s' -> reachable s'.

(* At each past time the contact graph was right about each pair, and about each body and the walls, with the motions in
   force at that time. *)
Definition nothing_missed (s : state) : Prop :=
  (forall a b t e f r, (a < b)%nat -> lived s a t e -> lived s b t f -> stood s a b t r -> ~ wrong r (a, e) (b, f) t) /\
  (forall a t e r, lived s a t e -> stood s a a t r -> ~ wrong_at_walls r (a, e) t).

End Machine.
