// Parts of rigid bodies: their points, and the balls around them.
#include "bound/rigid_part.hpp"

#include <gtest/gtest.h>

#include "kinesphere/random.hpp"

namespace kinesphere::rigid_part_test {
namespace {

constexpr std::uint64_t seed = 4103;

TEST(RigidPart, HasThePointsOfWhichItWasMade) {
  const std::vector<Vec3> points{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {1, 0, 1}};
  for (std::size_t count = 1; count <= points.size(); ++count) {
    const RigidPart part = hull_part(std::span(points).first(count), 0.5);
    ASSERT_EQ(point_count(part), count);
    for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(point_of(part, k), points[k]);
    EXPECT_EQ(is_ball(part), count == 1);
    EXPECT_EQ(is_hull(part), count > 2);
  }
}

TEST(RigidPart, LiesInItsBall) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 1000; ++k) {
    std::vector<Vec3> points(1 + random.bits() % 6);
    for (Vec3& point : points) point = 3.0 * random.point_in_ball();
    const double radius = random.uniform();
    const RigidPart part = hull_part(points, radius);
    const PartBall ball = ball_around(part);
    EXPECT_EQ(ball.arm, norm(ball.middle));
    double farthest = 0.0;
    for (const Vec3& point : points) {
      EXPECT_LE(norm(point - ball.middle) + radius, ball.radius + 1e-14);
      farthest = std::max(farthest, norm(point) + radius);
    }
    EXPECT_EQ(outer_radius(part), farthest);
    EXPECT_LE(ball.radius, farthest * 2.0) << "the ball is hardly larger than the part";
  }
}

TEST(RigidPart, OfManyHasTheLeastRadiusAndABallForEach) {
  const std::vector<RigidPart> parts{{{}, {}, 3.0}, {{1, 0, 0}, {2, 0, 0}, 0.5}, {{}, {}, 1.0}};
  EXPECT_EQ(least_radius(parts), 0.5);
  const std::vector<PartBall> balls = balls_around(parts);
  ASSERT_EQ(balls.size(), 3u);
  EXPECT_EQ(balls[0].radius, 3.0);
  EXPECT_EQ(balls[1].middle, (Vec3{1.5, 0, 0}));
  EXPECT_EQ(balls[1].radius, 1.0);
}

}  // namespace
}  // namespace kinesphere::rigid_part_test
