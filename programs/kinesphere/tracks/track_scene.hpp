// Turns a track set into a scene in which a contact is an approach.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "kinesphere/motion/recorded_tracks.hpp"
#include "simulation/scene/scene.hpp"
#include "tracks/reading_policy.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

struct ApproachQuestion {
  double distance = 0.0;           ///< largest distance of an approach, or the largest horizontal one; > 0
  std::optional<double> vertical;  ///< largest vertical distance, of a cylinder
  std::optional<double>
      tolerance;  ///< tolerance of that distance; if empty, a millionth of it, or what the extent needs
  Interpolation interpolation = Interpolation::spline;
  /// Seconds of the track set. The curves are those of all samples, whatever the window.
  double from = -std::numeric_limits<double>::infinity(), until = std::numeric_limits<double>::infinity();
};

/// How far a curve swings out between two samples.
struct Swing {
  std::string id;
  double size = 0.0;
  double time = 0.0;  ///< of the first of the two samples
};

/// Splines that swing out far beyond their samples: by more than the distance of an approach and more than
/// the distance of the two samples.
struct Overshoots {
  std::size_t tracks = 0;  ///< number of tracks with an overshoot
  Swing largest;           ///< by its distance from the straight line between the two samples
  /// Tracks that swing out absurdly, by more than the diagonal of the box around their samples: their bodies
  /// go straight on from sample to sample instead. They do not count above.
  std::size_t straightened = 0;
  Swing most_absurd;
  std::vector<bool> is_straight;  ///< by track; empty if there are no such tracks
};

struct TrackScene {
  /// The curves of the track set, with spheres of the (horizontal) distance.
  Scene scene;
  /// What the engine runs to find the approaches of cylinders: the track set stretched along z, with spheres
  /// around the cylinders.
  std::optional<Scene> enclosing;
  Overshoots overshoots;

  const Scene& searched() const { return enclosing ? *enclosing : scene; }
};

/// Returns the radii of the bodies, by track.
std::vector<double> radii_of(const TrackSet& track_set);

/// Returns the shapes of the bodies, by track: rectangles, or spheres.
std::vector<RectangleBody> shapes_of(const TrackSet& track_set);

/// Returns smooth curves through the samples, one for each track. Throws ProgramError naming the id if a
/// curve overflows.
RecordedTracks splines_through(const TrackSet& track_set);

/// Returns a scene with a body for each track, with half the distance as radius, present as the track says,
/// and a span that is the window. Throws ProgramError naming the option or the id: for a tolerance that does
/// not fit the distance or is too fine for the track set's extent, and if a curve overflows.
TrackScene scene_of(const TrackSet& track_set, const ApproachQuestion& question);

}  // namespace kinesphere::program
