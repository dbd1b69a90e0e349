// Evaluation of one cubic piece.
#include "kinesphere/motion/trajectory.hpp"

#include <gtest/gtest.h>

namespace kinesphere::trajectory_test {
namespace {

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
}  // namespace kinesphere::trajectory_test
