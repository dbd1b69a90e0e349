// The coefficients of eq 10, and its closed solution after Ferrari and Cardano.
#include "bound/quartic.hpp"

#include <algorithm>
#include <numbers>

#include "bound/relative_motion.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

using RealRoots = polynomial::Roots<double>;

/// Of c + b x + a x^2, a != 0.
RealRoots quadratic_roots(double c, double b, double a) {
  RealRoots roots;
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) return roots;
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  roots.add(q / a);
  roots.add(q == 0.0 ? 0.0 : c / q);
  return roots;
}

/// Of d + c x + b x^2 + x^3, by Cardano, or by angles where there are three. The greatest comes first.
RealRoots cubic_roots(double d, double c, double b) {
  RealRoots roots;
  const double q = (b * b - 3.0 * c) / 9.0;
  const double r = (b * (2.0 * b * b - 9.0 * c) + 27.0 * d) / 54.0;
  const double shift = b / 3.0;
  if (r * r < q * q * q) {
    const double angle = std::acos(std::clamp(r / std::sqrt(q * q * q), -1.0, 1.0));
    for (const double turn : {1.0, -1.0, 0.0})
      roots.add(-2.0 * std::sqrt(q) * std::cos((angle + 2.0 * std::numbers::pi * turn) / 3.0) - shift);
  } else {
    const double s = -std::copysign(std::cbrt(std::abs(r) + std::sqrt(r * r - q * q * q)), r);
    roots.add(s + (s == 0.0 ? 0.0 : q / s) - shift);
  }
  return roots;
}

/// Of d + c x + b x^2 + a x^3 + x^4: with x = y - a / 4 and a root m > 0 of the resolvent
///   y^4 + p y^2 + q y + r = (y^2 + p/2 + m)^2 - (sqrt(2m) y - q / (2 sqrt(2m)))^2.
RealRoots quartic_roots(double d, double c, double b, double a) {
  const double p = b - 0.375 * a * a;
  const double q = c - 0.5 * a * b + 0.125 * a * a * a;
  const double r = d - 0.25 * a * c + 0.0625 * a * a * b - 3.0 / 256.0 * a * a * a * a;
  const double m = cubic_roots(-0.125 * q * q, 0.25 * p * p - r, p).at[0];
  RealRoots roots;
  const auto add_all = [&](const RealRoots& ys) {
    for (std::size_t k = 0; k < ys.count; ++k) roots.add(ys.at[k] - 0.25 * a);
  };
  if (m > 0.0) {
    const double s = std::sqrt(2.0 * m);
    for (const double sign : {s, -s}) add_all(quadratic_roots(0.5 * p + m - 0.5 * q / sign, sign, 1.0));
  } else {
    for (const double square : quadratic_roots(r, p, 1.0).at) {
      if (!(square > 0.0)) continue;
      add_all({{std::sqrt(square), -std::sqrt(square)}, 2});
    }
  }
  return roots;
}

RealRoots real_roots(const Quartic& c) {
  if (c[4] != 0.0) return quartic_roots(c[0] / c[4], c[1] / c[4], c[2] / c[4], c[3] / c[4]);
  if (c[3] != 0.0) return cubic_roots(c[0] / c[3], c[1] / c[3], c[2] / c[3]);
  if (c[2] != 0.0) return quadratic_roots(c[0], c[1], c[2]);
  RealRoots roots;
  if (c[1] != 0.0) roots.add(-c[0] / c[1]);
  return roots;
}

/// The time that is `d` after `from`, unless that is after `until`.
double time_after(double from, double d, double until) {
  const double time = from + d;
  return time <= until ? time : infinity;
}

}  // namespace

Quartic meeting_quartic(const Bound& a, const Bound& b, double from, double distance) {
  const RelativeMotion motion(a, b, from);
  const double reach = motion.radii + motion.growth + distance;
  const double growth = motion.growth_speed;
  const double growth_acceleration = motion.growth_acceleration;
  return {norm_squared(motion.offset) - reach * reach,
          2.0 * (dot(motion.offset, motion.velocity) - reach * growth),
          norm_squared(motion.velocity) + dot(motion.offset, motion.acceleration) - growth * growth -
              reach * growth_acceleration,
          dot(motion.velocity, motion.acceleration) - growth * growth_acceleration,
          0.25 * (norm_squared(motion.acceleration) - growth_acceleration * growth_acceleration)};
}

double first_root_numeric(const Quartic& quartic, double end) { return polynomial::first_root(quartic, end); }

double first_root_closed_form(const Quartic& quartic) {
  if (!(quartic[0] > 0.0)) return 0.0;
  const RealRoots roots = real_roots(quartic);
  double first = infinity;
  for (std::size_t k = 0; k < roots.count; ++k)
    if (roots.at[k] > 0.0) first = std::min(first, roots.at[k]);
  return first;
}

double meeting_time_numeric(const Bound& a, const Bound& b, double from, double until, double distance) {
  return time_after(from, first_root_numeric(meeting_quartic(a, b, from, distance), until - from), until);
}

double meeting_time_closed_form(const Bound& a, const Bound& b, double from, double until, double distance) {
  return time_after(from, first_root_closed_form(meeting_quartic(a, b, from, distance)), until);
}

}  // namespace kinesphere
