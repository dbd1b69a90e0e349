// Points that are fixed in a body stay in their bounds, however the body moves and turns within its limits.
#include "bound/rigid_extent.hpp"

#include <gtest/gtest.h>

#include "bound/rigid_thing.hpp"

namespace kinesphere::rigid_extent_test {
namespace {

constexpr std::uint64_t seed = 4102;

TEST(RigidExtent, BoundsEachOfItsPoints) {
  SCOPED_TRACE(seed);
  for (std::uint64_t k = 0; k < 2000 && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 0, k);
    const Thing thing(random, k % 2 == 0, 2);
    const Vec3 push = random.point_in_ball();
    const double braking = random.uniform();
    const Vec3 point = random.point_in_ball();
    const Bound bound = thing.extent.of_point(point, 0.125);
    for (const double s : {0.0, 0.1, 0.5, 1.5}) {
      const double time = thing.extent.bound.time + s;
      const RigidPose pose = thing.pose_at(time, push, braking);
      const Vec3 place = pose.position + rotated(pose.orientation, point);
      EXPECT_LE(norm(place - bound.centre_at(time)), bound.radius_at(time) - 0.125 + 1e-12) << s;
    }
  }
}

TEST(RigidExtent, ThatIsExactIsTheSameLater) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 500; ++k) {
    const Thing thing(random, true, 2);
    ASSERT_TRUE(thing.extent.is_exact());
    const double time = rigid_thing_now + random.uniform();
    const RigidExtent later = thing.extent.at(time);
    EXPECT_TRUE(later.is_foreseen);
    const RigidPose pose = thing.pose_at(time, {}, 0.0);
    EXPECT_NEAR(norm(later.bound.position - pose.position), 0.0, 1e-12);
    EXPECT_NEAR(angle_between(later.rotation.orientation, pose.orientation), 0.0, 1e-7);
    EXPECT_GE(later.bound.radius, thing.extent.bound.radius) << "the rounding of the later place counts";
    EXPECT_FALSE(thing.extent.at(thing.extent.bound.time).is_foreseen);
  }
}

TEST(RigidPair, IsExactIfBothAre) {
  Random random(seed);
  const Thing exact(random, true);
  const Thing other(random, false);
  EXPECT_TRUE((RigidPair<RigidExtent>{exact.extent, exact.extent}.is_exact()));
  EXPECT_FALSE((RigidPair<RigidExtent>{exact.extent, other.extent}.is_exact()));
  EXPECT_TRUE((RigidPair<HalfSpace>{exact.extent, {}}.is_exact()));
  EXPECT_FALSE((RigidPair<HalfSpace>{other.extent, {}}.is_exact()));
}

}  // namespace
}  // namespace kinesphere::rigid_extent_test
