// Interactions of features, found by random mixtures of all of them.
#include <gtest/gtest.h>

#include "kinesphere/certificates.hpp"
#include "kinesphere/recording.hpp"
#include "support/playground.hpp"

namespace kinesphere::together_again_test {
namespace {

/// The world normalises the normal of a half-space; doing that twice may change its last bit.
TEST(RecordingOfSurroundings, KeepsTheNormalsOfHalfSpacesToTheBit) {
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    Playground p;
    p.world.start_recording().value();
    p.world.add_static({.shape = HalfSpace{random.unit_vector(), 0.5}}).value();
    p.run(1.0);
    Replay replay = Replay::open(p.world.stop_recording().value()).value();
    while (!replay.finished()) {
      const auto step = replay.advance();
      ASSERT_TRUE(step) << "half-space " << k << ": " << step.error().message;
    }
  }
}

/// The report is older than the change of limits, and the bound that it left grows with the old limits.
TEST(AnswersAfterALooserPromise, AreNotLaterThanTheContact) {
  Playground p({.box = Box{{0, 0, 0}, {100, 100, 100}}});
  const BodyId runner = p.add({.radius = 1, .position = {50, 50, 50}, .velocity = {1, 0, 0}});
  const BodyId post = p.world.add_static({.shape = Ball{{95, 50, 50}, 1}}).value();
  p.run(10.0);
  p.steer(runner, {5, 0, 0});
  p.world.change(runner, {.motion_limits = MotionLimits{.acceleration_limit = 5}}).value();
  const double of_world = p.world.certificates().safe_until()->time;
  const double of_body = p.world.certificates().safe_until(runner)->time;
  const double of_pair = p.world.certificates().safe_until(runner, post)->time;
  const double of_first = p.world.certificates().earliest_contact(runner)->time;
  const DistanceLimits limits = p.world.certificates().distance_limits(runner, post, 13.0).value();
  const double gap = 95.0 - p.state(runner, 13.0).position.x - 2.0;
  EXPECT_LE(limits.lower, gap);
  EXPECT_GE(limits.upper, gap);
  const auto contact = p.advance(100.0);
  ASSERT_TRUE(contact);
  for (const double answer : {of_world, of_body, of_pair, of_first}) EXPECT_LE(answer, contact->time);
}

TEST(AuditOfAStaticBody, KnowsItsSensor) {
  Playground p;
  p.world.set_sensor(1, {.distances = {2.0}}).value();
  p.world.add_static({.shape = Ball{}, .sensor_class = 1}).value();
  p.run(1.0);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(AuditOfAStaticBody, KnowsThePlane) {
  Playground p({.dimensions = 2});
  p.world.add_static({.shape = Ball{}}).value();
  p.world.add_static({.shape = Box{{3, 0, 0}, {4, 1, 1}}}).value();
  p.world.add_static({.shape = HalfSpace{{0, 1, 0}, -3}}).value();
  p.run(1.0);
  EXPECT_TRUE(is_clean(p.world));
}

/// While a sensor exists, facts end with swept spheres; the remaining ones do so afterwards, too.
TEST(Audit, AcceptsFactsFromBeforeTheLastSensorWentAway) {
  Playground p;
  p.world.set_sensor(1, {.distances = {2.0}}).value();
  p.add({.radius = 1});
  p.add({.radius = 1, .position = {0.5, 0, 0}, .velocity = {0.01, 0, 0}});
  for (int k = 0; k < 6; ++k) p.add({.radius = 0.1, .position = {3.0 + k, 3, 0}, .velocity = {0, 3, 0}});
  p.run(20.0);
  ASSERT_TRUE(is_clean(p.world));
  p.world.set_sensor(1, {}).value();
  EXPECT_TRUE(is_clean(p.world));
  p.run(200.0);
  EXPECT_TRUE(is_clean(p.world));
}

}  // namespace
}  // namespace kinesphere::together_again_test
