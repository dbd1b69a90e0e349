#include "research/rivals/event_driven/crossing.hpp"

#include <algorithm>
#include <cmath>

#include "bound/rounding.hpp"
#include "contact/contact_predictor.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

constexpr double margin = rounding::margin;

/// Returns an upper bound of the last d >= 0 at which c + b d + 1/2 a d^2 rises through 0: 0 if it is
/// positive already and stays so, +infinity if it never rises again. Counterpart of rounding::first_crossing.
double last_rise(double c, double b, double a) {
  if (c >= 0.0 && b >= 0.0) return 0.0;
  if (b <= 0.0 && a <= 0.0) return infinity;
  const double product = 2.0 * a * c;
  const double error = margin * (b * b + std::abs(product)) + std::numeric_limits<double>::min();
  double root;
  if (b > 0.0) {
    const double discriminant = (b * b - product) - error;
    if (discriminant < 0.0) return infinity;
    root = -2.0 * c / (b + std::sqrt(discriminant));
  } else {
    const double discriminant = (b * b - product) + error;
    if (discriminant < 0.0) return 0.0;
    root = (std::sqrt(discriminant) - b) / a;
  }
  return root + root * margin;
}

}  // namespace

MovingSide::MovingSide(const Bound& bound, int axis, bool upper, double from)
    : from_(from), sign_(upper ? 1.0 : -1.0) {
  const double s = from - bound.time;
  const double a = sign_ * bound.planned_acceleration[axis];
  const double v = sign_ * bound.velocity[axis];
  const double acceleration_size = std::abs(a) + bound.acceleration_limit;
  const double speed_size = std::abs(v) + bound.growth_speed + acceleration_size * s;
  position_size_ = std::abs(bound.position[axis]) + bound.radius + speed_size * s;
  acceleration_ = (a + bound.acceleration_limit) + margin * acceleration_size;
  speed_ = (v + a * s) + (bound.growth_speed + bound.acceleration_limit * s) + margin * speed_size;
  position_ = sign_ * bound.position[axis] + (v + 0.5 * a * s) * s + bound.radius +
              (bound.growth_speed + 0.5 * bound.acceleration_limit * s) * s;
}

/// Returns a lower bound of the distance to the plane.
double MovingSide::room_to(double plane) const {
  return (sign_ * plane - position_) - margin * (position_size_ + std::abs(plane));
}

double MovingSide::earliest_entering(double plane, double horizon) const {
  if (std::isinf(plane)) return infinity;
  const double d = rounding::first_crossing(room_to(plane), -speed_, -acceleration_);
  const double time = rounding::sum_down(from_, d);
  if (time > horizon) return infinity;
  return time > from_ ? time : from_;
}

double MovingSide::latest_leaving(double plane, double horizon) const {
  // The bound must have parted by more than the margin of entering, or it would enter again at once.
  const double gap = room_to(plane) - 2.0 * margin * (position_size_ + std::abs(plane));
  const double d = last_rise(gap, -speed_, -acceleration_);
  const double time = std::max(rounding::sum_up(from_, d), just_after(from_));
  return time <= horizon ? time : infinity;
}

double outgrowing_time(const Bound& bound, double edge) {
  constexpr double sliver = 0x1p-10;
  const double margin = 0.5 * edge * (1.0 - sliver) - bound.radius;
  if (!(margin > 0.0)) return bound.time;
  const double speed = bound.growth_speed;
  const double s =
      2.0 * margin / (speed + std::sqrt(speed * speed + 2.0 * bound.acceleration_limit * margin));
  return bound.time + s;
}

}  // namespace kinesphere
