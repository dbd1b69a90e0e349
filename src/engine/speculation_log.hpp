// What an island knows that runs beside others: which bodies are its own, and what it does to them.
//
// Inside a part of a phase (islands.hpp) an island meets nobody else, unless one of its bodies is kicked:
// that body's new capsule may touch others. While islands run, the capsules in the windows stay as they are,
// for all; those of kicked bodies are kept here. A body of nobody's or of another island that a kicked one
// may meet in time is claimed: then the island stops, and runs again with it from where the part began. One
// that it may meet later is counted on to be as it was when the part began, up to the time of the kick.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "broadphase/certificate_queue.hpp"
#include "broadphase/window_policy.hpp"
#include "engine/batch_state.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"

namespace kinesphere {

/// A capsule that a body has from `time` on, in its new window.
struct SweptSphereUpdate {
  std::uint32_t number;
  std::uint32_t revision;
  double time;
  Window window;
  Bound bound;
  Vec3 middle;  ///< where space repeats
  FirstChange first_change{};
};

/// An event, and in which round of its instant it came.
struct EventInRound {
  std::uint32_t round;
  Event event;
};

/// A body of another island, or of nobody's, and until when it has to be as it was when the part began.
struct ReadEntry {
  std::uint32_t number;
  double time;
};

/// A body that was turned, and from where it had set out before.
using UndoEntry = std::pair<BodyId, MotionOrigin>;

/// What an island has done that is only counted.
struct WorkCounters {
  Counters counters{};
  RenewalCounts recertified{};  ///< bodies that were settled one by one
};

/// Where something stands in a list.
struct IndexRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  std::uint32_t size() const { return end - begin; }
  template <class T>
  std::span<const T> of(const std::vector<T>& list) const {
    return std::span(list).subspan(begin, size());
  }
};

/// The lists of several islands, one behind the other: the last one is that of the island that runs now.
/// Those of islands that have been taken back are still there.
template <class T>
class SegmentedList {
 public:
  void clear() {
    all_.clear();
    begin_ = 0;
  }
  /// The next list begins.
  void start() { begin_ = static_cast<std::uint32_t>(all_.size()); }
  void add(const T& one) { all_.push_back(one); }
  /// The same list here: where it stands.
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

/// What came of an island: where it stands in the lists of the thread that ran it.
struct RunRecord {
  std::uint32_t worker = 0;
  std::uint32_t work = 0;
  IndexRange events{};
  IndexRange updates{};
  IndexRange late_pairs{};
  IndexRange conflicts{};
  IndexRange read_set{};
  IndexRange undo_log{};
};

/// What one island knows, and what it has done that others have to see; with the lists of those that the same
/// thread has run before it in this part.
struct SpeculationLog {
  BatchState* batch = nullptr;
  std::uint32_t index = BatchState::unassigned;
  SegmentedList<EventInRound> events;
  SegmentedList<SweptSphereUpdate> updates;   ///< in the order of their times
  SegmentedList<PairCertificate> late_pairs;  ///< that are due later
  SegmentedList<std::uint32_t> conflicts;     ///< whom else it needs
  SegmentedList<ReadEntry> read_set;          ///< with whom it has pairs that are due later
  SegmentedList<UndoEntry> undo_log;
  std::vector<WorkCounters> work;
  /// Of the first of these islands that has failed.
  std::optional<Error> failure;

  /// A part begins.
  void clear() {
    events.clear();
    updates.clear();
    late_pairs.clear();
    conflicts.clear();
    read_set.clear();
    undo_log.clear();
    work.clear();
    failure.reset();
  }
  void begin(BatchState& all, std::uint32_t place) {
    batch = &all;
    index = place;
    events.start();
    updates.start();
    late_pairs.start();
    conflicts.start();
    read_set.start();
    undo_log.start();
  }
  RunRecord end(std::uint32_t worker, const WorkCounters& counters) {
    work.push_back(counters);
    return {worker,
            static_cast<std::uint32_t>(work.size() - 1),
            events.range(),
            updates.range(),
            late_pairs.range(),
            conflicts.range(),
            read_set.range(),
            undo_log.range()};
  }
  /// All has to be answered one by one then.
  bool is_full() const { return updates.size() > batch->most_updates; }
  bool is_own(std::uint32_t number) const { return batch->slots[number].cluster == index; }
  void add(const SweptSphereUpdate& update) {
    note_change(update.number, update.time);
    if (update.revision != last_revision(update.number))
      first_change(update.number).invalidated = update.time;
    batch->slots[update.number].update = updates.range().end;
    updates.add(update);
  }
  /// One of its own is reported, or gets another capsule.
  void note_change(std::uint32_t number, double time) {
    double& first = first_change(number).changed;
    first = std::min(first, time);
  }
  /// A body of another island, which may be changing it now, as it was when the part began; null for all
  /// others.
  const BodyCheckpoint* checkpoint_of(std::uint32_t number) const {
    const std::uint32_t island = batch->slots[number].cluster;
    return island == index || island == BatchState::unassigned ? nullptr : batch->checkpoint_of(number);
  }
  /// Calls visit(number) for each body that has been kicked.
  template <class Visit>
  void for_each_updated(Visit visit) const {
    const auto [first, last] = updates.range();
    for (std::uint32_t k = first; k < last; ++k) {
      const std::uint32_t number = updates.all()[k].number;
      if (batch->slots[number].update == k) visit(number);
    }
  }
  const SweptSphereUpdate* last_update(std::uint32_t number) const {
    const BatchState::BodySlot& place = batch->slots[number];
    return place.cluster == index && place.update != BatchState::none ? &updates.all()[place.update]
                                                                      : nullptr;
  }

 private:
  std::uint32_t last_revision(std::uint32_t number) const {
    const BatchState::BodySlot& place = batch->slots[number];
    return place.update != BatchState::none ? updates.all()[place.update].revision
                                            : batch->checkpoints[place.checkpoint].body.body.revision;
  }
  /// Of one of its own: since its last kick or, if there was none, since the part began.
  FirstChange& first_change(std::uint32_t number) {
    assert(is_own(number));
    const BatchState::BodySlot& place = batch->slots[number];
    return place.update != BatchState::none ? updates.all()[place.update].first_change
                                            : batch->checkpoints[place.checkpoint].first_change;
  }
};

}  // namespace kinesphere
