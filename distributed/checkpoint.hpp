// Checkpoint serializes a distributed world to one part per rank, which any number of ranks can restore.
//
// For each body, only its window is saved, not its swept sphere. A swept sphere computed at restore contains
// the body's motion from then on, and it does not affect any result (docs/distributed.md).
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
#include "processor/spot_checks.hpp"

namespace kinesphere {

/// One part of a checkpoint: the state of one rank.
struct Checkpoint {
  /// Identity of a checkpoint; equal in all of its parts.
  struct Identity {
    std::uint64_t parts = 0;
    double time = 0.0;
    std::array<std::uint64_t, 2> hash{};
    friend bool operator==(const Identity&, const Identity&) = default;
  };

  Identity identity{};
  std::uint64_t part = 0;
  WorldDefinition definition{};
  // Shared state; equal in all parts.
  std::vector<std::byte> window_policy{};
  SensorTable sensors{};
  double epoch_end = infinity;
  SpotChecks spot_checks{};
  // State of this part alone.
  RenewalCounts recertified{};
  Counters counters{};
  std::array<std::uint64_t, 2> hash{};
  std::vector<BodyMessage> bodies{};

  static void serialize(auto& self, auto& archive) {
    archive(self.identity, self.part, self.definition, self.window_policy, self.sensors, self.epoch_end,
            self.spot_checks, self.recertified, self.counters, self.hash, self.bodies);
  }

  std::vector<std::byte> write() const;
  /// Reads one part. Errors: bad_snapshot.
  static Result<Checkpoint> read(std::span<const std::byte> bytes);
  static Result<std::vector<Checkpoint>> read_all(std::span<const std::vector<std::byte>> parts);
};

/// Collective; each rank passes some of the parts or none. Sets `common` to the state that all parts share,
/// as far as there are parts. Errors: bad_snapshot unless the parts of all ranks are exactly those of one
/// world, each present once.
Result<void> gather_common(Communicator& communicator, std::span<const Checkpoint> here, Checkpoint& common);

/// Reads a window policy. Errors: bad_snapshot.
Result<void> read_window_policy(std::span<const std::byte> bytes, WindowPolicy& window_policy);

}  // namespace kinesphere
