// The parts of an engine with a few bodies that fly straight on, for tests of these parts.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "bodies/body_bounds.hpp"
#include "kinesphere/run.hpp"
#include "processor/event_processor.hpp"
#include "processor/world_state.hpp"

namespace kinesphere {

class SmallWorld {
 public:
  explicit SmallWorld(const WorldDefinition& definition = {})
      : state(definition), main(state, definition.start_time) {
    main.reports().ask(probe, "test");
  }
  SmallWorld(const SmallWorld&) = delete;
  SmallWorld& operator=(const SmallWorld&) = delete;

  std::uint32_t add(const BodyDefinition& body) {
    const std::uint32_t number = state.bodies.add(body, main.time());
    state.bodies[number].bound = bound_now(body, main.time());
    state.contacts.add(number, state.bodies.largest_acceleration(number));
    origins.push_back({main.time(), {body.position, body.velocity}});
    main.invalidate(number);
    return number;
  }
  /// Gives a body another velocity, in truth and as its caller says.
  void set_velocity(std::uint32_t number, const Vec3& velocity) {
    origins[number] = {main.time(), {state_of(number, main.time()).position, velocity}};
    main.set_velocity(number, velocity);
  }
  State state_of(std::uint32_t number, double time) const {
    const MotionOrigin& origin = origins[number];
    return {origin.state.position + origin.state.velocity * (time - origin.time), origin.state.velocity};
  }

  /// Goes on to the next event, or to a time without one. No windows start together: each body renews its
  /// own.
  std::optional<Event> advance(double until) {
    main.note_response();
    for (;;) {
      if (main.is_gathering()) {
        EXPECT_TRUE(main.gather(until));
      }
      if (auto event = main.pop()) return event;
      EXPECT_TRUE(main.recertify());
      if (!main.events().pending().empty()) continue;
      const double next = main.next_time();
      if (next > until) {
        main.advance_clock(until);
        return std::nullopt;
      }
      main.begin_instant(next);
    }
  }
  std::vector<Event> advance_all(double until) {
    std::vector<Event> events;
    while (const auto event = advance(until)) events.push_back(*event);
    return events;
  }

  WorldState state;
  EventProcessor main;
  std::vector<MotionOrigin> origins;  ///< by number
  Probe probe = [this](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = state_of(ids[k].index, time);
  };
};

}  // namespace kinesphere
