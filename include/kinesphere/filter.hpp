// Filters: which bodies may touch which.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "kinesphere/body_id.hpp"

namespace kinesphere {

/// Two bodies of the same non-zero group touch if it is positive and do not if it is negative. Any others
/// touch if the category of each has a bit in the mask of the other. By default everything touches
/// everything. Walls are not filtered. Two fixed bodies never touch.
struct Filter {
  std::uint64_t category = 1;
  std::uint64_t mask = std::numeric_limits<std::uint64_t>::max();
  std::int32_t group = 0;

  friend constexpr bool operator==(const Filter&, const Filter&) = default;
};

/// Whether bodies with these filters may touch.
constexpr bool passes(const Filter& a, const Filter& b) {
  if (a.group != 0 && a.group == b.group) return a.group > 0;
  return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

/// Whether two bodies, whose filters let them, may touch: World::set_pair_filter, which says what it may ask
/// the world.
using PairFilter = std::function<bool(BodyId, BodyId)>;

}  // namespace kinesphere
