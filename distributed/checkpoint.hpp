// Checkpoint serializes a distributed world to one part per rank, which any number of ranks can restore.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "distributed/body_record.hpp"
#include "distributed/communicator.hpp"
#include "distributed/part.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/world_definition.hpp"

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
  SensorTable sensors{};
  WorldFacts facts{};
  // State of this part alone.
  Counters counters{};
  std::array<std::uint64_t, 2> hash{};
  std::vector<BodyRecord> bodies{};

  static void serialize(auto& self, auto& archive) {
    archive(self.identity, self.part, self.definition, self.sensors, self.facts, self.counters, self.hash,
            self.bodies);
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

}  // namespace kinesphere
