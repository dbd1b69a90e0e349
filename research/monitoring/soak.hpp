// A long run of a monitor on faulty reports, compared with a world that has the true motion.
#pragma once

#include <cstdint>
#include <functional>

#include "research/monitoring/faulty_reports.hpp"

namespace kinesphere {

struct SoakSettings {
  FaultySettings faults;
  double distance = 60.0;  ///< the separation of the monitor (length)
  double tolerance = 1.0;
  std::uint64_t reports = 10'000'000;
};

struct Soak {
  FaultCounts faults;
  MonitorCounters counters;
  double time = 0.0;                 ///< simulated time
  double monitor_seconds = 0.0;      ///< CPU time in calls of the monitor
  std::uint64_t approaches = 0;      ///< true approaches, from the time at which all tracks have reported
  std::uint64_t missed = 0;          ///< approaches that were reported as apart at some time while near
  std::uint64_t warnings = 0;        ///< changes of a pair from apart to another verdict
  std::uint64_t wrongly_within = 0;  ///< pairs reported as certainly near when they were not
  std::uint64_t memory_early = 0;    ///< peak memory of the process (bytes) after a quarter of the reports
  std::uint64_t memory = 0;          ///< peak memory of the process (bytes) at the end
  std::uint64_t open = 0;            ///< pairs at the end that are not apart
};

/// Runs the soak. `progress(reports)` is called now and then.
Soak soak(const SoakSettings& settings, const std::function<void(std::uint64_t)>& progress = {});

}  // namespace kinesphere
