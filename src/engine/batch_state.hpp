// What all islands of a part of a phase share: whose each body is, how it was when the part began, and how
// far islands go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "contact/contact_checkpoint.hpp"
#include "engine/bodies.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// What has first changed about a body since something; +infinity where nothing has.
struct FirstChange {
  double changed = infinity;      ///< it was reported, or its window ended
  double invalidated = infinity;  ///< what was known of it became void
};

/// A body as it was when the part began.
struct BodyCheckpoint {
  Bodies::Checkpoint body{};
  ContactCheckpoint contacts{};
  FirstChange first_change{};
};

struct BatchState {
  static constexpr std::uint32_t unassigned = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t none = unassigned;

  struct BodySlot {
    std::uint32_t cluster = unassigned;
    std::uint32_t update = none;      ///< the last one, in the list of the thread that has run its island
    std::uint32_t checkpoint = none;  ///< where it is kept as it was when the part began
  };
  std::vector<BodySlot> slots;  ///< by body; an island changes those of its own
  // By BodySlot::checkpoint. All bodies of islands are kept before these run.
  std::vector<BodyCheckpoint> checkpoints;
  std::vector<std::uint8_t> has_checkpoint;
  double begin = 0.0;  ///< of the part
  double epoch_end = 0.0;
  double stop = 0.0;   ///< islands go up to here,
  double until = 0.0;  ///< and no further than this
  /// Of an island. More would take too long to go through where islands can be left to others.
  std::size_t most_updates = 512;

  bool is_in_batch(double time) const { return time < stop && time <= until; }
  /// Null for a body that is as it was when the part began.
  const BodyCheckpoint* checkpoint_of(std::uint32_t number) const {
    const std::uint32_t place = number < slots.size() ? slots[number].checkpoint : none;
    return place < has_checkpoint.size() && has_checkpoint[place] != 0 ? &checkpoints[place] : nullptr;
  }
};

}  // namespace kinesphere
