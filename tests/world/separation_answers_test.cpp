// Certified separation by a distance: safe_until(a, b, distance) and earliest_approach(a, distance).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinesphere/certificates.hpp"
#include "number/infinity.hpp"
#include "support/expect_error.hpp"
#include "world/crowd.hpp"

namespace kinesphere::separation_answers_test {
namespace {

constexpr double rounding_room = 1e-10;

class Separation : public testing::TestWithParam<CrowdKind> {
 protected:
  Separation() : crowd(GetParam()) {}

  /// Expects the true gap of the two, on their unchanged paths from now to `time`, to stay above the
  /// distance.
  void expect_apart(BodyId a, BodyId b, double distance, double time) {
    const double now = crowd.world.time();
    const double end = std::min(time, now + 2.0);
    if (!(end > now)) return;
    for (int k = 0; k < 40; ++k) {
      const double at = now + (end - now) * k / 40;
      ASSERT_GT(crowd.gap(a, b, at), distance - rounding_room)
          << a << " and " << b << " at " << at << ", said to be apart until " << time;
    }
  }

  void ask() {
    World& world = crowd.world;
    const BodyId a = crowd.any();
    const double distance = crowd.random.uniform() < 0.2 ? 0.0 : 4.0 * crowd.random.uniform();
    const bool probe = crowd.random.uniform() < 0.5;
    const std::uint64_t probes = world.counters().probes;
    const auto nearest = probe ? world.certificates(crowd.probe()).earliest_approach(a, distance)
                               : world.certificates().earliest_approach(a, distance);
    ASSERT_EQ(nearest->probed, world.counters().probes > probes);
    ASSERT_GE(nearest->time, world.time());
    double first = infinity;
    for (const BodyId b : world.bodies()) {
      if (a == b) continue;
      const SafeSeparation pair = world.certificates().safe_until(a, b, distance).value();
      first = std::min(first, pair.time);
      ASSERT_NO_FATAL_FAILURE(expect_apart(a, b, distance, pair.time));
      if (pair.within) {
        ASSERT_EQ(pair.time, world.time());
        ASSERT_LE(crowd.gap(a, b, world.time()), distance + rounding_room);
      }
      if (probe) {
        const SafeSeparation fresh = world.certificates(crowd.probe()).safe_until(a, b, distance).value();
        // With errors a later report may certify less than the one before.
        if (GetParam().noise == 0.0) {
          ASSERT_GE(fresh.time - world.time(), (1.0 - 1e-9) * (pair.time - world.time()));
        }
        ASSERT_NO_FATAL_FAILURE(expect_apart(a, b, distance, fresh.time));
        // Fresh reports leave only their errors open.
        if (fresh.time == world.time() && !fresh.within) {
          ASSERT_LE(crowd.gap(a, b, world.time()), distance + 8.0 * GetParam().noise + 1e-9);
        }
      }
    }
    if (!probe && nearest->wall == Wall::none) {
      ASSERT_EQ(nearest->time, first);
    }
    ASSERT_LE(world.certificates().earliest_approach(a, distance)->time, first);
    asked += first < infinity && first > world.time() ? 1 : 0;
  }

  Crowd crowd;
  int asked = 0;
};

TEST_P(Separation, IsNeverShorterThanCertified) {
  for (int stop = 1; stop <= 20; ++stop) {
    ASSERT_NO_FATAL_FAILURE(ask());
    while (const auto event = crowd.advance(-1.0 + 0.1 * stop)) crowd.bounce(*event);
    ASSERT_NO_FATAL_FAILURE(ask());
    for (int k = 0; k < 4; ++k) crowd.change();
  }
  EXPECT_GT(asked, 5);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Separation, crowd_kinds());

TEST(SafeSeparation, IsSharpForBallisticBodies) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .position = {0, 0, 0}, .velocity = {1, 0, 0}});
  const BodyId b = p.add({.radius = 1, .position = {100, 0, 0}, .velocity = {-1, 0, 0}});
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(p.world.certificates().safe_until(a, b, 50.0)->time, 24.0, 1e-9);
    EXPECT_NEAR(p.world.certificates().safe_until(a, b, 0.0)->time, 49.0, 1e-9);
    EXPECT_EQ(p.world.certificates().earliest_approach(a, 50.0)->partner, b);
    EXPECT_FALSE(p.world.certificates().safe_until(a, b, 50.0)->within);
    EXPECT_FALSE(p.advance(10.0 + k));
  }
  EXPECT_FALSE(p.advance(30.0));
  const auto now = p.world.certificates().safe_until(b, a, 50.0);
  EXPECT_EQ(now->time, 30.0);
  EXPECT_TRUE(now->within);
  EXPECT_TRUE(p.world.certificates().earliest_approach(b, 50.0)->within);
  EXPECT_FALSE(p.world.certificates().earliest_approach(b, 30.0)->within);
}

