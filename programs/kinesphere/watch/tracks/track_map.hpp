// Where the tracks of a watch are: in the plane or space of the stream, or on a map of a part of the earth.
#pragma once

#include <optional>
#include <vector>

#include "formats/streams/source_report.hpp"
#include "geography/local_frame.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "watch/tracks/track_names.hpp"
#include "watch/watch_settings.hpp"

namespace kinesphere::program {

/// Makes reports of tracks, as the monitor takes them, of those of the stream: their places and errors.
class TrackMap {
 public:
  /// The settings must outlive the map.
  explicit TrackMap(const WatchSettings& settings) : settings_(settings) {}

  /// Begins with the first report, which says whether it is a map, and of how many dimensions. Throws
  /// ProgramError naming an option that is wrong for that.
  void begin(const SourceReport& first, const TrackClasses& classes);

  // Precondition of all that follow: it has begun.
  bool is_geographic() const { return is_geographic_; }
  int dimensions() const { return dimensions_; }
  /// Empty unless it is a map of the earth.
  const std::optional<LocalFrame>& frame() const { return frame_; }
  /// Distances of the monitor are at most so many times too long.
  double stretch() const { return frame_ ? frame_->stretch() : 1.0; }

  /// Returns the definition of the monitor of these classes, to begin at this time.
  MonitorDefinition definition(const TrackClasses& classes, double start_time) const;
  bool lacks_height(const SourceReport& report) const { return dimensions_ == 3 && !report.has_height; }
  /// True for a height that does not count as the first report had none.
  bool ignores_height_of(const SourceReport& report) const {
    return dimensions_ == 2 && !settings_.dimensions && report.has_height;
  }
  /// Returns a report as the monitor takes it, at this timestamp; nothing for one beyond the radius of the
  /// map. `declared` has the class of the report, and gets the sources of its bounds. Throws ProgramError
  /// naming an option that has to give a bound.
  std::optional<TrackReport> place(const SourceReport& report, double timestamp, const TrackClasses& classes,
                                   Declared& declared) const;
  bool has_areas() const { return !areas_.empty(); }
  /// True if a track may be in one of the areas of --area.
  bool is_in_area(const TrackView& track) const;

  static void serialize(auto& self, auto& archive) {
    archive(self.is_geographic_, self.dimensions_, self.origin_);
  }
  /// Call it once serialize() has read the map of a run that had begun.
  void go_on(const TrackClasses& classes);

 private:
  struct Circle {
    Vec3 centre{};
    double radius = 0.0;
  };
  void begin_frame(const TrackClasses& classes);
  void begin_areas();
  double velocity_age_of(const SourceReport& report) const;
  double needed_bound(const FallbackError& fallback, const char* option) const;
  ErrorBound position_error(const SourceReport& report, Declared& declared) const;
  ErrorBound velocity_error(const SourceReport& report, const MotionLimits& limits, double of_map,
                            Declared& declared) const;

  const WatchSettings& settings_;
  bool is_geographic_ = false;
  int dimensions_ = 3;
  WatchSettings::Origin origin_{};  ///< of a map
  std::optional<LocalFrame> frame_;
  std::vector<Circle> areas_;  ///< WatchSettings::areas in the plane of the monitor
};

}  // namespace kinesphere::program
