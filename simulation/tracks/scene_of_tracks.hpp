// Tracks as a scene, in which a contact is an approach.
#pragma once

#include <vector>

#include "kinesphere/motion/recorded_tracks.hpp"
#include "kinesphere/result.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// The motion between two samples.
enum class Interpolation {
  spline,  ///< the natural cubic spline: smooth, may swing out beyond the samples
  linear,  ///< straight on: never beyond the samples, with a sudden turn at each
};

/// Each track is a body of half the distance as radius, which is there from its first sample to its last. The
/// tolerance of the world, and whether it is a plane, are left to the caller. There must be at least one
/// track. Errors: as RecordedTracks::create().
Result<Scene> scene_of_tracks(const std::vector<Track>& tracks, double distance, Interpolation interpolation);

}  // namespace kinesphere
