// The scenes of `kinesphere bench speed`.
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
  SceneResponse response;  ///< of the runs that are timed; missed contacts are counted where all pass through
  std::function<Scene(SceneResponse)> make;
  std::vector<double> rates;  ///< of fixed steps, per unit of time
  /// Positive: every body has a sensor of this distance, and what is looked for are alarms. Nobody bounces.
  double alarm = 0.0;
  /// Missed contacts are counted where the second body has this number or a higher one.
  std::uint32_t first_counted = 0;
  bool trees = false;  ///< compare with Bullet's
  bool floor = false;  ///< count the probe floor
};

std::vector<SpeedScene> speed_scenes(const SpeedSettings& settings);

}  // namespace kinesphere::program
