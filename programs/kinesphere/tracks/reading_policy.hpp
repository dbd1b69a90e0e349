// How a recording is to be read, as said on the command line.
#pragma once

#include <optional>

#include "simulation/tracks/scene_of_tracks.hpp"
#include "tracks/projection.hpp"
#include "tracks/track_columns.hpp"

namespace kinesphere::program {

/// Rows without a time or a position: empty, NaN, NA, N/A, null or none; in longitudes and latitudes also 181
/// and 91, with which AIS says that it knows none.
enum class MissingPolicy {
  fail,
  skip,   ///< as if the row were not there
  split,  ///< nor does its id's track go on over it; a row without a time is skipped
};

/// Samples of one id at one time.
enum class DuplicatePolicy {
  fail,
  first,  ///< the first of the file counts
  mean,   ///< the mean of their positions
};

struct TrackOptions {
  TrackHints hints;
  ProjectionChoice projection = ProjectionChoice::automatic;
  MissingPolicy missing = MissingPolicy::fail;
  DuplicatePolicy duplicates = DuplicatePolicy::fail;
  /// Samples that cannot be reached at this speed, in lengths per second, are left out.
  std::optional<double> max_speed;
  /// A longer time (seconds) between two samples of one id splits them into two tracks. Default: 2.5 times
  /// the median time between the samples of that id or, where it has fewer than 4, of all ids.
  std::optional<double> max_gap;
  Interpolation interpolation = Interpolation::spline;
};

}  // namespace kinesphere::program
