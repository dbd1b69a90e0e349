// Recorded tracks as something to be monitored: reports of them, late and noisy, and when which two were
// within a distance in truth.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"

namespace kinesphere {

struct Span {
  double begin = 0.0;
  double end = 0.0;
};

/// Two tracks, the lesser number first.
using TrackPair = std::pair<TrackId, TrackId>;

struct ReportingSettings {
  double interval = 1.0;  ///< of the reports of a track: uniformly 0.2 to 1.8 times this
  double delay = 0.0;     ///< of a report, at most
  // Errors are drawn from the balls that are declared.
  double position_error = 0.0;
  double velocity_error = 0.0;
  std::uint64_t seed = 1;
};

/// A report that comes in.
struct Delivery {
  double time = 0.0;
  TrackId track = 0;
  TrackReport report{};
};

class RecordedSky {
 public:
  /// Errors: as RecordedTracks::create().
  static Result<RecordedSky> create(const std::vector<Track>& tracks, int dimensions);

  std::size_t size() const { return spans_.size(); }
  int dimensions() const { return dimensions_; }
  /// When a track was there.
  const Span& span(TrackId track) const { return spans_[track]; }
  /// The sum of all spans.
  double track_time() const;
  /// One class that promises the largest acceleration, and speed, of all.
  TrackClass promise() const { return {.acceleration_limit = fastest_turn_, .largest_speed = fastest_}; }
  /// Of a track at a time. Its plan is to keep within its own largest acceleration.
  TrackReport report(TrackId track, double time) const;

  /// In the order in which they come in. Each track reports at its begin.
  std::vector<Delivery> deliveries(const ReportingSettings& settings) const;
  /// Everybody reports at the multiples of a time, and at its begin, without error or delay.
  std::vector<Delivery> polled(double interval) const;
  /// When two were within a distance, by the exact course of their curves.
  Result<std::map<TrackPair, std::vector<Span>>> within(double distance) const;

 private:
  RecordedSky(RecordedTracks motion, std::vector<Track> tracks, int dimensions);

  RecordedTracks motion_;
  std::vector<Track> tracks_;
  int dimensions_;
  std::vector<Span> spans_;
  std::vector<double> limits_;
  double fastest_turn_ = 0.0;
  double fastest_ = 0.0;
};

}  // namespace kinesphere
