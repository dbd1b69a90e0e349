// Bodies that are added and removed while a motion runs.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/motion/steered_motion.hpp"
#include "kinesphere/motion/velocity_field.hpp"

namespace kinesphere::changing_motion_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const State muzzle{{1, 2, 3}, {0, 50, 0}};

TEST(AddedBodies, FlyOn) {
  Ballistic motion = Ballistic::create({.start = {{}}, .gravity = {0, 0, -10}}).value();
  EXPECT_EQ(motion.add(nan, muzzle).error().argument, "t");
  EXPECT_EQ(motion.add(2.0, {{nan, 0, 0}, {}}).error().code, ErrorCode::not_finite);
  EXPECT_EQ(motion.size(), 1u);
  EXPECT_EQ(motion.add(2.0, muzzle).value(), 1u);
  EXPECT_EQ(motion.state(1, 3.0), (State{{1, 52, -2}, {0, 50, -10}}));
  EXPECT_EQ(motion.definition(1, 2.0).planned_acceleration, (Vec3{0, 0, -10}));
}

TEST(AddedBodies, TakeTheNumbersOfRemovedOnes) {
  SteeredMotion motion =
      SteeredMotion::create({.start = {{}, {}, {}}, .acceleration_limits = {1.0, 2.0, 3.0}}).value();
  motion.steer(1, 0.0, {0, 0, 2}).value();
  motion.remove(1).value();
  EXPECT_EQ(motion.add(4.0, muzzle, 5.0).value(), 1u);
  EXPECT_EQ(motion.state(1, 6.0), (State{{1, 102, 3}, {0, 50, 0}})) << "not steered as the one before it";
  EXPECT_NEAR(motion.definition(1, 4.0).acceleration_limit, 5.0, 1e-10);
  EXPECT_EQ(motion.steer(1, 3.0, {}).error().code, ErrorCode::time_backwards);
  EXPECT_EQ(motion.add(4.0, muzzle, 7.0).value(), 3u);
  motion.steer(3, 5.0, {7, 0, 0}).value();
  EXPECT_EQ(motion.add(4.0, muzzle, -7.0).error().argument, "acceleration_limit");
}

TEST(FarTimes, AreRefusedWhereIntervalsCanNoLongerBeCounted) {
  RandomForces forces =
      RandomForces::create({.start = {{}}, .acceleration_limits = {1.0}, .interval = 0.5}).value();
  const double latest = 0.5 * 0x1p50;
  for (const double time : {std::nextafter(latest, 1e308), 0x1p70, 1e300}) {
    EXPECT_THROW((void)forces.state(0, time), BadResult) << time;
    EXPECT_THROW((void)forces.trajectory(0, 0.0, time), BadResult) << time;
    EXPECT_THROW((void)forces.definition(0, time), BadResult) << time;
    EXPECT_EQ(forces.set_velocity(0, time, {}).error().code, ErrorCode::out_of_range) << time;
  }
  // Free flight has no intervals to count.
  Ballistic flight = Ballistic::create({.start = {{{}, {1, 0, 0}}}}).value();
  EXPECT_EQ(flight.state(0, 0x1p70).position.x, 0x1p70);
}

TEST(AddedBodies, AreForcedAndDrawnAlong) {
  RandomForces forces = RandomForces::create({.start = {{}}, .acceleration_limits = {1.0}}).value();
  EXPECT_EQ(forces.add(1.0, muzzle, 3.0).value(), 1u);
  EXPECT_EQ(forces.state(1, 1.0), muzzle);
  EXPECT_GT(norm(forces.trajectory(1, 1.0, 1.0).front().acceleration), 0.0);
  EXPECT_EQ(forces.add(1e300, muzzle, 3.0).error().code, ErrorCode::out_of_range) << "beyond 2^50 intervals";

  VelocityField field = VelocityField::create({.field =
                                                   [](const Vec3& p) {
                                                     return p.x < 100 ? Vec3{1, 0, 0} : Vec3{nan, 0, 0};
                                                   },
                                               .start = {{}},
                                               .acceleration_limits = {1.0}})
                            .value();
  EXPECT_EQ(field.add(1.0, muzzle, 3.0).value(), 1u);
  EXPECT_EQ(field.definition(1, 1.0).acceleration_limit, 3.0);
  EXPECT_EQ(field.add(1.0, {{200, 0, 0}, {}}, 3.0).error().argument, "field");
  EXPECT_EQ(field.size(), 2u);
}

TEST(AddedBodies, JoinTheFrames) {
  FrameMotion frames =
      FrameMotion::create({.start = {{}, {5, 5, 5}}, .acceleration_limits = {8.0, 8.0}, .interval = 1.0})
          .value();
  frames.push(std::vector<Vec3>{{}, {5, 5, 5}}).value();
  EXPECT_EQ(frames.add(1.5, muzzle, 3.0).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(frames.add(0.5, {{nan, 0, 0}, {}}, 3.0).error().argument, "state");
  EXPECT_EQ(frames.add(0.5, muzzle, -1.0).error().argument, "acceleration_limit");
  EXPECT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames.add(0.5, muzzle, 3.0).value(), 2u);
  EXPECT_EQ(frames.state(2, 0.75), (State{{1, 14.5, 3}, {0, 50, 0}}));
  EXPECT_EQ(frames.latest()[2], (Vec3{1, 27, 3}));
  EXPECT_EQ(frames.push(std::vector<Vec3>{{}, {5, 5, 5}}).error().argument, "positions");
  frames.push(std::vector<Vec3>{{}, {5, 5, 5}, {1, 77, 3}}).value();
  EXPECT_TRUE(frames.violations().empty());

  frames.remove(1).value();
  frames.push(std::vector<Vec3>{{}, {nan, nan, nan}, {1, 127, 3}}).value();
  EXPECT_TRUE(frames.violations().empty());
  EXPECT_EQ(frames.add(3.0, {{9, 9, 9}, {}}, 3.0).value(), 1u);
  EXPECT_EQ(frames.latest()[1], (Vec3{9, 9, 9}));
}

TEST(TeleportedBodies, GoOnFromTheirNewPlaceInTheFrames) {
  FrameMotion frames =
      FrameMotion::create({.start = {{}}, .acceleration_limits = {8.0}, .interval = 1.0}).value();
  frames.push(std::vector<Vec3>{{1, 0, 0}}).value();
  frames.teleport(0, 0.5, {{100, 0, 0}, {0, 2, 0}}).value();
  EXPECT_EQ(frames.state(0, 0.5), (State{{100, 0, 0}, {0, 2, 0}}));
  EXPECT_EQ(frames.latest()[0], (Vec3{100, 1, 0}));
  frames.push(std::vector<Vec3>{{100, 3, 0}}).value();
  EXPECT_TRUE(frames.violations().empty()) << "the jump was announced";
}

}  // namespace
}  // namespace kinesphere::changing_motion_test
