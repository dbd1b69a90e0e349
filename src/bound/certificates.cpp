// Certified earliest times of contact, separation and exit. The method and the proof that no answer is late:
// bound.hpp.
#include "bound/relative_motion.hpp"
#include "bound/rounding.hpp"
#include "bound/safe_steps.hpp"
#include "kinesphere/bound.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Solves certificates that are one quadratic: the claim holds while c + b d + 1/2 a d^2 > 0, with d the time
/// after `from`.
double time_of_crossing(double from, double until, double c, double b, double a) {
  const double time = rounding::sum_down(from, rounding::first_crossing(c, b, a));
  if (time > until) return infinity;
  return time > from ? time : from;
}

/// Position, velocity and acceleration of a bound along one direction, advanced to time `from`.
struct Projection {
  Projection(const Bound& bound, const Vec3& normal, double from)
      : Projection(from - bound.time, dot(normal, bound.position), dot(normal, bound.velocity),
                   dot(normal, bound.planned_acceleration), bound) {
    // The terms of a dot product may cancel, so the rounding sizes come from the vectors.
    add_up(norm_one(bound.position), norm_one(bound.velocity), norm_one(bound.planned_acceleration), bound);
  }

  /// Projects on one coordinate axis.
  Projection(const Bound& bound, int axis, double from)
      : Projection(from - bound.time, bound.position[axis], bound.velocity[axis],
                   bound.planned_acceleration[axis], bound) {
    add_up(std::abs(bound.position[axis]), std::abs(bound.velocity[axis]), std::abs(acceleration), bound);
  }

  double s;
  double position, velocity, acceleration;
  double growth, growth_speed;
  double position_size = 0.0, velocity_size = 0.0, acceleration_size = 0.0;

 private:
  Projection(double elapsed, double p, double v, double a, const Bound& bound)
      : s(elapsed),
        position(p + (v + 0.5 * a * elapsed) * elapsed),
        velocity(v + a * elapsed),
        acceleration(a),
        growth((bound.growth_speed + 0.5 * bound.acceleration_limit * elapsed) * elapsed),
        growth_speed(bound.growth_speed + bound.acceleration_limit * elapsed) {}

  void add_up(double position_part, double velocity_part, double acceleration_part, const Bound& bound) {
    acceleration_size = rounding::capped(rounding::widened(acceleration_part + bound.acceleration_limit));
    velocity_size =
        rounding::capped(rounding::widened(velocity_part + bound.growth_speed) + acceleration_size * s);
    position_size = rounding::capped(rounding::widened(position_part + bound.radius) + velocity_size * s);
  }
};

/// Returns how long the centres of two bounds that go straight on and grow stay within `reach`, less the
/// growth; 0 where that is not to be seen so.
///
/// The distance of the centres and the growth are convex functions of time. So if their sum is below the
/// reach now and at the end, it is throughout: a time is guessed by Newton's method, from a later one, and
/// then tried. Two theorems: two_that_go_straight_stay_within, and separation_step_is_safe for all others.
double stays_within(const RelativeMotion& motion, double reach, double distance) {
  const double limit = motion.acceleration_limit, rate = motion.growth_speed;
  if (motion.acceleration != Vec3{} || !(limit > 0.0) || !(rate >= 0.0)) return 0.0;
  const auto is_within = [&](double d, double margin) {
    const double size = motion.size_at(d) + std::abs(distance);
    return norm(motion.centre_at(d)) + motion.growth_at(d) < reach - margin * size;
  };
  const double room = reach - motion.growth;
  // Of what is left, a small part is to be above the margin in the end.
  constexpr double early = 0x1p-22;
  if (!(room > 0.0) || !is_within(0.0, rounding::margin / early)) return 0.0;
  // When the squares of both sides are equal, but for the higher powers of time in that of what is left of
  // the reach; or when the growth alone uses that up.
  const double gap = room * room - norm_squared(motion.offset);
  const double fall = room * rate + dot(motion.offset, motion.velocity);
  const double bend = rate * rate - room * limit - norm_squared(motion.velocity);
  const double square = fall * fall - bend * gap;
  double d = 2.0 * room / (rate + std::sqrt(rate * rate + 2.0 * limit * room));
  if (square > 0.0 && fall + std::sqrt(square) > 0.0) d = std::min(d, gap / (fall + std::sqrt(square)));
  for (int step = 0; step < 3; ++step) {
    const Vec3 centre = motion.centre_at(d);
    const double length = norm(centre);
    const double slope =
        motion.growth_speed_at(d) + (length > 0.0 ? dot(centre, motion.velocity) / length : 0.0);
    d -= (length + motion.growth_at(d) - reach) / slope;
  }
  d *= 1.0 - early;
  return d > 0.0 && is_within(d, rounding::margin) ? d : 0.0;
}

}  // namespace

