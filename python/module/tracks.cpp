// Approaches in recorded tracks: kinesphere.tracks(), which prepares the samples in Python.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "errors.hpp"
#include "exchange.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/tracks/approaches.hpp"
#include "simulation/tracks/post_encroachment.hpp"
#include "simulation/tracks/scene_of_tracks.hpp"
#include "simulation/tracks/time_to_collision.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

/// A row; first and second are numbers of tracks.
struct ApproachRecord {
  std::int64_t first;
  std::int64_t second;
  double begin;
  double end;
  double closest_time;
  double closest_distance;
  double relative_speed;
  Vec3 first_position;
  Vec3 second_position;
  bool begins_with_track;
  bool ends_with_track;
  std::array<std::uint8_t, 6> unused;
  double least_time_to_collision;
  double least_time_at;
  double post_encroachment_time;
  double time_of_entry;
};

constexpr Field approach_fields[] = {
    {"first", "i8", offsetof(ApproachRecord, first)},
    {"second", "i8", offsetof(ApproachRecord, second)},
    {"begin", "f8", offsetof(ApproachRecord, begin)},
    {"end", "f8", offsetof(ApproachRecord, end)},
    {"closest_time", "f8", offsetof(ApproachRecord, closest_time)},
    {"closest_distance", "f8", offsetof(ApproachRecord, closest_distance)},
    {"relative_speed", "f8", offsetof(ApproachRecord, relative_speed)},
    {"first_position", "3f8", offsetof(ApproachRecord, first_position)},
    {"second_position", "3f8", offsetof(ApproachRecord, second_position)},
    {"begins_with_track", "?", offsetof(ApproachRecord, begins_with_track)},
    {"ends_with_track", "?", offsetof(ApproachRecord, ends_with_track)},
    {"least_time_to_collision", "f8", offsetof(ApproachRecord, least_time_to_collision)},
    {"least_time_at", "f8", offsetof(ApproachRecord, least_time_at)},
    {"post_encroachment_time", "f8", offsetof(ApproachRecord, post_encroachment_time)},
    {"time_of_entry", "f8", offsetof(ApproachRecord, time_of_entry)},
};

/// Track k has the samples from starts[k] to starts[k + 1].
std::vector<Track> tracks_of(const std::vector<double>& times, const std::vector<Vec3>& positions,
                             const std::vector<std::uint64_t>& starts) {
  std::vector<Track> tracks;
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    Track& track = tracks.emplace_back();
    for (std::size_t sample = starts[k]; sample < starts[k + 1]; ++sample)
      track.push_back({times.at(sample), positions.at(sample)});
  }
  return tracks;
}

/// Returns the approaches, and the number of probes. Without radii (lengths, by track) bodies are points, and
/// the times to collision and post-encroachment times are zeros.
py::tuple approaches(const py::object& times, const py::object& positions, const py::object& starts,
                     const py::object& given_radii, double distance, double tolerance, bool straight,
                     bool plane) {
  const char* const call = "tracks";
  const std::vector<Vec3> places = vectors_of(positions, {call, "positions"}, plane);
  const std::vector<double> moments = each_of(times, {call, "t"}, places.size());
  const auto count = static_cast<std::size_t>(py::len(starts));
  const std::vector<Track> tracks =
      tracks_of(moments, places, each_whole_of(starts, {call, "starts"}, count));
  std::vector<double> radii;
  if (!given_radii.is_none()) radii = each_of(given_radii, {call, "radii"}, tracks.size());
  std::vector<Approach> found;
  std::vector<LeastTimeToCollision> least;
  std::vector<PostEncroachment> entries;
  std::uint64_t probes = 0;
  if (!tracks.empty()) {
    const py::gil_scoped_release released;
    Scene scene =
        scene_of_tracks(tracks, distance, straight ? Interpolation::linear : Interpolation::spline).value();
    scene.world.contact_tolerance = tolerance;
    scene.world.contacts = ContactEvents::begin_and_end;
    scene.world.dimensions = plane ? 2 : 3;
    for (std::size_t k = 0; k < radii.size(); ++k) scene.bodies[k].radius += radii[k];
    std::vector<Event> events;
    Interruptions interruptions;
    SceneObserver observer;
    observer.on_event = [&](const Event& event) { events.push_back(event); };
    observer.between_events = [&](const Detector&) { interruptions.look(); };
    probes = run_scene(scene, make_world_detector, observer).value().counters.probes;
    found = approaches_in(scene, events);
    find_closest(*scene.motion, found, radii);
    if (!radii.empty())
      for (const Approach& one : found) {
        interruptions.look();
        least.push_back(least_time_to_collision(*scene.motion, one, radii));
        entries.push_back(post_encroachment(*scene.motion, one, radii));
      }
  }
  least.resize(found.size());
  entries.resize(found.size());
  const auto time_or_nan = [](double seconds, double at) {
    return std::isinf(seconds) ? std::numeric_limits<double>::quiet_NaN() : at;
  };
  const auto record = [&](std::size_t k) {
    const Approach& one = found[k];
    return ApproachRecord{one.first,
                          one.second,
                          one.begin,
                          one.end,
                          one.closest.time,
                          one.closest.distance,
                          one.closest.relative_speed,
                          one.closest.first,
                          one.closest.second,
                          one.begins_with_track,
                          one.ends_with_track,
                          {},
                          least[k].seconds,
                          time_or_nan(least[k].seconds, least[k].at),
                          entries[k].seconds,
                          time_or_nan(entries[k].seconds, entries[k].at)};
  };
  return py::make_tuple(table_of_records<ApproachRecord>(approach_fields, found.size(), record), probes);
}

}  // namespace

void bind_tracks(py::module_& module) {
  module.def("_approaches", approaches, py::arg("times"), py::arg("positions"), py::arg("starts"),
             py::arg("radii"), py::arg("distance"), py::arg("tolerance"), py::arg("straight"),
             py::arg("plane"));
}

}  // namespace kinesphere::python
