// Properties of random forces: the times of their changes, their size, and equality on all machines.
#include "kinesphere/motion/random_forces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace kinesphere::random_forces_test {
namespace {

RandomForcesDefinition two_bodies() {
  return {.start = {{{1, 2, 3}, {4, 5, 6}}, {{-1, -2, -3}, {0, 0, 1}}},
          .acceleration_limits = {10.0, 20.0},
          .interval = 0.2,
          .seed = 7};
}

TEST(RandomForces, ForcesChangeAtMultiplesOfTheInterval) {
  const RandomForces motion = RandomForces::create(two_bodies()).value();
  const Trajectory trajectory = motion.trajectory(0, 0.0, 20.0);
  ASSERT_EQ(trajectory.size(), 100u);
  for (std::size_t k = 1; k < trajectory.size(); ++k) {
    EXPECT_EQ(trajectory[k].begin, static_cast<double>(k) * 0.2);
    EXPECT_NE(trajectory[k].acceleration, trajectory[k - 1].acceleration);
    EXPECT_EQ(trajectory[k].jerk, Vec3{});
  }
}

TEST(RandomForces, EveryBodyAndSeedHasItsOwn) {
  auto definition = two_bodies();
  definition.acceleration_limits = {10.0, 10.0};
  const Vec3 force = RandomForces::create(definition)->trajectory(0, 0, 0).front().acceleration;
  EXPECT_NE(RandomForces::create(definition)->trajectory(1, 0, 0).front().acceleration, force);
  definition.seed = 8;
  EXPECT_NE(RandomForces::create(definition)->trajectory(0, 0, 0).front().acceleration, force);
}

TEST(RandomForces, KickKeepsTheForce) {
  RandomForces motion = RandomForces::create(two_bodies()).value();
  const Trajectory before = motion.trajectory(1, 0.5, 1.5);
  ASSERT_TRUE(motion.set_velocity(1, 0.5, {9, 9, 9}));
  const Trajectory after = motion.trajectory(1, 0.5, 1.5);
  ASSERT_EQ(before.size(), after.size());
  EXPECT_EQ(after.front().begin, 0.5);
  for (std::size_t k = 0; k < after.size(); ++k) {
    EXPECT_EQ(after[k].end, before[k].end);
    EXPECT_EQ(after[k].acceleration, before[k].acceleration);
  }
}

TEST(RandomForces, FillTheWholeBallOfTheLimitAndNoMore) {
  const RandomForces motion = RandomForces::create(two_bodies()).value();
  double largest = 0.0;
  Vec3 sum;
  const Trajectory trajectory = motion.trajectory(0, 0.0, 2000.0);
  for (const Segment& segment : trajectory) {
    ASSERT_LE(norm(segment.acceleration), 10.0);
    largest = std::max(largest, norm(segment.acceleration));
    sum += segment.acceleration;
  }
  EXPECT_GT(largest, 9.9);
  EXPECT_LT(norm(sum) / static_cast<double>(trajectory.size()), 0.3);
}

TEST(RandomForces, WorkAtNegativeTimesAndFarFromZero) {
  for (const double start_time : {-1.05, 1e6}) {
    auto definition = two_bodies();
    definition.start_time = start_time;
    const RandomForces motion = RandomForces::create(definition).value();
    const Trajectory trajectory = motion.trajectory(0, start_time, start_time + 2.0);
    EXPECT_EQ(trajectory.front().begin, start_time);
    EXPECT_GE(trajectory.size(), 10u);
    EXPECT_LE(trajectory.size(), 12u);
    for (const Segment& segment : trajectory) EXPECT_LT(segment.begin, segment.end);
  }
}

// Each boundary kinterval is rounded; whatever the interval, each boundary belongs to exactly one piece.
TEST(RandomForces, NoIntervalIsSkippedOrRepeatedByRounding) {
  for (const double interval : {0.1, 0.3, 1.0 / 3.0, 1.0 / 60.0, 0.7, 0x1.fffffffffffffp-4}) {
    auto definition = two_bodies();
    definition.interval = interval;
    RandomForces motion = RandomForces::create(definition).value();
    const Trajectory whole = motion.trajectory(0, 0.0, 3000 * interval);
    for (std::size_t k = 0; k < 2999; ++k) {
      ASSERT_EQ(whole[k].begin, static_cast<double>(k) * interval);
      const double just_before = std::nextafter(whole[k].end, 0.0);
      ASSERT_TRUE(motion.set_velocity(0, just_before, {}));
      const Trajectory redirected = motion.trajectory(0, just_before, whole[k].end);
      ASSERT_EQ(redirected.front().end, whole[k].end);
      ASSERT_EQ(redirected.front().acceleration, whole[k].acceleration);
    }
  }
}

TEST(RandomForces, AreTheSameEverywhere) {
  const RandomForces motion = RandomForces::create(two_bodies()).value();
  EXPECT_EQ(motion.state(0, 20.1).position,
            (Vec3{0x1.415a645550ae5p+7, 0x1.edc9596c565d1p+6, 0x1.f66f0e7b5223bp+7}));
}

TEST(RandomForces, NameWhatIsWrong) {
  auto definition = two_bodies();
  definition.acceleration_limits[1] = -1;
  const auto negative = RandomForces::create(definition);
  ASSERT_FALSE(negative);
  EXPECT_EQ(negative.error().code, ErrorCode::out_of_range);
  EXPECT_EQ(negative.error().body, (BodyId{1, 0}));
  EXPECT_EQ(negative.error().argument, "acceleration_limits");
  EXPECT_EQ(negative.error().message,
            "RandomForces::create: acceleration_limits of body 1 must be >= 0, but is -1");

  definition = two_bodies();
  definition.acceleration_limits.pop_back();
  EXPECT_EQ(RandomForces::create(definition).error().message,
            "RandomForces::create: acceleration_limits must have one entry per body, 2, but is 1");

  definition = two_bodies();
  definition.start[0].velocity.y = std::numeric_limits<double>::quiet_NaN();
  const auto not_finite = RandomForces::create(definition);
  EXPECT_EQ(not_finite.error().code, ErrorCode::not_finite);
  EXPECT_EQ(not_finite.error().message,
            "RandomForces::create: start of body 0, velocity, must be finite, but is (4, nan, 6)");

  for (const double interval : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    definition = two_bodies();
    definition.interval = interval;
    EXPECT_EQ(RandomForces::create(definition).error().argument, "interval");
  }

  // If several arguments are wrong, the error names the first.
  definition.interval = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(RandomForces::create(definition).error().code, ErrorCode::not_finite);
}

}  // namespace
}  // namespace kinesphere::random_forces_test
