// Velocity changes: of bodies just probed and not, in contact and free, and of several at one stop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::set_velocity_test {
namespace {

TEST(VelocityChange, OfABodyNotProbedForLongAsksFirst) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .acceleration_limit = 1, .velocity = {1, 0, 0}}, Vec3{0, 0.9, 0});
  p.run(0.13);
  // The body is not at the place of its last report; only its bound contains it.
  const Vec3 there = p.state(a).position;
  p.set_velocity(a, {0, 0, 100});
  p.steer(a, {});
  p.add({.radius = 1, .position = there + Vec3{0, 0, 50}});
  bool asked_at_once = false;
  p.distort = [&](BodyId id, double time, State&) { asked_at_once |= id == a && time == 0.13; };
  const auto events = p.run(10.0);
  EXPECT_TRUE(asked_at_once);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_NEAR(events[0].time, 0.13 + 0.48, 1e-6);
}

TEST(VelocityChange, DoesNotTrustTheVelocityOfTheKickForAStaleBody) {
  // The probe is right and the velocity passed to set_velocity() wrong: the report counts, and the caller
  // gets an error.
  Playground p;
  const BodyId a = p.add({.radius = 1, .velocity = {1, 0, 0}});
  p.add({.radius = 1, .position = {0.5, 0, 20}});
  p.run(0.5);
  p.set_velocity_unseen(a, {0, 0, 10});
  p.world.set_velocity(a, {0, 0, -10}).value();
  const auto events = p.run(10.0);
  ASSERT_EQ(events.size(), 3u) << events;
  EXPECT_EQ(events[0].kind, EventKind::bound_violation);
  EXPECT_NEAR(events[0].velocity_excess, 20.0, 1e-9);
  EXPECT_NEAR(events[1].time, 0.5 + 1.8, 1e-6);
}

TEST(VelocityChange, LastOfSeveralAtOneStopCounts) {
  Playground p;
  const BodyId a = p.add({.radius = 1});
  p.add({.radius = 1, .position = {10, 0, 0}});
  p.add({.radius = 1, .position = {0, 10, 0}});
  p.run(1.0);
  p.set_velocity(a, {0, 100, 0});
  p.set_velocity(a, {-100, 0, 0});
  p.set_velocity(a, {4, 0, 0});
  const auto events = p.run(4.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_NEAR(events[0].time, 3.0, 1e-6);
  EXPECT_EQ(events[0].second.index, 1u);
}

TEST(VelocityChange, WaitsForTheReportWhileOthersThatWereKickedGo) {
  Playground p;
  std::vector<BodyId> bodies;
  for (int k = 0; k < 6; ++k) bodies.push_back(p.add({.radius = 1, .position = {10.0 * k, 0, 0}}));
  p.run(1.0);
  for (int k = 0; k < 4; ++k) {
    p.set_velocity(bodies[static_cast<std::size_t>(k)], {0, 1.0 + k, 0});
    p.world
        .change(bodies[static_cast<std::size_t>(k)],
                {.motion_limits = MotionLimits{.acceleration_limit = 0.5 + k}})
        .value();
  }
  p.world.remove(bodies[1]).value();
  p.world.disable(bodies[0]).value();
  p.world.enable(bodies[0], p.state(bodies[0])).value();
  p.set_velocity(bodies[4], {0, 0, 1});
  p.set_velocity(bodies[5], {0, 0, 1});
  for (const int k : {2, 3}) {
    const BodyDefinition definition = p.world.body(bodies[static_cast<std::size_t>(k)]).value().definition;
    EXPECT_EQ(definition.velocity, (Vec3{0, 1.0 + k, 0}));
    EXPECT_EQ(definition.acceleration_limit, 0.5 + k);
  }
  EXPECT_TRUE(p.run(2.0).empty());
  for (const int k : {0, 2, 3}) {
    const Bound bound = p.world.body(bodies[static_cast<std::size_t>(k)]).value().bound;
    EXPECT_EQ(bound.velocity, (Vec3{0, 1.0 + k, 0}));
    EXPECT_EQ(bound.acceleration_limit, 0.5 + k);
  }
}

TEST(VelocityChange, OfABodyFarFromTheEventCounts) {
  Playground p;
  const BodyId idle = p.add({.radius = 1, .acceleration_limit = 0.1, .position = {500, 0, 0}}, Vec3{});
  const BodyId target = p.add({.radius = 1, .acceleration_limit = 0.1, .position = {500, 50, 0}}, Vec3{});
  p.add({.radius = 1});
  p.add({.radius = 1, .position = {10, 0, 0}, .velocity = {-4, 0, 0}});
  std::vector<Event> hits;
  for (const Event& event : p.run(20.0, [&](const Event& event) {
         if (event.kind == EventKind::contact_begin && event.first != idle)
           p.set_velocity(idle, {0, 1000, 0});
       }))
    if (event.first == idle) hits.push_back(event);
  ASSERT_EQ(hits.size(), 2u) << hits;
  EXPECT_EQ(hits[0].second, target);
  EXPECT_NEAR(hits[0].time, 2.048, 1e-6);
}

TEST(VelocityChange, InContactKeepsTheContactUntilTheyAreApart) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .position = {-2, 0, 0}, .velocity = {1, 0, 0}});
  const BodyId b = p.add({.radius = 1, .position = {1, 0, 0}});
  int updates = 0;
  const auto events = p.run(10.0, [&](const Event& event) {
    if (event.kind == EventKind::contact_begin && updates++ == 0) p.set_velocity(a, {-1, 0, 0});
  });
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[1].kind, EventKind::contact_end);
  EXPECT_NEAR(events[1].time, 1.0, 1e-4);
  EXPECT_GE(p.gap(a, b, events[1].time), 4e-6 - 1e-12);
  EXPECT_LE(p.gap(a, b, events[1].time), 5e-6 + 1e-12);
}

