// Certified predictions: checks the calls, and probes if the facet has a probe.
#include <limits>

#include "bodies/validation.hpp"
#include "input/input_check.hpp"
#include "kinesphere/certificates.hpp"
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

Result<SafeTime> World::Certificates::safe_until(BodyId first, BodyId second) const {
  const Preconditions check(*facet_.world, "safe_until");
  return safe_time(Engine::Answers::answer(
      facet_.world->engine_.get(), first_error(check.may_ask(facet_), check.pair(first, second)),
      StaleProber(facet_, "safe_until"), any_number, about_pair(first, second)));
}

Result<SafeTime> World::Certificates::safe_until(BodyId body) const {
  const Preconditions check(*facet_.world, "safe_until");
  return safe_time(Engine::Answers::answer(facet_.world->engine_.get(),
                                           first_error(check.may_ask(facet_), check.known(body)),
                                           StaleProber(facet_, "safe_until"), any_number, about_body(body)));
}

Result<SafeTime> World::Certificates::safe_until() const {
  return safe_time(Engine::Answers::answer(
      facet_.world->engine_.get(), Preconditions(*facet_.world, "safe_until").may_ask(facet_),
      StaleProber(facet_, "safe_until"), max_rounds_of_world, about_world));
}

Result<EarliestContact> World::Certificates::earliest_contact(BodyId body) const {
  const Preconditions check(*facet_.world, "earliest_contact");
  const Engine* const engine = facet_.world->engine_.get();
  return earliest<EarliestContact>(
      engine, Engine::Answers::answer(engine, first_error(check.may_ask(facet_), check.known(body)),
                                      StaleProber(facet_, "earliest_contact"), any_number, about_body(body)));
}

Result<SafeSeparation> World::Certificates::safe_until(BodyId first, BodyId second, double distance) const {
  const Preconditions check(*facet_.world, "safe_until");
  auto valid = first_error(check.may_ask(facet_), check.pair(first, second));
  if (valid) valid = check_distance(distance, facet_.world->definition(), "safe_until");
  return safe_separation(Engine::Answers::answer(facet_.world->engine_.get(), valid,
                                                 StaleProber(facet_, "safe_until"), any_number,
                                                 about_separation(first, second, distance)));
}

Result<EarliestApproach> World::Certificates::earliest_approach(BodyId body, double distance) const {
  const Preconditions check(*facet_.world, "earliest_approach");
  const Engine* const engine = facet_.world->engine_.get();
  auto valid = first_error(check.may_ask(facet_), check.known(body));
  if (valid) valid = check_distance(distance, engine->definition(), "earliest_approach");
  return earliest<EarliestApproach>(
      engine, Engine::Answers::answer(engine, valid, StaleProber(facet_, "earliest_approach"), any_number,
                                      about_approach(body, distance)));
}

Result<DistanceLimits> World::Certificates::distance_limits(BodyId first, BodyId second, double time) const {
  const Preconditions check(*facet_.world, "distance_limits");
  auto valid = first_error(check.may_ask(facet_), check.pair(first, second));
  if (valid) valid = check_not_past(time, facet_.world->time(), "distance_limits");
  if (!valid) return valid.error();
  const std::uint32_t both[] = {first.index, second.index};
  const auto probed = StaleProber(facet_, "distance_limits")(both);
  if (!probed) return probed.error();
  DistanceLimits limits = Engine::Answers(*facet_.world->engine_).distance(first.index, second.index, time);
  limits.probed = *probed;
  return limits;
}

}  // namespace kinesphere
