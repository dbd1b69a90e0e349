// The record of a rigid body: how it turns between reports, and how that is undone.
#include "bound/rigid_record.hpp"

#include <gtest/gtest.h>

#include "archive/fields.hpp"
#include "archive/heap_counter.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"
#include "support/read_back.hpp"

namespace kinesphere::rigid_record_test {
namespace {

constexpr std::uint64_t seed = 4105;

RigidRecord turning(const Vec3& spin, double time) {
  RigidRecord record{.parts = {{{-1, 0, 0}, {1, 0, 0}, 0.5}, {{}, {}, 1.0}}};
  record.balls = balls_around(record.parts);
  record.largest_angular_speed = 4.0;
  record.change({{}, spin}, time, true);
  return record;
}

TEST(RigidRecord, TurnsAlikeWhenEverItIsReported) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 200; ++k) {
    const Vec3 spin = 3.0 * random.point_in_ball();
    const RigidRecord once = turning(spin, 1.0);
    RigidRecord often = once;
    for (double time = 1.0; time < 6.0; time += random.uniform()) often.report(often.at(time), time);
    EXPECT_EQ(often.at(7.0), once.at(7.0)) << "reports of a steady rotation do not move its origin";
    EXPECT_NEAR(angle_between(once.at(7.0).orientation, rotation_by(spin * 6.0)), 0.0, 1e-7);
  }
}

TEST(RigidRecord, TurnsFromTheLastReportIfItsSpinMayChange) {
  RigidRecord record = turning({0, 0, 1}, 0.0);
  record.angular_acceleration_limit = 0.5;
  const Rotation reported{rotation_by({0, 0, 2}), {0, 0, 1.5}};
  record.report(reported, 1.0);
  EXPECT_EQ(record.origin, reported);
  EXPECT_EQ(record.origin_time, 1.0);
}

TEST(RigidRecord, RestartsItsAngleBeforeItIsInaccurate) {
  RigidRecord record = turning({0, 0, 1000}, 0.0);
  record.report(record.at(4.0), 4.0);
  EXPECT_EQ(record.origin_time, 0.0);
  record.report(record.at(5.0), 5.0);
  EXPECT_EQ(record.origin_time, 5.0) << "5,000 radians";
}

TEST(RigidRecord, BoundsItsSpin) {
  RigidRecord record = turning({0, 3, 0}, 0.0);
  EXPECT_NEAR(record.spin(), 3.0, 1e-12);
  EXPECT_GE(record.spin(), 3.0);
  EXPECT_NEAR(record.surface_acceleration(2.0), 18.0, 1e-10);
  record.angular_acceleration_limit = 0.25;
  EXPECT_EQ(record.spin(), 4.0) << "the largest that it promises";
  EXPECT_EQ(record.surface_acceleration(2.0), 2.0 * (0.25 + 16.0));
}

TEST(RigidRecord, AChangeWaitsForAReportUnlessTheStateIsKnown) {
  RigidRecord record = turning({0, 0, 1}, 0.0);
  const Rotation before = record.rotation;
  record.change({{}, {1, 0, 0}}, 2.0, false);
  EXPECT_TRUE(record.is_changed);
  EXPECT_EQ(record.rotation, before);
  record.report(record.at(2.0), 2.0);
  EXPECT_FALSE(record.is_changed);
  EXPECT_EQ(record.rotation.angular_velocity, (Vec3{1, 0, 0}));
}

TEST(RigidRecord, CountsASpinThatAwaitsAReport) {
  RigidRecord record = turning({}, 0.0);
  record.change({{}, {0, 0, 3}}, 2.0, false);
  EXPECT_EQ(record.surface_acceleration(2.0), 18.0);
}

TEST(RigidRecord, IsReadWithTheBallsAroundItsParts) {
  const RigidRecord record = turning({1, 2, 3}, 4.0);
  RigidRecord back;
  ASSERT_TRUE(read_back(record, back));
  EXPECT_EQ(back.parts, record.parts);
  EXPECT_EQ(back.at(9.0), record.at(9.0));
  ASSERT_EQ(back.balls.size(), 2u);
  EXPECT_EQ(back.balls[0].radius, 1.5);
}

TEST(RigidRecord, CountsTheMemoryOfPartsAndBalls) {
  RigidRecord record = turning({}, 0.0);
  const std::size_t before = heap_bytes(record);
  record.balls.reserve(100);
  EXPECT_GE(heap_bytes(record), before + 98 * sizeof(PartBall));
}

}  // namespace
}  // namespace kinesphere::rigid_record_test