TEST(VelocityChange, BackAndForthInContactIsOneContact) {
  Playground p({.contacts = ContactEvents::begin_and_end});
  const BodyId a = p.add({.radius = 1});
  const BodyId b = p.add({.radius = 1, .position = {1, 0, 0}, .velocity = {-0.001, 0, 0}});
  EXPECT_EQ(p.run(0.05).size(), 1u) << "which gets no response";
  for (int k = 1; k <= 20; ++k) {
    p.set_velocity(a, {k % 2 == 0 ? 3.0 : -3.0, 0, 0});
    if (k % 3 == 0) p.set_velocity(b, {0, 0, 0});
    EXPECT_TRUE(p.run(0.1 * k).empty());
  }
  EXPECT_TRUE(is_clean(p.world));
}

TEST(VelocityChange, BackAndForthInContactReportsEachNewApproach) {
  Playground p;
  const BodyId a = p.add({.radius = 1});
  p.add({.radius = 1, .position = {1, 0, 0}});
  EXPECT_FALSE(p.run(0.0).at(0).already_touching);
  for (int k = 1; k <= 20; ++k) {
    // Away, towards the other body, and towards it at another speed.
    p.set_velocity(a, {k % 3 == 0 ? -0.1 : 0.01 * k, 0, 0});
    const auto events = p.run(0.1 * k);
    ASSERT_EQ(events.size(), k % 3 == 1 ? 1u : 0u) << k << events;
    if (!events.empty()) {
      EXPECT_EQ(events[0].kind, EventKind::contact_begin);
      EXPECT_TRUE(events[0].already_touching);
    }
  }
  EXPECT_TRUE(is_clean(p.world));
}

TEST(VelocityChange, AtTheStartBeforeAnyAdvanceCounts) {
  Playground p({.start_time = 100.0});
  const BodyId a = p.add({.radius = 1, .velocity = {-5, 0, 0}});
  p.add({.radius = 1, .position = {10, 0, 0}});
  p.set_velocity(a, {8, 0, 0});
  const auto event = p.advance(200.0);
  ASSERT_TRUE(event);
  EXPECT_NEAR(event->time, 101.0, 1e-6);
}

TEST(VelocityChange, EveryStopWithoutTimeGoingOnTerminates) {
  // A caller that changes the velocity at every stop.
  Playground p;
  const BodyId a = p.add({.radius = 1, .acceleration_limit = 1}, Vec3{});
  for (int k = 0; k < 100; ++k) {
    p.set_velocity(a, {0.01 * k, 0, 0});
    EXPECT_FALSE(p.advance(0.0));
  }
  EXPECT_LE(p.world.counters().probes, 100u);
}

