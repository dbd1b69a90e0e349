// The scenes of `kinesphere-bench speed`.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "research/bench/speed/speed_settings.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

struct SpeedScene {
  std::string name;  ///< without blanks; for --only
  std::uint32_t bodies;
  SceneResponse response;  ///< of the runs that are timed; missed contacts are counted without bounces
  std::function<Scene(SceneResponse)> make;
  std::vector<double> rates;  ///< of fixed steps, per unit of time
  /// If positive, every body has a sensor of this distance (length), detectors look for alarms, and no body
  /// bounces.
  double alarm = 0.0;
  /// Missed contacts are counted if the second body has this number or a higher one.
  std::uint32_t first_counted = 0;
  bool trees = false;  ///< compare with Bullet's trees
  bool floor = false;  ///< count the probe floor
};

std::vector<SpeedScene> speed_scenes(const SpeedSettings& settings);

}  // namespace kinesphere::program
