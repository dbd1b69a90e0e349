// Recorded tracks as a scene, in which a contact is an approach.
#pragma once

#include <vector>

#include "kinesphere/motion/recorded_tracks.hpp"
#include "kinesphere/result.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// The motion between two samples.
enum class Interpolation {
  spline,  ///< natural cubic spline: smooth, may swing out beyond the samples
  linear,  ///< straight on: never beyond the samples, with a sudden turn at each
};

/// When the body of a track is there: at least from its first sample to its last. Outside of these it stays
/// where it rests, and goes straight on elsewhere.
struct TrackStay {
  double from, until;
  RestingEnds rests{};
};

/// Makes a scene with a body for each track. Its radius is half of `distance` (length), and it is there for
/// its stay; without stays, from the first sample to the last. Bodies of which `is_straight` is true go
/// straight on from sample to sample whatever the interpolation; empty for none. The caller sets the
/// tolerance of the world and the number of dimensions. Precondition: there is at least one track, and a stay
/// and an entry of `is_straight` for each if there are any. Errors: as RecordedTracks::create().
Result<Scene> scene_of_tracks(const std::vector<Track>& tracks, double distance, Interpolation interpolation,
                              std::vector<TrackStay> stays = {}, const std::vector<bool>& is_straight = {});

}  // namespace kinesphere
