// Speeds that samples imply, to find those that no body has.
#pragma once

#include <cstdint>
#include <vector>

#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// The speeds of a track set between one sample and the next, straight on.
///
/// Usual are speeds up to the one that three quarters of the track set's steps do not exceed, or three
/// quarters of the steps of the same id, whichever is larger. (An id counts with 8 steps or more: of fewer, a
/// wrong sample makes a quarter.) More than 10 times that is absurd: a fast body among slow ones is known by
/// its other steps, a wrong sample is not.
class ImpliedSpeeds {
 public:
  /// `track set` must outlive it. Cost: O(samples).
  explicit ImpliedSpeeds(const TrackSet& track_set);

  /// True if the step at `time` or one beside it, which bends the curve there, has an absurd speed.
  bool is_absurd_at(std::uint32_t track, double time) const;

 private:
  const TrackSet& track_set_;
  std::vector<double> limits_;  ///< by track: the largest speed that is not absurd
};

}  // namespace kinesphere::program
