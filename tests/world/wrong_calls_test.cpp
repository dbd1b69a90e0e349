// Every call with wrong input: the error names the cause, and the world is unaffected.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "number/infinity.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::wrong_calls_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(WrongWorld, IsRefusedByField) {
  const auto refused = [](ErrorCode code, const std::string& argument, const WorldDefinition& definition) {
    expect_error(World::create(definition), code, argument, "World::create");
  };
  for (const double bad : {nan, infinity, -infinity})
    refused(ErrorCode::not_finite, "contact_tolerance", {.contact_tolerance = bad});
  for (const double bad : {0.0, -0.0, -1e-6, 1e200})
    refused(ErrorCode::out_of_range, "contact_tolerance", {.contact_tolerance = bad});
  refused(ErrorCode::not_finite, "separation_distance", {.separation_distance = infinity});
  for (const double bad : {1e-6, 0.0, -1.0})
    refused(ErrorCode::out_of_range, "separation_distance", {.separation_distance = bad});
  refused(ErrorCode::not_finite, "zeno_interval", {.zeno_interval = nan});
  refused(ErrorCode::out_of_range, "zeno_interval", {.zeno_interval = -1.0});
  refused(ErrorCode::not_finite, "start_time", {.start_time = nan});
  refused(ErrorCode::not_finite, "start_time", {.start_time = -infinity});
  refused(ErrorCode::not_finite, "box", {.box = Box{{nan, 0, 0}, {1, 1, 1}}});
  refused(ErrorCode::not_finite, "box", {.box = Box{{0, 0, 0}, {1, infinity, 1}}});
  refused(ErrorCode::out_of_range, "box", {.box = Box{{0, 0, 0}, {1, 0, 1}}});
  refused(ErrorCode::out_of_range, "box", {.box = Box{{2, 0, 0}, {1, 1, 1}}});
  refused(ErrorCode::out_of_range, "box", {.box = Box{{0, 0, 0}, {1, 1, 1e35}}, .contact_tolerance = 1e20});
}

TEST(WrongWorld, MessagesSayWhatToWrite) {
  expect_error(
      World::create({.box = Box{{0, 0, 0}, {1, 1, 1e12}}}), ErrorCode::out_of_range, "contact_tolerance",
      "World::create: contact_tolerance must be at least 0.45474735088646412 for a box that reaches to "
      "1000000000000 (2^41 tolerances reach no farther), but is 9.9999999999999995e-07");
  EXPECT_TRUE(World::create({.box = Box{{0, 0, 0}, {1, 1, 1e12}}, .contact_tolerance = 0.46}));
  expect_error(
      World::create({.box = Box{{0, 0, 0}, {9, 9, 9}}, .periodic = {true, true, true}, .dimensions = 2}),
      ErrorCode::out_of_range, "periodic",
      "World::create: periodic must be x, y or both in two dimensions, where there is no z, but is x, y "
      "and z");
  expect_error(
      World::create({.periodic = {true, false, true}}), ErrorCode::out_of_range, "periodic",
      "World::create: periodic must be no axis where there is no box to give the period, but is x and z");
}

TEST(WrongBody, IsRefusedByField) {
  World world = World::create({}).value();
  const auto refused = [&](ErrorCode code, const std::string& argument, const BodyDefinition& body) {
    expect_error(world.add(body), code, argument, "add");
    EXPECT_EQ(world.size(), 0u);
  };
  for (const double bad : {nan, infinity, -infinity}) {
    refused(ErrorCode::not_finite, "radius", {.radius = bad});
    refused(ErrorCode::not_finite, "acceleration_limit", {.acceleration_limit = bad});
    refused(ErrorCode::not_finite, "position_error", {.position_error = bad});
    refused(ErrorCode::not_finite, "velocity_error", {.velocity_error = bad});
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 v;
      v[axis] = bad;
      refused(ErrorCode::not_finite, "planned_acceleration", {.planned_acceleration = v});
      refused(ErrorCode::not_finite, "position", {.position = v});
      refused(ErrorCode::not_finite, "velocity", {.velocity = v});
    }
  }
  refused(ErrorCode::out_of_range, "radius", {.radius = -1e-300});
  refused(ErrorCode::out_of_range, "acceleration_limit", {.acceleration_limit = -1.0});
  refused(ErrorCode::out_of_range, "position_error", {.position_error = -1.0});
  refused(ErrorCode::out_of_range, "velocity_error", {.velocity_error = -1.0});
  refused(ErrorCode::out_of_range, "velocity", {.velocity = {1e200, 0, 0}});
}

