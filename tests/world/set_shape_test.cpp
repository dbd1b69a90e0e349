// Static bodies and zones that get another shape: events report true changes only.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "kinesphere/recording.hpp"
#include "support/expect_error.hpp"
#include "surroundings.hpp"

namespace kinesphere::set_shape_test {
namespace {

/// Returns the events at the present time.
std::vector<Event> now(Playground& p) { return p.run(p.world.time()); }

TEST(SetShape, OfAZoneAroundABodyInsideReportsNothing) {
  Playground p;
  const BodyId unit = p.add({.radius = 1, .acceleration_limit = 2, .position = {5, 5, 5}}, Vec3{});
  const BodyId zone = p.world.add_zone(Box{{0, 0, 0}, {10, 10, 10}}).value();
  ASSERT_EQ(p.run(1.0).size(), 1u);
  double time = 1.0;
  for (const Shape& around : std::initializer_list<Shape>{
           Box{{0, 0, 0}, {12, 12, 12}}, Box{{-3, 2, 4}, {6, 8, 9}}, Ball{{4, 5, 5}, 3.0},
           HalfSpace{{0, 0, 1}, 100.0}, Box{{5, 5, 5}, {5, 5, 5}}}) {
    p.world.set_shape(zone, around).value();
    EXPECT_EQ(p.world.body(zone).value().shape.index(), around.index());
    const auto events = p.run(time += 0.25);
    EXPECT_TRUE(events.empty()) << events;
    EXPECT_TRUE(is_clean(p.world));
  }
  p.world.set_shape(zone, Ball{{20, 5, 5}, 3.0}).value();
  auto events = now(p);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::sensor_leave);
  EXPECT_EQ(events[0].partner_of(zone), unit);
  EXPECT_TRUE(events[0].is_sensed_by(zone));
  p.world.set_shape(zone, Ball{{8, 5, 5}, 3.0}).value();
  events = now(p);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::sensor_enter);
  EXPECT_EQ(events[0].second_state.position, (Vec3{8, 5, 5}));
  EXPECT_TRUE(is_clean(p.world));
}

TEST(SetShape, OfAFloorKeepsAndEndsAndBeginsContacts) {
  Surroundings p;
  const BodyId still = p.add({.radius = 1, .position = {0, 0, 1}});
  const BodyId beside = p.add({.radius = 1, .position = {10, 0, 1}});
  const BodyId above = p.add({.radius = 1, .position = {0, 0, 5}});
  const BodyId floor = p.place(Box{{-20, -20, -1}, {20, 20, 0}});
  ASSERT_EQ(p.run(1.0).size(), 2u);
  p.world.set_shape(floor, Box{{-5, -5, -1}, {5, 5, 0}}).value();
  auto events = now(p);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_end);
  EXPECT_EQ(events[0].partner_of(floor), beside);
  EXPECT_NEAR(events[0].gap, 0.0, 1e-12) << "as it was before the change";
  EXPECT_EQ(p.world.touching(floor).value(), std::vector{still});
  p.world.set_shape(floor, Box{{-5, -5, -1}, {5, 5, 4}}).value();
  events = now(p);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_begin);
  EXPECT_EQ(events[0].partner_of(floor), above);
  EXPECT_TRUE(is_clean(p.world));
}

/// Which bodies are linked before and after a change, by exact distances.
struct Links {
  std::set<BodyId> certain, possible;
};

Links links_of(const Surroundings& p, const std::vector<BodyId>& balls, const Shape& shape) {
  const WorldDefinition& world = p.world.definition();
  Links links;
  for (const BodyId ball : balls) {
    const double gap = distance(shape, p.state(ball).position) - p.radius(ball);
    if (gap < world.contact_tolerance) links.certain.insert(ball);
    if (gap < 4.0 * world.contact_tolerance) links.possible.insert(ball);
  }
  return links;
}

