// The scenes of `kinesphere-bench speed`, and every number of it that no option gives.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "research/bench/benchmark.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

struct SpeedSettings {
  std::string_view name;
  int repetitions;       ///< repetitions of every measurement; medians are shown
  double least_turn;     ///< seconds: shorter runs are repeated
  std::uint32_t divide;  ///< divisor of the number of bodies in every scene, at constant density
  double shorten;        ///< factor of the time of every scene
  /// Scenes of more bodies than this are left out.
  std::uint32_t most_bodies;
  std::uint32_t most_with_rivals;  ///< scenes of more bodies than this are run without fixed steps
  std::uint64_t most_recorded;     ///< positions of a scene kept at a time, 12 bytes each
  std::uint64_t most_looked;       ///< positions tested to count missed contacts
};

const SpeedSettings& speed_settings(Effort effort);

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
};

std::vector<SpeedScene> speed_scenes(const SpeedSettings& settings);

}  // namespace kinesphere::program
