// Sines, cosines and arc tangents by their series: equal on every machine, which those of the math library
// are not.
#pragma once

#include <cassert>
#include <cmath>

namespace kinesphere {

struct SineAndCosine {
  double sine;
  double cosine;
};

/// Returns sine and cosine of an angle, each within 2^-51. Precondition: -1.58 <= angle <= 1.58 (radians), or
/// NaN.
inline SineAndCosine sine_and_cosine(double angle) {
  assert(!(std::abs(angle) > 1.58));
  const double square = angle * angle;
  double sine = 1.0;
  double cosine = 1.0;
  // The terms left out are below 2^-64.
  for (int k = 22; k > 0; k -= 2) {
    sine = 1.0 - sine * (square * (1.0 / (k * (k + 1))));
    cosine = 1.0 - cosine * (square * (1.0 / (k * (k - 1))));
  }
  return {angle * sine, cosine};
}

/// Returns the angle from 0 to pi/4 (radians) with this tangent, to within 2^-50 of it. Precondition:
/// 0 <= tangent <= 1, but for rounding, or NaN.
inline double arc_tangent(double tangent) {
  assert(!(tangent < 0.0 || tangent > 1.01));
  const auto halved = [](double t) { return t / (1.0 + std::sqrt(1.0 + t * t)); };
  const double quarter = halved(halved(tangent));
  const double square = quarter * quarter;
  double sum = 0.0;
  // The terms left out are below 2^-60 of the sum.
  for (int k = 25; k > 0; k -= 2) sum = 1.0 / k - square * sum;
  return 4.0 * quarter * sum;
}

}  // namespace kinesphere
