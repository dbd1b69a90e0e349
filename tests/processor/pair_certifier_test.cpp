// What is certain of pairs at an instant, against bodies that move as their bounds allow.
#include "processor/pair_certifier.hpp"

#include <gtest/gtest.h>

#include "kinesphere/random.hpp"
#include "support/small_world.hpp"
#include "support/true_balls.hpp"

namespace kinesphere::pair_certifier_test {
namespace {

constexpr std::uint64_t seed = 5204;

/// Bodies in safe regions.
class PairCertifierTest : public testing::Test {
 protected:
  void add(const BodyDefinition& body) {
    world.add(body);
    ASSERT_TRUE(world.main.recertify());
  }
  PairCertifier certifier() const { return {world.state, 0.0}; }

  SmallWorld world;
};

TEST_F(PairCertifierTest, IsNeverLateAndTheSameFromBothSides) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (std::uint32_t k = 0; k < 800; k += 2) {
    for (std::uint32_t one = 0; one < 2; ++one)
      add({.radius = 0.5 * random.uniform(),
           .acceleration_limit = random.uniform(),
           .velocity_error = 0.1 * random.uniform(),
           .position = 2.0 * random.point_in_ball(),
           .velocity = 2.0 * random.point_in_ball()});
    const double until = certifier().apart_until(k, k + 1);
    EXPECT_EQ(until, certifier().apart_until(k + 1, k));
    const double end = certifier().earlier_own_time(k, k + 1);
    const Bound& a = world.state.bodies[k].bound;
    const Bound& b = world.state.bodies[k + 1].bound;
    if (until > 0.0) {
      EXPECT_GT(least_true_gap(a, b, 0.0, std::min(until, end) * 0.999999), 0.0) << k;
    }
    if (until == 0.0) {
      EXPECT_LE(true_gap(true_ball(a, 0.0), true_ball(b, 0.0)), 2e-6) << k;
    }
  }
}

TEST_F(PairCertifierTest, ForgetsPairsThatFiltersKeepApart) {
  add({.velocity = {1, 0, 0}, .filter = {.category = 2, .mask = 4}});
  add({.position = {3, 0, 0}});
  EXPECT_EQ(certifier().apart_until(0, 1), infinity);
  EXPECT_EQ(certifier().unchanged_until(0, 1, world.state.contacts.links_of(0, 1)), infinity);
}

TEST_F(PairCertifierTest, HasThresholdsInwardAndOutward) {
  world.state.bodies.sensors.set(1, {.distances = {1.0, 3.0}});
  world.add({.sensor_class = 1});
  world.add({.position = {4, 0, 0}});
  const auto thresholds = [&] {
    std::vector<std::pair<bool, double>> all;
    certifier().for_each_threshold(0, 1, world.state.contacts.links_of(0, 1), [&](const Threshold& one) {
      if (one.sensed) all.emplace_back(one.within, one.distance);
    });
    return all;
  };
  using All = std::vector<std::pair<bool, double>>;
  EXPECT_EQ(thresholds(), (All{{false, 3.0}}));
  Event enter{.kind = EventKind::sensor_enter,
              .first = world.state.bodies.id_of(0),
              .second = world.state.bodies.id_of(1)};
  enter.distance = 3.0;
  world.state.contacts.set_touching(enter, true);
  EXPECT_EQ(thresholds(), (All{{false, 1.0}, {true, 3.0}}));
}

TEST(PairCertifierWalls, AreClearUntilABodyMayReachThem) {
  SmallWorld world({.box = Box{{-9, -9, -9}, {9, 9, 9}}});
  world.add({.position = {5, 0, 0}, .velocity = {1, 0, 0}});
  ASSERT_TRUE(world.main.recertify());
  const PairCertifier certifier(world.state, 0.0);
  EXPECT_GT(certifier.walls_unchanged_until(0), 0.0);
  EXPECT_LE(std::min(certifier.walls_unchanged_until(0), certifier.own_time(0)), 3.0);
  world.state.contacts.set_touching({.first = world.state.bodies.id_of(0), .wall = Wall::x_upper}, true);
  EXPECT_EQ(certifier.walls_unchanged_until(0), 0.0) << "it touches one";
}

}  // namespace
}  // namespace kinesphere::pair_certifier_test
