// Reports: asking for states, refusing bad ones, and noticing broken promises.
#include <string>

#include "bound/broken_promise.hpp"
#include "world/engine.hpp"
#include "world/validation.hpp"

namespace kinesphere {
namespace {

constexpr double not_said = std::numeric_limits<double>::quiet_NaN();
/// A probe that forgets to answer is told so.
constexpr State unanswered{{not_said, not_said, not_said}, {not_said, not_said, not_said}};

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
  probe_ids_.resize(numbers.size());
  probe_states_.resize(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    probe_ids_[k] = id_of(numbers[k]);
    probe_states_[k] = unanswered;
  }
  // Counted first: a probe that throws leaves the same world as one that does not answer.
  counters_.probes += numbers.size();
  {
    const WhileTrue guard(probing_);
    (*probe_)(probe_ids_, time_, probe_states_);
  }
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (auto valid = check_report(probe_states_[k], probe_ids_[k], time_, definition_, probing_call_); !valid)
      return valid;
  }
  for (std::size_t k = 0; k < numbers.size(); ++k) apply_report(numbers[k], probe_states_[k]);
  return {};
}

/// Outside advance(): probes those whose reports are not of this time, except for disabled ones. True when
/// there were any.
Result<bool> World::Engine::probe_stale(std::span<const std::uint32_t> numbers, const Probe& ask,
                                        std::string_view call) {
  std::vector<std::uint32_t> stale;
  for (const std::uint32_t number : numbers)
    if (bodies_[number].enabled && !bodies_[number].fresh(time_)) stale.push_back(number);
  if (stale.empty()) return false;
  probe_ = &ask;
  probing_call_ = call;
  if (auto probed = probe(stale); !probed) return probed.error();
  return true;
}

/// Probes the body whose report is older; the second one, if they are of the same age. One of them at least
/// is not fresh.
Result<void> World::Engine::probe_staler(std::uint32_t a, std::uint32_t b) {
  const bool a_is_staler = bodies_[a].bound.time < bodies_[b].bound.time;
  const bool a_is_asked = !bodies_[a].fresh(time_) && (a_is_staler || bodies_[b].fresh(time_));
  const std::uint32_t staler = a_is_asked ? a : b;
  return probe(std::span(&staler, 1));
}

void World::Engine::apply_report(std::uint32_t number, const State& answer) {
  Body& body = bodies_[number];
  State state = answer;
  if (space_.repeats())
    state.position += space_.shift_to_nearest(answer.position, body.bound.centre_at(time_));
  const Bound before = body.bound;
  std::optional<Vec3> kicked_to;
  if (const Change* change = change_since_report(number)) {
    kicked_to = change->kicked_to;
    body.bound = bound_of(definition_of(number), state, time_);
    forget_change(number);
  } else {
    body.bound.time = time_;
    body.bound.position = state.position;
    body.bound.velocity = state.velocity;
  }
  const auto broken =
      broken_promise(before, body.bound, body.radius, kicked_to, definition_.contact_tolerance);
  if (body.is_resting()) stand_still(body);
  if (!broken) return;
  Sphere reported = sphere(number);
  reported.state = {space_.wrapped(state.position).position, state.velocity};
  book_.announce(violation_event(time_, reported, *broken));
  void_facts(number);
}

}  // namespace kinesphere
