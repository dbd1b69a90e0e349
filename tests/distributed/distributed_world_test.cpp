// A distributed world has the events of one world: each to the last bit, in order, with an equal number of
// reports, for any number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "distributed/one_world.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/random.hpp"
#include "simulation/oracle/comparison.hpp"
#include "simulation/scene/make_scene.hpp"
#include "support/differential_scenes.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::distributed_world_test {
namespace {

SceneParameters parameters_of(const std::string& name, std::uint32_t bodies, double seconds) {
  SceneParameters parameters;
  for (const SceneParameters& built_in : built_in_scenes())
    if (built_in.name == name) parameters = built_in;
  if (parameters.packing <= 0.0) {
    // Keeps the density of the original scene.
    const double factor = std::cbrt(static_cast<double>(bodies) / parameters.bodies);
    parameters.box.upper = parameters.box.lower + factor * (parameters.box.upper - parameters.box.lower);
  }
  parameters.bodies = bodies;
  parameters.seconds = seconds;
  return parameters;
}

Scene scene_of(const SceneParameters& parameters) { return make_scene(parameters).value(); }

void expect_the_same_as_alone(const Setting& setting, std::size_t least_events) {
  const RunOutcome one = alone(setting);
  EXPECT_GE(one.events.size(), least_events);
  expect_same(one, spread_out(setting));
}

TEST(DistributedWorld, TellsOfTheFirstPaper) {
  expect_the_same_as_alone({.scene = scene_of(parameters_of("paper1", 400, 2.0))}, 500);
}

TEST(DistributedWorld, TellsOfTheSecondPaper) {
  expect_the_same_as_alone({.scene = scene_of(parameters_of("paper2", 300, 2.0))}, 100);
}

TEST(DistributedWorld, TellsOfAGasInASpaceThatRepeats) {
  expect_the_same_as_alone({.scene = scene_of(parameters_of("gas", 300, 1.0))}, 500);
  SceneParameters parameters = parameters_of("paper1", 200, 2.0);
  parameters.periodic = true;
  parameters.walls = false;
  expect_the_same_as_alone({.scene = scene_of(parameters)}, 100);
}

/// In a long tube each rank knows a small part of the bodies. Fast ones push others to where nobody has
/// expected them.
TEST(DistributedWorld, TellsOfALongTube) {
  SceneParameters parameters = parameters_of("paper1", 300, 2.0);
  parameters.box = {{0, 0, 0}, {900, 6, 6}};
  parameters.radius_min = 0.3;
  parameters.radius_max = 1.0;
  parameters.speed_min = 1.0;
  parameters.speed_max = 100.0;
  for (const bool repeats : {false, true}) {
    parameters.periodic = repeats;
    parameters.walls = !repeats;
    const Setting setting{.scene = scene_of(parameters)};
    const RunOutcome one = alone(setting);
    EXPECT_GE(one.events.size(), 300u);
    const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
    DistributedWorld world = spread(setting, *motion);
    expect_same(one, finish(setting, world));
    EXPECT_LT(world.figures().ghosts, parameters.bodies / 3);
  }
}

/// Some bodies are always on both sides of a face of the primary box. No rank knows all bodies for that.
TEST(DistributedWorld, KnowsLittleAroundTheFacesOfTheBox) {
  SceneParameters parameters = parameters_of("periodic_gas", 1500, 1.0);
  parameters.box = {{0, 0, 0}, {75, 1, 1}};
  parameters.packing = 0.1;
  const Setting setting{.scene = scene_of(parameters), .slices = 8};
  const RunOutcome one = alone(setting);
  const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  DistributedWorld world = spread(setting, *motion);
  expect_same(one, finish(setting, world));
  EXPECT_LT(world.figures().ghosts, parameters.bodies / 3);
}

/// Beside many bodies at rest, a few are hit, fly far aslant to where nobody has expected them, and hit
/// others. Until then, neither of the two ranks knows the body of the other.
TEST(DistributedWorld, TellsOfBodiesThatFlyFarOnceTheyAreHit) {
  RandomForcesDefinition forces{.interval = 1.0, .seed = 13};
  for (int k = 0; k < 300; ++k) forces.start.push_back({{4.0 * k, 0, 0}, {}});
  const Vec3 aslant = Vec3{1, 1, 0} / std::sqrt(2.0);
  for (int k = 0; k < 4; ++k) {
    const Vec3 hit{100.0 + 20.0 * k, 0, 100.0 + 20.0 * k};
    forces.start.push_back({hit - Vec3{std::sqrt(2.0), 1400, 0}, {0, 80, 0}});
    forces.start.push_back({hit, {}});
    forces.start.push_back({hit + 600.0 * aslant, {}});
  }
  // Those that nobody hits hardly move. Exact bodies would be looked at too often.
  forces.acceleration_limits.resize(forces.start.size(), 1e-6);
  Scene scene;
  scene.bodies.resize(forces.start.size(), {.radius = 1.0});
  scene.motion = RandomForces::create(forces).value().clone();
  scene.response = SceneResponse::bounce;
  scene.end_time = 30.0;
  // As bodies arrive, ranks agree only once they know most of them.
  expect_the_same_as_alone({.scene = std::move(scene), .slices = 2}, 8);
}

/// Some ranks know exact bodies alone, and are brought none. They compare them as one world does that has
/// others, too.
TEST(DistributedWorld, TellsOfUnknownCoursesAtOneEndOfATube) {
  constexpr int length = 100, count = 4 * length;
  RandomForcesDefinition forces{.interval = 0.25, .seed = 12};
  Random random(12);
  Scene scene;
  scene.world.box = Box{{0, 0, 0}, {3.0 * length, 6, 6}};
  for (int k = 0; k < count; ++k) {
    const int place = 47 * k % count;
    const Vec3 cell{place / 4 + 0.5, place / 2 % 2 + 0.5, place % 2 + 0.5};
    forces.start.push_back({3.0 * cell, 3.0 * random.point_in_ball()});
    forces.acceleration_limits.push_back(place < 8 ? 4.0 : 0.0);
    scene.bodies.push_back({.radius = 1.0});
  }
  scene.motion = RandomForces::create(forces).value().clone();
  scene.response = SceneResponse::bounce;
  scene.end_time = 2.0;
  const Setting setting{.scene = std::move(scene), .bringer = last_brings_all};
  const RunOutcome one = alone(setting);
  EXPECT_GE(one.events.size(), 500u);
  const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  DistributedWorld world = spread(setting, *motion);
  expect_same(one, finish(setting, world));
  // If ranks compared bodies in different ways, they would try again and again.
  EXPECT_LE(world.figures().rounds, 4 * world.figures().batches);
}

TEST(DistributedWorld, TellsOfRadiiThatChange) {
  expect_the_same_as_alone({.scene = scene_of(parameters_of("paper1", 300, 2.0)), .radius_rate = 0.1}, 300);
  expect_the_same_as_alone({.scene = scene_of(parameters_of("gas", 200, 1.0)), .radius_rate = 0.02}, 300);
}

/// What is remembered of pairs goes on with them, wherever the two are and whenever they meet again.
TEST(DistributedWorld, TellsOfPotentialsAndStatesOfPairs) {
  SceneParameters parameters = parameters_of("gas", 150, 2.0);
  parameters.packing = 0.15;
  const Setting setting{
      .scene = scene_of(parameters),
      .potential = StepPotential::Definition{.distances = {0.4, 0.9}, .energies = {-0.4, -0.2}},
      .slices = 3};
  const RunOutcome one = alone(setting);
  const auto in_state = [&](int least) {
    return std::count_if(one.events.begin(), one.events.end(),
                         [&](const Event& event) { return event.pair_state >= least; });
  };
  EXPECT_GT(in_state(2), 100);
  EXPECT_GT(in_state(3), 20);
  expect_same(one, spread_out(setting));
}

/// The first two meet after one has flown past many others, through the parts of ranks that do not know both.
TEST(DistributedWorld, RemembersPairsThatAreFarApart) {
  BallisticDefinition flight;
  flight.start = {{{0, 10, 0}, {80, 0, 0}}, {{600, 10, 0}, {}}};
  for (int k = 0; k < 150; ++k) flight.start.push_back({{4.0 * k, 0, 0}, {}});
  Scene scene;
  scene.bodies.resize(flight.start.size(), {.radius = 1.0});
  scene.motion = Ballistic::create(flight).value().clone();
  scene.end_time = 10.0;
  const Setting setting{.scene = std::move(scene),
                        .potential = StepPotential::Definition{.distances = {0.4}, .energies = {-0.4}},
                        .slices = 10};
  const RunOutcome one = alone(setting);
  ASSERT_EQ(one.events.size(), 4u);
  EXPECT_EQ(one.events[1].kind, EventKind::contact_begin);
  EXPECT_EQ(one.events[1].pair_state, 1);
  const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  DistributedWorld world = spread(setting, *motion);
  expect_same(one, finish(setting, world));
  EXPECT_LT(world.figures().ghosts, 100u);
}

/// Clusters are large, and their bodies come to ranks while these execute.
TEST(DistributedWorld, TellsOfADenseGasWithSensors) {
  SceneParameters parameters = parameters_of("gas", 220, 0.5);
  parameters.packing = 0.45;
  expect_the_same_as_alone({.scene = scene_of(parameters), .sensors = true}, 1000);
}

TEST(DistributedWorld, TellsOfSensorsAndErrors) {
  expect_the_same_as_alone(
      {.scene = scene_of(parameters_of("paper1", 300, 1.5)), .sensors = true, .position_error = 1e-3}, 500);
}

/// Far apart in a layer of air, each with a sensor, without responses.
TEST(DistributedWorld, TellsOfDrones) {
  SceneParameters parameters;
  parameters.bodies = 500;
  parameters.radius_min = parameters.radius_max = 0.5;
  parameters.speed_min = parameters.speed_max = 15.0;
  parameters.limit_min = parameters.limit_max = 5.0;
  parameters.box = {{0, 0, 0}, {400, 400, 40}};
  parameters.response = SceneResponse::pass_through;
  parameters.seconds = 5.0;
  Setting setting{.scene = scene_of(parameters), .sensors = true, .position_error = 0.01};
  setting.distances = {5.0, 20.0};
  expect_the_same_as_alone(setting, 1000);
}

TEST(DistributedWorld, TellsOfBrokenPromises) {
  // Limits of 0 are found by spot checks. From then on they are what was observed, on all ranks.
  for (const double broken : {0.3, 0.0}) {
    const Setting setting{.scene = scene_of(parameters_of("paper1", 250, 1.5)), .broken = broken};
    const RunOutcome one = alone(setting);
    EXPECT_GE(one.counters.count(EventKind::bound_violation), 20u);
    for (const Event& event : one.events)
      EXPECT_EQ(event.acceleration_limit > 0.0, event.kind == EventKind::bound_violation);
    expect_same(one, spread_out(setting));
  }
}

TEST(DistributedWorld, TellsOfLargeAndSmallBodies) {
  SceneParameters parameters = parameters_of("paper1", 300, 1.0);
  parameters.radius_min = 0.01;
  parameters.radius_max = 10.0;
  parameters.speed_max = 400.0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    parameters.seed = seed;
    expect_the_same_as_alone({.scene = scene_of(parameters)}, 20);
  }
}

