// Every approach of satellites, by a monitor that asks for their states.
#pragma once

#include <cstdint>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "lab/orbits/orbit.hpp"
#include "lab/orbits/orbit_approach.hpp"

namespace kinesphere {

struct WatchOptions {
  double distance = 5.0;
  double tolerance = 1e-3;  ///< as MonitorDefinition has it (km)
  double window = 128.0;    ///< the same (s)
  /// Plans of slow satellites are good for several windows: as long as they stray no farther than this.
  double stray = 1.0;
};

struct OrbitWatch {
  /// By pair and begin. Those that have not ended by the last time end then.
  std::vector<OrbitApproach> approaches;
  MonitorCounters counters{};
  std::uint64_t undecided = 0;  ///< events that left a pair undecided
  double undecided_time = 0.0;  ///< of all pairs (s)
};

/// From time 0 to `until`. Errors: those of Monitor.
Result<OrbitWatch> watch_orbits(const std::vector<Orbit>& orbits, double until, const WatchOptions& options);

}  // namespace kinesphere
