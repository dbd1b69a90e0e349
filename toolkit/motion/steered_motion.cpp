// SteeredMotion: bodies with accelerations set by the caller.
#include "kinesphere/motion/steered_motion.hpp"

#include <utility>

#include "input/input_check.hpp"
#include "motion/body_bytes.hpp"
#include "motion/checks.hpp"

namespace kinesphere {

Result<SteeredMotion> SteeredMotion::create(SteeredMotionDefinition definition) {
  const auto check = InputCheck("SteeredMotion::create")
                         .start(definition.start, definition.start_time)
                         .acceleration_limits(definition.acceleration_limits, definition.start.size());
  if (check.error()) return *check.error();
  return SteeredMotion(std::move(definition));
}

SteeredMotion::SteeredMotion(SteeredMotionDefinition definition)
    : PiecewiseAcceleration(definition.start, definition.start_time),
      limits_(std::move(definition.acceleration_limits)),
      accelerations_(limits_.size()) {
  for (double& limit : limits_) limit *= slightly_more;
}

Result<std::uint32_t> SteeredMotion::add(double t, const State& state, double acceleration_limit) {
  InputCheck check("add");
  if (check.not_negative({"acceleration_limit"}, acceleration_limit).error()) return *check.error();
  auto body = add_body("add", t, state);
  if (!body) return body;
  keep_of(limits_, *body, slightly_more * acceleration_limit);
  keep_of(accelerations_, *body, {});
  return body;
}

Result<void> SteeredMotion::steer(std::uint32_t body, double t, const Vec3& acceleration) {
  InputCheck check("steer");
  if (const auto error = wrong_body("steer", *this, body)) return *error;
  const BodyId id{body, 0};
  check.finite({"t", id}, t)
      .finite({"acceleration", id}, acceleration)
      .require(t >= last_change(body), ErrorCode::time_backwards, {"t", id},
               "must not lie before its last change at", last_change(body), t)
      .require(norm(acceleration) <= limits_[body], ErrorCode::out_of_range, {"acceleration", id},
               "must not be longer than", limits_[body], acceleration);
  if (check.error()) return *check.error();
  restart(body, t, state(body, t));
  accelerations_[body] = acceleration;
  return {};
}

BodyDefinition SteeredMotion::definition(std::uint32_t body, double t) const {
  return definition_with(body, t, limits_);
}

Result<void> SteeredMotion::write_body(std::uint32_t body, std::vector<std::byte>& bytes) const {
  if (const auto error = wrong_body("write_body", *this, body)) return *error;
  append_body(bytes, steered_mark, origin(body), limits_[body], accelerations_[body]);
  return {};
}

Result<std::uint32_t> SteeredMotion::read_body(std::span<const std::byte>& bytes) {
  MotionOrigin last;
  double limit = 0.0;
  Vec3 acceleration;
  const auto rest = take_body(bytes, steered_mark, last, limit, acceleration);
  if (!rest) return rest.error();
  InputCheck check("SteeredMotion");
  check.finite({"acceleration"}, acceleration)
      .require(norm(acceleration) <= limit, ErrorCode::out_of_range, {"acceleration"},
               "must not be longer than", limit, acceleration);
  if (check.error()) return bad_bytes(*check.error());
  auto body = add(last.time, last.state, limit);
  if (!body) return bad_bytes(body.error());
  limits_[*body] = limit;  // Already scaled by slightly_more when the body was first added.
  accelerations_[*body] = acceleration;
  bytes = *rest;
  return body;
}

std::unique_ptr<Motion> SteeredMotion::clone() const { return std::make_unique<SteeredMotion>(*this); }

}  // namespace kinesphere
