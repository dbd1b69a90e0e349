// Sensors: each crossing of each distance is reported once, at its time, through all motions and changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "kinesphere/certificates.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::sensor_test {
namespace {

constexpr double eps = 1e-6;  // the default contact tolerance
constexpr SensorClass watchful = 7;

/// A body at rest at the origin warns at 50, with an alarm at 10; the other comes along x.
struct Approach : Playground {
  explicit Approach(double velocity, const BodyDefinition& guard = {.radius = 1, .sensor_class = watchful})
      : rests(add(guard)), comes(add({.radius = 1, .position = {-102, 0, 0}, .velocity = {velocity, 0, 0}})) {
    world.set_sensor(watchful, {.distances = {10, 50}}).value();
  }
  BodyId rests;
  BodyId comes;
};

std::vector<std::tuple<EventKind, double>> crossings(const std::vector<Event>& events) {
  std::vector<std::tuple<EventKind, double>> found;
  for (const Event& event : events) found.emplace_back(event.kind, event.distance);
  return found;
}

TEST(Sensor, WarnsThenAlarmsThenTouchesAndBackAgain) {
  Approach p(10.0);
  const auto events = p.run(40.0);
  using enum EventKind;
  const std::vector<std::tuple<EventKind, double>> expected{{sensor_enter, 50}, {sensor_enter, 10},
                                                            {contact_begin, 0}, {contact_end, 0},
                                                            {sensor_leave, 10}, {sensor_leave, 50}};
  ASSERT_EQ(crossings(events), expected) << events;
  const double times[] = {5.0, 9.0, 10.0, 10.4, 11.4, 15.4};
  for (std::size_t k = 0; k < events.size(); ++k) {
    // Ends come between four and five tolerances beyond the distance.
    EXPECT_NEAR(events[k].time, times[k], 5.001 * eps / 10.0) << events[k];
    EXPECT_NEAR(events[k].gap, events[k].distance, 5.001 * eps);
    EXPECT_EQ(events[k].first, p.rests);
    EXPECT_EQ(events[k].second, p.comes);
  }
  EXPECT_EQ(events[0].first_state.position, Vec3());
  EXPECT_NEAR(events[0].approach_speed, 10.0, 1e-9);
  EXPECT_TRUE(p.world.sensor_overlaps(p.rests).value().empty());
}

TEST(Sensor, WithoutEndsOfContactsStillHasEndsOfItsOwn) {
  Playground p({.contacts = ContactEvents::impacts});
  p.world.set_sensor(0, {.distances = {3}}).value();
  p.add({.radius = 1});
  p.add({.radius = 1, .position = {-50, 0, 0}, .velocity = {10, 0, 0}});
  using enum EventKind;
  const std::vector<std::tuple<EventKind, double>> expected{
      {sensor_enter, 3}, {contact_begin, 0}, {sensor_leave, 3}};
  EXPECT_EQ(crossings(p.run(40.0)), expected);
}

TEST(Sensor, OfEitherBodyCounts) {
  Playground p;
  p.world.set_sensor(1, {.distances = {5, 2}}).value();
  p.world.set_sensor(2, {.distances = {2, 8}}).value();
  p.add({.radius = 1, .sensor_class = 1});
  p.add({.radius = 1, .position = {-60, 0, 0}, .velocity = {10, 0, 0}, .sensor_class = 2});
  std::vector<double> inward;
  for (const Event& event : of_kind(p.run(5.7), EventKind::sensor_enter)) inward.push_back(event.distance);
  EXPECT_EQ(inward, (std::vector<double>{8, 5, 2})) << "a distance that both have is one";
}

TEST(Sensor, SensesOnlyTheCategoriesOfItsMask) {
  Playground p;
  p.world.set_sensor(1, {.distances = {5}, .mask = 2}).value();
  p.add({.radius = 1, .sensor_class = 1});
  const BodyId seen = p.add({.radius = 1, .position = {4, 0, 0}, .filter = {.category = 2}});
  p.add({.radius = 1, .position = {0, 4, 0}});
  const auto events = p.run(1.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].second, seen);
}

