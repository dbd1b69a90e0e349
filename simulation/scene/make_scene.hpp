// Scenes that are made by drawing: from a few parameters and a seed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kinesphere/result.hpp"
#include "kinesphere/vec3.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// The parameters of the paper's experiments; scene files and the built-in scenes are made of these.
struct SceneParameters {
  std::string name = "custom";
  enum class MotionKind { random_forces, velocity_field, ballistic } motion = MotionKind::random_forces;
  std::uint32_t bodies = 1000;
  double radius_min = 0.1, radius_max = 10.0;
  double speed_min = 4.3301270189221932, speed_max = 43.301270189221931;  ///< 2.5 sqrt 3, 25 sqrt 3
  double limit_min = 10.0, limit_max = 20.0;                              ///< acceleration
  Vec3 gravity{};                                                         ///< planned acceleration
  Box box{{0, 0, 0}, {200, 200, 200}};
  /// In [0, 1). When positive, the box is made larger or smaller, in proportion and from its lower corner,
  /// until the bodies fill this part of it. Up to about 0.55 there is room for spheres of one size.
  double packing = 0.0;
  bool walls = true;
  /// Space repeats with the box on all three axes; there are no walls then, and the velocities at the start
  /// are changed by as much as makes the total momentum zero.
  bool periodic = false;
  double redraw_interval = 0.2;  ///< how long a random force lasts
  SceneResponse response = SceneResponse::bounce;
  double restitution = 1.0;
  /// Scene::resting_speed. When positive and too small for the contact tolerance, it is raised to
  /// least_resting_speed().
  double resting_speed = 0.0;
  double contact_tolerance = 1e-6;
  double zeno_interval = 0.0;  ///< WorldDefinition::zeno_interval
  double seconds = 15.0;
  std::uint64_t seed = 1;
};

/// Places the bodies without overlap and makes the scene. Errors: out_of_range naming the parameter, also
/// when so many bodies do not fit into the box.
Result<Scene> make_scene(const SceneParameters& parameters);

/// The built-in scenes, by name.
const std::vector<SceneParameters>& built_in_scenes();

}  // namespace kinesphere
