// Distribution assigns bodies to ranks: it partitions space, migrates bodies to the rank whose region
// contains them, and sends ghosts to all ranks that need them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "distributed/halo_region.hpp"
#include "distributed/migration.hpp"
#include "distributed/partition.hpp"

namespace kinesphere {

/// All functions except drop_ghosts() and partitions() are collective. Errors: those of
/// Migration::exchange().
class Distribution {
 public:
  Distribution(Communicator& communicator, ErrorConsensus& consensus, RankState& rank_state,
               Migration& migration, HaloRegions& known);

  // Windows start in the following steps, in this order. `starters` are the bodies whose windows start now:
  // at first own bodies only; in the end the remaining own bodies, bodies that have migrated here, and
  // ghosts.
  /// Ends the windows of these bodies, which end on all ranks. Drops ghosts among them and removes these from
  /// `ending`; clears the holders of own bodies, as the holders have dropped their ghosts.
  void drop_ghosts(std::vector<std::uint32_t>& ending);
  /// Repartitions space by the work of bodies since the last partition, if the imbalance exceeds its limit or
  /// space has not been partitioned yet.
  void divide_space(std::span<const BroadPhase::Starter> starters);
  /// Migrates starters to the ranks whose region contains them. Appends arriving starters to `starters`.
  Result<void> migrate(std::vector<BroadPhase::Starter>& starters);
  /// Extends this rank's halo region by the swept boxes of the starters, and exchanges the additions with all
  /// ranks. Sends own bodies that may enter the halo region of another rank there as ghosts. Appends arriving
  /// ghosts that start to `starters`. `anew`: rebuilds the halo region from this rank's region of space and
  /// the swept boxes of all its own bodies.
  Result<void> update_ghosts(std::vector<BroadPhase::Starter>& starters, bool anew);

  /// Partitions space for the bodies of a checkpoint and sends each body to its rank. Does not send ghosts;
  /// spread() does.
  Result<void> distribute(std::vector<BodyMessage> messages);

  /// Number of times that space has been partitioned.
  std::uint64_t partitions() const { return partitions_; }

 private:
  BodyMessage pack_to_start(const BroadPhase::Starter& starter) const;
  Result<void> exchange(SendBuffers& buffers, std::vector<BroadPhase::Starter>& starters);
  Box way_of(const BroadPhase::Starter& starter) const;
  Box core_of(std::span<const Box> ways, std::span<const std::uint32_t> others);
  std::vector<std::vector<Box>> gather_boxes(std::span<const Box> boxes);
  void send_starters(std::span<const BroadPhase::Starter> starters, std::span<const Box> ways,
                     SendBuffers& buffers);
  void send_ghosts(int to, std::span<const std::uint32_t> numbers, SendBuffers& buffers);

  Communicator& communicator_;
  ErrorConsensus& consensus_;
  RankState& rank_;
  Migration& migration_;
  HaloRegions& known_;
  Partition partition_;
  std::uint64_t partitions_ = 0;
};

}  // namespace kinesphere
