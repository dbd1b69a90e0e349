// Bodies that sleep stand still and wake together.
#include "processor/sleeping.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/small_world.hpp"

namespace kinesphere::sleeping_test {
namespace {

/// Velocity error of all bodies. The smaller it is, the more rarely those that touch are rechecked.
constexpr double error = 0x1p-10;

/// Five balls in a row: the first three touch, the others stand alone.
class SleepingTest : public testing::Test {
 protected:
  SleepingTest() {
    for (const double x : {0.0, 2.0, 4.0, 8.0, 12.0})
      world.add({.acceleration_limit = 1.0 + x, .velocity_error = error, .position = {x, 0, 0}});
    (void)world.advance_all(1.0);
  }
  Sleeping sleeping() { return {world.state, world.main}; }
  std::set<std::uint32_t> woken() {
    std::set<std::uint32_t> numbers;
    for (const Event& event : world.advance_all(world.main.time()))
      if (event.kind == EventKind::woke) numbers.insert(event.first.index);
    return numbers;
  }

  SmallWorld world;
};

TEST_F(SleepingTest, StandsStillAndKeepsItsLimitsForLater) {
  sleeping().sleep(3);
  (void)world.advance_all(2.0);
  const Body& body = world.state.bodies[3];
  EXPECT_TRUE(body.is_at_rest());
  EXPECT_TRUE(body.stands_still());
  EXPECT_TRUE(body.fresh(77.0)) << "its report never becomes old";
  EXPECT_EQ(world.state.core.balls()[3].own, infinity);
  EXPECT_EQ(world.state.bodies.definition_of(3).acceleration_limit, 9.0);
  const std::uint64_t probes = world.main.counters().probes;
  sleeping().resume(3);
  EXPECT_FALSE(body.is_sleeping());
  EXPECT_EQ(body.bound.acceleration_limit, 9.0);
  EXPECT_EQ(body.bound.growth_speed, error);
  EXPECT_EQ(world.main.counters().probes, probes);
  EXPECT_EQ(woken(), std::set<std::uint32_t>{}) << "without an event";
}

TEST_F(SleepingTest, WakesAllThatTouch) {
  for (std::uint32_t number = 0; number < 5; ++number) sleeping().sleep(number);
  (void)world.advance_all(2.0);
  sleeping().wake(0);
  EXPECT_EQ(woken(), (std::set<std::uint32_t>{0, 1, 2}));
  EXPECT_TRUE(world.state.bodies[3].is_sleeping() && world.state.bodies[4].is_sleeping());
}

TEST_F(SleepingTest, WakesTheSleepersBesideOneThatIsAwake) {
  for (const std::uint32_t number : {0u, 2u, 4u}) sleeping().sleep(number);
  (void)world.advance_all(2.0);
  sleeping().wake(1);
  EXPECT_EQ(woken(), (std::set<std::uint32_t>{0, 2}));
}

TEST_F(SleepingTest, AContactWakesWhomItHits) {
  sleeping().sleep(3);
  (void)world.advance_all(2.0);
  world.set_velocity(4, {-1, 0, 0});
  std::vector<EventKind> kinds;
  while (const auto event = world.advance(10.0)) {
    kinds.push_back(event->kind);
    if (event->kind == EventKind::contact_begin) {
      EXPECT_FALSE(event->first_traits.is_sleeping);
    }
    if (event->kind == EventKind::contact_begin) world.set_velocity(4, {1, 0, 0});
    if (kinds.size() == 2) break;
  }
  EXPECT_EQ(kinds, (std::vector{EventKind::contact_begin, EventKind::woke}));
  EXPECT_FALSE(world.state.bodies[3].is_sleeping());
}

TEST_F(SleepingTest, BeforeItsReportABodyWaitsForOne) {
  world.state.bodies[4].bound.time = 0.5;
  sleeping().sleep(4);
  EXPECT_TRUE(world.state.bodies[4].is_sleeping());
  EXPECT_FALSE(world.state.bodies[4].is_at_rest());
  ASSERT_TRUE(world.main.recertify());
  EXPECT_TRUE(world.state.bodies[4].is_at_rest());
}

}  // namespace
}  // namespace kinesphere::sleeping_test
