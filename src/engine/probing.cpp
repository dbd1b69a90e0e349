// Reports: asking for states, refusing bad ones, and noticing broken promises.
#include <atomic>
#include <map>
#include <mutex>
#include <string>

#include "bound/broken_promise.hpp"
#include "engine/island.hpp"
#include "engine/validation.hpp"
#include "engine/while_true.hpp"

namespace kinesphere {
namespace {

constexpr double not_said = std::numeric_limits<double>::quiet_NaN();
/// A probe that forgets to answer is told so.
constexpr State unanswered{{not_said, not_said, not_said}, {not_said, not_said, not_said}};

}  // namespace

Result<void> Island::probe(std::span<const std::uint32_t> numbers) {
  Shift alone;
  return probe(numbers, alone);
}

Result<void> Island::probe(std::span<const std::uint32_t> numbers, Shift& shift) {
  probe_ids_.resize(numbers.size());
  probe_states_.resize(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    probe_ids_[k] = bodies().id_of(numbers[k]);
    probe_states_[k] = unanswered;
  }
  // Counted first: a probe that throws leaves the same world as one that does not answer.
  counters_.probes += numbers.size();
  {
    const WhileTrue guard(asking_);
    constexpr std::size_t bodies_at_once = 512;
    shift.for_each(numbers.size(), bodies_at_once, [this](std::size_t from, std::size_t to, std::size_t) {
      const std::size_t count = to - from;
      (*probe_)(std::span(probe_ids_).subspan(from, count), time_,
                std::span(probe_states_).subspan(from, count));
    });
  }
  if (numbers.size() == 1) {
    if (auto valid = check(0); !valid) return valid;
    if (const auto broken = apply_report(numbers[0], probe_states_[0])) tell_broken(0, *broken);
    return {};
  }
  constexpr std::size_t reports_at_once = 512;
  std::atomic<std::size_t> first_bad = numbers.size();
  shift.for_each(numbers.size(), reports_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
    for (std::size_t k = from; k < to && k < first_bad; ++k) {
      if (check(k)) continue;
      for (std::size_t first = first_bad; k < first && !first_bad.compare_exchange_weak(first, k);) continue;
    }
  });
  if (first_bad < numbers.size()) return check(first_bad);
  // What was changed since the last report is in a table of all bodies.
  Shift alone;
  std::mutex mutex;
  std::map<std::size_t, BrokenPromise> broken_ones;
  (bodies().has_changes() ? alone : shift)
      .for_each(numbers.size(), reports_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
        for (std::size_t k = from; k < to; ++k) {
          const auto broken = apply_report(numbers[k], probe_states_[k]);
          if (!broken) continue;
          const std::lock_guard lock(mutex);
          broken_ones.emplace(k, *broken);
        }
      });
  for (const auto& [k, broken] : broken_ones) tell_broken(k, broken);
  return {};
}

Result<void> Island::check(std::size_t k) const {
  return check_report(probe_states_[k], probe_ids_[k], time_, bodies().definition(), call_);
}

/// Probes the body whose report is older; the second one, if they are of the same age. One of them at least
/// is not fresh.
Result<void> Island::probe_staler(std::uint32_t a, std::uint32_t b) {
  const bool a_is_staler = bodies()[a].bound.time < bodies()[b].bound.time;
  const bool a_is_asked = !bodies()[a].fresh(time_) && (a_is_staler || bodies()[b].fresh(time_));
  const std::uint32_t staler = a_is_asked ? a : b;
  return probe(std::span(&staler, 1));
}

/// Returns what the report says about promises of the body that did not hold.
std::optional<BrokenPromise> Island::apply_report(std::uint32_t number, const State& answer) {
  Body& body = bodies()[number];
  State state = answer;
  if (bodies().space().repeats())
    state.position += bodies().space().shift_to_nearest(answer.position, body.bound.centre_at(time_));
  const Bound before = body.bound;
  std::optional<Vec3> kicked_to;
  if (const Change* change = bodies().change_since_report(number)) {
    kicked_to = change->kicked_to;
    body.bound = bound_of(bodies().definition_of(number), state, time_);
    bodies().forget_change(number);
  } else {
    body.bound.time = time_;
    body.bound.position = state.position;
    body.bound.velocity = state.velocity;
  }
  const auto broken =
      broken_promise(before, body.bound, body.radius, kicked_to, bodies().definition().contact_tolerance);
  if (body.is_resting()) body.stand_still();
  return broken;
}

void Island::tell_broken(std::size_t k, const BrokenPromise& broken) {
  const std::uint32_t number = probe_ids_[k].index;
  Sphere reported = sphere(number);
  reported.state.velocity = probe_states_[k].velocity;
  instant_.announce(violation_event(time_, reported, broken));
  void_facts(number);
}

}  // namespace kinesphere
