// A convex solid at rest: what is certain of a box or a triangle, whichever it is.
#pragma once

#include <variant>

#include "bound/hull_distance.hpp"
#include "bound/reach.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

using Convex = std::variant<Box, Triangle>;

inline double reach(const Convex& convex, const Vec3& direction) {
  return std::visit([&](const auto& solid) { return reach(solid, direction); }, convex);
}
inline double size_of(const Convex& convex) {
  return std::visit([](const auto& solid) { return size_of(solid); }, convex);
}
inline SurfacePoint nearest_point(const Convex& convex, const Vec3& from) {
  return std::visit([&](const auto& solid) { return nearest_point(solid, from); }, convex);
}
inline double earliest_meeting(const Bound& bound, const Convex& convex, double from, double until,
                               double distance = 0.0) {
  return std::visit([&](const auto& solid) { return earliest_meeting(bound, solid, from, until, distance); },
                    convex);
}
inline double earliest_separation(const Bound& bound, const Convex& convex, double from, double until,
                                  double distance) {
  return std::visit(
      [&](const auto& solid) { return earliest_separation(bound, solid, from, until, distance); }, convex);
}
inline GapLimits gap_limits(const Bound& bound, const Convex& convex, double t) {
  return std::visit([&](const auto& solid) { return gap_limits(bound, solid, t); }, convex);
}
inline Corners corners_near(std::span<const Vec3> points, const Convex& convex) {
  return std::visit([&](const auto& solid) { return corners_near(points, solid); }, convex);
}

}  // namespace kinesphere
