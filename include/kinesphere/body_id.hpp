// Names of bodies.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

namespace kinesphere {

/// Names a body for as long as it lives. When a body is removed its index may be used again, with
/// another generation, so an old id is recognised as stale and never mistaken for a newer body.
struct BodyId {
  std::uint32_t index = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t generation = 0;

  friend constexpr auto operator<=>(const BodyId&, const BodyId&) = default;
};

/// The id that names no body: the second body of a wall event, for one.
inline constexpr BodyId no_body{};

}  // namespace kinesphere
