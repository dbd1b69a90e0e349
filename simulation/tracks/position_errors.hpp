// How far the positions of recorded tracks may be off.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace kinesphere {

/// At its samples a track is off by a length at most, and between them by more: by so much for each unit of
/// time from the nearest sample or, with a limit of speed or acceleration, by what a body can do that keeps
/// it. The limits need tracks that go straight from sample to sample, without anything before and after.
struct PositionErrors {
  struct Sample {
    double time;
    double way = 0.0;  ///< the length of the straight way to the next sample
  };

  double at_samples = 0.0;  ///< length
  double growth = 0.0;      ///< length / time
  /// Infinite without such a promise; with one, `growth` does not count.
  double speed_limit = std::numeric_limits<double>::infinity(),
         acceleration_limit = std::numeric_limits<double>::infinity();
  std::vector<std::vector<Sample>> samples;  ///< by track; empty if there are no errors

  bool any() const { return !samples.empty(); }
  bool has_limits() const;
  /// Returns how far a track may be off at a time.
  double at(std::uint32_t track, double t) const;
  /// Returns the largest error of a track from `begin` to `end`, or a larger one.
  double largest(std::uint32_t track, double begin, double end) const;
  /// Returns a bound on how fast the error of a track changes from `begin` to `end`.
  double steepest(std::uint32_t track, double begin, double end) const;

 private:
  /// Returns the error `since` a sample, with `rest` left until the next one.
  double between(const Sample& sample, double since, double rest) const;
};

}  // namespace kinesphere
