#include "bound/nearest_parts.hpp"

#include <vector>

#include "bound/segments.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

Segment axis_of(const RigidPose& body, const RigidPart& part) {
  const Vec3 a = body.position + rotated(body.orientation, part.a);
  return {a, part.a == part.b ? a : body.position + rotated(body.orientation, part.b)};
}

struct PlacedPart {
  Segment axis;
  Vec3 middle;
  double reach;  ///< radius of the ball around the middle that contains the part
};

std::vector<PlacedPart> placed(const RigidPose& body) {
  std::vector<PlacedPart> found;
  found.reserve(body.parts.size());
  for (const RigidPart& part : body.parts) {
    const Segment axis = axis_of(body, part);
    found.push_back({axis, 0.5 * (axis.a + axis.b), 0.5 * norm(axis.b - axis.a) + part.radius});
  }
  return found;
}

/// Takes `found` if it is nearer than `nearest`.
void keep_nearer(NearestParts& nearest, const NearestParts& found) {
  if (found.gap < nearest.gap) nearest = found;
}

NearestParts of_two(const Segment& p, const Segment& q, double first_radius, double second_radius) {
  const NearestOnSegments at = nearest_on_segments(p, q);
  const Vec3 from = p.at(at.first);
  const Vec3 way = q.at(at.second) - from;
  const double distance = norm(way);
  const Vec3 normal = distance > 0.0 ? way / distance : Vec3{1.0, 0.0, 0.0};
  const double gap = distance - (first_radius + second_radius);
  return {gap, normal, from + normal * (first_radius + 0.5 * gap), distance};
}

template <class Solid>
NearestParts of_part_and_solid(const Segment& axis, const Solid& solid, double radius) {
  const Vec3 from = axis.at(nearest_on_segment(axis, solid));
  const SurfacePoint nearest = nearest_point(solid, from);
  const double gap = nearest.distance - radius;
  return {gap, -nearest.normal, from - nearest.normal * (radius + 0.5 * gap), nearest.distance};
}

template <class Solid>
NearestParts nearest_to_solid(const RigidPose& body, const Solid& solid) {
  NearestParts nearest{.gap = infinity};
  for (std::uint32_t k = 0; k < body.parts.size(); ++k) {
    NearestParts found = of_part_and_solid(axis_of(body, body.parts[k]), solid, body.parts[k].radius);
    found.first_part = k;
    keep_nearer(nearest, found);
  }
  return nearest;
}

}  // namespace

NearestParts nearest_parts(const RigidPose& first, const RigidPose& second) {
  const std::vector<PlacedPart> own = placed(first);
  const std::vector<PlacedPart> other = placed(second);
  NearestParts nearest{.gap = infinity};
  for (std::uint32_t k = 0; k < own.size(); ++k)
    for (std::uint32_t m = 0; m < other.size(); ++m) {
      // The balls around the two are not nearer than the nearest parts so far.
      const double enough = nearest.gap + own[k].reach + other[m].reach;
      if (enough < 0.0 || norm_squared(own[k].middle - other[m].middle) > enough * enough) continue;
      NearestParts found = of_two(own[k].axis, other[m].axis, first.parts[k].radius, second.parts[m].radius);
      found.first_part = k;
      found.second_part = m;
      keep_nearer(nearest, found);
    }
  return nearest;
}

NearestParts nearest_parts(const RigidPose& first, const HalfSpace& second) {
  return nearest_to_solid(first, second);
}
NearestParts nearest_parts(const RigidPose& first, const Box& second) {
  return nearest_to_solid(first, second);
}
NearestParts nearest_parts(const RigidPose& first, const Triangle& second) {
  return nearest_to_solid(first, second);
}

}  // namespace kinesphere
