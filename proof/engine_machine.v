(* The engine's bookkeeping as an abstract machine: windows, capsules, hot pairs, stamps, the book of contacts, and
   islands that run beside each other. proof/README.md says which function of src/engine each step stands for.

   The machine decides by what the engine knows (bounds, capsules, stamps, due times). What is true of the bodies
   stands in [World], and no step but a report or a change by the caller refers to it. *)
From Coq Require Import Reals Bool Arith.
Open Scope R_scope.

(* A time, or never. *)
Definition until := option R.
Definition before (t : R) (u : until) : Prop := match u with Some v => t < v | None => True end.
Definition reaches (t : R) (u : until) : Prop := match u with Some v => t <= v | None => True end.
Definition no_later (u v : until) : Prop := forall t, before t u -> before t v.
(* A certificate that ends at u lasts up to the end of the first of two windows. *)
Definition spans (u v w : until) : Prop := forall t, before t v -> before t w -> before t u.

Definition body := nat.
(* A body with its stamp: its motion, from one discontinuity to the next. *)
Definition motion := (body * nat)%type.

Class World := {
  place : Type;
  bound : Type;     (* what is known of a body since its last report: bound, filter, sensors *)
  capsule : Type;
  relation : Type;  (* what the book says of a pair: touching or not, and within which sensor distances *)
  apart : relation; (* neither touching nor within a sensor distance *)
  only_ends : relation -> relation -> Prop; (* from the first to the second one nothing begins *)
  fixed : body -> bool;

  (* What is true. *)
  fills : motion -> R -> place -> Prop;            (* the body with all that it senses around it *)
  wrong : relation -> motion -> motion -> R -> Prop; (* the book would miss a begin or an end at this time *)
  keeps_to : motion -> bound -> R -> Prop;         (* from this time on the motion lies in the bound *)

  (* What is computed. *)
  holds : capsule -> R -> place -> Prop;
  capsule_of : bound -> R -> until -> capsule;     (* from a time on, for a window that ends then *)
  left_out : capsule -> capsule -> R -> until -> until -> Prop; (* a search leaves the pair out *)
  certifies : relation -> bound -> bound -> R -> until -> Prop  (* one of the certificates computed then *)
}.

(* What is known of bounds, capsules, searches and certificates: the lemmas of docs/guarantee.md. *)
Class Lemmas (W : World) : Prop := {
  nothing_ends r : only_ends r r;
  ends_add_up r q p : only_ends r q -> only_ends q p -> only_ends r p;
  nothing_ends_twice r : only_ends apart r -> r = apart;
  bounds_last x p s t : keeps_to x p s -> s <= t -> keeps_to x p t;
  apart_without_a_common_place x y t :
    wrong apart x y t -> exists l, fills x t l /\ fills y t l;
  capsules_hold x p s now end_ t l :
    keeps_to x p s -> s <= t -> now <= t -> before t end_ -> fills x t l -> holds (capsule_of p now end_) t l;
  searches_are_complete c d now u v t l :
    left_out c d now u v -> now <= t -> before t u -> before t v -> holds c t l -> holds d t l -> False;
  certificates_are_early r p q now u x y s s' t :
    certifies r p q now u -> keeps_to x p s -> keeps_to y q s' -> s <= t -> s' <= t ->
    now <= t -> before t u -> ~ wrong r x y t
}.

(* What the engine must do. The theorem is about a machine that obeys all of them; engine_rules.v shows for each of
   them that a machine without it misses a contact. *)
Inductive rule :=
  | search_for_who_starts    (* whoever gets a capsule gets a fact with everybody *)
  | links_are_not_searched   (* a pair that touches is not left to the search *)
  | kicked_are_dirty         (* a discontinuity is followed by a new start *)
  | hot_pairs_outlive_starts (* who starts does not touch the hot pairs of others *)
  | earliest_is_due          (* time moves on to the earliest due time *)
  | windows_are_not_passed   (* ... and not past the end of a window *)
  | news_is_looked_at        (* a pair whose event was delivered is looked at again *)
  | islands_claim            (* an island takes along whom its kicked bodies may meet *)
  | kicks_are_compared       (* kicked bodies of different islands are held against each other *)
  | due_pairs_join           (* bodies whose pair is due in the part are in one island *)
  | both_agendas_are_kept.   (* what islands leave due is due afterwards *)

