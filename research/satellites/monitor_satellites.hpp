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
  double tolerance = 1e-3;  ///< as MonitorDefinition has it (km)
  double window = 128.0;    ///< the same (s); at most SatelliteMotion::arc_length
};

struct SatelliteWatch {
  /// By pair and begin. Those that have not ended by the last time end then.
  std::vector<SatelliteApproach> approaches;
  MonitorCounters counters{};
  double undecided_time = 0.0;  ///< of all pairs (s)
};

/// What can be said of a satellite at a time, with a plan that is good until `end`, no later than the arc's.
TrackReport report_of(const Arc& arc, double time, double end);

/// From time 0 to `until`. Errors: those of Monitor; out_of_range for the window, and where a satellite
/// accelerates more than was promised of all.
Result<SatelliteWatch> monitor_satellites(SatelliteMotion motion, double until, const WatchOptions& options);

}  // namespace kinesphere
