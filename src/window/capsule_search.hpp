// Which capsules of a table may come near a given one? The inner loop of every search.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "window/capsule.hpp"

namespace kinesphere {

/// A piece of a table, places begin <= k < end, and which query it is searched for.
struct Run {
  std::uint32_t begin;
  std::uint32_t end;
  std::uint32_t query = 0;
};

/// Seven columns of one length: the centres, velocities and radii of capsules of one frame. Behind the last
/// one there must be room to read `capsule_lanes` numbers, as many as are looked at at a time.
using CapsuleColumns = std::array<const float*, 7>;
inline constexpr std::size_t capsule_lanes = 8;

namespace capsule_search {
/// What is added to squares, as those of small numbers are lost.
inline constexpr float least_square = 0x1p-100f;
}  // namespace capsule_search

/// A capsule, and a span of time in which to look at it, from <= to, both in the frame of the table.
struct CapsuleQuery {
  Capsule capsule;
  float from;
  float to;
};

/// Writes to `found`, run by run, the places of all capsules that may touch the capsule of the run's query
/// during its span, and to `ends` how many there are up to the end of each run. `found` has room for all
/// places of all runs. Every capsule that does touch it is among them, if speeds
/// are as capsule_of() lets them be. The same on all processors, to the bit: the best vectors of this one are
/// used (Google Highway), and near_capsules_plain() is the same without.
void near_capsules(const CapsuleColumns& table, std::span<const CapsuleQuery> queries,
                   std::span<const Run> runs, std::uint32_t* found, std::uint32_t* ends);
void near_capsules_plain(const CapsuleColumns& table, std::span<const CapsuleQuery> queries,
                         std::span<const Run> runs, std::uint32_t* found, std::uint32_t* ends);

}  // namespace kinesphere
