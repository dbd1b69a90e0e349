// Windows of time, in which bodies are registered: they begin and end at the multiples of their lengths.
#pragma once

#include <limits>
#include <span>

#include "number/infinity.hpp"

namespace kinesphere {

/// One of the windows of length 2^tier, or the one that never ends.
struct Window {
  /// A tier that no window is shorter than.
  static constexpr int shortest = std::numeric_limits<int>::min();
  static constexpr int longest_rung = 300;
  /// No window that ends does so later: twice the length of the longest one, which is far longer than any
  /// time.
  static constexpr double latest_end = 0x1p301;

  int rung = 0;
  double end = 0.0;

  /// The window of length 2^tier at a time, or a longer one where numbers cannot tell its end from now.
  static Window at(double now, int rung);
  static constexpr Window endless() { return {std::numeric_limits<int>::max(), infinity}; }
  /// The longest window, no longer than 2^tier, whose tier is none of these: a layer in which others are
  /// already would have to be sorted anew. Windows that are 8, 64, ... times shorter are tried. Where there
  /// is none, the window returned ends now.
  static Window free_at(double now, int rung, std::span<const int> held);

  /// Of one that ends.
  double begin() const;
  /// True for what can be a window of a body.
  bool is_valid() const;

  friend bool operator==(const Window&, const Window&) = default;
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [power, until] = self;
    archive(power, until);
  }
};

/// From now until a window ends. What stands still in one that never ends is as large as it is, for however
/// long: then 0.
inline double duration_until(double end, double now) { return end < infinity ? end - now : 0.0; }

}  // namespace kinesphere
