// VelocityField: bodies that follow a velocity field.
#include "kinesphere/motion/velocity_field.hpp"

#include <algorithm>
#include <utility>

#include "input/input_check.hpp"
#include "motion/body_bytes.hpp"
#include "motion/checks.hpp"

namespace kinesphere {

Vec3 Circulation::operator()(const Vec3& position) const {
  const Vec3 half = 0.5 * (box.upper - box.lower);
  const Vec3 centre = box.lower + half;
  const double height = box.upper.z - box.lower.z;
  const double x = std::clamp((position.x - centre.x) / half.x, -1.0, 1.0);
  const double y = std::clamp((position.y - centre.y) / half.y, -1.0, 1.0);
  const double z = std::clamp((position.z - box.lower.z) / height, 0.0, 1.0);
  const double rise = 4.0 * z * (1.0 - z);
  const double rise_slope = 4.0 - 8.0 * z;
  const auto q = [](double s) { return 1.0 - 3.0 * s * s; };
  const auto q_integral = [](double s) { return s - s * s * s; };
  const double outward = -0.5 * speed * rise_slope / height;
  return {outward * half.x * q_integral(x), outward * half.y * q_integral(y),
          0.5 * speed * rise * (q(x) + q(y))};
}

Result<VelocityField> VelocityField::create(VelocityFieldDefinition definition) {
  InputCheck check("VelocityField::create");
  check.start(definition.start, definition.start_time)
      .acceleration_limits(definition.acceleration_limits, definition.start.size())
      .positive({"interval"}, definition.interval)
      .positive({"response_time"}, definition.response_time)
      .require(definition.field != nullptr, ErrorCode::out_of_range, {"field"}, "must be a function",
               std::size_t{0});
  if (check.error()) return *check.error();
  for (std::uint32_t body = 0; body < definition.start.size(); ++body) {
    check.finite({"field", {body, 0}, "at its start"}, definition.field(definition.start[body].position));
  }
  if (check.error()) return *check.error();
  return VelocityField(std::move(definition));
}

VelocityField::VelocityField(VelocityFieldDefinition definition)
    : PiecewiseAcceleration(definition.start, definition.start_time, definition.interval),
      field_(std::move(definition.field)),
      limits_(std::move(definition.acceleration_limits)),
      response_time_(definition.response_time) {}

Result<std::uint32_t> VelocityField::add(double t, const State& state, double acceleration_limit) {
  InputCheck check("add");
  if (check.not_negative({"acceleration_limit"}, acceleration_limit).error()) return *check.error();
  if (const auto error = wrong_state("add", no_body, state)) return *error;
  if (check.finite({"field"}, field_(state.position)).error()) return *check.error();
  auto body = add_body("add", t, state);
  if (body) keep_of(limits_, *body, acceleration_limit);
  return body;
}

BodyDefinition VelocityField::definition(std::uint32_t body, double t) const {
  return definition_with(body, t, limits_);
}

Result<void> VelocityField::write_body(std::uint32_t body, std::vector<std::byte>& bytes) const {
  if (const auto error = wrong_body("write_body", *this, body)) return *error;
  append_body(bytes, velocity_field_mark, origin(body), limits_[body]);
  return {};
}

Result<std::uint32_t> VelocityField::read_body(std::span<const std::byte>& bytes) {
  MotionOrigin last;
  double limit = 0.0;
  const auto rest = take_body(bytes, velocity_field_mark, last, limit);
  if (!rest) return rest.error();
  auto body = add(last.time, last.state, limit);
  if (!body) return bad_bytes(body.error());
  bytes = *rest;
  return body;
}

std::unique_ptr<Motion> VelocityField::clone() const { return std::make_unique<VelocityField>(*this); }

Vec3 VelocityField::acceleration(std::uint32_t body, std::int64_t, const State& state) const {
  const Vec3 wanted = (field_(state.position) - state.velocity) / response_time_;
  const double longest = limits_[body] * slightly_less;
  const double length = norm(wanted);
  return length <= longest ? wanted : wanted * (longest / length);
}

}  // namespace kinesphere
