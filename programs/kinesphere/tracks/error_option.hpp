// How far positions are declared to be off: --error.
#pragma once

#include <string>

#include "simulation/tracks/position_errors.hpp"
#include "tracks/closeness.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// Parses LENGTH[:SPEED]; returns no errors for an empty text. Throws ProgramError naming the option: for
/// other text, with a cylinder, and for a unit where that of the recording is not known.
PositionErrors errors_of(const std::string& given, const Closeness& closeness, const TrackSet& track_set);

/// Returns by how much two tracks may be nearer than they seem, at most.
double largest_error(const PositionErrors& errors, const TrackSet& track_set);

}  // namespace kinesphere::program
