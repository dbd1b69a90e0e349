// Approaches of recorded tracks: the pairs that were close, when, and how close they came.
#pragma once

#include <cstdint>
#include <vector>

#include "kinesphere/event.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// The least distance of two tracks during an approach, along their exact curves.
struct ClosestApproach {
  double time = 0.0;
  double distance = 0.0;  ///< distance of the centres, less the radii
  Vec3 first, second;     ///< positions at that time
  double relative_speed = 0.0;
};

/// A span of time in which two tracks are close.
struct Approach {
  std::uint32_t first = 0, second = 0;  ///< numbers of the tracks
  double begin = 0.0, end = 0.0;
  bool begins_with_track =
      false;  ///< the two were close at the first sample of one of them or at the start of the scene
  bool ends_with_track =
      false;  ///< the two were close at the last sample of one of them or at the end of the scene
  ClosestApproach closest{};  ///< within [begin, end]; set by find_closest()
  bool is_certain = true;     ///< false: only if positions are off as far as they may be
};

/// Returns the approaches that a run of `scene` reported, sorted by begin. An approach without an end event
/// ends with the track that ends first.
std::vector<Approach> approaches_in(const Scene& scene, const std::vector<Event>& events);

/// Sets `closest` of each approach. `radii` (lengths, by track) are those of the bodies; empty for points.
/// Cost: proportional to the pieces of the two curves during the approach.
void find_closest(const Motion& motion, std::vector<Approach>& approaches,
                  const std::vector<double>& radii = {});

/// A local minimum of the distance during an approach.
struct DistanceMinimum {
  std::size_t approach = 0;  ///< index
  ClosestApproach closest{};
  Vec3 first_velocity, second_velocity;  ///< at a sudden turn those after it
  bool is_cut_off = false;               ///< the distance still falls toward a begin or end of a track
};

/// Returns all local minima of the distance (GapCourse::minima()) in each approach, by approach and time.
/// `radii` is as for find_closest(). Each approach has at least one. Cost: proportional to the pieces of the
/// two curves during the approach.
std::vector<DistanceMinimum> minima_in(const Motion& motion, const std::vector<Approach>& approaches,
                                       const std::vector<double>& radii = {});

/// Returns the indices of at most `most` approaches, the closest first; equal ones in their order.
std::vector<std::size_t> closest_of(const std::vector<Approach>& approaches, std::size_t most);

}  // namespace kinesphere
