// A picture of the approaches: a map of the tracks, and how the distance of the closest pairs changed.
#pragma once

#include <string>
#include <vector>

#include "simulation/tracks/approaches.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// Returns an SVG picture of 1000 by 520 pixels. `distance` is the largest distance of an approach.
std::string plot_of(const TrackSet& track_set, const Scene& scene, const std::vector<Approach>& approaches,
                    double distance);

/// Returns round numbers from `low` to `high`, about `wanted` of them: multiples of 1, 2 or 5 times a power
/// of ten.
std::vector<double> ticks(double low, double high, int wanted);

}  // namespace kinesphere::program