TEST(Sensor, ObeysFilters) {
  Playground p;
  p.world.set_sensor(0, {.distances = {5}}).value();
  const BodyId a = p.add({.radius = 1, .filter = {.group = -1}});
  p.add({.radius = 1, .position = {4, 0, 0}, .filter = {.group = -1}});
  EXPECT_TRUE(p.run(1.0).empty());
  p.world.change(a, {.filter = Filter{}}).value();
  EXPECT_EQ(of_kind(p.run(2.0), EventKind::sensor_enter).size(), 1u);
  p.world.change(a, {.filter = Filter{.group = -1}}).value();
  EXPECT_EQ(of_kind(p.run(3.0), EventKind::sensor_leave).size(), 1u);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Sensor, ZoneIsNotTouchedButLooksThrough) {
  Approach p(10.0, {.radius = 3, .solid = false, .sensor_class = watchful});
  p.world.set_sensor(watchful, {.distances = {0}}).value();
  const auto events = p.run(40.0);
  using enum EventKind;
  const std::vector<std::tuple<EventKind, double>> expected{{sensor_enter, 0}, {sensor_leave, 0}};
  ASSERT_EQ(crossings(events), expected) << events;
  EXPECT_NEAR(events[0].time, 9.8, eps);
  EXPECT_EQ(p.world.certificates().safe_until(p.rests, p.comes).value().time,
            std::numeric_limits<double>::infinity());
}

TEST(Sensor, ZoneMayLieOverOthersWhereOverlapsAreNotAllowed) {
  World world = World::create({.allow_overlap = false}).value();
  const BodyId zone = world.add({.radius = 5, .solid = false}).value();
  EXPECT_TRUE(world.add({.radius = 1}));
  ASSERT_TRUE(world.change(zone, {.solid = true})) << "what overlaps begins to touch";
}

TEST(Sensor, EveryWayOutOfAWorldLeavesTheInnerDistanceFirst) {
  using Way = std::function<void(World&, BodyId)>;
  const std::map<std::string, Way> ways{
      {"remove", [](World& world, BodyId id) { world.remove(id).value(); }},
      {"disable", [](World& world, BodyId id) { world.disable(id).value(); }},
      {"teleport",
       [](World& world, BodyId id) {
         world.teleport(id, {{0, 999, 0}, {}}).value();
       }},
      {"filter", [](World& world, BodyId id) { world.change(id, {.filter = Filter{.mask = 0}}).value(); }},
      {"class", [](World& world, BodyId id) { world.change(id, {.sensor_class = 0}).value(); }},
      {"sensor", [](World& world, BodyId) { world.set_sensor(watchful, {}).value(); }},
  };
  for (const auto& [name, leave] : ways) {
    Approach p(10.0);
    p.run(9.5);
    ASSERT_EQ(p.world.sensor_overlaps(p.comes).value(),
              (std::vector<SensorOverlap>{{p.rests, 50}, {p.rests, 10}}));
    leave(p.world, p.rests);
    if (name == "teleport") p.set_position(p.rests, {0, 999, 0});
    const auto events = p.run(9.5);
    using enum EventKind;
    const std::vector<std::tuple<EventKind, double>> expected{{sensor_leave, 10}, {sensor_leave, 50}};
    EXPECT_EQ(crossings(events), expected) << name << events;
    for (const Event& event : events) EXPECT_NEAR(event.gap, 5.0, 1e-9) << name << event;
    EXPECT_TRUE(p.world.sensor_overlaps(p.comes).value().empty()) << name;
    EXPECT_TRUE(is_clean(p.world)) << name;
  }
}

TEST(Sensor, ChangedInMidApproachKeepsWhatStillCounts) {
  Approach p(10.0);
  p.run(9.5);
  p.world.set_sensor(watchful, {.distances = {50, 30, 4}}).value();
  using enum EventKind;
  const std::vector<std::tuple<EventKind, double>> at_once{{sensor_leave, 10}, {sensor_enter, 30}};
  EXPECT_EQ(crossings(p.run(9.5)), at_once);
  EXPECT_TRUE(is_clean(p.world));
  const std::vector<std::tuple<EventKind, double>> later{{sensor_enter, 4}, {contact_begin, 0}};
  EXPECT_EQ(crossings(p.run(10.2)), later);
}

