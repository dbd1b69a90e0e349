// Comparison of verdicts with the true motion, by a world that has it.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <unordered_map>

#include "kinesphere/monitor/monitor_event.hpp"
#include "kinesphere/world.hpp"
#include "research/monitoring/faulty_reports.hpp"

namespace kinesphere {

/// VerdictCheck compares the verdicts of one separation, for tracks numbered from 0.
class VerdictCheck {
 public:
  /// `distance` is that of the separation, `tolerance` the monitor's (length). Nothing is counted before all
  /// tracks have reported.
  VerdictCheck(const FaultySettings& settings, const RandomForces& motion, double distance, double tolerance);

  /// Compares the truth with the reported events up to a time. `reported` is sorted by time, and later calls
  /// continue earlier ones.
  void compare(double until, std::span<const MonitorEvent> reported);

  std::uint64_t approaches = 0;      ///< true approaches
  std::uint64_t missed = 0;          ///< approaches that were reported as apart at some time while near
  std::uint64_t warnings = 0;        ///< changes of a pair from apart to another verdict
  std::uint64_t wrongly_within = 0;  ///< pairs reported as certainly near when they were not

 private:
  static constexpr double margin = 1e-2;

  void approach(std::uint64_t pair, double time);
  void begin();
  void take(const Event& event);
  void take(const MonitorEvent& event);

  double near_;
  double far_;
  double begin_;
  bool begun_ = false;
  std::unique_ptr<Motion> motion_;
  World world_;
  std::set<std::uint64_t> truly_near_;
  std::set<std::uint64_t> truly_within_;
  std::unordered_map<std::uint64_t, Verdict> verdicts_;
};

}  // namespace kinesphere
