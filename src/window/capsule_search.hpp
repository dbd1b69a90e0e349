// Which capsules of a table may come near a given one? The inner loop of every search.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "window/capsule.hpp"

namespace kinesphere {

/// A piece of a table: places begin <= k < end.
struct Run {
  std::uint32_t begin;
  std::uint32_t end;
};

/// Seven columns of one length: the centres, velocities and radii of capsules of one frame. Behind the last
/// one there must be room to read `capsule_padding` numbers.
using CapsuleColumns = std::array<const float*, 7>;
inline constexpr std::size_t capsule_padding = 16;

/// A capsule, and a span of time in which to look at it, from <= to, both in the frame of the table.
struct CapsuleQuery {
  Capsule capsule;
  float from;
  float to;
};

/// Writes the places, in the order of the runs, of all capsules that may touch the query's during the span;
/// `found` has room for all places of all runs. Returns how many there are. Every capsule that does touch it
/// is among them, if speeds are as capsule_of() lets them be. The same on all processors, to the bit: the
/// best vectors of this one are used (Google Highway), and near_capsules_plain() is the same without.
std::size_t near_capsules(const CapsuleColumns& table, std::span<const Run> runs, const CapsuleQuery& query,
                          std::uint32_t* found);
std::size_t near_capsules_plain(const CapsuleColumns& table, std::span<const Run> runs,
                                const CapsuleQuery& query, std::uint32_t* found);

}  // namespace kinesphere
