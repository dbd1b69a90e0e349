// Scenes: bodies, their motion and what they do on contact. One set of scenes serves the program, the tests
// and the benchmarks.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/vec3.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

enum class SceneResponse {
  pass_through,  ///< nobody reacts: the contacts are a fixed truth
  bounce,        ///< bodies bounce off each other and the walls, mass ~ radius^3
};

struct SceneBody {
  double radius = 1.0;
  double appears = 0.0;                                       ///< when it is added
  double vanishes = std::numeric_limits<double>::infinity();  ///< when it is removed
};

/// A velocity that a body is given at some time, whatever happens: the motion's set_velocity() is called with
/// it, and the detector told.
struct SceneTurn {
  double time = 0.0;
  std::uint32_t body = 0;
  Vec3 velocity;
};

struct Scene {
  std::string name;
  WorldDefinition world;
  std::vector<SceneBody> bodies;  ///< by their number in the motion
  std::unique_ptr<const Motion> motion;
  std::vector<SceneTurn> turns;  ///< in any order; those of bodies that are not there then are passed over
  SceneResponse response = SceneResponse::pass_through;
  double restitution = 1.0;
  double resting_speed = 0.0;  ///< positive: bodies settle() with it instead of just bounce()
  double end_time = 1.0;
};

}  // namespace kinesphere
