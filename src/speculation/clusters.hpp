// Clusters partitions the bodies of a batch: bodies of one cluster are executed together. It also holds the
// initial work of each cluster.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bodies/bodies.hpp"
#include "broadphase/certificate_queue.hpp"
#include "kinesphere/event.hpp"
#include "processor/speculation_log.hpp"

namespace kinesphere {

/// The bodies of a cluster, and the record of its last execution.
struct Cluster {
  std::uint32_t index = 0;        ///< index in Clusters
  std::uint32_t merged_into = 0;  ///< cluster that this one was merged into; equal to `index` if not merged
  bool needs_run = true;          ///< must be executed, or executed again
  bool executed = false;          ///< executed and not rolled back
  bool has_run = false;
  bool updates_are_checked = false;
  bool failed = false;
  /// Set when the cluster changes; cleared by the code that sends clusters to other processes.
  bool is_unsent = true;
  std::uint32_t runs = 0;
  /// Number of bodies in the read set that other clusters invalidated before the time of the read.
  std::uint32_t superseded = 0;
  IndexRange members{};  ///< range in the lists of Clusters
  IndexRange due{};
  RunRecord record{};
  std::vector<std::uint32_t> dirty{};
  std::vector<Event> pending{};

  bool is_merged() const { return merged_into != index; }
};

/// Lists of bodies and of due pairs, in which each cluster has a contiguous range. A cluster that grows moves
/// its range to the end.
class Clusters {
 public:
  /// Forms the clusters of a batch: bodies connected by due pairs share a cluster.
  void form(std::span<const PairCertificate> due, const Bodies& bodies,
            std::vector<BatchState::BodySlot>& slots);
  /// Removes all clusters; call at the end of a batch.
  void clear();

  /// Returns all clusters, including merged ones. A cluster is merged only into one with a smaller index.
  std::span<Cluster> all() { return std::span(clusters_).first(count_); }
  std::span<const Cluster> all() const { return std::span(clusters_).first(count_); }
  Cluster& operator[](std::uint32_t index) { return clusters_[index]; }
  const Cluster& operator[](std::uint32_t index) const { return clusters_[index]; }
  std::size_t size() const { return count_; }
  std::span<const std::uint32_t> members_of(const Cluster& cluster) const {
    return cluster.members.of(members_);
  }
  std::span<const PairCertificate> due_of(const Cluster& cluster) const { return cluster.due.of(due_); }
  /// Follows merges to the cluster that finally contains this one.
  Cluster& root_of(std::uint32_t index);
  /// Returns nullptr if the body belongs to no cluster.
  Cluster* cluster_of(std::uint32_t number);
  /// Returns the number of bodies in clusters; each BodySlot::checkpoint is smaller.
  std::size_t checkpoint_count() const { return checkpoint_count_; }

  // add_member() and add_due() require a cluster that is not merged.
  Cluster& add();
  void add_member(Cluster& cluster, std::uint32_t number);
  void add_due(Cluster& cluster, const PairCertificate& pair);
  /// Merges two different clusters into the one with the smaller index, which is returned. Precondition:
  /// neither is merged already.
  Cluster& merge(Cluster& one, Cluster& other);

 private:
  void merge_bodies(std::span<const PairCertificate> due);
  void distribute(std::span<const PairCertificate> due);
  std::uint32_t index_of(std::uint32_t number);
  std::uint32_t root_at(std::uint32_t node);
  std::uint32_t mobile_of(const PairCertificate& pair) const;

  std::vector<BatchState::BodySlot>* slots_ = nullptr;  ///< by body number
  const Bodies* bodies_ = nullptr;
  std::vector<Cluster> clusters_;  ///< may contain unused clusters of earlier batches
  std::size_t count_ = 0;          ///< number of clusters in use
  std::size_t checkpoint_count_ = 0;
  std::vector<std::uint32_t> members_;
  std::vector<PairCertificate> due_;
  // Scratch lists of form(), by index of first occurrence.
  std::vector<std::uint32_t> numbers_;
  std::vector<std::uint32_t> parents_;  ///< parent in the union-find forest; a root is its own parent
};

}  // namespace kinesphere
