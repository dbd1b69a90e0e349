// Turns a track set into a scene in which a contact is an approach.
#include "tracks/track_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "base/program_error.hpp"
#include "kinesphere/limits.hpp"
#include "simulation/tracks/cylinder_approaches.hpp"
#include "simulation/tracks/scene_of_tracks.hpp"

namespace kinesphere::program {
namespace {

/// The world's coordinates reach to 2^41 tolerances; half of that is reserved for curves that swing out.
constexpr double tolerances_in_extent = 0x1p40;

struct Furthest {
  double coordinate = 0.0;
  std::string id;
};

Furthest furthest_of(const TrackSet& track_set, double stretch = 1.0) {
  Furthest furthest;
  for (const RecordedTrack& track : track_set.tracks) {
    for (const TrackSample& sample : track.samples) {
      const Vec3& position = sample.position;
      const double size =
          std::max({std::abs(position.x), std::abs(position.y), std::abs(stretch * position.z)});
      if (size > furthest.coordinate) furthest = {size, track.id};
    }
  }
  return furthest;
}

double tolerance_of(const TrackSet& track_set, const ApproachQuestion& question) {
  const Furthest furthest = furthest_of(track_set);
  const double finest = furthest.coordinate / tolerances_in_extent;
  const double tolerance = question.tolerance.value_or(std::max(1e-6 * question.distance, finest));
  if (tolerance < finest) {
    throw ProgramError(
        fmt::format("--tolerance: expected {:.3g} or more, as id '{}' is {:.6g} from the recording's middle, "
                    "but got {}",
                    finest, furthest.id, furthest.coordinate, tolerance));
  }
  if (tolerance >= question.distance) {
    throw ProgramError(fmt::format("--tolerance: expected less than the distance {}, but got {}",
                                   question.distance, tolerance));
  }
  return tolerance;
}

/// Returns the farthest coordinate that the curves of the motion may reach, up to a small factor, and the
/// sample before it.
Swing farthest_of(const TrackSet& track_set, const Motion& motion) {
  Swing farthest;
  for (std::uint32_t number = 0; number < track_set.tracks.size(); ++number) {
    const RecordedTrack& track = track_set.tracks[number];
    for (const Segment& segment : motion.trajectory(number, track.from(), track.until())) {
      const double s = segment.end - segment.begin;
      for (int axis = 0; axis < 3; ++axis) {
        const double coordinate =
            std::abs(segment.position[axis]) +
            (std::abs(segment.velocity[axis]) +
             (std::abs(segment.acceleration[axis]) / 2.0 + std::abs(segment.jerk[axis]) * s / 6.0) * s) *
                s;
        if (coordinate > farthest.size) farthest = {track.id, coordinate, segment.begin};
      }
    }
  }
  return farthest;
}

/// Returns a tolerance with which the world reaches as far as the curves: the one that it has or, unless the
/// caller has chosen it, a coarser one.
double tolerance_for_curves(const TrackSet& track_set, const ApproachQuestion& question, const Scene& scene,
                            double distance) {
  const double tolerance = scene.world.contact_tolerance;
  const Swing farthest = farthest_of(track_set, *scene.motion);
  const double finest = farthest.size / limits::largest_length;
  if (finest <= tolerance) return tolerance;
  const std::string cause = fmt::format(
      "the spline of id '{}' after {} may swing out to {:.6g} from the recording's middle (see "
      "--max-speed and --interpolate linear)",
      farthest.id, track_set.times.text(farthest.time), farthest.size);
  if (question.tolerance)
    throw ProgramError(fmt::format("--tolerance: expected {:.3g} or more, as {}, but got {}", finest, cause,
                                   *question.tolerance));
  if (finest >= distance)
    throw ProgramError(
        fmt::format("the distance {:.6g} is too small beside the curves: {}", distance, cause));
  return finest;
}

double distance_to_line(const Vec3& point, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double length_squared = norm_squared(way);
  const double part =
      length_squared > 0 ? std::clamp(dot(point - from, way) / length_squared, 0.0, 1.0) : 0.0;
  return norm(point - from - part * way);
}

/// Returns the distance of the curve from the straight line between two samples, at 7 times between them.
double swing(const Segment& segment, const Vec3& from, const Vec3& to) {
  double largest = 0.0;
  for (int k = 1; k < 8; ++k) {
    const double time = segment.begin + (segment.end - segment.begin) * k / 8.0;
    largest = std::max(largest, distance_to_line(segment.state_at(time).position, from, to));
  }
  return largest;
}

/// Returns the largest swing of a curve between two samples that is larger than `distance` and their
/// distance.
Swing largest_swing(const RecordedTrack& track, const Trajectory& curve, double distance) {
  Swing largest;
  for (std::size_t k = 0; k + 1 < track.samples.size(); ++k) {
    const Vec3 &from = track.samples[k].position, &to = track.samples[k + 1].position;
    const double size = swing(curve[k], from, to);
    if (size > distance && size > norm(to - from) && size > largest.size)
      largest = {track.id, size, track.samples[k].time};
  }
  return largest;
}

double diagonal_of(const RecordedTrack& track) {
  Box box{track.samples.front().position, track.samples.front().position};
  for (const TrackSample& sample : track.samples) {
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::min(box.lower[axis], sample.position[axis]);
      box.upper[axis] = std::max(box.upper[axis], sample.position[axis]);
    }
  }
  return norm(box.upper - box.lower);
}

Overshoots overshoots_of(const TrackSet& track_set, const Motion& motion, double distance) {
  Overshoots overshoots;
  for (std::uint32_t number = 0; number < track_set.tracks.size(); ++number) {
    const RecordedTrack& track = track_set.tracks[number];
    const auto& samples = track.samples;
    const Swing found =
        largest_swing(track, motion.trajectory(number, samples.front().time, samples.back().time), distance);
    if (found.size == 0.0) continue;
    const bool is_absurd = found.size > diagonal_of(track);
    ++(is_absurd ? overshoots.straightened : overshoots.tracks);
    Swing& largest = is_absurd ? overshoots.most_absurd : overshoots.largest;
    if (found.size > largest.size) largest = found;
    if (!is_absurd) continue;
    overshoots.is_straight.resize(track_set.tracks.size(), false);
    overshoots.is_straight[number] = true;
  }
  return overshoots;
}

/// Returns the samples, with z stretched.
std::vector<Track> samples_of(const TrackSet& track_set, double stretch = 1.0) {
  std::vector<Track> tracks;
  tracks.reserve(track_set.tracks.size());
  for (const RecordedTrack& track : track_set.tracks) {
    tracks.push_back(track.samples);
    for (TrackSample& sample : tracks.back()) sample.position.z *= stretch;
  }
  return tracks;
}

std::vector<TrackStay> stays_of(const TrackSet& track_set) {
  std::vector<TrackStay> stays;
  for (const RecordedTrack& track : track_set.tracks)
    stays.push_back({track.from(), track.until(), track.rests});
  return stays;
}

/// Throws the error of a scene with curves through its samples.
[[noreturn]] void refuse(const TrackSet& track_set, const Error& error) {
  const bool is_known = error.body.index < track_set.tracks.size();
  throw ProgramError(
      fmt::format("id '{}': {}", is_known ? track_set.tracks[error.body.index].id : "", message_of(error)));
}

/// Returns a scene of the track set stretched along z. `is_straight` as for scene_of_tracks().
Scene scene_with(const TrackSet& track_set, const ApproachQuestion& question,
                 const std::vector<bool>& is_straight, double stretch, double distance, double tolerance) {
  auto scene = scene_of_tracks(samples_of(track_set, stretch), distance, question.interpolation,
                               stays_of(track_set), is_straight);
  if (!scene) refuse(track_set, scene.error());
  for (std::size_t k = 0; k < track_set.tracks.size(); ++k)
    scene->bodies[k].radius += track_set.tracks[k].radius;
  scene->world.contact_tolerance = tolerance;
  scene->world.start_time = std::max(scene->world.start_time, question.from);
  scene->end_time = std::min(scene->end_time, question.until);
  scene->world.contacts = ContactEvents::begin_and_end;
  scene->world.dimensions = track_set.is_plane ? 2 : 3;
  scene->world.contact_tolerance = tolerance_for_curves(track_set, question, *scene, distance);
  return std::move(*scene);
}

}  // namespace

