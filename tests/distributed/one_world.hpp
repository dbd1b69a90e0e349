// Runs a scene in one world and in a distributed one; the results must be equal.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "distributed/communicator.hpp"
#include "kinesphere/distributed/distributed_world.hpp"
#include "kinesphere/kinesphere.hpp"
#include "kinesphere/workers.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

struct RunOutcome {
  std::vector<Event> events;  ///< events of all ranks, in order
  Counters counters{};
  std::uint64_t hash = 0;
};

/// Returns the rank that adds a body.
using Bringer = std::function<int(std::uint32_t body, std::uint32_t bodies, int ranks)>;
inline int in_turn(std::uint32_t body, std::uint32_t, int ranks) {
  return static_cast<int>(body % static_cast<std::uint32_t>(ranks));
}
inline int last_brings_all(std::uint32_t, std::uint32_t, int ranks) { return ranks - 1; }

struct Setting {
  Scene scene{};
  bool sensors = false;
  std::vector<double> distances{0.4, 1.1};
  double position_error = 0.0;
  /// All bodies have this potential, but for pairs in an odd state. The state of a pair counts its contacts,
  /// and begins at 1 for neighbours by number.
  std::optional<StepPotential::Definition> potential{};
  /// Radii grow at this rate, keep or shrink at it, in turn.
  double radius_rate = 0.0;
  /// Parts, rotation, limits of turning and inertia of the bodies that are not balls, by number.
  std::map<std::uint32_t, RigidBody> rigid{};
  /// Shapes of the bodies that carry one, by number.
  std::map<std::uint32_t, Shape> shapes{};
  /// Factor by which the bodies' limits are too small.
  double broken = 1.0;
  int threads = 1;
  Bringer bringer = in_turn;
  /// Number of advances of the run.
  int slices = 1;
  /// Whose ranks share the world: DistributedWorld::create().
  std::optional<int> communicator{};

  BodyDefinition body(std::uint32_t number) const {
    BodyDefinition body = scene.motion->definition(number, scene.world.start_time);
    body.radius = scene.bodies[number].radius;
    body.mass = body.radius * body.radius * body.radius;
    body.user_data = number;
    if (sensors && number % 3 == 0) body.sensor_class = 1;
    if (number % 2 == 1) body.position_error = position_error;
    body.radius_rate = radius_rate * (1.0 - number % 3);
    if (number % 5 == 2) body.acceleration_limit *= broken;
    return body;
  }
  /// Adds a body by one of three functions, for balls, rigid bodies and moving shapes.
  void add(std::uint32_t number, const std::function<void(const BodyDefinition&)>& add_ball,
           const std::function<void(const RigidBody&)>& add_rigid,
           const std::function<void(const MovingShape&)>& add_shape) const {
    if (const auto shape = shapes.find(number); shape != shapes.end()) {
      MovingShape definition{body(number), shape->second};
      definition.body.radius_rate = 0.0;
      return add_shape(definition);
    }
    const auto found = rigid.find(number);
    if (found == rigid.end()) return add_ball(body(number));
    RigidBody definition = found->second;
    definition.body = body(number);
    definition.body.radius_rate = 0.0;
    add_rigid(definition);
  }
  void set_sensors(auto& world) const {
    if (sensors) world.set_sensor(1, {.distances = distances}).value();
    if (potential) world.set_sensor(0, {.distances = potential->distances}).value();
  }
  Response answer(const Event& event) const {
    if (potential) {
      const bool has_potential = event.pair_state % 2 == 0;
      const StepPotential steps = StepPotential::create(*potential, scene.world).value();
      Response response = has_potential || !is_of_sensor(event.kind) ? steps.respond(event) : Response{};
      if (event.kind == EventKind::contact_begin) response.pair_state = event.pair_state + 1;
      return response;
    }
    const bool begins = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
    if (scene.response != SceneResponse::bounce || !begins || event.approach_speed <= 0.0) return {};
    return response_of(event, bounce(event, scene.restitution));
  }
};

inline RunOutcome alone(const Setting& setting) {
  const Scene& scene = setting.scene;
  const std::unique_ptr<Motion> motion = scene.motion->clone();
  World world = World::create(scene.world).value();
  setting.set_sensors(world);
  std::vector<BodyId> ids;
  for (std::uint32_t k = 0; k < scene.bodies.size(); ++k)
    setting.add(
        k, [&](const BodyDefinition& body) { ids.push_back(world.add(body).value()); },
        [&](const RigidBody& body) { ids.push_back(world.add_rigid_body(body).value()); },
        [&](const MovingShape& body) { ids.push_back(world.add_moving_shape(body).value()); });
  if (setting.potential)
    for (std::size_t k = 1; k < ids.size(); ++k) world.set_pair_state(ids[k - 1], ids[k], 1).value();
  RunOutcome outcome;
  EventHash hash;
  const auto sink = [&](const Event& event) {
    outcome.events.push_back(event);
    hash.add(event);
  };
  const ResponseFn respond = [&](const Event& event) { return setting.answer(event); };
  SingleMotionSource source(*motion);
  world.run(scene.end_time, source, respond, sink).value();
  outcome.counters = world.counters();
  outcome.hash = hash.value();
  return outcome;
}