TEST(WrongBody, LengthsTooLargeForTheToleranceAreRefused) {
  World world = World::create({}).value();
  const double limit = 0x1p41 * 1e-6;
  for (const double sign : {1.0, -1.0}) {
    EXPECT_TRUE(world.add({.position = {0, sign * limit, 0}}));
    expect_error(world.add({.position = {0, sign * std::nextafter(limit, infinity), 0}}),
                 ErrorCode::out_of_range, "position", "add");
  }
  // A radius of that size leaves no bits for the tolerance either.
  expect_error(world.add({.radius = 2.0 * limit}), ErrorCode::out_of_range, "radius", "add");
  expect_error(world.add({.position_error = 2.0 * limit}), ErrorCode::out_of_range, "position_error", "add");
}

TEST(WrongBody, MessageOfARangeNamesTheSideThatWasPassed) {
  World world = World::create({}).value();
  const auto added = world.add({.acceleration_limit = 1e200});
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().code, ErrorCode::out_of_range);
  EXPECT_NE(added.error().message.find("at most"), std::string::npos) << added.error().message;
}

TEST(WrongBody, OutsideTheBoxIsRefused) {
  World world = World::create({.box = Box{{0, 0, 0}, {10, 10, 10}}}).value();
  expect_error(world.add({.position = {5, 5, 10.1}}), ErrorCode::outside_domain, "position", "add");
  expect_error(world.add({.position = {-0.1, 5, 5}}), ErrorCode::outside_domain, "position", "add");
  EXPECT_TRUE(world.add({.position = {0, 5, 10}}));
  World strict = World::create({.box = Box{{0, 0, 0}, {10, 10, 10}}, .allow_overlap = false}).value();
  expect_error(strict.add({.radius = 1, .position = {0.9, 5, 5}}), ErrorCode::outside_domain, "position",
               "add");
  EXPECT_TRUE(strict.add({.radius = 1, .position = {1, 5, 9}}));
}

TEST(WrongBody, OverlapNamesTheOtherBody) {
  World world = World::create({.allow_overlap = false}).value();
  const BodyId first = world.add({.radius = 1}).value();
  expect_error(world.add({.radius = 1, .position = {1.9, 0, 0}}), ErrorCode::overlapping, "position", "add",
               first);
  EXPECT_TRUE(world.add({.radius = 1, .position = {2, 0, 0}})) << "touching is not overlapping";
  world.remove(first).value();
  EXPECT_TRUE(world.add({.radius = 1, .position = {0, 0, 0}})) << "the place is free again";
}

TEST(WrongBody, OverlapIsFoundWithBodiesThatHaveMoved) {
  Playground p({.allow_overlap = false});
  const BodyId source = p.add({.radius = 1, .velocity = {100, 0, 0}});
  p.run(1.0);
  EXPECT_FALSE(p.world.add({.radius = 1, .position = {100.5, 0, 0}}));
  EXPECT_TRUE(p.world.add({.radius = 1, .position = {0, 0, 0}}));
  EXPECT_NEAR(p.state(source).position.x, 100.0, 1e-9);
}

