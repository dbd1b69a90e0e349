// A monitor that is fed faulty reports for long, against a world that knows the true motion.
#pragma once

#include <cstdint>
#include <functional>

#include "research/monitoring/faulty_reports.hpp"

namespace kinesphere {

struct SoakSettings {
  FaultySettings faults;
  double distance = 60.0;  ///< that is watched (length)
  double tolerance = 1.0;
  std::uint64_t reports = 10'000'000;
};

struct Soak {
  FaultCounts faults;
  MonitorCounters counters;
  double time = 0.0;                 ///< that has passed in the sky
  double monitor_seconds = 0.0;      ///< of the processor, in the calls of the monitor
  std::uint64_t approaches = 0;      ///< in truth, once everybody has been heard of
  std::uint64_t missed = 0;          ///< of them, told to be apart at a time when they were near
  std::uint64_t warnings = 0;        ///< how often a pair that was apart was so no longer
  std::uint64_t wrongly_within = 0;  ///< told to be certainly near when they were not
  std::uint64_t memory_early = 0;    ///< most of the process (bytes), when a quarter of the reports had come
  std::uint64_t memory = 0;          ///< and in the end
  std::uint64_t open = 0;            ///< pairs in the end
};

/// `progress(reports)` is called now and then.
Soak soak(const SoakSettings& settings, const std::function<void(std::uint64_t)>& progress = {});

}  // namespace kinesphere
