// SpeculationLog contains what a cluster knows and does during speculative execution: its read set, its write
// set (swept-sphere updates) and its events.
//
// Within a batch of an epoch (speculative_runner.hpp) a cluster meets no other body unless one of its bodies
// changes its velocity: the new swept sphere of that body may touch others. During execution the broad phase
// is read-only, and new swept spheres are stored here. If such a body may meet one outside the cluster within
// the batch, that one is a conflict: the cluster stops, and is executed again from the start of the batch
// with that body. If it may meet one later, that one joins the read set: it must be unchanged since the start
// of the batch up to the time of the velocity change. So does one that parts or shapes, not the balls around
// the two, show not to be met.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "broadphase/certificate_queue.hpp"
#include "broadphase/window_policy.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"
#include "number/infinity.hpp"
#include "processor/batch_state.hpp"

namespace kinesphere {

/// A swept sphere that a body has from `time` on, in its new window. A body that is removed or disabled has
/// none from then on: a departure.
struct SweptSphereUpdate {
  static SweptSphereUpdate departure(std::uint32_t number, std::uint32_t revision, double time) {
    return {.number = number, .revision = revision, .time = time, .window = {.end = -infinity}};
  }
  bool is_departure() const { return window.end == -infinity; }

  std::uint32_t number;
  std::uint32_t revision;
  double time;
  Window window{};
  Bound bound{};
  Vec3 middle{};  ///< centre of the path; used in periodic space only
  FirstChange first_change{};
};

/// An event, and in which round of its instant it was delivered.
struct EventInRound {
  std::uint32_t round;
  Event event;
  /// Ends of contacts that a response caused follow the event of that response at once, before events of
  /// other clusters: the number of events from that one to this one in the list of the cluster; otherwise 0.
  std::uint32_t after_cause = 0;
  // Bodies that the response has removed.
  bool removes_first = false;
  bool removes_second = false;

  const EventInRound& cause() const { return *(this - after_cause); }
};

/// A body outside the cluster, and the time up to which it must be unchanged since the start of the batch.
struct ReadEntry {
  std::uint32_t number;
  double time;
  bool is_certified = false;  ///< the cluster has created a certificate for the two
};

/// A body whose origin was changed, and its origin before the change.
using UndoEntry = std::pair<BodyId, MotionOrigin>;

/// Work that is only counted.
struct WorkCounters {
  Counters counters{};
  RenewalCounts recertified{};  ///< bodies that were recertified one by one
};

/// A range of indices in a list.
struct IndexRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  std::uint32_t size() const { return end - begin; }
  template <class T>
  std::span<const T> of(const std::vector<T>& list) const {
    return std::span(list).subspan(begin, size());
  }
};

/// The concatenated lists of several clusters; the last one belongs to the cluster that is being executed.
/// Lists of rolled-back runs stay until they are compacted (RunPool::drop_rolled_back).
template <class T>
class SegmentedList {
 public:
  void clear() {
    all_.clear();
    begin_ = 0;
  }
  /// Starts the list of the next cluster.
  void start() { begin_ = static_cast<std::uint32_t>(all_.size()); }
  void add(const T& one) { all_.push_back(one); }
  /// Copies a list from another object. Returns its range here.
  IndexRange add(const SegmentedList& other, const IndexRange& other_range) {
    start();
    const std::span<const T> list = other_range.of(other.all_);
    all_.insert(all_.end(), list.begin(), list.end());
    return range();
  }

  bool empty() const { return begin_ == all_.size(); }
  std::size_t size() const { return all_.size() - begin_; }
  IndexRange range() const { return {begin_, static_cast<std::uint32_t>(all_.size())}; }
  const std::vector<T>& all() const { return all_; }
  std::vector<T>& all() { return all_; }

 private:
  std::vector<T> all_;
  std::uint32_t begin_ = 0;
};

/// The result of a run: its ranges in the lists of the worker that executed it.
struct RunRecord {
  std::uint32_t worker = 0;
  std::uint32_t work = 0;
  IndexRange events{};
  IndexRange updates{};
  IndexRange late_pairs{};
  IndexRange conflicts{};
  IndexRange read_set{};
  IndexRange undo_log{};
  double time = 0.0;  ///< last instant that the run has processed
  /// Instant at which the main processor has to process a response; +infinity if there is none.
  double stop = infinity;
};