/// Returns the hash of a little scene, with `disturb` called on its world at several stops.
std::uint64_t hash_of_scene(const WorldDefinition& definition,
                            const std::function<void(Playground&)>& disturb) {
  Playground p(definition);
  Random random(7);
  disturb(p);
  p.add({.radius = 0.3, .position = {9.6, 9.6, 9.6}});  // stands still, so that its place is certain
  for (int k = 0; k < 40; ++k) {
    const BodyDefinition body{
        .radius = 0.3,
        .acceleration_limit = 5,
        .position = {1.0 + 2.0 * (k % 5), 1.0 + 2.0 * (k / 5 % 5), 1.0 + 2.0 * (k / 25)},
        .velocity = 3.0 * random.point_in_ball()};
    p.add(body, 4.9 * random.point_in_ball());
  }
  disturb(p);
  for (int stop = 1; stop <= 5; ++stop) {
    int budget = 10;
    p.run(0.2 * stop, [&](const Event& event) {
      if (--budget > 0) disturb(p);
      if (event.kind != EventKind::contact_begin) return;
      p.set_velocity(event.first, p.state(event.first).velocity - event.normal);
      if (budget > 0) disturb(p);
    });
    disturb(p);
    if (stop == 2) p.world.remove(BodyId{3, 0}).value();
    if (stop == 3) p.add({.radius = 0.1, .position = {5, 5, 4.9}, .velocity = {0, 0, -7}});
  }
  EXPECT_GT(p.world.counters().count(EventKind::contact_begin), 2u);
  return p.hash.value();
}

TEST(WrongCalls, LeaveNoTrace) {
  const WorldDefinition definition{.box = Box{{0, 0, 0}, {10, 10, 10}}, .allow_overlap = false};
  const std::uint64_t undisturbed = hash_of_scene(definition, [](Playground&) {});
  const auto bad_calls = [](Playground& p) {
    World& world = p.world;
    const double time = world.time();
    const Counters counters = world.counters();
    const std::vector<BodyId> bodies = world.bodies();
    EXPECT_FALSE(world.add({.radius = -1}));
    EXPECT_FALSE(world.add({.position = {nan, 5, 5}}));
    EXPECT_FALSE(world.add({.position = {50, 5, 5}}));
    if (!bodies.empty()) {
      const Vec3 here = p.state(bodies.front()).position;
      EXPECT_FALSE(world.add({.radius = 1e-3, .position = here}));
      EXPECT_FALSE(world.set_velocity(bodies.front(), {0, nan, 0}));
      EXPECT_FALSE(world.set_velocity(bodies.front(), {0, 1e300, 0}));
    }
    const std::vector<BodyDefinition> last_is_bad{{.radius = 1e-3, .position = {0.1, 0.1, 9.9}},
                                                  {.radius = 1e-3, .position = {0.2, 0.1, 9.9}},
                                                  {.radius = nan, .position = {0.3, 0.1, 9.9}}};
    EXPECT_FALSE(world.add_all(last_is_bad));
    const std::vector<BodyDefinition> overlap_each_other{{.radius = 1e-3, .position = {0.1, 0.1, 9.9}},
                                                         {.radius = 1e-3, .position = {0.2, 0.1, 9.9}},
                                                         {.radius = 1e-3, .position = {0.2, 0.1, 9.9}}};
    EXPECT_FALSE(world.add_all(overlap_each_other));
    EXPECT_FALSE(world.set_velocity({12345, 0}, {}));
    EXPECT_FALSE(world.remove(no_body));
    EXPECT_FALSE(world.body({3, 77}));
    EXPECT_FALSE(world.advance(time - 1e-9, p.probe()));
    EXPECT_FALSE(world.advance(nan, p.probe()));
    EXPECT_FALSE(world.advance(infinity, p.probe()));
    EXPECT_FALSE(world.advance(-infinity, p.probe()));
    EXPECT_EQ(world.time(), time);
    EXPECT_EQ(world.bodies(), bodies);
    EXPECT_EQ(world.counters().probes, counters.probes);
    EXPECT_EQ(world.counters().events, counters.events);
    EXPECT_EQ(world.counters().steps(), counters.steps());
    EXPECT_EQ(world.counters().certificates, counters.certificates);
    EXPECT_TRUE(is_clean(world));
  };
  EXPECT_EQ(hash_of_scene(definition, bad_calls), undisturbed);
}

