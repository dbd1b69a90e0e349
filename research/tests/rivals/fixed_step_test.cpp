// A detector at fixed steps comes close to the oracle, or misses contacts.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "kinesphere/motion/ballistic.hpp"
#include "research/rivals/rivals.hpp"
#include "simulation/oracle/oracle.hpp"
#include "support/detector_runs.hpp"
#include "support/playground.hpp"

namespace kinesphere::fixed_step_test {
namespace {

DetectorMaker fixed_step(double step) {
  return [step](const WorldDefinition& definition, const Motion& motion) {
    return make_fixed_step_detector(definition, motion, step);
  };
}

TEST(FixedStep, ConvergesToTheOracleInABenignScene) {
  const Scene scene = dense_scene(SceneResponse::pass_through, false, 5);
  const auto truth = by_pair(events_of(scene, make_oracle));
  double last_error = 1e9;
  std::size_t last_missing = 1000000;
  for (const double step : {1.0 / 16, 1.0 / 128, 1.0 / 1024}) {
    const auto found = by_pair(events_of(scene, fixed_step(step)));
    double error = 0.0;
    std::size_t missing = 0;
    for (const auto& [key, events] : truth) {
      const auto same = found.find(key);
      if (same == found.end() || same->second.size() != events.size()) {
        ++missing;
        continue;
      }
      for (std::size_t k = 0; k < events.size(); ++k) {
        const double late = same->second[k].time - events[k].time;
        EXPECT_GE(late, -1e-6);
        EXPECT_LE(late, step + 1e-6);
        error = std::max(error, late);
      }
    }
    EXPECT_LT(error, last_error);
    EXPECT_LE(missing, last_missing);
    last_error = error;
    last_missing = missing;
  }
  EXPECT_LE(last_error, 1.0 / 1024 + 1e-6);
  EXPECT_LE(last_missing, truth.size() / 50);
}

TEST(FixedStep, MissesFastBulletsThatWorldAndOracleSee) {
  Scene scene;
  std::vector<State> start;
  for (int k = 0; k < 20; ++k) {
    start.push_back({{0, 3.0 * k, 0}, {}});
    start.push_back({{-50.0 - 0.7 * k, 3.0 * k, 0}, {300.0, 0, 0}});
  }
  scene.motion = std::make_unique<Ballistic>(Ballistic::create({.start = start}).value());
  for (int k = 0; k < 40; ++k) scene.bodies.push_back({.radius = k % 2 == 0 ? 0.2 : 0.01});
  scene.end_time = 1.0;
  const auto begins = [&](const DetectorMaker& make) {
    return of_kind(events_of(scene, make), EventKind::contact_begin).size();
  };
  EXPECT_EQ(begins(make_world_detector), 20u);
  EXPECT_EQ(begins(make_oracle), 20u);
  EXPECT_LT(begins(fixed_step(1.0 / 60)), 5u);
}

TEST(FixedStep, RefusesAStepThatIsNone) {
  const auto motion = Ballistic::create({.start = {{}}}).value();
  for (const double step :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const auto detector = make_fixed_step_detector({}, motion, step);
    ASSERT_FALSE(detector);
    EXPECT_EQ(detector.error().argument, "step");
  }
}

TEST(FixedStep, EndsTheContactsOfTheVanished) { expect_ends_of_contacts_of_the_vanished(fixed_step(0.01)); }

TEST(FixedStep, HeadOnBouncesOnceAndGoesOn) { expect_one_head_on_bounce(fixed_step(1e-3)); }

}  // namespace
}  // namespace kinesphere::fixed_step_test
