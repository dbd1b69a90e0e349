// Conservative advancement: repeats certified steps until they gain little.
#pragma once

#include "bound/rounding.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// Maximum number of steps. Any number is safe; more steps give later certificates for more time.
inline constexpr int most_rounds = 16;
/// Stops the iteration when a step gains less than this fraction of the total. Smaller values give slightly
/// later certificates for more steps.
inline constexpr double negligible_gain = 0x1p-24;

/// Sums up the certified steps `step(d)`, where d is the time after `from`. Returns a time >= from, or
/// +infinity if the sum exceeds `until`.
template <class SafeStep>
double advance_by_safe_steps(double from, double until, SafeStep step) {
  double d = 0.0;
  double time = from;
  for (int round = 0; round < most_rounds; ++round) {
    const double gain = step(d);
    d = rounding::sum_down(d, gain);
    time = rounding::sum_down(from, d);
    if (time > until) return infinity;
    if (!(gain > d * negligible_gain)) break;
  }
  return time > from ? time : from;
}

}  // namespace kinesphere
