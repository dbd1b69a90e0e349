#include "recording/expectation.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "archive/heap_counter.hpp"
#include "bound/bound_violation.hpp"
#include "contact/rebound.hpp"

namespace kinesphere {
namespace {

using step::Rebound;

/// Number of rebounds with the same masses: four restitutions and four resting speeds.
constexpr std::uint8_t rebounds = 8;
/// Number of choices of masses: those of the event, the volumes of balls and the areas of discs.
constexpr std::uint8_t mass_choices = 3;
static_assert(rebounds * mass_choices == Rebound::told_speed);

/// Returns the mass of a body of the event.
double mass_of(std::uint8_t choice, double given, double radius) {
  if (choice / rebounds == 1) return radius * radius * radius;
  if (choice / rebounds == 2) return radius * radius;
  return given;
}

bool is(BodyId a, BodyId b) { return a.index == b.index && a.generation == b.generation; }

Vec3 part_of(const Bounce& after, bool second, bool spin) {
  if (spin) return second ? after.second_angular_velocity : after.first_angular_velocity;
  return second ? after.second_velocity : after.first_velocity;
}

/// Makes a value the first one of recent values.
void make_first(std::span<double> recent, double value) {
  auto at = std::find(recent.begin(), recent.end(), value);
  if (at == recent.end()) --at;
  std::copy_backward(recent.begin(), at, at + 1);
  recent.front() = value;
}

/// Returns the number that somebody has typed, from one with rounding errors.
double as_typed(double value) { return std::round(value * 1e6) / 1e6; }

}  // namespace

Vec3 Expectation::Flight::position_at(double time, const Vec3& velocity) const {
  if (velocity == bound.velocity_at(time)) return bound.centre_at(time);
  return bound.position + (0.5 * (time - bound.time)) * (bound.velocity + velocity);
}

Expectation::Flight& Expectation::flight(const World& world, BodyId body) {
  if (body.index >= flights_.size()) flights_.resize(std::size_t{body.index} + 1);
  Flight& flight = flights_[body.index];
  if (flight.generation == body.generation) return flight;
  flight = {.generation = body.generation};
  if (const auto now = world.body(body)) {
    flight.bound = now->bound;
    flight.radius = now->definition.radius;
  }
  return flight;
}

/// What is expected of a body depends on when it is first asked for, so this must not depend on the choice of
/// a turn, which the replay does not search.
void Expectation::know_bodies_of_event(const World& world) {
  flight(world, event_->first);
  if (event_->second != no_body) flight(world, event_->second);
}

step::Answer Expectation::told(const World& world, BodyId body, double time, const State& answer) {
  Flight& flight = this->flight(world, body);
  step::Answer told;
  told.set(0, answer.velocity, flight.bound.velocity_at(time));
  told.set(3, answer.position, flight.position_at(time, answer.velocity));
  if (told != step::Answer()) restart(flight.bound, time, answer);
  return told;
}

State Expectation::answer(const World& world, BodyId body, double time, const step::Answer& told) {
  Flight& flight = this->flight(world, body);
  const Vec3 velocity = told.vector(0, flight.bound.velocity_at(time));
  const State answer{told.vector(3, flight.position_at(time, velocity)), velocity};
  if (told != step::Answer()) restart(flight.bound, time, answer);
  return answer;
}

void Expectation::note(const std::optional<Event>& event) {
  event_ = event;
  turn_.reset();
}

void Expectation::note(const World& world, const Step& change) {
  const auto known = [this](BodyId body) {
    return body.index < flights_.size() && flights_[body.index].generation == body.generation
               ? &flights_[body.index]
               : nullptr;
  };
  if (const auto* set = std::get_if<step::SetVelocity>(&change)) {
    if (Flight* flight = known(set->subject))
      restart(flight->bound, world.time(), {flight->bound.centre_at(world.time()), set->argument});
    return;
  }
  const auto forget = [&](BodyId body) {
    if (Flight* flight = known(body)) flight->generation.reset();
  };
  if (const auto* set = std::get_if<step::Teleport>(&change)) forget(set->subject);
  if (const auto* set = std::get_if<step::Enable>(&change)) forget(set->subject);
  if (const auto* set = std::get_if<step::SetMotionLimits>(&change)) forget(set->body);
  if (const auto* set = std::get_if<step::SetRadius>(&change)) forget(set->body);
}

std::optional<Rebound> Expectation::rebound_of(const World& world, const Step& change) {
  const auto* const push = std::get_if<step::SetVelocity>(&change);
  const auto* const spin = std::get_if<step::SetAngularVelocity>(&change);
  if (!event_ || (!push && !spin)) return {};
  const BodyId body = push ? push->subject : spin->body;
  const Vec3 velocity = push ? push->argument : spin->argument;
  Rebound rebound{.second = is(body, event_->second), .spin = spin != nullptr};
  if (body == no_body || (!rebound.second && !is(body, event_->first))) return {};
  if (!turn_) {
    know_bodies_of_event(world);
    turn_ = turn_to(world, rebound.second, rebound.spin, velocity);
    learn(*turn_);
    rebound.choice = turn_->choice;
    rebound.speed = turn_->speed;
  }
  rebound.velocity.set(0, velocity, part_of(turn_->after, rebound.second, rebound.spin));
  return rebound;
}

std::optional<Step> Expectation::change_of(const World& world, const Rebound& rebound) {
  if (!event_) return {};
  if (rebound.choice != Rebound::as_before) {
    know_bodies_of_event(world);
    turn_ = turn_of(world, rebound.choice, rebound.speed);
    learn(*turn_);
  }
  if (!turn_) return {};
  const BodyId body = rebound.second ? event_->second : event_->first;
  const Vec3 velocity = rebound.velocity.vector(0, part_of(turn_->after, rebound.second, rebound.spin));
  if (rebound.spin) return step::SetAngularVelocity{body, velocity};
  return step::SetVelocity{body, velocity};
}

Expectation::Turn Expectation::turn_of(const World& world, std::uint8_t choice, double speed) {
  const Event& event = *event_;
  const std::size_t number = choice % rebounds;
  // As bounce() and settle() compute them, to the last bit.
  const double approach = event.approach_speed;
  if (choice < Rebound::told_speed)
    speed = (1.0 + (number < 4 ? restitutions_[number] : resting_speeds_[number - 4] / approach)) * approach;
  double first_mass = event.first_mass, second_mass = event.second_mass;
  if (choice >= rebounds && choice < Rebound::told_speed) {
    first_mass = mass_of(choice, first_mass, flight(world, event.first).radius);
    if (event.second != no_body)
      second_mass = mass_of(choice, second_mass, flight(world, event.second).radius);
  }
  return {choice, speed, rebound(event, first_mass, second_mass, speed)};
}

Expectation::Turn Expectation::turn_to(const World& world, bool second, bool spin, const Vec3& velocity) {
  for (std::uint8_t choice = 0; choice < Rebound::told_speed; ++choice) {
    const Turn turn = turn_of(world, choice, 0.0);
    if (part_of(turn.after, second, spin) == velocity) return turn;
  }
  const Vec3 before = part_of(turn_of(world, Rebound::told_speed, 0.0).after, second, spin);
  const Vec3 unit = part_of(turn_of(world, Rebound::told_speed, 1.0).after, second, spin) - before;
  const double size = norm_squared(unit);
  const double speed = size > 0.0 ? dot(velocity - before, unit) / size : 0.0;
  return turn_of(world, Rebound::told_speed, std::isfinite(speed) ? speed : 0.0);
}

void Expectation::learn(const Turn& turn) {
  const std::size_t number = turn.choice % rebounds;
  const double approach = event_->approach_speed;
  if (turn.choice == Rebound::told_speed) {
    make_first(restitutions_, as_typed(turn.speed / approach - 1.0));
    make_first(resting_speeds_, as_typed(turn.speed - approach));
  } else if (number < 4) {
    make_first(restitutions_, restitutions_[number]);
  } else {
    make_first(resting_speeds_, resting_speeds_[number - 4]);
  }
}

std::size_t Expectation::memory() const { return heap_bytes(flights_); }

}  // namespace kinesphere