TEST(DistributedWorld, TakesSeveralThreads) {
  expect_the_same_as_alone({.scene = scene_of(parameters_of("paper1", 400, 1.0)), .threads = 2}, 200);
}

TEST(DistributedWorld, TakesBodiesFromWhoeverBringsThem) {
  Setting setting{.scene = scene_of(parameters_of("paper1", 300, 1.0)), .bringer = last_brings_all};
  expect_the_same_as_alone(setting, 100);
}

TEST(DistributedWorld, MayStopOnTheWay) {
  expect_the_same_as_alone({.scene = scene_of(parameters_of("paper1", 300, 1.0)), .slices = 13}, 100);
}

/// Worlds of no more bodies than are recertified one by one: some ranks have none.
TEST(DistributedWorld, TakesFewBodies) {
  for (const std::uint32_t bodies : {1u, 2u, 3u, 8u, 9u, 12u}) {
    SceneParameters parameters = parameters_of("paper1", bodies, 6.0);
    parameters.radius_min = 3.0;
    expect_the_same_as_alone({.scene = scene_of(parameters)}, 0);
  }
}

/// Bodies on a lattice that all meet at equal times: the order of rechecks matters.
TEST(DistributedWorld, TellsOfManyThingsAtOneInstant) {
  for (const bool flies_apart : {false, true}) {
    constexpr int side = 6;
    std::vector<State> states;
    Scene scene;
    scene.world.box = Box{{0, 0, 0}, {3.0 * side, 3.0 * side, 3.0 * side}};
    // Numbers unrelated to places.
    for (int k = 0; k < side * side * side; ++k) {
      const int place = 125 * k % (side * side * side);
      const int x = place % side, y = place / side % side, z = place / side / side;
      const double to = (x + y + z) % 2 == 0 ? 1.0 : -1.0;
      const double along = flies_apart ? 0.0 : to;
      states.push_back({{3.0 * x + 1.5, 3.0 * y + 1.5, 3.0 * z + 1.5}, {to, along, 0.5 * along}});
      scene.bodies.push_back({.radius = 1.0});
    }
    scene.motion = Ballistic::create({.start = states}).value().clone();
    scene.response = SceneResponse::bounce;
    scene.end_time = 6.0;
    expect_the_same_as_alone({.scene = std::move(scene)}, 500);
  }
}

