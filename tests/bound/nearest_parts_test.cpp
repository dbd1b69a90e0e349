// The nearest parts of rigid bodies against a plain search along their axes.
#include "bound/nearest_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "bound/rigid_thing.hpp"
#include "number/infinity.hpp"

namespace kinesphere::nearest_parts_test {
namespace {

constexpr std::uint64_t seed = 4107;

/// One ball or capsule at a place.
struct Capsule {
  explicit Capsule(Random& random) {
    part.a = random.point_in_ball();
    part.b = random.uniform() < 0.3 ? part.a : random.point_in_ball();
    part.radius = 0.2 * random.uniform();
    balls = {ball_around(part)};
    pose = {3.0 * random.point_in_ball(), rotation_by(3.0 * random.point_in_ball()), std::span(&part, 1),
            balls};
  }
  Capsule(const Capsule&) = delete;
  Capsule& operator=(const Capsule&) = delete;
  Vec3 at(double along) const {
    return pose.position + rotated(pose.orientation, part.a + (part.b - part.a) * along);
  }

  RigidPart part;
  std::vector<PartBall> balls;
  RigidPose pose;
};

/// Returns the least value of a convex function on [0, 1].
template <class F>
double least_of(F f) {
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double third = (high - low) / 3.0;
    if (f(low + third) < f(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return f(low);
}

TEST(NearestParts, OfCapsulesAreThoseOfASearch) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 200; ++k) {
    const Capsule one(random);
    const Capsule other(random);
    const double distance =
        least_of([&](double s) { return least_of([&](double t) { return norm(one.at(s) - other.at(t)); }); });
    const NearestParts found = nearest_parts(one.pose, other.pose);
    const double gap = distance - one.part.radius - other.part.radius;
    EXPECT_NEAR(found.gap, gap, 1e-7);
    EXPECT_NEAR(found.arm, distance, 1e-7);
    const NearestParts back = nearest_parts(other.pose, one.pose);
    EXPECT_NEAR(back.gap, found.gap, 1e-12);
    EXPECT_NEAR(norm(back.normal + found.normal), 0.0, 1e-6) << "the normal points the other way";
    EXPECT_NEAR(norm(back.point - found.point), 0.0, 1e-6);
    // The midpoint of the gap is half of it away from either surface.
    const double from_one = least_of([&](double s) { return norm(one.at(s) - found.point); });
    EXPECT_NEAR(from_one - one.part.radius, 0.5 * found.gap, 1e-7);
  }
}

TEST(NearestParts, OfHullsOfTwoPointsAreThoseOfCapsules) {
  SCOPED_TRACE(seed);
  Random random(seed + 1);
  for (int k = 0; k < 500; ++k) {
    const Capsule one(random);
    const Capsule other(random);
    // A hull whose points are all on the axis.
    const std::vector<Vec3> points{other.part.a, other.part.b, 0.5 * (other.part.a + other.part.b)};
    const RigidPart hull = hull_part(points, other.part.radius);
    const PartBall ball = ball_around(hull);
    const RigidPose posed{other.pose.position, other.pose.orientation, std::span(&hull, 1),
                          std::span(&ball, 1)};
    EXPECT_NEAR(nearest_parts(one.pose, posed).gap, nearest_parts(one.pose, other.pose).gap, 1e-9);
    const Box box{{-1, -1, -1}, {-0.5, 1, 1}};
    const NearestParts of_hull = nearest_parts(posed, box);
    const NearestParts of_capsule = nearest_parts(other.pose, box);
    if (of_capsule.gap > -other.part.radius) {
      EXPECT_NEAR(of_hull.gap, of_capsule.gap, 1e-9);
    }
  }
}

TEST(NearestParts, OfSolidsAreWhereTheDistanceIsLeast) {
  SCOPED_TRACE(seed);
  Random random(seed + 2);
  for (int k = 0; k < 300; ++k) {
    const Capsule one(random);
    const auto check = [&](const auto& solid) {
      const double least = least_of([&](double s) { return nearest_point(solid, one.at(s)).distance; });
      const NearestParts found = nearest_parts(one.pose, solid);
      if (least > 1e-6) {
        EXPECT_NEAR(found.gap, least - one.part.radius, 1e-7);
      }
      if (found.gap > 1e-6) {
        EXPECT_NEAR(nearest_point(solid, found.point).distance, 0.5 * found.gap, 1e-6);
      }
    };
    check(HalfSpace{random.unit_vector(), random.uniform(-2.0, 0.0)});
    check(Box{{-1, -1, -1}, {0.5, 1, 0.25}});
    check(Triangle{random.unit_vector(), random.unit_vector(), random.unit_vector()});
  }
}

TEST(NearestParts, OfEquallyNearOnesAreTheFirst) {
  const std::vector<RigidPart> parts{
      {{0, 5, 0}, {0, 5, 0}, 1.0}, {{0, 1, 0}, {0, 1, 0}, 1.0}, {{0, -1, 0}, {0, -1, 0}, 1.0}};
  const std::vector<PartBall> balls = balls_around(parts);
  const RigidPose body{{-3, 0, 0}, {}, parts, balls};
  const RigidPose other{{3, 0, 0}, {}, parts, balls};
  const NearestParts found = nearest_parts(body, other);
  EXPECT_EQ(found.gap, 4.0);
  // Each is opposite to the part of the same number.
  EXPECT_EQ(found.first_part, 0u);
  EXPECT_EQ(found.second_part, 0u);
  EXPECT_EQ(nearest_parts(body, HalfSpace{{1, 0, 0}, -5.0}).first_part, 0u);
  EXPECT_EQ(nearest_parts(body, HalfSpace{{0, 1, 0}, -5.0}).first_part, 2u);
}

}  // namespace
}  // namespace kinesphere::nearest_parts_test
