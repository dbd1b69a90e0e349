#include "simulation/tracks/scene_of_tracks.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "simulation/tracks/linear_tracks.hpp"

namespace kinesphere {

Result<Scene> scene_of_tracks(const std::vector<Track>& tracks, double distance,
                              Interpolation interpolation) {
  Scene scene;
  scene.name = "tracks";
  if (interpolation == Interpolation::linear) {
    auto lines = LinearTracks::create(tracks);
    if (!lines) return lines.error();
    scene.turns = lines->turns();
    scene.motion = std::make_unique<LinearTracks>(std::move(*lines));
  } else {
    auto curves = RecordedTracks::create(tracks);
    if (!curves) return curves.error();
    scene.motion = std::make_unique<RecordedTracks>(std::move(*curves));
  }
  scene.world.start_time = scene.end_time = tracks.front().front().time;
  for (const Track& track : tracks) {
    const double begin = track.front().time, end = track.back().time;
    scene.bodies.push_back({.radius = distance / 2, .appears = begin, .vanishes = end});
    scene.world.start_time = std::min(scene.world.start_time, begin);
    scene.end_time = std::max(scene.end_time, end);
  }
  return scene;
}

}  // namespace kinesphere
