// How far positions are declared to be off: --error, and what bodies promise between samples.
#pragma once

#include <string>

#include "simulation/tracks/position_errors.hpp"
#include "tracks/closeness.hpp"
#include "tracks/reading_policy.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// The texts of the options; empty where one is not given.
struct ErrorOptions {
  std::string error;          ///< of positions: LENGTH[:SPEED]
  std::string largest_speed;  ///< of bodies between their samples
  std::string acceleration;   ///< their largest one

  bool has_limits() const { return !largest_speed.empty() || !acceleration.empty(); }
  bool any() const { return has_limits() || !error.empty(); }
  /// Returns "10m at samples, and speeds up to 20kt" or the like, for the summary.
  std::string text() const;
};

/// Returns the motion between samples: straight on where bodies promise limits. Throws ProgramError naming
/// the option that does not go with that.
Interpolation interpolation_for(const ErrorOptions& given, const TrackOptions& reading);

/// Returns no errors if no option is given. Throws ProgramError naming the option: for other text, with a
/// cylinder, for a unit where that of the recording is not known, and for a limit that samples of an id
/// break.
PositionErrors errors_of(const ErrorOptions& given, const Closeness& closeness, const TrackSet& track_set);

/// Returns by how much two tracks may be nearer than they seem, at most.
double largest_error(const PositionErrors& errors, const TrackSet& track_set);

}  // namespace kinesphere::program