/// Bodies at rest on a lattice have certificates of equal times and different motions: the order of rechecks
/// decides which body is probed, and so what is due next.
TEST(DistributedWorld, TellsOfManyPairsThatAreDueAtOneInstant) {
  constexpr int side = 6;
  RandomForcesDefinition forces{.interval = 0.25, .seed = 7};
  Scene scene;
  scene.world.box = Box{{0, 0, 0}, {4.0 * side, 4.0 * side, 4.0 * side}};
  for (int k = 0; k < side * side * side; ++k) {
    const int place = 125 * k % (side * side * side);
    const int x = place % side, y = place / side % side, z = place / side / side;
    forces.start.push_back({{4.0 * x + 2.0, 4.0 * y + 2.0, 4.0 * z + 2.0}, {}});
    forces.acceleration_limits.push_back(2.0);
    scene.bodies.push_back({.radius = 1.5});
  }
  scene.motion = RandomForces::create(forces).value().clone();
  scene.response = SceneResponse::bounce;
  scene.end_time = 3.0;
  expect_the_same_as_alone({.scene = std::move(scene)}, 200);
}

/// A body hits one end of each row: clusters span all ranks.
TEST(DistributedWorld, TellsOfChainsThroughAllOfSpace) {
  std::vector<State> states;
  Scene scene;
  for (int row = 0; row < 5; ++row) {
    for (int k = 0; k < 60; ++k) {
      states.push_back({{2.0 * k + 0.001 * (k > 0 ? 1 : -3000), 4.0 * row, 0.0}, {}});
      if (k == 0) states.back().velocity = {20.0 + row, 0, 0};
      scene.bodies.push_back({.radius = 0.9995});
    }
  }
  scene.motion = Ballistic::create({.start = states}).value().clone();
  scene.response = SceneResponse::bounce;
  scene.end_time = 3.0;
  expect_the_same_as_alone({.scene = std::move(scene)}, 200);
}

