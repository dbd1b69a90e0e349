// Bodies steered by hand.
#include "kinesphere/motion/steered.hpp"

#include <utility>

#include "input/input_check.hpp"
#include "motion/limit_rounding.hpp"

namespace kinesphere {

Result<Steered> Steered::create(SteeredDefinition definition) {
  const auto check = InputCheck("Steered::create")
                         .start(definition.start, definition.start_time)
                         .acceleration_limits(definition.acceleration_limits, definition.start.size());
  if (check.error()) return *check.error();
  return Steered(std::move(definition));
}

Steered::Steered(SteeredDefinition definition)
    : PiecewiseAcceleration(definition.start, definition.start_time),
      limits_(std::move(definition.acceleration_limits)),
      accelerations_(limits_.size()) {
  for (double& limit : limits_) limit *= slightly_more;
}

Result<void> Steered::steer(std::uint32_t body, double t, const Vec3& acceleration) {
  InputCheck check("steer");
  check.require(body < size(), ErrorCode::unknown_body, {"body"}, "must be less than", size(),
                std::size_t{body});
  if (check.error()) return *check.error();
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

BodyDefinition Steered::definition(std::uint32_t body, double t) const {
  return definition_with(body, t, limits_[body]);
}

std::unique_ptr<Motion> Steered::clone() const { return std::make_unique<Steered>(*this); }

}  // namespace kinesphere
