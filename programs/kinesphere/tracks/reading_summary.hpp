// What was read, told to a person.
#pragma once

#include <string>
#include <vector>

#include "summary.hpp"
#include "tracks/recording.hpp"
#include "tracks/track_scene.hpp"

namespace kinesphere::program {

/// Files, format, tracks, samples, what was left out and why, span.
void add_recording(Summary& summary, const std::vector<std::string>& files, const Recording& recording,
                   const TrackScene& scene);

/// What should not pass unseen, one line each: many rows or samples left out.
std::vector<std::string> warnings_of(const Recording& recording);
/// These, and splines that swing out far.
std::vector<std::string> warnings_of(const Recording& recording, const TrackScene& scene);

}  // namespace kinesphere::program