TEST(VelocityChange, IsExemptFromTheVelocityPromise) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .acceleration_limit = 0.5, .velocity = {1, 2, 3}}, Vec3{});
  for (int k = 1; k < 20; ++k) {
    EXPECT_TRUE(p.run(0.37 * k).empty());
    p.set_velocity(a, {100.0 * (k % 3), -50.0, 7.0 * k});
  }
  EXPECT_EQ(p.world.counters().count(EventKind::bound_violation), 0u);
}

TEST(VelocityChange, OfManyIsThatOfEachOrOfNone) {
  Playground one, all;
  std::vector<BodyId> bodies, same;
  std::vector<Vec3> velocities;
  for (int k = 0; k < 20; ++k) {
    const BodyDefinition body{.radius = 1, .position = {5.0 * k, 0.1 * k, 0}, .velocity = {0, 0, 0.01 * k}};
    same.push_back(one.add(body));
    bodies.push_back(all.add(body));
    velocities.push_back({3.0 * (k % 4), 0, 1});
  }
  one.run(0.5);
  all.run(0.5);
  for (const std::size_t k : {0u, 7u, 19u}) {
    std::vector<BodyId> wrong_bodies = bodies;
    std::vector<Vec3> wrong = velocities;
    wrong[k].y = std::numeric_limits<double>::quiet_NaN();
    expect_error(all.world.set_velocities(bodies, wrong), ErrorCode::not_finite, "velocity",
                 "set_velocities: ", bodies[k]);
    wrong_bodies[k] = {1000, 0};
    expect_error(all.world.set_velocities(wrong_bodies, velocities), ErrorCode::unknown_body, "body",
                 "set_velocities: ", BodyId{1000, 0});
  }
  expect_error(all.world.set_velocities(bodies, std::vector<Vec3>(3)), ErrorCode::out_of_range, "velocities",
               "set_velocities: ");
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    EXPECT_EQ(all.world.body(bodies[k])->bound.velocity, (Vec3{0, 0, 0.01 * static_cast<double>(k)}));
    one.set_velocity(same[k], velocities[k]);
    all.set_velocity_unseen(bodies[k], velocities[k]);
  }
  all.world.set_velocities(bodies, velocities).value();
  const auto expected = one.run(20.0), events = all.run(20.0);
  EXPECT_GT(events.size(), 5u);
  ASSERT_EQ(events.size(), expected.size());
  for (std::size_t k = 0; k < events.size(); ++k) {
    EXPECT_EQ(events[k].time, expected[k].time);
    EXPECT_NE(events[k].kind, EventKind::bound_violation);
  }
}

/// Bodies pass through each other, and all turn in each frame: who touches whom at its end is known.
TEST(SetVelocities, OfAllBodiesLeaveNoContactUntold) {
  for (const double acceleration : {0.0, 2.0}) {
    Playground p;
    Random random(3);
    std::vector<BodyId> ids;
    for (int k = 0; k < 150; ++k)
      ids.push_back(p.add({.radius = 0.3 + 0.4 * random.uniform(),
                           .acceleration_limit = acceleration,
                           .position = 6.0 * Vec3{random.uniform(), random.uniform(), random.uniform()},
                           .velocity = 2.0 * random.point_in_ball()},
                          acceleration * random.point_in_ball()));
    std::size_t touching = 0;
    for (int frame = 1; frame <= 40; ++frame) {
      p.run(frame / 60.0);
      std::vector<Vec3> velocities;
      for (std::size_t a = 0; a < ids.size(); ++a) {
        const auto partners = p.world.touching(ids[a]).value();
        for (std::size_t b = 0; b < a; ++b) {
          const double gap = p.gap(ids[a], ids[b]);
          if (std::abs(gap) < 1e-4) continue;
          const bool touch = std::find(partners.begin(), partners.end(), ids[b]) != partners.end();
          ASSERT_EQ(touch, gap < 0.0) << frame << ": " << a << " " << b << " " << gap;
          touching += static_cast<std::size_t>(touch);
        }
        velocities.push_back(2.0 * random.point_in_ball());
      }
      for (std::size_t a = 0; a < ids.size(); ++a) p.set_velocity_unseen(ids[a], velocities[a]);
      p.world.set_velocities(ids, velocities).value();
    }
    EXPECT_GT(touching, 1000u);
  }
}

}  // namespace
}  // namespace kinesphere::set_velocity_test