/// The log of one run, with the lists of runs that the same worker executed before in this batch.
struct SpeculationLog {
  BatchState* batch = nullptr;
  std::uint32_t index = BatchState::unassigned;
  SegmentedList<EventInRound> events;
  SegmentedList<SweptSphereUpdate> updates;   ///< ordered by time
  SegmentedList<PairCertificate> late_pairs;  ///< certificates due after the batch
  SegmentedList<std::uint32_t> conflicts;     ///< bodies that the cluster needs
  SegmentedList<ReadEntry> read_set;          ///< bodies outside the cluster that its certificates depend on
  SegmentedList<UndoEntry> undo_log;
  std::vector<WorkCounters> work;
  double stop = infinity;  ///< RunRecord::stop
  /// Error of the first of these runs that failed.
  std::optional<Error> failure;

  /// Clears all lists; call at the start of a batch.
  void clear() {
    for_each_list([](auto& list) { list.clear(); });
    work.clear();
    failure.reset();
  }
  void begin(BatchState& all, std::uint32_t slot) {
    batch = &all;
    index = slot;
    for_each_list([](auto& list) { list.start(); });
    stop = infinity;
  }
  RunRecord end(std::uint32_t worker, const WorkCounters& counters, double time) {
    work.push_back(counters);
    return {worker,
            static_cast<std::uint32_t>(work.size() - 1),
            events.range(),
            updates.range(),
            late_pairs.range(),
            conflicts.range(),
            read_set.range(),
            undo_log.range(),
            time,
            stop};
  }
  /// Returns true if the cluster has too many updates; the run then fails, and events are processed one by
  /// one.
  bool is_full() const { return updates.size() > batch->most_updates; }
  bool is_own(std::uint32_t number) const { return batch->slots[number].cluster == index; }
  void add(const SweptSphereUpdate& update) {
    note_change(update.number, update.time);
    if (update.revision != last_revision(update.number))
      first_change(update.number).invalidated = update.time;
    batch->slots[update.number].update = updates.range().end;
    updates.add(update);
  }
  /// Records that a body of the cluster is probed or gets a new swept sphere.
  void note_change(std::uint32_t number, double time) {
    double& first = first_change(number).changed;
    first = std::min(first, time);
  }
  /// Returns the checkpoint of a body that another cluster may be changing concurrently; nullptr for all
  /// other bodies.
  const BodyCheckpoint* checkpoint_of(std::uint32_t number) const {
    const std::uint32_t owner = batch->slots[number].cluster;
    return owner == index || owner == BatchState::unassigned ? nullptr : batch->checkpoint_of(number);
  }
  /// Calls visit(number) for each body that has been updated in this run and has not departed.
  template <class Visit>
  void for_each_updated(Visit visit) const {
    const auto [first, last] = updates.range();
    for (std::uint32_t k = first; k < last; ++k) {
      const std::uint32_t number = updates.all()[k].number;
      if (batch->slots[number].update == k && !updates.all()[k].is_departure()) visit(number);
    }
  }
  const SweptSphereUpdate* last_update(std::uint32_t number) const {
    const BatchState::BodySlot& slot = batch->slots[number];
    return slot.cluster == index && slot.update != BatchState::none ? &updates.all()[slot.update] : nullptr;
  }

 private:
  void for_each_list(auto visit) {
    std::apply([&](auto&... lists) { (visit(lists), ...); },
               std::tie(events, updates, late_pairs, conflicts, read_set, undo_log));
  }
  std::uint32_t last_revision(std::uint32_t number) const {
    const BatchState::BodySlot& slot = batch->slots[number];
    return slot.update != BatchState::none ? updates.all()[slot.update].revision
                                           : batch->checkpoints[slot.checkpoint].body.body.revision;
  }
  /// Returns the first changes of a body of the cluster since its last update or, without one, since the
  /// start of the batch.
  FirstChange& first_change(std::uint32_t number) {
    assert(is_own(number));
    const BatchState::BodySlot& slot = batch->slots[number];
    return slot.update != BatchState::none ? updates.all()[slot.update].first_change
                                           : batch->checkpoints[slot.checkpoint].first_change;
  }
};

}  // namespace kinesphere
