// Certified predictions: checks the calls, and probes if the facet has a probe.
#include <limits>

#include "bodies/validation.hpp"
#include "input/input_check.hpp"
#include "kinesphere/certificates.hpp"
#include "query/answers.hpp"
#include "world/preconditions.hpp"

namespace kinesphere {
namespace {

/// Maximum rounds of probing for an answer about the whole world. More rounds give later times for more
/// probes.
constexpr std::size_t most_rounds_of_world = 32;
constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

Result<void> check_not_past(double time, double now, std::string_view call) {
  return InputCheck(call)
      .finite({"time"}, time)
      .require(time >= now, ErrorCode::time_backwards, {"time"}, "must not lie before the current time", now,
               time)
      .result();
}

Result<void> check_distance(double distance, const WorldDefinition& world, std::string_view call) {
  InputCheck check(call);
  return require_length(check, "distance", distance, world).result();
}

}  // namespace

/// Returns ask(Answers) as an Answer, which has the fields of an EarliestContact or of a SafeTime. With a
/// probe, the bodies that limit the answer are probed and `ask` is repeated, until their reports are fresh or
/// after `max_rounds`, which is safe but less sharp. If `valid` is an error, it is returned, and the world
/// may have been moved from.
template <class Answer, class Ask>
Result<Answer> World::Certificates::answer(std::string_view call, const Result<void>& valid,
                                           std::size_t max_rounds, Ask ask) const {
  if (!valid) return valid.error();
  const Engine& engine = *facet_.world->engine_;
  if (auto stands = check_no_shear(engine.definition(), call); !stands) return stands.error();
  ContactBoundary boundary = ask(Engine::Answers(engine));
  bool is_probed = false;
  for (std::size_t round = 0; round < max_rounds; ++round) {
    const auto probed = facet_.refresh(Engine::Answers::concerned(boundary), call);
    if (!probed) return probed.error();
    if (!*probed) break;
    boundary = ask(Engine::Answers(engine));
    is_probed = true;
  }
  if constexpr (requires(Answer with) { with.partner; }) {
    const BodyId partner = boundary.partner ? engine.bodies().id_of(*boundary.partner) : no_body;
    return Answer{boundary.time, partner, boundary.wall, boundary.touching, is_probed};
  } else {
    return Answer{boundary.time, boundary.touching, is_probed};
  }
}

Result<SafeTime> World::Certificates::safe_until(BodyId first, BodyId second) const {
  const Preconditions check(*facet_.world, "safe_until");
  return answer<SafeTime>("safe_until", first_error(check.may_ask(facet_), check.pair(first, second)),
                          any_number,
                          [=](const auto& answers) { return answers.of_pair(first.index, second.index); });
}

Result<SafeTime> World::Certificates::safe_until(BodyId body) const {
  const Preconditions check(*facet_.world, "safe_until");
  return answer<SafeTime>("safe_until", first_error(check.may_ask(facet_), check.known(body)), any_number,
                          [=](const auto& answers) { return answers.of_body(body.index); });
}

Result<SafeTime> World::Certificates::safe_until() const {
  return answer<SafeTime>("safe_until", Preconditions(*facet_.world, "safe_until").may_ask(facet_),
                          most_rounds_of_world, [](const auto& answers) { return answers.of_world(); });
}

Result<EarliestContact> World::Certificates::earliest_contact(BodyId body) const {
  const Preconditions check(*facet_.world, "earliest_contact");
  return answer<EarliestContact>("earliest_contact", first_error(check.may_ask(facet_), check.known(body)),
                                 any_number,
                                 [=](const auto& answers) { return answers.of_body(body.index); });
}

Result<SafeSeparation> World::Certificates::safe_until(BodyId first, BodyId second, double distance) const {
  const Preconditions check(*facet_.world, "safe_until");
  auto valid = first_error(check.may_ask(facet_), check.pair(first, second));
  if (valid) valid = check_distance(distance, facet_.world->definition(), "safe_until");
  return answer<SafeSeparation>("safe_until", valid, any_number, [=](const auto& answers) {
    return answers.approach_of_pair(first.index, second.index, distance);
  });
}

Result<EarliestApproach> World::Certificates::earliest_approach(BodyId body, double distance) const {
  const Preconditions check(*facet_.world, "earliest_approach");
  auto valid = first_error(check.may_ask(facet_), check.known(body));
  if (valid) valid = check_distance(distance, facet_.world->definition(), "earliest_approach");
  return answer<EarliestApproach>("earliest_approach", valid, any_number, [=](const auto& answers) {
    return answers.approach_of_body(body.index, distance);
  });
}

Result<DistanceLimits> World::Certificates::distance_limits(BodyId first, BodyId second, double time) const {
  const Preconditions check(*facet_.world, "distance_limits");
  auto valid = first_error(check.may_ask(facet_), check.pair(first, second));
  if (valid) valid = check_no_shear(facet_.world->definition(), "distance_limits");
  if (valid) valid = check_not_past(time, facet_.world->time(), "distance_limits");
  if (!valid) return valid.error();
  const std::uint32_t both[] = {first.index, second.index};
  const auto probed = facet_.refresh(both, "distance_limits");
  if (!probed) return probed.error();
  DistanceLimits limits = Engine::Answers(*facet_.world->engine_).distance(first.index, second.index, time);
  limits.probed = *probed;
  return limits;
}

}  // namespace kinesphere
