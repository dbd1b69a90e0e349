// Which rank has which bodies: space is divided among the ranks, bodies go to the rank in whose space they
// are, and copies of them to all ranks that have to know of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "distributed/known_space.hpp"
#include "distributed/partition.hpp"
#include "distributed/transit.hpp"

namespace kinesphere {

/// All functions but drop_copies() and partitions() are collective. Errors: those of Transit::exchange().
class Distribution {
 public:
  Distribution(Communicator& communicator, Agreement& agreement, LocalWorld& local, Transit& transit,
               KnownSpaces& known);

  // Windows start in these steps. `starters` are the bodies whose windows start now: first own ones alone,
  // and in the end the own ones that are left, those that have come, and copies of others.
  /// The windows of these bodies end on all ranks. Copies among them are dropped, and taken out of `ending`;
  /// own ones have no holders any longer, as these have dropped theirs.
  void drop_copies(std::vector<std::uint32_t>& ending);
  /// Divides space anew by the work that bodies have made since the last time, if that was not shared well.
  void divide_space(std::span<const Windows::Starter> starters);
  /// Starters go to the ranks in whose space they are; those that come are added to `starters`.
  Result<void> migrate(std::vector<Windows::Starter>& starters);
  /// Known space grows by the ways of the starters. Ranks tell each other, and own bodies that may come into
  /// the known space of others go there as copies; copies of others that start are added to `starters`.
  /// `anew`: known space is made anew from this rank's part of space and the ways of all its own bodies.
  Result<void> spread(std::vector<Windows::Starter>& starters, bool anew);

  /// Divides space for the bodies of a checkpoint, and sends each to its rank. Copies come with spread().
  Result<void> deal_out(std::vector<Parcel> parcels);

  /// How often space has been divided.
  std::uint64_t partitions() const { return partitions_; }

 private:
  Parcel pack_to_start(const Windows::Starter& starter) const;
  Result<void> exchange(Outbox& outbox, std::vector<Windows::Starter>& starters);
  Box way_of(const Windows::Starter& starter) const;
  Box core_of(std::span<const Box> ways, std::span<const std::uint32_t> others);
  std::vector<std::vector<Box>> gather_boxes(std::span<const Box> boxes);
  void send_starters(std::span<const Windows::Starter> starters, std::span<const Box> ways, Outbox& outbox);
  void send_copies(int to, std::span<const std::uint32_t> numbers, Outbox& outbox);

  Communicator& communicator_;
  Agreement& agreement_;
  LocalWorld& local_;
  Transit& transit_;
  KnownSpaces& known_;
  Partition partition_;
  std::uint64_t partitions_ = 0;
};

}  // namespace kinesphere
