// Plans that exceed the limits of their class allow more until they end, and join as sets of motions do.
#include "monitor/plans_beyond_class.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace kinesphere::plans_beyond_class_test {
namespace {

const TrackClass planes{.acceleration_limit = 1.0, .planned_acceleration = {0, 0, -1}};

TrackReport with_plan(const Vec3& acceleration, double limit, double until) {
  TrackReport report;
  report.plan = TrackReport::Plan{acceleration, limit, until};
  return report;
}

TEST(PlansBeyondClass, AreNoneWithinTheLimits) {
  EXPECT_EQ(PlansBeyondClass::of({}, planes).end, -infinity);
  EXPECT_EQ(PlansBeyondClass::of(with_plan({0, 0, -1}, 1.0, 5.0), planes).end, -infinity)
      << "those of the class";
  EXPECT_EQ(PlansBeyondClass::of(with_plan({0.4, 0, -1}, 0.5, 5.0), planes).end, -infinity);
}

TEST(PlansBeyondClass, AllowWhatTheyMaySumUpToUntilTheyEnd) {
  const PlansBeyondClass plans = PlansBeyondClass::of(with_plan({3, 4, -1}, 0.5, 5.0), planes);
  EXPECT_EQ(plans.end, 5.0);
  EXPECT_NEAR(plans.limit.total(), 5.5, 1e-12);
  EXPECT_GE(plans.limit.total(), 5.5);
  EXPECT_GE(plans.limit.vertical(), 1.0) << "no less than the class";
  EXPECT_EQ(plans.limit_from(4.9, planes), plans.limit);
  EXPECT_EQ(plans.limit_from(5.0, planes), planes.acceleration_limit);
}

TEST(PlansBeyondClass, IncludeWhatTheyAreJoinedFrom) {
  const std::vector<PlansBeyondClass> some = {{},
                                              PlansBeyondClass::of(with_plan({3, 4, -1}, 0.5, 5.0), planes),
                                              PlansBeyondClass::of(with_plan({0, 0, 3}, 0.5, 4.0), planes),
                                              PlansBeyondClass::of(with_plan({9, 0, -1}, 0.5, 2.0), planes)};
  for (const PlansBeyondClass& a : some)
    for (const PlansBeyondClass& b : some) {
      const PlansBeyondClass both = joined(a, b);
      EXPECT_TRUE(both.include(a));
      EXPECT_TRUE(both.include(b));
      EXPECT_EQ(both.end, joined(b, a).end);
      for (const double time : {0.0, 3.0, 4.5, 6.0}) {
        EXPECT_GE(both.limit_from(time, planes).total(), a.limit_from(time, planes).total());
      }
    }
  EXPECT_FALSE(some[1].include(some[3])) << "shorter, but harder";
  EXPECT_TRUE(some[1].include({}));
  const PlansBeyondClass longer = PlansBeyondClass::of(with_plan({3, 4, -1}, 0.5, 6.0), planes);
  EXPECT_FALSE(some[1].include(longer));
  EXPECT_TRUE(longer.include(some[1]));
}

}  // namespace
}  // namespace kinesphere::plans_beyond_class_test
