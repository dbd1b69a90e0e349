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
  EXPECT_TRUE(state.broad_phase.space().repeats(1));
  EXPECT_TRUE(state.broad_phase.space().is_flat());
  EXPECT_EQ(state.contacts.rule().tolerance(), definition.contact_tolerance);
  EXPECT_FALSE(state.window_policy.is_chosen());
  ASSERT_TRUE(state.bodies.walls());
  EXPECT_EQ(state.bodies.walls()->upper.x, 9.0);
  EXPECT_EQ(state.bodies.walls()->upper.y, std::numeric_limits<double>::infinity()) << "it repeats";
}

TEST(WorldState, IsCopiedWhole) {
  WorldState state{WorldDefinition{}};
  state.bodies.add({.radius = 2.0}, 0.0);
  state.contacts.add(0, 0.0);
  state.broad_phase.enter(0, inflated_bound(state.bodies, 0, 0.0), 0.0, Window::at(0.0, 0));
  const WorldState copy = state;
  state.broad_phase.leave(0);
  state.bodies.remove(0);
  EXPECT_EQ(copy.bodies[0].radius, 2.0);
  EXPECT_TRUE(copy.broad_phase.contains(0));
}

}  // namespace
}  // namespace kinesphere::world_state_test