/// What all bodies sense alike is left out of their extents in the core: this one ends that, in three ways.
TEST(Sensor, SensesOneThatComesLaterAndSensesNothing) {
  for (const int way : {0, 1, 2}) {
    SCOPED_TRACE(way);
    Playground p;
    p.world.set_sensor(watchful, {.distances = {4}}).value();
    const BodyId guard = p.add({.radius = 1, .sensor_class = watchful});
    for (int k = 1; k < 20; ++k) p.add({.radius = 1, .position = {0, 20.0 * k, 0}, .sensor_class = watchful});
    BodyDefinition passes{
        .radius = 1, .position = {-20, 5.5, 0}, .velocity = {10, 0, 0}, .sensor_class = watchful};
    if (way == 0) passes.sensor_class = 0;
    EXPECT_TRUE(p.run(1.0).empty());
    const BodyId body = p.add(passes);
    if (way == 1) p.world.change(body, {.sensor_class = SensorClass{0}}).value();
    if (way == 2) {
      // All sense less far, but for the guard.
      p.world.set_sensor(0, {.distances = {4}}).value();
      p.world.change(guard, {.sensor_class = SensorClass{0}}).value();
      p.world.set_sensor(watchful, {.distances = {}}).value();
    }
    const auto events = p.run(1.0 + 4.0);
    // 6 from centre to centre, 5.5 of it on y.
    const double half_chord = std::sqrt(6.0 * 6.0 - 5.5 * 5.5);
    ASSERT_EQ(events.size(), 2u) << events;
    EXPECT_EQ(events[0].kind, EventKind::sensor_enter);
    EXPECT_NEAR(events[0].time, 1.0 + (20.0 - half_chord) / 10.0, 2.0 * eps);
    EXPECT_EQ(events[0].first, guard);
    EXPECT_EQ(events[0].second, body);
    EXPECT_EQ(events[1].kind, EventKind::sensor_leave);
  }
}

TEST(Sensor, TakesBackWhatItsChangeMadeUntrueAtTheSameInstant) {
  Playground p;
  p.world.set_sensor(0, {.distances = {3}}).value();
  p.add({.radius = 1});
  p.add({.radius = 1, .position = {-50, 0, 0}, .velocity = {10, 0, 0}});
  p.add({.radius = 1, .position = {0, 500, 0}});
  p.add({.radius = 1, .position = {-50, 500, 0}, .velocity = {10, 0, 0}});
  ASSERT_TRUE(p.advance(10.0));  // the first of two at one instant
  p.world.set_sensor(0, {}).value();
  const auto events = p.run(4.51);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::sensor_leave);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Sensor, GoneLeavesNoContactUnwatched) {
  Playground p;
  p.world.set_sensor(watchful, {.distances = {2}}).value();
  p.add({.radius = 1});
  p.add({.radius = 1, .position = {1, 0, 0}, .velocity = {1e-3, 0, 0}});
  ASSERT_EQ(p.run(0.0).size(), 1u) << "they touch";
  EXPECT_TRUE(is_clean(p.world));
  p.world.set_sensor(watchful, {}).value();
  EXPECT_TRUE(is_clean(p.world));
  EXPECT_EQ(p.run(2000.0).size(), 1u) << "they part";
}

TEST(Sensor, OfOneCentimetreSeesTenThousandBullets) {
  Playground p;
  p.world.set_sensor(watchful, {.distances = {0}}).value();
  const BodyId sensor = p.add({.radius = 0.005, .solid = false, .sensor_class = watchful});
  Random random(2026);
  const int bullets = 10000;
  std::vector<Vec3> aims;
  for (int k = 0; k < bullets; ++k) {
    const Vec3 inward = random.unit_vector();
    // Aimed at the surface of the sensor, not at its centre, with 0 to 10 s of flight.
    const Vec3 start = inward * (-10000.0 * random.uniform() - 1.0) + random.point_in_ball() * 0.005;
    p.add({.radius = 0.0,
           .position = start,
           .velocity = inward * 1000.0,
           .filter = {.category = 2, .mask = 1}});
  }
  std::map<BodyId, int> seen;
  for (const Event& event : p.run(11.0)) {
    ASSERT_EQ(event.first, sensor);
    if (event.kind == EventKind::sensor_enter) ++seen[event.second];
  }
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(bullets));
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](const auto& s) { return s.second == 1; }));
  EXPECT_EQ(p.world.counters().count(EventKind::sensor_leave), static_cast<std::uint64_t>(bullets));
}

