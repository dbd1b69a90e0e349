// What is due is rechecked with as few reports as decide it, for pairs, walls, sensors and changing radii.
#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"
#include "support/small_world.hpp"

namespace kinesphere::rechecks_test {
namespace {

constexpr std::uint64_t seed = 5202;
constexpr double tolerance = 1e-6;

TEST(Rechecks, OfExactBodiesNeedOneReportOfEach) {
  SmallWorld world;
  world.add({.velocity = {1, 0, 0}});
  world.add({.position = {7, 0, 0}, .velocity = {-1, 0, 0}});
  ASSERT_TRUE(world.main.recertify());
  const auto event = world.advance(10.0);
  ASSERT_TRUE(event);
  EXPECT_NEAR(event->time, 2.5, tolerance);
  EXPECT_EQ(world.main.counters().probes, 2u) << "both at once, where they meet";
}

TEST(Rechecks, ProbeTheOlderReportFirst) {
  SmallWorld world;
  world.add({.acceleration_limit = 1.0});
  world.add({.acceleration_limit = 1.0, .position = {5, 0, 0}});
  ASSERT_EQ(world.advance(10.0), std::nullopt);
  const double first = world.state.bodies[0].bound.time;
  const double second = world.state.bodies[1].bound.time;
  EXPECT_NE(first, second) << "one report moves the certificate";
  EXPECT_GT(std::min(first, second), 8.0) << "neither stays old";
}

TEST(Rechecks, FindWallsAndWhenTheyAreLeft) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 60; ++k) {
    const double speed = random.uniform(0.5, 3.0);
    const int axis = k % 3;
    const bool upper = k % 2 == 0;
    SmallWorld world({.box = Box{{-5, -5, -5}, {5, 5, 5}}});
    Vec3 velocity;
    velocity[axis] = upper ? speed : -speed;
    world.add({.acceleration_limit = 0.1, .velocity = velocity});
    const auto begin = world.advance(100.0);
    ASSERT_TRUE(begin);
    EXPECT_EQ(begin->kind, EventKind::wall_begin);
    EXPECT_EQ(static_cast<int>(begin->wall), 1 + 2 * axis + (upper ? 1 : 0));
    EXPECT_NEAR(begin->time, 4.0 / speed, 2 * tolerance / speed);
    world.set_velocity(0, -velocity);
    const auto end = world.advance(100.0);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->kind, EventKind::wall_end);
    EXPECT_GE(end->gap, 4 * tolerance * (1.0 - 1e-9)) << "the separation distance";
    EXPECT_LE(end->gap, 5 * tolerance * (1.0 + 1e-9));
  }
}

TEST(Rechecks, CrossSensorDistancesOneAfterTheOther) {
  SmallWorld world;
  world.state.bodies.sensors.set(1, {.distances = {1.0, 3.0}});
  world.add({.velocity = {1, 0, 0}, .solid = false, .sensor_class = 1});
  world.add({.position = {10, 0, 0}});
  const auto events = world.advance_all(30.0);
  ASSERT_EQ(events.size(), 4u);
  const double times[] = {5.0, 7.0, 13.0, 15.0};
  const double distances[] = {3.0, 1.0, 1.0, 3.0};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(events[k].kind, k < 2 ? EventKind::sensor_enter : EventKind::sensor_leave);
    EXPECT_EQ(events[k].distance, distances[k]);
    EXPECT_NEAR(events[k].time, times[k], 6 * tolerance);
    EXPECT_EQ(events[k].senses, Senses::first);
  }
}

TEST(Rechecks, KnowRadiiThatGrowAndShrink) {
  for (const double rate : {0.5, -0.25}) {
    SmallWorld world;
    world.add({.radius = 1.0, .velocity = {1, 0, 0}, .radius_rate = rate});
    world.add({.radius = 1.0, .position = {8, 0, 0}});
    const auto event = world.advance(50.0);
    ASSERT_TRUE(event);
    // The gap 6 - (1 + rate) t vanishes; a ball that shrinks is a point from 4 on.
    EXPECT_NEAR(event->time, rate > 0.0 ? 4.0 : 7.0, 1e-5);
    EXPECT_NEAR(world.state.bodies[0].radius, rate > 0.0 ? 3.0 : 0.0, 1e-5);
  }
}

TEST(Rechecks, TellThatAGuardLetsTwoOverlap) {
  // Two bodies touch, and rest nearly a tolerance deep; they may press on at any time.
  SmallWorld world({.contacts = ContactEvents::impacts});
  world.add({.acceleration_limit = 1.0});
  world.add({.acceleration_limit = 1.0, .position = {2.0 - 0.9 * tolerance, 0, 0}});
  const auto event = world.advance(1e-3);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::zeno_guard);
  EXPECT_GT(world.main.counters().zeno_steps, 0u);
}

}  // namespace
}  // namespace kinesphere::rechecks_test