/// Returns the world of this rank, with the bodies that it adds; removes all others from the motion.
inline DistributedWorld spread(const Setting& setting, Motion& motion) {
  DistributedWorld world =
      DistributedWorld::create(setting.scene.world, motion, setting.communicator).value();
  setting.set_sensors(world);
  const auto bodies = static_cast<std::uint32_t>(setting.scene.bodies.size());
  for (std::uint32_t k = 0; k < bodies; ++k)
    if (setting.bringer(k, bodies, world.ranks()) == world.rank())
      setting.add(
          k, [&](const BodyDefinition& body) { world.add(k, body, k).value(); },
          [&](const RigidBody& body) { world.add_rigid_body(k, body, k).value(); },
          [&](const MovingShape& body) { world.add_moving_shape(k, body, k).value(); });
  for (std::uint32_t k = 0; k < bodies; ++k)
    if (setting.bringer(k, bodies, world.ranks()) != world.rank()) motion.remove(k).value();
  if (setting.potential)
    for (std::uint32_t k = 1; k < bodies; ++k) world.set_pair_state(k - 1, k, 1).value();
  return world;
}

/// Returns the events of all ranks of a communicator, in the order of one world.
inline std::vector<Event> merged(const std::vector<OrderedEvent>& here, std::optional<int> of_ranks = {}) {
  ByteWriter writer;
  for (const OrderedEvent& event : here) writer(event.event, event.round);
  std::vector<OrderedEvent> all;
  Communicator communicator(of_ranks);
  for (const auto& bytes : communicator.gather(writer.bytes())) {
    ByteReader reader(bytes);
    while (reader.remaining() > 0) {
      OrderedEvent& event = all.emplace_back();
      reader(event.event, event.round);
    }
  }
  std::sort(all.begin(), all.end());
  std::vector<Event> events;
  for (const OrderedEvent& event : all) events.push_back(event.event);
  return events;
}

/// Runs to the end of the scene; the result begins with the events in `told`.
inline RunOutcome finish(const Setting& setting, DistributedWorld& world,
                         std::vector<OrderedEvent> reported = {}) {
  Workers workers = Workers::create(setting.threads).value();
  const auto sink = [&](const OrderedEvent& event) {
    if (!reported.empty()) {
      EXPECT_TRUE(reported.back() < event);
    }
    reported.push_back(event);
  };
  const ResponseFn respond = [&](const Event& event) { return setting.answer(event); };
  const double begin = world.time();
  for (int slice = 1; slice <= setting.slices; ++slice) {
    const double part = static_cast<double>(slice) / setting.slices;
    const double until =
        slice == setting.slices ? setting.scene.end_time : begin + part * (setting.scene.end_time - begin);
    const auto done = world.run(until, respond, sink, &workers);
    EXPECT_TRUE(done) << done.error().message;
    if (!done) return {};
  }
  EXPECT_EQ(world.time(), setting.scene.end_time);
  EXPECT_EQ(world.size(), setting.scene.bodies.size());
  return {merged(reported, setting.communicator), world.counters(), world.hash().value()};
}

inline RunOutcome spread_out(const Setting& setting) {
  const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  DistributedWorld world = spread(setting, *motion);
  return finish(setting, world);
}

/// Returns all fields of the events, to the last bit.
inline std::vector<std::byte> bytes_of(const std::vector<Event>& events) {
  ByteWriter writer;
  for (const Event& event : events) writer(event);
  return writer.take();
}

/// Expects equal events after equal numbers of reports and of checks of pairs.
inline void expect_same_course(const RunOutcome& one, const RunOutcome& other) {
  ASSERT_EQ(one.events.size(), other.events.size());
  for (std::size_t k = 0; k < one.events.size(); ++k)
    ASSERT_EQ(bytes_of({one.events[k]}), bytes_of({other.events[k]}))
        << "event " << k << " at " << one.events[k].time << " and " << other.events[k].time;
  EXPECT_EQ(one.hash, other.hash);
  EXPECT_EQ(one.counters.events, other.counters.events);
  EXPECT_EQ(one.counters.probes, other.counters.probes);
  EXPECT_EQ(one.counters.pair_checks, other.counters.pair_checks);
}

/// Expects an equal course, and equal numbers of window starts and of all checks.
inline void expect_same(const RunOutcome& one, const RunOutcome& other) {
  expect_same_course(one, other);
  EXPECT_EQ(one.counters.starts, other.counters.starts);
  EXPECT_EQ(one.counters.restarts, other.counters.restarts);
  EXPECT_EQ(one.counters.wall_checks, other.counters.wall_checks);
  EXPECT_EQ(one.counters.certificates, other.counters.certificates);
  EXPECT_EQ(one.counters.zeno_steps, other.counters.zeno_steps);
  EXPECT_EQ(one.counters.repeated_contacts, other.counters.repeated_contacts);
}

}  // namespace kinesphere
