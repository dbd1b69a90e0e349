// The clock: time goes to the next event or to the end of a call, and no event is known too late.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/playground.hpp"

namespace kinesphere::engine_test {
namespace {

TEST(Engine, GoesToTheEndOfACallWithoutEvents) {
  Playground world({.start_time = 2.0});
  EXPECT_EQ(world.advance(5.0), std::nullopt) << "nobody is there";
  EXPECT_EQ(world.world.time(), 5.0);
  world.add({.velocity = {1, 0, 0}});
  EXPECT_EQ(world.advance(5.0), std::nullopt);
  EXPECT_EQ(world.advance(1e6), std::nullopt);
  EXPECT_EQ(world.world.time(), 1e6);
}

TEST(Engine, KnowsAllEventsOfAnInstantBeforeTheFirst) {
  // Two pairs meet at the same time; the second event stands, whatever the response to the first is.
  Playground world;
  for (const double y : {0.0, 50.0}) {
    world.add({.position = {0, y, 0}, .velocity = {1, 0, 0}});
    world.add({.position = {4, y, 0}, .velocity = {-1, 0, 0}});
  }
  const auto first = world.advance(10.0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->first.index, 0u);
  world.set_velocity({2, 0}, {-3, 0, 0});
  const auto second = world.advance(10.0);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->first.index, 2u);
  EXPECT_EQ(second->kind, EventKind::contact_begin);
  EXPECT_EQ(second->time, first->time);
}

TEST(Engine, DeliversTheSameInOneCallOrInMany) {
  std::vector<Event> events[2];
  for (const bool in_steps : {false, true}) {
    Playground world;
    Random random(5215);
    for (int k = 0; k < 30; ++k) {
      const Vec3 position = random.point_in_ball();
      world.add({.radius = 0.1,
                 .acceleration_limit = 0.1,
                 .position = position,
                 .velocity = random.point_in_ball()});
    }
    for (double until = in_steps ? 0.1 : 3.0; until < 3.05; until += 0.1) {
      const auto some = world.run(std::min(until, 3.0));
      events[in_steps].insert(events[in_steps].end(), some.begin(), some.end());
    }
  }
  ASSERT_EQ(events[0].size(), events[1].size());
  ASSERT_GT(events[0].size(), 10u);
  for (std::size_t k = 0; k < events[0].size(); ++k) EXPECT_EQ(events[0][k].time, events[1][k].time);
}

TEST(Engine, GoesOnAfterAReportThatWasNone) {
  Playground world;
  world.add({.acceleration_limit = 1.0, .velocity = {1, 0, 0}});
  world.add({.acceleration_limit = 1.0, .position = {6, 0, 0}});
  bool fails = true;
  world.distort = [&](BodyId, double, State& state) {
    if (fails) state.position.x = std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_FALSE(world.world.advance(10.0, world.probe()));
  fails = false;
  const auto event = world.advance(10.0);
  ASSERT_TRUE(event);
  EXPECT_NEAR(event->time, 4.0, 1e-5);
}

}  // namespace
}  // namespace kinesphere::engine_test
