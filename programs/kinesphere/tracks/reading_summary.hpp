// A summary of what was read.
#pragma once

#include <string>
#include <vector>

#include "scenes/summary.hpp"
#include "tracks/coverage.hpp"
#include "tracks/track_scene.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// Adds files, format, tracks, samples, dropped rows with reasons, what was not looked at, and the span.
void add_track_set(Summary& summary, const std::vector<std::string>& files, const TrackSet& track_set,
                   const TrackScene& scene, const Coverage& coverage);

/// Returns warnings, one line each: many rows or samples were dropped.
std::vector<std::string> warnings_of(const TrackSet& track_set);
/// Returns those warnings, and one about splines that swing out far.
std::vector<std::string> warnings_of(const TrackSet& track_set, const TrackScene& scene);

}  // namespace kinesphere::program
