// The summary of `kinesphere tracks` as JSON.
#pragma once

#include <string>
#include <vector>

#include "simulation/tracks/approaches.hpp"
#include "tracks/approach_choice.hpp"
#include "tracks/coverage.hpp"
#include "tracks/track_scene.hpp"
#include "tracks/track_set.hpp"
#include "tracks/vanishings.hpp"

namespace kinesphere::program {

/// What a run has found and looked at.
struct TracksResult {
  std::vector<Approach> approaches;
  LeftOut left_out;
  std::size_t of_one_body = 0;  ///< approaches that were left out because of a handover
  Coverage coverage;
  std::vector<Vanishing> vanishings;
  std::uint64_t probes = 0;
  std::uint64_t hash = 0;
};

/// Returns an object on one line: counts of what was read and left out, the span, the approaches, and what
/// was not looked at (docs/tracks.md has all members).
std::string summary_json(const std::vector<std::string>& files, const TrackSet& track_set,
                         const TrackScene& scene, const TracksResult& result);

}  // namespace kinesphere::program
