// What a stream says of one track at one time, in the words of no particular format.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "kinesphere/vec3.hpp"
#include "tracks/time_scale.hpp"

namespace kinesphere::program {

/// A bound, and what declares it to be one. Texts live as long as the format that made the report.
struct DeclaredError {
  double bound = 0.0;  ///< length or length / time; infinite: nothing is known
  std::string_view declaration{};
};

/// Lengths and times are in the units of the stream, which are metres and seconds where it has a unit at all.
struct SourceReport {
  std::string_view id{};              ///< as the stream spells it; valid during the call
  FileTime stamp{};                   ///< when it was so, in seconds
  std::optional<FileTime> arrival{};  ///< when it came in, where the stream says so
  TimeKind time_kind = TimeKind::number;
  bool geographic = false;
  /// x, y, z; where geographic: degrees east and north on WGS 84, and metres above it.
  Vec3 position{};
  bool has_height = false;
  /// x, y, z; where geographic: eastward, northward and upward.
  std::optional<Vec3> velocity{};
  bool has_climb = false;  ///< whether the velocity's z is known

  // Where the stream itself says how far off it may be. What is left open the options say.
  std::optional<DeclaredError> position_error{};  ///< horizontal; without a height error, in all directions
  std::optional<DeclaredError> height_error{};
  std::optional<DeclaredError> velocity_error{};
  std::optional<DeclaredError> climb_error{};
  std::optional<double> stamp_error{};  ///< seconds
  /// The velocity was measured at most so long before or after the stamp (seconds).
  double velocity_age = 0.0;
  /// Two reports of one place with stamps this near each other are one (seconds).
  double same_within = 0.0;
};

/// Why something that is no error is passed over.
enum class Passed {
  no_position,  ///< a track of which the stream has no position, or no time
  no_bound,     ///< the stream says that it does not know how far off the position may be
};

/// What takes the reports of a stream.
class ReportSink {
 public:
  virtual ~ReportSink() = default;
  virtual void take(const SourceReport& report) = 0;
  /// The stream says what time it is.
  virtual void time_is(const FileTime& arrival, TimeKind kind) = 0;
  virtual void pass_over(Passed reason) = 0;
  /// A part of a record cannot be read; the rest of it can.
  virtual void refuse(std::size_t line, const std::string& reason) = 0;
};

}  // namespace kinesphere::program
