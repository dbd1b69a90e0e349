// A recorded simulation: its replay gives the hash that it gave, though bodies come, go and take each other's
// indices.
#include <gtest/gtest.h>

#include <limits>

#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/recording.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/oracle/oracle.hpp"
#include "simulation/run/recorded_scene.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/scene.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::recorded_scene_test {
namespace {

/// Bodies fly through each other; each is there for a while.
Scene coming_and_going() {
  Random random(7);
  BallisticDefinition flight;
  Scene scene;
  scene.end_time = 4.0;
  for (int k = 0; k < 60; ++k) {
    flight.start.push_back({Vec3{5, 5, 5} + 4.0 * random.point_in_ball(), random.point_in_ball()});
    const double appears = k % 3 == 0 ? 0.0 : random.uniform(0.0, 3.0);
    scene.bodies.push_back({.radius = random.uniform(0.2, 1.0), .appears = appears});
    if (k % 2 == 0) scene.bodies.back().vanishes = appears + random.uniform(0.1, 1.0);
  }
  scene.motion = std::make_unique<Ballistic>(Ballistic::create(flight).value());
  return scene;
}

TEST(RecordedScene, ReplaysToTheSameResult) {
  const Scene scene = coming_and_going();
  std::vector<std::byte> recording;
  SceneObserver observer;
  observer.at_start = [](Detector& detector) { return detector.start_recording(); };
  observer.at_end = [&](Detector& detector) -> Result<void> {
    recording = detector.stop_recording().value();
    return {};
  };
  const SceneResult expected = run_scene(scene, make_world_detector, observer).value();
  EXPECT_GT(expected.counters.count(EventKind::contact_end), 15u);
  EXPECT_EQ(expected.contact_hash, run_scene(scene, make_world_detector).value().contact_hash);
  EXPECT_GT(expected.memory.value().total(), 10000u);
  const SceneResult found = replay(recording).value();
  EXPECT_EQ(found.contact_hash, expected.contact_hash);
  EXPECT_EQ(found.counters.probes, expected.counters.probes);
  EXPECT_EQ(found.simulated_time, expected.simulated_time);
  EXPECT_NEAR(found.body_time, expected.body_time, 1e-9);
  bool reused = false;
  for (const Event& event : read_recording(recording).value().events)
    reused = reused || event.first.generation > 0;
  EXPECT_TRUE(reused) << "the test does not show what it is for";
}

TEST(RecordedScene, IsRefusedWhereItCannotBe) {
  expect_error(replay({}), ErrorCode::bad_recording, "recording", "Replay::open");
  const Scene scene = coming_and_going();
  SceneObserver observer;
  observer.at_start = [](Detector& detector) { return detector.start_recording(); };
  expect_error(run_scene(scene, make_oracle, observer), ErrorCode::unsupported, "detector",
               "start_recording");
  observer.at_start = {};
  observer.at_end = [](Detector& detector) -> Result<void> { return detector.stop_recording().error(); };
  expect_error(run_scene(scene, make_oracle, observer), ErrorCode::unsupported, "detector", "stop_recording");
  expect_error(run_scene(scene, make_world_detector, observer), ErrorCode::not_recording, "world",
               "stop_recording");
}

}  // namespace
}  // namespace kinesphere::recorded_scene_test
