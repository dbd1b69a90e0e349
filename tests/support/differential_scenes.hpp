// Pass-through scenes on which all detectors must find equal contacts: random scenes, and adversarial ones.
#pragma once

#include <cstdint>
#include <string_view>

#include "simulation/scene/scene.hpp"

namespace kinesphere::scene_tests {

enum class Family {
  random_forces,   ///< the paper's first experiment at many sizes and densities
  velocity_field,  ///< the paper's second experiment
  ballistic,       ///< straight lines, or gravity as the plan
  mixed_radii,     ///< 1:1000, few large among many small
  pursuit,         ///< each body accelerates at its limit straight at its nearest neighbour
  bang_bang,       ///< full acceleration to and fro along one line through a neighbour
  grazing,         ///< pairs that pass each other at a gap between -1e-3 and 1e-3, down to 1e-12
  at_rest,         ///< zero speed, zero limit, or both, with a few visitors
  bullets,         ///< some 1000 times as fast as the others
  points,          ///< radius 0 among others
  tracks,          ///< splines through noisy samples, bodies that come and go
  far_away,        ///< two clusters 10^6 apart
  count
};

std::string_view name_of(Family family);

/// Returns the scene of this seed.
Scene differential_scene(Family family, std::uint64_t seed);

}  // namespace kinesphere::scene_tests
