// Rigid bodies of a distributed world have the events of one world, parts and rotations included, wherever
// they migrate, and after a checkpoint.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "distributed/rigid_scenes.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::distributed_rigid_bodies_test {
namespace {

void expect_the_same_as_alone(const Setting& setting, std::size_t least_events) {
  const RunOutcome one = alone(setting);
  EXPECT_GE(one.events.size(), least_events);
  expect_same(one, spread_out(setting));
}

TEST(DistributedRigidBodies, OfEachKindBounceAsInOneWorld) {
  for (const RigidKind kind :
       {RigidKind::capsules, RigidKind::clusters, RigidKind::hulls, RigidKind::mixed}) {
    SCOPED_TRACE(static_cast<int>(kind));
    expect_the_same_as_alone(rigid_setting({.kind = kind}), 200);
  }
}

TEST(DistributedRigidBodies, OfUnknownCourses) {
  for (const std::uint64_t seed : {2, 3})
    expect_the_same_as_alone(rigid_setting({.seed = seed, .acceleration_limit = 4.0, .has_walls = seed == 2}),
                             100);
}

TEST(DistributedRigidBodies, InASpaceThatRepeats) {
  expect_the_same_as_alone(rigid_setting({.seed = 4, .is_periodic = true}), 100);
}

/// Clusters of many ranks are executed again, with bodies that come while they execute.
TEST(DistributedRigidBodies, ThatAreFastAndDense) {
  RigidSceneParameters parameters{.kind = RigidKind::clusters, .spacing = 1.7, .largest_spin = 30.0};
  parameters.speed = 20.0;
  parameters.seconds = 0.3;
  expect_the_same_as_alone(rigid_setting(parameters), 500);
}

TEST(DistributedRigidBodies, WithSensorsAndErrors) {
  Setting setting = rigid_setting({.seed = 6});
  setting.sensors = true;
  setting.position_error = 1e-3;
  expect_the_same_as_alone(setting, 300);
}

TEST(DistributedRigidBodies, AmongBallsThatGrowAndShrink) {
  Setting setting = rigid_setting({.seed = 7});
  setting.radius_rate = 0.1;
  expect_the_same_as_alone(setting, 200);
}

TEST(DistributedRigidBodies, OfPromisesThatAreBroken) {
  Setting setting = rigid_setting({.seed = 8, .acceleration_limit = 4.0});
  setting.broken = 0.2;
  expect_the_same_as_alone(setting, 200);
}

/// Most ranks have balls alone, and know of no others. They recheck them as a world does that has rigid
/// bodies, too.
TEST(DistributedRigidBodies, AtOneEndOfATubeOfBalls) {
  Setting setting = rigid_setting({.seed = 9, .side = 2, .length = 100, .rigid_below = 4.0});
  setting.scene.world.contacts = ContactEvents::impacts;
  EXPECT_LT(setting.rigid.size(), 9u);
  expect_the_same_as_alone(setting, 200);
}

TEST(DistributedRigidBodies, BroughtByOneRankToThreadsInSlices) {
  Setting setting = rigid_setting({.seed = 10});
  setting.bringer = last_brings_all;
  setting.threads = 2;
  setting.slices = 7;
  expect_the_same_as_alone(setting, 200);
}

TEST(DistributedRigidBodies, AreRefusedForWhatIsWrong) {
  Setting setting = rigid_setting({.side = 3});
  const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  DistributedWorld world = DistributedWorld::create(setting.scene.world, *motion).value();
  RigidBody good = setting.rigid.begin()->second;
  good.body.position = {3, 3, 3};
  const auto refused = [&](RigidBody body, ErrorCode code, const std::string& argument) {
    expect_error(world.add_rigid_body(5, body, 5), code, argument, "add_rigid_body: ");
  };
  RigidBody bad = good;
  bad.angular_acceleration_limit = 1.0;
  bad.largest_angular_speed = 9.0;
  refused(bad, ErrorCode::unsupported, "angular_acceleration_limit");
  bad = good;
  bad.parts.clear();
  refused(bad, ErrorCode::out_of_range, "parts");
  bad = good;
  bad.body.radius_rate = 1.0;
  refused(bad, ErrorCode::unsupported, "radius_rate");
  bad = good;
  bad.body.position = {-0.5, 3, 3};
  refused(bad, ErrorCode::outside_domain, "parts");
  expect_error(world.add_rigid_body(5, good, 100'000), ErrorCode::unknown_body, "number_in_motion",
               "add_rigid_body: ", {5, 0, 0});
  const auto rank = static_cast<std::uint32_t>(world.rank());
  world.add_rigid_body(rank, good, rank).value();
  expect_error(world.add_rigid_body(rank, good, rank), ErrorCode::out_of_range, "index",
               "add_rigid_body: ", {rank, 0, 0});
}

/// Answers with an angular velocity for which there is no rigid body, or that is too large.
TEST(DistributedRigidBodies, AreNotTurnedByWrongAnswers) {
  for (const bool is_too_fast : {false, true}) {
    Setting setting = rigid_setting({.kind = RigidKind::capsules, .side = 3});
    if (!is_too_fast) setting.rigid.clear();
    const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
    DistributedWorld world = spread(setting, *motion);
    const ResponseFn respond = [&](const Event& event) {
      Response answer = setting.answer(event);
      answer.first_angular_velocity = Vec3{is_too_fast ? 1e300 : 1.0, 0, 0};
      return answer;
    };
    const auto done = world.run(2.0, respond, [](const OrderedEvent&) {});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, is_too_fast ? ErrorCode::out_of_range : ErrorCode::unsupported);
    EXPECT_EQ(done.error().argument, "first_angular_velocity");
    EXPECT_NE(done.error().message.find("run: respond: first_angular_velocity at "), std::string::npos)
        << done.error().message;
  }
}

}  // namespace
}  // namespace kinesphere::distributed_rigid_bodies_test
