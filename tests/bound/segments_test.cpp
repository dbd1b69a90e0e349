// Nearest points of segments, against points taken all along them.
#include "bound/segments.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::segments_test {
namespace {

constexpr std::uint64_t seed = 5201;
constexpr int looks = 200;

LineSegment some_segment(Random& random, double size) {
  const Vec3 middle = random.point_in_ball();
  return {middle + size * random.point_in_ball(), middle + size * random.point_in_ball()};
}

/// Distance of a point from a segment.
double distance(const Vec3& point, const LineSegment& segment) {
  const Vec3 along = segment.b - segment.a;
  const double square = norm_squared(along);
  const double part = square > 0.0 ? std::clamp(dot(point - segment.a, along) / square, 0.0, 1.0) : 0.0;
  return norm(point - segment.at(part));
}

/// The least of f at points all along a segment: less than half a step of it above the true minimum.
template <class F>
double least_along(const LineSegment& segment, F f) {
  double least = infinity;
  for (int k = 0; k <= looks; ++k) least = std::min(least, f(segment.at(double(k) / looks)));
  return least;
}

TEST(NearestOnSegments, NoOtherPointsAreNearer) {
  SCOPED_TRACE(seed);
  for (std::uint64_t part = 0; part < 3000; ++part) {
    SCOPED_TRACE(part);
    Random random = Random::at(seed, part, 0);
    const double size = part % 3 == 0 ? 1.0 : part % 3 == 1 ? 0.01 : 0.0;
    const LineSegment p = some_segment(random, 1.0);
    LineSegment q = some_segment(random, size);
    if (part % 7 == 0) q = {p.a + 0.1 * random.point_in_ball(), p.b + 1e-9 * random.point_in_ball()};
    if (part % 11 == 0) q = {p.a + Vec3{0, 0, 1}, p.b + Vec3{0, 0, 1}};
    const NearestOnSegments at = nearest_on_segments(p, q);
    ASSERT_TRUE(at.first >= 0.0 && at.first <= 1.0 && at.second >= 0.0 && at.second <= 1.0);
    const double found = norm(p.at(at.first) - q.at(at.second));
    ASSERT_LE(found, least_along(p, [&](const Vec3& point) { return distance(point, q); }) + 1e-6);
  }
}

TEST(NearestOnSegments, OfPointsAreThesePoints) {
  const LineSegment point{{1, 2, 3}, {1, 2, 3}};
  const NearestOnSegments of_points = nearest_on_segments(point, point);
  EXPECT_TRUE(of_points.first >= 0.0 && of_points.first <= 1.0);
  EXPECT_TRUE(of_points.second >= 0.0 && of_points.second <= 1.0);
  EXPECT_EQ(nearest_on_segments(point, {{0, 2, 3}, {4, 2, 3}}).second, 0.25);
  EXPECT_EQ(nearest_on_segments({{0, 2, 3}, {4, 2, 3}}, point).first, 0.25);
}

}  // namespace
}  // namespace kinesphere::segments_test