/// With old reports the world does not know whether the pair is within; a probe decides.
TEST(SafeSeparation, AProbeDecides) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .acceleration_limit = 1, .position = {0, 0, 0}}, Vec3{});
  const BodyId b = p.add({.radius = 1, .acceleration_limit = 1, .position = {30, 0, 0}}, Vec3{});
  EXPECT_FALSE(p.advance(3.9));
  const auto open = p.world.certificates().safe_until(a, b, 27.9);
  EXPECT_EQ(open->time, 3.9);
  EXPECT_FALSE(open->within);
  const auto decided = p.world.certificates(p.probe()).safe_until(a, b, 27.9);
  EXPECT_TRUE(decided->probed);
  EXPECT_NEAR(decided->time, 3.9 + std::sqrt(0.1), 1e-9);
  EXPECT_TRUE(p.world.certificates().safe_until(a, b, 29.0)->within);
}

TEST(SafeSeparation, FiltersDoNotCountForAPairButForABody) {
  Playground p;
  const BodyId a =
      p.add({.radius = 1, .position = {0, 0, 0}, .velocity = {1, 0, 0}, .filter = {.group = -1}});
  const BodyId b = p.add({.radius = 1, .position = {12, 0, 0}, .filter = {.group = -1}});
  const BodyId zone = p.world.add_static({.shape = Box{{20, -1, -1}, {21, 1, 1}}, .solid = false}).value();
  EXPECT_NEAR(p.world.certificates().safe_until(a, b, 2.0)->time, 8.0, 1e-9);
  const auto approach = p.world.certificates().earliest_approach(a, 2.0);
  EXPECT_EQ(approach->partner, zone);
  EXPECT_NEAR(approach->time, 17.0, 1e-9);
}

TEST(SafeSeparation, CountsWallsAndShapes) {
  Playground p({.box = Box{{0, 0, 0}, {100, 100, 100}}});
  const BodyId a = p.add({.radius = 1, .position = {50, 50, 50}, .velocity = {0, -1, 0}});
  const auto approach = p.world.certificates().earliest_approach(a, 10.0);
  EXPECT_EQ(approach->wall, Wall::y_lower);
  EXPECT_EQ(approach->partner, no_body);
  EXPECT_NEAR(approach->time, 39.0, 1e-9);
  EXPECT_TRUE(p.world.certificates().earliest_approach(a, 49.5)->within);
  const BodyId floor = p.world.add_static({.shape = HalfSpace{{0, 1, 0}, 5.0}}).value();
  EXPECT_EQ(p.world.certificates().earliest_approach(a, 10.0)->partner, floor);
  EXPECT_NEAR(p.world.certificates().safe_until(a, floor, 10.0)->time, 34.0, 1e-9);
  EXPECT_NEAR(p.world.certificates().safe_until(floor, a, 10.0)->time, 34.0, 1e-9);
  const BodyId box = p.world.add_static({.shape = Box{{0, 0, 0}, {1, 1, 1}}}).value();
  EXPECT_EQ(p.world.certificates().safe_until(floor, box, 1.0)->time, p.world.time())
      << "nothing is known of two shapes";
  EXPECT_FALSE(p.world.certificates().safe_until(floor, box, 1.0)->within);
}

/// All images count in periodic space.
TEST(SafeSeparation, WhereSpaceRepeats) {
  Playground p({.box = Box{{0, 0, 0}, {40, 40, 40}}, .periodic = {true, true, true}});
  const BodyId a = p.add({.radius = 1, .position = {2, 5, 5}, .velocity = {-1, 0, 0}});
  const BodyId b = p.add({.radius = 1, .position = {22, 5, 5}});
  EXPECT_NEAR(p.world.certificates().safe_until(a, b, 8.0)->time, 10.0, 1e-9) << "through the lower side";
  EXPECT_EQ(p.world.certificates().safe_until(a, b, 100.0)->time, p.world.time());
}

TEST(SafeSeparation, WrongDistancesAreRefused) {
  Playground p;
  const BodyId a = p.add({.radius = 1});
  const BodyId b = p.add({.radius = 1, .position = {5, 0, 0}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [wrong, code] :
       {std::pair(nan, ErrorCode::not_finite), std::pair(-1.0, ErrorCode::out_of_range),
        std::pair(infinity, ErrorCode::not_finite), std::pair(1e30, ErrorCode::out_of_range)}) {
    expect_error(p.world.certificates().safe_until(a, b, wrong), code, "distance", "safe_until:");
    expect_error(p.world.certificates(p.probe()).safe_until(a, b, wrong), code, "distance", "safe_until:");
    expect_error(p.world.certificates().earliest_approach(a, wrong), code, "distance", "earliest_approach:");
    expect_error(p.world.certificates(p.probe()).earliest_approach(a, wrong), code, "distance",
                 "earliest_approach:");
  }
  expect_error(p.world.certificates().safe_until(a, a, 1.0), ErrorCode::out_of_range, "second",
               "safe_until:", a);
  expect_error(p.world.certificates().earliest_approach({9, 0}, 1.0), ErrorCode::unknown_body, "body",
               "earliest_approach:", {9, 0});
  p.world.disable(b).value();
  EXPECT_EQ(p.world.certificates().safe_until(a, b, 1.0)->time, infinity) << "a disabled body is nowhere";
}

}  // namespace
}  // namespace kinesphere::separation_answers_test
