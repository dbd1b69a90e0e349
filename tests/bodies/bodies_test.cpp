// All bodies of a world: definitions as they were given, waiting changes, radii that change, and copies.
#include "bodies/bodies.hpp"

#include <gtest/gtest.h>

#include "bodies/body_bounds.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::bodies_test {
namespace {

constexpr std::uint64_t seed = 5205;

BodyDefinition any_body(Random& random) {
  return {.radius = random.uniform(),
          .acceleration_limit = random.uniform(),
          .planned_acceleration = random.point_in_ball(),
          .position_error = random.uniform(),
          .velocity_error = random.uniform(),
          .position = random.point_in_ball(),
          .velocity = random.point_in_ball(),
          .filter = {.category = random.bits(), .mask = random.bits()},
          .solid = random.uniform() < 0.5,
          .contacts = ContactEvents::begin_and_end,
          .sensor_class = static_cast<SensorClass>(random.bits() % 4),
          .user_data = random.bits(),
          .mass = random.uniform(),
          .radius_rate = random.uniform() < 0.5 ? 0.0 : random.uniform(-1.0, 1.0)};
}

TEST(Bodies, HaveTheDefinitionsThatWereGiven) {
  SCOPED_TRACE(seed);
  Random random(seed);
  Bodies bodies{WorldDefinition{}};
  std::vector<BodyDefinition> given;
  for (std::uint32_t number = 0; number < 100; ++number) {
    given.push_back(any_body(random));
    ASSERT_EQ(bodies.add(given.back(), 3.0), number);
    bodies[number].bound = bound_now(given.back(), 3.0);
  }
  for (std::uint32_t number = 0; number < 100; number += 3) bodies.remove(number);
  for (std::uint32_t number = 0; number < 100; number += 3) {
    const std::uint32_t again = bodies.add(any_body(random), 3.0);
    given[again] = {.radius = 0.25};
    bodies.remove(again);
    ASSERT_EQ(bodies.add(given[again], 3.0), again) << "the last freed number comes first";
    given[again].contacts = ContactEvents::all;
    bodies[again].bound = bound_now(given[again], 3.0);
  }
  for (std::uint32_t number = 0; number < 100; ++number)
    EXPECT_EQ(bodies.definition_of(number), given[number]) << number << ": nothing is left of earlier bodies";
}

TEST(Bodies, AWaitingChangeCountsInTheDefinition) {
  Bodies bodies{WorldDefinition{}};
  bodies.add({.acceleration_limit = 1.0}, 0.0);
  bodies[0].bound.acceleration_limit = 1.0;
  Change& change = bodies.change_of(0);
  EXPECT_EQ(change.limits.acceleration_limit, 1.0) << "as it is";
  change.velocity = Vec3{0, 5, 0};
  change.limits.acceleration_limit = 2.0;
  EXPECT_EQ(&bodies.change_of(0), &change);
  EXPECT_EQ(bodies.definition_of(0).velocity, (Vec3{0, 5, 0}));
  EXPECT_EQ(bodies.definition_of(0).acceleration_limit, 2.0);
  bodies.forget_change(0);
  EXPECT_EQ(bodies.definition_of(0).acceleration_limit, 1.0);
}

TEST(Bodies, ChangeTheirRadiiByALaw) {
  Bodies bodies{WorldDefinition{}};
  bodies.add({.radius = 2.0}, 0.0);
  EXPECT_EQ(bodies.radius_at(0, 9.0), 2.0);
  bodies[0].bound.growth_speed = 0.125;
  bodies.set_radius_law(0, 2.0, 0.0, 1.0);
  EXPECT_EQ(bodies.radii.find(0), nullptr) << "nothing changes";
  bodies.set_radius_law(0, 2.0, 0.5, 1.0);
  EXPECT_EQ(bodies.radius_at(0, 3.0), 3.0);
  EXPECT_EQ(bodies.radius_rate(0), 0.5);
  EXPECT_EQ(bodies.velocity_error(0), 0.125) << "that of the bound before";
  EXPECT_EQ(bodies[0].radius, 2.0) << "of the last report";
  bodies.update_radius(0, 3.0);
  EXPECT_EQ(bodies[0].radius, 3.0);
}

TEST(Bodies, TouchIfTheyAreSolidAndPass) {
  Bodies bodies{WorldDefinition{}};
  bodies.add({}, 0.0);
  bodies.add({.solid = false}, 0.0);
  bodies.add({.filter = {.category = 2, .mask = 2}}, 0.0);
  EXPECT_TRUE(bodies.may_meet(0, 1));
  EXPECT_FALSE(bodies.may_touch(0, 1));
  EXPECT_FALSE(bodies.may_meet(0, 2));
  bodies.set_solid(1, true);
  EXPECT_TRUE(bodies.may_touch(0, 1));
  bodies.give_shape(0, Box{{-1, -1, -1}, {1, 1, 1}}, false);
  EXPECT_TRUE(bodies.may_touch(0, 1));
  bodies.give_shape(1, Box{{-1, -1, -1}, {1, 1, 1}}, true);
  EXPECT_TRUE(bodies.may_touch(0, 1)) << "a moving shape meets a static one";
  bodies.add({}, 0.0);
  bodies.give_shape(3, Box{{-1, -1, -1}, {1, 1, 1}}, false);
  EXPECT_FALSE(bodies.may_meet(0, 3)) << "static bodies do not meet each other";
}

TEST(Bodies, AreMovedToThePrimaryBox) {
  Bodies bodies({.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {.x = true}});
  bodies.add({.position = {1, 2, 3}}, 0.0);
  bodies[0].bound = {.position = {14, 2, 3}, .radius = 1.0};
  bodies.wrap_to_primary(0, 0.0);
  EXPECT_EQ(bodies[0].bound.position.x, 4.0);
  EXPECT_EQ(bodies.images[0].image.x, 1.0);
}

}  // namespace
}  // namespace kinesphere::bodies_test
