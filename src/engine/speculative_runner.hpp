// The islands of a part of a phase: which they are, that they are run, by several threads, and what comes of
// it.
//
// A phase begins when windows have started, and ends when the next ones do; a part of it ends when so many
// pairs have been due. Bodies joined by hot pairs that are due in a part are an island. SpeculativeRunner run
// side by side, each as if there was nobody else (island.hpp). That is right as long as no kicked body of one
// may meet a body of another: so
//   - an island that claims a body stops; it is joined with the island that has the body, if there is one,
//     and they run again, from where the part began;
//   - an island that counts on a body is joined with the one that has reported it too early, if there is one;
//   - when none claims any more, the capsules of all kicked bodies are held against each other; islands of
//     two that may meet in the part are joined, and run again; two that may meet later become a hot pair, as
//     if one had found the other.
// What is left is what one island with all bodies would have done, in another order: a body's reports, facts
// and events depend on its own island alone. So what comes out depends neither on threads, nor on who ran
// what, nor on where parts end. Events are told in the order of their times, rounds and kinds, when the part
// is over.
#pragma once

#include <cstdint>
#include <deque>
#include <exception>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/batch_sizer.hpp"
#include "engine/clusters.hpp"
#include "engine/conflict_detector.hpp"
#include "engine/cross_cluster_pairs.hpp"
#include "engine/event_processor.hpp"
#include "engine/run_pool.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {

/// What islands begin with: pairs that are due, bodies that have to be settled before anything else, and
/// events that are known already.
struct InitialWork {
  std::vector<PairCertificate> due{};
  std::vector<std::uint32_t> dirty{};
  std::vector<Event> pending{};
};

class SpeculativeRunner {
 public:
  /// `answerer` may be null: then events get no answer.
  SpeculativeRunner(WorldState& tables, EventProcessor& main, PoolLease& shift, const Probe& probe,
                    ResponseHandler* handler);

  /// From now to `until` or, if that comes first, to the end of a part of the phase, where all has happened
  /// but what is due then. Appends the events. False, and nothing has happened, if there are no islands worth
  /// it, if they run again too often or have done so before, or if something has failed in one of them: that
  /// comes again when events are answered one by one. Needs a world in which nothing is left to be settled.
  /// Throws what a mover threw that was to set a body back, when all others have been set back.
  bool run(double until, std::deque<Event>& events);

  // The same in steps, for a process that has a part of the bodies and learns from others in between which
  // islands are to be joined. The part begins with what everybody() has not settled, too, and what is to be
  // told.

