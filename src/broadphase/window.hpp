// Windows of time, in which bodies are registered. A window of length 2^rung begins and ends at multiples of
// its length, like a block time step.
#pragma once

#include <limits>
#include <span>

#include "number/infinity.hpp"

namespace kinesphere {

/// A window of length 2^rung, or the window that never ends (endless()).
struct Window {
  /// Rung that is below every window's: no window is shorter.
  static constexpr int shortest = std::numeric_limits<int>::min();
  static constexpr int longest_rung = 300;
  /// Upper limit of the ends of all windows that end: twice the length of the longest window, which is far
  /// longer than any time.
  static constexpr double latest_end = 0x1p301;

  int rung = 0;
  double end = 0.0;

  /// Returns the window of length 2^rung that contains `now`, or a longer one if double precision cannot
  /// distinguish its end from `now`.
  static Window at(double now, int rung);
  static constexpr Window endless() { return {std::numeric_limits<int>::max(), infinity}; }
  /// Returns the longest window at `now`, no longer than 2^rung, whose rung is not in `held`; a grid level
  /// that holds bodies already would have to be sorted again. Lengths 8, 64, ... times shorter are tried. If
  /// all are held, the returned window ends at `now`.
  static Window free_at(double now, int rung, std::span<const int> held);

  /// Returns the beginning of the window. Precondition: the window ends.
  double begin() const;
  /// True if a body can be registered in this window.
  bool is_valid() const;

  friend bool operator==(const Window&, const Window&) = default;
};

/// Returns the time from `now` to `end`, or 0 if `end` is +infinity: what stands still in the endless window
/// has the same extent at all times.
inline double duration_until(double end, double now) { return end < infinity ? end - now : 0.0; }

}  // namespace kinesphere
