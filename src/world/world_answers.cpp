// World's certified answers: checks the calls, and probes if the caller provides a probe.
#include <limits>

#include "engine/validation.hpp"
#include "input/input_check.hpp"
#include "query/answers.hpp"
#include "world/preconditions.hpp"
#include "world/stale_prober.hpp"

namespace kinesphere {
namespace {

/// Maximum rounds of probing for an answer about the whole world. More rounds give later times for more
/// probes.
constexpr std::size_t max_rounds_of_world = 32;
constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

Result<void> check_not_past(double time, double now, std::string_view call) {
  return InputCheck(call)
      .finite({"time"}, time)
      .require(time >= now, ErrorCode::time_backwards, {"time"}, "must not lie before the current time", now,
               time)
      .result();
}

Result<SafeTime> safe_time(const Result<ProbedAnswer>& refined) {
  if (!refined) return refined.error();
  return SafeTime{refined->boundary.time, refined->boundary.touching, refined->probed};
}

/// Builds an EarliestContact or an EarliestApproach, which have the same fields.
template <class Earliest, class Engine>
Result<Earliest> earliest(const Engine* engine, const Result<ProbedAnswer>& refined) {
  if (!refined) return refined.error();
  const ContactBoundary& boundary = refined->boundary;
  const BodyId partner = boundary.partner ? engine->bodies().id_of(*boundary.partner) : no_body;
  return Earliest{boundary.time, partner, boundary.wall, boundary.touching, refined->probed};
}

Result<void> check_distance(double distance, const WorldDefinition& world, std::string_view call) {
  InputCheck check(call);
  return require_length(check, "distance", distance, world).result();
}

Result<SafeSeparation> safe_separation(const Result<ProbedAnswer>& refined) {
  if (!refined) return refined.error();
  return SafeSeparation{refined->boundary.time, refined->boundary.touching, refined->probed};
}

const auto about_world = [](const auto& answers) { return answers.of_world(); };

auto about_body(BodyId body) {
  return [=](const auto& answers) { return answers.of_body(body.index); };
}

auto about_pair(BodyId first, BodyId second) {
  return [=](const auto& answers) { return answers.of_pair(first.index, second.index); };
}

auto about_separation(BodyId first, BodyId second, double distance) {
  return [=](const auto& answers) { return answers.approach_of_pair(first.index, second.index, distance); };
}

auto about_approach(BodyId body, double distance) {
  return [=](const auto& answers) { return answers.approach_of_body(body.index, distance); };
}

}  // namespace

Result<SafeTime> World::safe_until(BodyId first, BodyId second) const {
  return safe_time(Engine::Answers::answer(engine_.get(),
                                           Preconditions(*this, "safe_until").pair(first, second),
                                           without_probe, any_number, about_pair(first, second)));
}

Result<SafeTime> World::safe_until(BodyId first, BodyId second, Probe probe) {
  const Preconditions check(*this, "safe_until");
  return safe_time(Engine::Answers::answer(
      engine_.get(), first_error(check.may_ask(probe), check.pair(first, second)),
      StaleProber(*this, probe, "safe_until"), any_number, about_pair(first, second)));
}

Result<SafeTime> World::safe_until(BodyId body) const {
  return safe_time(Engine::Answers::answer(engine_.get(), Preconditions(*this, "safe_until").changeable(body),
                                           without_probe, any_number, about_body(body)));
}

Result<SafeTime> World::safe_until(BodyId body, Probe probe) {
  const Preconditions check(*this, "safe_until");
  return safe_time(
      Engine::Answers::answer(engine_.get(), first_error(check.may_ask(probe), check.known(body)),
                              StaleProber(*this, probe, "safe_until"), any_number, about_body(body)));
}

Result<SafeTime> World::safe_until() const {
  return safe_time(Engine::Answers::answer(engine_.get(), Preconditions(*this, "safe_until").idle(),
                                           without_probe, max_rounds_of_world, about_world));
}

Result<SafeTime> World::safe_until(Probe probe) {
  return safe_time(Engine::Answers::answer(engine_.get(), Preconditions(*this, "safe_until").may_ask(probe),
                                           StaleProber(*this, probe, "safe_until"), max_rounds_of_world,
                                           about_world));
}

Result<EarliestContact> World::earliest_contact(BodyId body) const {
  return earliest<EarliestContact>(
      engine_.get(),
      Engine::Answers::answer(engine_.get(), Preconditions(*this, "earliest_contact").changeable(body),
                              without_probe, any_number, about_body(body)));
}

Result<EarliestContact> World::earliest_contact(BodyId body, Probe probe) {
  const Preconditions check(*this, "earliest_contact");
  return earliest<EarliestContact>(
      engine_.get(),
      Engine::Answers::answer(engine_.get(), first_error(check.may_ask(probe), check.known(body)),
                              StaleProber(*this, probe, "earliest_contact"), any_number, about_body(body)));
}

Result<SafeSeparation> World::safe_until(BodyId first, BodyId second, double distance) const {
  auto valid = Preconditions(*this, "safe_until").pair(first, second);
  if (valid) valid = check_distance(distance, definition(), "safe_until");
  return safe_separation(Engine::Answers::answer(engine_.get(), valid, without_probe, any_number,
                                                 about_separation(first, second, distance)));
}

Result<SafeSeparation> World::safe_until(BodyId first, BodyId second, double distance, Probe probe) {
  const Preconditions check(*this, "safe_until");
  auto valid = first_error(check.may_ask(probe), check.pair(first, second));
  if (valid) valid = check_distance(distance, definition(), "safe_until");
  return safe_separation(Engine::Answers::answer(engine_.get(), valid,
                                                 StaleProber(*this, probe, "safe_until"), any_number,
                                                 about_separation(first, second, distance)));
}

Result<EarliestApproach> World::earliest_approach(BodyId body, double distance) const {
  auto valid = Preconditions(*this, "earliest_approach").changeable(body);
  if (valid) valid = check_distance(distance, definition(), "earliest_approach");
  return earliest<EarliestApproach>(engine_.get(),
                                    Engine::Answers::answer(engine_.get(), valid, without_probe, any_number,
                                                            about_approach(body, distance)));
}

Result<EarliestApproach> World::earliest_approach(BodyId body, double distance, Probe probe) {
  const Preconditions check(*this, "earliest_approach");
  auto valid = first_error(check.may_ask(probe), check.known(body));
  if (valid) valid = check_distance(distance, definition(), "earliest_approach");
  return earliest<EarliestApproach>(
      engine_.get(),
      Engine::Answers::answer(engine_.get(), valid, StaleProber(*this, probe, "earliest_approach"),
                              any_number, about_approach(body, distance)));
}

Result<DistanceLimits> World::distance_limits(BodyId first, BodyId second, double time) const {
  auto valid = Preconditions(*this, "distance_limits").pair(first, second);
  if (valid) valid = check_not_past(time, engine_->time(), "distance_limits");
  if (!valid) return valid.error();
  return Engine::Answers(*engine_).distance(first.index, second.index, time);
}

Result<DistanceLimits> World::distance_limits(BodyId first, BodyId second, double time, Probe probe) {
  const Preconditions check(*this, "distance_limits");
  auto valid = first_error(check.may_ask(probe), check.pair(first, second));
  if (valid) valid = check_not_past(time, engine_->time(), "distance_limits");
  if (!valid) return valid.error();
  const std::uint32_t both[] = {first.index, second.index};
  const auto probed = refresh(both, probe, "distance_limits");
  if (!probed) return probed.error();
  DistanceLimits limits = Engine::Answers(*engine_).distance(first.index, second.index, time);
  limits.probed = probed.value();
  return limits;
}

}  // namespace kinesphere
