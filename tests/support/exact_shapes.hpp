// Distances from static shapes in quadruple precision, by methods other than the library's.
#pragma once

#include "kinesphere/shape.hpp"
#include "support/exact_certificates.hpp"

namespace kinesphere::exact {

using WideVec = std::array<Wide, 3>;

inline WideVec wide(const Vec3& v) { return {v.x, v.y, v.z}; }
inline WideVec operator-(const WideVec& a, const WideVec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline WideVec moved(const WideVec& a, const WideVec& b, Wide t) {
  return {a[0] + b[0] * t, a[1] + b[1] * t, a[2] + b[2] * t};
}
inline Wide dot(const WideVec& a, const WideVec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline WideVec cross(const WideVec& a, const WideVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline WideVec centre_at(const Bound& bound, Wide t) {
  const Wide s = t - Wide(bound.time);
  return moved(moved(wide(bound.position), wide(bound.velocity), s), wide(bound.planned_acceleration),
               s * s / 2);
}
inline Wide growth_at(const Bound& bound, Wide t) {
  const Wide s = t - Wide(bound.time);
  return bound.growth_speed * s + bound.acceleration_limit * s * s / 2;
}

/// Signed, like SurfacePoint::distance.
inline Wide distance(const Box& box, const WideVec& from) {
  Wide outside = 0;
  Wide inside = -infinity;
  for (int axis = 0; axis < 3; ++axis) {
    const Wide x = from[static_cast<std::size_t>(axis)];
    const Wide over = max(box.lower[axis] - x, x - box.upper[axis]);
    inside = max(inside, over);
    if (over > 0) outside += over * over;
  }
  return outside > 0 ? sqrt(outside) : inside;
}

inline Wide distance_to_segment(const WideVec& a, const WideVec& b, const WideVec& from) {
  const WideVec side = b - a;
  const Wide part = max(0, min(1, dot(from - a, side) / dot(side, side)));
  const WideVec away = from - moved(a, side, part);
  return sqrt(dot(away, away));
}

inline Wide distance(const Triangle& triangle, const WideVec& from) {
  const std::array<WideVec, 3> corner{wide(triangle.a), wide(triangle.b), wide(triangle.c)};
  const WideVec normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  bool over = true;
  Wide least = infinity;
  for (std::size_t k = 0; k < 3; ++k) {
    const WideVec& a = corner[k];
    const WideVec& b = corner[(k + 1) % 3];
    over = over && dot(cross(normal, b - a), from - a) >= 0;
    least = min(least, distance_to_segment(a, b, from));
  }
  return over ? abs(dot(from - corner[0], normal)) / sqrt(dot(normal, normal)) : least;
}

/// Asks every triangle.
inline Wide distance(const Mesh& mesh, const WideVec& from) {
  Wide least = infinity;
  for (std::size_t k = 0; k < mesh.size(); ++k) least = min(least, distance(mesh.triangle(k), from));
  return least;
}

/// Returns the least height relative to the longest side.
inline Wide thickness(const Triangle& triangle) {
  const std::array<WideVec, 3> corner{wide(triangle.a), wide(triangle.b), wide(triangle.c)};
  Wide longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const WideVec side = corner[(k + 1) % 3] - corner[k];
    longest = max(longest, dot(side, side));
  }
  const WideVec across = cross(corner[1] - corner[0], corner[2] - corner[0]);
  return sqrt(dot(across, across)) / longest;
}

inline Wide distance(const HalfSpace& solid, const WideVec& from) {
  return dot(wide(solid.normal), from) - solid.offset;
}

/// Returns the gap between the true surfaces at time t.
template <class Solid>
Gaps shape_gaps(const Bound& bound, const Solid& solid, Wide t) {
  const Wide gap = distance(solid, centre_at(bound, t)) - bound.radius;
  return {gap - growth_at(bound, t), gap + growth_at(bound, t)};
}

}  // namespace kinesphere::exact
