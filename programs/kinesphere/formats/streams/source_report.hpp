// A report in the form common to all formats of recordings and streams.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "formats/fields/time_text.hpp"
#include "formats/tables/craft_kinds.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

class RowReader;

/// An error bound, and its source. Texts live as long as the format that made the report.
struct DeclaredError {
  double bound = 0.0;  ///< length or length / time; infinite: nothing is known
  std::string_view declaration{};
};

/// The time, position and shape of a row in its own numbers, whose units the columns say.
struct WrittenSample {
  std::optional<TimeField> time{};
  Vec3 position{};
  double length = 0.0, width = 0.0, height = 0.0;  ///< of the body, in metres; 0: not known
  std::optional<double> heading{};                 ///< which way the body points
};

/// Lengths and times are in the units of the stream: metres and seconds if it has units.
struct SourceReport {
  std::string_view id{};              ///< the stream's spelling; valid during the call
  std::string_view name{};            ///< callsign or ship's name; empty: unknown; valid during the call
  FileTime stamp{};                   ///< when it was so, in seconds
  std::optional<FileTime> arrival{};  ///< when it came in, where the stream says so
  TimeKind time_kind = TimeKind::number;
  bool geographic = false;
  bool in_metres = false;  ///< lengths without degrees are known to be metres
  /// x, y, z; if geographic, degrees east and north on WGS 84, and metres above it.
  Vec3 position{};
  bool has_height = false;
  bool may_have_height = false;  ///< the stream has heights, though perhaps none here
  bool on_ground = false;        ///< an aircraft that says so, without a height
  /// x, y, z; if geographic, eastward, northward and upward.
  std::optional<Vec3> velocity{};
  bool has_climb = false;  ///< true if the velocity's z is known

  // Error bounds from the stream; options supply the absent ones.
  std::optional<DeclaredError> position_error{};  ///< horizontal; without a height error, in all directions
  std::optional<DeclaredError> height_error{};
  std::optional<DeclaredError> velocity_error{};
  std::optional<DeclaredError> climb_error{};
  std::optional<double> stamp_error{};  ///< seconds
  /// Largest time between the measurement of the velocity and the timestamp. Unit: seconds.
  double velocity_age = 0.0;
  /// Added to the velocity error: the speed, for example, of a track whose course is not known.
  double velocity_spread = 0.0;
  /// The track extends at most this far from its reported position, horizontally: added to the position
  /// error, so that `apart` holds for all parts of two tracks, and `within` for all parts too. Sound, because
  /// for each offset u of at most this length the path of the position + u keeps all limits and enlarged
  /// errors.
  double extent = 0.0;
  /// Speed over ground as reported, whatever the course. Unit: metres per second.
  std::optional<double> ground_speed{};
  // What the stream says that the track is, which may give it a class: by its status, and by its
  // kind.
  std::optional<MotionPreset> said_status{}, said_kind{};
  /// All that may come as one of the two; lives as long as the format.
  std::span<const MotionPreset> sayable{};
  std::size_t ruled_class = 0;  ///< index of the class of the first --class that holds; 0: none
  /// Of a table, the row that has the report; valid during the call. Null for other formats.
  const RowReader* row = nullptr;
  WrittenSample written{};  ///< of a table
  // Texts for expressions of --class, valid during the call.
  std::string_view category{}, craft_type{}, status{};
  /// Two reports of one place with timestamps this close are one report. Unit: seconds.
  double same_within = 0.0;
};

/// Returns true for degrees of a place on the earth.
inline bool is_place(double longitude, double latitude) {
  return std::abs(latitude) <= 90.0 && std::abs(longitude) <= 360.0;
}

/// Returns the velocity of a speed over ground and a course, in degrees clockwise from north.
inline Vec3 going(double speed, double course, double climb) {
  constexpr double degree = 3.14159265358979323846 / 180.0;
  return {speed * std::sin(course * degree), speed * std::cos(course * degree), climb};
}

/// Sets the velocity of a report, as far as it is known. A speed without a course is one in any direction.
inline void set_velocity(SourceReport& report, std::optional<double> speed, std::optional<double> course,
                         std::optional<double> climb) {
  report.has_climb = climb.has_value();
  if (!speed) return;
  report.ground_speed = std::abs(*speed);
  report.velocity =
      course ? going(*speed, *course, climb.value_or(0.0)) : Vec3{0.0, 0.0, climb.value_or(0.0)};
  report.velocity_spread = course ? 0.0 : std::abs(*speed);
}

/// Reasons for which a valid record is skipped.
enum class Passed {
  no_position,  ///< a track of which the stream has no position, or no time
  filtered,     ///< --where leaves it out
  no_bound,     ///< the stream says that it does not know how far off the position may be
};

/// Receives the reports of a stream.
class ReportSink {
 public:
  virtual ~ReportSink() = default;
  /// Receives the line of the row that is read next, where one record has many rows.
  virtual void begin_row(std::size_t /*line*/) {}
  virtual void take(const SourceReport& report) = 0;
  /// Receives a row of a table that lacks its time or position.
  virtual void take_incomplete(const SourceReport&) { pass_over(Passed::no_position); }
  /// Receives the present time of the stream.
  virtual void time_is(const FileTime& arrival, TimeKind kind) = 0;
  virtual void pass_over(Passed reason) = 0;
  /// Receives a warning about the whole stream, which names it.
  virtual void warn(const std::string& /*warning*/) {}
  /// Receives an unreadable part of a record; the other parts are valid.
  virtual void refuse(std::size_t line, const std::string& reason) = 0;
};

}  // namespace kinesphere::program
