// Ballistic: bodies in free flight under a common gravity.
#include "kinesphere/motion/ballistic.hpp"

#include "input/input_check.hpp"
#include "motion/body_bytes.hpp"
#include "motion/checks.hpp"

namespace kinesphere {

Result<Ballistic> Ballistic::create(const BallisticDefinition& definition) {
  const auto check = InputCheck("Ballistic::create")
                         .start(definition.start, definition.start_time)
                         .finite({"gravity"}, definition.gravity);
  if (check.error()) return *check.error();
  return Ballistic(definition);
}

Ballistic::Ballistic(const BallisticDefinition& definition)
    : PiecewiseAcceleration(definition.start, definition.start_time), gravity_(definition.gravity) {}

BodyDefinition Ballistic::definition(std::uint32_t body, double t) const {
  return definition_with(body, t, 0.0, gravity_);
}

Result<void> Ballistic::write_body(std::uint32_t body, std::vector<std::byte>& bytes) const {
  if (const auto error = wrong_body("write_body", *this, body)) return *error;
  append_body(bytes, ballistic_mark, origin(body));
  return {};
}

Result<std::uint32_t> Ballistic::read_body(std::span<const std::byte>& bytes) {
  MotionOrigin last;
  const auto rest = take_body(bytes, ballistic_mark, last);
  if (!rest) return rest.error();
  auto body = add(last.time, last.state);
  if (!body) return bad_bytes(body.error());
  bytes = *rest;
  return body;
}

std::unique_ptr<Motion> Ballistic::clone() const { return std::make_unique<Ballistic>(*this); }

}  // namespace kinesphere
