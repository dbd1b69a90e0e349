// Soak of a monitor: a long run on reports with all usual faults of transmission, compared with a world that
// has the true motion.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <queue>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

struct FaultySettings {
  std::uint32_t tracks = 20'000;
  double width = 40'000.0;    ///< edge of the square in which the tracks begin (length)
  double height = 1000.0;     ///< height of the layer above the square (length)
  double speed = 15.0;        ///< largest speed at the begin
  double acceleration = 1.0;  ///< largest acceleration; drawn anew every two units of time
  double interval = 1.0;      ///< mean time between reports of a track, each 0.5 to 1.5 times this
  double position_error = 3.0;
  double velocity_error = 0.5;
  double delay = 2.0;        ///< largest delay of a report; reports overtake each other
  double clock_error = 0.2;  ///< largest error of a track's timestamps; declared in reports
  // Faults, each as a part of all reports: repeated reports, and those below.
  double repeated = 0.02;
  double outliers = 0.002;  ///< reports displaced by 500 to 5000
  double swapped = 0.002;   ///< reports under the id of another track
  double gaps = 0.001;      ///< gaps after a report, of 20 to 40 times the interval
  std::uint64_t seed = 1;
};

struct FaultCounts {
  std::uint64_t reports = 0;
  std::uint64_t repeated = 0;
  std::uint64_t outliers = 0;
  std::uint64_t swapped = 0;
  std::uint64_t gaps = 0;
};

/// A report with its time of arrival.
struct Delivery {
  double time = 0.0;
  TrackId track = 0;
  TrackReport report{};
};

/// FaultyReports makes reports. At most one of any three successive reports under one id is wrong.
class FaultyReports {
 public:
  explicit FaultyReports(const FaultySettings& settings);

  /// Returns the next report that arrives, in order of arrival.
  Delivery next();
  const FaultCounts& counts() const { return counts_; }
  /// The true motion of the tracks. Times of calls must never decrease.
  const RandomForces& motion() const { return motion_; }
  RandomForces& motion() { return motion_; }
  /// Returns the class of all tracks.
  TrackClass promise() const { return {.acceleration_limit = settings_.acceleration}; }

 private:
  struct Due {
    double time;
    std::uint32_t track;
    friend bool operator<(const Due& a, const Due& b) {
      return a.time != b.time ? a.time > b.time : a.track > b.track;
    }
  };
  struct Waiting {
    Delivery delivery;
    std::uint64_t number;  ///< sequence number of the report
    friend bool operator<(const Waiting& a, const Waiting& b) {
      return a.delivery.time != b.delivery.time ? a.delivery.time > b.delivery.time : a.number > b.number;
    }
  };
  void make_report(double time, std::uint32_t track);
  void send(double time, TrackId id, const TrackReport& report);

  FaultySettings settings_;
  Random random_;
  RandomForces motion_;
  std::vector<double> clocks_;       ///< by track: error of its timestamps
  std::vector<std::uint32_t> good_;  ///< by id: good reports since a wrong one, or a gap
  std::priority_queue<Due> due_;
  std::priority_queue<Waiting> waiting_;
  std::uint64_t made_ = 0;
  FaultCounts counts_;
};

/// What a comparison of verdicts with the truth has found, from the time at which all tracks have reported.
struct VerdictCounts {
  std::uint64_t approaches = 0;      ///< true approaches
  std::uint64_t missed = 0;          ///< approaches that were reported as apart at some time while near
  std::uint64_t warnings = 0;        ///< changes of a pair from apart to another verdict
  std::uint64_t wrongly_within = 0;  ///< pairs reported as certainly near when they were not
};

/// VerdictCheck compares the verdicts of one separation, for tracks numbered from 0.
class VerdictCheck {
 public:
  /// `distance` is that of the separation, `tolerance` the monitor's (length). Nothing is counted before all
  /// tracks have reported.
  VerdictCheck(const FaultySettings& settings, const RandomForces& motion, double distance, double tolerance);

  /// Compares the truth with the reported events up to a time. `reported` is sorted by time, and later calls
  /// continue earlier ones.
  void compare(double until, std::span<const MonitorEvent> reported);

  const VerdictCounts& counts() const { return counts_; }

 private:
  static constexpr double margin = 1e-2;

  void approach(std::uint64_t pair, double time);
  void begin();
  void take(const Event& event);
  void take(const MonitorEvent& event);

  VerdictCounts counts_;
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

struct SoakSettings {
  FaultySettings faults;
  double distance = 60.0;  ///< the separation of the monitor (length)
  double tolerance = 1.0;
  std::uint64_t reports = 10'000'000;
};

struct Soak {
  FaultCounts faults;
  MonitorCounters counters;
  double time = 0.0;             ///< simulated time
  double monitor_seconds = 0.0;  ///< CPU time in calls of the monitor
  VerdictCounts verdicts;
  std::uint64_t memory_early = 0;  ///< peak memory of the process (bytes) after a quarter of the reports
  std::uint64_t memory = 0;        ///< peak memory of the process (bytes) at the end
  std::uint64_t open = 0;          ///< pairs at the end that are not apart
};

/// Runs the soak. `progress(reports)` is called now and then.
Soak soak(const SoakSettings& settings, const std::function<void(std::uint64_t)>& progress = {});

}  // namespace kinesphere
