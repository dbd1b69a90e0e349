// RecordedTracks: motion along a smooth curve through samples of positions.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "kinesphere/motion/piecewise_motion.hpp"

namespace kinesphere {

/// Position (length) of a body at one time.
struct TrackSample {
  double time = 0.0;
  Vec3 position;

  friend constexpr bool operator==(const TrackSample&, const TrackSample&) = default;
};

/// The samples of one body, in the order of their times.
using Track = std::vector<TrackSample>;

/// Where a body is before its first and after its last sample, of which nothing is known.
enum class Outside : std::uint8_t {
  go_on,  ///< it goes straight on with the velocity of that sample
  stay,  ///< it stays at that sample: its curve begins and ends at rest, which bends its first and last steps
  /// It is not there. Remove it from its world at the latest at last_time(), and add it no earlier than at
  /// first_time(): a question about another time is an error.
  vanish,
};

/// The ends of a curve at which the body is at rest.
struct RestingEnds {
  bool first = false, last = false;
};

/// Each body follows the cubic spline through its samples: the smooth curve through them with the least
/// integral of |acceleration|^2. It has zero acceleration at its two ends (a natural spline), or zero
/// velocity where the body rests. Its acceleration limit is the exact maximum of that curve.
class RecordedTracks final : public PiecewiseMotion {
 public:
  /// Creates one body for each track. Errors, naming body and sample: out_of_range for fewer than 2
  /// samples, for times that do not increase, and for numbers so large that the curve overflows;
  /// not_finite. With Outside::vanish, calls that take a time also have the error out_of_range for times
  /// before the body's first sample or after its last. Cost: O(samples).
  static Result<RecordedTracks> create(const std::vector<Track>& tracks, Outside outside = Outside::go_on);
  /// Creates bodies that go on straight at the ends where they do not rest. Errors: as above; out_of_range
  /// unless there are ends for each track.
  static Result<RecordedTracks> create(const std::vector<Track>& tracks,
                                       const std::vector<RestingEnds>& ends);

  /// Returns what create() was given; go_on if it was given ends.
  Outside outside() const { return outside_; }
  std::unique_ptr<Motion> clone() const override;

 private:
  RecordedTracks(std::vector<Trajectory> trajectories, Outside outside)
      : PiecewiseMotion(std::move(trajectories), outside == Outside::vanish), outside_(outside) {}

  Outside outside_;
};

}  // namespace kinesphere
