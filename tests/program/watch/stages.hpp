// Reports and settings for tests of the stages of a watch.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/fields/separations.hpp"
#include "watch/watch_settings.hpp"

namespace kinesphere::program {

/// A watch of 50 m in a plane whose tracks fly at most 20 m/s.
inline WatchSettings plane_settings() {
  return {.separations = {parse_separation("sphere:50:10s")},
          .hold = 5.0,
          .dimensions = 2,
          .classes = TrackClasses({ErrorBound(2.0), ErrorBound(20.0)}),
          .position_error = {1.0, "test"},
          .velocity_error = {0.1, "test"},
          .silence = 10.0,
          .forget = 30.0,
          .source = "test",
          .format = "jsonl"};
}

/// A report of a track that goes along x.
inline SourceReport report_at(std::string_view id, double time, double x, double speed, double y = 0.0) {
  SourceReport report{.id = id, .stamp = time_of(time)};
  report.position = {x, y, 0.0};
  report.velocity = Vec3{speed, 0.0, 0.0};
  return report;
}

}  // namespace kinesphere::program
