// Scenes drawn at random from a few parameters and a seed.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinesphere/result.hpp"
#include "kinesphere/vec3.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// What scene files call the values of SceneParameters::MotionKind and of SceneResponse, in their order.
inline constexpr std::array<std::string_view, 3> motion_names{"random_forces", "velocity_field", "ballistic"};
inline constexpr std::array<std::string_view, 2> response_names{"pass_through", "bounce"};

/// The parameters of the paper's experiments, from which scene files and the built-in scenes are made.
struct SceneParameters {
  std::string name = "custom";
  enum class MotionKind { random_forces, velocity_field, ballistic } motion = MotionKind::random_forces;
  std::uint32_t bodies = 1000;
  double radius_min = 0.1, radius_max = 10.0;
  double speed_min = 4.3301270189221932, speed_max = 43.301270189221931;  ///< 2.5 sqrt 3, 25 sqrt 3
  double limit_min = 10.0, limit_max = 20.0;                              ///< acceleration limit
  Vec3 gravity{};                                                         ///< planned acceleration
  Box box{{0, 0, 0}, {200, 200, 200}};
  /// Part of the box that the bodies fill, in [0, 1). If positive, the box is scaled from its lower corner
  /// until they do; 0 leaves the box as it is. Up to about 0.6 spheres of one size find room.
  double packing = 0.0;
  bool walls = true;
  /// Repeats space with the box on all three axes, without walls. The velocities at the start are then
  /// shifted so that the total momentum is zero.
  bool periodic = false;
  double redraw_interval = 0.2;  ///< time for which a random force lasts
  SceneResponse response = SceneResponse::bounce;
  double restitution = 1.0;
  /// Scene::resting_speed. A positive value that is too small for the contact tolerance is raised to
  /// least_resting_speed().
  double resting_speed = 0.0;
  double contact_tolerance = 1e-6;
  double zeno_interval = 0.0;  ///< WorldDefinition::zeno_interval
  double seconds = 15.0;
  std::uint64_t seed = 1;
};

/// Places the bodies without overlap and makes the scene. Errors: out_of_range with the name of the
/// parameter, also if the bodies do not fit into the box.
Result<Scene> make_scene(const SceneParameters& parameters);

/// Returns the built-in scenes, each with its name.
const std::vector<SceneParameters>& built_in_scenes();

}  // namespace kinesphere
