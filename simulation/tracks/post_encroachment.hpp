// Post-encroachment time: how long after one body has left a place the other enters it.
#pragma once

#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "simulation/tracks/approaches.hpp"

namespace kinesphere {

struct PostEncroachment {
  double at = 0.0;       ///< when the later of the two enters the place
  double seconds = 0.0;  ///< infinity if no place is taken by both
};

/// Returns the least post-encroachment time of all places that both spheres of an approach take during it:
/// the least |t - s| of which the first at time s and the second at time t, or the other way round, overlap.
/// It is 0 for two that touch. The result is at most a millionth too long, and as exact as 2^-30 of the
/// approach's duration otherwise. Precondition: the closest point of the approach is known; `radii` by track.
/// Cost: that of all pairs of pieces of the two curves, then up to some ten thousand pairs of parts.
PostEncroachment post_encroachment(const Motion& motion, const Approach& approach,
                                   const std::vector<double>& radii);

}  // namespace kinesphere
