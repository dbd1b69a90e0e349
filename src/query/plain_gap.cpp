#include "query/plain_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinesphere {
namespace {

using Long = long double;

struct Point {
  Long x = 0, y = 0, z = 0;

  friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Point operator*(const Point& a, Long s) { return {a.x * s, a.y * s, a.z * s}; }
};
Point point(const Vec3& v) { return {v.x, v.y, v.z}; }
Long dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Long length(const Point& a) {
  // If the exponent range of Long holds the squared lengths, no scaling against overflow is needed.
  if constexpr (std::numeric_limits<Long>::max_exponent > 8 * std::numeric_limits<double>::max_exponent)
    return std::sqrt(dot(a, a));
  else
    return std::hypot(a.x, a.y, a.z);
}
Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Point centre(const Bound& bound, double time) {
  const Long s = Long(time) - bound.time;
  return point(bound.position) + (point(bound.velocity) + point(bound.planned_acceleration) * (s / 2)) * s;
}

Long size_of_way(const Bound& bound, double time) {
  const Long s = Long(time) - bound.time;
  return (norm_one(bound.velocity) + std::abs(bound.growth_speed) +
          (norm_one(bound.planned_acceleration) + bound.acceleration_limit) * s) *
         s;
}

Long growth_of(const Bound& bound, double time) {
  const Long s = Long(time) - bound.time;
  return (bound.growth_speed + bound.acceleration_limit * s / 2) * s;
}

/// Interval that contains a distance.
struct Range {
  Long lower, upper;
};

Range from(const Point& centre, const HalfSpace& solid) {
  const Long distance = dot(point(solid.normal), centre) - solid.offset;
  return {distance, distance};
}

/// Outside, the distance to the box; inside, minus the distance to the nearest face.
Range from(const Point& centre, const Box& box) {
  const Point below = point(box.lower) - centre;
  const Point above = centre - point(box.upper);
  const Point out{std::max(below.x, above.x), std::max(below.y, above.y), std::max(below.z, above.z)};
  const Long deepest = std::max({out.x, out.y, out.z});
  const Long distance =
      length({std::max(out.x, Long(0)), std::max(out.y, Long(0)), std::max(out.z, Long(0))});
  return deepest < 0 ? Range{deepest, deepest} : Range{distance, distance};
}

/// Brackets the distance to a triangle. Any point of it is at least as far away as the triangle, and the
/// triangle lies behind its supporting plane in any direction. So the nearest of some points and the farthest
/// of some planes enclose the distance, however those were chosen.
Range from(const Point& centre, const Triangle& triangle) {
  const std::array corners{point(triangle.a), point(triangle.b), point(triangle.c)};
  Range range{0, std::numeric_limits<Long>::infinity()};
  const auto try_direction = [&](const Point& direction) {
    const Long size = length(direction);
    if (!(size > 0)) return;
    Long least = std::numeric_limits<Long>::infinity();
    for (const Point& corner : corners) least = std::min(least, dot(direction, centre - corner) / size);
    range.lower = std::max(range.lower, least);
  };
  const auto try_point = [&](const Point& on) {
    range.upper = std::min(range.upper, length(centre - on));
    try_direction(centre - on);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const Point side = corners[(k + 1) % 3] - corners[k];
    const Long part = dot(centre - corners[k], side) / dot(side, side);
    try_point(corners[k] + side * std::clamp(part, Long(0), Long(1)));
  }
  const Point to_b = corners[1] - corners[0];
  const Point to_c = corners[2] - corners[0];
  const Point across = cross(to_b, to_c);
  const Point way = centre - corners[0];
  try_direction(across);
  try_direction(across * -1);
  const Long square = dot(across, across);
  const Long along_b = std::clamp(dot(cross(way, to_c), across) / square, Long(0), Long(1));
  const Long along_c = std::clamp(dot(cross(to_b, way), across) / square, Long(0), 1 - along_b);
  try_point(corners[0] + to_b * along_b + to_c * along_c);
  return range;
}

/// Asks every triangle.
Range from(const Point& centre, const Mesh& mesh) {
  Range range{std::numeric_limits<Long>::infinity(), std::numeric_limits<Long>::infinity()};
  for (std::size_t k = 0; k < mesh.size(); ++k) {
    const Range own = from(centre, mesh.triangle(k));
    range = {std::min(range.lower, own.lower), std::min(range.upper, own.upper)};
  }
  return range;
}

Long magnitude_of(const HalfSpace& solid) { return std::abs(solid.offset); }
Long magnitude_of(const Box& box) { return Long(norm_one(box.lower)) + norm_one(box.upper); }
Long magnitude_of(const Triangle& t) { return Long(norm_one(t.a)) + norm_one(t.b) + norm_one(t.c); }
Long magnitude_of(const Mesh& mesh) {
  double largest = 0.0;
  for (const Vec3& vertex : mesh.vertices()) largest = std::max(largest, norm_one(vertex));
  return 3 * Long(largest);
}

double rounded_down(Long value) {
  const double rounded = static_cast<double>(value);
  return rounded > value ? std::nextafter(rounded, -std::numeric_limits<double>::infinity()) : rounded;
}
double rounded_up(Long value) { return -rounded_down(-value); }

/// Exceeds the rounding error of fewer than a hundred operations, relative to the sum of the operands'
/// magnitudes.
constexpr Long result_margin = 128 * std::numeric_limits<Long>::epsilon();

}  // namespace

