// Built-in scenes, run by the world itself: the same as a loop over advance(), with any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/workers.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/oracle/oracle.hpp"
#include "simulation/run/recorded_scene.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/make_scene.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::run_test {
namespace {

/// As crowded as the scene itself, with fewer bodies and for a shorter time.
Scene small(SceneParameters parameters) {
  constexpr std::uint32_t bodies = 400;
  if (parameters.bodies > bodies) {
    const double part = std::cbrt(bodies / static_cast<double>(parameters.bodies));
    parameters.box.upper = parameters.box.lower + part * (parameters.box.upper - parameters.box.lower);
    parameters.bodies = bodies;
  }
  parameters.seconds = std::min(parameters.seconds, 4.0);
  return make_scene(parameters).value();
}

/// Bodies bounce; each is there for a while, and some are turned.
Scene coming_and_going() {
  Random random(11);
  RandomForcesDefinition forces;
  Scene scene;
  scene.name = "coming_and_going";
  scene.end_time = 5.0;
  scene.response = SceneResponse::bounce;
  for (std::uint32_t k = 0; k < 150; ++k) {
    forces.start.push_back({4.0 * random.point_in_ball(), 2.0 * random.point_in_ball()});
    forces.acceleration_limits.push_back(random.uniform(0.0, 8.0));
    const double appears = k % 3 == 0 ? 0.0 : random.uniform(0.0, 2.0);
    scene.bodies.push_back({.radius = random.uniform(0.2, 0.8), .appears = appears});
    if (k % 2 == 0) scene.bodies.back().vanishes = appears + random.uniform(0.3, 2.0);
    if (k % 5 == 0) scene.turns.push_back({appears + 0.2, k, 3.0 * random.point_in_ball()});
  }
  scene.motion = std::make_unique<RandomForces>(RandomForces::create(forces).value());
  return scene;
}

std::vector<Scene> scenes() {
  std::vector<Scene> all;
  for (const SceneParameters& parameters : built_in_scenes()) {
    all.push_back(small(parameters));
    all.push_back(small(parameters));
    all.back().response = SceneResponse::pass_through;
    all.back().name += "_pass_through";
  }
  all.push_back(coming_and_going());
  return all;
}

/// Where bodies are kicked, most are near others that are kicked too.
std::vector<Scene> dense_scenes() {
  std::vector<Scene> all;
  for (SceneParameters parameters : built_in_scenes()) {
    if (parameters.name != "paper1" && parameters.name != "gas" && parameters.name != "periodic_gas")
      continue;
    parameters.packing = 0.4;
    parameters.bodies = 1500;
    parameters.seconds = 2.0;
    parameters.name = "dense_" + parameters.name;
    all.push_back(make_scene(parameters).value());
  }
  return all;
}

/// What does not depend on how many threads there are: all but how many searches look at.
std::string outcome_of(const SceneResult& result) {
  const Counters& counters = result.counters;
  std::ostringstream text;
  text << std::hex << result.contact_hash << std::dec << " events";
  for (const std::uint64_t count : counters.events) text << ' ' << count;
  text << " probes " << counters.probes << " window ends " << counters.window_ends << " starts "
       << counters.starts << " restarts " << counters.restarts << " checks " << counters.pair_checks << ' '
       << counters.wall_checks << " searches " << counters.searches << " hot pairs " << counters.hot_pairs
       << " certificates " << counters.certificates << " Zeno steps " << counters.zeno_steps << " repeated "
       << counters.repeated_contacts;
  return text.str();
}

/// Runs with these numbers of threads, as a loop does.
class RunScenes : public testing::TestWithParam<std::vector<int>> {
 protected:
  void expect_runs_as_loops(const std::vector<Scene>& scenes) const;
};

INSTANTIATE_TEST_SUITE_P(Of, RunScenes, testing::Values(std::vector{1, 3}));
INSTANTIATE_TEST_SUITE_P(Long, RunScenes, testing::Values(std::vector{2, 8}));

void RunScenes::expect_runs_as_loops(const std::vector<Scene>& scenes) const {
  for (const Scene& scene : scenes) {
    const SceneResult looped = run_scene(scene, make_world_detector).value();
    EXPECT_GT(looped.counters.probes, 500u) << scene.name;
    for (const int threads : GetParam()) {
      Workers workers = Workers::create(threads).value();
      EXPECT_EQ(outcome_of(run_scene(scene, make_world_detector, {}, &workers).value()), outcome_of(looped))
          << scene.name << " with " << threads << " threads";
    }
  }
}

TEST_P(RunScenes, EndsAsALoopDoes) { expect_runs_as_loops(scenes()); }

TEST_P(RunScenes, EndsAsALoopDoesWhereManyAreKicked) { expect_runs_as_loops(dense_scenes()); }

TEST_P(RunScenes, CanBeRecorded) {
  for (const int threads : GetParam()) {
    Workers workers = Workers::create(threads).value();
    const Scene scene = coming_and_going();
    std::vector<std::byte> recording;
    SceneObserver observer;
    observer.at_start = [](Detector& detector) { return detector.start_recording(); };
    observer.at_end = [&](Detector& detector) -> Result<void> {
      recording = detector.stop_recording().value();
      return {};
    };
    const SceneResult run = run_scene(scene, make_world_detector, observer, &workers).value();
    EXPECT_EQ(replay(recording).value().contact_hash, run.contact_hash) << threads << " threads";
  }
}

TEST(RunScenesWithoutAWay, AreRefused) {
  Workers workers = Workers::create(1).value();
  Scene scene = coming_and_going();
  expect_error(run_scene(scene, make_oracle, {}, &workers), ErrorCode::unsupported, "detector", "run:");
  std::vector<Track> tracks;
  Random random(3);
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    const Vec3 start = 8.0 * random.point_in_ball();
    tracks.push_back({{0.0, start}, {4.0, -start}});
  }
  scene.turns.clear();
  scene.motion = std::make_unique<RecordedTracks>(RecordedTracks::create(tracks).value());
  const auto looped = run_scene(scene, make_world_detector);
  const auto run = run_scene(scene, make_world_detector, {}, &workers);
  ASSERT_FALSE(looped);
  expect_error(run, ErrorCode::unsupported, "response", "simulate:", looped.error().body);
}

}  // namespace
}  // namespace kinesphere::run_test
