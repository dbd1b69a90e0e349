// Expectation: what a recording expects of the bodies of its world, so that it has to hold differences only.
//
// A body is expected to go on as planned since its last turn, and to be turned by an event as bounce() or
// settle() would turn it. The recorder and the replay each keep an expectation, and tell it the same.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "kinesphere/bound.hpp"
#include "kinesphere/response.hpp"
#include "recording/step.hpp"

namespace kinesphere {

class Expectation {
 public:
  /// Takes note of an answer of the probe, and returns it as differences.
  step::Answer told(const World& world, BodyId body, double time, const State& answer);
  /// The reverse: takes note of an answer, and returns it.
  State answer(const World& world, BodyId body, double time, const step::Answer& told);

  /// Takes note of the outcome of an advance.
  void note(const std::optional<Event>& event);
  /// Takes note of a change, before it is made.
  void note(const World& world, const Step& change);

  /// Returns a change of the velocity or angular velocity of a body of the last event as a rebound; nothing
  /// for any other change.
  std::optional<step::Rebound> rebound_of(const World& world, const Step& change);
  /// The reverse; nothing if there was no event.
  std::optional<Step> change_of(const World& world, const step::Rebound& rebound);

  std::size_t memory() const;

 private:
  /// A body since its last turn, or since its last answer that was not as expected.
  struct Flight {
    std::optional<std::uint32_t> generation{};  ///< of the body; nothing if the world has to be asked
    Bound bound{};
    double radius = 0.0;

    /// Returns the position if this is the velocity: as planned, or after a steady acceleration.
    Vec3 position_at(double time, const Vec3& velocity) const;
  };
  /// How the last event turns its bodies.
  struct Turn {
    std::uint8_t choice;
    double speed;
    Bounce after;
  };

  Flight& flight(const World& world, BodyId body);
  void know_bodies_of_event(const World& world);

  /// Returns the turn of a choice; `speed` is that of told_speed. Precondition: there is an event.
  Turn turn_of(const World& world, std::uint8_t choice, double speed);
  /// Returns the turn that gives a body of the event this velocity, or the nearest one.
  Turn turn_to(const World& world, bool second, bool spin, const Vec3& velocity);
  /// Takes note of the restitution and resting speed of the turn.
  void learn(const Turn& turn);

  std::vector<Flight> flights_;  ///< by index of the body
  std::optional<Event> event_;   ///< of the last advance
  std::optional<Turn> turn_;     ///< at the event, once a body has been turned
  /// Restitutions and resting speeds of recent events, the last one first.
  std::array<double, 4> restitutions_{1.0, 0.5, 0.8, 0.0};
  std::array<double, 4> resting_speeds_{};
};

}  // namespace kinesphere