/// `senses`: all bodies, and the late ones farther.
void expect_the_same_with_more_bodies_later(bool senses) {
  SceneParameters parameters = parameters_of("paper1", 200, 2.0);
  parameters.walls = false;
  Setting setting{.scene = scene_of(parameters)};
  const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  const auto late = [](std::uint32_t number) { return number % 10 == 7; };
  const ResponseFn respond = [&](const Event& event) { return setting.answer(event); };

  RunOutcome one;
  EventHash hash;
  World world = World::create(setting.scene.world).value();
  const Sensor sensors[] = {{.distances = {0.5}}, {.distances = {0.7}}};
  for (const SensorClass k : {SensorClass{1}, SensorClass{2}}) world.set_sensor(k, sensors[k - 1]).value();
  BodyMap map;
  const auto sink = [&](const Event& event) { hash.add(event); };
  std::vector<std::uint32_t> order;
  for (const bool is_late : {false, true})
    for (std::uint32_t k = 0; k < 200; ++k)
      if (late(k) == is_late) order.push_back(k);
  // In one world a body's index is its place in this order.
  Setting ordered{.scene = scene_of(parameters)};
  for (std::size_t k = 0; k < order.size(); ++k) ordered.scene.bodies[k] = setting.scene.bodies[order[k]];
  const ResponseFn ordered_respond = [&](const Event& event) { return ordered.answer(event); };
  const auto body_at = [&](std::uint32_t place, const Motion& source, double time) {
    BodyDefinition body = source.definition(order[place], time);
    body.radius = ordered.scene.bodies[place].radius;
    if (senses) body.sensor_class = late(order[place]) ? 2 : 1;
    return body;
  };
  std::uint32_t place = 0;
  for (const double until : {1.0, 2.0}) {
    for (; place < order.size() && late(order[place]) == (until == 2.0); ++place)
      map.add(world, *motion, order[place], body_at(place, *motion, world.time())).value();
    BodyMap::MapSource source = map.source();
    world.run(until, source, ordered_respond, sink).value();
  }

  const std::unique_ptr<Motion> spread_motion = setting.scene.motion->clone();
  DistributedWorld distributed = DistributedWorld::create(setting.scene.world, *spread_motion).value();
  for (const SensorClass k : {SensorClass{1}, SensorClass{2}})
    distributed.set_sensor(k, sensors[k - 1]).value();
  std::uint32_t next = 0;
  for (const double until : {1.0, 2.0}) {
    for (; next < order.size() && late(order[next]) == (until == 2.0); ++next)
      if (in_turn(next, 200, distributed.ranks()) == distributed.rank())
        distributed.add(next, body_at(next, *setting.scene.motion, distributed.time()), order[next]).value();
    const auto done = distributed.run(until, ordered_respond, [](const OrderedEvent&) {});
    ASSERT_TRUE(done) << done.error().message;
  }
  if (senses)
    expect_error(distributed.add(9999, {.radius = 0.1}, 0), ErrorCode::unsupported, "sensor_class", "add: ");
  EXPECT_EQ(distributed.hash().value(), hash.value());
  EXPECT_EQ(distributed.counters().probes, world.counters().probes);
  EXPECT_EQ(distributed.counters().pair_checks, world.counters().pair_checks);
}

TEST(DistributedWorld, CanBeGivenMoreBodiesLater) {
  expect_the_same_with_more_bodies_later(false);
  expect_the_same_with_more_bodies_later(true);
}

/// In scenes without responses the truth is known.
TEST(DistributedWorldDifferential, AgreesWithTheOracle) {
  int scenes = 0;
  for (int index = 0; index < static_cast<int>(scene_tests::Family::count); ++index) {
    const scene_tests::Family family{index};
    // Bodies of this family are added and removed.
    if (family == scene_tests::Family::tracks) continue;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      SCOPED_TRACE(std::string(scene_tests::name_of(family)) + " " + std::to_string(seed));
      Setting setting{.scene = scene_tests::differential_scene(family, seed)};
      setting.bringer = seed % 2 == 0 ? Bringer(in_turn) : Bringer(last_brings_all);
      const RunOutcome outcome = spread_out(setting);
      const ContactComparison comparison = compare_with_oracle(setting.scene, outcome.events).value();
      EXPECT_TRUE(comparison.agrees()) << comparison.first_difference.value_or("");
      ++scenes;
    }
  }
  EXPECT_GE(scenes, 60);
}

}  // namespace
}  // namespace kinesphere::distributed_world_test
