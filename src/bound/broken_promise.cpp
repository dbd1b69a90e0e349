#include "bound/broken_promise.hpp"

namespace kinesphere {

std::optional<BrokenPromise> broken_promise(const BodyDefinition& promise, const Bound& bound,
                                            const State& report, double time,
                                            const std::optional<Vec3>& kicked_to, double contact_tolerance) {
  const double s = time - bound.time;
  const Vec3 way = report.position - bound.centre_at(time);
  const double position_error = bound.radius - promise.radius;  // of the report before
  const double growth = bound.radius_at(time) - bound.radius;
  const double deviation_limit = growth + (position_error + promise.position_error);
  const Vec3 expected = kicked_to.value_or(bound.velocity_at(time));
  const Vec3 turn = report.velocity - expected;
  const double change_limit =
      (kicked_to ? 0.0 : bound.growth_acceleration * s) + (bound.growth_speed + promise.velocity_error);
  const double position_slack = contact_tolerance / 16.0;
  // Nearly all reports are faithful: no root for them.
  if (norm_squared(way) <= deviation_limit * deviation_limit &&
      norm_squared(turn) <= change_limit * change_limit)
    return std::nullopt;
  const double deviation = norm(way);
  const double change = norm(turn);
  const double velocity_slack = 0x1p-30 * (norm(report.velocity) + norm(expected) + change_limit);
  const bool left = deviation > deviation_limit + position_slack;
  const bool jumped = change > change_limit + velocity_slack;
  if (!left && !jumped) return std::nullopt;
  return BrokenPromise{left ? deviation - deviation_limit : 0.0, jumped ? change - change_limit : 0.0};
}

}  // namespace kinesphere
