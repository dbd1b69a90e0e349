// Free flight.
#include "kinesphere/motion/ballistic.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace kinesphere::ballistic_test {
namespace {

TEST(Ballistic, FollowsAParabolaAndPlansIt) {
  Ballistic motion =
      Ballistic::create({.start = {{{0, 0, 10}, {2, 0, 4}}}, .gravity = {0, 0, -8}, .start_time = 1.0})
          .value();
  EXPECT_EQ(motion.state(0, 2.0), (State{{2, 0, 10}, {2, 0, -4}}));
  EXPECT_EQ(motion.definition(0, 2.0).acceleration_limit, 0.0);
  EXPECT_EQ(motion.definition(0, 2.0).planned_acceleration, (Vec3{0, 0, -8}));
  ASSERT_TRUE(motion.set_velocity(0, 2.0, {0, 0, 4}));
  EXPECT_EQ(motion.state(0, 3.0), (State{{2, 0, 10}, {0, 0, -4}}));
  EXPECT_EQ(motion.trajectory(0, 2.0, 1e9).size(), 1u);
}

TEST(Ballistic, NamesWhatIsWrong) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Ballistic::create({.start = {}, .gravity = {0, infinity, 0}}).error().message,
            "Ballistic::create: gravity must be finite, but is (0, inf, 0)");
  EXPECT_EQ(Ballistic::create({.start = {}, .gravity = {}, .start_time = -infinity}).error().argument,
            "start_time");
}

}  // namespace
}  // namespace kinesphere::ballistic_test
