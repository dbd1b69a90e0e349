#include "query/shape_queries.hpp"

#include <array>

#include "bound/mesh_tree.hpp"
#include "bound/reach.hpp"
#include "bound/rounding.hpp"
#include "bound/triangle.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

GapLimits around(double gap, double wrong) { return {gap - wrong, gap + wrong}; }

/// Gap between the projections of the two on a direction.
template <class A, class B>
double gap_along(const A& a, const B& b, const Vec3& direction) {
  return -std::min(reach(a, direction) + reach(b, -direction), reach(a, -direction) + reach(b, direction));
}

/// True if the segment between the two points certainly crosses the triangle: they lie on opposite sides of
/// its plane, and their projections are inside it, beyond the rounding error.
bool certainly_crosses(const Triangle& triangle, const Vec3& from, const Vec3& to) {
  const TriangleFrame frame(triangle);
  const double wrong = rounding::margin * (size_of(triangle) + norm_one(from) + norm_one(to));
  const auto well_inside = [&](const Vec3& place) {
    return frame.beyond(frame.in_plane(place - frame.origin())) < -wrong;
  };
  const double height_from = frame.above_plane(from - frame.origin());
  const double height_to = frame.above_plane(to - frame.origin());
  return std::max(height_from, height_to) > wrong && std::min(height_from, height_to) < -wrong &&
         well_inside(from) && well_inside(to);
}

template <class Solid>
bool certainly_meets(const Solid&, const Bound&, double, double) {
  return false;
}
bool certainly_meets(const Triangle& shape, const Bound& sphere, double from, double to) {
  return certainly_crosses(shape, sphere.centre_at(from), sphere.centre_at(to));
}

}  // namespace

GapLimits gap_limits(const Box& region, const HalfSpace& shape) {
  return around(-reach(region, -shape.normal) - shape.offset,
                rounding::margin * (size_of(region) + std::abs(shape.offset)));
}

GapLimits gap_limits(const Box& region, const Box& shape) {
  double gap = -infinity;
  for (int axis = 0; axis < 3; ++axis)
    gap = std::max({gap, region.lower[axis] - shape.upper[axis], shape.lower[axis] - region.upper[axis]});
  return {gap, gap};  // the sign of a difference is exact
}

/// Separating axis test: the normals of the two, and the cross products of their edges.
GapLimits gap_limits(const Box& region, const Triangle& shape) {
  const std::array<Vec3, 3> sides{shape.b - shape.a, shape.c - shape.b, shape.a - shape.c};
  double gap = -infinity;
  const auto try_direction = [&](const Vec3& direction) {
    const double length = norm(direction);
    if (length > 0x1p-500) gap = std::max(gap, gap_along(region, shape, direction / length));
  };
  try_direction(TriangleFrame(shape).normal());
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 unit;
    unit[axis] = 1.0;
    try_direction(unit);
    for (const Vec3& side : sides) try_direction(cross(unit, side));
  }
  const double thick = thickness(shape);
  const double wrong =
      rounding::margin * (size_of(region) + norm_one(shape.a) + norm_one(shape.b) + norm_one(shape.c));
  return {gap - wrong, gap + 16.0 * wrong / thick};
}

GapLimits gap_limits(const Box& region, const Mesh& shape) {
  GapLimits limits{infinity, infinity};
  tree_of(shape).search([&](const Box& box) { return gap_limits(region, box).lower; }, [] { return 0.0; },
                        [&](std::uint32_t, const Triangle& triangle) {
                          const GapLimits own = gap_limits(region, triangle);
                          limits = {std::min(limits.lower, own.lower), std::min(limits.upper, own.upper)};
                          return limits.upper > 0.0;
                        });
  return limits;
}

template <class Solid>
RayLimits first_touch(const Bound& sphere, const Solid& shape, double length) {
  const double first = earliest_meeting(sphere, shape, 0.0, length);
  if (first == infinity) return {infinity, infinity};
  // The shape is met shortly after `first`, or perhaps not at all: search on in doubling steps.
  double step = 0x1p-50 * (norm_one(sphere.position) + sphere.radius + length);
  for (double at = first;; at += step, step *= 2.0) {
    const double end = std::min(at, length);
    if (gap_limits(sphere, shape, end).upper <= 0.0) return {first, end};
    if (certainly_meets(shape, sphere, std::max(0.0, first - step), end)) return {first, end};
    if (!(at < length) || !(step > 0.0)) return {first, infinity};
  }
}
template RayLimits first_touch(const Bound&, const HalfSpace&, double);
template RayLimits first_touch(const Bound&, const Box&, double);
template RayLimits first_touch(const Bound&, const Triangle&, double);

RayLimits first_touch(const Bound& sphere, const Mesh& shape, double length) {
  RayLimits touch{infinity, infinity};
  const auto limit = [&] { return std::min(touch.upper, length); };
  tree_of(shape).search([&](const Box& box) { return earliest_meeting(sphere, box, 0.0, limit()); }, limit,
                        [&](std::uint32_t, const Triangle& triangle) {
                          const RayLimits own = first_touch(sphere, triangle, limit());
                          touch = {std::min(touch.lower, own.lower), std::min(touch.upper, own.upper)};
                          return true;
                        });
  return touch;
}

}  // namespace kinesphere
