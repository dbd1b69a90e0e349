// What events say of their bodies: static, zone, asleep, and how heavy.
#include <gtest/gtest.h>

#include <limits>

#include "kinesphere/recording.hpp"
#include "kinesphere/response.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::event_traits_test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(EventTraits, OfStaticBodiesAndZonesAndWalls) {
  Playground p({.box = Box{{-10, -10, -10}, {10, 10, 10}}});
  const BodyId ball = p.add({.radius = 1, .velocity = {1, 0, 0}, .mass = 3.0});
  const BodyId post = p.world.add_static({.shape = Ball{{4, 0, 0}, 1.0}}).value();
  const BodyId zone = p.world.add_zone(Box{{5, -1, -1}, {6, 1, 1}}).value();
  const auto events = p.run(9.0);
  ASSERT_EQ(events.size(), 5u) << events;
  for (const Event& event : events) {
    EXPECT_EQ(event.first, ball);
    EXPECT_EQ(event.first_traits, BodyTraits{});
    EXPECT_EQ(event.first_mass, 3.0);
    EXPECT_EQ(event.second_mass, infinite);
    EXPECT_TRUE(event.first_can_move());
    EXPECT_FALSE(event.second_can_move());
    EXPECT_EQ(event.second_traits.is_static, event.second == post || event.second == zone);
    EXPECT_EQ(event.second_traits.is_zone, event.second == zone);
    EXPECT_EQ(event.partner_of(ball), event.second);
    EXPECT_EQ(event.partner_of(no_body), no_body);
    EXPECT_EQ(event.is_sensed_by(zone), is_of_sensor(event.kind));
    EXPECT_FALSE(event.is_sensed_by(ball));
    EXPECT_FALSE(event.is_sensed_by(no_body));
  }
}

/// The visitor senses at the distance of the zone too: Event::sensor() is then the first of the two.
TEST(EventTraits, AZoneFindsItsEventsWhenItsVisitorSensesToo) {
  Playground p;
  p.world.set_sensor(1, {.distances = {0.0}}).value();
  const BodyId ball = p.add({.radius = 1, .velocity = {1, 0, 0}, .sensor_class = 1});
  const BodyId zone = p.world.add_zone(Box{{5, -1, -1}, {6, 1, 1}}).value();
  const BodyId other = p.add({.radius = 1, .position = {20, 0, 0}, .sensor_class = 1});
  int of_zone = 0;
  for (const Event& event : p.run(30.0)) {
    if (!event.is_sensed_by(zone)) continue;
    ++of_zone;
    EXPECT_NE(event.sensor(), zone);
    EXPECT_EQ(event.partner_of(zone), ball);
    EXPECT_EQ(event.partner_of(ball), zone);
    EXPECT_EQ(event.partner_of(other), no_body);
    EXPECT_TRUE(event.is_sensed_by(ball));
  }
  EXPECT_EQ(of_zone, 2);
}

/// A contact wakes its bodies, so they answer it with their own masses; a sensor lets them sleep.
TEST(EventTraits, OfASleeperThatIsPassedAndHit) {
  Playground p;
  p.world.set_sensor(1, {.distances = {2.0}}).value();
  const BodyId sleeper = p.add({.radius = 1, .mass = 2.0});
  const BodyId ball = p.add({.radius = 1, .position = {10, 0, 0}, .velocity = {-1, 0, 0}, .sensor_class = 1});
  p.world.sleep(sleeper).value();
  const auto events = p.run(9.0, [&](const Event& event) {
    if (event.kind != EventKind::contact_begin) return;
    const Response answer = response_of(event, bounce(event, 1.0));
    p.set_velocity(sleeper, *answer.first_velocity);
    p.set_velocity(ball, *answer.second_velocity);
  });
  ASSERT_GE(events.size(), 3u) << events;
  EXPECT_EQ(events[0].kind, EventKind::sensor_enter);
  EXPECT_TRUE(events[0].first_traits.is_sleeping);
  EXPECT_FALSE(response_of(events[0], bounce(events[0], 1.0)).first_velocity);
  EXPECT_EQ(events[1].kind, EventKind::contact_begin);
  EXPECT_FALSE(events[1].first_traits.is_sleeping);
  EXPECT_EQ(events[2].kind, EventKind::woke);
  EXPECT_EQ(events[2].first_mass, 2.0);
  EXPECT_NEAR(p.state(sleeper).velocity.x, -2.0 / 3.0, 1e-12);
  EXPECT_NEAR(p.state(ball).velocity.x, 1.0 / 3.0, 1e-12);
}

TEST(Mass, IsInAllEventsOfABodyAndChangesAndSurvives) {
  Playground p;
  p.world.start_recording().value();
  const BodyId light = p.add({.radius = 1, .position = {0, 0, 0}});
  const BodyId heavy = p.add({.radius = 1, .position = {5, 0, 0}, .velocity = {-1, 0, 0}, .mass = 8.0});
  World restored = World::restore(p.world.save().value()).value();
  EXPECT_EQ(p.world.body(heavy).value().definition.mass, 8.0);
  auto events = p.run(4.0, [&](const Event& event) {
    if (event.kind == EventKind::contact_begin) p.world.change(light, {.mass = 0.5}).value();
  });
  p.world.remove(heavy).value();
  const auto end = p.run(4.0);
  events.insert(events.end(), end.begin(), end.end());
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].first_mass, 1.0);
  EXPECT_EQ(events[0].second_mass, 8.0);
  EXPECT_EQ(events[1].kind, EventKind::contact_end);
  EXPECT_EQ(events[1].first_mass, 0.5);
  EXPECT_EQ(events[1].second_mass, 8.0) << "also of the removed body";
  EXPECT_EQ(restored.advance(4.0, p.probe()).value()->second_mass, 8.0);
  const BodyId next = p.add({.radius = 1, .position = {9, 0, 0}});
  EXPECT_EQ(next.index, heavy.index);
  EXPECT_EQ(p.world.body(next).value().definition.mass, 1.0);
  Replay replay = Replay::open(p.world.stop_recording().value()).value();
  while (!replay.finished()) EXPECT_TRUE(replay.advance());
  EXPECT_EQ(replay.world().body(light).value().definition.mass, 0.5);
}

TEST(Mass, IsCheckedByName) {
  Playground p;
  const BodyId ball = p.add({.radius = 1, .mass = infinite});
  const BodyId post = p.world.add_static({.shape = Ball{{4, 0, 0}, 1.0}}).value();
  EXPECT_EQ(p.world.body(post).value().definition.mass, infinite);
  p.world.change(ball, {.mass = 0.0}).value();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  expect_error(p.world.change(ball, {.mass = -1.0}), ErrorCode::out_of_range, "mass",
               "change: mass of body 0", ball);
  expect_error(p.world.change(ball, {.mass = nan}), ErrorCode::not_finite, "mass", "change: mass of body 0",
               ball);
  expect_error(p.world.change(post, {.mass = 1.0}), ErrorCode::static_body, "body", "change:", post);
  expect_error(p.world.add({.mass = nan}), ErrorCode::not_finite, "mass", "add: mass");
  expect_error(p.world.add({.mass = -0.5}), ErrorCode::out_of_range, "mass", "add: mass");
}

}  // namespace
}  // namespace kinesphere::event_traits_test
