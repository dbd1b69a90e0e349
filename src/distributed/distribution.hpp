// Which rank has which bodies: space is divided among the ranks, bodies go to the rank in whose space they
// are, and copies of them to all ranks that have to know of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "distributed/halo_region.hpp"
#include "distributed/migration.hpp"
#include "distributed/partition.hpp"

namespace kinesphere {

/// All functions but drop_copies() and partitions() are collective. Errors: those of Transit::exchange().
class Distribution {
 public:
  Distribution(Communicator& communicator, ErrorConsensus& agreement, RankState& local, Migration& transit,
               HaloRegions& known);

  // Windows start in these steps. `starters` are the bodies whose windows start now: first own ones alone,
  // and in the end the own ones that are left, those that have come, and copies of others.
  /// The windows of these bodies end on all ranks. Copies among them are dropped, and taken out of `ending`;
  /// own ones have no holders any longer, as these have dropped theirs.
  void drop_ghosts(std::vector<std::uint32_t>& ending);
  /// Divides space anew by the work that bodies have made since the last time, if that was not shared well.
  void divide_space(std::span<const BroadPhase::Starter> starters);
  /// Starters go to the ranks in whose space they are; those that come are added to `starters`.
  Result<void> migrate(std::vector<BroadPhase::Starter>& starters);
  /// Known space grows by the ways of the starters. Ranks tell each other, and own bodies that may come into
  /// the known space of others go there as copies; copies of others that start are added to `starters`.
  /// `anew`: known space is made anew from this rank's part of space and the ways of all its own bodies.
  Result<void> spread(std::vector<BroadPhase::Starter>& starters, bool anew);

  /// Divides space for the bodies of a checkpoint, and sends each to its rank. Copies come with spread().
  Result<void> distribute(std::vector<BodyMessage> messages);

  /// How often space has been divided.
  std::uint64_t partitions() const { return partitions_; }

 private:
  BodyMessage pack_to_start(const BroadPhase::Starter& starter) const;
  Result<void> exchange(SendBuffers& outbox, std::vector<BroadPhase::Starter>& starters);
  Box way_of(const BroadPhase::Starter& starter) const;
  Box core_of(std::span<const Box> ways, std::span<const std::uint32_t> others);
  std::vector<std::vector<Box>> gather_boxes(std::span<const Box> boxes);
  void send_starters(std::span<const BroadPhase::Starter> starters, std::span<const Box> ways,
                     SendBuffers& outbox);
  void send_ghosts(int to, std::span<const std::uint32_t> numbers, SendBuffers& outbox);

  Communicator& communicator_;
  ErrorConsensus& agreement_;
  RankState& local_;
  Migration& transit_;
  HaloRegions& known_;
  Partition partition_;
  std::uint64_t partitions_ = 0;
};

}  // namespace kinesphere
