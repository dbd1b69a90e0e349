// SpeculativeRunner executes the clusters of a batch with several threads, detects conflicts between them,
// and commits or rolls back their results (optimistic execution, as in Time Warp).
//
// An epoch begins when windows have started and ends when the next windows start. A batch is a part of an
// epoch that ends after a limited number of due pairs. Bodies connected by certificates due in the batch form
// a cluster. Clusters are executed concurrently, each as if it were alone (event_processor.hpp). That is
// correct as long as no body whose velocity changed may meet a body of another cluster. Therefore:
// - A cluster that conflicts with a body outside it stops. It takes the body, or is merged with the body's
//   cluster, and is executed again from the start of the batch.
// - A cluster whose read set contains a body that another cluster changed too early is merged with that
//   cluster.
// - A response that concerns more than its cluster (RunPool) ends the batch before its instant, which
//   the main processor then processes alone.
// - When there are no such conflicts, the updated swept spheres of all clusters are compared. Clusters of two
//   bodies that may meet in the batch are merged and executed again. Two bodies that may meet later get a
//   certificate, as if a search had found the pair.
//
// The result equals that of one processor with all bodies, in another order: the reports, certificates and
// events of a body depend on its own cluster alone. So the result depends neither on the number of threads,
// nor on the assignment of clusters to threads, nor on the ends of batches. Events are delivered after the
// batch, in the order of their times, rounds and kinds.
#pragma once

#include <cstdint>
#include <deque>
#include <exception>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "parallel/thread_pool.hpp"
#include "processor/event_processor.hpp"
#include "speculation/batch_sizer.hpp"
#include "speculation/clusters.hpp"
#include "speculation/conflict_detector.hpp"
#include "speculation/cross_cluster_pairs.hpp"
#include "speculation/run_pool.hpp"

namespace kinesphere {

/// Work that a cluster begins with: certificates that are due, bodies to recertify first, and events that are
/// known already.
struct InitialWork {
  std::vector<PairCertificate> due{};
  std::vector<std::uint32_t> dirty{};
  std::vector<Event> pending{};
};

class SpeculativeRunner {
 public:
  /// `handler` may be null; then events get no response.
  SpeculativeRunner(WorldState& state, EventProcessor& main, PoolLease& lease, const Probe& probe,
                    ResponseHandler* handler);

  /// Advances from now to `until` or to the end of a batch, whichever is earlier, except for what is due at
  /// that time, and appends the events. Returns false, without any change, if too few or too unequal clusters
  /// exist, if they are executed again too often in this batch or were in earlier epochs, or if a callback
  /// fails; advance() then repeats the failure. Precondition: EventProcessor::is_certified() of the main
  /// processor. Throws the exception of a motion source that failed to restore an origin, after all other
  /// origins were restored.
  bool run(double until, std::deque<Event>& events);
  /// Returns the time of an instant that the main processor has to process alone, if the last batch ended
  /// before it for that reason.
  const std::optional<double>& exclusive() const { return exclusive_; }

  // Single steps of run(), for a process that owns some of the bodies and learns from other processes between
  // the steps which clusters to merge. The batch begins with the dirty bodies and pending events of the main
  // processor.

