// Scenes: bodies, their motion and their response to contacts. The program, the tests and the benchmarks
// share them.
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

/// Response of the bodies of a scene to contacts.
enum class SceneResponse {
  pass_through,  ///< bodies do not react: the contacts are a fixed truth
  bounce,        ///< bodies bounce off each other and off the walls; mass is radius^3
};

/// Radius (length) of a body, and the times at which it appears and vanishes. The motion has its states.
struct SceneBody {
  double radius = 1.0;
  double appears = 0.0;                                       ///< time at which the body is added
  double vanishes = std::numeric_limits<double>::infinity();  ///< time at which the body is removed
};

/// A velocity that a body gets at a given time, whatever happens: set_velocity() of the motion is called with
/// it, then that of the detector.
struct SceneTurn {
  double time = 0.0;
  std::uint32_t body = 0;
  Vec3 velocity;
};

/// A scene: a world, bodies with their motion, and their response to contacts. It runs from world.start_time
/// to end_time.
struct Scene {
  std::string name;
  WorldDefinition world;
  std::vector<SceneBody> bodies;  ///< by their number in the motion
  std::unique_ptr<const Motion> motion;
  std::vector<SceneTurn> turns;  ///< in any order; turns of absent bodies are skipped
  SceneResponse response = SceneResponse::pass_through;
  double restitution = 1.0;
  double resting_speed = 0.0;  ///< if positive, bodies settle() with this speed instead of just bounce()
  double end_time = 1.0;
};

}  // namespace kinesphere
