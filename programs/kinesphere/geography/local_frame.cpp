// A plane map of a part of the earth, with the bound of its error.
#include "geography/local_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinesphere::program {
namespace {

constexpr double polar_radius = 6356752.0;  // rounded down
constexpr double mean_radius = 6371000.0;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double degree_of_arc = 3.14159265358979323846 / 180.0;

}  // namespace

LocalFrame::LocalFrame(double latitude, double longitude, double radius, double margin)
    : map_(latitude, longitude), radius_(radius), outer_radius_(radius + margin) {
  // The disc must stay convex.
  const double angle = std::min(outer_radius_ / polar_radius, 1.5);
  stretch_ = angle / std::sin(angle) * (1.0 + 1e-12);
}

double LocalFrame::curving() const {
  return 1.2 * stretch_ * stretch_ * outer_radius_ / (polar_radius * polar_radius);
}

std::optional<LocalFrame::Placed> LocalFrame::place(const Vec3& geographic, bool has_height,
                                                    const Vec3& velocity, double away) const {
  const AzimuthalMap::Point point = map_.point(geographic);
  const Vec3& at = point.position;
  const double distance = std::hypot(at.x, at.y);
  if (!(distance <= radius_) || std::abs(geographic.z) > largest_height) return std::nullopt;
  const double height = has_height ? geographic.z : 0.0;
  const double on_ground = mean_radius / (mean_radius + height);
  const double along_azimuth = point.azimuth * degree_of_arc;
  const Vec3 along{std::sin(along_azimuth), std::cos(along_azimuth), 0.0};
  const Vec3 across{along.y, -along.x, 0.0};
  const double speed_along = dot(velocity, along) * on_ground;
  const double speed_across = dot(velocity, across) * on_ground / point.reciprocal_scale;
  // At the origin, where no direction exists, GeographicLib returns an azimuth of 0.
  const Vec3 outward = distance > 0.0 ? Vec3{at.x / distance, at.y / distance, 0.0} : along;
  const Vec3 sideward{outward.y, -outward.x, 0.0};
  Placed placed;
  placed.state.position = at;
  placed.state.velocity = outward * speed_along + sideward * speed_across;
  placed.state.velocity.z = velocity.z;
  const double uncertain_height = has_height ? 1500.0 + 0.01 * std::abs(height) : largest_height;
  const double speed = stretch_ * std::hypot(velocity.x, velocity.y);
  placed.velocity_error = speed * uncertain_height / polar_radius;
  if (away > 0.0) {
    // At a pole no direction is certain.
    const double latitude = std::abs(geographic.y) * degree_of_arc + away / polar_radius;
    const double north_turns = latitude < 1.57 ? std::tan(latitude) / polar_radius : infinite;
    placed.velocity_error += speed * std::min(2.0, away * (north_turns + curving()));
  }
  return placed;
}

TrackClass LocalFrame::promise(const ErrorBound& acceleration, const ErrorBound& largest_speed) const {
  TrackClass promise;
  const double fastest = largest_speed.horizontal(), steepest = largest_speed.vertical();
  if (std::isfinite(largest_speed.total()))
    promise.largest_speed = ErrorBound::cylinder(stretch_ * fastest, steepest);
  if (std::isfinite(acceleration.total())) {
    promise.acceleration_limit = ErrorBound::cylinder(
        stretch_ * acceleration.horizontal() +
            (curving() + largest_height / (polar_radius * polar_radius)) * fastest * fastest +
            fastest * steepest / polar_radius,
        acceleration.vertical());
  }
  return promise;
}

Separation LocalFrame::separation(const Separation& separation) const {
  Separation on_map = separation;
  on_map.horizontal *= stretch_;
  return on_map;
}

}  // namespace kinesphere::program
