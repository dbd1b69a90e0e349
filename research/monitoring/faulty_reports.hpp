// Endless reports of many tracks whose true motion is known, with all that goes wrong on the way.
#pragma once

#include <cstdint>
#include <queue>
#include <vector>

#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/random.hpp"
#include "research/monitoring/recorded_sky.hpp"

namespace kinesphere {

struct FaultySettings {
  std::uint32_t tracks = 20'000;
  double width = 40'000.0;    ///< of the square in which they begin (length)
  double height = 1000.0;     ///< of the layer above it
  double speed = 15.0;        ///< at the begin, at most
  double acceleration = 1.0;  ///< at most, drawn anew every two units of time
  double interval = 1.0;      ///< of reports: 0.5 to 1.5 times this
  double position_error = 3.0;
  double velocity_error = 0.5;
  double delay = 2.0;        ///< at most: reports overtake each other
  double clock_error = 0.2;  ///< of each track's stamps, at most; declared
  // Parts of all reports.
  double repeated = 0.02;
  double outliers = 0.002;  ///< 500 to 5000 away
  double swapped = 0.002;   ///< under the id of another track
  double gaps = 0.001;      ///< behind which a track is silent for 20 to 40 times the interval
  std::uint64_t seed = 1;
};

struct FaultCounts {
  std::uint64_t reports = 0;
  std::uint64_t repeated = 0;
  std::uint64_t outliers = 0;
  std::uint64_t swapped = 0;
  std::uint64_t gaps = 0;
};

/// Of any three successive reports under one id at most one is wrong.
class FaultyReports {
 public:
  explicit FaultyReports(const FaultySettings& settings);

  /// The next one that comes in, by time.
  Delivery next();
  const FaultCounts& counts() const { return counts_; }
  /// As the tracks really move. Times never decrease.
  const RandomForces& motion() const { return motion_; }
  RandomForces& motion() { return motion_; }
  /// What all tracks promise.
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
    std::uint64_t number;  ///< in the order in which they were made
    friend bool operator<(const Waiting& a, const Waiting& b) {
      return a.delivery.time != b.delivery.time ? a.delivery.time > b.delivery.time : a.number > b.number;
    }
  };
  void make_report(double time, std::uint32_t track);
  void send(double time, TrackId id, const TrackReport& report);

  FaultySettings settings_;
  Random random_;
  RandomForces motion_;
  std::vector<double> clocks_;       ///< by how much the stamps of a track are off
  std::vector<std::uint32_t> good_;  ///< reports of an id since a wrong one, or a gap
  std::priority_queue<Due> due_;
  std::priority_queue<Waiting> waiting_;
  std::uint64_t made_ = 0;
  FaultCounts counts_;
};

}  // namespace kinesphere
