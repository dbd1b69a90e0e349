// What a watch remembers of the reports of a track, to know which ids may be one body.
#pragma once

#include <cstdint>
#include <limits>

#include "kinesphere/body.hpp"
#include "kinesphere/monitor/monitor_event.hpp"

namespace kinesphere::program {

/// Times and lengths are those of the monitor.
struct Sighting {
  // The latest report.
  State state{};
  double stamp = 0.0;
  double velocity_error = 0.0;  ///< in the plane; infinite: no velocity is known
  double first = 0.0;           ///< timestamp of the first report
  double interval = 0.0;        ///< the longest one between its latest reports; 0: it has one report
  std::uint32_t reports = 0;
  std::uint32_t place = 0;  ///< number in LatestPlaces

  /// Of a track that may be one body with another one that began before it (SameBodies).
  struct Link {
    TrackId former = 0;      ///< that track; 0: none
    bool may_go_on = false;  ///< the former track has not reported since: this one may go on as it
    bool is_told = false;    ///< an alert has told that the two are one body
    // Reports of both that were alike.
    std::uint32_t alike = 0, former_alike = 0;
    double due = std::numeric_limits<double>::infinity();  ///< when it is given up
  };
  Link link{};
  TrackId later = 0;  ///< the track with a link to this one; 0: none

  /// Leaves out the place, which SameBodies finds anew.
  static void serialize(auto& self, auto& archive) {
    auto& [state, stamp, velocity_error, first, interval, reports, place, link, later] = self;
    archive(state, stamp, velocity_error, first, interval, reports, link, later);
  }
};

}  // namespace kinesphere::program