  /// Takes the certificates due from now to `until`, to the end of a batch, or to `latest`, whichever is
  /// earliest. Returns that time.
  double take_due(double until, double latest);
  /// Begins a batch that ends at `stop`, and forms its clusters. Precondition: `stop` is not later than the
  /// result of take_due().
  void begin_batch(double stop);
  /// Executes the clusters that need it and for which is_ready(cluster) is true. Merges clusters with
  /// conflicts and executes them again until there are none. Returns false if a run failed or if runs were
  /// repeated too often.
  template <class IsReady>
  bool execute_all(IsReady is_ready) {
    return run_rounds([&] {
      for (const Cluster& cluster : clusters_.all())
        if (cluster.needs_run && is_ready(cluster)) to_run_.push_back(cluster.index);
    });
  }
  /// Returns the error of the run that failed.
  const std::optional<Error>& failure() const { return failure_; }
  /// Returns all clusters, including merged ones. A cluster is merged only into one with a smaller index.
  std::span<Cluster> clusters() { return clusters_.all(); }
  /// Returns nullptr if the body belongs to no cluster.
  Cluster* cluster_of(std::uint32_t number) { return clusters_.cluster_of(number); }
  std::span<const std::uint32_t> members_of(const Cluster& cluster) const {
    return clusters_.members_of(cluster);
  }
  std::span<const PairCertificate> due_of(const Cluster& cluster) const { return clusters_.due_of(cluster); }
  // Results of the last run of a cluster; empty if it was rolled back.
  std::span<const SweptSphereUpdate> updates_of(const Cluster& cluster) const {
    return pool_.updates_of(cluster);
  }
  std::span<const PairCertificate> late_pairs_of(const Cluster& cluster) const {
    return pool_.late_pairs_of(cluster);
  }
  std::span<const ReadEntry> read_set_of(const Cluster& cluster) const { return pool_.read_set_of(cluster); }
  std::span<const UndoEntry> undo_log_of(const Cluster& cluster) const { return pool_.undo_log_of(cluster); }
  /// Merges clusters so that one cluster contains all these bodies.
  void merge_bodies(std::span<const std::uint32_t> numbers);
  /// Adds initial work, of bodies that became known after begin_batch().
  void add(const InitialWork& more);
  /// Adds an update that another process made; take_conflicts() then returns the clusters here that may meet
  /// the body.
  void add_foreign_update(const SweptSphereUpdate& update) { conflicts_.add_foreign(update); }
  /// Returns pairs of a cluster and the number of a body, updated by another process, that it may meet.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> take_conflicts() {
    return conflicts_.take_conflicts();
  }
  /// Rolls the cluster back, to be executed again from the start of the batch.
  void run_again(std::uint32_t own) {
    rollback(clusters_[own]);
    clusters_[own].needs_run = true;
  }
  /// Returns true if the time is before the end of the batch.
  bool is_in_batch(double time) const { return batch_.is_in_batch(time); }
  /// Returns nullptr if the body is in the state that it had at the start of the batch.
  const BodyCheckpoint* checkpoint_of(std::uint32_t number) const { return batch_.checkpoint_of(number); }
  /// Commits the results of all clusters to the main processor. Returns the events of clusters for which
  /// is_counted(cluster) is true, in their order; only the work of these is counted. Precondition:
  /// execute_all() returned true.
  template <class IsCounted>
  std::vector<const EventInRound*> commit(IsCounted is_counted) {
    std::vector<const EventInRound*> committed;
    for (const Cluster& cluster : clusters_.all())
      if (!cluster.is_merged() && cluster.executed) commit(cluster, is_counted(cluster), committed);
    commit(committed);
    return committed;
  }
  /// Rolls back all clusters, which restores the state at the start of the batch.
  void rollback();
  /// Ends the batch after commit() or rollback().
  void end_batch();
  /// Forces speculative execution of every epoch, however long it takes and however few pairs are due.
  void require_speculation() {
    batch_.most_updates = std::numeric_limits<std::size_t>::max();
    sizer_.require_speculation();
  }

 private:
  bool is_worthwhile() const;
  template <class FindAgain>
  bool run_rounds(FindAgain find_again);
  bool execute_found();
  void end_before_exclusive();
  void checkpoint(const Cluster& cluster);
  void rollback(Cluster& cluster);
  void restore_origin(const UndoEntry& entry);
  void add_member(Cluster& cluster, std::uint32_t number);
  void merge(Cluster& one, Cluster& other);
  bool merge_conflicts();
  bool merge_read_sets();
  PairCertificate certificate_of(const SweptSphereUpdate& update, const SweptSphereUpdate& other,
                                 double until) const;
  bool merge_updates();
  void commit(const Cluster& cluster, bool is_counted, std::vector<const EventInRound*>& committed);
  void commit(std::vector<const EventInRound*>& committed);
  void register_updates();

  WorldState& state_;
  EventProcessor& main_;
  PoolLease& lease_;
  ResponseHandler* handler_;
  BatchSizer sizer_;
  // State of the batch.
  BatchState batch_;
  Clusters clusters_;
  RunPool pool_;
  ConflictDetector conflicts_;
  CrossClusterPairs cross_pairs_;
  std::vector<PairCertificate> due_;
  std::vector<PairCertificate> deferred_;  ///< certificates that return to the queue of the main processor
  std::vector<std::uint32_t> to_run_;      ///< clusters to execute next
  std::optional<double> exclusive_;
  std::optional<Error> failure_;
  std::exception_ptr exception_;  ///< thrown by a motion source while an origin was restored
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
