// RandomForces: bodies with random accelerations, constant in each interval.
#include "kinesphere/motion/random_forces.hpp"

#include <numeric>
#include <utility>

#include "input/input_check.hpp"
#include "kinesphere/random.hpp"
#include "motion/body_bytes.hpp"
#include "motion/checks.hpp"

namespace kinesphere {

Result<RandomForces> RandomForces::create(RandomForcesDefinition definition) {
  const auto check = InputCheck("RandomForces::create")
                         .start(definition.start, definition.start_time)
                         .acceleration_limits(definition.acceleration_limits, definition.start.size())
                         .positive({"interval"}, definition.interval);
  if (check.error()) return *check.error();
  return RandomForces(std::move(definition));
}

RandomForces::RandomForces(RandomForcesDefinition definition)
    : PiecewiseAcceleration(definition.start, definition.start_time, definition.interval),
      limits_(std::move(definition.acceleration_limits)),
      names_(limits_.size()),
      seed_(definition.seed) {
  std::iota(names_.begin(), names_.end(), 0u);
}

Result<std::uint32_t> RandomForces::add(double t, const State& state, double acceleration_limit) {
  InputCheck check("add");
  if (check.not_negative({"acceleration_limit"}, acceleration_limit).error()) return *check.error();
  auto body = add_body("add", t, state);
  if (!body) return body;
  keep_of(limits_, *body, acceleration_limit);
  keep_of(names_, *body, *body);
  return body;
}

BodyDefinition RandomForces::definition(std::uint32_t body, double t) const {
  return definition_with(body, t, limits_);
}

Result<void> RandomForces::write_body(std::uint32_t body, std::vector<std::byte>& bytes) const {
  if (const auto error = wrong_body("write_body", *this, body)) return *error;
  append_body(bytes, random_forces_mark, origin(body), limits_[body], names_[body]);
  return {};
}

Result<std::uint32_t> RandomForces::read_body(std::span<const std::byte>& bytes) {
  MotionOrigin last;
  double limit = 0.0;
  std::uint32_t name = 0;
  const auto rest = take_body(bytes, random_forces_mark, last, limit, name);
  if (!rest) return rest.error();
  auto body = add(last.time, last.state, limit);
  if (!body) return bad_bytes(body.error());
  names_[*body] = name;
  bytes = *rest;
  return body;
}

std::unique_ptr<Motion> RandomForces::clone() const { return std::make_unique<RandomForces>(*this); }

Vec3 RandomForces::acceleration(std::uint32_t body, std::int64_t k, const State&) const {
  const double length = limits_[body] * slightly_less;
  return length * Random::at(seed_, names_[body], static_cast<std::uint64_t>(k)).point_in_ball();
}

}  // namespace kinesphere
