// Ready-made trajectories: their cubic pieces, their ends, their limits, and insufficient smoothness.
#include "kinesphere/motion/piecewise_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "kinesphere/motion/trajectory.hpp"
#include "motion/motion_properties.hpp"

namespace kinesphere::piecewise_motion_test {
namespace {

/// Returns a way up and back from time 1 to 5: x = 6 at time 3.
Trajectory there_and_back() {
  return {{1.0, 3.0, {0, 0, 0}, {6, 0, 0}, {-3, 0, 0}, {0, 0, 0}},
          {3.0, 5.0, {6, 0, 0}, {0, 0, 0}, {-3, 0, 0}, {0, 0, 0}}};
}

TEST(PiecewiseMotion, FollowsItsSegments) {
  const PiecewiseMotion motion = PiecewiseMotion::create({there_and_back()}).value();
  EXPECT_EQ(motion.first_time(0), 1.0);
  EXPECT_EQ(motion.last_time(0), 5.0);
  EXPECT_EQ(motion.state(0, 1.0), (State{{0, 0, 0}, {6, 0, 0}}));
  EXPECT_EQ(motion.state(0, 3.0), (State{{6, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(motion.state(0, 5.0), (State{{0, 0, 0}, {-6, 0, 0}}));
}

TEST(PiecewiseMotion, GoesStraightOnBeforeAndAfter) {
  const PiecewiseMotion motion = PiecewiseMotion::create({there_and_back()}).value();
  EXPECT_EQ(motion.state(0, 0.0), (State{{-6, 0, 0}, {6, 0, 0}}));
  EXPECT_EQ(motion.state(0, 7.0), (State{{-12, 0, 0}, {-6, 0, 0}}));
  const Trajectory trajectory = motion.trajectory(0, -1.0, 8.0);
  ASSERT_EQ(trajectory.size(), 4u);
  EXPECT_EQ(trajectory.front().begin, -1.0);
  EXPECT_EQ(trajectory.front().end, 1.0);
  EXPECT_EQ(trajectory.front().state_at(0.0), motion.state(0, 0.0));
  EXPECT_EQ(trajectory.back().end, 8.0);
  EXPECT_EQ(motion.trajectory(0, -2.0, -1.0).size(), 1u);
}

TEST(PiecewiseMotion, LimitIsTheLargestAcceleration) {
  const Segment curved{0.0, 2.0, {}, {}, {1, 0, 0}, {-3, 2, 0}};  // ends with acceleration (-5, 4, 0)
  const PiecewiseMotion motion = PiecewiseMotion::create({{curved}, there_and_back()}).value();
  EXPECT_NEAR(motion.definition(0, 0.0).acceleration_limit, std::sqrt(41.0), 1e-11);
  EXPECT_GE(motion.definition(0, 0.0).acceleration_limit, std::sqrt(41.0));
  EXPECT_NEAR(motion.definition(1, 1.0).acceleration_limit, 3.0, 1e-11);
}

std::string error_of(const Trajectory& wrong) {
  const auto result = PiecewiseMotion::create({there_and_back(), wrong});
  if (result) return "none";
  EXPECT_EQ(result.error().argument, "trajectories");
  EXPECT_EQ(result.error().body, (BodyId{1, 0}));
  return result.error().message;
}

TEST(PiecewiseMotion, NamesWhatIsWrong) {
  const std::string prefix = "PiecewiseMotion::create: trajectories of body 1";
  EXPECT_EQ(error_of(there_and_back()), "none");
  EXPECT_EQ(error_of({}), prefix + " must have at least 1 segment, but is 0");

  Trajectory wrong = there_and_back();
  wrong[1].end = 2.0;
  EXPECT_EQ(error_of(wrong), prefix + ", segment 1, must have an end later than 3, but is 2");
  wrong = there_and_back();
  wrong[1].begin = 3.5;
  EXPECT_EQ(error_of(wrong), prefix + ", segment 1, must begin when the one before it ends, 3, but is 3.5");
  wrong = there_and_back();
  wrong[1].position.y = 1e-9;
  EXPECT_NE(error_of(wrong), "none");
  wrong = there_and_back();
  wrong[1].velocity.z = 1e-9;
  EXPECT_EQ(error_of(wrong),
            prefix +
                ", segment 1, must have the position and velocity with which the one before it ends, "
                "(6, 0, 0) moving (0, 0, 0), but is (6, 0, 0) moving (0, 0, 1.0000000000000001e-09)");
  wrong = there_and_back();
  wrong[0].jerk.x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(error_of(wrong), prefix + ", segment 0, must be finite, but is (inf, 0, 0)");
}

TEST(Segment, FollowsItsCubic) {
  const Segment segment{10.0, 14.0, {1, 2, 3}, {4, 5, 6}, {2, 0, -2}, {6, -6, 0}};
  const State state = segment.state_at(12.0);
  EXPECT_EQ(state.position, (Vec3{1 + 8 + 4 + 8, 2 + 10 + 0 - 8, 3 + 12 - 4 + 0}));
  EXPECT_EQ(state.velocity, (Vec3{4 + 4 + 12, 5 + 0 - 12, 6 - 4 + 0}));
  EXPECT_EQ(segment.acceleration_at(12.0), (Vec3{14, -12, -2}));
}

TEST(Segment, BeginsExactlyWhereItSays) {
  const Segment segment{0.1, 0.2, {0.3, 0.7, 1e10}, {1e-3, 1e3, 0.1}, {9, 9, 9}, {7, 7, 7}};
  EXPECT_EQ(segment.state_at(0.1), (State{segment.position, segment.velocity}));
}

}  // namespace
}  // namespace kinesphere::piecewise_motion_test
