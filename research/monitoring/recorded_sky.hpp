// Recorded tracks as input of a monitor: late and noisy reports of them, and the true spans in which pairs
// are within a distance.
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
  double interval = 1.0;  ///< mean time between reports of a track; each uniformly 0.2 to 1.8 times this
  double delay = 0.0;     ///< largest delay of a report
  // Declared errors; the true ones are drawn from balls of these radii.
  double position_error = 0.0;
  double velocity_error = 0.0;
  std::uint64_t seed = 1;
};

/// A report with its time of arrival.
struct Delivery {
  double time = 0.0;
  TrackId track = 0;
  TrackReport report{};
};

class RecordedSky {
 public:
  /// Makes a sky of these tracks. Errors: as RecordedTracks::create().
  static Result<RecordedSky> create(const std::vector<Track>& tracks, int dimensions);

  std::size_t size() const { return spans_.size(); }
  int dimensions() const { return dimensions_; }
  /// Returns the span of time in which a track is there.
  const Span& span(TrackId track) const { return spans_[track]; }
  /// Returns the sum of all spans.
  double track_time() const;
  /// Returns the class of all tracks: the largest acceleration and the largest speed of any.
  TrackClass promise() const { return {.acceleration_limit = fastest_turn_, .largest_speed = fastest_}; }
  /// Returns the report of a track at a time. Its plan is to keep within the track's own largest
  /// acceleration.
  TrackReport report(TrackId track, double time) const;

  /// Returns reports in order of arrival. Each track reports at its begin.
  std::vector<Delivery> deliveries(const ReportingSettings& settings) const;
  /// Returns reports of all tracks at the multiples of `interval`, and at their begins, without error or
  /// delay.
  std::vector<Delivery> polled(double interval) const;
  /// Returns the spans in which a pair is within a distance, by the exact course of the curves.
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
