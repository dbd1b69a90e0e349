// What an island knows that runs beside others: which bodies are its own, and what it does to them.
//
// Inside a part of a phase (islands.hpp) an island meets nobody else, unless one of its bodies is kicked:
// that body's new capsule may touch others. While islands run, the capsules in the windows stay as they are,
// for all; those of kicked bodies are kept here. A body of nobody's that a kicked one may meet in time is
// claimed: then the island stops, and runs again with it from where the part began. One that it may meet
// later is counted on to stay nobody's.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "kinesphere/bound.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/run.hpp"
#include "window/agenda.hpp"
#include "window/windows.hpp"

namespace kinesphere {

/// Whose each body is, and how far islands go.
struct Sea {
  static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t none = nobody;

  struct Place {
    std::uint32_t island = nobody;
    std::uint32_t kick = none;  ///< the last one, among those of its island
    std::uint32_t kept = none;  ///< where the island keeps it as it was when the part began
  };
  std::vector<Place> places;  ///< by body; an island changes those of its own
  double phase_end = 0.0;
  double stop = 0.0;   ///< islands go up to here,
  double until = 0.0;  ///< and no further than this
  /// Of an island. More would take too long to go through where islands can be left to others.
  std::size_t most_kicks = 512;

  bool comes(double time) const { return time < stop && time <= until; }
};

/// A capsule that a body has from `time` on, in its new window.
struct BodyKick {
  std::uint32_t number;
  double time;
  Window window;
  Bound bound;
  Vec3 middle;  ///< where space repeats
};

/// What one island knows, and what it has done that others have to see.
struct Beside {
  Sea* sea = nullptr;
  std::uint32_t own = Sea::nobody;
  std::vector<BodyKick> kicks;        ///< in the order of their times
  std::vector<std::uint32_t> claims;  ///< whom else it needs
  /// Nobody's, with whom it has pairs that are due later: nobody may move them.
  std::vector<std::uint32_t> counted_on;
  std::vector<std::pair<BodyId, Departure>> turned;  ///< from where they had set out before

  void begin(Sea& all, std::uint32_t place) {
    sea = &all;
    own = place;
    kicks.clear();
    claims.clear();
    counted_on.clear();
    turned.clear();
  }
  /// All has to be answered one by one then.
  bool is_full() const { return kicks.size() > sea->most_kicks; }
  bool is_own(std::uint32_t number) const { return sea->places[number].island == own; }
  void add(const BodyKick& kick) {
    sea->places[kick.number].kick = static_cast<std::uint32_t>(kicks.size());
    kicks.push_back(kick);
  }
  /// Of one of its own.
  bool is_last(std::uint32_t place) const { return sea->places[kicks[place].number].kick == place; }
  const BodyKick* last_kick(std::uint32_t number) const {
    const Sea::Place& place = sea->places[number];
    return place.island == own && place.kick != Sea::none ? &kicks[place.kick] : nullptr;
  }
};

/// What an island begins with: pairs that are due, bodies that have to be settled before anything else, and
/// events that are known already.
struct Beginning {
  std::vector<HotPair> due{};
  std::vector<std::uint32_t> unsettled{};
  std::vector<Event> pending{};

  void clear() {
    due.clear();
    unsettled.clear();
    pending.clear();
  }
  void add(const Beginning& more) {
    due.insert(due.end(), more.due.begin(), more.due.end());
    unsettled.insert(unsettled.end(), more.unsettled.begin(), more.unsettled.end());
    pending.insert(pending.end(), more.pending.begin(), more.pending.end());
  }
};

/// An event, and in which round of its instant it came.
struct Told {
  std::uint32_t round;
  Event event;
};

}  // namespace kinesphere
