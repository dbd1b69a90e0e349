// Reports: asking for states, refusing bad ones, and noticing broken promises.
#include <cmath>
#include <string>

#include "world/engine.hpp"
#include "world/validation.hpp"

namespace kinesphere {
namespace {

/// Resets the flag even if the probe throws.
class WhileTrue {
 public:
  explicit WhileTrue(bool& flag) : flag_(flag) { flag_ = true; }
  WhileTrue(const WhileTrue&) = delete;
  WhileTrue& operator=(const WhileTrue&) = delete;
  ~WhileTrue() { flag_ = false; }

 private:
  bool& flag_;
};

}  // namespace

Result<void> World::Engine::probe(std::span<const std::uint32_t> numbers) {
  // A probe that forgets to answer is told so.
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  constexpr Vec3 unanswered{nothing, nothing, nothing};
  probe_ids_.clear();
  for (const std::uint32_t number : numbers) probe_ids_.push_back(id_of(number));
  probe_states_.assign(numbers.size(), State{unanswered, unanswered});
  {
    const WhileTrue guard(probing_);
    (*probe_)(probe_ids_, time_, probe_states_);
  }
  counters_.probes += numbers.size();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (auto valid = check_report(probe_states_[k], probe_ids_[k], time_, definition_); !valid) return valid;
  }
  for (std::size_t k = 0; k < numbers.size(); ++k) apply_report(numbers[k], probe_states_[k]);
  return {};
}

/// Probes the body whose report is older; the second one, if they are of the same age.
Result<void> World::Engine::probe_staler(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t staler = bodies_[a].bound.time < bodies_[b].bound.time ? a : b;
  return probe(std::span(&staler, 1));
}

void World::Engine::apply_report(std::uint32_t number, const State& state) {
  Body& body = bodies_[number];
  const BodyDefinition& promise = body.definition;
  const double s = time_ - body.bound.time;
  const double deviation = norm(state.position - body.bound.centre_at(time_));
  const double deviation_limit =
      (body.bound.radius_at(time_) - body.bound.radius) + 2.0 * promise.position_error;
  // After a kick the velocity is the caller's, to be confirmed at the same instant.
  const bool kicked = body.kicked_since_report;
  const Vec3 expected = kicked ? promise.velocity : body.bound.velocity_at(time_);
  const double change = norm(state.velocity - expected);
  const double change_limit = (kicked ? 0.0 : promise.acceleration_limit * s) + 2.0 * promise.velocity_error;
  // What rounding may do to a faithful report is no violation: it is covered by the contact tolerance.
  const double position_slack = definition_.contact_tolerance / 16.0;
  const double velocity_slack = 0x1p-30 * (norm(state.velocity) + norm(expected) + change_limit);
  const bool left = deviation > deviation_limit + position_slack;
  const bool jumped = change > change_limit + velocity_slack;

  body.definition.position = state.position;
  body.definition.velocity = state.velocity;
  body.bound = bound_of(body.definition, state, time_);
  body.kicked_since_report = false;
  if (!left && !jumped) return;
  Event violation{.kind = EventKind::bound_violation, .time = time_, .first = id_of(number)};
  violation.first_state = state;
  violation.point = state.position;
  if (left) violation.position_excess = deviation - deviation_limit;
  if (jumped) violation.velocity_excess = change - change_limit;
  book_.announce(violation);
  void_facts(number);
}

}  // namespace kinesphere
