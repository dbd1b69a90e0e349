// How far the positions of recorded tracks may be off.
#pragma once

#include <cstdint>
#include <vector>

namespace kinesphere {

/// At its samples a track is off by a length at most, and between them by more: so much for each unit of time
/// from the nearest sample.
struct PositionErrors {
  double at_samples = 0.0;                   ///< length
  double growth = 0.0;                       ///< length / time
  std::vector<std::vector<double>> samples;  ///< times, by track; empty if there are no errors

  bool any() const { return !samples.empty(); }
  /// Returns how far a track may be off at a time.
  double at(std::uint32_t track, double t) const;
  /// Returns the largest error of a track from `begin` to `end`.
  double largest(std::uint32_t track, double begin, double end) const;
};

}  // namespace kinesphere
