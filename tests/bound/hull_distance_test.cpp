// Nearest points of convex hulls, beside brute force: distances, directions, and means that are in the hulls.
#include "bound/hull_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "kinesphere/random.hpp"
#include "kinesphere/rigid_body.hpp"
#include "support/true_hulls.hpp"

namespace kinesphere {
namespace {

enum class HullKind { any, box, needle, plate, segment, point };

std::ostream& operator<<(std::ostream& out, HullKind kind) { return out << static_cast<int>(kind); }

std::vector<Vec3> points_of(const RigidPart& part) {
  std::vector<Vec3> points{part.a, part.b};
  points.insert(points.end(), part.more.begin(), part.more.end());
  return points;
}

std::vector<Vec3> random_points(Random& random, HullKind kind) {
  const auto box = [&](double x, double y, double z) {
    return points_of(box_part({{-x, -y, -z}, {x, y, z}}, 0.0));
  };
  switch (kind) {
    case HullKind::box:
      return box(0.2 + random.uniform(), 0.2 + random.uniform(), 0.2 + random.uniform());
    case HullKind::needle:
      return box(1.0, 0.001, 0.001);
    case HullKind::plate:
      return box(0.2 + random.uniform(), 0.2 + random.uniform(), 0.0);
    case HullKind::segment:
      return {random.point_in_ball(), random.point_in_ball()};
    case HullKind::point:
      return {random.point_in_ball()};
    default: {
      std::vector<Vec3> points;
      for (std::size_t k = 4 + random.bits() % 6; k > 0; --k) points.push_back(random.point_in_ball());
      return points;
    }
  }
}

Vec3 in_second(const NearestInHulls& found, const std::vector<Vec3>& points) {
  Vec3 mean;
  for (std::size_t k = 0; k < found.count; ++k) mean += points[found.pairs[k].second] * found.pairs[k].weight;
  return mean;
}

class HullDistance : public testing::TestWithParam<std::pair<HullKind, HullKind>> {};

TEST_P(HullDistance, IsThatOfBruteForce) {
  Random random(7);
  int overlaps = 0, grazes = 0;
  for (int run = 0; run < 400; ++run) {
    const auto first = random_points(random, GetParam().first);
    const auto second = random_points(random, GetParam().second);
    const true_hulls::Hull hulls[] = {true_hulls::Hull(first), true_hulls::Hull(second)};
    // A quarter parallel, so that faces and edges lie upon each other.
    const Quaternion turn = rotation_by(3.0 * random.point_in_ball());
    const Quaternion other_turn = run % 4 == 0 ? turn : rotation_by(3.0 * random.point_in_ball());
    Vec3 shift = rotated(turn, (2.5 * random.uniform()) * random.unit_vector());
    if (run % 8 == 0) shift = rotated(turn, {0, 0, 2.5 * random.uniform()});
    const auto placed = [&](const std::vector<Vec3>& points, const Quaternion& by, const Vec3& at) {
      std::vector<Vec3> there;
      for (const Vec3& point : points) there.push_back(Vec3{3, -5, 4} + at + rotated(by, point));
      return there;
    };
    for (int step = 0; step < 4; ++step) {
      const auto p = placed(first, turn, {});
      const auto q = placed(second, other_turn, shift);
      const double truth = true_hulls::signed_distance({hulls[0], p}, {hulls[1], q});
      const NearestInHulls found = nearest_in_hulls(p, q);
      SCOPED_TRACE(testing::Message() << "run " << run << ", step " << step << ", truth " << truth);
      ASSERT_NEAR(found.distance, std::max(truth, 0.0), 2e-14);
      ASSERT_NEAR(norm(found.normal), 1.0, 1e-15);
      double sum = 0.0;
      for (std::size_t k = 0; k < found.count; ++k) {
        ASSERT_GE(found.pairs[k].weight, 0.0);
        sum += found.pairs[k].weight;
      }
      ASSERT_NEAR(sum, 1.0, 1e-15);
      const Vec3 between = found.in_first([&](std::size_t k) { return p[k]; }) - in_second(found, q);
      // The point in which two thin hulls cross is less accurate than their distance.
      ASSERT_NEAR(norm(between), found.distance, truth > 0.0 ? 2e-14 : 1e-9);
      overlaps += truth < 0.0;
      grazes += truth > 0.0 && truth < 1e-6;
      if (truth <= 0.0) break;
      // The gap along the direction is the distance. Rounding turns the direction between two near points.
      double least = 1e300, most = -1e300;
      for (const Vec3& point : p) least = std::min(least, dot(found.normal, point));
      for (const Vec3& point : q) most = std::max(most, dot(found.normal, point));
      if (truth > 1e-8) {
        ASSERT_NEAR(least - most, truth, 2e-14 + 2e-15 / truth);
      }
      // All but to the surface.
      shift += found.normal * (truth - std::pow(10.0, -4.0 * (step + 1)));
    }
  }
  EXPECT_GT(grazes, 100);
  if (GetParam().first == HullKind::box) {
    EXPECT_GT(overlaps, 50);
  }
}

/// The corners of the part of a solid that is near a segment have the nearest point of the whole.
template <class Solid>
void expect_nearest(const std::vector<Vec3>& ends, const Solid& solid) {
  const NearestInHulls found = nearest_in_hulls(ends, corners_near(ends, solid).all());
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= 200; ++k)
    least = std::min(least, nearest_point(solid, ends[0] + (ends[1] - ends[0]) * (k / 200.0)).distance);
  ASSERT_LE(found.distance, std::max(least, 0.0) + 1e-15);
  ASSERT_GE(found.distance, std::max(least, 0.0) - 0.02);
  const double from = nearest_point(solid, found.in_first([&](std::size_t k) { return ends[k]; })).distance;
  ASSERT_NEAR(std::max(from, 0.0), found.distance, 1e-12);
}

TEST(CornersNear, HaveTheNearestPointOfBoxesAndTriangles) {
  for (std::uint64_t part = 0; part < 1000; ++part) {
    SCOPED_TRACE(part);
    Random random = Random::at(5201, part, 1);
    const Vec3 middle = random.point_in_ball();
    const std::vector<Vec3> ends{middle + 1.5 * random.point_in_ball(),
                                 middle + 1.5 * random.point_in_ball()};
    const Vec3 corner = random.point_in_ball();
    const Vec3 edges{random.uniform(), random.uniform(), part % 5 == 0 ? 0.0 : random.uniform()};
    ASSERT_NO_FATAL_FAILURE(expect_nearest(ends, Box{corner, corner + edges}));
    ASSERT_NO_FATAL_FAILURE(expect_nearest(
        ends, Triangle{random.point_in_ball(), random.point_in_ball(), random.point_in_ball()}));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, HullDistance,
    testing::Values(std::pair(HullKind::any, HullKind::any), std::pair(HullKind::box, HullKind::box),
                    std::pair(HullKind::box, HullKind::needle), std::pair(HullKind::needle, HullKind::needle),
                    std::pair(HullKind::plate, HullKind::plate), std::pair(HullKind::box, HullKind::segment),
                    std::pair(HullKind::needle, HullKind::segment), std::pair(HullKind::any, HullKind::point),
                    std::pair(HullKind::plate, HullKind::any)));

}  // namespace
}  // namespace kinesphere
