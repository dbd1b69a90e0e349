// The whole of a distributed world as bytes: a part for each rank, which any number of ranks can go on from.
//
// Of windows, no more is kept than in which one each body is: a capsule that is made anew holds what the body
// may do from now on, and decides nothing (docs/distributed.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "broadphase/window_policy.hpp"
#include "distributed/body_message.hpp"
#include "distributed/communicator.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/world_definition.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// A part of a checkpoint: what one rank has of the world.
struct Checkpoint {
  /// The same in all parts of one checkpoint.
  struct Stamp {
    std::uint64_t parts = 0;
    double time = 0.0;
    std::array<std::uint64_t, 2> hash{};

    template <class Self, class Archive>
    static void serialize(Self& self, Archive& archive) {
      auto& [count, when, events] = self;
      archive(count, when, events);
    }
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };

  Stamp stamp{};
  std::uint64_t part = 0;
  WorldDefinition definition{};
  // The same in all parts, too.
  std::vector<std::byte> window_policy{};
  SensorTable sensors{};
  double epoch_end = infinity;
  // Of this part.
  RenewalCounts kicks{};
  Counters counters{};
  std::array<std::uint64_t, 2> hash{};
  std::vector<BodyMessage> bodies{};

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    archive(self.stamp, self.part, self.definition, self.window_policy, self.sensors, self.epoch_end,
            self.kicks, self.counters, self.hash, self.bodies);
  }

  std::vector<std::byte> write() const;
  /// Errors: bad_snapshot.
  static Result<Checkpoint> read(std::span<const std::byte> bytes);
  static Result<std::vector<Checkpoint>> read_all(std::span<const std::vector<std::byte>> parts);
};

/// Collective: each rank has some of the parts, or none. Sets `common` to what all parts have alike, as far
/// as there are parts. Errors: bad_snapshot, if the parts of all ranks are not those of one world, each of
/// them once.
Result<void> gather_common(Communicator& communicator, std::span<const Checkpoint> here, Checkpoint& common);

/// Errors: bad_snapshot.
Result<void> read_window_policy(std::span<const std::byte> bytes, WindowPolicy& window_policy);

}  // namespace kinesphere
