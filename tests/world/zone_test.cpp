// Zones, and the roles of the two bodies in a sensor event.
#include <gtest/gtest.h>

#include <map>

#include "kinesphere/recording.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::zone_test {
namespace {

TEST(Zone, IsOneLineAndTellsWhoComesAndGoes) {
  Playground p;
  const BodyId zone = p.world.add_zone(Box{{10, -5, -5}, {20, 5, 5}}, 77).value();
  const BodyId ball = p.add({.radius = 1, .velocity = {1, 0, 0}, .user_data = 5});
  const auto events = p.run(100.0);
  ASSERT_EQ(events.size(), 2u) << events;
  for (const Event& event : events) {
    EXPECT_EQ(event.sensor(), zone);
    EXPECT_EQ(event.visitor(), ball);
    EXPECT_EQ(event.sensor_user_data(), 77u);
    EXPECT_EQ(event.visitor_user_data(), 5u);
    EXPECT_EQ(event.distance, 0.0);
  }
  EXPECT_EQ(events[0].kind, EventKind::sensor_enter);
  EXPECT_NEAR(events[0].time, 9.0, 1e-5);
  EXPECT_EQ(events[1].kind, EventKind::sensor_leave);
  EXPECT_NEAR(events[1].time, 21.0, 1e-5);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Zone, OfABulletThatIsRemovedInItStillTellsWhichItWas) {
  Playground p;
  p.world.add_zone(Ball{{10, 0, 0}, 1.0}).value();
  p.add({.radius = 1, .velocity = {1, 0, 0}, .user_data = 42});
  const auto events = p.run(100.0, [&](const Event& event) {
    if (event.kind == EventKind::sensor_enter) p.world.remove(event.visitor()).value();
  });
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[1].kind, EventKind::sensor_leave);
  EXPECT_EQ(events[1].visitor_user_data(), 42u);
}

TEST(Zone, TakesTheDistancesThatItsClassHasAlready) {
  Playground p;
  EXPECT_TRUE(p.world.sensor(zone_class).distances.empty());
  p.world.add_zone(Ball{{100, 0, 0}, 1.0}).value();
  EXPECT_EQ(p.world.sensor(zone_class).distances, std::vector{0.0});
  p.world.set_sensor(zone_class, {.distances = {3.0}}).value();
  p.world.add_zone(Ball{{10, 0, 0}, 1.0}).value();
  EXPECT_EQ(p.world.sensor(zone_class).distances, std::vector{3.0});
  p.add({.radius = 1, .velocity = {1, 0, 0}});
  const auto events = p.run(8.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_NEAR(events[0].time, 5.0, 1e-5);
}

TEST(Zone, IsRefusedLikeAnyFixedBodyAndLeavesItsClassAlone) {
  World world = World::create({}).value();
  expect_error(world.add_zone(Ball{{0, 0, 0}, -1.0}), ErrorCode::out_of_range, "radius", "add_zone:");
  EXPECT_TRUE(world.sensor(zone_class).distances.empty());
}

TEST(Zone, IsReplayedAndRestored) {
  Playground p;
  p.world.start_recording().value();
  p.world.add_zone(Box{{10, -5, -5}, {20, 5, 5}}, 77).value();
  p.add({.radius = 1, .velocity = {1, 0, 0}, .user_data = 5});
  const auto until_inside = p.run(12.0);
  World restored = World::restore(p.world.save().value()).value();
  const auto later = p.run(100.0);
  const auto replay = restored.advance(100.0, p.probe()).value();
  ASSERT_TRUE(replay);
  EXPECT_EQ(replay->sensor_user_data(), 77u);
  EXPECT_EQ(replay->visitor(), later.at(0).visitor());
  EXPECT_EQ(replay->senses, later.at(0).senses);
  auto again = Replay::open(p.world.stop_recording().value()).value();
  std::vector<Event> replayed;
  while (!again.finished())
    if (const auto event = again.advance().value()) replayed.push_back(*event);
  ASSERT_EQ(replayed.size(), 2u);
  EXPECT_EQ(replayed[0].sensor_user_data(), 77u);
  EXPECT_EQ(replayed[1].visitor_user_data(), 5u);
}

TEST(SensorEvent, TellsWhichOfTheTwoSensesAtWhichDistance) {
  Playground p;
  p.world.set_sensor(1, {.distances = {5, 2}}).value();
  p.world.set_sensor(2, {.distances = {2, 8}}).value();
  p.add({.radius = 1, .sensor_class = 1, .user_data = 100});
  p.add({.radius = 1, .position = {-60, 0, 0}, .velocity = {10, 0, 0}, .sensor_class = 2, .user_data = 200});
  std::map<double, std::vector<Senses>> reported;
  for (const Event& event : p.run(40.0)) {
    EXPECT_EQ(event.first_user_data, 100u);
    EXPECT_EQ(event.second_user_data, 200u);
    if (!is_of_sensor(event.kind)) {
      EXPECT_EQ(event.senses, Senses::neither);
      EXPECT_EQ(event.sensor(), no_body);
      EXPECT_EQ(event.visitor(), no_body);
      EXPECT_EQ(event.sensor_user_data() + event.visitor_user_data(), 0u);
      continue;
    }
    reported[event.distance].push_back(event.senses);
    EXPECT_EQ(event.sensor(), event.senses == Senses::second ? event.second : event.first);
    EXPECT_EQ(event.visitor(), event.senses == Senses::second ? event.first : event.second);
    EXPECT_EQ(event.sensor_user_data(), event.senses == Senses::second ? 200u : 100u);
  }
  const std::map<double, std::vector<Senses>> expected{{8, {Senses::second, Senses::second}},
                                                       {5, {Senses::first, Senses::first}},
                                                       {2, {Senses::both, Senses::both}}};
  EXPECT_EQ(reported, expected);
}

/// The sensors may have changed in between; the events of one overlap can still be matched.
TEST(SensorEvent, OfALeaveSaysWhatItsEnterSaid) {
  Playground p;
  p.world.set_sensor(1, {.distances = {5}}).value();
  const BodyId watcher = p.add({.radius = 1, .sensor_class = 1});
  const BodyId other = p.add({.radius = 1, .position = {4, 0, 0}});
  const auto entered = p.run(1.0);
  ASSERT_EQ(entered.size(), 1u) << entered;
  EXPECT_EQ(entered[0].sensor(), watcher);
  p.world.change(other, {.sensor_class = 1}).value();
  EXPECT_TRUE(p.run(2.0).empty()) << "they are within that distance already";
  p.world.set_sensor(1, {}).value();
  const auto left = p.run(3.0);
  ASSERT_EQ(left.size(), 1u) << left;
  EXPECT_EQ(left[0].kind, EventKind::sensor_leave);
  EXPECT_EQ(left[0].senses, entered[0].senses);
}

TEST(SensorEvent, OfWallsAndBrokenPromisesHasUserDataToo) {
  Playground p({.box = Box{{0, 0, 0}, {10, 10, 10}}});
  const BodyId ball = p.add({.position = {5, 5, 5}, .velocity = {1, 0, 0}, .user_data = 9});
  const auto wall = p.advance(10.0);
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->kind, EventKind::wall_begin);
  EXPECT_EQ(wall->first_user_data, 9u);
  p.set_position(ball, {5, 5, 5});
  const auto violation = p.advance(100.0);
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation->kind, EventKind::bound_violation);
  EXPECT_EQ(violation->first_user_data, 9u);
}

}  // namespace
}  // namespace kinesphere::zone_test