double earliest_meeting(const Bound& a, const Bound& b, double from, double until, double distance) {
  const RelativeMotion motion(a, b, from);
  const double reach = motion.radii + distance;
  return advance_by_safe_steps(from, until, [&](double d) {
    const Vec3 centre = motion.centre_at(d);
    // If the squared length underflows, there is no unit vector. Without one, |C(d)| >= 0 is used.
    const double measured = norm(centre);
    const double length = measured > 0x1p-500 ? measured : 0.0;
    const Vec3 n = length > 0.0 ? centre / length : Vec3{};
    const double c =
        (length - reach) - motion.growth_at(d) - rounding::margin * (motion.size_at(d) + std::abs(distance));
    const double speed = dot(n, motion.velocity_at(d)) - motion.growth_speed_at(d) -
                         rounding::margin * (motion.velocity_size + motion.acceleration_size * d);
    const double acceleration =
        dot(n, motion.acceleration) - motion.acceleration_limit - rounding::margin * motion.acceleration_size;
    return rounding::first_crossing(c, speed, acceleration);
  });
}

double earliest_separation(const Bound& a, const Bound& b, double from, double until, double distance) {
  const RelativeMotion motion(a, b, from);
  const double reach = motion.radii + distance;
  if (const double time = rounding::sum_down(from, stays_within(motion, reach, distance)); time > from)
    return time > until ? infinity : time;
  return advance_by_safe_steps(from, until, [&](double d) -> double {
    const Vec3 centre = motion.centre_at(d);
    const Vec3 velocity = motion.velocity_at(d);
    const Vec3& acceleration = motion.acceleration;
    const double size = motion.size_at(d) + std::abs(distance);
    const double velocity_size = motion.velocity_size + motion.acceleration_size * d;
    const double slack = reach - motion.growth_at(d);  // S(d)
    if (!(slack > rounding::margin * size)) return 0.0;
    const double shrinking = motion.growth_speed_at(d);  // -S'(d)
    const double alpha = motion.acceleration_limit;
    const double length = norm(centre) + rounding::margin * size;

    // p(d + e) = q0 + q1 e + q2 e^2 + q3 e^3 + q4 e^4, each coefficient lowered by its possible rounding
    // error.
    const double wrong = 4.0 * rounding::margin;
    const double q0 = (slack - length) * (slack + length) - wrong * (slack + length) * size;
    const double q1 =
        -2.0 * (slack * shrinking + dot(centre, velocity)) - wrong * (slack + length + size) * velocity_size;
    const double q2 = shrinking * shrinking - slack * alpha - norm_squared(velocity) -
                      dot(centre, acceleration) -
                      wrong * (velocity_size * velocity_size + size * motion.acceleration_size);
    const double q3 =
        shrinking * alpha - dot(velocity, acceleration) - wrong * velocity_size * motion.acceleration_size;
    const double q4 = 0.25 * (alpha * alpha - norm_squared(acceleration)) -
                      wrong * motion.acceleration_size * motion.acceleration_size;

    // Replaces the cubic and quartic terms by their minima over a range of e. The range is the one that the
    // quadratic part suggests or, if that part never reaches zero, the one in which they cannot outweigh q2.
    if (!std::isfinite(q3 + q4)) return 0.0;
    const double fall3 = std::max(0.0, -q3);
    const double fall4 = std::max(0.0, -q4);
    double range = 2.0 * rounding::first_crossing(q0, q1, 2.0 * q2);
    if (range == infinity) {
      if (fall3 == 0.0 && fall4 == 0.0) return infinity;
      const double cubic_range = fall3 > 0.0 ? 0.5 * q2 / fall3 : infinity;
      const double quartic_range = fall4 > 0.0 ? std::sqrt(0.5 * q2 / fall4) : infinity;
      range = std::min(cubic_range, quartic_range);
    }
    if (!(range < infinity)) return infinity;
    const auto step_within = [&](double reach_of_step) {
      const double higher = -(fall3 + fall4 * reach_of_step) * reach_of_step;
      return std::min(reach_of_step, rounding::first_crossing(q0, q1, 2.0 * (q2 + higher)));
    };
    const double gain = step_within(range);
    // If the quadratic part hardly falls, `range` is far too long and the step far too short. The geometric
    // mean of the two is tried as a second range.
    return std::max(gain, step_within(std::sqrt(range * gain)));
  });
}

