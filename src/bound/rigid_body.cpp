// Rotations, and what impulses do to rigid bodies.
#include "kinesphere/rigid_body.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "bound/rigid_record.hpp"
#include "number/angles.hpp"

namespace kinesphere {
namespace {

Vec3 vector_of(const Quaternion& q) { return {q.x, q.y, q.z}; }

}  // namespace

Quaternion rotation_by(const Vec3& turn) {
  const double angle = norm(turn);
  if (angle == 0.0) return {};
  constexpr double pi = std::numbers::pi;
  // A whole turn changes the sign of the quaternion, which is the same rotation.
  const auto [sine, cosine] = sine_and_cosine(0.5 * (angle > pi ? std::remainder(angle, 2.0 * pi) : angle));
  const Vec3 axis = turn * (sine / angle);
  return {cosine, axis.x, axis.y, axis.z};
}

Quaternion after(const Quaternion& second, const Quaternion& first) {
  const Vec3 u = vector_of(second);
  const Vec3 v = vector_of(first);
  const double w = second.w * first.w - dot(u, v);
  const Vec3 axis = v * second.w + u * first.w + cross(u, v);
  const double length = std::sqrt(w * w + norm_squared(axis));
  return {w / length, axis.x / length, axis.y / length, axis.z / length};
}

double angle_between(const Quaternion& a, const Quaternion& b) {
  const Quaternion turn = after(a, {b.w, -b.x, -b.y, -b.z});
  return 4.0 * arc_tangent(norm(vector_of(turn)) / (1.0 + std::abs(turn.w)));
}

Vec3 rotated(const Quaternion& rotation, const Vec3& vector) {
  const Vec3 u = vector_of(rotation);
  const Vec3 twice = cross(u, vector) * 2.0;
  return vector + twice * rotation.w + cross(u, twice);
}

Vec3 rotated_back(const Quaternion& rotation, const Vec3& vector) {
  return rotated({rotation.w, -rotation.x, -rotation.y, -rotation.z}, vector);
}

RigidPart hull_part(std::span<const Vec3> points, double radius) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 first = points.empty() ? Vec3{nan, nan, nan} : points.front();
  RigidPart part{first, points.size() > 1 ? points[1] : first, radius};
  if (points.size() > 2) part.more.assign(points.begin() + 2, points.end());
  return part;
}

RigidPart box_part(const Box& box, double radius) {
  std::vector<Vec3> corners{box.lower};
  for (int axis = 0; axis < 3; ++axis) {
    if (box.lower[axis] == box.upper[axis]) continue;
    const std::size_t count = corners.size();
    for (std::size_t k = 0; k < count; ++k) {
      corners.push_back(corners[k]);
      corners.back()[axis] = box.upper[axis];
    }
  }
  return hull_part(corners, radius);
}

Vec3 RigidRecord::spin_gain(const Quaternion& orientation, const Vec3& arm, const Vec3& direction) const {
  Vec3 torque = rotated_back(orientation, cross(arm, direction));
  for (int axis = 0; axis < 3; ++axis)
    torque[axis] = inertia[axis] > 0.0 && std::isfinite(inertia[axis]) ? torque[axis] / inertia[axis] : 0.0;
  return rotated(orientation, torque);
}

}  // namespace kinesphere
