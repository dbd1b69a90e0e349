// Points of two segments that are nearest to each other. Certificates stay true for any points; accurate ones
// make them last longer.
#pragma once

#include <algorithm>

#include "kinesphere/vec3.hpp"

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

}  // namespace kinesphere
