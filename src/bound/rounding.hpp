// Conservative rounding without changing the rounding mode. The method: bound.hpp.
#pragma once

#include <cmath>
#include <limits>

#include "kinesphere/limits.hpp"

namespace kinesphere::rounding {

/// Relative margin, 2^-47 = 64 unit roundoffs: exceeds all rounding errors in one coefficient. A larger
/// margin would make certificates shorter.
inline constexpr double margin = 0x1p-47;

/// Widens a sum of magnitudes by what products may lose to underflow. Zero stays zero, as products with zero
/// are exact.
inline double widened(double size) { return size + (size > 0.0 ? limits::least_size : 0.0); }

/// Returns the size unchanged, or +infinity if products of two such sizes might overflow.
inline double capped(double size) {
  return size <= limits::largest_size ? size : std::numeric_limits<double>::infinity();
}

/// Lower bound of the exact sum a + b; NaN if the sum of two finite numbers overflows.
inline double sum_down(double a, double b) {
  const double sum = a + b;
  if (std::isinf(a) || std::isinf(b)) return sum;
  return sum - std::abs(sum) * 0x1p-52;
}

/// Upper bound of the exact sum a + b.
inline double sum_up(double a, double b) { return -sum_down(-a, -b); }

/// Lower bound of the first d >= 0 with c + b d + 1/2 a d^2 <= 0. Returns +infinity if there certainly is
/// none. Returns 0 if c <= 0, if an intermediate value is not finite, or if c or the root is so small that
/// its margin underflows. The coefficients are taken as exact: the caller has lowered them by their possible
/// errors. An infinite c is permitted.
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
