// Conservative advancement: on and on by steps that are safe, until they hardly get further.
#pragma once

#include "bound/rounding.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// Any number of rounds is safe; more are only nearer to the truth.
inline constexpr int most_rounds = 16;
/// A round that gains less than this part of the whole is the last.
inline constexpr double negligible_gain = 0x1p-24;

/// Adds up the safe steps that `step(d)` offers at d after `from`. +infinity if they go beyond `until`.
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
