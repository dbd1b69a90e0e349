// Every approach of satellites, by a monitor that asks for their states.
#pragma once

#include <cstdint>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "research/satellites/satellite_approach.hpp"
#include "research/satellites/satellite_motion.hpp"

namespace kinesphere {

struct WatchOptions {
  double distance = 5.0;    ///< km
  double tolerance = 1e-3;  ///< tolerance of the monitor (km)
  double window = 128.0;    ///< window of the monitor (s); at most SatelliteMotion::arc_length
};

struct SatelliteWatch {
  /// Sorted by pair and begin. Approaches that have not ended at the last time end then.
  std::vector<SatelliteApproach> approaches;
  MonitorCounters counters{};
  double undecided_time = 0.0;  ///< sum over all pairs (s)
};

/// Returns the report of a satellite at a time, with a plan that holds until `end`, no later than the arc's
/// end.
TrackReport report_of(const Arc& arc, double time, double end);

/// Runs a monitor from time 0 to `until`. Errors: those of Monitor; out_of_range for the window, and for a
/// satellite that accelerates more than the class of all satellites allows.
Result<SatelliteWatch> monitor_satellites(SatelliteMotion motion, double until, const WatchOptions& options);

}  // namespace kinesphere
