// Reports: what they do to bounds, which ones are refused, and which ones break a promise.
#include "processor/reports.hpp"

#include <gtest/gtest.h>

#include "bodies/body_bounds.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::reports_test {
namespace {

using Numbers = std::vector<std::uint32_t>;

class ReportsTest : public testing::Test {
 protected:
  ReportsTest() { reports.ask(probe, "test"); }

  void add(const BodyDefinition& body) {
    const std::uint32_t number = bodies.add(body, 0.0);
    bodies[number].bound = bound_now(body, 0.0);
    answers.push_back({body.position, body.velocity});
  }
  auto take(const Numbers& numbers, double time) {
    PoolLease alone;
    return reports.take(bodies, time, numbers, alone);
  }

  Bodies bodies{WorldDefinition{}};
  std::vector<State> answers;  ///< by number
  Reports reports;
  Probe probe = [this](std::span<const BodyId> ids, double, std::span<State> states) {
    EXPECT_TRUE(reports.is_asking());
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = answers[ids[k].index];
  };
};

TEST_F(ReportsTest, StartBoundsAnewForFewAndForMany) {
  for (int k = 0; k < 6; ++k)
    add({.radius = 2.0, .acceleration_limit = 1.0, .position_error = 0.25, .velocity = {1, 0, 0}});
  for (const Numbers& numbers : {Numbers{3}, Numbers{0, 1}, Numbers{2, 4, 5}}) {
    for (const std::uint32_t number : numbers) answers[number] = {{1.125, 0, 0}, {1.25, 0, 0}};
    const auto broken = take(numbers, 1.0);
    ASSERT_TRUE(broken);
    EXPECT_TRUE(broken->empty());
    for (const std::uint32_t number : numbers) {
      EXPECT_EQ(bodies[number].bound.time, 1.0);
      EXPECT_EQ(bodies[number].bound.position, (Vec3{1.125, 0, 0}));
      EXPECT_EQ(bodies[number].bound.velocity, (Vec3{1.25, 0, 0}));
      EXPECT_EQ(bodies[number].bound.radius, 2.25);
    }
  }
  EXPECT_FALSE(reports.is_asking());
}

TEST_F(ReportsTest, RefuseAnswersThatAreNoStatesAndChangeNothing) {
  for (int k = 0; k < 4; ++k) add({});
  for (const Numbers& numbers : {Numbers{1}, Numbers{0, 1}, Numbers{0, 2, 1, 3}}) {
    answers[1] = {{0, std::numeric_limits<double>::quiet_NaN(), 0}, {}};
    const auto refused = take(numbers, 1.0);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::not_finite);
    EXPECT_EQ(refused.error().body, bodies.id_of(1));
    EXPECT_EQ(refused.error().message.rfind("test: the probe's answer at time 1", 0), 0u);
    for (const std::uint32_t number : numbers) EXPECT_EQ(bodies[number].bound.time, 0.0);
  }
}

TEST_F(ReportsTest, TellWhichBreakTheirBounds) {
  for (int k = 0; k < 5; ++k) add({.acceleration_limit = 1.0});
  answers[1].velocity = {3, 0, 0};
  answers[3].position = {0, 7, 0};
  const auto broken = take({0, 1, 2, 3, 4}, 1.0);
  ASSERT_TRUE(broken);
  ASSERT_EQ(broken->size(), 2u);
  EXPECT_EQ((*broken)[0].k, 1u);
  EXPECT_NEAR((*broken)[0].limits.velocity_excess, 2.0, 1e-12);
  EXPECT_EQ((*broken)[0].limits.position_excess, 0.0);
  EXPECT_EQ((*broken)[1].k, 3u);
  EXPECT_NEAR((*broken)[1].limits.position_excess, 6.5, 1e-12);
  EXPECT_EQ(bodies[3].bound.position, (Vec3{0, 7, 0})) << "the world goes on from the new report";
}

TEST_F(ReportsTest, LetWaitingChangesTakeEffect) {
  add({.acceleration_limit = 1.0});
  Change& change = bodies.change_of(0);
  change.velocity = Vec3{5, 0, 0};
  change.limits.acceleration_limit = 3.0;
  answers[0].velocity = {5, 0, 0};
  const auto broken = take({0}, 1.0);
  ASSERT_TRUE(broken);
  EXPECT_TRUE(broken->empty()) << "the caller has set that velocity";
  EXPECT_EQ(bodies[0].bound.acceleration_limit, 3.0);
  EXPECT_TRUE(bodies.changes.empty());
}

TEST_F(ReportsTest, GiveBodiesTheRadiiThatTheyHaveByThen) {
  add({.radius = 1.0, .radius_rate = 0.5});
  ASSERT_TRUE(take({0}, 2.0));
  EXPECT_EQ(bodies[0].radius, 2.0);
  EXPECT_EQ(bodies[0].bound.radius, 2.0);
  EXPECT_GE(bodies[0].bound.growth_speed, 0.5);
}

TEST_F(ReportsTest, OfSleepingBodiesStandStill) {
  add({.acceleration_limit = 1.0});
  const MotionLimits limits = motion_limits_of(bodies.definition_of(0));
  bodies.sleep_records.add(bodies[0], 0).limits = limits;
  answers[0].velocity = {0.5, 0, 0};
  ASSERT_TRUE(take({0}, 1.0));
  EXPECT_TRUE(bodies[0].stands_still());
}

TEST_F(ReportsTest, OfRigidBodiesThatMaySpinNeedAProbeOfRotations) {
  add({});
  bodies.make_rigid(0, {.parts = {RigidPart{}},
                        .balls = {PartBall{{}, 0.0, 1.0}},
                        .angular_acceleration_limit = 1.0,
                        .largest_angular_speed = 2.0});
  const auto refused = take({0}, 1.0);
  expect_error(refused, ErrorCode::null_probe, "rotation_probe", "test: ", bodies.id_of(0));
  bodies.rigid.probe = [](std::span<const BodyId>, double, std::span<Rotation> rotations) {
    rotations[0] = {rotation_by({0, 0, 0.25}), {0, 0, 0.5}};
  };
  ASSERT_TRUE(take({0}, 1.0));
  EXPECT_EQ(bodies.rigid[bodies[0]].rotation.angular_velocity, (Vec3{0, 0, 0.5}));
}

}  // namespace
}  // namespace kinesphere::reports_test
