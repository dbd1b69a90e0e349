#include "bound/nearest_parts.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "bound/hull_distance.hpp"
#include "bound/mesh_tree.hpp"
#include "bound/part_pairs.hpp"
#include "bound/reach.hpp"
#include "bound/rigid_part.hpp"
#include "bound/segments.hpp"
#include "bound/triangle.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// A part where it is.
class PlacedPart {
 public:
  PlacedPart(const RigidPose& body, const RigidPart& part) : radius_(part.radius), count_(point_count(part)) {
    const auto placed = [&](std::size_t k) {
      return body.position + rotated(body.orientation, point_of(part, k));
    };
    if (is_hull()) {
      hull_.reserve(count_);
      for (std::size_t k = 0; k < count_; ++k) hull_.push_back(placed(k));
    } else {
      ends_[0] = placed(0);
      ends_[1] = count_ == 1 ? ends_[0] : placed(1);
    }
  }

  bool is_hull() const { return count_ > 2; }
  double radius() const { return radius_; }
  LineSegment axis() const { return {ends_[0], ends_[1]}; }
  std::span<const Vec3> points() const {
    return is_hull() ? std::span<const Vec3>(hull_) : std::span(ends_).first(count_);
  }

 private:
  double radius_;
  std::size_t count_;
  std::array<Vec3, 2> ends_;
  std::vector<Vec3> hull_;
};

/// Takes `found` if it is nearer than `nearest`.
void keep_nearer(NearestParts& nearest, const NearestParts& found) {
  const auto order = [](const NearestParts& parts) {
    return std::tuple(parts.gap, parts.first_part, parts.second_part);
  };
  if (order(found) < order(nearest)) nearest = found;
}

NearestParts of_hulls(const NearestInHulls& nearest, const PlacedPart& first, double second_radius) {
  const double gap = nearest.distance - (first.radius() + second_radius);
  const Vec3 from = nearest.in_first([&](std::size_t k) { return first.points()[k]; });
  return {gap, -nearest.normal, from - nearest.normal * (first.radius() + 0.5 * gap), nearest.distance};
}

NearestParts of_two(const PlacedPart& first, const PlacedPart& second) {
  if (first.is_hull() || second.is_hull())
    return of_hulls(nearest_in_hulls(first.points(), second.points()), first, second.radius());
  const LineSegment p = first.axis();
  const LineSegment q = second.axis();
  const NearestOnSegments at = nearest_on_segments(p, q);
  const Vec3 from = p.at(at.first);
  const Vec3 way = q.at(at.second) - from;
  const double distance = norm(way);
  const Vec3 normal = distance > 0.0 ? way / distance : Vec3{1.0, 0.0, 0.0};
  const double gap = distance - (first.radius() + second.radius());
  return {gap, normal, from + normal * (first.radius() + 0.5 * gap), distance};
}

NearestParts from_surface(const Vec3& from, const SurfacePoint& nearest, double radius) {
  const double gap = nearest.distance - radius;
  return {gap, -nearest.normal, from - nearest.normal * (radius + 0.5 * gap), nearest.distance};
}

template <class Solid>
NearestParts of_part_and_solid(const PlacedPart& part, const Solid& solid) {
  const auto points = part.points();
  if (points.size() > 1)
    return of_hulls(nearest_in_hulls(points, corners_near(points, solid).all()), part, 0.0);
  return from_surface(points[0], nearest_point(solid, points[0]), part.radius());
}

NearestParts of_part_and_solid(const PlacedPart& part, const HalfSpace& solid) {
  const auto points = part.points();
  const Vec3& from = *std::min_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
    return dot(solid.normal, a) < dot(solid.normal, b);
  });
  return from_surface(from, nearest_point(solid, from), part.radius());
}

RigidExtent at_rest(const RigidPose& body) {
  double radius = 0.0;
  for (const PartBall& part : body.balls) radius = std::max(radius, part.arm + part.radius);
  radius *= 1.0 + rounding::margin;
  return {{.position = body.position, .radius = radius}, radius, body.parts, body.balls, {body.orientation}};
}

}  // namespace

NearestParts nearest_parts(const RigidPose& first, const RigidPose& second) {
  NearestParts nearest{.gap = infinity};
  for_each_part_pair(
      at_rest(first), at_rest(second), 0.0, {}, [&](const GapNow& gap) { return gap.least > nearest.gap; },
      [&](const RigidPart& one, const RigidPart& other) {
        NearestParts found = of_two(PlacedPart(first, one), PlacedPart(second, other));
        found.first_part = static_cast<std::uint32_t>(&one - first.parts.data());
        found.second_part = static_cast<std::uint32_t>(&other - second.parts.data());
        keep_nearer(nearest, found);
        return true;
      });
  return nearest;
}

template <class Solid>
NearestParts nearest_parts(const RigidPose& body, const Solid& solid) {
  NearestParts nearest{.gap = infinity};
  for (std::uint32_t k = 0; k < body.parts.size(); ++k) {
    NearestParts found = of_part_and_solid(PlacedPart(body, body.parts[k]), solid);
    found.first_part = k;
    keep_nearer(nearest, found);
  }
  return nearest;
}
template NearestParts nearest_parts(const RigidPose&, const HalfSpace&);
template NearestParts nearest_parts(const RigidPose&, const Box&);
template NearestParts nearest_parts(const RigidPose&, const Triangle&);

/// A part that has crossed a triangle, so that no direction is certain, is pushed back to the side on which
/// the ball around it has its middle.
NearestParts nearest_parts(const RigidPose& body, const Mesh& mesh) {
  NearestParts nearest{.gap = infinity};
  for (std::uint32_t k = 0; k < body.parts.size(); ++k) {
    const PlacedPart part(body, body.parts[k]);
    const Vec3 middle = body.position + rotated(body.orientation, body.balls[k].middle);
    const Bound around{.position = middle, .radius = body.balls[k].radius * (1.0 + 0x1p-40)};
    const double size = norm_one(middle) + around.radius;
    const auto points = part.points();
    const bool is_flat = mesh.is_chain() && std::all_of(points.begin(), points.end(),
                                                        [](const Vec3& point) { return point.z == 0.0; });
    tree_of(mesh).search([&](const Box& box) { return gap_limits(around, box, 0.0).lower; },
                         [&] { return nearest.gap; },
                         [&](std::uint32_t number, const Triangle& triangle) {
                           NearestParts found = of_part_and_solid(part, triangle);
                           if (found.arm > rounding::margin * (size + size_of(triangle))) {
                             found.normal = steadied(found.normal, triangle, found.arm, size);
                           } else {
                             const TriangleFrame frame(triangle);
                             const bool below = frame.above_plane(middle - frame.origin()) < 0.0;
                             found.normal = below ? frame.normal() : -frame.normal();
                           }
                           if (is_flat) {
                             found.normal = without_z(found.normal);
                             found.point = without_z(found.point);
                           }
                           found.first_part = k;
                           found.second_part = number;
                           keep_nearer(nearest, found);
                           return true;
                         });
  }
  return nearest;
}

}  // namespace kinesphere
