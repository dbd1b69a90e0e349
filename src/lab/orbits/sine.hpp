// Sine and cosine at once, the same to the last bit on all machines.
#pragma once

#include <cmath>
#include <cstdint>

namespace kinesphere {

struct SineCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

/// Of an angle of at most 2^20 radians, to within 2^-51. Cost: about 10 ns.
inline SineCosine sine_and_cosine(double angle) {
  // pi / 2 as a sum of three parts, of which the first two have so few bits that their multiples are exact.
  constexpr double quarters = 0.63661977236758134308;
  constexpr double part1 = 1.57079632673412561417e+00;
  constexpr double part2 = 6.07710050630396597660e-11;
  constexpr double part3 = 2.02226624879595063154e-21;
  // Adding and taking away 1.5 * 2^52 rounds to a whole number.
  constexpr double rounder = 6755399441055744.0;
  const double quadrant = (angle * quarters + rounder) - rounder;
  const double x = ((angle - quadrant * part1) - quadrant * part2) - quadrant * part3;
  const double z = x * x;
  // The polynomials of fdlibm on [-pi / 4, pi / 4].
  const double sine =
      x + x * z *
              (-1.66666666666666324348e-01 +
               z * (8.33333333332248946124e-03 +
                    z * (-1.98412698298579493134e-04 +
                         z * (2.75573137070700676789e-06 +
                              z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
  const double cosine =
      1.0 - 0.5 * z +
      z * z *
          (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 +
                          z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  switch (static_cast<std::int64_t>(quadrant) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace kinesphere
