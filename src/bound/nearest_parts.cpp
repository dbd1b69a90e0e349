#include "bound/nearest_parts.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "bound/hull_distance.hpp"
#include "bound/rigid_part.hpp"
#include "bound/segments.hpp"
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

/// The same with a ball around it.
struct PartInBall : PlacedPart {
  BallAroundPoints ball;

  PartInBall(const RigidPose& body, const RigidPart& part)
      : PlacedPart(body, part), ball(points().size(), [this](std::size_t k) { return points()[k]; }) {}
  double reach() const { return ball.reach + radius(); }
};

std::vector<PartInBall> placed(const RigidPose& body) {
  std::vector<PartInBall> found;
  found.reserve(body.parts.size());
  for (const RigidPart& part : body.parts) found.emplace_back(body, part);
  return found;
}

/// Takes `found` if it is nearer than `nearest`.
void keep_nearer(NearestParts& nearest, const NearestParts& found) {
  if (found.gap < nearest.gap) nearest = found;
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
  if (part.is_hull())
    return of_hulls(nearest_in_hulls(part.points(), corners_near(part.points(), solid).all()), part, 0.0);
  const Vec3 from = part.axis().at(nearest_on_segment(part.axis(), solid));
  return from_surface(from, nearest_point(solid, from), part.radius());
}

NearestParts of_part_and_solid(const PlacedPart& part, const HalfSpace& solid) {
  const auto points = part.points();
  const Vec3& from = *std::min_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
    return dot(solid.normal, a) < dot(solid.normal, b);
  });
  return from_surface(from, nearest_point(solid, from), part.radius());
}

template <class Solid>
NearestParts nearest_to_solid(const RigidPose& body, const Solid& solid) {
  NearestParts nearest{.gap = infinity};
  for (std::uint32_t k = 0; k < body.parts.size(); ++k) {
    NearestParts found = of_part_and_solid(PlacedPart(body, body.parts[k]), solid);
    found.first_part = k;
    keep_nearer(nearest, found);
  }
  return nearest;
}

}  // namespace

NearestParts nearest_parts(const RigidPose& first, const RigidPose& second) {
  const std::vector<PartInBall> own = placed(first);
  const std::vector<PartInBall> other = placed(second);
  NearestParts nearest{.gap = infinity};
  for (std::uint32_t k = 0; k < own.size(); ++k)
    for (std::uint32_t m = 0; m < other.size(); ++m) {
      // The balls around the two are not nearer than the nearest parts so far.
      const double enough = nearest.gap + own[k].reach() + other[m].reach();
      const Vec3 between = own[k].ball.middle - other[m].ball.middle;
      if (enough < 0.0 || norm_squared(between) > enough * enough) continue;
      NearestParts found = of_two(own[k], other[m]);
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
