// Points of two segments, or of a segment and a solid, that are nearest to each other. Certificates stay true
// for any points; accurate ones make them last longer.
#pragma once

#include <algorithm>
#include <optional>

#include "kinesphere/shape.hpp"

namespace kinesphere {

struct LineSegment {
  Vec3 a, b;

  Vec3 at(double part) const { return a + (b - a) * part; }
};

/// Positions of the nearest points on two segments, each in [0, 1] from a to b.
struct NearestOnSegments {
  double first = 0.0;
  double second = 0.0;
};

/// Ericson, Real-Time Collision Detection, 5.1.9.
inline NearestOnSegments nearest_on_segments(const LineSegment& p, const LineSegment& q) {
  const Vec3 along_p = p.b - p.a;
  const Vec3 along_q = q.b - q.a;
  const Vec3 between = p.a - q.a;
  const double pp = norm_squared(along_p);
  const double qq = norm_squared(along_q);
  const double pq = dot(along_p, along_q);
  const double pr = dot(along_p, between);
  const double qr = dot(along_q, between);
  const auto unit = [](double part) { return std::clamp(part, 0.0, 1.0); };
  if (pp == 0.0) return {0.0, qq > 0.0 ? unit(qr / qq) : 0.0};
  if (qq == 0.0) return {unit(-pr / pp), 0.0};
  const double determinant = pp * qq - pq * pq;
  // Of parallel segments any pair of opposite points is nearest.
  double first = determinant > 0x1p-40 * pp * qq ? unit((pq * qr - pr * qq) / determinant) : 0.5;
  const double second = (pq * first + qr) / qq;
  if (second >= 0.0 && second <= 1.0) {
    // One more step along the first segment repairs what a small determinant loses.
    first = unit((pq * second - pr) / pp);
    return {first, unit((pq * first + qr) / qq)};
  }
  const double clamped = unit(second);
  return {unit((pq * clamped - pr) / pp), clamped};
}

/// Calls visit(edge) for each edge of the solid.
template <class Visit>
void for_each_edge(const Triangle& t, Visit visit) {
  visit(LineSegment{t.a, t.b});
  visit(LineSegment{t.b, t.c});
  visit(LineSegment{t.c, t.a});
}

template <class Visit>
void for_each_edge(const Box& box, Visit visit) {
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner) {
      LineSegment edge{box.lower, box.lower};
      const int next = (axis + 1) % 3;
      const int last = (axis + 2) % 3;
      edge.b[axis] = box.upper[axis];
      if (corner & 1) edge.a[next] = edge.b[next] = box.upper[next];
      if (corner & 2) edge.a[last] = edge.b[last] = box.upper[last];
      visit(edge);
    }
}

/// Returns the middle of the part of the segment that is inside the box, or nullopt if there is none.
inline std::optional<double> crossing(const LineSegment& segment, const Box& box) {
  double from = 0.0;
  double to = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double start = segment.a[axis];
    const double way = segment.b[axis] - start;
    if (way == 0.0 && (start < box.lower[axis] || start > box.upper[axis])) return std::nullopt;
    if (way == 0.0) continue;
    const double one = (box.lower[axis] - start) / way;
    const double other = (box.upper[axis] - start) / way;
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
  return from <= to ? std::optional(0.5 * (from + to)) : std::nullopt;
}

/// Returns where the segment crosses the triangle, or nullopt if it does not.
inline std::optional<double> crossing(const LineSegment& segment, const Triangle& t) {
  const Vec3 normal = cross(t.b - t.a, t.c - t.a);
  const double start = dot(normal, segment.a - t.a);
  const double end = dot(normal, segment.b - t.a);
  if (!(start * end < 0.0)) return std::nullopt;
  const double part = start / (start - end);
  const Vec3 point = segment.at(part);
  const auto is_inside = [&](const Vec3& from, const Vec3& to) {
    return dot(cross(to - from, point - from), normal) >= 0.0;
  };
  if (!is_inside(t.a, t.b) || !is_inside(t.b, t.c) || !is_inside(t.c, t.a)) return std::nullopt;
  return part;
}

/// The point of a segment nearest to a solid.
struct NearestOnSegment {
  double position = 0.0;  ///< from 0 at a to 1 at b
  bool crosses = false;   ///< true if the point is in the solid
};

/// Returns the nearest point to the solid. Unless the two intersect, that point is an end, or the nearest one
/// to an edge of the solid.
template <class Solid>
NearestOnSegment nearest_on_segment(const LineSegment& segment, const Solid& solid) {
  if (const auto inside = crossing(segment, solid)) return {*inside, true};
  const double from_a = nearest_point(solid, segment.a).distance;
  const double from_b = nearest_point(solid, segment.b).distance;
  double nearest = from_a <= from_b ? 0.0 : 1.0;
  double least = std::min(from_a, from_b);
  for_each_edge(solid, [&](const LineSegment& edge) {
    const NearestOnSegments at = nearest_on_segments(segment, edge);
    const double distance = norm(segment.at(at.first) - edge.at(at.second));
    if (!(distance < least)) return;
    least = distance;
    nearest = at.first;
  });
  return {nearest};
}

}  // namespace kinesphere
