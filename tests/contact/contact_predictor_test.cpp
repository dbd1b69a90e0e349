// Rechecks of a pair with fresh reports.
#include "contact/contact_predictor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/contact_event.hpp"
#include "number/infinity.hpp"
#include "space/space.hpp"

namespace kinesphere::contact_predictor_test {
namespace {

constexpr double tolerance = 1e-3;

/// Two balls that approach each other at this speed.
struct Pair {
  WorldDefinition world;
  Bound first, second;

  Pair(double gap, double speed, double x) {
    world.contact_tolerance = tolerance;
    first = {.position = {x, 0, 0}, .velocity = {speed, 0, 0}, .radius = 1.0, .acceleration_limit = 1.0};
    second = {.position = {x + 2.0 + gap, 0, 0}, .radius = 1.0, .acceleration_limit = 1.0};
  }
  Event now() const {
    const auto sphere = [](std::uint32_t index, const Bound& bound) {
      return Sphere{{index, 0, 0}, bound.radius, {bound.position, bound.velocity}};
    };
    return contact_event(EventKind::zeno_guard, 0.0, sphere(0, first), sphere(1, second), Space(world));
  }
  ContactDecision judge(const ContactRule& rule) const {
    const ContactPredictor<Bound> predictor(rule, {.within = false}, first, second, 0.0,
                                            {infinity, infinity});
    return predictor.decide(now(), {0.0, 2.0});
  }
};

/// The distance is guarded however near to the tolerance it is, down to the resolution of coordinates.
TEST(ContactPredictor, GuardsTheDistanceOfAPairOutsideTheTolerance) {
  for (const double x : {0.0, 0x1p27, 0x1p34}) {
    // Resolution of the coordinates.
    const double step = x > 0.0 ? x * 0x1p-52 : 0x1p-52;
    for (const double steps : {1.0, 2.0, 5.0, 100.0}) {
      const Pair pair(tolerance + steps * step, 2.0, x);
      const Event now = pair.now();
      if (!(now.gap > tolerance)) continue;
      const ContactDecision verdict = pair.judge(ContactRule(pair.world));
      EXPECT_EQ(verdict.change, ContactRule::Change::none);
      EXPECT_LE(verdict.next_check, 1.0001 * now.gap / 2.0) << "at " << x << ", " << steps << " steps out";
    }
  }
}

TEST(ContactPredictor, BeginsWithinTheTolerance) {
  const Pair pair(0.999 * tolerance, 2.0, 0.0);
  EXPECT_EQ(pair.judge(ContactRule(pair.world)).change, ContactRule::Change::begin);
}

/// They hardly approach, but pass each other.
TEST(ContactPredictor, DefersABeginNoLongerThanTheTwoStayTogether) {
  Pair pair(0.0, 0.0, 0.0);
  pair.first.velocity = {1e-9, 1, 0};
  pair.first.acceleration_limit = pair.second.acceleration_limit = 0.0;
  const ContactRule rule(pair.world);
  const ContactPredictor<Bound> predictor(rule, {.within = true}, pair.first, pair.second, 0.0,
                                          {infinity, infinity});
  const double apart = 2.0 + rule.release_gap();
  EXPECT_LE(predictor.defer(pair.now(), {0.0, 0.0}).next_check, std::sqrt(apart * apart - 4.0) + 1e-6);
}

}  // namespace
}  // namespace kinesphere::contact_predictor_test
