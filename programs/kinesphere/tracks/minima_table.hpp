// A table of all local minima of distance (--minima).
#pragma once

#include <string>
#include <vector>

#include "base/table_file.hpp"
#include "simulation/tracks/approaches.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// Writes when, who, how far, where, relative position and velocity, and both as each of the two sees them
/// (own_frame.hpp).
void write_minima(TableFile& table, const std::vector<DistanceMinimum>& minima,
                  const std::vector<Approach>& approaches, const TrackSet& track_set);

}  // namespace kinesphere::program
