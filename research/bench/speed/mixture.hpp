// Scenes that the benchmark has of its own: several kinds of bodies in one box, a crowd, a gas.
#pragma once

#include <cstdint>
#include <vector>

#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

/// Drawn uniformly between least and largest.
struct BodyKind {
  std::uint32_t bodies;
  double radius_min, radius_max;
  double speed_min, speed_max;
  double limit;  ///< acceleration
};

struct MixtureParameters {
  Box box;
  bool walls = true;
  std::vector<BodyKind> kinds;
  double gap = 0.0;              ///< between any two at the start, at least (length)
  double redraw_interval = 0.2;  ///< of random forces
  double seconds;
  std::uint64_t seed = 1;
};

/// All are pushed around by random forces. Throws ProgramError when they do not fit into the box.
Scene make_mixture(const MixtureParameters& parameters, SceneResponse response);

/// People on a square: everyone walks towards a place of his own and now and then changes his mind. All
/// stay in one plane.
struct CrowdParameters {
  std::uint32_t people;
  double area_each;  ///< (length^2)
  double seconds;
  std::uint64_t seed = 1;
};

Scene make_crowd(const CrowdParameters& parameters, SceneResponse response);

/// Spheres of diameter 1 that start with speed 1, bounce, and fly straight in between, in space that repeats.
/// At the start they are pushed apart at random, between walls.
struct GasParameters {
  std::uint32_t bodies;
  double filled;  ///< part of the volume
  double seconds;
  std::uint64_t seed = 1;
};

/// Throws ProgramError when they do not fit. Cost: some hundred microseconds per sphere.
Scene make_gas(const GasParameters& parameters, SceneResponse response);

}  // namespace kinesphere::program
