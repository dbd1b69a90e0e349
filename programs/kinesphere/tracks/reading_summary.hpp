// A summary of what was read.
#pragma once

#include <string>
#include <vector>

#include "scenes/summary.hpp"
#include "tracks/recording.hpp"
#include "tracks/track_scene.hpp"

namespace kinesphere::program {

/// Adds files, format, tracks, samples, dropped rows with reasons, and the span.
void add_recording(Summary& summary, const std::vector<std::string>& files, const Recording& recording,
                   const TrackScene& scene);

/// Returns warnings, one line each: many rows or samples were dropped.
std::vector<std::string> warnings_of(const Recording& recording);
/// Returns those warnings, and one about splines that swing out far.
std::vector<std::string> warnings_of(const Recording& recording, const TrackScene& scene);

}  // namespace kinesphere::program
