// What is declared of the tracks and reports of a format, where neither the stream nor an option says it.
#pragma once

#include <optional>

#include "formats/streams/report_format.hpp"
#include "kinesphere/monitor/report.hpp"

namespace kinesphere::program {

/// Limits of tracks, and largest errors of reports, if neither the stream nor an option has them. An empty
/// value must be given by an option.
struct FormatDefaults {
  int dimensions = 3;
  bool geographic = true;  ///< always; otherwise the stream may have either
  std::optional<ErrorBound> acceleration{};
  std::optional<ErrorBound> largest_speed{};
  std::optional<double> position_error{}, height_error{}, velocity_error{}, climb_error{};
  double stamp_error = 0.0;
  double velocity_age = 0.0;
  double silence = 60.0, forget = 300.0;
  double window = 1.0;
  double look_ahead = 10.0;     ///< of separations without a time
  double rest_speed = 0.0;      ///< a track that is no faster for a while is at rest; 0: none is
  bool has_steady_rate = true;  ///< tracks report about as often whatever they do
};
/// docs/watch-streams.md cites the sources of the values.
FormatDefaults defaults_of(StreamFormat format);

}  // namespace kinesphere::program
