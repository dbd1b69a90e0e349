// Slow twins of the functions of kinesphere/bound.hpp in quadruple precision: certificates without rounding
// and without an early stop. Times are absolute; +infinity means "not up to the horizon".
#pragma once

#include "kinesphere/bound.hpp"
#include "support/exact_polynomial.hpp"

namespace kinesphere::exact {

/// A bound seen from time `from`: its centre and growth as polynomials of the time since.
struct Course {
  std::array<Polynomial, 3> centre;
  Polynomial growth;

  Course(const Bound& bound, double from) {
    const Wide s = Wide(from) - Wide(bound.time);
    const auto moved = [s](Wide position, Wide velocity, Wide acceleration) {
      return Polynomial{{position, velocity, acceleration / 2}}.from(s);
    };
    for (int axis = 0; axis < 3; ++axis)
      centre[static_cast<std::size_t>(axis)] =
          moved(bound.position[axis], bound.velocity[axis], bound.planned_acceleration[axis]);
    growth = moved(0, bound.growth_speed, bound.acceleration_limit);
  }
};

inline Polynomial constant(Wide value) { return {{value}}; }

/// |centre of a - centre of b|^2 from time `from` on.
inline Polynomial squared_distance(const Course& a, const Course& b) {
  Polynomial sum;
  for (std::size_t axis = 0; axis < 3; ++axis) sum = sum + squared(a.centre[axis] - b.centre[axis]);
  return sum;
}

inline Wide certified_until(const Polynomial& positive, double from, double horizon) {
  return Wide(from) + first_zero(positive, Wide(horizon) - Wide(from));
}

/// `extra` is added to the distance, in full precision.
inline Wide earliest_meeting(const Bound& a, const Bound& b, double from, double horizon, double distance,
                             Wide extra = 0) {
  const Course course_a(a, from), course_b(b, from);
  const Polynomial reach =
      course_a.growth + course_b.growth + constant(Wide(a.radius) + b.radius + distance + extra);
  // While the reach is negative nothing is within it, whatever the squares say.
  const Wide end = Wide(horizon) - Wide(from);
  const Wide start = reach.c[0] < 0 ? first_zero(-reach, end) : Wide(0);
  if (start > end) return infinity;
  const Polynomial apart = squared_distance(course_a, course_b) - squared(reach);
  return Wide(from) + start + first_zero(apart.from(start), end - start);
}

inline Wide earliest_separation(const Bound& a, const Bound& b, double from, double horizon, double distance,
                                Wide extra = 0) {
  const Course course_a(a, from), course_b(b, from);
  const Polynomial slack =
      constant(Wide(a.radius) + b.radius + distance + extra) - course_a.growth - course_b.growth;
  // The certificate ends with the slack; for coincident centres the difference only touches zero there.
  const Polynomial within = squared(slack) - squared_distance(course_a, course_b);
  return min(certified_until(slack, from, horizon), certified_until(within, from, horizon));
}

/// Returns normal . centre - offset.
inline Polynomial height(const Course& course, const HalfSpace& wall) {
  Polynomial sum = constant(-Wide(wall.offset));
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t k = 0; k < 3; ++k)
      sum.c[k] += Wide(wall.normal[axis]) * course.centre[static_cast<std::size_t>(axis)].c[k];
  return sum;
}

inline Wide earliest_meeting(const Bound& bound, const HalfSpace& wall, double from, double horizon,
                             double distance, Wide extra = 0) {
  const Course course(bound, from);
  const Polynomial reach = course.growth + constant(Wide(bound.radius) + distance + extra);
  return certified_until(height(course, wall) - reach, from, horizon);
}

inline Wide earliest_separation(const Bound& bound, const HalfSpace& wall, double from, double horizon,
                                double distance, Wide extra = 0) {
  const Course course(bound, from);
  const Polynomial slack = constant(Wide(bound.radius) + distance + extra) - course.growth;
  return certified_until(slack - height(course, wall), from, horizon);
}

/// `extra` is added to the bound's radius.
inline Wide earliest_exit(const Bound& bound, const Box& box, double from, double horizon, Wide extra = 0) {
  const Course course(bound, from);
  const Polynomial reach = course.growth + constant(Wide(bound.radius) + extra);
  Wide first = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    const Polynomial& x = course.centre[static_cast<std::size_t>(axis)];
    first = min(first, certified_until(constant(box.upper[axis]) - x - reach, from, horizon));
    first = min(first, certified_until(x - constant(box.lower[axis]) - reach, from, horizon));
  }
  return first;
}

/// Returns the greatest coordinate that the bound reaches on one axis during [from, to]; the least for sign =
/// -1.
inline Wide farthest(const Bound& bound, int axis, int sign, double from, double to) {
  const Course course(bound, from);
  Polynomial edge = course.growth + constant(bound.radius);
  const Polynomial& x = course.centre[static_cast<std::size_t>(axis)];
  edge = sign > 0 ? edge + x : edge - x;
  const Wide end = Wide(to) - Wide(from);
  Wide greatest = max(edge.c[0], edge.at(end));
  if (edge.c[2] < 0) {
    const Wide vertex = -edge.c[1] / (2 * edge.c[2]);
    if (vertex > 0 && vertex < end) greatest = max(greatest, edge.at(vertex));
  }
  return sign > 0 ? greatest : -greatest;
}

struct Gaps {
  Wide lower;
  Wide upper;
};

inline Gaps gap_limits(const Bound& a, const Bound& b, double t) {
  const Course course_a(a, t), course_b(b, t);
  const Wide gap = sqrt(squared_distance(course_a, course_b).c[0]) - a.radius - b.radius;
  const Wide growth = course_a.growth.c[0] + course_b.growth.c[0];
  return {gap - growth, gap + growth};
}

inline Gaps gap_limits(const Bound& bound, const HalfSpace& wall, double t) {
  const Course course(bound, t);
  const Wide gap = height(course, wall).c[0] - bound.radius;
  return {gap - course.growth.c[0], gap + course.growth.c[0]};
}

}  // namespace kinesphere::exact
