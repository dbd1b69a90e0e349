// A gas of hard spheres has the collision rate and the pressure of theory.
#include "research/measures/gas_properties.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "kinesphere/motion/ballistic.hpp"
#include "simulation/scene/make_scene.hpp"

namespace kinesphere::gas_properties_test {
namespace {

SceneParameters small_gas() {
  const auto& scenes = built_in_scenes();
  SceneParameters gas = *std::find_if(scenes.begin(), scenes.end(),
                                      [](const auto& scene) { return scene.name == "periodic_gas"; });
  gas.bodies = 50;
  gas.seconds = 1.0;
  return gas;
}

TEST(HardSphereTheory, BeginsWithTheVirialsOfADiluteGas) {
  const double packing = 1e-4;
  EXPECT_NEAR(hard_sphere_compressibility(packing), 1.0 + 4.0 * packing + 10.0 * packing * packing, 1e-10);
  EXPECT_EQ(hard_sphere_compressibility(0.0), 1.0);
  EXPECT_EQ(hard_sphere_collision_rate(0.0), 0.0);
}

/// The reference is hardsphere_Z_and_collision_rate.csv of the project's data, to its six decimals.
TEST(HardSphereTheory, IsThatOfTheReference) {
  struct Row {
    double packing, compressibility, rate;
  };
  for (const Row& row :
       {Row{0.05, 1.227485, 0.770069}, Row{0.10, 1.521647, 1.765845}, Row{0.25, 3.080182, 7.041703},
        Row{0.40, 6.945460, 20.126198}, Row{0.49, 12.170358, 37.813199}}) {
    EXPECT_NEAR(hard_sphere_compressibility(row.packing), row.compressibility, 6e-7) << row.packing;
    EXPECT_NEAR(hard_sphere_collision_rate(row.packing), row.rate, 2e-6) << row.packing;
  }
}

class Gas : public testing::TestWithParam<double> {};

/// A fifth of the contacts, 80 collisions of each sphere, let the gas forget its start. The standard error is
/// then about 0.2 % (that of a count, 1 / sqrt(320,000), is 0.18 %); the finite size shifts results by 1 / N
/// = 0.05 %.
TEST_P(Gas, HasTheRateAndThePressureOfTheory) {
  const double packing = GetParam();
  const GasBlocks blocks{.equilibration = 10, .measured = 40};
  const double contacts = 400'000;
  SceneParameters gas = small_gas();
  gas.bodies = 2000;
  gas.packing = packing;
  gas.seconds = contacts / (0.5 * gas.bodies * hard_sphere_collision_rate(packing));
  SCOPED_TRACE(testing::Message() << "packing " << packing << ", seed " << gas.seed);
  const GasProperties found = measure_gas(make_scene(gas).value(), make_world_detector, blocks).value();
  EXPECT_NEAR(found.packing, packing, 1e-12);

  const auto expect_close = [](const Estimate& estimate, double theory) {
    EXPECT_GT(estimate.standard_error, 0.0);
    EXPECT_LT(estimate.standard_error, 0.004 * theory);
    EXPECT_NEAR(estimate.value, theory, 0.005 * theory + 2.0 * estimate.standard_error);
  };
  expect_close(found.compressibility, hard_sphere_compressibility(packing));
  expect_close(found.collision_rate, hard_sphere_collision_rate(packing));
  EXPECT_LT(found.energy_change, 1e-11);
  EXPECT_LT(found.momentum_change, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Packings, Gas, testing::Values(0.05, 0.25, 0.49));

/// Two spheres meet head on for ever, so the virial is known.
TEST(GasProperties, OfTwoSpheresAreCountedByHand) {
  // The spheres meet at 1.5 and, across the periodic box, at 5.5 and 9.5.
  Scene scene;
  scene.world = {.box = Box{{0, 0, 0}, {10, 10, 10}},
                 .periodic = {true, true, true},
                 .contact_tolerance = 1e-9,
                 .contacts = ContactEvents::impacts};
  scene.bodies = {{.radius = 0.5}, {.radius = 0.5}};
  scene.motion = std::make_unique<Ballistic>(
      Ballistic::create({.start = {{{2, 5, 5}, {1, 0, 0}}, {{6, 5, 5}, {-1, 0, 0}}}}).value());
  scene.response = SceneResponse::bounce;
  scene.end_time = 8.0;
  const GasBlocks blocks{.equilibration = 2, .measured = 6};
  const GasProperties found = measure_gas(scene, make_world_detector, blocks).value();
  // The sum of m v^2 is 2 = 3 (N - 1) kT, the exchanged momentum is 2, and the measured time is 6.
  const double temperature = 2.0 / 3.0;
  EXPECT_EQ(found.contacts, 1u);
  EXPECT_NEAR(found.packing, 3.14159265358979 / 3000.0, 1e-12);
  EXPECT_NEAR(found.compressibility.value, 1.0 + 2.0 / (3.0 * 2.0 * temperature * 6.0), 1e-8);
  EXPECT_NEAR(found.collision_rate.value, 2.0 / (2.0 * 6.0) / std::sqrt(temperature), 1e-8);
  // One block has all contacts, so the standard error is as large as the mean.
  EXPECT_NEAR(found.collision_rate.standard_error, found.collision_rate.value, 1e-8);
  EXPECT_NEAR(found.energy_change, 0.0, 1e-15);
  EXPECT_EQ(found.result.counters.count(EventKind::contact_begin), 2u);
}

/// kT is that of the motion relative to the centre of mass.
TEST(GasProperties, KnowNoCommonMotion) {
  const auto measured = [](const Vec3& wind) {
    Scene scene = make_scene(small_gas()).value();
    std::vector<State> start;
    for (std::uint32_t body = 0; body < scene.bodies.size(); ++body) {
      start.push_back(scene.motion->state(body, 0.0));
      start.back().velocity += wind;
    }
    scene.motion = std::make_unique<Ballistic>(Ballistic::create({.start = start}).value());
    return measure_gas(scene, make_world_detector, {.equilibration = 0, .measured = 2}).value();
  };
  const GasProperties still = measured({});
  const GasProperties windy = measured({0.5, -0.25, 0});
  // The contacts are few and early, before chaos changes them.
  EXPECT_EQ(windy.contacts, still.contacts);
  EXPECT_NEAR(windy.compressibility.value, still.compressibility.value, 1e-3);
  EXPECT_NEAR(windy.collision_rate.value, still.collision_rate.value, 1e-9);
}

}  // namespace
}  // namespace kinesphere::gas_properties_test
