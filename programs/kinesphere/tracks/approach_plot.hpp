// A picture of the approaches: a map of the tracks, and how the distance of the closest pairs changed.
#pragma once

#include <string>
#include <vector>

#include "simulation/tracks/approaches.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// Returns an SVG picture of 1200 by 520 pixels. `distance` is the largest distance of an approach.
std::string plot_of(const TrackSet& track_set, const Scene& scene, const std::vector<Approach>& approaches,
                    double distance);

}  // namespace kinesphere::program
