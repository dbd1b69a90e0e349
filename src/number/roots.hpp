// Roots that no correctly rounded function of the standard library gives.
#pragma once

#include <algorithm>

namespace kinesphere {

/// Returns the cube root, by Newton's method from above. Unlike std::cbrt it gives the same bits on every
/// machine. Precondition: value > 0, and finite. Cost: about 6 steps, and 4 more for each power of ten
/// beyond 1.
inline double cube_root(double value) {
  double root = std::max(value, 1.0);
  for (;;) {
    const double next = (2.0 * root + value / (root * root)) / 3.0;
    if (!(next < root)) return root;
    root = next;
  }
}

}  // namespace kinesphere
