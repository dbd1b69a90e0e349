// RecordedTracks: motion along a smooth curve through samples of positions.
#pragma once

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

/// Each body follows the natural cubic spline through its samples: the smooth curve through them with the
/// least integral of |acceleration|^2, and with zero acceleration at its two ends. Its acceleration limit
/// is the exact maximum of that curve. The motion before the first and after the last sample is unknown;
/// the body continues straight there (PiecewiseMotion).
class RecordedTracks final : public PiecewiseMotion {
 public:
  /// Creates one body for each track. Errors, naming body and sample: out_of_range for fewer than 2
  /// samples, for times that do not increase, and for numbers so large that the curve overflows;
  /// not_finite. Cost: O(samples).
  static Result<RecordedTracks> create(const std::vector<Track>& tracks);

  std::unique_ptr<Motion> clone() const override;

 private:
  explicit RecordedTracks(std::vector<Trajectory> trajectories) : PiecewiseMotion(std::move(trajectories)) {}
};

}  // namespace kinesphere
