// How the command line asks for a track set to be read.
#pragma once

#include <optional>
#include <string_view>

#include "formats/ids/identities.hpp"
#include "formats/streams/report_format.hpp"
#include "simulation/tracks/scene_of_tracks.hpp"
#include "tracks/projection.hpp"

namespace kinesphere::program {

/// Rows without a time or a position: empty, NaN, inf, NA, N/A, null or none; for longitudes and latitudes
/// also 181 and 91, the unknown position of AIS.
enum class MissingPolicy {
  fail,
  skip,   ///< drops the row
  split,  ///< nor does its id's track go on over it; a row without a time is skipped
};

/// How to treat several samples of one id at one time.
enum class DuplicatePolicy {
  fail,
  first,  ///< the first of the file counts
  mean,   ///< the mean of their positions
};

enum class HeadingFrom {
  motion,  ///< bodies point where they go
  x_axis,  ///< counterclockwise from the x axis
  north,   ///< clockwise from north, the y axis
};

/// Returns "vanish", "stay" or "go-on".
std::string_view name_of(Outside outside);

struct TrackOptions : FormatChoices {
  IdentityChoice identities;
  ProjectionChoice projection = ProjectionChoice::automatic;
  MissingPolicy missing = MissingPolicy::fail;
  DuplicatePolicy duplicates = DuplicatePolicy::fail;
  /// Samples that cannot be reached at this speed, in lengths per second, are dropped.
  std::optional<double> max_speed;
  /// Seconds. A longer time between two samples of one id splits it into two tracks. Default: 2.5 times the
  /// median time between samples of that id, or of all ids if it has fewer than 4 samples.
  std::optional<double> max_gap;
  /// The rows are waypoints of plans: however far apart, the way goes on from one to the next.
  bool is_plan = false;
  std::optional<Interpolation> interpolation;  ///< Default: straight on in a plan, else a spline
  std::string ground;  ///< height of aircraft on the ground that have none: a length; empty to leave them out
  bool counts_handovers = false;  ///< approaches of an id with the one as which it goes on are approaches
  /// What headings of bodies with a size count from, or that they are those of their motion. Default: what
  /// the file or its motion says.
  std::optional<HeadingFrom> heading_from;
  /// Before the first and after the last sample of an id, within the recording.
  Outside outside = Outside::vanish;

  Interpolation chosen_interpolation() const {
    return interpolation.value_or(is_plan ? Interpolation::linear : Interpolation::spline);
  }
};

}  // namespace kinesphere::program
