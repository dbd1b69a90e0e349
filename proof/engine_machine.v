(* The engine's bookkeeping as an abstract machine: windows, swept spheres, certificates, revisions, the contact graph,
   and clusters that run concurrently. proof/README.md says which function of src/engine each step stands for.

   The machine decides by what the engine knows (bounds, swept spheres, revisions, due times). What is true of the
   bodies stands in [World], and no step but a report or a change by the caller refers to it. *)
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
(* A body with its revision: its motion, from one discontinuity to the next. *)
Definition motion := (body * nat)%type.

Class World := {
  place : Type;
  bound : Type;     (* what is known of a body since its last report: bound, filter, sensors *)
  swept_sphere : Type;
  relation : Type;  (* what the contact graph says of a pair: touching or not, and within which sensor distances *)
  apart : relation; (* neither touching nor within a sensor distance *)
  only_ends : relation -> relation -> Prop; (* from the first to the second one nothing begins *)
  static : body -> bool;

  (* The truth. *)
  fills : motion -> R -> place -> Prop;            (* the body with all that it senses around it *)
  wrong : relation -> motion -> motion -> R -> Prop; (* the contact graph would miss a begin or an end at this time *)
  keeps_to : motion -> bound -> R -> Prop;         (* from this time on the motion lies in the bound *)

  (* Computed values. *)
  holds : swept_sphere -> R -> place -> Prop;
  swept_sphere_of : bound -> R -> until -> swept_sphere; (* from a time on, for a window that ends then *)
  left_out : swept_sphere -> swept_sphere -> R -> until -> until -> Prop; (* a search leaves the pair out *)
  certifies : relation -> bound -> bound -> R -> until -> Prop  (* one of the certificates computed then *)
}.

(* Properties of bounds, swept spheres, searches and certificates: the lemmas of docs/guarantee.md. *)
Class Lemmas (W : World) : Prop := {
  nothing_ends r : only_ends r r;
  ends_add_up r q p : only_ends r q -> only_ends q p -> only_ends r p;
  nothing_ends_twice r : only_ends apart r -> r = apart;
  bounds_last x p s t : keeps_to x p s -> s <= t -> keeps_to x p t;
  apart_without_a_common_place x y t :
    wrong apart x y t -> exists l, fills x t l /\ fills y t l;
  swept_spheres_hold x p s now end_ t l :
    keeps_to x p s -> s <= t -> now <= t -> before t end_ -> fills x t l -> holds (swept_sphere_of p now end_) t l;
  searches_are_complete c d now u v t l :
    left_out c d now u v -> now <= t -> before t u -> before t v -> holds c t l -> holds d t l -> False;
  certificates_are_early r p q now u x y s s' t :
    certifies r p q now u -> keeps_to x p s -> keeps_to y q s' -> s <= t -> s' <= t ->
    now <= t -> before t u -> ~ wrong r x y t
}.

(* The rules of the engine. The theorem is about a machine that obeys all of them; engine_rules.v shows for each rule
   that a machine without it misses a contact. *)
Inductive rule :=
  | search_for_who_starts       (* a body that gets a swept sphere gets a fact with every other body *)
  | links_are_not_searched      (* a pair that touches is not left to the search *)
  | changed_are_dirty           (* a discontinuity is followed by a new start *)
  | certificates_outlive_starts (* a start keeps the certificates of other bodies *)
  | earliest_is_due             (* time moves on to the earliest due time *)
  | windows_are_not_passed      (* ... and not past the end of a window *)
  | news_is_rechecked           (* a pair is rechecked after its event was delivered *)
  | conflicts_join              (* a cluster takes in the bodies that its updated bodies may meet *)
  | updates_are_compared        (* updated bodies of different clusters are certified against each other *)
  | due_pairs_join              (* the bodies of a pair that is due in the batch are in one cluster *)
  | both_queues_are_kept.       (* certificates that clusters leave are due afterwards *)

(* A body as the engine keeps it. *)
Record Body `{World} := mkBody {
  there : bool;
  revision : nat;
  dirty : bool;
  known : option bound; (* none after a discontinuity, until a report *)
  held : swept_sphere;
  window : until        (* the swept sphere holds the body until then *)
}.

Inductive entry :=
  | Pair (due : R) (x y : motion)    (* a certificate; the first body has the smaller number *)
  | Renewal (due : R) (x : motion).  (* the end of a window that a body has for itself *)
Definition due (h : entry) : R := match h with Pair t _ _ => t | Renewal t _ => t end.

(* Record of a swept sphere that a cluster gives to a body. *)
Record Update `{World} := mkUpdate { updated : body; since : R; as_known : bound; with_revision : nat; lasts : until }.