Shape random_shape(Random& random) {
  const auto point = [&] { return random.uniform(0.0, 4.0) * random.point_in_ball(); };
  switch (random.bits() % 4) {
    case 0:
      return Ball{point(), random.uniform(0.0, 3.0)};
    case 1:
      return HalfSpace{random.unit_vector(), random.uniform(-3.0, 3.0)};
    case 2: {
      const Vec3 a = point(), b = point();
      return Box{{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                 {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
    }
    default:
      return Triangle{point(), point() + Vec3{5, 0, 0}, point() + Vec3{0, 5, 0}};
  }
}

/// Zones and obstacles jump among bodies whose last reports are old. Each change reports exactly the links
/// that exact distances begin and end, also in a restored world.
TEST(SetShape, AmongMovingBodiesReportsExactlyTheTrueChanges) {
  for (const bool is_zone : {true, false}) {
    Random random(is_zone ? 41 : 42);
    Surroundings p({.contact_tolerance = 1e-3});
    std::vector<BodyId> balls;
    for (int k = 0; k < 60; ++k) {
      const Filter alone{.category = 2, .mask = 1};
      balls.push_back(p.add({.radius = random.uniform(0.0, 0.3),
                             .acceleration_limit = 1.0,
                             .position = 4.0 * random.point_in_ball(),
                             .velocity = 0.5 * random.point_in_ball(),
                             .filter = alone},
                            0.4 * random.point_in_ball()));
    }
    Shape shape = random_shape(random);
    const BodyId changed = is_zone ? p.world.add_zone(shape).value() : p.place(shape);
    const EventKind begins = is_zone ? EventKind::sensor_enter : EventKind::contact_begin;
    const auto linked = [&] {
      std::set<BodyId> found;
      if (!is_zone) {
        for (const BodyId id : p.world.touching(changed).value()) found.insert(id);
      } else {
        for (const SensorOverlap& overlap : p.world.sensor_overlaps(changed).value())
          found.insert(overlap.body);
      }
      return found;
    };
    std::size_t kept = 0, events_seen = 0;
    for (int round = 1; round <= 80; ++round) {
      p.run(0.05 * round);
      const std::set<BodyId> before = linked();
      shape = random_shape(random);
      p.world.set_shape(changed, shape).value();
      if (round % 3 == 0) p.world = World::restore(p.world.save().value()).value();
      const auto events = now(p);
      events_seen += events.size();
      std::set<BodyId> expected = before;
      for (const Event& event : events) {
        if (event.already_touching) continue;  // it approaches the shape anew, of which there is another side
        const BodyId ball = event.partner_of(changed);
        if (event.kind == begins)
          EXPECT_TRUE(expected.insert(ball).second) << event;
        else
          EXPECT_EQ(expected.erase(ball), 1u) << event;
        EXPECT_TRUE((event.kind == begins) != before.contains(ball)) << "no leave and enter: " << event;
      }
      EXPECT_EQ(linked(), expected);
      const Links truth = links_of(p, balls, shape);
      EXPECT_TRUE(
          std::includes(expected.begin(), expected.end(), truth.certain.begin(), truth.certain.end()));
      EXPECT_TRUE(
          std::includes(truth.possible.begin(), truth.possible.end(), expected.begin(), expected.end()));
      kept += static_cast<std::size_t>(
          std::count_if(before.begin(), before.end(), [&](BodyId id) { return expected.contains(id); }));
      ASSERT_TRUE(is_clean(p.world)) << "round " << round;
    }
    EXPECT_GT(kept, 50u);
    EXPECT_GT(events_seen, 500u);
  }
}

TEST(SetShape, IsReplayedAndClonedAndKeptWhileDisabled) {
  Playground p;
  p.world.start_recording().value();
  p.add({.radius = 1, .velocity = {1, 0, 0}});
  const BodyId zone = p.world.add_zone(Ball{{10, 0, 0}, 1.0}).value();
  p.run(1.0);
  p.world.set_shape(zone, Ball{{5, 0, 0}, 1.0}).value();
  World clone = p.world.clone().value();
  p.run(4.0);
  p.world.disable(zone).value();
  p.world.set_shape(zone, Box{{8, -1, -1}, {9, 1, 1}}).value();
  EXPECT_TRUE(p.run(5.0).size() == 1);
  p.world.enable(zone, {}).value();
  const auto events = p.run(20.0);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_NEAR(events[0].time, 7.0, 1e-5);
  EXPECT_NEAR(events[1].time, 10.0, 1e-5);
  EXPECT_NEAR(clone.advance(20.0, p.probe()).value()->time, 3.0, 1e-5);
  const auto recording = p.world.stop_recording().value();
  Replay replay = Replay::open(recording).value();
  EventHash hash;
  while (!replay.finished())
    if (const auto event = replay.advance().value()) hash.add(*event);
  EXPECT_EQ(hash.value(), p.hash.value());
}

TEST(SetShape, OfABodyUnderASleeperWakesIt) {
  Surroundings p;
  const BodyId floor = p.place(HalfSpace{{0, 0, 1}, 0.0});
  const BodyId ball = p.add({.radius = 1, .position = {0, 0, 1}});
  p.run(1.0);
  p.world.sleep(ball).value();
  p.run(2.0);
  p.world.set_shape(floor, HalfSpace{{0, 0, 1}, -1.0}).value();
  const auto events = now(p);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(of_kind(events, EventKind::woke).size(), 1u);
  EXPECT_EQ(of_kind(events, EventKind::contact_end).size(), 1u);
}

TEST(SetShape, IsRefusedByName) {
  Playground p({.allow_overlap = false});
  const BodyId ball = p.add({.radius = 1, .position = {0, 0, 5}});
  const BodyId floor = p.world.add_static({.shape = HalfSpace{{0, 0, 1}, 0.0}}).value();
  const BodyId zone = p.world.add_zone(Ball{{0, 0, 5}, 1.0}).value();
  expect_error(p.world.set_shape(ball, Ball{{}, 2.0}), ErrorCode::unsupported, "body", "set_shape: body",
               ball);
  expect_error(p.world.set_shape(floor, Ball{{}, -2.0}), ErrorCode::out_of_range, "radius", "set_shape:");
  expect_error(p.world.set_shape(floor, HalfSpace{{0, 0, 2}, 0.0}), ErrorCode::out_of_range, "shape",
               "set_shape:");
  expect_error(p.world.set_shape(floor, HalfSpace{{0, 0, 1}, 5.0}), ErrorCode::overlapping, "shape",
               "set_shape: shape must not overlap", ball);
  p.world.set_shape(zone, Ball{{0, 0, 5}, 3.0}).value();
  p.world.set_shape(floor, HalfSpace{{0, 0, 1}, 4.0}).value();
  for (const auto& refused : {p.world.change(zone, {.radius = 3.0}), p.world.teleport(zone, {})}) {
    expect_error(refused, ErrorCode::static_body, "body", "", zone);
    EXPECT_NE(refused.error().message.find("set_shape() changes it"), std::string::npos);
  }
  p.world.remove(zone).value();
  expect_error(p.world.set_shape(zone, Ball{}), ErrorCode::stale_body, "body", "set_shape:", zone);
  Playground repeating({.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {true, true, true}});
  const BodyId post = repeating.world.add_static({.shape = Ball{{1, 1, 1}, 1.0}}).value();
  expect_error(repeating.world.set_shape(post, Box{{0, 0, 0}, {1, 1, 1}}), ErrorCode::unsupported, "shape",
               "set_shape:");
  repeating.world.set_shape(post, Ball{{12, 1, 1}, 0.5}).value();
  EXPECT_EQ(std::get<Ball>(repeating.world.body(post).value().shape).centre, (Vec3{2, 1, 1}));
  repeating.run(1.0);
  EXPECT_TRUE(is_clean(repeating.world));
}

}  // namespace
}  // namespace kinesphere::set_shape_test
