// The volumes of bodies, and the margins in which they touch and sense others.
#include "bodies/body_bounds.hpp"

#include <gtest/gtest.h>

#include "kinesphere/random.hpp"
#include "support/small_world.hpp"

namespace kinesphere::body_bounds_test {
namespace {

constexpr std::uint64_t seed = 5207;

TEST(BodyBounds, HaveGapsInTheNearestImage) {
  SCOPED_TRACE(seed);
  SmallWorld world({.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {.x = true, .y = true, .z = true}});
  world.add({.radius = 0.5});
  world.add({.radius = 0.25});
  Random random(seed);
  Bodies& bodies = world.state.bodies;
  for (int k = 0; k < 500; ++k) {
    for (std::uint32_t number = 0; number < 2; ++number)
      for (int axis = 0; axis < 3; ++axis) bodies[number].bound.position[axis] = 10.0 * random.uniform();
    double least = 1e9;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          least = std::min(least, norm(bodies[1].bound.position + 10.0 * Vec3{1.0 * x, 1.0 * y, 1.0 * z} -
                                       bodies[0].bound.position));
    const GapLimits gap = gap_at(bodies, 0.0, collision_shape_of(bodies, 0), collision_shape_of(bodies, 1));
    EXPECT_NEAR(gap.lower, least - 0.75, 1e-9);
    EXPECT_NEAR(gap.upper, least - 0.75, 1e-9);
  }
}

TEST(BodyBounds, WithChangedLimitsAreNewIfTheStateIsKnown) {
  SmallWorld world;
  world.add({.radius = 1.0, .acceleration_limit = 1.0, .position_error = 0.5, .velocity = {1, 0, 0}});
  BodyDefinition changed = world.state.bodies.definition_of(0);
  changed.radius = 2.0;
  changed.acceleration_limit = 3.0;
  const Bound known = bound_with(world.state.bodies, 0, changed, 0.0);
  EXPECT_EQ(known.radius, 2.5);
  EXPECT_EQ(known.acceleration_limit, 3.0);
  const Bound unknown = bound_with(world.state.bodies, 0, changed, 4.0);
  EXPECT_EQ(unknown.time, 0.0) << "the old limits held until now";
  EXPECT_EQ(unknown.acceleration_limit, 1.0);
  EXPECT_EQ(unknown.radius, 2.5);
}

TEST(BodyBounds, SpheresAreWhereEventsShowThem) {
  SmallWorld world({.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {.x = true}});
  world.add({.radius = 1.0, .position = {9, 5, 5}, .velocity = {1, 0, 0}, .user_data = 7, .mass = 3.0});
  const Sphere sphere = sphere_at(world.state.bodies, 4.0, 0);
  EXPECT_EQ(sphere.state.position, (Vec3{3, 5, 5})) << "in the primary image";
  EXPECT_EQ(sphere.state.velocity, (Vec3{1, 0, 0}));
  EXPECT_EQ(sphere.user_data, 7u);
  EXPECT_EQ(sphere.mass, 3.0);
  EXPECT_EQ(sphere.radius, 1.0);
}

TEST(BodyBounds, SensorsReachAsFarAsTheirLargestDistance) {
  SmallWorld world;
  world.state.bodies.sensors.set(3, {.distances = {1.0, 4.0}});
  world.add({});
  world.add({.sensor_class = 3});
  const Bodies& bodies = world.state.bodies;
  EXPECT_EQ(sensor_reach(bodies, 0), 0.0);
  EXPECT_EQ(sensor_reach(bodies, 1), 4.0);
  EXPECT_EQ(reach_of_pair(bodies, 0, 1), 4.0);
}

TEST(BodyBounds, OfAStaticShapeAreTheBallAroundItsBox) {
  SmallWorld world;
  const std::uint32_t number = world.add({.radius = 0.0});
  world.state.bodies.give_shape(number, Box{{1, 2, 3}, {3, 4, 5}}, false);
  const Bound ball = ball_around_static(world.state.bodies, number, 0.0);
  EXPECT_EQ(ball.position, (Vec3{2, 3, 4}));
  EXPECT_NEAR(ball.radius, std::sqrt(3.0) + world.state.bodies.definition().contact_tolerance, 1e-15);
  EXPECT_EQ(box_of_static(world.state.bodies, number), (Box{{1, 2, 3}, {3, 4, 5}}));
}

}  // namespace
}  // namespace kinesphere::body_bounds_test
