// Turns bytes into a scenario and operations on its world: any bytes are a stream, so that a fuzzer may write
// them.
//
// A stream is a header, which chooses the scenario, and records of one size, one for each operation; missing
// bytes of the last are zero. So removing one operation leaves the others as they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinesphere/random.hpp"
#include "stream/scenario.hpp"

namespace kinesphere::stream {

using Bytes = std::vector<std::uint8_t>;

/// One operation: its kind, the body that it is about, and a seed of all that it draws.
struct Operation {
  static constexpr std::size_t size = 8;
  std::array<std::uint8_t, size> bytes{};

  std::uint8_t code() const { return bytes[0]; }
  std::uint8_t body() const { return bytes[1]; }
  /// Returns random numbers that depend on this operation alone.
  Random random() const;
};

/// Returns the operations of a stream.
std::vector<Operation> operations_of(std::span<const std::uint8_t> bytes);

/// Returns the scenario that the header of a stream chooses: a seed (8 bytes), the features to leave out (a
/// bit each, 6 bytes), the most bodies at the start (0 for as many as are drawn), and whether it is a crowd.
Scenario scenario_of(std::span<const std::uint8_t> bytes);

/// Returns a stream with this number of random operations, of the scenario with this seed.
Bytes random_stream(std::uint64_t seed, std::size_t operations);

/// Returns a stream for a crowd of hundreds, in which every other operation is a run.
Bytes crowd_stream(std::uint64_t seed, std::size_t operations);

/// Returns the stream with fewer features.
Bytes without_feature(Bytes bytes, std::size_t feature);

/// Returns the stream with at most this number of bodies at the start. Range: [1, 255].
Bytes with_bodies(Bytes bytes, int most);

/// Returns the stream without operations [from, to).
Bytes without(const Bytes& bytes, std::size_t from, std::size_t to);

}  // namespace kinesphere::stream