(* A body as the engine keeps it. *)
Record Body `{World} := mkBody {
  there : bool;
  stamp : nat;
  dirty : bool;
  known : option bound; (* none after a discontinuity, until a report *)
  held : capsule;
  window : until        (* the capsule holds the body until then *)
}.

Inductive entry :=
  | Pair (due : R) (x y : motion)    (* a hot pair; the first body has the smaller number *)
  | Renewal (due : R) (x : motion).  (* the end of a window that a body has for itself *)
Definition due (h : entry) : R := match h with Pair t _ _ => t | Renewal t _ => t end.

(* What an island notes when a body gets a capsule. *)
Record Kick `{World} := mkKick { kicked : body; since : R; as_known : bound; with_stamp : nat; lasts : until }.

Record state `{World} := mkState {
  now : R;
  phase : until;                        (* when the next common window ends *)
  bodies : body -> Body;
  book : body -> body -> relation;      (* by the smaller number, and the larger one *)
  news : body -> body -> Prop;          (* events to be delivered, or delivered and not looked at again *)
  agenda : entry -> Prop;
  kicks : Kick -> Prop;                 (* of the present part *)
  told : body -> body -> R -> relation -> Prop; (* events that were delivered, and what the book says since *)
  (* What has passed, for the theorem: with which stamp a body left a time, and what the book then said. *)
  lived : body -> R -> nat -> Prop;
  stood : body -> body -> R -> relation -> Prop
}.

Section Machine.
Context {W : World}.
Variable on : rule -> Prop. (* the rules that the machine obeys *)

Definition motion_of (s : state) (a : body) : motion := (a, stamp (bodies s a)).
Definition clean (s : state) (a : body) : Prop := there (bodies s a) = true /\ dirty (bodies s a) = false.

(* As PairCertificate: void once one of the two has another stamp. *)
Definition valid (s : state) (h : entry) : Prop :=
  match h with
  | Pair _ x y => x = motion_of s (fst x) /\ y = motion_of s (fst y)
  | Renewal _ x => x = motion_of s (fst x)
  end.
Definition concerns (own : body -> bool) (h : entry) : Prop :=
  match h with
  | Pair _ x y => own (fst x) = true \/ own (fst y) = true
  | Renewal _ x => own (fst x) = true
  end.

(* The pairs of an island: two of its bodies, or one of them and a fixed body. *)
Definition covers (own : body -> bool) (a b : body) : bool :=
  (own a && own b) || (own a && fixed b) || (fixed a && own b).

(* A pair gets a fact: from the search, from a certificate that lasts as long as both windows, or a hot pair. Beside
   others a body that gets a capsule touches and senses only bodies of its island. *)
Definition certified (s : state) (a b : body) : Prop :=
  exists p q u,
    known (bodies s a) = Some p /\ known (bodies s b) = Some q /\ certifies (book s a b) p q (now s) u /\
    (spans u (window (bodies s a)) (window (bodies s b)) \/
     exists v, u = Some v /\ agenda s (Pair v (motion_of s a) (motion_of s b))).
Definition gets_fact (own : body -> bool) (s : state) (a b : body) : Prop :=
  (on islands_claim -> covers own a b = false -> book s a b = apart) /\
  (((on links_are_not_searched -> book s a b = apart) /\
    left_out (held (bodies s a)) (held (bodies s b)) (now s) (window (bodies s a)) (window (bodies s b)))
   \/ certified s a b
   \/ (~ on islands_claim /\ covers own a b = false)).

(* A body in a window that ends before the phase has a renewal. *)
Definition will_renew (s : state) (a : body) : Prop :=
  no_later (phase s) (window (bodies s a)) \/
  exists v, agenda s (Renewal v (motion_of s a)) /\ reaches v (window (bodies s a)).

Definition put (s : state) (a : body) (v : Body) : body -> Body := fun x => if x =? a then v else bodies s x.
Definition set_bodies (f : body -> Body) (s : state) : state :=
  mkState _ (now s) (phase s) f (book s) (news s) (agenda s) (kicks s) (told s) (lived s) (stood s).
Definition set_pairs (r : body -> body -> relation) (n : body -> body -> Prop) (g : entry -> Prop) (s : state) : state :=
  mkState _ (now s) (phase s) (bodies s) r n g (kicks s) (told s) (lived s) (stood s).
Definition tell (a b : body) (r : relation) (s : state) : state :=
  mkState _ (now s) (phase s) (bodies s) (book s) (news s) (agenda s) (kicks s)
    (fun x y t q => told s x y t q \/ (x = a /\ y = b /\ t = now s /\ q = r)) (lived s) (stood s).

(* All but the pairs of a body, or but a pair, is as it was. *)
Definition same_but_of {A} (own : body -> bool) (a : body) (f g : body -> body -> A) : Prop :=
  forall x y, ~ ((x = a \/ y = a) /\ covers own x y = true) -> f x y = g x y.
Definition same_but {A} (a b : body) (f g : body -> body -> A) : Prop :=
  forall x y, ~ (x = a /\ y = b) -> f x y = g x y.

Definition started (s : state) (set : body -> bool) (ends : body -> until) : body -> Body := fun x =>
  match set x, known (bodies s x) with
  | true, Some p => mkBody _ (there (bodies s x)) (stamp (bodies s x)) false (Some p)
                           (capsule_of p (now s) (ends x)) (ends x)
  | _, _ => bodies s x
  end.
Definition noted (s : state) (set : body -> bool) (ends : body -> until) (k : Kick) : Prop :=
  kicks s k \/
  (set (kicked k) = true /\ since k = now s /\ known (bodies s (kicked k)) = Some (as_known k) /\
   with_stamp k = stamp (bodies s (kicked k)) /\ lasts k = ends (kicked k)).

(* The steps of an island with bodies `own`. Where all bodies are its own these are the steps of World::advance. *)
Inductive step (own : body -> bool) : state -> state -> Prop :=

  (* A report that keeps the promise. *)
  | report s a p :
      own a = true -> keeps_to (motion_of s a) p (now s) ->
      step own s (set_bodies (put s a (mkBody _ (there (bodies s a)) (stamp (bodies s a)) (dirty (bodies s a))
                                            (Some p) (held (bodies s a)) (window (bodies s a)))) s)

  (* A discontinuity: a kick, a change by the caller, a report that breaks the promise. Contacts of the body may
     end with it. Where its new state is not known a report is needed first. *)
  | change s a k r n :
      own a = true -> there (bodies s a) = true ->
      (forall p, k = Some p -> keeps_to (a, S (stamp (bodies s a))) p (now s)) ->
      same_but_of own a r (book s) -> same_but_of own a n (news s) ->
      (forall x y, only_ends (book s x y) (r x y)) ->
      forall d, (on kicked_are_dirty -> d = true) ->
      step own s (set_bodies (put s a (mkBody _ true (S (stamp (bodies s a))) d k
                                            (held (bodies s a)) (window (bodies s a))))
                        (set_pairs r n (agenda s) s))

  (* There is no window for a body at this instant. *)
  | postpone s a :
      own a = true ->
      step own s (set_bodies (put s a (mkBody _ (there (bodies s a)) (stamp (bodies s a)) true
                                            (known (bodies s a)) (held (bodies s a)) (window (bodies s a)))) s)

  (* Bodies get capsules from now on, and facts with everybody: those whose windows have ended, the dirty ones, or
     one whose own window has ended. *)
  | start s set ends (g : entry -> Prop) :
      (forall x, set x = true -> own x = true /\ there (bodies s x) = true /\ known (bodies s x) <> None) ->
      let s' := mkState _ (now s) (phase s) (started s set ends) (book s) (news s) g (noted s set ends) (told s)
                       (lived s) (stood s) in
      (on search_for_who_starts ->
       forall a b, (a < b)%nat -> set a = true \/ set b = true -> clean s' a -> clean s' b -> gets_fact own s' a b) ->
      (on hot_pairs_outlive_starts ->
       forall h, agenda s h -> g h \/ exists v x, h = Renewal v x /\ set (fst x) = true) ->
      (forall x, own x = true -> clean s' x -> will_renew s' x) ->
      step own s s'

  (* A hot pair is looked at, and leaves the agenda: with a new certificate, or with news. A contact may be over
     without an event (ContactRule::Change::release). *)
  | look s a b v r n (g : entry -> Prop) :
      (a < b)%nat -> covers own a b = true ->
      same_but a b r (book s) -> same_but a b n (news s) -> only_ends (book s a b) (r a b) ->
      (forall h, agenda s h -> g h \/ h = Pair v (motion_of s a) (motion_of s b)) ->
      let s' := set_pairs r n g s in
      certified s' a b \/ n a b ->
      step own s s'

  (* An event is delivered; the book says what it says. *)
  | deliver s a b r :
      (a < b)%nat -> covers own a b = true -> news s a b -> same_but a b r (book s) ->
      step own s (tell a b (r a b) (set_pairs r (news s) (agenda s) s))

  (* Then the pair is looked at again, now. *)
  | look_again s a b n :
      (a < b)%nat -> covers own a b = true -> same_but a b n (news s) ->
      forall g : entry -> Prop, (forall h, agenda s h -> g h) ->
      (on news_is_looked_at -> g (Pair (now s) (motion_of s a) (motion_of s b))) ->
      step own s (set_pairs (book s) n g s)

  (* News of a body that is dirty meanwhile does not hold any more. *)
  | drop_news s a b n :
      (a < b)%nat -> covers own a b = true -> ~ (clean s a /\ clean s b) -> same_but a b n (news s) ->
      step own s (set_pairs (book s) n (agenda s) s)

  (* What is void, or of dirty bodies, leaves the agenda. *)
  | drop s (g : entry -> Prop) :
      (forall h, agenda s h -> g h \/ ~ valid s h \/
         match h with
         | Pair _ x y => covers own (fst x) (fst y) = true /\ ~ (clean s (fst x) /\ clean s (fst y))
         | Renewal _ x => own (fst x) = true /\ ~ clean s (fst x)
         end) ->
      step own s (set_pairs (book s) (news s) g s)

  (* Time moves on, up to what is due first. Nobody is dirty, and all news has been delivered. *)
  | advance s t :
      now s <= t ->
      (forall a, own a = true -> there (bodies s a) = true -> dirty (bodies s a) = false) ->
      (forall a b, (a < b)%nat -> covers own a b = true -> clean s a -> clean s b -> ~ news s a b) ->
      (on windows_are_not_passed -> reaches t (phase s)) ->
      (forall h, match h with Pair _ _ _ => on earliest_is_due | Renewal _ _ => on windows_are_not_passed end ->
                 agenda s h -> valid s h -> concerns own h -> t <= due h) ->
      step own s
        (mkState _ t (phase s) (bodies s) (book s) (news s) (agenda s) (kicks s) (told s)
           (fun a u e => lived s a u e \/
                         (own a = true /\ there (bodies s a) = true /\ now s <= u < t /\ e = stamp (bodies s a)))
           (fun a b u r => stood s a b u r \/ ((own a = true \/ own b = true) /\ now s <= u < t /\ r = book s a b))).

Inductive steps (own : body -> bool) (s : state) : state -> Prop :=
  | no_step : steps own s s
  | one_more s' s'' : steps own s s' -> step own s' s'' -> steps own s s''.

(* A part of a phase: islands run from its beginning to its end, each as if it had the world for itself, and one that
   claimed a body, or met another, has run again, joined. What is accepted becomes what came of the world. *)
Definition own_of (island : body -> option nat) (i : nat) (a : body) : bool :=
  match island a with Some j => i =? j | None => false end.
Definition begin_part (s : state) : state :=
  mkState _ (now s) (phase s) (bodies s) (book s) (news s) (agenda s) (fun _ => False) (told s) (lived s) (stood s).

(* Two kicked bodies of different islands stay apart from the later kick to the end of the first window: their
   capsules, each as if it had been there from the beginning of the part, or a certificate say so. Or they do up to the
   end of the part at least, and are due when the certificate ends, unless one of the two is kicked again. *)
Definition last_of (s : state) (k : Kick) : Prop :=
  with_stamp k = stamp (bodies s (kicked k)) /\ lasts k = window (bodies s (kicked k)).
Definition stay_apart (begin stop : R) (k l : Kick) (are_last : Prop) (g : entry -> Prop) : Prop :=
  left_out (capsule_of (as_known k) begin (lasts k)) (capsule_of (as_known l) begin (lasts l)) begin (lasts k) (lasts l) \/
  exists u, certifies apart (as_known k) (as_known l) (Rmax (since k) (since l)) u /\
    (spans u (lasts k) (lasts l) \/
     exists v, u = Some v /\ stop <= v /\ (are_last -> g (Pair v (kicked k, with_stamp k) (kicked l, with_stamp l)))).

(* The island that has a pair. *)
Definition island_of (island : body -> option nat) (a b : body) : option nat :=
  match island a, island b with
  | Some i, Some j => if i =? j then Some i else None
  | Some i, None => if fixed b then Some i else None
  | None, Some j => if fixed a then Some j else None
  | None, None => None
  end.

(* With g due when the part is over. *)
Record accepted (s : state) (island : body -> option nat) (stop : R) (f : nat -> state) (g : entry -> Prop) : Prop := {
  in_phase : now s <= stop /\ reaches stop (phase s);
  nothing_waits : (forall a, there (bodies s a) = true -> dirty (bodies s a) = false) /\
                  (forall a b, (a < b)%nat -> ~ news s a b);
  fixed_are_nobodys : forall a, fixed a = true -> island a = None;
  due_in_one_island : forall h, agenda s h -> valid s h -> due h < stop ->
    match h with
    | Pair _ x y => on due_pairs_join -> island_of island (fst x) (fst y) <> None
    | Renewal _ x => on windows_are_not_passed -> island (fst x) <> None
    end;
  have_run : forall i, steps (own_of island i) (begin_part s) (f i);
  have_come : forall i, now (f i) = stop;
  are_settled : forall i,
    (forall a, own_of island i a = true -> there (bodies (f i) a) = true -> dirty (bodies (f i) a) = false) /\
    (forall a b, (a < b)%nat -> covers (own_of island i) a b = true -> ~ news (f i) a b);
  kicked_stay_apart : on kicks_are_compared -> forall i j k l, i <> j -> (kicked k < kicked l)%nat ->
    kicks (f i) k -> kicks (f j) l -> stay_apart (now s) stop k l (last_of (f i) k /\ last_of (f j) l) g
}.

Definition merged (s : state) (island : body -> option nat) (stop : R) (f : nat -> state) (g : entry -> Prop) : state :=
  mkState _ stop (phase s)
    (fun a => match island a with Some i => bodies (f i) a | None => bodies s a end)
    (fun a b => match island_of island a b with Some i => book (f i) a b | None => book s a b end)
    (fun _ _ => False) g (fun _ => False)
    (fun a b u r => told s a b u r \/ exists i, told (f i) a b u r)
    (fun a u e => match island a with
                  | Some i => lived (f i) a u e
                  | None => lived s a u e \/ (there (bodies s a) = true /\ now s <= u < stop /\ e = stamp (bodies s a))
                  end)
    (fun a b u r => match island_of island a b with
                    | Some i => stood (f i) a b u r
                    | None => stood s a b u r \/ (now s <= u < stop /\ r = book s a b)
                    end).

(* The steps of a world. *)
Definition everybody : body -> bool := fun _ => true.

Inductive world_step : state -> state -> Prop :=
  | alone s s' : step everybody s s' -> world_step s s'
  (* When the next common window ends, from now on. *)
  | begin_phase s next :
      let s' := mkState _ (now s) next (bodies s) (book s) (news s) (agenda s) (kicks s) (told s) (lived s) (stood s) in
      (forall a, clean s a -> will_renew s' a) -> world_step s s'
  (* A body comes, or comes back: it is dirty, and nobody has heard of its stamp. *)
  | come s a k c w r n :
      there (bodies s a) = false ->
      (forall p, k = Some p -> keeps_to (a, S (stamp (bodies s a))) p (now s)) ->
      same_but_of everybody a r (book s) -> same_but_of everybody a n (news s) ->
      (forall x y, only_ends (book s x y) (r x y)) ->
      world_step s (set_bodies (put s a (mkBody _ true (S (stamp (bodies s a))) true k c w)) (set_pairs r n (agenda s) s))
  (* A body is removed or disabled. *)
  | go s a r n :
      same_but_of everybody a r (book s) -> same_but_of everybody a n (news s) ->
      (forall x y, only_ends (book s x y) (r x y)) ->
      world_step s (set_bodies (put s a (mkBody _ false (S (stamp (bodies s a))) false None
                                         (held (bodies s a)) (window (bodies s a)))) (set_pairs r n (agenda s) s))
  | part s island stop f (g : entry -> Prop) :
      accepted s island stop f g ->
      (forall h, agenda s h -> stop <= due h -> g h) ->
      (on both_agendas_are_kept ->
       forall i h, agenda (f i) h -> stop <= due h \/ concerns (own_of island i) h -> g h) ->
      world_step s (merged s island stop f g).

(* A world without bodies. *)
Definition empty (s : state) : Prop :=
  (forall a, there (bodies s a) = false /\ known (bodies s a) = None) /\
  (forall a b, book s a b = apart) /\
  (forall a t e, ~ lived s a t e) /\ (forall a b t r, ~ stood s a b t r).

Inductive reachable : state -> Prop :=
  | at_first s : empty s -> reachable s
  | then_one s s' : reachable s -> world_step s s' -> reachable s'.

(* At each time that has been left the book was right about each pair, with the motions in force when it was left. *)
Definition nothing_missed (s : state) : Prop :=
  forall a b t e f r, (a < b)%nat -> lived s a t e -> lived s b t f -> stood s a b t r -> ~ wrong r (a, e) (b, f) t.

End Machine.
