// What really happened in a run of a scene: the exact paths of all bodies, bounces included, and who touched
// whom when.
#pragma once

#include <cstdint>
#include <vector>

#include "kinesphere/motion/trajectory.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/run/simulate.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

struct FlightContact {
  std::uint32_t first;
  std::uint32_t second;  ///< `first` again for a wall
  Wall wall = Wall::none;
  double begin;
  double end;  ///< `begin` in ContactMode::impacts; infinite when it has not ended
};

struct Flight {
  std::vector<Trajectory> paths;        ///< by body, from the start of the scene to its end
  std::vector<FlightContact> contacts;  ///< by begin
  SimulationResult result;
};

/// Runs the scene under the detector and notes the paths, piece by piece from event to event. Errors: as
/// simulate().
Result<Flight> record_flight(const Scene& scene, const DetectorMaker& make);

}  // namespace kinesphere
