// SpeculativeRunner that run: each thread has one, which runs for one group after the other, and the lists of
// what came of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/clusters.hpp"
#include "engine/event_processor.hpp"
#include "engine/response_handler.hpp"
#include "engine/speculation_log.hpp"

namespace kinesphere {

class RunPool {
 public:
  /// One island for each worker. `answerer` may be null: then events get no answer.
  RunPool(WorldState& tables, const EventProcessor& main, std::size_t workers, const Probe& probe,
          ResponseHandler* handler);

  /// A part begins.
  void clear();
  /// Runs the group's island from where the part begins, as far as islands go, or to where it claims a body
  /// that is not its own. Throws what a callback throws. Several threads may do that at the same time, each
  /// as another worker, for different groups.
  void run(Cluster& group, std::span<const PairCertificate> due, BatchState& batch, std::uint32_t worker);
  /// Of a group whose last attempt failed: none, where it had to stop.
  const std::optional<Error>& failure_of(const Cluster& group) const { return log_of(group).failure; }

  // What came of a group in the last attempt; nothing, if it has been taken back.
  std::span<const EventInRound> events_of(const Cluster& group) const {
    return of(group, &SpeculationLog::events, &RunRecord::events);
  }
  std::span<const SweptSphereUpdate> updates_of(const Cluster& group) const {
    return of(group, &SpeculationLog::updates, &RunRecord::updates);
  }
  std::span<const PairCertificate> late_pairs_of(const Cluster& group) const {
    return of(group, &SpeculationLog::late_pairs, &RunRecord::late_pairs);
  }
  std::span<const ReadEntry> read_set_of(const Cluster& group) const {
    return of(group, &SpeculationLog::read_set, &RunRecord::read_set);
  }
  std::span<const UndoEntry> undo_log_of(const Cluster& group) const {
    return of(group, &SpeculationLog::undo_log, &RunRecord::undo_log);
  }
  /// Also of one that has been taken back.
  std::span<const std::uint32_t> conflicts_of(const Cluster& group) const {
    return group.record.conflicts.of(log_of(group).conflicts.all());
  }
  /// Of one that has been attempted.
  const WorkCounters& work_of(const Cluster& group) const { return log_of(group).work[group.record.work]; }

  /// Lists forget what groups have done that were taken back since, when that is most of what they have.
  void drop_rolled_back(Clusters& groups, BatchState& batch);

 private:
  struct Worker {
    EventProcessor processor;
    SpeculationLog log{};
  };

  static RunRecord end(Worker& runner, std::uint32_t worker);
  Result<void> advance(Worker& runner);
  Result<void> respond(Worker& runner, const Event& event);
  const SpeculationLog& log_of(const Cluster& group) const { return workers_[group.record.worker].log; }
  template <class T>
  std::span<const T> of(const Cluster& group, SegmentedList<T> SpeculationLog::*list,
                        IndexRange RunRecord::*range) const {
    if (!group.executed) return {};
    return (group.record.*range).of((log_of(group).*list).all());
  }

  ResponseHandler* handler_;
  std::vector<Worker> workers_;   ///< by worker
  std::size_t updates_kept_ = 0;  ///< in the lists, when these were looked through
};

}  // namespace kinesphere