  /// Takes what is due from now to `until`, or to the end of a part of the phase, or to `latest`: where that
  /// is.
  double take_due(double until, double latest);
  /// The part ends at `stop`, no later than take_due() said. Forms islands.
  void begin_batch(double stop);
  /// Runs those islands that have to run and of which is_ready(group) is true; joins those that claim bodies
  /// or meet, and runs them again, until no more have to. False when one has failed.
  template <class IsReady>
  bool execute_all(IsReady is_ready) {
    return run_rounds([&] {
      for (const Cluster& group : clusters_.all())
        if (group.needs_run && is_ready(group)) to_run_.push_back(group.index);
    });
  }
  /// Of the attempt that has failed.
  const std::optional<Error>& failure() const { return failure_; }
  /// Groups are joined only to others with smaller places.
  std::span<Cluster> clusters() { return clusters_.all(); }
  /// Nobody's bodies have none.
  Cluster* cluster_of(std::uint32_t number) { return clusters_.cluster_of(number); }
  std::span<const std::uint32_t> members_of(const Cluster& group) const {
    return clusters_.members_of(group);
  }
  std::span<const PairCertificate> due_of(const Cluster& group) const { return clusters_.due_of(group); }
  // What came of a group in the last attempt; nothing, if it has been taken back.
  std::span<const SweptSphereUpdate> updates_of(const Cluster& group) const {
    return pool_.updates_of(group);
  }
  std::span<const PairCertificate> late_pairs_of(const Cluster& group) const {
    return pool_.late_pairs_of(group);
  }
  std::span<const ReadEntry> read_set_of(const Cluster& group) const { return pool_.read_set_of(group); }
  std::span<const UndoEntry> undo_log_of(const Cluster& group) const { return pool_.undo_log_of(group); }
  /// These bodies have to be in one island.
  void merge_bodies(std::span<const std::uint32_t> numbers);
  /// Bodies have become known meanwhile, and may bring these along.
  void add(const InitialWork& more);
  /// A body that another process kicks: take_meetings() tells which islands here may meet it.
  void add_foreign_update(const SweptSphereUpdate& update) { conflicts_.add_foreign(update); }
  /// Groups, and kicked bodies of others that they may meet.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> take_conflicts() {
    return conflicts_.take_conflicts();
  }
  /// The island has to run again, from where the part began.
  void run_again(std::uint32_t own) {
    rollback(clusters_[own]);
    clusters_[own].needs_run = true;
  }
  /// Whether that is before the part ends.
  bool is_in_batch(double time) const { return batch_.is_in_batch(time); }
  /// Null for a body that is as it was when the part began.
  const BodyCheckpoint* checkpoint_of(std::uint32_t number) const { return batch_.checkpoint_of(number); }
  /// All islands have run: what came of the groups becomes what came of everybody. Of those of which
  /// is_counted(group) is true, events are returned, in their order, and work is counted.
  template <class IsCounted>
  std::vector<const EventInRound*> commit(IsCounted is_counted) {
    std::vector<const EventInRound*> told;
    for (const Cluster& group : clusters_.all())
      if (!group.is_merged() && group.executed) commit(group, is_counted(group), told);
    commit(told);
    return told;
  }
  /// Nothing has happened.
  void rollback();
  /// Ends the part.
  void end_batch();
  /// All is done by islands, however long they take and however few pairs are due.
  void require_speculation() {
    batch_.most_updates = std::numeric_limits<std::size_t>::max();
    sizer_.require_speculation();
  }

 private:
  bool is_worthwhile() const;
  template <class FindAgain>
  bool run_rounds(FindAgain find_again);
  bool execute_found();
  void checkpoint(const Cluster& group);
  void rollback(Cluster& group);
  void restore_origin(const UndoEntry& turn);
  void add_member(Cluster& group, std::uint32_t number);
  void merge(Cluster& one, Cluster& other);
  bool merge_conflicts();
  bool merge_read_sets();
  PairCertificate certificate_of(const SweptSphereUpdate& update, const SweptSphereUpdate& other,
                                 double until) const;
  bool merge_updates();
  void commit(const Cluster& group, bool is_counted, std::vector<const EventInRound*>& told);
  void commit(std::vector<const EventInRound*>& told);
  void register_updates();

  WorldState& state_;
  EventProcessor& main_;
  PoolLease& lease_;
  ResponseHandler* handler_;
  BatchSizer sizer_;
  // Of the part.
  BatchState batch_;
  Clusters clusters_;
  RunPool pool_;
  ConflictDetector conflicts_;
  CrossClusterPairs cross_pairs_;
  std::vector<PairCertificate> due_;
  std::vector<PairCertificate> deferred_;  ///< that go back into everybody's agenda
  std::vector<std::uint32_t> to_run_;      ///< groups that run next
  std::optional<Error> failure_;
  std::exception_ptr exception_;  ///< by a mover that was to go back
};

template <class FindAgain>
bool SpeculativeRunner::run_rounds(FindAgain find_again) {
  for (;;) {
    to_run_.clear();
    find_again();
    if (to_run_.empty() && !conflicts_.has_new_foreign()) return true;
    if (!execute_found()) return false;
    if (!merge_conflicts()) merge_updates();
  }
}

}  // namespace kinesphere
