// Verdicts held against the true motion, by a world that knows it.
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

/// Of tracks that are numbered from 0, and one separation.
class VerdictCheck {
 public:
  /// `distance` is what was watched, `tolerance` the monitor's. Nothing is counted before everybody has been
  /// heard of.
  VerdictCheck(const FaultySettings& settings, const RandomForces& motion, double distance, double tolerance);

  /// What has happened in truth, and what was told, up to a time; each in order.
  void compare(double until, std::span<const MonitorEvent> told);

  std::uint64_t approaches = 0;      ///< in truth
  std::uint64_t missed = 0;          ///< told to be apart at a time when they were near
  std::uint64_t warnings = 0;        ///< how often a pair that was apart was so no longer
  std::uint64_t wrongly_within = 0;  ///< told to be certainly near when they were not

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