TEST(Sensor, RefusesDistancesThatAreNone) {
  World world = World::create({}).value();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_error(world.set_sensor(1, {.distances = {1, nan}}), ErrorCode::not_finite, "sensor", "set_sensor");
  expect_error(world.set_sensor(1, {.distances = {-1}}), ErrorCode::out_of_range, "sensor", "set_sensor");
  expect_error(world.set_sensor(1, {.distances = {1e9}}), ErrorCode::out_of_range, "sensor", "set_sensor");
  EXPECT_TRUE(world.sensor(1).distances.empty());
  const BodyId never{5, 0};
  expect_error(world.change(never, {.sensor_class = 1}), ErrorCode::unknown_body, "body", "change", never);
  expect_error(world.change(never, {.solid = true}), ErrorCode::unknown_body, "body", "change", never);
  expect_error(world.touching(never), ErrorCode::unknown_body, "body", "touching", never);
  expect_error(world.sensor_overlaps(never), ErrorCode::unknown_body, "body", "sensor_overlaps", never);
  world.add({}).value();
  auto calls_back = [&](std::span<const BodyId> ids, double, std::span<State> states) {
    for (State& state : states) state = {};
    const auto busy = ErrorCode::probe_in_progress;
    expect_error(world.set_sensor(1, {}), busy, "probe", "set_sensor");
    expect_error(world.change(ids[0], {.sensor_class = 1}), busy, "probe", "change");
    expect_error(world.change(ids[0], {.solid = false}), busy, "probe", "change");
  };
  world.advance(1.0, calls_back).value();
  world.set_velocity({0, 0}, {}).value();
  world.advance(2.0, calls_back).value();
}

/// A crowd under constant change, with the truth of every pair at every stop.
class SensingCrowd : public testing::TestWithParam<std::uint64_t> {
 protected:
  static constexpr double size = 12.0;

  SensingCrowd()
      : p({.box = Box{{0, 0, 0}, {size, size, size}},
           .contacts = GetParam() % 2 == 0 ? ContactEvents::impacts : ContactEvents::begin_and_end}),
        random(GetParam()) {}

  Vec3 anywhere() { return {size * random.uniform(), size * random.uniform(), size * random.uniform()}; }
  Filter some_filter() { return {.category = 1 + random.bits() % 3, .mask = 1 + random.bits() % 3}; }
  SensorClass some_class() { return static_cast<SensorClass>(random.bits() % 3); }

  void add() {
    const double limit = 5.0 * random.uniform();
    BodyDefinition body{.radius = 0.4 * random.uniform(),
                        .acceleration_limit = limit,
                        .position = anywhere(),
                        .velocity = 4.0 * random.point_in_ball()};
    body.solid = random.uniform() < 0.7;
    body.sensor_class = some_class();
    if (random.uniform() < 0.3) body.filter = some_filter();
    alive.push_back(p.add(body, 0.999 * limit * random.point_in_ball()));
  }

  void change_something() {
    const BodyId id = alive[random.bits() % alive.size()];
    const BodyView view = p.world.body(id).value();
    switch (random.bits() % 9) {
      case 0: {
        Sensor sensor{.distances = {}, .mask = 1 + random.bits() % 3};
        while (random.uniform() < 0.7)
          sensor.distances.push_back(0.5 * static_cast<double>(random.bits() % 6));
        return p.world.set_sensor(some_class(), sensor).value();
      }
      case 1:
        return p.world.change(id, {.sensor_class = some_class()}).value();
      case 2:
        return p.world.change(id, {.solid = random.uniform() < 0.5}).value();
      case 3:
        return p.world.change(id, {.filter = some_filter()}).value();
      case 4:
        if (view.enabled) return p.world.disable(id).value();
        p.set_position(id, anywhere());
        return p.world.enable(id, p.state(id)).value();
      case 5:
        if (!view.enabled) return;
        p.set_position(id, anywhere());
        return p.world.teleport(id, p.state(id)).value();
      case 6:
        return p.world.change(id, {.radius = 0.5 * random.uniform()}).value();
      case 7:
        p.world.remove(id).value();
        std::erase(alive, id);
        return add();
      default:
        if (view.enabled) p.set_velocity(id, 4.0 * random.point_in_ball());
    }
  }

