// The engine's events of a scene.
#pragma once

#include <vector>

#include "base/program_error.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

inline std::vector<Event> events_of(const Scene& scene) {
  std::vector<Event> events;
  SceneObserver observer;
  observer.on_event = [&](const Event& event) { events.push_back(event); };
  require(run_scene(scene, make_world_detector, observer));
  return events;
}

}  // namespace kinesphere::program
