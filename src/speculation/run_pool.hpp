// RunPool executes clusters. Each worker thread has one event processor, used for one cluster after the
// other, and the log of what its clusters have done.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "processor/event_processor.hpp"
#include "processor/response_handler.hpp"
#include "processor/speculation_log.hpp"
#include "speculation/clusters.hpp"

namespace kinesphere {

class RunPool {
 public:
  /// Creates an event processor for each worker. `handler` may be null; then events get no response.
  RunPool(WorldState& state, const EventProcessor& main, std::size_t workers, const Probe& probe,
          ResponseHandler* handler);

  /// Clears all logs; call at the start of a batch.
  void clear();
  /// Executes the cluster from the start of the batch until its end, until it conflicts with a body outside
  /// the cluster, or until a response that the main processor has to process. Thread-safe for different
  /// clusters and different workers. Throws what a callback throws.
  void run(Cluster& cluster, std::span<const PairCertificate> due, BatchState& batch, std::uint32_t worker);
  /// Returns the error of a cluster whose last run failed; nullopt if it exceeded BatchState::most_updates.
  const std::optional<Error>& failure_of(const Cluster& cluster) const { return log_of(cluster).failure; }

  // Results of the last run of a cluster; empty if it was rolled back.
  std::span<const EventInRound> events_of(const Cluster& cluster) const {
    return of(cluster, &SpeculationLog::events, &RunRecord::events);
  }
  std::span<const SweptSphereUpdate> updates_of(const Cluster& cluster) const {
    return of(cluster, &SpeculationLog::updates, &RunRecord::updates);
  }
  std::span<const PairCertificate> late_pairs_of(const Cluster& cluster) const {
    return of(cluster, &SpeculationLog::late_pairs, &RunRecord::late_pairs);
  }
  std::span<const ReadEntry> read_set_of(const Cluster& cluster) const {
    return of(cluster, &SpeculationLog::read_set, &RunRecord::read_set);
  }
  std::span<const UndoEntry> undo_log_of(const Cluster& cluster) const {
    return of(cluster, &SpeculationLog::undo_log, &RunRecord::undo_log);
  }
  /// Also valid after a rollback.
  std::span<const std::uint32_t> conflicts_of(const Cluster& cluster) const {
    return cluster.record.conflicts.of(log_of(cluster).conflicts.all());
  }
  /// Precondition: the cluster has been executed.
  const WorkCounters& work_of(const Cluster& cluster) const {
    return log_of(cluster).work[cluster.record.work];
  }

  /// Removes the records of rolled-back runs from the logs, if these are most of their entries. Cost:
  /// O(entries) when it removes them.
  void drop_rolled_back(Clusters& clusters, BatchState& batch);

 private:
  struct Worker {
    EventProcessor processor;
    SpeculationLog log{};
  };

  static RunRecord end(Worker& worker, std::uint32_t number);
  Result<void> advance(Worker& worker);
  Result<void> respond(Worker& worker, const Event& event);
  bool changes_more_than_clusters(const Event& event, const Response& answer) const;
  bool act(Worker& worker, const BodyResponse& part);
  const SpeculationLog& log_of(const Cluster& cluster) const { return workers_[cluster.record.worker].log; }
  template <class T>
  std::span<const T> of(const Cluster& cluster, SegmentedList<T> SpeculationLog::*list,
                        IndexRange RunRecord::*range) const {
    if (!cluster.executed) return {};
    return (cluster.record.*range).of((log_of(cluster).*list).all());
  }

  WorldState& state_;
  ResponseHandler* handler_;
  std::vector<Worker> workers_;   ///< by worker
  std::size_t updates_left_ = 0;  ///< updates that remained when the logs were last examined
};

}  // namespace kinesphere
