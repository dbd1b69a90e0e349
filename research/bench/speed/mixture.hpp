// Scenes of the benchmark's own: several kinds of bodies in one box, and a crowd.
#pragma once

#include <cstdint>
#include <vector>

#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

/// A kind of bodies. Values are drawn uniformly between least and largest.
struct BodyKind {
  std::uint32_t bodies;
  double radius_min, radius_max;
  double speed_min, speed_max;
  double limit;  ///< acceleration limit
};

struct MixtureParameters {
  Box box;
  bool walls = true;
  std::vector<BodyKind> kinds;
  double gap = 0.0;              ///< least gap of any two bodies at the start (length)
  double redraw_interval = 0.2;  ///< time between new random forces
  double seconds;
  std::uint64_t seed = 1;
};

/// Makes bodies that random forces push around. Throws ProgramError if they do not fit into the box.
Scene make_mixture(const MixtureParameters& parameters, SceneResponse response);

/// People on a square: each walks towards a place of its own and changes it now and then. All stay in one
/// plane.
struct CrowdParameters {
  std::uint32_t people;
  double area_each;  ///< area for each person (length^2)
  double seconds;
  std::uint64_t seed = 1;
};

Scene make_crowd(const CrowdParameters& parameters, SceneResponse response);

}  // namespace kinesphere::program