TEST(WrongCalls, BatchIsAllOrNothing) {
  World world = World::create({.allow_overlap = false}).value();
  const std::vector<BodyDefinition> bad{
      {.position = {0, 0, 0}}, {.position = {5, 0, 0}}, {.position = {0.5, 0, 0}}};
  const auto refused = world.add_all(bad);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::overlapping);
  EXPECT_EQ(refused.error().message.rfind("add_all: bodies[2]", 0), 0u) << refused.error().message;
  EXPECT_EQ(world.size(), 0u);
  EXPECT_TRUE(world.bodies().empty());
  EXPECT_FALSE(world.contains({0, 0}));
  const auto ids = world.add_all(std::vector<BodyDefinition>(bad.begin(), bad.begin() + 2)).value();
  EXPECT_EQ(ids, (std::vector<BodyId>{{0, 0}, {1, 0}})) << "a refused batch uses up no ids";
  EXPECT_TRUE(world.add_all(std::span<const BodyDefinition>{}).value().empty());
}

TEST(WrongCalls, NoRoomForMoreBodiesThanThereAreIds) {
  World world = World::create({}).value();
  const std::size_t most = no_body.index;
  expect_error(world.reserve(most + 1), ErrorCode::out_of_range, "bodies",
               "reserve: bodies must be at most 4294967295, but is 4294967296");
  EXPECT_TRUE(world.reserve(0));
}

TEST(WrongCalls, TimeMayStandStillButNotGoBack) {
  Playground p({.start_time = -3.0});
  p.add({.velocity = {1, 0, 0}});
  EXPECT_FALSE(p.advance(-3.0));
  EXPECT_FALSE(p.advance(-2.0));
  const auto back = p.world.advance(-2.5, p.probe());
  expect_error(back, ErrorCode::time_backwards, "until", "advance");
  EXPECT_EQ(p.world.time(), -2.0);
}

TEST(WrongIds, UnknownAndStaleAreToldApart) {
  World world = World::create({}).value();
  const BodyId id = world.add(BodyDefinition{}).value();
  const BodyId never{7, 0};
  const BodyId too_new{id.index, id.generation + 1};
  for (const BodyId wrong : {never, too_new, no_body}) {
    expect_error(world.remove(wrong), ErrorCode::unknown_body, "body", "remove", wrong);
    expect_error(world.set_velocity(wrong, {}), ErrorCode::unknown_body, "body", "set_velocity", wrong);
    expect_error(world.body(wrong), ErrorCode::unknown_body, "body", "body", wrong);
    EXPECT_FALSE(world.contains(wrong));
  }
  world.remove(id).value();
  // No body has had the next generation of this index yet.
  expect_error(world.remove(too_new), ErrorCode::unknown_body, "body", "remove", too_new);
  const auto stale = [&] {
    expect_error(world.remove(id), ErrorCode::stale_body, "body", "remove", id);
    expect_error(world.set_velocity(id, {1, 0, 0}), ErrorCode::stale_body, "body", "set_velocity", id);
    expect_error(world.body(id), ErrorCode::stale_body, "body", "body", id);
    EXPECT_FALSE(world.contains(id));
  };
  stale();
  const BodyId reused = world.add(BodyDefinition{}).value();
  EXPECT_EQ(reused.index, id.index);
  EXPECT_NE(reused, id);
  EXPECT_TRUE(world.contains(reused));
  stale();
  EXPECT_EQ(world.size(), 1u);
}

}  // namespace
}  // namespace kinesphere::wrong_calls_test