Record state `{World} := mkState {
  now : R;
  epoch : until;                        (* when the next common window ends *)
  bodies : body -> Body;
  graph : body -> body -> relation;     (* by the smaller number, and the larger one *)
  news : body -> body -> Prop;          (* events to be delivered, or delivered and not rechecked *)
  queue : entry -> Prop;
  updates : Update -> Prop;             (* of the present batch *)
  delivered : body -> body -> R -> relation -> Prop; (* delivered events, and what the contact graph says since *)
  (* History, for the theorem: the revision with which a body left a time, and what the contact graph then said. *)
  lived : body -> R -> nat -> Prop;
  stood : body -> body -> R -> relation -> Prop
}.

Section Machine.
Context {W : World}.
Variable on : rule -> Prop. (* the rules that the machine obeys *)

Definition motion_of (s : state) (a : body) : motion := (a, revision (bodies s a)).
Definition clean (s : state) (a : body) : Prop := there (bodies s a) = true /\ dirty (bodies s a) = false.

(* Like a PairCertificate, an entry is stale once one of its bodies has another revision. *)
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

(* The pairs of a cluster: two of its bodies, or one of them and a static body. *)
Definition covers (own : body -> bool) (a b : body) : bool :=
  (own a && own b) || (own a && static b) || (static a && own b).

(* A pair gets a fact from the search, from a certificate that lasts as long as both windows, or from one in the queue.
   In a concurrent run a body that gets a swept sphere touches and senses only bodies of its cluster. *)
Definition certified (s : state) (a b : body) : Prop :=
  exists p q u,
    known (bodies s a) = Some p /\ known (bodies s b) = Some q /\ certifies (graph s a b) p q (now s) u /\
    (spans u (window (bodies s a)) (window (bodies s b)) \/
     exists v, u = Some v /\ queue s (Pair v (motion_of s a) (motion_of s b))).
Definition gets_fact (own : body -> bool) (s : state) (a b : body) : Prop :=
  (on conflicts_join -> covers own a b = false -> graph s a b = apart) /\
  (((on links_are_not_searched -> graph s a b = apart) /\
    left_out (held (bodies s a)) (held (bodies s b)) (now s) (window (bodies s a)) (window (bodies s b)))
   \/ certified s a b
   \/ (~ on conflicts_join /\ covers own a b = false)).

(* A body in a window that ends before the epoch has a renewal. *)
Definition will_renew (s : state) (a : body) : Prop :=
  no_later (epoch s) (window (bodies s a)) \/
  exists v, queue s (Renewal v (motion_of s a)) /\ reaches v (window (bodies s a)).

Definition put (s : state) (a : body) (v : Body) : body -> Body := fun x => if x =? a then v else bodies s x.
Definition set_bodies (f : body -> Body) (s : state) : state :=
  mkState _ (now s) (epoch s) f (graph s) (news s) (queue s) (updates s) (delivered s) (lived s) (stood s).
Definition set_pairs (r : body -> body -> relation) (n : body -> body -> Prop) (g : entry -> Prop) (s : state) : state :=
  mkState _ (now s) (epoch s) (bodies s) r n g (updates s) (delivered s) (lived s) (stood s).
Definition deliver_event (a b : body) (r : relation) (s : state) : state :=
  mkState _ (now s) (epoch s) (bodies s) (graph s) (news s) (queue s) (updates s)
    (fun x y t q => delivered s x y t q \/ (x = a /\ y = b /\ t = now s /\ q = r)) (lived s) (stood s).

(* Nothing changes except pairs of one body, or except one pair. *)
Definition same_but_of {A} (own : body -> bool) (a : body) (f g : body -> body -> A) : Prop :=
  forall x y, ~ ((x = a \/ y = a) /\ covers own x y = true) -> f x y = g x y.
Definition same_but {A} (a b : body) (f g : body -> body -> A) : Prop :=
  forall x y, ~ (x = a /\ y = b) -> f x y = g x y.

Definition started (s : state) (set : body -> bool) (ends : body -> until) : body -> Body := fun x =>
  match set x, known (bodies s x) with
  | true, Some p => mkBody _ (there (bodies s x)) (revision (bodies s x)) false (Some p)
                           (swept_sphere_of p (now s) (ends x)) (ends x)
  | _, _ => bodies s x
  end.
Definition noted (s : state) (set : body -> bool) (ends : body -> until) (k : Update) : Prop :=
  updates s k \/
  (set (updated k) = true /\ since k = now s /\ known (bodies s (updated k)) = Some (as_known k) /\
   with_revision k = revision (bodies s (updated k)) /\ lasts k = ends (updated k)).

(* The steps of a cluster with bodies `own`. Where all bodies are its own these are the steps of World::advance. *)
Inductive step (own : body -> bool) : state -> state -> Prop :=

  (* A report that keeps the promise. *)
  | report s a p :
      own a = true -> keeps_to (motion_of s a) p (now s) ->
      step own s (set_bodies (put s a (mkBody _ (there (bodies s a)) (revision (bodies s a)) (dirty (bodies s a))
                                            (Some p) (held (bodies s a)) (window (bodies s a)))) s)

  (* A discontinuity: a velocity change, a change by the caller, or a report that breaks the promise. It may end
     contacts of the body. If the new state is not known, a report is needed first. *)
  | change s a k r n :
      own a = true -> there (bodies s a) = true ->
      (forall p, k = Some p -> keeps_to (a, S (revision (bodies s a))) p (now s)) ->
      same_but_of own a r (graph s) -> same_but_of own a n (news s) ->
      (forall x y, only_ends (graph s x y) (r x y)) ->
      forall d, (on changed_are_dirty -> d = true) ->
      step own s (set_bodies (put s a (mkBody _ true (S (revision (bodies s a))) d k
                                            (held (bodies s a)) (window (bodies s a))))
                        (set_pairs r n (queue s) s))

  (* A body gets no window at this instant. *)
  | postpone s a :
      own a = true ->
      step own s (set_bodies (put s a (mkBody _ (there (bodies s a)) (revision (bodies s a)) true
                                            (known (bodies s a)) (held (bodies s a)) (window (bodies s a)))) s)

  (* Bodies get new swept spheres, and facts with all others: bodies with an ended common window, dirty bodies, or one
     body with an ended window of its own. *)
  | start s set ends (g : entry -> Prop) :
      (forall x, set x = true -> own x = true /\ there (bodies s x) = true /\ known (bodies s x) <> None) ->
      let s' := mkState _ (now s) (epoch s) (started s set ends) (graph s) (news s) g (noted s set ends) (delivered s)
                       (lived s) (stood s) in
      (on search_for_who_starts ->
       forall a b, (a < b)%nat -> set a = true \/ set b = true -> clean s' a -> clean s' b -> gets_fact own s' a b) ->
      (on certificates_outlive_starts ->
       forall h, queue s h -> g h \/ exists v x, h = Renewal v x /\ set (fst x) = true) ->
      (forall x, own x = true -> clean s' x -> will_renew s' x) ->
      step own s s'

  (* A certificate is rechecked and leaves the queue; the pair gets a new certificate or a pending event. A contact may
     end without an event (ContactRule::Change::release). *)
  | recheck s a b v r n (g : entry -> Prop) :
      (a < b)%nat -> covers own a b = true ->
      same_but a b r (graph s) -> same_but a b n (news s) -> only_ends (graph s a b) (r a b) ->
      (forall h, queue s h -> g h \/ h = Pair v (motion_of s a) (motion_of s b)) ->
      let s' := set_pairs r n g s in
      certified s' a b \/ n a b ->
      step own s s'

  (* An event is delivered, and the contact graph takes over its relation. *)
  | deliver s a b r :
      (a < b)%nat -> covers own a b = true -> news s a b -> same_but a b r (graph s) ->
      step own s (deliver_event a b (r a b) (set_pairs r (news s) (queue s) s))

  (* The pair of a delivered event is rechecked at the same time. *)
  | recertify s a b n :
      (a < b)%nat -> covers own a b = true -> same_but a b n (news s) ->
      forall g : entry -> Prop, (forall h, queue s h -> g h) ->
      (on news_is_rechecked -> g (Pair (now s) (motion_of s a) (motion_of s b))) ->
      step own s (set_pairs (graph s) n g s)

  (* A pending event of a body that has become dirty is dropped. *)
  | drop_news s a b n :
      (a < b)%nat -> covers own a b = true -> ~ (clean s a /\ clean s b) -> same_but a b n (news s) ->
      step own s (set_pairs (graph s) n (queue s) s)

  (* Stale certificates, and certificates of dirty bodies, leave the queue. *)
  | drop s (g : entry -> Prop) :
      (forall h, queue s h -> g h \/ ~ valid s h \/
         match h with
         | Pair _ x y => covers own (fst x) (fst y) = true /\ ~ (clean s (fst x) /\ clean s (fst y))
         | Renewal _ x => own (fst x) = true /\ ~ clean s (fst x)
         end) ->
      step own s (set_pairs (graph s) (news s) g s)

  (* Time moves on, at most to the earliest failure time. No body is dirty, and all pending events have been delivered.
     *)
  | advance s t :
      now s <= t ->
      (forall a, own a = true -> there (bodies s a) = true -> dirty (bodies s a) = false) ->
      (forall a b, (a < b)%nat -> covers own a b = true -> clean s a -> clean s b -> ~ news s a b) ->
      (on windows_are_not_passed -> reaches t (epoch s)) ->
      (forall h, match h with Pair _ _ _ => on earliest_is_due | Renewal _ _ => on windows_are_not_passed end ->
                 queue s h -> valid s h -> concerns own h -> t <= due h) ->
      step own s
        (mkState _ t (epoch s) (bodies s) (graph s) (news s) (queue s) (updates s) (delivered s)
           (fun a u e => lived s a u e \/
                         (own a = true /\ there (bodies s a) = true /\ now s <= u < t /\ e = revision (bodies s a)))
           (fun a b u r => stood s a b u r \/ ((own a = true \/ own b = true) /\ now s <= u < t /\ r = graph s a b))).

Inductive steps (own : body -> bool) (s : state) : state -> Prop :=
  | no_step : steps own s s
  | one_more s' s'' : steps own s s' -> step own s' s'' -> steps own s s''.

(* A batch of an epoch: each cluster runs from its begin to its end as if it were alone. Clusters in conflict are joined
   and run again. The accepted runs become the state of the world. *)
Definition own_of (cluster : body -> option nat) (i : nat) (a : body) : bool :=
  match cluster a with Some j => i =? j | None => false end.
Definition begin_batch (s : state) : state :=
  mkState _ (now s) (epoch s) (bodies s) (graph s) (news s) (queue s) (fun _ => False) (delivered s) (lived s) (stood s).

(* Two updated bodies of different clusters stay apart from the later update to the end of the first window: their
   swept spheres, extended back to the begin of the batch, or a certificate imply it. Or they stay apart at least to the
   end of the batch, and are due when the certificate ends, unless one of the two is updated again. *)
Definition last_of (s : state) (k : Update) : Prop :=
  with_revision k = revision (bodies s (updated k)) /\ lasts k = window (bodies s (updated k)).
Definition stay_apart (begin stop : R) (k l : Update) (are_last : Prop) (g : entry -> Prop) : Prop :=
  left_out (swept_sphere_of (as_known k) begin (lasts k)) (swept_sphere_of (as_known l) begin (lasts l)) begin (lasts k) (lasts l) \/
  exists u, certifies apart (as_known k) (as_known l) (Rmax (since k) (since l)) u /\
    (spans u (lasts k) (lasts l) \/
     exists v, u = Some v /\ stop <= v /\ (are_last -> g (Pair v (updated k, with_revision k) (updated l, with_revision l)))).

(* The cluster that has a pair. *)
Definition cluster_of (cluster : body -> option nat) (a b : body) : option nat :=
  match cluster a, cluster b with
  | Some i, Some j => if i =? j then Some i else None
  | Some i, None => if static b then Some i else None
  | None, Some j => if static a then Some j else None
  | None, None => None
  end.

(* The entries g are due after the batch. *)
Record accepted (s : state) (cluster : body -> option nat) (stop : R) (f : nat -> state) (g : entry -> Prop) : Prop := {
  in_epoch : now s <= stop /\ reaches stop (epoch s);
  nothing_waits : (forall a, there (bodies s a) = true -> dirty (bodies s a) = false) /\
                  (forall a b, (a < b)%nat -> ~ news s a b);
  static_are_unassigned : forall a, static a = true -> cluster a = None;
  due_in_one_cluster : forall h, queue s h -> valid s h -> due h < stop ->
    match h with
    | Pair _ x y => on due_pairs_join -> cluster_of cluster (fst x) (fst y) <> None
    | Renewal _ x => on windows_are_not_passed -> cluster (fst x) <> None
    end;
  have_run : forall i, steps (own_of cluster i) (begin_batch s) (f i);
  have_come : forall i, now (f i) = stop;
  are_finished : forall i,
    (forall a, own_of cluster i a = true -> there (bodies (f i) a) = true -> dirty (bodies (f i) a) = false) /\
    (forall a b, (a < b)%nat -> covers (own_of cluster i) a b = true -> ~ news (f i) a b);
  updated_stay_apart : on updates_are_compared -> forall i j k l, i <> j -> (updated k < updated l)%nat ->
    updates (f i) k -> updates (f j) l -> stay_apart (now s) stop k l (last_of (f i) k /\ last_of (f j) l) g
}.

Definition merged (s : state) (cluster : body -> option nat) (stop : R) (f : nat -> state) (g : entry -> Prop) : state :=
  mkState _ stop (epoch s)
    (fun a => match cluster a with Some i => bodies (f i) a | None => bodies s a end)
    (fun a b => match cluster_of cluster a b with Some i => graph (f i) a b | None => graph s a b end)
    (fun _ _ => False) g (fun _ => False)
    (fun a b u r => delivered s a b u r \/ exists i, delivered (f i) a b u r)
    (fun a u e => match cluster a with
                  | Some i => lived (f i) a u e
                  | None => lived s a u e \/ (there (bodies s a) = true /\ now s <= u < stop /\ e = revision (bodies s a))
                  end)
    (fun a b u r => match cluster_of cluster a b with
                    | Some i => stood (f i) a b u r
                    | None => stood s a b u r \/ (now s <= u < stop /\ r = graph s a b)
                    end).

(* The steps of a world. *)
Definition everybody : body -> bool := fun _ => true.

Inductive world_step : state -> state -> Prop :=
  | alone s s' : step everybody s s' -> world_step s s'
  (* When the next common window ends, from now on. *)
  | begin_epoch s next :
      let s' := mkState _ (now s) next (bodies s) (graph s) (news s) (queue s) (updates s) (delivered s) (lived s) (stood s) in
      (forall a, clean s a -> will_renew s' a) -> world_step s s'
  (* A body is added or enabled: it is dirty, and no certificate has its new revision. *)
  | come s a k c w r n :
      there (bodies s a) = false ->
      (forall p, k = Some p -> keeps_to (a, S (revision (bodies s a))) p (now s)) ->
      same_but_of everybody a r (graph s) -> same_but_of everybody a n (news s) ->
      (forall x y, only_ends (graph s x y) (r x y)) ->
      world_step s (set_bodies (put s a (mkBody _ true (S (revision (bodies s a))) true k c w)) (set_pairs r n (queue s) s))
  (* A body is removed or disabled. *)
  | go s a r n :
      same_but_of everybody a r (graph s) -> same_but_of everybody a n (news s) ->
      (forall x y, only_ends (graph s x y) (r x y)) ->
      world_step s (set_bodies (put s a (mkBody _ false (S (revision (bodies s a))) false None
                                         (held (bodies s a)) (window (bodies s a)))) (set_pairs r n (queue s) s))
  | batch s cluster stop f (g : entry -> Prop) :
      accepted s cluster stop f g ->
      (forall h, queue s h -> stop <= due h -> g h) ->
      (on both_queues_are_kept ->
       forall i h, queue (f i) h -> stop <= due h \/ concerns (own_of cluster i) h -> g h) ->
      world_step s (merged s cluster stop f g).

(* A world without bodies. *)
Definition empty (s : state) : Prop :=
  (forall a, there (bodies s a) = false /\ known (bodies s a) = None) /\
  (forall a b, graph s a b = apart) /\
  (forall a t e, ~ lived s a t e) /\ (forall a b t r, ~ stood s a b t r).

Inductive reachable : state -> Prop :=
  | at_first s : empty s -> reachable s
  | then_one s s' : reachable s -> world_step s s' -> reachable s'.

(* At each past time the contact graph was right about each pair, with the motions in force at that time. *)
Definition nothing_missed (s : state) : Prop :=
  forall a b t e f r, (a < b)%nat -> lived s a t e -> lived s b t f -> stood s a b t r -> ~ wrong r (a, e) (b, f) t.

End Machine.
