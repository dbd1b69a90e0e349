// Counts of a watch.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "archive/archive.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "watch/policy/alert_policy.hpp"

namespace kinesphere::program {

struct MalformedLine {
  std::size_t line = 0;
  std::string reason;
};

struct WatchCounts {
  // Reports that were skipped.
  std::uint64_t repeated = 0;  ///< equal place and time as in an earlier report
  std::uint64_t stale = 0;     ///< from before the time at which their track would have been forgotten
  std::uint64_t ahead = 0;     ///< stamped ahead by more than the limit, and not confirmed
  std::uint64_t outside = 0;   ///< beyond the radius of the map
  std::uint64_t no_position = 0;
  std::uint64_t on_ground = 0;  ///< aircraft without a height, as they say that they are on the ground
  std::uint64_t no_bound = 0;
  std::uint64_t no_velocity = 0;  ///< neither it nor the largest speed is known
  std::uint64_t filtered = 0;     ///< left out by --where or --ignore
  std::uint64_t superseded = 0;   ///< from before their track had its present class
  std::uint64_t crowded = 0;      ///< reports of new tracks at the limit of tracks or open pairs
  std::uint64_t malformed = 0;
  std::vector<MalformedLine> first_malformed;  ///< ten at most

  std::uint64_t no_height =
      0;  ///< reports that were taken, but have no height in a space of three dimensions
  std::uint64_t ignored_heights = 0;  ///< reports that were taken as if they had no height (TrackMap)
  std::uint64_t dropped = 0;          ///< tracks, because there were more open pairs than may be
  std::uint64_t alerts = 0;
  std::uint64_t with_velocity = 0;        ///< reports taken that have a velocity
  std::uint64_t behind = 0;               ///< reports taken that are seconds older than others before them
  std::uint64_t of_own = 0;               ///< reports taken of the own track (--own)
  std::uint64_t lost = 0;                 ///< alerts `lost`
  std::uint64_t handovers = 0;            ///< tracks that have gone on under another id
  std::uint64_t one_bodies = 0;           ///< alerts `one_body`
  std::uint64_t groups = 0;               ///< groups that have begun
  std::uint64_t grouped = 0;              ///< reports of members of groups that the monitor has not got
  std::array<std::uint64_t, 9> events{};  ///< indexed by MonitorEventKind
  std::array<std::uint64_t, alert_fates> fates{};  ///< events, indexed by AlertFate
  /// Changes of the verdict of a separation: to undecided, to within, and back to apart.
  struct Turns {
    std::uint64_t apart = 0, undecided = 0, within = 0;
  };
  std::vector<Turns> turns;

  static void serialize(auto& self, auto& archive) {
    auto& [repeated, stale, ahead, outside, no_position, on_ground, no_bound, no_velocity, filtered,
           superseded, crowded, malformed, first_malformed, no_height, ignored_heights, dropped, alerts,
           with_velocity, behind, of_own, lost, handovers, one_bodies, groups, grouped, events, fates,
           turns] = self;
    archive(repeated, stale, ahead, outside, no_position, on_ground, no_bound, no_velocity, filtered,
            superseded, crowded, malformed, first_malformed, no_height, ignored_heights, dropped, alerts,
            with_velocity, behind, of_own, lost, handovers, one_bodies, groups, grouped, events, fates,
            turns);
  }

  /// Events that are not written.
  std::uint64_t held_back() const {
    return std::accumulate(fates.begin() + 1, fates.end(), std::uint64_t{0});
  }
  /// Reports that cannot be used for what they lack; not those without a position, which receivers of
  /// aircraft have many of, nor those that are meant to be left out.
  std::uint64_t unusable() const { return stale + ahead + outside + no_bound + no_velocity + malformed; }
  /// Reports without a position, and those that are left out as they should be.
  std::uint64_t meant_to_be_left_out() const { return no_position + on_ground + filtered; }
};

}  // namespace kinesphere::program
