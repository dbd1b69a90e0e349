// When a contact begins, ends, and may be rechecked.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact/contact_rule.hpp"

namespace kinesphere::contact_rule_test {
namespace {

using Change = ContactRule::Change;
constexpr double eps = 1e-6;

Threshold apart(ContactEvents wanted) { return {.within = false, .wanted = wanted}; }
Threshold in_touch(ContactEvents wanted, ApproachState approach) {
  return {.within = true, .wanted = wanted, .state = {.approach = approach}};
}
constexpr ContactEvents events[] = {ContactEvents::impacts, ContactEvents::begin_and_end, ContactEvents::all};

TEST(ContactRule, BeginsAndEndsWithHysteresis) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps});
  EXPECT_EQ(rule.separation_distance(), 4 * eps);
  EXPECT_EQ(rule.release_gap(), 5 * eps);
  for (const ContactEvents wanted : {ContactEvents::begin_and_end, ContactEvents::all})
    for (const double approach : {-1.0, 0.0, 1.0}) {
      EXPECT_EQ(rule.decide(apart(wanted), eps, approach), Change::begin);
      EXPECT_EQ(rule.decide(apart(wanted), -100.0, approach), Change::begin);
      EXPECT_EQ(rule.decide(apart(wanted), std::nextafter(eps, 1.0), approach), Change::none);
      for (const ApproachState state :
           {ApproachState::reported, ApproachState::turned, ApproachState::ignored}) {
        EXPECT_EQ(rule.decide(in_touch(wanted, state), std::nextafter(4 * eps, 0.0), approach), Change::none);
        EXPECT_EQ(rule.decide(in_touch(wanted, state), 4 * eps, approach), Change::end);
        EXPECT_EQ(rule.decide(in_touch(wanted, state), -100.0, approach), Change::none);
      }
    }
}

TEST(ContactRule, AnApproachInTouchBeginsWhereItIsWatched) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps});
  for (const ContactEvents wanted : events) {
    const Threshold watched = in_touch(wanted, ApproachState::watched);
    EXPECT_EQ(rule.decide(watched, 0.0, 1e-300), Change::begin);
    EXPECT_EQ(rule.decide(watched, -100.0, 1e-300), Change::begin);
    const Change stays = wanted == ContactEvents::impacts ? Change::release : Change::none;
    EXPECT_EQ(rule.decide(watched, 2 * eps, 1.0), stays) << "not near enough";
    EXPECT_EQ(rule.decide(watched, 0.0, 0.0), stays);
  }
}

TEST(ContactRule, WithoutEndsABeginNeedsAnApproachAndTheEndIsARelease) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps});
  const ContactEvents impacts = ContactEvents::impacts;
  EXPECT_EQ(rule.decide(apart(impacts), 0.0, 1e-300), Change::begin);
  EXPECT_EQ(rule.decide(apart(impacts), 0.0, 0.0), Change::none);
  EXPECT_EQ(rule.decide(apart(impacts), 2 * eps, 1.0), Change::none);
  EXPECT_EQ(rule.decide(in_touch(impacts, ApproachState::reported), 0.0, 0.0), Change::none);
  EXPECT_EQ(rule.decide(in_touch(impacts, ApproachState::reported), 4 * eps, 1.0), Change::release);
  EXPECT_EQ(rule.decide(in_touch(impacts, ApproachState::turned), 0.0, 1.0), Change::none);
  EXPECT_EQ(rule.decide(in_touch(impacts, ApproachState::turned), 0.0, 0.0), Change::release);
  Threshold jammed = in_touch(impacts, ApproachState::watched);
  jammed.state.jams = 1;
  EXPECT_EQ(rule.decide(jammed, 0.0, 0.0), Change::none) << "jams count until the two have separated";
  EXPECT_EQ(rule.decide(jammed, 4 * eps, 0.0), Change::release);
}

TEST(ContactRule, AnApproachThatRoundingMayHaveMadeIsNoneUnlessItIsDeep) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps});
  const Threshold impact = apart(ContactEvents::impacts);
  EXPECT_EQ(rule.decide(impact, 0.0, 1e-15, 2e-15), Change::none);
  EXPECT_EQ(rule.decide(impact, 0.0, 3e-15, 2e-15), Change::begin);
  EXPECT_EQ(rule.decide(impact, -0.87 * eps, 1e-15, 2e-15), Change::none);
  EXPECT_EQ(rule.decide(impact, -0.88 * eps, 1e-15, 2e-15), Change::begin);
  EXPECT_EQ(rule.decide(impact, -0.88 * eps, 0.0, 2e-15), Change::none);
  const Threshold watched = in_touch(ContactEvents::all, ApproachState::watched);
  EXPECT_EQ(rule.decide(watched, 0.0, 1e-15, 2e-15), Change::none);
  EXPECT_EQ(rule.decide(watched, 0.0, 3e-15, 2e-15), Change::begin);
  // The first begin of bodies that ask for ends needs no approach.
  EXPECT_EQ(rule.decide(apart(ContactEvents::all), 0.0, 1e-15, 2e-15), Change::begin);
}

TEST(ContactRule, GivenSeparationDistanceCounts) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps, .separation_distance = 0.5});
  const Threshold touching = in_touch(ContactEvents::all, ApproachState::reported);
  EXPECT_EQ(rule.decide(touching, 0.4999, -1.0), Change::none);
  EXPECT_EQ(rule.decide(touching, 0.5, -1.0), Change::end);
  EXPECT_EQ(rule.release_gap(), 0.5 + eps);
}

TEST(ContactRule, GuardedGapLiesBelowTheGapAndNeverBelowTheToleranceWithoutNeed) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps});
  EXPECT_EQ(rule.guarded_gap(2 * eps), 0.0);
  for (double gap = eps; gap > -0.99 * eps; gap -= 0.01 * eps) {
    EXPECT_LT(rule.guarded_gap(gap), gap);
    EXPECT_GE(rule.guarded_gap(gap), -eps);
  }
}

TEST(ContactRule, LeastStepShrinksTheGapByAnEighthOfTheTolerance) {
  const ContactRule rule(WorldDefinition{.contact_tolerance = eps});
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
