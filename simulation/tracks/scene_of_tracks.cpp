#include "simulation/tracks/scene_of_tracks.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "simulation/tracks/linear_tracks.hpp"

namespace kinesphere {

namespace {

/// Returns the track with its first and last place again at the ends of its stay, where it rests: straight
/// lines stop suddenly there.
Track with_rests(Track track, const TrackStay& stay) {
  if (stay.rests.first && stay.from < track.front().time)
    track.insert(track.begin(), {stay.from, track.front().position});
  if (stay.rests.last && stay.until > track.back().time) track.push_back({stay.until, track.back().position});
  return track;
}

Result<void> set_lines(Scene& scene, Result<LinearTracks> lines) {
  if (!lines) return lines.error();
  scene.turns = lines->turns();
  scene.motion = std::make_unique<LinearTracks>(std::move(*lines));
  return {};
}

Result<void> set_motion(Scene& scene, const std::vector<Track>& tracks, Interpolation interpolation,
                        const std::vector<TrackStay>& stays, const std::vector<bool>& is_straight) {
  const bool has_straight = std::find(is_straight.begin(), is_straight.end(), true) != is_straight.end();
  std::vector<Track> resting;
  if (has_straight || interpolation == Interpolation::linear)
    for (std::size_t k = 0; k < tracks.size(); ++k) resting.push_back(with_rests(tracks[k], stays[k]));
  if (interpolation == Interpolation::linear) return set_lines(scene, LinearTracks::create(resting));
  std::vector<RestingEnds> ends;
  for (const TrackStay& stay : stays) ends.push_back(stay.rests);
  auto curves = RecordedTracks::create(tracks, ends);
  if (!curves) return curves.error();
  if (has_straight) return set_lines(scene, LinearTracks::create_among(*curves, resting, is_straight));
  scene.motion = std::make_unique<RecordedTracks>(std::move(*curves));
  return {};
}

}  // namespace

Result<Scene> scene_of_tracks(const std::vector<Track>& tracks, double distance, Interpolation interpolation,
                              std::vector<TrackStay> stays, const std::vector<bool>& is_straight) {
  Scene scene;
  scene.name = "tracks";
  if (stays.empty())
    for (const Track& track : tracks) stays.push_back({track.front().time, track.back().time});
  if (auto set = set_motion(scene, tracks, interpolation, stays, is_straight); !set) return set.error();
  scene.world.start_time = stays.front().from;
  scene.end_time = stays.front().until;
  for (const TrackStay& stay : stays) {
    scene.bodies.push_back({.radius = distance / 2, .appears = stay.from, .vanishes = stay.until});
    scene.world.start_time = std::min(scene.world.start_time, stay.from);
    scene.end_time = std::max(scene.end_time, stay.until);
  }
  return scene;
}

}  // namespace kinesphere
