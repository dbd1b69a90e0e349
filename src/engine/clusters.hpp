// Which bodies are in an island together, in a part of a phase, and what each island begins with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/certificate_queue.hpp"
#include "engine/bodies.hpp"
#include "engine/speculation_log.hpp"
#include "kinesphere/event.hpp"

namespace kinesphere {

/// The bodies of an island, and what came of them in the last attempt.
struct Cluster {
  std::uint32_t index = 0;        ///< its place
  std::uint32_t merged_into = 0;  ///< the same, unless it has been joined to another one
  bool needs_run = true;          ///< it has to run, or run again
  bool executed = false;          ///< and not taken back
  bool has_run = false;
  bool updates_are_checked = false;
  bool failed = false;
  bool is_unsent = true;  ///< until whoever tells other processes of groups sets it to false
  std::uint32_t runs = 0;
  /// Of the bodies that it has counted on, those that others had kicked before.
  std::uint32_t superseded = 0;
  IndexRange members{};  ///< of the lists of Groups
  IndexRange due{};
  RunRecord record{};
  std::vector<std::uint32_t> dirty{};
  std::vector<Event> pending{};

  bool is_merged() const { return merged_into != index; }
};

/// Lists of bodies and of due pairs, in which each group has a stretch. A group that grows moves to the end
/// of them.
class Clusters {
 public:
  /// A part begins: bodies joined by due pairs are in a group.
  void form(std::span<const PairCertificate> due, const Bodies& bodies,
            std::vector<BatchState::BodySlot>& places);
  /// It ends.
  void clear();

  /// Those that have been joined to others, too. A group is joined only to one with a smaller place.
  std::span<Cluster> all() { return std::span(clusters_).first(count_); }
  std::span<const Cluster> all() const { return std::span(clusters_).first(count_); }
  Cluster& operator[](std::uint32_t own) { return clusters_[own]; }
  const Cluster& operator[](std::uint32_t own) const { return clusters_[own]; }
  std::size_t size() const { return count_; }
  std::span<const std::uint32_t> members_of(const Cluster& group) const { return group.members.of(members_); }
  std::span<const PairCertificate> due_of(const Cluster& group) const { return group.due.of(due_); }
  /// That it is joined to, in the end.
  Cluster& root_of(std::uint32_t own);
  /// Nobody's bodies have none.
  Cluster* cluster_of(std::uint32_t number);
  /// How many bodies are in groups: the places where they are kept are less than this.
  std::size_t checkpoint_count() const { return checkpoint_count_; }

  // Needs a group that is not joined to another one.
  Cluster& add();
  void add_member(Cluster& group, std::uint32_t number);
  void add_due(Cluster& group, const PairCertificate& pair);
  /// Two different ones become one, which is returned.
  Cluster& merge(Cluster& one, Cluster& other);

 private:
  void merge_bodies(std::span<const PairCertificate> due);
  void distribute(std::span<const PairCertificate> due);
  std::uint32_t index_of(std::uint32_t number);
  std::uint32_t root_at(std::uint32_t place);
  std::uint32_t mobile_of(const PairCertificate& pair) const;

  std::vector<BatchState::BodySlot>* slots_ = nullptr;  ///< by body
  const Bodies* bodies_ = nullptr;
  std::vector<Cluster> clusters_;  ///< more than there are in this part, perhaps
  std::size_t count_ = 0;          ///< of those that there are
  std::size_t checkpoint_count_ = 0;
  std::vector<std::uint32_t> members_;
  std::vector<PairCertificate> due_;
  // While groups are formed: by place.
  std::vector<std::uint32_t> numbers_;
  std::vector<std::uint32_t> parents_;  ///< one of the same group, or itself
};

}  // namespace kinesphere
