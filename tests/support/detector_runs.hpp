// Scenes and runs for tests that compare detectors with each other.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "kinesphere/motion/ballistic.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"
#include "support/playground.hpp"

namespace kinesphere {

/// Returns the first `at_most` events of the scene; audits the detector before every `audit_interval`th
/// advance.
inline std::vector<Event> events_of(const Scene& scene, const DetectorMaker& make,
                                    std::size_t at_most = 1000000, std::uint64_t audit_interval = 1) {
  std::vector<Event> events;
  std::uint64_t stops = 0;
  SceneObserver observer;
  observer.on_event = [&](const Event& event) {
    if (events.size() < at_most) events.push_back(event);
  };
  observer.between_events = [&](const Detector& detector) {
    if (++stops % audit_interval != 0) return;
    if (const auto finding = detector.audit())
      ADD_FAILURE() << detector.time() << ": " << finding->where << ": " << finding->what;
  };
  run_scene(scene, make, observer).value();
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

/// Returns the events of each pair, without begins of two that touch already.
inline std::map<PairKey, std::vector<Event>> by_pair(const std::vector<Event>& events) {
  std::map<PairKey, std::vector<Event>> found;
  for (const Event& event : events)
    if (!event.already_touching) found[{event.first.index, event.second.index, event.wall}].push_back(event);
  return found;
}

/// Expects each contact of a body to end when the body vanishes.
inline void expect_ends_of_contacts_of_the_vanished(const DetectorMaker& make) {
  Scene scene;
  scene.motion = std::make_unique<Ballistic>(
      Ballistic::create({.start = {{{0, 0, 0}, {}}, {{1, 0, 0}, {}}, {{0, 1, 0}, {}}}}).value());
  scene.bodies = {{.radius = 1, .appears = 1, .vanishes = 2}, {.radius = 1}, {.radius = 1, .appears = 1.5}};
  scene.end_time = 4.0;
  const auto events = events_of(scene, make);
  // 1-2 touch to the end; 0 touches both while it is there.
  ASSERT_EQ(events.size(), 5u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_begin);
  EXPECT_NEAR(events[0].time, 1.0, 0.011);
  EXPECT_EQ(events[3].kind, EventKind::contact_end);
  EXPECT_EQ(events[4].kind, EventKind::contact_end);
  EXPECT_EQ(events[3].first.index, 0u);
  EXPECT_EQ(events[3].second.index, 1u);
  EXPECT_EQ(events[4].second.index, 2u);
  EXPECT_EQ(events[4].time, 2.0);
}

/// Expects two balls that meet head on to bounce once, and then off the walls.
inline void expect_one_head_on_bounce(const DetectorMaker& make) {
  Scene scene;
  scene.world.contacts = ContactEvents::impacts;
  scene.world.box = Box{{-10, -10, -10}, {10, 10, 10}};
  scene.response = SceneResponse::bounce;
  scene.motion = std::make_unique<Ballistic>(
      Ballistic::create({.start = {{{-5, 0, 0}, {2, 0, 0}}, {{5, 0, 0}, {-2, 0, 0}}}}).value());
  scene.bodies = {{.radius = 1}, {.radius = 1}};
  scene.end_time = 9.9;  // together at 2, at the walls at 6, together at 10
  const auto events = events_of(scene, make);
  ASSERT_EQ(events.size(), 3u) << events;
  EXPECT_NEAR(events[0].time, 2.0, 2e-3);
  // Both at once: rounding alone says which comes first.
  const bool is_lower_first = events[1].wall == Wall::x_lower;
  EXPECT_EQ(events[is_lower_first ? 1 : 2].wall, Wall::x_lower) << events;
  EXPECT_EQ(events[is_lower_first ? 2 : 1].wall, Wall::x_upper) << events;
  EXPECT_NEAR(events[1].time, events[2].time, 5e-3);
  EXPECT_NEAR(events[2].time, 6.0, 5e-3);
}

}  // namespace kinesphere
