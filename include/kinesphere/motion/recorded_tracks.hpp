// Motion along recorded tracks: a smooth curve through samples of positions.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "kinesphere/motion/piecewise_motion.hpp"

namespace kinesphere {

/// Where a body was at one time.
struct TrackSample {
  double time = 0.0;
  Vec3 position;
};

/// The samples of one body in the order of their times.
using Track = std::vector<TrackSample>;

/// Each body goes along the natural cubic spline through its samples: of all smooth curves through them the
/// one that bends least (the least integral of |acceleration|^2), with no acceleration at its two ends. Its
/// promise is the exact largest acceleration of that curve. What happened before the first and after the last
/// sample is unknown; there it goes straight on, see PiecewiseMotion.
class RecordedTracks final : public PiecewiseMotion {
 public:
  /// One track for each body. Errors, naming body and sample: out_of_range for fewer than 2 samples, for
  /// times that do not increase, and for numbers so large that the curve overflows; not_finite. Cost:
  /// O(samples).
  static Result<RecordedTracks> create(const std::vector<Track>& tracks);

  std::unique_ptr<Motion> clone() const override;

 private:
  explicit RecordedTracks(std::vector<Trajectory> trajectories) : PiecewiseMotion(std::move(trajectories)) {}
};

}  // namespace kinesphere
