#include "bound/bound_violation.hpp"

#include <algorithm>

namespace kinesphere {

std::optional<BoundViolation> bound_violation(const Bound& before, const Bound& after, double radius,
                                              const std::optional<Vec3>& new_velocity,
                                              double contact_tolerance, double speed_of_terms) {
  const double s = after.time - before.time;
  const Vec3 way = after.position - before.centre_at(after.time);
  const double position_errors = (before.radius - radius) + (after.radius - radius);
  const double deviation_limit = before.radius_at(after.time) - before.radius + position_errors;
  const Vec3 expected = new_velocity.value_or(before.velocity_at(after.time));
  const Vec3 turn = after.velocity - expected;
  const double change_limit =
      (new_velocity ? 0.0 : before.acceleration_limit * s) + (before.growth_speed + after.growth_speed);
  const double position_slack = contact_tolerance / 16.0;
  const double deviation = norm(way);
  const double change = norm(turn);
  // At the top of a throw the expected velocity is the difference of two larger ones.
  const double expected_terms =
      new_velocity ? norm(*new_velocity) : norm(before.velocity) + norm(before.planned_acceleration) * s;
  const double velocity_slack =
      0x1p-30 * (norm(after.velocity) + expected_terms + change_limit + speed_of_terms);
  bool left = deviation > deviation_limit + position_slack;
  bool jumped = change > change_limit + velocity_slack;
  if (!left && !jumped) return std::nullopt;
  // Only what has passed the other margins needs these, which are zero around time 0.
  const double rounding = time_rounding(before.time, after.time);
  const double acceleration = norm(before.planned_acceleration) + before.acceleration_limit;
  const double speed = norm(before.velocity) + before.growth_speed + acceleration * s;
  left = left && deviation > deviation_limit + position_slack + rounding * speed;
  jumped = jumped && change > change_limit + velocity_slack + rounding * acceleration;
  if (!left && !jumped) return std::nullopt;
  return BoundViolation{left ? deviation - deviation_limit : 0.0, jumped ? change - change_limit : 0.0};
}

double observed_acceleration(const Bound& before, const Bound& after, double radius,
                             double contact_tolerance) {
  const double s = after.time - before.time;
  const Vec3 turn = after.velocity - before.velocity_at(after.time);
  const double change = norm(turn) - (before.growth_speed + after.growth_speed);
  if (!(s > 0.0) || !(change > 0.0)) return 0.0;
  const double errors = (before.radius - radius) + (after.radius - radius) + before.growth_speed * s;
  const double along = dot(after.position - before.centre_at(after.time), turn) / norm(turn) - errors;
  if (!(along > 0.0)) return 0.0;
  const double observed =
      std::min({2.0 * along / (s * s), change / s, 8.0 * change * change / contact_tolerance});
  return (1.0 + 0x1p-6) * observed;
}

}  // namespace kinesphere
