#include "research/satellites/satellite_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "input/input_check.hpp"

namespace kinesphere {
namespace {

constexpr double largest_eccentricity = 0.95;
constexpr double lowest_perigee = earth::radius - 100.0;

}  // namespace

Result<SatelliteMotion> SatelliteMotion::create(const std::vector<State>& start) {
  SatelliteMotion motion;
  motion.arcs_.reserve(start.size());
  motion.lowest_ = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < start.size(); ++k) {
    const auto& [position, velocity] = start[k];
    const Subject subject{.argument = "start", .part = "state", .part_number = k};
    InputCheck check("SatelliteMotion::create");
    check.finite(subject, position).finite(subject, velocity);
    if (check.error()) return *check.error();
    const double distance = norm(position);
    const double axis = 1.0 / (2.0 / distance - norm_squared(velocity) / earth::gravity);
    const Vec3 area = cross(position, velocity);
    const double eccentricity = std::sqrt(std::max(0.0, 1.0 - norm_squared(area) / (earth::gravity * axis)));
    const double perigee = axis * (1.0 - eccentricity);
    check
        .require(distance > 0.0 && axis > 0.0 && eccentricity <= largest_eccentricity,
                 ErrorCode::out_of_range, subject,
                 "must be that of an ellipse around the earth, of an eccentricity of at most",
                 largest_eccentricity, eccentricity)
        .require(perigee >= lowest_perigee, ErrorCode::out_of_range, subject,
                 "must lead to no lower perigee than", lowest_perigee, perigee);
    if (check.error()) return *check.error();
    motion.lowest_ = std::min(motion.lowest_, perigee);
    motion.arcs_.emplace_back(Arc(start[k], 0.0).state_at(Arc::half_length), Arc::half_length);
  }
  return motion;
}

double SatelliteMotion::largest_acceleration() const {
  // Perigees go up and down by some 20 km.
  return largest_gravity(lowest_ - 50.0);
}

double SatelliteMotion::largest_speed() const { return std::sqrt(2.0 * earth::gravity / lowest_); }

}  // namespace kinesphere
