// Reports: asking for states, refusing bad ones, and noticing broken promises.
#include <cmath>
#include <string>

#include "world/engine.hpp"
#include "world/validation.hpp"

namespace kinesphere {

Result<void> World::Engine::probe(std::span<const std::uint32_t> numbers) {
  std::vector<BodyId> ids;
  for (const std::uint32_t number : numbers) ids.push_back(id_of(number));
  // A probe that forgets to answer is told so.
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  constexpr Vec3 unanswered{nothing, nothing, nothing};
  std::vector<State> states(ids.size(), State{unanswered, unanswered});
  probing_ = true;
  (*probe_)(ids, time_, states);
  probing_ = false;
  counters_.probes += ids.size();
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (auto valid = check_report(states[k], ids[k], time_, definition_); !valid) return valid;
  }
  for (std::size_t k = 0; k < ids.size(); ++k) apply_report(numbers[k], states[k]);
  return {};
}

/// Probes the body whose report is older, unless one of the two is fresh.
Result<void> World::Engine::probe_staler(std::uint32_t a, std::uint32_t b) {
  const double time_a = bodies_[a].bound.time;
  const double time_b = bodies_[b].bound.time;
  if (time_a == time_ || time_b == time_) return {};
  const std::uint32_t staler = time_a <= time_b ? a : b;
  return probe(std::span(&staler, 1));
}

void World::Engine::apply_report(std::uint32_t number, const State& state) {
  Body& body = bodies_[number];
  const BodyDefinition& promise = body.definition;
  const double s = time_ - body.bound.time;
  const double deviation = norm(state.position - body.bound.centre_at(time_));
  const double deviation_limit =
      (body.bound.radius_at(time_) - body.bound.radius) + 2.0 * promise.position_error;
  const double change = norm(state.velocity - body.bound.velocity_at(time_));
  const double change_limit = promise.acceleration_limit * s + 2.0 * promise.velocity_error;
  // What rounding may do to a faithful report is no violation: it is covered by the contact tolerance.
  const double position_slack = definition_.contact_tolerance / 16.0;
  const double velocity_slack = 0x1p-30 * (norm(state.velocity) + norm(body.bound.velocity) + change_limit);
  const bool left = deviation > deviation_limit + position_slack;
  const bool jumped = change > change_limit + velocity_slack && !body.velocity_unknown;

  body.definition.position = state.position;
  body.definition.velocity = state.velocity;
  body.bound = bound_of(body.definition, state, time_);
  body.velocity_unknown = false;
  if (!left && !jumped) return;
  Event violation{.kind = EventKind::bound_violation, .time = time_, .first = id_of(number)};
  violation.first_state = state;
  violation.point = state.position;
  if (left) violation.position_excess = deviation - deviation_limit;
  if (jumped) violation.velocity_excess = change - change_limit;
  announce(violation);
  void_facts(number);
}

}  // namespace kinesphere
