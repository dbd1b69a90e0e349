// The exponential function and the logarithm by their series: equal on every machine, which those of the math
// library are not.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "number/infinity.hpp"

namespace kinesphere {

/// Returns exp(x) - 1, to within 2^-50 of it; infinity from 710 on. NaN for NaN.
inline double exponential_less_one(double x) {
  if (!(std::abs(x) < 800.0)) return x > 0.0 ? infinity : x < 0.0 ? -1.0 : x;
  // exp(x) is 2^k exp(rest), and the natural logarithm of 2 is high + low, of which k high is exact.
  constexpr double high = 0x1.62e42fefap-1, low = 0x1.cf79abc9e3b39p-40;
  const double k = std::abs(x) < 0.3 ? 0.0 : std::floor(x / std::numbers::ln2 + 0.5);
  const double rest = (x - k * high) - k * low;
  // The terms left out are below 2^-60 of the sum.
  double sum = 1.0;
  for (int n = 16; n > 1; --n) sum = 1.0 + sum * (rest / n);
  return k == 0.0 ? rest * sum : std::ldexp(1.0 + rest * sum, static_cast<int>(k)) - 1.0;
}

/// Returns log(1 + x), to within 2^-50 of it; -infinity for -1, NaN for less.
inline double logarithm_of_one_and(double x) {
  if (!(x < infinity)) return x;
  if (x <= -1.0) return x == -1.0 ? -infinity : std::numeric_limits<double>::quiet_NaN();
  // The logarithm of (1 + s) / (1 - s); the terms left out are below 2^-60 of the sum.
  const auto series = [](double s) {
    double sum = 0.0;
    for (int n = 25; n > 0; n -= 2) sum = 1.0 / n + s * s * sum;
    return 2.0 * s * sum;
  };
  if (std::abs(x) < 0.3) return series(x / (2.0 + x));
  int exponent = 0;
  double part = std::frexp(1.0 + x, &exponent);
  if (part < 0.5 * std::numbers::sqrt2) {
    part *= 2.0;
    --exponent;
  }
  return exponent * std::numbers::ln2 + series((part - 1.0) / (part + 1.0));
}

}  // namespace kinesphere
