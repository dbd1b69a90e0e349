// BatchState holds what all clusters of a batch share: the cluster of each body, checkpoints of the bodies at
// the start of the batch, and how far clusters are executed.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "bodies/bodies.hpp"
#include "contact/contact_checkpoint.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// Times of the first changes to a body since its last swept-sphere update or, without one, since the start
/// of the batch; +infinity if there was none.
struct FirstChange {
  double changed = infinity;      ///< first report or new swept sphere
  double invalidated = infinity;  ///< first increment of the revision
};

/// State of a body at the start of the batch.
struct BodyCheckpoint {
  Bodies::Checkpoint body{};
  ContactCheckpoint contacts{};
  FirstChange first_change{};
};

/// A time that several threads may lower and read at once.
class SharedTime {
 public:
  SharedTime(double time = 0.0) : time_(time) {}
  SharedTime(const SharedTime& other) : time_(other) {}
  SharedTime& operator=(const SharedTime& other) {
    time_ = double(other);
    return *this;
  }

  operator double() const { return time_.load(std::memory_order_relaxed); }
  void lower_to(double time) {
    double now = *this;
    while (time < now && !time_.compare_exchange_weak(now, time, std::memory_order_relaxed)) {
    }
  }

 private:
  std::atomic<double> time_;
};

struct BatchState {
  static constexpr std::uint32_t unassigned = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t none = unassigned;

  struct BodySlot {
    std::uint32_t cluster = unassigned;
    /// index of its last update, in the list of the worker that executed its cluster
    std::uint32_t update = none;
    std::uint32_t checkpoint = none;  ///< index of its checkpoint in `checkpoints`
  };
  std::vector<BodySlot> slots;  ///< by body number; a cluster writes only the slots of its own bodies
  // By BodySlot::checkpoint. A cluster's bodies are checkpointed before the cluster is executed.
  std::vector<BodyCheckpoint> checkpoints;
  std::vector<std::uint8_t> has_checkpoint;
  double begin = 0.0;  ///< start of the batch (time)
  double epoch_end = 0.0;
  double next_slice = 0.0;
  /// End of the batch, exclusive. A cluster that needs the main processor lowers it for all others, so that
  /// these do less in vain.
  SharedTime stop;
  double until = 0.0;  ///< end of the run, inclusive
  /// Maximum number of updates of one cluster; execution fails above it. Trades fallbacks to advance()
  /// against the cost of every search, which scans all updates of the cluster.
  std::size_t most_updates = 512;

  bool is_in_batch(double time) const { return time < stop && time <= until; }
  /// Returns nullptr if the body is in the state that it had at the start of the batch.
  const BodyCheckpoint* checkpoint_of(std::uint32_t number) const {
    const std::uint32_t checkpoint_index = number < slots.size() ? slots[number].checkpoint : none;
    return checkpoint_index < has_checkpoint.size() && has_checkpoint[checkpoint_index] != 0
               ? &checkpoints[checkpoint_index]
               : nullptr;
  }
};

}  // namespace kinesphere
