// When a contact begins, ends, and may be rechecked.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact/contact_rule.hpp"

namespace kinesphere::contact_rule_test {
namespace {

using Change = ContactRule::Change;
constexpr double eps = 1e-6;

TEST(ContactRule, BeginsAndEndsWithHysteresis) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps});
  EXPECT_FALSE(rule.impacts_only());
  EXPECT_EQ(rule.separation_distance(), 4 * eps);
  EXPECT_EQ(rule.release_gap(), 5 * eps);
  for (const double approach : {-1.0, 0.0, 1.0}) {
    EXPECT_EQ(rule.decide(false, eps, approach), Change::begin);
    EXPECT_EQ(rule.decide(false, -100.0, approach), Change::begin);
    EXPECT_EQ(rule.decide(false, std::nextafter(eps, 1.0), approach), Change::none);
    EXPECT_EQ(rule.decide(true, std::nextafter(4 * eps, 0.0), approach), Change::none);
    EXPECT_EQ(rule.decide(true, 4 * eps, approach), Change::end);
    EXPECT_EQ(rule.decide(true, -100.0, approach), Change::none);
  }
}

TEST(ContactRule, ImpactsNeedAnApproachAndAreReleasedWithoutAWord) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps, .contacts = ContactMode::impacts});
  EXPECT_TRUE(rule.impacts_only());
  EXPECT_EQ(rule.decide(false, 0.0, 1e-300), Change::begin);
  EXPECT_EQ(rule.decide(false, 0.0, 0.0), Change::none);
  EXPECT_EQ(rule.decide(false, 2 * eps, 1.0), Change::none);
  EXPECT_EQ(rule.decide(true, 0.0, 1.0), Change::none);
  EXPECT_EQ(rule.decide(true, 0.0, 0.0), Change::release);
  EXPECT_EQ(rule.decide(true, 4 * eps, 1.0), Change::release);
}

TEST(ContactRule, AnApproachThatRoundingMayHaveMadeIsNoneUnlessItIsDeep) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps, .contacts = ContactMode::impacts});
  EXPECT_EQ(rule.decide(false, 0.0, 1e-15, 2e-15), Change::none);
  EXPECT_EQ(rule.decide(false, 0.0, 3e-15, 2e-15), Change::begin);
  EXPECT_EQ(rule.decide(true, 0.0, 1e-15, 2e-15), Change::release);
  EXPECT_EQ(rule.decide(true, 0.0, 3e-15, 2e-15), Change::none);
  EXPECT_EQ(rule.decide(false, -0.87 * eps, 1e-15, 2e-15), Change::none);
  EXPECT_EQ(rule.decide(false, -0.88 * eps, 1e-15, 2e-15), Change::begin);
  EXPECT_EQ(rule.decide(false, -0.88 * eps, 0.0, 2e-15), Change::none);
  // In the mode that reports each begin and end, the speed does not matter.
  const ContactRule both(WorldDefinition{.contact_tolerance = eps});
  EXPECT_EQ(both.decide(false, 0.0, 1e-15, 2e-15), Change::begin);
  EXPECT_EQ(both.decide(true, 0.0, 1e-15, 2e-15), Change::none);
}

TEST(ContactRule, GivenSeparationDistanceCounts) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps, .separation_distance = 0.5});
  EXPECT_EQ(rule.decide(true, 0.4999, -1.0), Change::none);
  EXPECT_EQ(rule.decide(true, 0.5, -1.0), Change::end);
  EXPECT_EQ(rule.release_gap(), 0.5 + eps);
}

TEST(ContactRule, GuardedGapLiesBelowTheGapAndNeverBelowTheToleranceWithoutNeed) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps, .contacts = ContactMode::impacts});
  EXPECT_EQ(rule.guarded_gap(2 * eps), 0.0);
  for (double gap = eps; gap > -0.99 * eps; gap -= 0.01 * eps) {
    EXPECT_LT(rule.guarded_gap(gap), gap);
    EXPECT_GE(rule.guarded_gap(gap), -eps);
  }
}

TEST(ContactRule, LeastStepShrinksTheGapByAnEighthOfTheTolerance) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps, .contacts = ContactMode::impacts});
  for (const double speed : {0.0, 1e-6, 0.1, 10.0})
    for (const double acceleration : {0.0, 1e-3, 1.0, 1e4}) {
      const double step = rule.least_step(0.0, speed, acceleration);
      if (speed + acceleration == 0.0) {
        EXPECT_EQ(step, 0.0);
        continue;
      }
      EXPECT_NEAR(speed * step + 0.5 * acceleration * step * step, eps / 8, 1e-12 * eps);
      EXPECT_EQ(rule.least_step(1.5 * eps, speed, acceleration), 0.0) << "outside the tolerance";
    }
}

TEST(ContactRule, HopWithinTheToleranceIsARepeatedContact) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps, .zeno_interval = 1e-7});
  const double acceleration = 10.0;
  // From the tolerance to the guarded gap and back, for all restitutions.
  const double fall = eps - rule.guarded_gap(eps);
  EXPECT_GT(rule.zeno_interval(acceleration), 2.0 * std::sqrt(2.0 * fall / acceleration));
  EXPECT_LT(rule.zeno_interval(acceleration), 1e-2);
  EXPECT_EQ(rule.zeno_interval(0.0), 1e-7);
  EXPECT_EQ(rule.zeno_interval(1e30), 1e-7);
}

}  // namespace
}  // namespace kinesphere::contact_rule_test
