// When which two bodies of a recording were close, and how close they came.
#pragma once

#include <cstdint>
#include <vector>

#include "kinesphere/event.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// Where two bodies were nearest: the exact least distance of their curves.
struct ClosestApproach {
  double time = 0.0;
  double distance = 0.0;  ///< of the centres
  Vec3 first, second;     ///< where the two were then
  double relative_speed = 0.0;
};

struct Approach {
  std::uint32_t first = 0, second = 0;  ///< numbers of the tracks
  double begin = 0.0, end = 0.0;
  bool begins_with_track = false;  ///< the two were close at the first sample of one of them
  bool ends_with_track = false;    ///< the two were close at the last sample of one of them
  ClosestApproach closest{};       ///< within [begin, end]; see find_closest()
};

/// The approaches that a run of `scene` has reported, by begin. One without an end event ends with the track
/// that ends first.
std::vector<Approach> approaches_in(const Scene& scene, const std::vector<Event>& events);

/// Finds where the two of each approach came closest. Cost: some time for each piece of the two curves
/// during the approach.
void find_closest(const Motion& motion, std::vector<Approach>& approaches);

/// Numbers of approaches, the closest first, at most so many; equals by their begin.
std::vector<std::size_t> closest_of(const std::vector<Approach>& approaches, std::size_t most);

}  // namespace kinesphere
