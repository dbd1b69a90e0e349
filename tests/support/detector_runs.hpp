// Scenes and runs for tests that compare detectors with each other.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <tuple>
#include <vector>

#include "simulation/detector/detector.hpp"
#include "simulation/run/simulate.hpp"
#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// Returns the first `at_most` events of the scene; audits the detector before each.
inline std::vector<Event> events_of(const Scene& scene, const DetectorMaker& make,
                                    std::size_t at_most = 1000000) {
  std::vector<Event> events;
  SimulationObserver observer;
  observer.on_event = [&](const Event& event) {
    if (events.size() < at_most) events.push_back(event);
  };
  observer.between_events = [&](const Detector& detector) {
    if (const auto finding = detector.audit())
      ADD_FAILURE() << detector.time() << ": " << finding->where << ": " << finding->what;
  };
  simulate(scene, make, observer).value();
  return events;
}

/// Returns a scene of 30 bodies in a box of edge 12.
inline Scene dense_scene(SceneResponse response, bool forces, std::uint64_t seed) {
  SceneParameters parameters{.bodies = 30,
                             .radius_min = 0.5,
                             .radius_max = 1.5,
                             .speed_min = 1.0,
                             .speed_max = 4.0,
                             .limit_min = forces ? 3.0 : 0.0,
                             .limit_max = forces ? 6.0 : 0.0,
                             .box = {{0, 0, 0}, {12, 12, 12}},
                             .response = response,
                             .contact_tolerance = 1e-9,
                             .seconds = 6.0,
                             .seed = seed};
  if (!forces) parameters.motion = SceneParameters::MotionKind::ballistic;
  return make_scene(parameters).value();
}

/// First body, second body (the first again for a wall), wall.
using PairKey = std::tuple<std::uint32_t, std::uint32_t, Wall>;

inline std::map<PairKey, std::vector<Event>> by_pair(const std::vector<Event>& events) {
  std::map<PairKey, std::vector<Event>> found;
  for (const Event& event : events)
    found[{event.first.index, event.second.index, event.wall}].push_back(event);
  return found;
}

}  // namespace kinesphere
