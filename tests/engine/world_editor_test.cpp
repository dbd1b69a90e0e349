// Changes by the caller: what each of them ends, begins and forgets.
#include <gtest/gtest.h>

#include "support/playground.hpp"

namespace kinesphere::world_editor_test {
namespace {

/// Two balls that touch, and one that is far away.
class WorldEditorTest : public testing::Test {
 protected:
  WorldEditorTest() {
    one = world.add({.acceleration_limit = 0.1});
    other = world.add({.acceleration_limit = 0.1, .position = {2, 0, 0}});
    far = world.add({.acceleration_limit = 0.1, .position = {50, 0, 0}});
    EXPECT_EQ(kinds(1.0), Kinds{EventKind::contact_begin});
  }
  using Kinds = std::vector<EventKind>;
  Kinds kinds(double until) {
    Kinds found;
    for (const Event& event : world.run(until)) found.push_back(event.kind);
    return found;
  }
  void expect_touching(bool touches) {
    EXPECT_EQ(world.world.touching(one).value().size(), touches ? 1u : 0u);
    EXPECT_TRUE(is_clean(world.world));
  }

  Playground world;
  BodyId one, other, far;
};

TEST_F(WorldEditorTest, ARemovedBodyEndsItsContactsAndItsId) {
  world.world.remove(other).value();
  EXPECT_EQ(kinds(1.0), Kinds{EventKind::contact_end});
  expect_touching(false);
  const BodyId next = world.add({.position = {20, 0, 0}});
  EXPECT_EQ(next.index, other.index);
  EXPECT_NE(next, other);
  EXPECT_FALSE(world.world.contains(other));
}

TEST_F(WorldEditorTest, ADisabledBodyIsOutOfTheWayUntilItIsEnabled) {
  world.world.disable(other).value();
  EXPECT_EQ(kinds(2.0), Kinds{EventKind::contact_end});
  world.set_position(other, {2, 0, 0});
  world.world.enable(other, world.state(other)).value();
  EXPECT_EQ(kinds(3.0), Kinds{EventKind::contact_begin});
  expect_touching(true);
}

TEST_F(WorldEditorTest, AFilterEndsWhatItForbids) {
  world.world.change(one, {.filter = Filter{.category = 2, .mask = 4}}).value();
  EXPECT_EQ(kinds(2.0), Kinds{EventKind::contact_end});
  expect_touching(false);
  world.world.change(one, {.filter = Filter{}}).value();
  EXPECT_EQ(kinds(3.0), Kinds{EventKind::contact_begin});
}

TEST_F(WorldEditorTest, AZoneTouchesNobody) {
  world.world.change(other, {.solid = false}).value();
  EXPECT_EQ(kinds(2.0), Kinds{EventKind::contact_end});
}

TEST_F(WorldEditorTest, ASmallerRadiusEndsAndALargerOneBegins) {
  world.world.change(one, {.radius = 0.5}).value();
  EXPECT_EQ(kinds(2.0), Kinds{EventKind::contact_end});
  world.world.change(one, {.radius = 1.0}).value();
  EXPECT_EQ(kinds(3.0), Kinds{EventKind::contact_begin});
  world.world.change(one, {.radius = 49.0}).value();
  EXPECT_EQ(kinds(4.0).front(), EventKind::contact_begin) << "with the one that was far away";
  EXPECT_EQ(world.world.touching(one).value().size(), 2u);
}

TEST_F(WorldEditorTest, NewLimitsHoldFromNowOn) {
  world.world.change(far, {.motion_limits = MotionLimits{.acceleration_limit = 5.0}}).value();
  EXPECT_EQ(kinds(2.0), Kinds{});
  EXPECT_EQ(world.world.body(far).value().definition.acceleration_limit, 5.0);
  EXPECT_TRUE(is_clean(world.world));
}

TEST_F(WorldEditorTest, SensorsSeeWhoIsThereAlready) {
  world.world.set_sensor(3, {.distances = {10.0}}).value();
  world.world.change(one, {.sensor_class = 3}).value();
  EXPECT_EQ(kinds(2.0), Kinds{EventKind::sensor_enter});
  world.world.set_sensor(3, {}).value();
  EXPECT_EQ(kinds(3.0), Kinds{EventKind::sensor_leave});
}

}  // namespace
}  // namespace kinesphere::world_editor_test
