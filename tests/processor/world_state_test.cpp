// What the processors of a world share begins empty, by the definition of the world, and is copied whole.
#include "processor/world_state.hpp"

#include <gtest/gtest.h>

#include "bodies/body_bounds.hpp"

namespace kinesphere::world_state_test {
namespace {

TEST(WorldState, FollowsFromTheDefinition) {
  const WorldDefinition definition{
      .box = Box{{0, 0, 0}, {9, 9, 0}}, .periodic = {.y = true}, .dimensions = 2};
  const WorldState state(definition);
  EXPECT_EQ(state.bodies.definition(), definition);
  EXPECT_TRUE(state.bodies.space().repeats(1));
  EXPECT_TRUE(state.bodies.space().is_flat());
  EXPECT_EQ(state.contacts.rule().tolerance(), definition.contact_tolerance);
  ASSERT_TRUE(state.bodies.walls());
  EXPECT_EQ(state.bodies.walls()->upper.x, 9.0);
  EXPECT_EQ(state.bodies.walls()->upper.y, std::numeric_limits<double>::infinity()) << "it repeats";
}

TEST(WorldState, IsCopiedWhole) {
  WorldState state{WorldDefinition{}};
  state.bodies.add({.radius = 2.0}, 0.0);
  state.contacts.add(0, 0.0);
  state.core.enter(0, {.radius = 2.0}, false, false);
  const WorldState copy = state;
  state.core.leave(0);
  state.bodies.remove(0);
  EXPECT_EQ(copy.bodies[0].radius, 2.0);
  EXPECT_TRUE(copy.core.contains(0));
}

}  // namespace
}  // namespace kinesphere::world_state_test