  void send_back() {
    for (const BodyId id : alive) {
      const Vec3 out = p.state(id).position - Vec3{0.5, 0.5, 0.5} * size;
      if (p.world.body(id).value().enabled && norm(out) > size && dot(out, p.state(id).velocity) > 0.0)
        p.set_velocity(id, out * (-0.3));
    }
  }

  void note(const Event& event) {
    const auto overlap = std::tuple(event.first, event.second, event.distance);
    if (event.kind == EventKind::sensor_enter) {
      ASSERT_TRUE(within.insert(overlap).second) << "twice: " << event;
      ASSERT_LE(event.gap, event.distance + eps) << event;
    } else if (event.kind == EventKind::sensor_leave) {
      ASSERT_EQ(within.erase(overlap), 1u) << "without having entered: " << event;
    }
  }

  std::set<double> distances(const BodyDefinition& a, const BodyDefinition& b) const {
    std::set<double> all;
    for (const auto& [watcher, watched] : {std::pair(a, b), std::pair(b, a)}) {
      const Sensor& sensor = p.world.sensor(watcher.sensor_class);
      if (sensor.mask & watched.filter.category) all.insert(sensor.distances.begin(), sensor.distances.end());
    }
    return all;
  }

  void compare_with_truth() {
    ASSERT_TRUE(is_clean(p.world));
    std::size_t expected_at_most = 0;
    for (std::size_t i = 0; i < alive.size(); ++i) {
      for (std::size_t j = i + 1; j < alive.size(); ++j) {
        const auto [a, b] = std::minmax(alive[i], alive[j]);
        const BodyView first = p.world.body(a).value();
        const BodyView second = p.world.body(b).value();
        const bool meet =
            first.enabled && second.enabled && passes(first.definition.filter, second.definition.filter);
        if (!meet) continue;
        for (const double distance : distances(first.definition, second.definition)) {
          if (within.contains({a, b, distance})) {
            ++expected_at_most;
            ASSERT_LE(p.gap(a, b), distance + 5.001 * eps) << a << " " << b << " at " << p.world.time();
          } else {
            ASSERT_GE(p.gap(a, b), distance - 1.001 * eps) << a << " " << b << " at " << p.world.time();
          }
        }
      }
    }
    ASSERT_EQ(within.size(), expected_at_most) << "within a distance that nobody senses";
    std::size_t reported = 0;
    for (const BodyId id : alive) reported += p.world.sensor_overlaps(id).value().size();
    ASSERT_EQ(reported, 2 * within.size());
  }

  Playground p;
  Random random;
  std::vector<BodyId> alive;
  std::set<std::tuple<BodyId, BodyId, double>> within;
};

TEST_P(SensingCrowd, AgreesWithTheTruthAtEveryStop) {
  p.world.set_sensor(1, {.distances = {1.0}}).value();
  p.world.set_sensor(2, {.distances = {2.5, 0.5, 0.0}, .mask = 2}).value();
  for (int k = 0; k < 30; ++k) add();
  std::size_t events = 0;
  for (int stop = 1; stop <= 150; ++stop) {
    while (const auto event = p.advance(0.02 * stop)) {
      ASSERT_LT(++events, 100000u);
      ASSERT_NO_FATAL_FAILURE(note(*event)) << "seed " << GetParam();
      if (random.uniform() < 0.02) change_something();
      if (random.uniform() < 0.02) p.world = World::restore(p.world.save().value()).value();
    }
    ASSERT_NO_FATAL_FAILURE(compare_with_truth()) << "seed " << GetParam();
    for (int k = 0; k < 2; ++k) change_something();
    send_back();
  }
  EXPECT_GT(events, 100u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SensingCrowd, testing::Range<std::uint64_t>(1, 9));

}  // namespace
}  // namespace kinesphere::sensor_test
