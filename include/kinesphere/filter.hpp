// Filters: select the pairs of bodies that may touch.
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "kinesphere/body_id.hpp"
#include "kinesphere/callback.hpp"

namespace kinesphere {

/// Selects the bodies that a body may touch. Two bodies in one non-zero group may touch if the group is
/// positive, and may not if it is negative. Any other pair may touch if the category of each has a bit in
/// the mask of the other. By default every pair may touch. A body without a filter of its own, as a floor of
/// World::add_static(), has the category 1: a mask without that bit lets its body fall through the floor. Put
/// the bit into the mask, or give the floor all categories. The walls of a world meet every body unless they
/// have a filter, too (WorldDefinition::wall_filter). Two static bodies never touch.
struct Filter {
  std::uint64_t category = 1;
  std::uint64_t mask = std::numeric_limits<std::uint64_t>::max();
  std::int32_t group = 0;

  friend constexpr bool operator==(const Filter&, const Filter&) = default;
};

/// Returns true if bodies with these filters may touch.
constexpr bool passes(const Filter& a, const Filter& b) {
  if (a.group != 0 && a.group == b.group) return a.group > 0;
  return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

/// Any callable `bool(BodyId, BodyId)` that returns true if two bodies whose filters let them touch may do
/// so, or none, which lets all of them. The world keeps it, so unlike other callbacks it owns its callable,
/// named or not. World::set_pair_filter() gives its preconditions and the calls that it may make.
class PairFilter : public Callback<bool(BodyId, BodyId)> {
 public:
  /// Makes an empty one.
  PairFilter() = default;
  /// Keeps the callable.
  template <class Callable>
  requires(!std::is_same_v<Callable, PairFilter> && std::is_constructible_v<Callback, Callable>)
      PairFilter(Callable callable)
      : Callback(std::move(callable)) {}
};

}  // namespace kinesphere
