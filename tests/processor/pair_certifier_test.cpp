// What is certain of pairs at an instant, against bodies that move as their bounds allow.
#include "processor/pair_certifier.hpp"

#include <gtest/gtest.h>

#include "kinesphere/random.hpp"
#include "support/small_world.hpp"
#include "support/true_balls.hpp"

namespace kinesphere::pair_certifier_test {
namespace {

constexpr std::uint64_t seed = 5204;

/// Two bodies in windows from now on.
class PairCertifierTest : public testing::Test {
 protected:
  void add(const BodyDefinition& body, int rung) {
    const std::uint32_t number = world.add(body);
    world.state.bodies[number].mark_visited();
    world.state.broad_phase.enter(number, inflated_bound(world.state.bodies, number, 0.0), 0.0,
                                  Window::at(0.0, rung));
  }
  PairCertifier certifier() const { return {world.state, 0.0, nullptr}; }

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
           .velocity = 2.0 * random.point_in_ball()},
          static_cast<int>(one));
    const double until = certifier().apart_until(k, k + 1);
    EXPECT_EQ(until, certifier().apart_until(k + 1, k));
    const double end = certifier().earliest_window_end(k, k + 1);
    EXPECT_EQ(end, 1.0);
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

TEST_F(PairCertifierTest, NamesBodiesInTheirOrder) {
  add({.position = {0, 0, 0}}, 0);
  add({.position = {9, 0, 0}}, 0);
  const PairCertificate pair = certifier().certificate(3.0, 1, 0);
  EXPECT_EQ(pair.first, 0u);
  EXPECT_EQ(pair.second, 1u);
  EXPECT_EQ(pair.failure_time, 3.0);
  EXPECT_FALSE(certifier().is_stale(pair));
  const PairCertificate walls = certifier().certificate(3.0, 1, PairCertificate::walls);
  EXPECT_EQ(walls.first, 1u);
  EXPECT_EQ(walls.kind(), PairCertificate::Kind::with_walls);
  ++world.state.bodies[0].revision;
  EXPECT_TRUE(certifier().is_stale(pair));
  EXPECT_FALSE(certifier().is_stale(walls)) << "of another body";
}

TEST_F(PairCertifierTest, ForgetsPairsThatFiltersKeepApart) {
  add({.velocity = {1, 0, 0}, .filter = {.category = 2, .mask = 4}}, 3);
  add({.position = {3, 0, 0}}, 3);
  EXPECT_EQ(certifier().apart_until(0, 1), infinity);
  EXPECT_EQ(certifier().unchanged_until_by_thresholds(0, 1), infinity);
  SearchResults found;
  EXPECT_EQ(certifier().certify(0, 1, found), infinity);
  EXPECT_EQ(found.candidates, 1u);
  EXPECT_EQ(found.near, 0u);
  EXPECT_TRUE(found.certificates.empty());
}

TEST_F(PairCertifierTest, LeavesLinkedPairsToTheContactGraph) {
  add({.acceleration_limit = 1.0}, 3);
  add({.acceleration_limit = 1.0, .position = {2, 0, 0}}, 3);
  Event touch{.first = world.state.bodies.id_of(0), .second = world.state.bodies.id_of(1)};
  world.state.contacts.set_state(touch, {.approach = ApproachState::reported});
  EXPECT_TRUE(certifier().are_linked(0, 1));
  SearchResults found;
  EXPECT_EQ(certifier().certify(0, 1, found), infinity);
  EXPECT_TRUE(found.certificates.empty());
  certifier().certify_linked(0, found);
  ASSERT_EQ(found.certificates.size(), 1u);
  EXPECT_EQ(found.certificates.front().second, 1u);
  found.keeps_linked = true;
  (void)certifier().certify(0, 1, found);
  EXPECT_EQ(found.linked.size(), 1u) << "for a search whose certificates begin later";
}

TEST_F(PairCertifierTest, HasThresholdsInwardAndOutward) {
  world.state.bodies.sensors.set(1, {.distances = {1.0, 3.0}});
  add({.sensor_class = 1}, 0);
  add({.position = {4, 0, 0}}, 0);
  const auto thresholds = [&] {
    std::vector<std::pair<bool, double>> all;
    certifier().for_each_threshold(0, 1, [&](const Threshold& one) {
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
  world.state.broad_phase.enter(0, inflated_bound(world.state.bodies, 0, 0.0), 0.0, Window::at(0.0, 4));
  const PairCertifier certifier(world.state, 0.0, nullptr);
  EXPECT_EQ(certifier.walls_end_of(0), 16.0);
  EXPECT_NEAR(certifier.walls_unchanged_until(0), 3.0, 1e-5);
  EXPECT_LE(certifier.walls_unchanged_until(0), 3.0);
  SearchResults found;
  certifier.certify_walls(0, found);
  ASSERT_EQ(found.certificates.size(), 1u);
  EXPECT_EQ(found.certificates.front().kind(), PairCertificate::Kind::with_walls);
  world.state.contacts.set_touching({.first = world.state.bodies.id_of(0), .wall = Wall::x_upper}, true);
  EXPECT_EQ(certifier.walls_unchanged_until(0), 0.0) << "it touches one";
}

}  // namespace
}  // namespace kinesphere::pair_certifier_test
