// Places at which a body appeared or vanished, and who else was there before or afterwards.
#pragma once

#include <string>
#include <vector>

#include "tracks/closeness.hpp"
#include "tracks/coverage.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// A body is not there before its first and after its last sample; another one is as close as an approach to
/// the place of that sample at such a time.
struct Vanishing {
  std::string id;
  double time = 0.0;          ///< of the sample, in seconds of the track set
  bool has_appeared = false;  ///< the sample is the first; else it is the last
  std::string other;
  double other_time = 0.0;
  double distance = 0.0;  ///< of the other one from that place, less the radii
};

/// Returns for each first and last sample of an id the other body that comes closest to its place while the
/// id is not there, if that is close enough; the closest first. It looks along straight lines between
/// samples. Bodies and times that the choice leaves out do not count, and neither do samples beyond which the
/// id is there
/// (--outside). Cost: O(samples), and more for fast bodies beside a small distance, up to some millions of
/// steps.
std::vector<Vanishing> vanishings_in(const TrackSet& track_set, const ApproachFilter& filter,
                                     const Closeness& closeness);

}  // namespace kinesphere::program
