// Bodies at rest within a hair of each other: nothing changes, and time must go on.
#include <gtest/gtest.h>

#include "support/playground.hpp"

namespace kinesphere::standstill_test {
namespace {

struct Standstill {
  ContactEvents mode;
  double gap;
};

class StandstillTest : public testing::TestWithParam<Standstill> {};

/// A recheck is good for at least the time in which the gap could change by an eighth of the tolerance, 1e-6.
constexpr std::uint64_t enough_looks = 50000;

TEST_P(StandstillTest, OfTwoBodiesDoesNotStopTime) {
  Playground p({.contacts = GetParam().mode});
  p.add({.radius = 1, .acceleration_limit = 1}, Vec3{});
  p.add({.radius = 1, .acceleration_limit = 1, .position = {2.0 + GetParam().gap, 0, 0}}, Vec3{});
  p.run(2.0);
  EXPECT_LT(p.world.counters().pair_checks, enough_looks);
  EXPECT_TRUE(is_clean(p.world));
}

TEST_P(StandstillTest, AtAWallDoesNotStopTime) {
  Playground p({.box = Box{{0, 0, 0}, {10, 10, 10}}, .contacts = GetParam().mode});
  p.add({.radius = 1, .acceleration_limit = 1, .position = {1.0 + GetParam().gap, 5, 5}}, Vec3{});
  p.run(2.0);
  EXPECT_LT(p.world.counters().wall_checks, enough_looks);
  EXPECT_TRUE(is_clean(p.world));
}

TEST_P(StandstillTest, OfBodiesWithUncertainVelocityDoesNotStopTime) {
  Playground p({.contact_tolerance = 1e-3, .contacts = GetParam().mode});
  p.add({.radius = 1, .velocity_error = 0.1});
  p.add({.radius = 1, .velocity_error = 0.1, .position = {2.0 + 1e3 * GetParam().gap, 0, 0}});
  p.run(2.0);
  EXPECT_LT(p.world.counters().pair_checks, enough_looks);
  EXPECT_TRUE(is_clean(p.world));
}

std::vector<Standstill> standstills() {
  std::vector<Standstill> cases;
  for (const ContactEvents mode : {ContactEvents::begin_and_end, ContactEvents::impacts})
    for (const double gap : {-0.5e-6, -0.2e-6, 0.0, 1e-15, 1e-12, 1e-9, 0.5e-6, 0.999999e-6, 1.000001e-6,
                             2e-6, 3.999999e-6, 4.000001e-6, 4.999999e-6})
      cases.push_back({mode, gap});
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Gaps, StandstillTest, testing::ValuesIn(standstills()));

/// A contact that has begun and then stays just short of its end.
TEST(Standstill, AtTheEdgeOfSeparationDoesNotStopTime) {
  for (const double gap : {3.9e-6, 3.999999999e-6, 4.000000001e-6, 4.9e-6, 4.999999999e-6, 5.0e-6}) {
    Playground p;
    p.add({.radius = 1, .acceleration_limit = 1}, Vec3{});
    const BodyId b = p.add(
        {.radius = 1, .acceleration_limit = 1, .position = {1.9, 0, 0}, .velocity = {0.1, 0, 0}}, Vec3{});
    p.run(0.999);
    p.set_velocity(b, {});
    p.set_position(b, {2.0 + gap, 0, 0});
    p.run(3.0);
    EXPECT_LT(p.world.counters().pair_checks, enough_looks) << gap;
  }
}

TEST(Standstill, OfBouncersDeepInEachOtherDoesNotStopTime) {
  // Without an acceleration to scale the smallest step, and with gaps that rounding blurs more the farther
  // out they are.
  for (const double place : {1.0, 30.0, 1e3, 1e5, 1e6}) {
    for (const double receding : {0.0, 0.5}) {
      Playground p({.contacts = ContactEvents::impacts});
      const Vec3 centre = Vec3{1, 1, 1} * place;
      p.add({.radius = 1, .position = centre});
      p.add({.radius = 1, .position = centre + Vec3{1, 0, 0}, .velocity = {receding, 0, 0}});
      const auto events = p.run(10.0);
      ASSERT_EQ(events.size(), 1u) << place;
      EXPECT_EQ(events[0].kind, EventKind::contact_begin);
      EXPECT_EQ(events[0].time, 0.0);
      EXPECT_LT(p.world.counters().probes, 1000u) << place << " receding at " << receding;
    }
  }
}

}  // namespace
}  // namespace kinesphere::standstill_test