double earliest_meeting(const Bound& bound, const HalfSpace& wall, double from, double until,
                        double distance) {
  const Projection p(bound, wall.normal, from);
  const double size = p.position_size + std::abs(wall.offset) + std::abs(distance);
  return time_of_crossing(
      from, until, (p.position - wall.offset) - bound.radius - p.growth - distance - rounding::margin * size,
      p.velocity - p.growth_speed - rounding::margin * p.velocity_size,
      p.acceleration - bound.acceleration_limit - rounding::margin * p.acceleration_size);
}

double earliest_separation(const Bound& bound, const HalfSpace& wall, double from, double until,
                           double distance) {
  const Projection p(bound, wall.normal, from);
  const double size = p.position_size + std::abs(wall.offset) + std::abs(distance);
  return time_of_crossing(
      from, until, (wall.offset - p.position) + bound.radius - p.growth + distance - rounding::margin * size,
      -p.velocity - p.growth_speed - rounding::margin * p.velocity_size,
      -p.acceleration - bound.acceleration_limit - rounding::margin * p.acceleration_size);
}

double earliest_exit(const Bound& bound, const Box& box, double from, double until) {
  const double span = until - from;
  double first = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    if (box.upper[axis] == infinity) continue;
    const Projection p(bound, axis, from);
    const double speed_margin = p.growth_speed + rounding::margin * p.velocity_size;
    const double acceleration_margin = bound.acceleration_limit + rounding::margin * p.acceleration_size;
    const auto crossing = [&](double distance, double wall, double velocity, double acceleration) {
      const double c =
          distance - bound.radius - p.growth - rounding::margin * (p.position_size + std::abs(wall));
      const double b = velocity - speed_margin;
      const double a = acceleration - acceleration_margin;
      // A concave function has its minimum at an end of the interval.
      const double left = c + (b + 0.5 * a * span) * span;
      if (a <= 0.0 && c > 0.0 && left > rounding::margin * (c + (std::abs(b) - a * span) * span))
        return infinity;
      return rounding::first_crossing(c, b, a);
    };
    first = std::min(first,
                     crossing(box.upper[axis] - p.position, box.upper[axis], -p.velocity, -p.acceleration));
    first =
        std::min(first, crossing(p.position - box.lower[axis], box.lower[axis], p.velocity, p.acceleration));
  }
  const double time = rounding::sum_down(from, first);
  if (time > until) return infinity;
  return time > from ? time : from;
}

}  // namespace kinesphere
