// Bodies of unusual kinds, places, times and sizes.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/playground.hpp"

namespace kinesphere::unusual_bodies_test {
namespace {

TEST(UnusualBodies, ThrownBallMeetsItsTargetWithFewProbes) {
  const Vec3 gravity{0, 0, -10};
  Playground p;
  p.add({.radius = 0.5, .planned_acceleration = gravity, .velocity = {10, 0, 20}});
  const BodyId target = p.add({.radius = 0.5, .position = {40, 0, 0}});
  const auto events = p.run(10.0);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].second, target);
  EXPECT_LE(events[0].gap, 1e-6);
  EXPECT_GE(events[0].gap, -1e-9);
  EXPECT_LT(events[0].time, 4.0);
  EXPECT_GT(events[0].time, 3.9);
  EXPECT_LT(p.world.counters().probes, 200u);
}

TEST(UnusualBodies, AgentsWithOnlyASpeedLimitNeverMissEachOther) {
  // Unknown velocity: reported as zero, truly up to V in any direction.
  const double top_speed = 2.0, eps = 1e-3;
  Playground p({.contact_tolerance = eps});
  Random random(8);
  std::vector<BodyId> agents;
  std::vector<Vec3> heading;
  for (int k = 0; k < 12; ++k) {
    agents.push_back(
        p.add({.radius = 0.4, .velocity_error = top_speed, .position = {1.0 * (k % 4), 1.0 * (k / 4), 0}}));
    p.set_velocity_unseen(agents.back(), 0.99 * top_speed * random.unit_vector());
  }
  p.distort = [](BodyId, double, State& state) { state.velocity = {}; };
  std::set<std::pair<BodyId, BodyId>> touching;
  for (int tick = 1; tick <= 20; ++tick) {
    p.run(0.25 * tick, [&](const Event& event) {
      ASSERT_NE(event.kind, EventKind::bound_violation);
      if (event.kind == EventKind::contact_begin) touching.insert({event.first, event.second});
      if (event.kind == EventKind::contact_end) touching.erase({event.first, event.second});
    });
    for (std::size_t a = 0; a < agents.size(); ++a)
      for (std::size_t b = a + 1; b < agents.size(); ++b) {
        const double gap = p.gap(agents[a], agents[b]);
        if (touching.contains({agents[a], agents[b]})) {
          EXPECT_LE(gap, 5 * eps + 1e-9);
        } else {
          EXPECT_GE(gap, -eps);
        }
      }
    for (const BodyId id : agents) p.set_velocity_unseen(id, 0.99 * top_speed * random.unit_vector());
  }
  EXPECT_GT(p.world.counters().count(EventKind::contact_begin), 0u);
}

