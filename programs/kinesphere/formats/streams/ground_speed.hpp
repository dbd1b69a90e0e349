// Velocities from a speed over ground and a course.
#pragma once

#include <cmath>
#include <optional>

#include "formats/streams/source_report.hpp"

namespace kinesphere::program {

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

}  // namespace kinesphere::program
