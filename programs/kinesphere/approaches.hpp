// When which two bodies of a recording were close.
#pragma once

#include <cstdint>
#include <vector>

#include "kinesphere/scene.hpp"

namespace kinesphere::program {

struct Approach {
  std::uint32_t first = 0, second = 0;  ///< numbers of the tracks
  double begin = 0.0, end = 0.0;
  bool begins_with_track = false;  ///< the two were close at the first sample of one of them
  bool ends_with_track = false;    ///< the two were close at the last sample of one of them
};

/// The approaches that a run of `scene` has reported, by begin. One without an end event ends with the track
/// that ends first.
std::vector<Approach> approaches_in(const Scene& scene, const std::vector<Event>& events);

}  // namespace kinesphere::program
