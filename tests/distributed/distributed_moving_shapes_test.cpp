// Moving shapes of a distributed world have the events of one world, wherever they migrate, and after a
// checkpoint (distributed_checkpoints_test.cpp).
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

#include "distributed/rigid_scenes.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::distributed_moving_shapes_test {
namespace {

/// Plates and triangles among balls and rigid bodies.
Setting shape_setting(RigidSceneParameters parameters, double size = 0.8) {
  Setting setting = rigid_setting(parameters);
  add_shapes(setting, size);
  return setting;
}

void expect_the_same_as_alone(const Setting& setting, std::size_t least_events) {
  const RunOutcome one = alone(setting);
  EXPECT_GE(one.events.size(), least_events);
  std::size_t with_shape = 0;
  for (const Event& event : one.events)
    with_shape += setting.shapes.contains(event.first.index) || setting.shapes.contains(event.second.index);
  EXPECT_GE(with_shape, least_events / 5);
  // As in distributed_rigid_bodies_test.cpp: a world may have a certificate with the walls twice.
  expect_same_course(one, spread_out(setting));
}

TEST(DistributedMovingShapes, BounceAsInOneWorld) {
  for (const std::uint64_t seed : {1, 2})
    expect_the_same_as_alone(shape_setting({.seed = seed, .has_walls = seed == 2}), 100);
}

TEST(DistributedMovingShapes, OfUnknownCourses) {
  expect_the_same_as_alone(shape_setting({.seed = 3, .acceleration_limit = 4.0}), 100);
}

TEST(DistributedMovingShapes, ThatReachThroughManyRegions) {
  expect_the_same_as_alone(shape_setting({.seed = 4}, 4.0), 200);
}

TEST(DistributedMovingShapes, WithSensorsAndErrors) {
  Setting setting = shape_setting({.seed = 5});
  setting.sensors = true;
  setting.position_error = 1e-3;
  expect_the_same_as_alone(setting, 200);
}

/// Most ranks have balls alone, and recheck them as a world does that has shapes, too.
TEST(DistributedMovingShapes, OneAloneInAWorldOfBalls) {
  Setting setting = rigid_setting({.seed = 6, .side = 6, .rigid_below = -1.0});
  setting.scene.world.contacts = ContactEvents::impacts;
  ASSERT_TRUE(setting.rigid.empty());
  setting.shapes[17] = Box{{-1, -1, -0.1}, {1, 1, 0.1}};
  const RunOutcome one = alone(setting);
  EXPECT_GE(one.events.size(), 200u);
  expect_same_course(one, spread_out(setting));
}

TEST(DistributedMovingShapes, AreRefusedForWhatIsWrong) {
  const Setting setting = shape_setting({.side = 3});
  const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  DistributedWorld world = DistributedWorld::create(setting.scene.world, *motion).value();
  const MovingShape good{setting.body(0), setting.shapes.at(0)};
  MovingShape bad = good;
  bad.body.radius_rate = 1.0;
  expect_error(world.add_moving_shape(5, bad, 5), ErrorCode::unsupported, "radius_rate",
               "add_moving_shape: ");
  bad = good;
  bad.shape = HalfSpace{{0, 0, 1}, 0};
  expect_error(world.add_moving_shape(5, bad, 5), ErrorCode::unsupported, "shape", "add_moving_shape: ");
  expect_error(world.add_moving_shape(5, good, 100'000), ErrorCode::unknown_body, "number_in_motion",
               "add_moving_shape: ", {5, 0, 0});
  const auto rank = static_cast<std::uint32_t>(world.rank());
  world.add_moving_shape(rank, good, rank).value();
  expect_error(world.add_moving_shape(rank, good, rank), ErrorCode::out_of_range, "index",
               "add_moving_shape: ", {rank, 0, 0});
}

}  // namespace
}  // namespace kinesphere::distributed_moving_shapes_test
