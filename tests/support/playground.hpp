// A world with bodies of known true motion: each has a constant acceleration between changes.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <optional>
#include <ostream>
#include <span>
#include <utility>
#include <vector>

#include "kinesphere/event_hash.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

inline std::ostream& operator<<(std::ostream& out, const Event& e) {
  out << std::hexfloat << e.time << std::defaultfloat << " (" << e.time << ") " << name_of(e.kind) << " "
      << e.first << " " << e.second << " " << name_of(e.wall);
  return out << " gap " << e.gap << " approach " << e.approach_speed << (e.repeated ? " repeated" : "");
}

inline std::ostream& operator<<(std::ostream& out, const std::vector<Event>& events) {
  for (const Event& event : events) out << "\n  " << event;
  return out;
}

/// The true motion since the last change.
struct TrueCourse {
  double since = 0.0;
  State state{};
  Vec3 acceleration{};

  State at(double t) const {
    const double s = t - since;
    return {state.position + (state.velocity + acceleration * (0.5 * s)) * s,
            state.velocity + acceleration * s};
  }
};

class Playground {
 public:
  explicit Playground(const WorldDefinition& definition = {}) : world(World::create(definition).value()) {}

  /// Adds a body that moves with `acceleration`, or with its plan if none is given.
  BodyId add(const BodyDefinition& body, std::optional<Vec3> acceleration = std::nullopt) {
    const BodyId id = world.add(body).value();
    start_course(id, body, acceleration);
    return id;
  }

  /// Adds a rigid body whose position moves with its plan.
  BodyId add_rigid_body(const RigidBody& rigid) {
    const BodyId id = world.add_rigid_body(rigid).value();
    start_course(id, rigid.body);
    return id;
  }

  /// Starts the true motion of a body that has been added to the world already.
  void start_course(BodyId id, const BodyDefinition& body, std::optional<Vec3> acceleration = std::nullopt) {
    if (id.index >= courses_.size()) courses_.resize(id.index + 1);
    courses_[id.index] = {
        world.time(), {body.position, body.velocity}, acceleration.value_or(body.planned_acceleration)};
  }

  State state(BodyId id, double t) const { return courses_[id.index].at(t); }
  State state(BodyId id) const { return state(id, world.time()); }

  /// Changes the true velocity, and calls the world.
  void set_velocity(BodyId id, const Vec3& velocity) {
    set_velocity_unseen(id, velocity);
    world.set_velocity(id, velocity).value();
  }

  /// Changes the true velocity without a call of the world; this may break the limits.
  void set_velocity_unseen(BodyId id, const Vec3& velocity) {
    restart(id);
    courses_[id.index].state.velocity = velocity;
  }
  void set_position(BodyId id, const Vec3& position) {
    restart(id);
    courses_[id.index].state.position = position;
  }
  /// Changes the true state without a call of the world.
  void set_state(BodyId id, const State& state) {
    set_position(id, state.position);
    set_velocity_unseen(id, state.velocity);
  }
  /// Changes the true state, and calls the world.
  void teleport(BodyId id, const State& state) {
    set_state(id, state);
    world.teleport(id, state).value();
  }
  void steer(BodyId id, const Vec3& acceleration) {
    restart(id);
    courses_[id.index].acceleration = acceleration;
  }

  auto probe() {
    return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) {
        states[k] = state(ids[k], time);
        if (distort) distort(ids[k], time, states[k]);
      }
    };
  }

  std::optional<Event> advance(double until) {
    auto event = world.advance(until, probe()).value();
    if (event) hash.add(*event);
    return event;
  }

  /// Returns all events up to `until`; calls `answer` at each.
  std::vector<Event> run(double until, const std::function<void(const Event&)>& answer = {},
                         std::size_t at_most = 100000) {
    std::vector<Event> events;
    while (const auto event = advance(until)) {
      events.push_back(*event);
      if (answer) answer(*event);
      if (events.size() >= at_most) {
        ADD_FAILURE() << at_most << " events by time " << event->time << ", the last " << *event;
        break;
      }
    }
    return events;
  }

  /// Returns the distance between the true surfaces, without report errors.
  double gap(BodyId a, BodyId b, double t) const {
    return norm(state(a, t).position - state(b, t).position) - radius(a) - radius(b);
  }
  double gap(BodyId a, BodyId b) const { return gap(a, b, world.time()); }
  double radius(BodyId id) const { return world.body(id).value().definition.radius; }

  World world;
  EventHash hash;
  /// Called for each report.
  std::function<void(BodyId, double, State&)> distort;

 private:
  void restart(BodyId id) {
    TrueCourse& course = courses_[id.index];
    course.state = course.at(world.time());
    course.since = world.time();
  }

  std::vector<TrueCourse> courses_;  ///< indexed by body
};

inline std::vector<Event> of_kind(const std::vector<Event>& events, EventKind kind) {
  std::vector<Event> found;
  for (const Event& event : events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

/// Expects that audit() finds nothing.
inline testing::AssertionResult is_clean(const World& world) {
  const auto finding = world.inspection().audit();
  if (!finding) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "audit at time " << world.time() << ": " << finding->where << ": "
                                     << finding->what;
}

}  // namespace kinesphere
