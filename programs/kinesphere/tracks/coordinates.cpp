// Converts the coordinates of a file to those of the computation, and back.
#include "tracks/coordinates.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere::program {
namespace {

/// Returns a multiple of `step` near the middle; 0 if the middle is closer than half a step.
double origin_near(double low, double high, double step) {
  return step * std::round((low / 2 + high / 2) / step);
}

Vec3 product(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec3 quotient(const Vec3& a, const Vec3& b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }

}  // namespace

Coordinates::Coordinates(const Box& extent, const Vec3& units, std::optional<UtmZone> zone)
    : units_(units), zone_(zone) {
  const Vec3 size = extent.upper - extent.lower;
  const double largest = std::max({size.x, size.y, size.z});
  // Powers of two keep the numbers exact.
  const double step = largest > 0 ? std::exp2(6 + std::ceil(std::log2(largest))) : 0x1p-20;
  origin_ = {origin_near(extent.lower.x, extent.upper.x, step),
             origin_near(extent.lower.y, extent.upper.y, step),
             origin_near(extent.lower.z, extent.upper.z, step)};
}

Vec3 Coordinates::local(const Vec3& position) const {
  return projection_ ? projection_->local(product(position, units_)) : product(position - origin_, units_);
}

Vec3 Coordinates::as_in_file(const Vec3& local) const {
  return projection_ ? quotient(projection_->geographic(local), units_) : origin_ + quotient(local, units_);
}

std::optional<Vec3> Coordinates::geographic(const Vec3& local) const {
  if (projection_) return projection_->geographic(local);
  if (!zone_) return std::nullopt;
  // UTM is in metres, in whatever unit the file is.
  return geographic_from_utm(*zone_, product(as_in_file(local), units_));
}

LocalAxes Coordinates::axes_at(const Vec3& local) const {
  if (!projection_) return {};
  // Differences over 22 m: long enough for their rounding, short enough for the bend of the earth.
  constexpr double degrees = 1e-4, metres = 10.0;
  const Vec3 place = projection_->geographic(local);
  const auto moved = [&](double north, double up) {
    return projection_->local({place.x, std::clamp(place.y + north, -90.0, 90.0), place.z + up});
  };
  const Vec3 north = moved(degrees, 0.0) - moved(-degrees, 0.0);
  const Vec3 up = moved(0.0, metres) - moved(0.0, -metres);
  const Vec3 east = cross(north, up);
  LocalAxes axes{.x = east / norm(east), .y = {}, .z = up / norm(up)};
  axes.y = cross(axes.z, axes.x);
  return axes;
}

}  // namespace kinesphere::program