std::vector<double> radii_of(const TrackSet& track_set) {
  std::vector<double> radii;
  for (const RecordedTrack& track : track_set.tracks) radii.push_back(track.radius);
  return radii;
}

std::vector<RectangleBody> shapes_of(const TrackSet& track_set) {
  std::vector<RectangleBody> shapes;
  for (const RecordedTrack& track : track_set.tracks)
    shapes.push_back(track_set.has_rectangles ? track.shape : RectangleBody{.radius = track.radius});
  return shapes;
}

RecordedTracks splines_through(const TrackSet& track_set) {
  std::vector<RestingEnds> ends;
  for (const RecordedTrack& track : track_set.tracks) ends.push_back(track.rests);
  auto curves = RecordedTracks::create(samples_of(track_set), ends);
  if (!curves) refuse(track_set, curves.error());
  return std::move(*curves);
}

TrackScene scene_of(const TrackSet& track_set, const ApproachQuestion& question) {
  const double tolerance = tolerance_of(track_set, question);
  TrackScene result;
  if (question.interpolation == Interpolation::spline)
    result.overshoots = overshoots_of(track_set, splines_through(track_set), question.distance);
  const auto& is_straight = result.overshoots.is_straight;
  result.scene = scene_with(track_set, question, is_straight, 1.0, question.distance, tolerance);
  if (!question.vertical) return result;
  const CylinderEnclosure enclosure =
      enclosure_of({.horizontal = question.distance, .vertical = *question.vertical, .tolerance = tolerance});
  const double finest = furthest_of(track_set, enclosure.stretch).coordinate / tolerances_in_extent;
  const double coarse = std::max(1e-6 * enclosure.distance, finest);
  if (coarse >= enclosure.distance)
    throw ProgramError(fmt::format(
        "--separation: expected lengths above {:.3g}, because of the recording's extent", finest));
  // The margin is far above what the engine and the rounding of curves take.
  result.enclosing = scene_with(track_set, question, is_straight, enclosure.stretch,
                                enclosure.distance + 4.0 * coarse, coarse);
  return result;
}

}  // namespace kinesphere::program