PlainGap::PlainGap(const CollisionShape& a, const CollisionShape& b, const Vec3& period, double shear_rate,
                   double start)
    : moving_(a.shape ? b.bound : a.bound),
      other_(a.shape ? a.bound : b.bound),
      shape_(a.shape ? a.shape : b.shape),
      is_carried_(a.is_carried() || b.is_carried()),
      shape_radius_(a.shape ? a.carried_radius : b.carried_radius),
      period_(period),
      shear_rate_(shear_rate),
      start_(start) {}

PlainGap::Limits PlainGap::distance(double time) const {
  const Point at = centre(moving_, time);
  Long size = norm_one(moving_.position) + size_of_way(moving_, time) + radii() + growth(time);
  if (shape_ == nullptr || is_carried_) size += norm_one(other_.position) + size_of_way(other_, time);
  Range range{};
  if (shape_ == nullptr) {
    Point way = centre(other_, time) - at;
    if (shear_rate_ != 0.0)
      way.x -= std::round(way.y / Long(period_.y)) * shear_rate_ * Long(period_.y) * (Long(time) - start_);
    if (period_.x > 0.0) way.x = std::remainder(way.x, Long(period_.x));
    if (period_.y > 0.0) way.y = std::remainder(way.y, Long(period_.y));
    if (period_.z > 0.0) way.z = std::remainder(way.z, Long(period_.z));
    range = {length(way), length(way)};
  } else {
    std::visit(
        [&]<class Solid>(const Solid& solid) {
          if constexpr (!std::is_same_v<Solid, Ball>) {
            range = from(is_carried_ ? at - centre(other_, time) : at, solid);
            size += magnitude_of(solid);
          }
        },
        *shape_);
  }
  return {rounded_down(range.lower - result_margin * size), rounded_up(range.upper + result_margin * size)};
}

double PlainGap::radii() const {
  return moving_.radius + (shape_ == nullptr || is_carried_ ? other_.radius - shape_radius_ : 0.0);
}

double PlainGap::growth(double time) const {
  return static_cast<double>(growth_of(moving_, time) + growth_of(other_, time));
}

PlainGap::Limits PlainGap::of_bounds(double time) const {
  const Limits limits = distance(time);
  const double less = radii() + growth(time);
  const double margin = 0x1p-50 * (std::abs(limits.upper) + less);
  return {limits.lower - less - margin, limits.upper - less + margin};
}

PlainGap::Limits PlainGap::at_farthest(double time) const {
  const Limits limits = distance(time);
  const double more = growth(time) - radii();
  const double margin = 0x1p-50 * (std::abs(limits.upper) + radii() + growth(time));
  return {limits.lower + more - margin, limits.upper + more + margin};
}

double PlainGap::largest_speed(double from, double to) const {
  const auto rate = [&](const Bound& bound) {
    return norm(bound.velocity_at(from)) + std::abs(bound.growth_speed) +
           (norm(bound.planned_acceleration) + bound.acceleration_limit) * (to - bound.time);
  };
  // Images that two bodies with regions in the primary box have next to each other are one row apart.
  return rate(moving_) + rate(other_) + std::abs(shear_rate_) * period_.y;
}

double PlainGap::uncertainty(double time) const {
  const Long slid = std::abs(Long(shear_rate_) * period_.y * (Long(time) - start_));
  return 0x1p-28 * static_cast<double>(size_of_way(moving_, time) + size_of_way(other_, time)) +
         0x1p-50 * static_cast<double>(slid);
}

}  // namespace kinesphere
