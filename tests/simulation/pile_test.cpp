// A thousand spheres fall into a heap and come to rest: time goes on, nobody sinks, the energy is gone.
#include "support/pile_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "simulation/scene/make_scene.hpp"

namespace kinesphere::scene_tests::pile_test {
namespace {

SceneParameters pile() {
  const auto& scenes = built_in_scenes();
  return *std::find_if(scenes.begin(), scenes.end(), [](const auto& scene) { return scene.name == "pile"; });
}

/// The mean of kinetic energies over the last `seconds`: a single frame fluctuates.
double late_energy(const PileWatch& watch, double seconds) {
  double sum = 0.0;
  int count = 0;
  for (const PileFrame& frame : watch.frames()) {
    if (frame.time < watch.frames().back().time - seconds) continue;
    sum += frame.kinetic_energy;
    ++count;
  }
  return sum / count;
}

SceneResult watched(PileWatch& watch, const Scene& scene) {
  return run_scene(scene, watch.watching(make_world_detector), watch.observer(0.02)).value();
}

TEST(Pile, ThousandSpheresSettleIn20Seconds) {
  const SceneParameters parameters = pile();
  ASSERT_EQ(parameters.bodies, 1000u);
  ASSERT_EQ(parameters.restitution, 0.5);
  ASSERT_EQ(parameters.seconds, 20.0);
  const Scene scene = make_scene(parameters).value();
  PileWatch watch(scene);
  const SceneResult result = watched(watch, scene);
  EXPECT_EQ(watch.frames().back().time, 20.0);
  EXPECT_EQ(watch.guards(), 0u);
  EXPECT_GE(watch.least_gap(), -scene.world.contact_tolerance * (1.0 + 1.0 / 16.0));
  // Of a fall of some 7 units, 69 per mass, less than a thousandth is left: hops of the resting speed, 0.5.
  EXPECT_LT(late_energy(watch, 5.0), 0.069 * 3.0);
  const double height = watch.frames().back().mean_height;
  EXPECT_LT(height, 3.3);
  EXPECT_GT(height, 2.5) << "it stands on the floor";
  EXPECT_LT(result.counters.steps() + result.counters.events[0], 20'000'000u);
}

struct PileCase {
  const char* name;
  double restitution;
  double tolerance;
};

class SmallPile : public ::testing::TestWithParam<PileCase> {};

TEST_P(SmallPile, KeepsItsDistances) {
  SceneParameters parameters = pile();
  parameters.bodies = 100;
  parameters.box.upper = {4, 4, 20};
  parameters.seconds = 5.0;
  parameters.restitution = GetParam().restitution;
  parameters.contact_tolerance = GetParam().tolerance;
  const Scene scene = make_scene(parameters).value();
  PileWatch watch(scene);
  const SceneResult result = watched(watch, scene);
  EXPECT_EQ(watch.frames().back().time, 5.0);
  EXPECT_EQ(result.counters.count(EventKind::zeno_guard), 0u);
  EXPECT_GE(watch.least_gap(), -scene.world.contact_tolerance * (1.0 + 1.0 / 16.0));
  if (parameters.restitution <= 0.5) {
    EXPECT_LT(late_energy(watch, 1.0), 2.0 * scene.resting_speed * scene.resting_speed);
  }
  if (parameters.restitution == 1.0) {
    const PileFrame& first = watch.frames().front();
    const PileFrame& last = watch.frames().back();
    const auto energy = [](const PileFrame& f) { return f.kinetic_energy + 9.81 * f.mean_height; };
    EXPECT_NEAR(energy(last), energy(first), 1e-9 * energy(first));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, SmallPile,
    ::testing::Values(PileCase{"restitution_0", 0.0, 5e-4}, PileCase{"restitution_0_3", 0.3, 5e-4},
                      PileCase{"restitution_0_5", 0.5, 5e-4}, PileCase{"restitution_0_9", 0.9, 5e-4},
                      PileCase{"restitution_1", 1.0, 5e-4}, PileCase{"tolerance_5e_3", 0.5, 5e-3},
                      PileCase{"tolerance_5e_6", 0.5, 5e-6}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(Pile, RestingSpeedFitsTheTolerance) {
  SceneParameters parameters = pile();
  parameters.bodies = 1;
  EXPECT_EQ(make_scene(parameters).value().resting_speed, 0.5);
  parameters.contact_tolerance = 0.1;
  EXPECT_GT(make_scene(parameters).value().resting_speed, 1.7) << "raised to sqrt(3 * 0.1 * 9.81)";
  parameters.resting_speed = 0.0;
  EXPECT_EQ(make_scene(parameters).value().resting_speed, 0.0);
}

TEST(Pile, WrongParametersAreNamed) {
  SceneParameters parameters = pile();
  parameters.resting_speed = -1.0;
  EXPECT_EQ(make_scene(parameters).error().argument, "resting_speed");
  parameters = pile();
  parameters.zeno_interval = -1.0;
  EXPECT_EQ(make_scene(parameters).error().argument, "zeno_interval");
}

}  // namespace
}  // namespace kinesphere::scene_tests::pile_test
