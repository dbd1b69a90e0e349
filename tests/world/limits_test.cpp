// The limits of kinesphere/limits.hpp: a value at a limit is accepted and works, a value beyond it is
// refused; within them contacts are found at all sizes, speeds and times.
#include "kinesphere/limits.hpp"
#include "kinesphere/queries.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "number/infinity.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::limits_test {
namespace {

constexpr double tolerance = 1e-6;
constexpr double largest_length = limits::largest_length * tolerance;

/// One number that a call takes.
struct Limit {
  std::string argument;
  double value;
  std::string call;
  /// Passes the number to a world with one body.
  std::function<Result<void>(World&, BodyId, double)> take;
  bool names_the_body = true;
};

template <class Value>
Result<void> without_value(const Result<Value>& result) {
  return result ? Result<void>() : Result<void>(result.error());
}

std::vector<Limit> limits_of_a_world() {
  const auto add = [](auto set) {
    return [set](World& world, BodyId, double value) {
      BodyDefinition body;
      set(body, value);
      return without_value(world.add(body));
    };
  };
  const auto promise = [](auto set) {
    return [set](World& world, BodyId id, double value) {
      MotionLimits changed;
      set(changed, value);
      return world.change(id, {.motion_limits = changed});
    };
  };
  const auto answer = [](auto set) {
    return [set](World& world, BodyId id, double value) {
      // The body has to be probed at once.
      const auto rests = [](auto, double, std::span<State> states) { states[0] = {}; };
      (void)world.advance(world.time() + 1e-3, rests).value();
      world.set_velocity(id, {}).value();
      const double until = world.time() + 1e-3;
      return without_value(world.advance(until, [&](auto, double, std::span<State> states) {
        states[0] = {};
        set(states[0], value);
      }));
    };
  };
  const auto create = [](auto set) {
    return [set](World&, BodyId, double value) {
      WorldDefinition definition{.contact_tolerance = tolerance};
      set(definition, value);
      return without_value(World::create(definition));
    };
  };
  return {
      {"start_time", limits::largest_time, "World::create",
       create([](WorldDefinition& d, double v) { d.start_time = v; }), false},
      {"start_time", -limits::largest_time, "World::create",
       create([](WorldDefinition& d, double v) { d.start_time = v; }), false},
      {"contact_tolerance", limits::largest_contact_tolerance, "World::create",
       create([](WorldDefinition& d, double v) { d.contact_tolerance = v; }), false},
      {"separation_distance", largest_length, "World::create",
       create([](WorldDefinition& d, double v) { d.separation_distance = v; }), false},
      {"radius", largest_length, "add", add([](BodyDefinition& b, double v) { b.radius = v; }), false},
      {"position", -largest_length, "add", add([](BodyDefinition& b, double v) { b.position.z = v; }), false},
      {"position_error", largest_length, "add",
       add([](BodyDefinition& b, double v) { b.position_error = v; }), false},
      {"velocity", limits::largest_speed, "add", add([](BodyDefinition& b, double v) { b.velocity.y = v; }),
       false},
      {"velocity_error", limits::largest_speed, "add",
       add([](BodyDefinition& b, double v) { b.velocity_error = v; }), false},
      {"acceleration_limit", limits::largest_acceleration, "add",
       add([](BodyDefinition& b, double v) { b.acceleration_limit = v; }), false},
      {"planned_acceleration", -limits::largest_acceleration, "add",
       add([](BodyDefinition& b, double v) { b.planned_acceleration.x = v; }), false},
      {"radius", largest_length, "change",
       [](World& world, BodyId id, double value) { return world.change(id, {.radius = value}); }},
      {"velocity", -limits::largest_speed, "set_velocity",
       [](World& world, BodyId id, double value) {
         return world.set_velocity(id, {0, 0, value});
       }},
      {"position", largest_length, "teleport",
       [](World& world, BodyId id, double value) {
         return world.teleport(id, {{value, 0, 0}, {}});
       }},
      {"velocity", limits::largest_speed, "teleport",
       [](World& world, BodyId id, double value) {
         return world.teleport(id, {{}, {value, 0, 0}});
       }},
      {"acceleration_limit", limits::largest_acceleration, "change",
       promise([](MotionLimits& p, double v) { p.acceleration_limit = v; })},
      {"planned_acceleration", limits::largest_acceleration, "change",
       promise([](MotionLimits& p, double v) { p.planned_acceleration.y = v; })},
      {"position_error", largest_length, "change",
       promise([](MotionLimits& p, double v) { p.position_error = v; })},
      {"velocity_error", limits::largest_speed, "change",
       promise([](MotionLimits& p, double v) { p.velocity_error = v; })},
      {"position", largest_length, "advance", answer([](State& s, double v) { s.position.y = v; })},
      {"velocity", -limits::largest_speed, "advance", answer([](State& s, double v) { s.velocity.y = v; })},
      {"until", limits::largest_time, "advance",
       [](World& world, BodyId, double value) {
         return without_value(
             world.advance(value, [](auto, double, std::span<State> states) { states[0] = {}; }));
       },
       false},
      {"sensor", largest_length, "set_sensor",
       [](World& world, BodyId, double value) { return world.set_sensor(1, {.distances = {value}}); }, false},
      {"shape", largest_length, "add_static",
       [](World& world, BodyId, double value) {
         return without_value(world.add_static({.shape = Ball{{0, value, 0}, 1.0}}));
       },
       false},
      {"centre", largest_length, "overlapping",
       [](World& world, BodyId, double value) {
         return without_value(world.queries().overlapping({value, 0, 0}, 1.0));
       },
       false},
      {"radius", limits::largest_query_length * tolerance, "overlapping",
       [](World& world, BodyId, double value) {
         return without_value(world.queries().overlapping({}, value));
       },
       false},
      {"length", limits::largest_query_length * tolerance, "ray_cast",
       [](World& world, BodyId, double value) {
         return without_value(world.queries().ray_cast({}, {1, 0, 0}, value));
       },
       false},
      {"direction", limits::largest_direction, "ray_cast",
       [](World& world, BodyId, double value) {
         return without_value(world.queries().ray_cast({}, {0, value, 0}, 1.0));
       },
       false},
  };
}

World world_with_a_body(BodyId& id) {
  World world = World::create({.contact_tolerance = tolerance}).value();
  id = world.add({.position = {0, 0, 0}}).value();
  return world;
}

TEST(Limits, WhatLiesAtALimitIsTaken) {
  for (const Limit& limit : limits_of_a_world()) {
    BodyId id;
    World world = world_with_a_body(id);
    const auto taken = limit.take(world, id, limit.value);
    EXPECT_TRUE(taken) << limit.call << ", " << limit.argument << ": " << taken.error().message;
    EXPECT_TRUE(is_clean(world)) << limit.call << ", " << limit.argument;
  }
}

TEST(Limits, WhatLiesBeyondALimitIsRefusedByName) {
  for (const Limit& limit : limits_of_a_world())
    for (const double farther : {std::nextafter(limit.value, std::copysign(infinity, limit.value)),
                                 std::copysign(std::numeric_limits<double>::max(), limit.value)}) {
      BodyId id;
      World world = world_with_a_body(id);
      SCOPED_TRACE(testing::Message() << limit.call << ", " << limit.argument << " " << farther);
      expect_error(limit.take(world, id, farther), ErrorCode::out_of_range, limit.argument, limit.call,
                   limit.names_the_body ? id : no_body);
      EXPECT_TRUE(is_clean(world));
    }
}

TEST(Limits, ABoxMayReachAsFarAsItsToleranceAllows) {
  const auto with = [](double reach) {
    return World::create({.box = Box{{std::min(reach, 0.0), 0, 0}, {1, std::max(reach, 1.0), 1}}});
  };
  for (const double limit : {largest_length, -largest_length}) {
    EXPECT_TRUE(with(limit));
    expect_error(with(std::nextafter(limit, 2 * limit)), ErrorCode::out_of_range, "contact_tolerance",
                 "World::create");
    expect_error(with(std::copysign(std::numeric_limits<double>::max(), limit)), ErrorCode::out_of_range,
                 "box", "World::create");
  }
}

TEST(Limits, TheLeastToleranceIsTakenAndNoSmallerOne) {
  const auto with = [](double value) { return World::create({.contact_tolerance = value}); };
  EXPECT_TRUE(with(limits::least_contact_tolerance));
  for (const double smaller : {std::nextafter(limits::least_contact_tolerance, 0.0), 1e-90, 5e-324})
    expect_error(with(smaller), ErrorCode::out_of_range, "contact_tolerance", "World::create");
}

/// Two bodies, `distance` apart, fly towards each other and pass through each other.
void expect_one_contact(double unit, double radius, double distance, double speed, double start_time = 0.0) {
  SCOPED_TRACE(testing::Message() << "unit " << unit << ", radius " << radius << ", distance " << distance
                                  << ", speed " << speed << ", start " << start_time);
  Playground p({.contact_tolerance = tolerance * unit, .start_time = start_time});
  const Vec3 place{0.5 * distance * unit, 0, 0};
  const Vec3 velocity{speed, 0, 0};
  p.add({.radius = radius * unit, .position = -place, .velocity = velocity});
  p.add({.radius = radius * unit, .position = place, .velocity = -velocity});
  const double until = start_time + distance * unit / speed;
  const auto events = p.run(
      until,
      [&](const Event& event) {
        EXPECT_LE(std::abs(p.gap(event.first, event.second)),
                  (event.kind == EventKind::contact_begin ? 1.0 : 5.0) * tolerance * unit)
            << event;
        EXPECT_TRUE(is_clean(p.world));
      },
      10);
  EXPECT_EQ(of_kind(events, EventKind::contact_begin).size(), 1u);
  EXPECT_EQ(of_kind(events, EventKind::contact_end).size(), 1u);
  EXPECT_EQ(events.size(), 2u);
}

TEST(Limits, AtAllSpeedsContactsAreFound) {
  for (const double speed : {1e-12, 1.0, 1e9, 1e17, 1e18, 1e19, 2e19, 5e19, 1e20, 1e22, 1e38, 1e50, 1e99})
    for (const double radius : {1e-2, 1e-3, 1e-4, 1e-5}) expect_one_contact(1.0, radius, 0.1, speed);
  expect_one_contact(1.0, 1e-3, 0.1, limits::largest_speed);
}

TEST(Limits, AtAllSizesContactsAreFound) {
  for (const double unit : {1e-23, 1e-20, 1e-10, 1e10, 1e20, 1e26})
    for (const double duration : {1e-20, 1.0, 1e20})
      for (const double radius : {1e-3, 1.0, 1e3})
        expect_one_contact(unit, radius, 10.0 * radius, 10.0 * radius * unit / duration);
}

/// Bodies at rest, up to the largest time.
TEST(Limits, TimeReachesItsLimitInAFewSteps) {
  for (const bool repeats : {false, true}) {
    Playground p({.box = Box{{-10, -10, -10}, {10, 10, 10}},
                  .periodic = {repeats, repeats, repeats},
                  .start_time = -limits::largest_time});
    for (const double x : {-3.0, 0.0, 3.0}) p.add({.radius = 1.0, .position = {x, 0, 0}});
    p.add({.radius = 1.0, .position = {0, 5, 0}, .velocity = {0, 0, 1e-60}});
    EXPECT_TRUE(p.run(limits::largest_time).empty());
    EXPECT_EQ(p.world.time(), limits::largest_time);
    EXPECT_LT(p.world.counters().probes, 100u);
    EXPECT_TRUE(is_clean(p.world));
    expect_error(p.world.advance(std::numeric_limits<double>::max(), p.probe()), ErrorCode::out_of_range,
                 "until", "advance");
  }
}

/// Bodies that fly far within one unit in the last place of the time: no event can be exact, but time must go
/// on.
TEST(Limits, WhereTimesAreTooCoarseForTheBodiesTimeGoesOn) {
  for (const bool repeats : {false, true})
    for (const double start : {1e15, -1e17, 1e29}) {
      const double step = std::nextafter(std::abs(start), infinity) - std::abs(start);
      Playground p({.box = Box{{-10, -10, -10}, {10, 10, 10}},
                    .periodic = {repeats, repeats, repeats},
                    .start_time = start});
      const double speed = repeats ? 1.0 : 2.0 / step;
      if (repeats)
        p.distort = [](BodyId, double, State& reported) {
          reported.position.x -= 20.0 * std::floor((reported.position.x + 10.0) / 20.0);
        };
      p.add({.radius = 1.0, .position = {-5, 0, 0}, .velocity = {speed, 0, 0}});
      p.add({.radius = 1.0, .position = {5, 0, 0}, .velocity = {-speed, 0, 0}});
      p.add({.radius = 0.1, .acceleration_limit = 0.01 / step / step, .position = {0, 5, 0}});
      for (int k = 1; k <= 3; ++k) (void)p.run(start + k * step, {}, 1000);
      EXPECT_EQ(p.world.time(), start + 3 * step);
    }
}

}  // namespace
}  // namespace kinesphere::limits_test
