// Steering by hand.
#include "kinesphere/motion/steered_motion.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

#include "motion/motion_properties.hpp"

namespace kinesphere::steered_motion_test {
namespace {

SteeredMotion two_bodies() {
  return SteeredMotion::create(
             {.start = {{{0, 0, 0}, {1, 0, 0}}, {{5, 5, 5}, {}}}, .acceleration_limits = {4.0, 2.0}})
      .value();
}

TEST(Steered, MovesAsItIsTold) {
  SteeredMotion motion = two_bodies();
  EXPECT_EQ(motion.state(0, 2.0), (State{{2, 0, 0}, {1, 0, 0}}));
  motion.steer(0, 2.0, {0, 4, 0}).value();
  EXPECT_EQ(motion.state(0, 3.0), (State{{3, 2, 0}, {1, 4, 0}}));
  motion.steer(0, 3.0, {0, -4, 0}).value();
  EXPECT_EQ(motion.state(0, 4.0), (State{{4, 4, 0}, {1, 0, 0}}));
  EXPECT_EQ(motion.state(1, 4.0), (State{{5, 5, 5}, {}}));
}

TEST(Steered, KickKeepsTheAcceleration) {
  SteeredMotion motion = two_bodies();
  motion.steer(0, 1.0, {0, 4, 0}).value();
  ASSERT_TRUE(motion.set_velocity(0, 2.0, {}));
  EXPECT_EQ(motion.state(0, 3.0), (State{{2, 4, 0}, {0, 4, 0}}));
}

TEST(Steered, KeepsThePromiseOfTheStartWhateverItIsTold) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    SteeredMotion motion = two_bodies();
    const BodyDefinition promise = motion.definition(0, 0.0);
    double time = 0.0;
    for (int k = 0; k < 50; ++k) {
      motion.steer(0, time, 4.0 * random.unit_vector()).value();
      time += random.uniform(0, 0.5);
      const State state = motion.state(0, time);
      EXPECT_LE(norm(state.position - time * promise.velocity),
                0.5 * promise.acceleration_limit * time * time + 1e-12);
    }
  }
}

TEST(Steered, RefusesWhatTheBodyCannotDoAndStaysAsItWas) {
  SteeredMotion motion = two_bodies();
  motion.steer(1, 1.0, {0, 0, 2}).value();
  const State before = motion.state(1, 5.0);

  const auto too_strong = motion.steer(1, 2.0, {0, 0, 3});
  ASSERT_FALSE(too_strong);
  EXPECT_EQ(too_strong.error().code, ErrorCode::out_of_range);
  EXPECT_EQ(too_strong.error().body, (BodyId{1, 0}));
  EXPECT_EQ(too_strong.error().argument, "acceleration");

  const auto too_early = motion.steer(1, 0.5, {});
  ASSERT_FALSE(too_early);
  EXPECT_EQ(too_early.error().code, ErrorCode::time_backwards);
  EXPECT_EQ(too_early.error().message,
            "steer: t of body 1 must not lie before its last change at 1, but is 0.5");

  EXPECT_EQ(motion.steer(2, 2.0, {}).error().code, ErrorCode::unknown_body);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(motion.steer(1, nan, {}).error().code, ErrorCode::not_finite);
  EXPECT_EQ(motion.steer(1, 2.0, {nan, 0, 0}).error().code, ErrorCode::not_finite);

  EXPECT_EQ(motion.state(1, 5.0), before);
}

}  // namespace
}  // namespace kinesphere::steered_motion_test