TEST(UnusualBodies, StaticWorldCostsNothing) {
  Playground p;
  for (int k = 0; k < 100; ++k) p.add({.radius = 0.4, .position = {1.0 * (k % 10), 1.0 * (k / 10), 0}});
  EXPECT_TRUE(p.run(1e6).empty());
  // Spot checks: one of each body whenever the time has quadrupled.
  EXPECT_LT(p.world.counters().probes, 100u * 14u);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(UnusualBodies, PointsMeetOnlyWhenTheyCoincide) {
  Playground p;
  p.add({.radius = 0, .velocity = {1, 0, 0}});
  p.add({.radius = 0, .position = {2, 0, 0}, .velocity = {-1, 0, 0}});
  p.add({.radius = 0, .position = {2, 1e-3, 0}, .velocity = {-1, 0, 0}});
  const auto events = p.run(10.0);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_NEAR(events[0].time, 1.0, 1e-6);
  EXPECT_EQ(events[0].second.index, 1u);
}

TEST(UnusualBodies, StaticPointsAtRoundPlacesAreFound) {
  // Boxes of no extent, on coordinates that single precision holds exactly.
  Playground p;
  for (int k = 0; k < 50; ++k) p.add({.radius = 0, .position = {1.0 * k, 0, 0}});
  p.add({.radius = 0.25, .acceleration_limit = 1, .position = {-1, 0, 0}, .velocity = {5, 0, 0}}, Vec3{});
  EXPECT_EQ(p.run(20.0).size(), 100u);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(UnusualBodies, RadiiOfOneToAMillionMeet) {
  Playground p;
  const BodyId planet = p.add({.radius = 1000, .position = {0, 0, -1000}});
  std::vector<BodyId> drops;
  for (int k = 0; k < 30; ++k)
    drops.push_back(p.add({.radius = k % 2 == 0 ? 1e-3 : 1.0,
                           .acceleration_limit = 0.5,
                           .planned_acceleration = {0, 0, -10},
                           .position = {0.1 * k, 30.0 * (k % 5), 20.0 + k},
                           .velocity = {0, 0, -1}},
                          Vec3{0, 0, -9.8}));
  std::size_t landed = 0;
  for (const Event& event : p.run(4.0))
    landed += event.kind == EventKind::contact_begin && event.first == planet;
  EXPECT_EQ(landed, drops.size());
  EXPECT_LT(p.world.counters().probes, 20000u);
}

TEST(UnusualBodies, LoneBulletOfAnySizeCostsLittle) {
  for (const double radius : {0.0, 1e-9, 1e-6, 1e-3, 1.0}) {
    Playground p({.contact_tolerance = 1e-9 + 1e-6 * radius});
    p.add({.radius = radius, .acceleration_limit = 1, .velocity = {300, 0, 0}}, Vec3{});
    p.run(1.0);
    p.add({.radius = radius, .acceleration_limit = 1, .position = {-10, 0, 0}, .velocity = {300, 0, 0}},
          Vec3{});
    EXPECT_TRUE(p.run(6.0).empty());
    EXPECT_LT(p.world.counters().probes, 5000u) << "radius " << radius;
  }
}

/// Returns the events of one scene, scaled in length by `length` and in time by `time`, and moved.
std::vector<Event> scaled_scene(double length, double time, double start = 0.0, const Vec3& place = {}) {
  Playground p({.contact_tolerance = 1e-6 * length, .start_time = start});
  Random random(11);
  const double rate = length / time;
  for (int k = 0; k < 60; ++k) {
    const BodyDefinition body{
        .radius = (0.3 + 0.5 * random.uniform()) * length,
        .acceleration_limit = 4 * rate / time,
        .planned_acceleration = Vec3{0, 0, -2} * (rate / time),
        .position = place + Vec3{2.0 * (k % 4), 2.0 * (k / 4 % 4), 2.0 * (k / 16)} * length,
        .velocity = 3.0 * random.point_in_ball() * rate};
    p.add(body, (Vec3{0, 0, -2} + 3.9 * random.point_in_ball()) * (rate / time));
  }
  auto events = p.run(start + 3.0 * time);
  EXPECT_TRUE(is_clean(p.world));
  EXPECT_GT(events.size(), 20u);
  return events;
}

void expect_scaled(const std::vector<Event>& scaled, const std::vector<Event>& plain, double length,
                   double time, double start = 0.0, double tolerance = 1e-5) {
  ASSERT_EQ(scaled.size(), plain.size());
  for (std::size_t k = 0; k < plain.size(); ++k) {
    ASSERT_EQ(scaled[k].kind, plain[k].kind) << scaled[k] << "\n" << plain[k];
    ASSERT_EQ(scaled[k].first, plain[k].first) << scaled[k] << "\n" << plain[k];
    ASSERT_EQ(scaled[k].second, plain[k].second) << scaled[k] << "\n" << plain[k];
    ASSERT_NEAR((scaled[k].time - start) / time, plain[k].time, tolerance);
    ASSERT_LE(std::abs(scaled[k].gap), 5.0001e-6 * length + std::abs(plain[k].gap * length));
  }
}

TEST(Scale, NoUnitIsSpecial) {
  const auto plain = scaled_scene(1, 1);
  for (const double length : {0x1p-30, 0x1p-10, 0x1p20, 0x1p30})
    for (const double time : {0x1p-20, 1.0, 0x1p20}) {
      SCOPED_TRACE(testing::Message() << length << " " << time);
      expect_scaled(scaled_scene(length, time), plain, length, time);
    }
  expect_scaled(scaled_scene(1e-9, 1e-9), plain, 1e-9, 1e-9);
  expect_scaled(scaled_scene(1e6, 1e3), plain, 1e6, 1e3);
}

TEST(Scale, NeitherPlaceNorTimeIsSpecial) {
  const auto plain = scaled_scene(1, 1);
  for (const double start : {-1000.0, -1.0, 12345.0, 1e6})
    expect_scaled(scaled_scene(1, 1, start), plain, 1, 1, start);
  for (const double place : {-1e3, 1e6, -2.19e6})
    expect_scaled(scaled_scene(1, 1, 0.0, {place, -place, place}), plain, 1, 1, 0.0, 1e-5);
}

TEST(Scale, PowersOfTwoScaleEveryBit) {
  const auto plain = scaled_scene(1, 1);
  for (const double length : {0x1p-4, 0x1p6})
    for (const double time : {0x1p-7, 0x1p3}) {
      const auto scaled = scaled_scene(length, time);
      ASSERT_EQ(scaled.size(), plain.size());
      for (std::size_t k = 0; k < plain.size(); ++k) {
        EXPECT_EQ(scaled[k].time, plain[k].time * time) << k;
        EXPECT_EQ(scaled[k].gap, plain[k].gap * length) << k;
        EXPECT_EQ(scaled[k].approach_speed, plain[k].approach_speed * (length / time)) << k;
      }
    }
}

TEST(UnusualBodies, PointAtTheOriginIsFoundAfterAKick) {
  // The swept sphere has no size, at the one place where rounding gives it none.
  Playground p;
  const BodyId point = p.add({.radius = 0});
  p.add({.radius = 1, .position = {10, 0, 0}});
  p.run(1.0);
  p.set_velocity(point, {1, 0, 0});
  const auto events = p.run(20.0);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_NEAR(events[0].time, 10.0, 1e-5);
}

TEST(UnusualBodies, PointsAtOnePlaceDoNotStopTime) {
  Playground p;
  for (int k = 0; k < 10; ++k) p.add({.radius = 0, .velocity = {1, 0, 0}});
  EXPECT_EQ(p.run(1.0).size(), 45u);
  EXPECT_LT(p.world.counters().probes, 50000u);
}

TEST(UnusualBodies, ManyContactsOfOneInstantComeInOrder) {
  Playground p;
  for (int k = 0; k < 100; ++k) p.add({.radius = 1, .position = {0.001 * k, 0, 0}});
  const auto events = p.run(0.5);
  ASSERT_EQ(events.size(), 100u * 99u / 2u);
  for (std::size_t k = 1; k < events.size(); ++k)
    EXPECT_LT(std::pair(events[k - 1].first, events[k - 1].second),
              std::pair(events[k].first, events[k].second));
}

void answer_rest(std::span<const BodyId>, double, std::span<State> states) {
  for (State& state : states) state = {};
}

TEST(UnusualBodies, ProbeMayBeAPlainFunction) {
  World world = World::create({}).value();
  world.add({.radius = 1, .acceleration_limit = 1}).value();
  EXPECT_TRUE(world.advance(1e3, answer_rest));
  EXPECT_TRUE(world.advance(2e3, &answer_rest));
  EXPECT_GT(world.counters().probes, 0u);
}

}  // namespace
}  // namespace kinesphere::unusual_bodies_test
