// What the engine finds in a scene.
#pragma once

#include <vector>

#include "lab/detector/detector.hpp"
#include "lab/scene/scene.hpp"
#include "lab/simulation/simulate.hpp"
#include "program_error.hpp"

namespace kinesphere::program {

inline std::vector<Event> events_of(const Scene& scene) {
  std::vector<Event> events;
  SimulationObserver observer;
  observer.on_event = [&](const Event& event) { events.push_back(event); };
  require(simulate(scene, make_world_detector, observer));
  return events;
}

}  // namespace kinesphere::program
