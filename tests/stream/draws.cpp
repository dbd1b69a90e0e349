#include "stream/draws.hpp"

#include <cmath>

#include "number/infinity.hpp"
#include "support/needles.hpp"

namespace kinesphere::stream {
namespace {

/// Returns the nearest point of a grid with this distance of its points.
Vec3 on_grid(Vec3 v, double distance) {
  for (int axis = 0; axis < 3; ++axis) v[axis] = distance * std::round(v[axis] / distance);
  return v;
}

}  // namespace

Vec3 Draws::in_space(Vec3 v) const {
  if (s_.line) return {v.x, 0.0, 0.0};
  if (s_.flat) v.z = 0.0;
  return v;
}

Vec3 Draws::middle() const {
  return s_.origin() + Vec3{0.5, 0.6, s_.flat ? 0.0 : 0.45} * (s_.edge * s_.unit_length());
}

Vec3 Draws::place() {
  const Vec3 place = point_in_ball() * (0.33 * s_.edge * s_.unit_length());
  return middle() + (s_.grid ? on_grid(place, 0x1p-4 * s_.unit_length()) : place);
}

Vec3 Draws::velocity() {
  const double unit = s_.unit_length() / s_.unit_time();
  Vec3 velocity = 1.5 * unit * point_in_ball();
  if (s_.grid) velocity = on_grid(velocity, 0x1p-2 * unit);
  if (one_in(12)) return {};
  return s_.fast && one_in(8) ? 100.0 * velocity : velocity;
}

Quaternion Draws::orientation() {
  return rotation_by(s_.flat ? Vec3{0.0, 0.0, 3.0 * uniform()} : 3.0 * random_.point_in_ball());
}

BodyDefinition Draws::body(double radius) {
  BodyDefinition body{.radius = radius,
                      .position_error = s_.position_error(),
                      .velocity_error = s_.position_error() / s_.unit_time(),
                      .position = place(),
                      .velocity = velocity(),
                      .solid = !one_in(20),
                      .mass = one_in(15)   ? infinity
                              : one_in(15) ? 0.0
                                           : uniform(0.1, 3.0)};
  if (s_.steered && !one_in(4)) body.acceleration_limit = acceleration();
  if (s_.gravity && !s_.line && !one_in(4)) body.planned_acceleration.y = -2.0 * unit_acceleration();
  if (s_.sensors && one_in(3)) body.sensor_class = 1;
  if (s_.filters) body.filter = filter();
  if (s_.mixed_contacts) body.contacts = static_cast<ContactEvents>(1 + below(3));
  return body;
}

double Draws::radius() {
  if (one_in(20)) return 0.0;
  const double radius = uniform(0.1, 0.45) * s_.unit_length();
  if (s_.crowd) return 0.25 * radius;
  return s_.sizes ? radius * any_of(std::array{1e-5, 1e-2, 1.5}) : radius;
}

double Draws::radius_rate() {
  const double most = (s_.is_periodic() ? 0.05 : 0.4) * s_.unit_length() / s_.unit_time();
  const double rate = uniform(-most, most);
  return one_in(8) ? 1e-6 * rate : rate;
}

Filter Draws::filter() { return {.category = std::uint64_t{1} << below(3), .mask = one_in(3) ? 3u : 7u}; }

Vec3 Draws::arm() {
  Vec3 arm = 0.5 * random_.point_in_ball();
  if (s_.flat) arm.z = 0.0;
  return arm;
}

/// Returns a box, a plate or a hull, sharp or round.
RigidPart Draws::hull() {
  const double radius = one_in(2) ? 0.0 : uniform(0.0, 0.15);
  const auto side = [&] { return uniform(0.1, 0.45); };
  const std::size_t kind = below(3);
  if (kind < 2) {
    const Vec3 corner{side(), kind == 0 || s_.flat ? side() : 0.0, s_.flat ? 0.0 : side()};
    return box_part({-corner, corner}, radius);
  }
  std::vector<Vec3> points;
  for (std::size_t k = 3 + below(4); k > 0; --k) points.push_back(arm());
  return hull_part(points, radius);
}

std::vector<RigidPart> Draws::parts() {
  std::vector<RigidPart> parts;
  if (s_.hulls && one_in(2)) parts.push_back(hull());
  if (parts.empty() || one_in(3))
    for (std::size_t k = 1 + below(3); k > 0; --k) {
      const Vec3 a = arm();
      parts.push_back({a, one_in(2) ? a : arm(), one_in(6) ? 0.002 : uniform(0.05, 0.2)});
    }
  const double size =
      s_.unit_length() * (s_.sizes && one_in(3) ? 1e-3 : 1.0) * (s_.is_periodic() ? 0.5 : 1.0);
  for (RigidPart& part : parts) {
    part.a *= size;
    part.b *= size;
    part.radius *= size;
    for (Vec3& point : part.more) point *= size;
  }
  return parts;
}

Shape Draws::shape() {
  const Vec3 at = place();
  const double unit = s_.unit_length();
  switch (s_.is_periodic() ? 0 : below(s_.flat ? 3 : 6)) {
    case 0:
      return Ball{at, (one_in(6) ? 0.0 : uniform(0.2, 0.8)) * unit};
    case 1: {
      const auto side = [&] { return uniform(0.2, 1.0) * unit; };
      return Box{at, at + Vec3{side(), one_in(6) ? 0.0 : side(), s_.flat ? 0.0 : side()}};
    }
    case 2: {
      const Vec3 normal = s_.flat ? Vec3{0.6, 0.8, 0.0} : random_.unit_vector();
      return HalfSpace{normal, dot(normal, middle()) - 0.3 * s_.edge * unit};
    }
    case 3:
      return tent(at);
    case 4:
      return needle(at);
    default:
      return Triangle{at, at + Vec3{1.0, 0.2, 0.1} * unit, at + Vec3{0.3, 1.0, uniform(-0.6, 0.6)} * unit};
  }
}

/// Returns the four sides of a pyramid, over a rectangle that may stand beside its foot.
Mesh Draws::tent(const Vec3& at) {
  const Vec3 edges = s_.unit_length() * Vec3{uniform(0.2, 1.0), uniform(0.2, 1.0), uniform(0.1, 1.0)};
  const std::array vertices{at, at + Vec3{edges.x, 0, 0}, at + Vec3{edges.x, edges.y, 0.1 * edges.z},
                            at + Vec3{0, edges.y, 0}, at + Vec3{0.4 * edges.x, 0.6 * edges.y, edges.z}};
  const std::array<std::array<std::uint32_t, 3>, 4> corners{{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  return Mesh::create(vertices, corners).value();
}

/// Returns a triangle through the point, shorter or longer than the world, and as thin as a world allows or
/// slightly thinner.
Triangle Draws::needle(const Vec3& through) {
  const Needle needle = random_needle(random_, 0.0);
  const double scale = s_.edge * s_.unit_length() * std::exp2(uniform(-4.0, 2.0)) / needle.length;
  const Vec3 to = through - needle.point(random_) * scale;
  const auto& [a, b, c] = needle.triangle;
  return {to + a * scale, to + b * scale, to + c * scale};
}

Shape Draws::carried_shape() {
  const double unit = s_.unit_length();
  if (!s_.flat && one_in(3))
    return Triangle{Vec3{-0.6, 0, 0} * unit, Vec3{0.6, 0.1, 0} * unit, Vec3{0, 0.7, 0.2} * unit};
  const Vec3 corner{uniform(0.1, 0.8), one_in(5) ? 0.0 : uniform(0.1, 0.8),
                    s_.flat ? 0.0 : uniform(0.05, 0.3)};
  return Box{-corner * unit, corner * unit};
}

Sensor Draws::sensor() {
  Sensor sensor{.distances = {0.3 * s_.unit_length() * uniform()}};
  if (!one_in(4)) sensor.distances.push_back(0.05 * s_.unit_length());
  if (one_in(3)) sensor.distances.push_back(0.0);
  return sensor;
}

}  // namespace kinesphere::stream
