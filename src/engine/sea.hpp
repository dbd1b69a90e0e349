// What all islands of a part of a phase share: whose each body is, how it was when the part began, and how
// far islands go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "contact/kept_contacts.hpp"
#include "engine/bodies.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// What has first changed about a body since something; +infinity where nothing has.
struct Since {
  double change = infinity;  ///< it was reported, or its window ended
  double kick = infinity;    ///< what was known of it became void
};

/// A body as it was when the part began.
struct Kept {
  Bodies::Kept body{};
  KeptContacts contacts{};
  Since since{};
};

struct Sea {
  static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t none = nobody;

  struct Place {
    std::uint32_t island = nobody;
    std::uint32_t kick = none;  ///< the last one, in the list of the thread that has run its island
    std::uint32_t kept = none;  ///< where it is kept as it was when the part began
  };
  std::vector<Place> places;  ///< by body; an island changes those of its own
  // By Place::kept. All bodies of islands are kept before these run.
  std::vector<Kept> kept;
  std::vector<std::uint8_t> is_kept;
  double begin = 0.0;  ///< of the part
  double phase_end = 0.0;
  double stop = 0.0;   ///< islands go up to here,
  double until = 0.0;  ///< and no further than this
  /// Of an island. More would take too long to go through where islands can be left to others.
  std::size_t most_kicks = 512;

  bool comes(double time) const { return time < stop && time <= until; }
  /// Null for a body that is as it was when the part began.
  const Kept* kept_of(std::uint32_t number) const {
    const std::uint32_t place = number < places.size() ? places[number].kept : none;
    return place < is_kept.size() && is_kept[place] != 0 ? &kept[place] : nullptr;
  }
};

}  // namespace kinesphere
