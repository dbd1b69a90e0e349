// A world of bouncing bodies in windows, advanced by a loop over advance() or by World::run, with equal
// results.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/workers.hpp"

namespace kinesphere {

template <class OfMotion>
struct BouncingWorld {
  OfMotion motion;
  World world;
  double restitution = 1.0;
  bool passes = false;           ///< no responses
  std::vector<double> masses{};  ///< indexed by body; others are static
  EventHash hash{};
  std::uint64_t order = 0;  ///< hash of events that depends on their order
  std::size_t reported = 0;
  double last = -std::numeric_limits<double>::infinity();  ///< the time of the last event

  BouncingWorld(OfMotion moved_by, World empty, double bounciness)
      : motion(std::move(moved_by)), world(std::move(empty)), restitution(bounciness) {}
  /// Adds the next body of the motion.
  void add(const BodyDefinition& body, double mass) {
    world.add(body).value();
    masses.push_back(mass);
  }
  BodyDefinition next() const { return motion.definition(static_cast<std::uint32_t>(masses.size()), 0.0); }

  Response answer(const Event& event) const {
    const bool begins = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
    if (passes || !begins || event.approach_speed <= 0.0) return {};
    const Bounce after = bounce(event, mass(event.first), mass(event.second), restitution);
    Response given;
    if (std::isfinite(mass(event.first))) given.first_velocity = after.first_velocity;
    if (event.second != no_body && std::isfinite(mass(event.second)))
      given.second_velocity = after.second_velocity;
    return given;
  }
  double mass(BodyId body) const {
    if (body == no_body) return 1.0;
    return body.index < masses.size() ? masses[body.index] : std::numeric_limits<double>::infinity();
  }
  void tell(const Event& event) {
    hash.add(event);
    EventHash one;
    one.add(event);
    order = 31 * order + one.value();
    ++reported;
    EXPECT_GE(event.time, last);
    last = event.time;
  }

  void loop(double until) {
    while (const auto event = world.advance(until, motion.probe()).value()) {
      const Response given = answer(*event);
      const auto update = [&](BodyId body, const std::optional<Vec3>& velocity) {
        if (!velocity) return;
        motion.set_velocity(body.index, event->time, *velocity).value();
        world.set_velocity(body, *velocity).value();
      };
      update(event->first, given.first_velocity);
      update(event->second, given.second_velocity);
      tell(*event);
    }
  }
  Result<void> run(double until, Workers* workers = nullptr) {
    const auto sink = [this](const Event& event) { tell(event); };
    if (passes) return world.run(until, motion.probe(), sink, workers);
    SingleMotionSource source(motion);
    return world.run(
        until, source, [this](const Event& event) { return answer(event); }, sink, workers);
  }
};

/// Expects equal events, from equal numbers of reports and rechecks.
template <class OfMotion>
void expect_same_course(const BouncingWorld<OfMotion>& found, const BouncingWorld<OfMotion>& expected) {
  EXPECT_EQ(found.reported, expected.reported);
  EXPECT_EQ(found.hash.value(), expected.hash.value());
  EXPECT_EQ(found.order, expected.order);
  EXPECT_EQ(found.world.counters().probes, expected.world.counters().probes);
  EXPECT_EQ(found.world.counters().pair_checks, expected.world.counters().pair_checks);
}

}  // namespace kinesphere
