// What really happened in a run of a scene: the exact paths of all bodies, bounces included, and all
// contacts.
#pragma once

#include <cstdint>
#include <vector>

#include "kinesphere/motion/trajectory.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// A contact of two bodies, or of a body and a wall, in a run.
struct FlightContact {
  std::uint32_t first;
  std::uint32_t second;  ///< equals `first` for a wall
  Wall wall = Wall::none;
  double begin;
  double end;  ///< equals `begin` with ContactEvents::impacts; infinite if the contact has not ended
};

/// The paths, the contacts and the result of a run.
struct Flight {
  std::vector<Trajectory> paths;        ///< by body, from the start of the scene to its end
  std::vector<FlightContact> contacts;  ///< sorted by begin
  SceneResult result;
};

/// Runs the scene under the detector and records the paths, piece by piece from event to event. Errors: as
/// run_scene().
Result<Flight> record_flight(const Scene& scene, const DetectorMaker& make);

}  // namespace kinesphere
