// Windows end and start again, for all bodies or with those that have arrived, in one step or prepared.
#include <gtest/gtest.h>

#include <vector>

#include "support/in_windows.hpp"
#include "support/playground.hpp"

namespace kinesphere::epochs_test {
namespace {

constexpr std::uint64_t seed = 5214;

/// Balls that fly about in a box whose walls they pass through.
void add_some(Playground& world, int count, std::uint64_t stream, double radius = 0.05) {
  Random random = Random::at(seed, stream, 0);
  for (int k = 0; k < count; ++k) {
    const Vec3 position = 3.0 * random.point_in_ball();
    const Vec3 velocity = random.point_in_ball();
    const Vec3 acceleration = 0.1 * random.point_in_ball();
    world.add({.radius = radius, .acceleration_limit = 0.2, .position = position, .velocity = velocity},
              acceleration);
  }
}

TEST(Epochs, EndAndStartForAllBodies) {
  Playground world;
  use_windows(world.world);
  add_some(world, 40, 0);
  (void)world.run(0.01);
  EXPECT_EQ(world.world.counters().window_ends, 1u) << "all of them are new";
  EXPECT_EQ(world.world.counters().searches, 40u);
  (void)world.run(8.0);
  const Counters& counters = world.world.counters();
  EXPECT_GT(counters.window_ends, 4u);
  EXPECT_GT(counters.starts, 40u);
  EXPECT_TRUE(is_clean(world.world));
}

TEST(Epochs, StartWithMostOfThoseThatArrive) {
  Playground world;
  use_windows(world.world);
  add_some(world, 40, 0);
  (void)world.run(0.01);
  const std::uint64_t before = world.world.counters().window_ends;
  add_some(world, 3, 1);
  (void)world.run(0.02);
  EXPECT_EQ(world.world.counters().window_ends, before) << "a few are searched for one by one";
  add_some(world, 30, 2);
  (void)world.run(0.03);
  EXPECT_EQ(world.world.counters().window_ends, before + 1);
}

TEST(Epochs, ThatAreSpreadHaveTheSameEvents) {
  std::vector<std::vector<Event>> events;
  for (const bool is_spread : {false, true}) {
    Playground world({.spread_window_starts = is_spread});
    add_some(world, 60, 3, 0.3);
    events.push_back(world.run(6.0));
    EXPECT_TRUE(is_clean(world.world));
  }
  ASSERT_EQ(events[0].size(), events[1].size());
  EXPECT_GT(events[0].size(), 20u);
  for (std::size_t k = 0; k < events[0].size(); ++k) {
    EXPECT_EQ(events[0][k].kind, events[1][k].kind);
    EXPECT_EQ(events[0][k].first, events[1][k].first);
    EXPECT_NEAR(events[0][k].time, events[1][k].time, 1e-4);
  }
}

}  // namespace
}  // namespace kinesphere::epochs_test
