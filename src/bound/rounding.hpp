// Rounding to the safe side without changing the rounding mode. bound.hpp explains the method.
#pragma once

#include <cmath>
#include <limits>

#include "kinesphere/limits.hpp"

namespace kinesphere::rounding {

/// Relative margin, 2^-47 = 64 unit roundoffs: more than all the roundings behind one coefficient.
inline constexpr double margin = 0x1p-47;

/// A sum of magnitudes, from which margins will be taken, with room for what products lose to underflow. Zero
/// stays zero, as nothing is lost where there is nothing.
inline double widened(double size) { return size + (size > 0.0 ? limits::least_size : 0.0); }

/// The same sum; +infinity where products of two of its kind might overflow.
inline double capped(double size) {
  return size <= limits::largest_size ? size : std::numeric_limits<double>::infinity();
}

/// A lower bound of the exact sum a + b; NaN where the sum of two finite numbers overflows.
inline double sum_down(double a, double b) {
  const double sum = a + b;
  if (std::isinf(a) || std::isinf(b)) return sum;
  return sum - std::abs(sum) * 0x1p-52;
}

/// An upper bound of the exact sum a + b.
inline double sum_up(double a, double b) { return -sum_down(-a, -b); }

/// Lower bound of the first d >= 0 with c + b d + 1/2 a d^2 <= 0: +infinity when there certainly is none,
/// and 0 when c is not above zero, a number on the way is not finite, or c or the root is so small that its
/// margin underflows. The coefficients are taken as they are: the caller has lowered them by what they may be
/// wrong. An infinite c is as good as any.
inline double first_crossing(double c, double b, double a) {
  // Underflow is an absolute error, which the relative margin does not cover.
  constexpr double underflow = std::numeric_limits<double>::min();
  constexpr double least = underflow / margin;
  if (!(c > least)) return 0.0;
  if (b >= 0.0 && a >= 0.0)
    return b + a < std::numeric_limits<double>::infinity() ? std::numeric_limits<double>::infinity() : 0.0;
  const double product = 2.0 * a * c;
  double root;
  if (b >= 0.0) {
    const double discriminant = (b * b - product) - underflow;
    root = (b + std::sqrt(discriminant > 0.0 ? discriminant : 0.0)) / -a;
  } else {
    const double discriminant = (b * b - product) + (margin * (b * b + std::abs(product)) + underflow);
    if (discriminant < 0.0) return std::numeric_limits<double>::infinity();
    root = 2.0 * c / (std::sqrt(discriminant) - b);
  }
  root -= root * margin;
  return root > least ? root : 0.0;
}

}  // namespace kinesphere::rounding
