// What reports say of a track: where it may be, and which of them contradict the others.
#include "monitor/track_estimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinesphere/random.hpp"

namespace kinesphere::track_estimate_test {
namespace {

constexpr std::uint64_t seed = 5221;

/// A track that accelerates evenly.
struct Course {
  State first;
  Vec3 acceleration;

  State at(double time) const {
    return {first.position + (first.velocity + acceleration * (0.5 * time)) * time,
            first.velocity + acceleration * time};
  }
  TrackReport report(double time, Random& random) const {
    const State state = at(time);
    return {.timestamp = time,
            .state = {state.position + 0.1 * random.point_in_ball(),
                      state.velocity + 0.05 * random.point_in_ball()},
            .position_error = 0.1,
            .velocity_error = 0.05};
  }
};

Course any_course(Random& random, double limit) {
  return {{10.0 * random.point_in_ball(), 2.0 * random.point_in_ball()}, limit * random.point_in_ball()};
}

TEST(TrackEstimate, ContainsTheTrackWheneverReportsArrive) {
  SCOPED_TRACE(seed);
  const TrackClass slow{.acceleration_limit = 0.3};
  const TrackClass fast{.acceleration_limit = 0.3, .largest_speed = 8.0};
  for (std::uint64_t k = 0; k < 300; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 0, k);
    const TrackClass& limits = k % 2 == 0 ? slow : fast;
    const Course course = any_course(random, 0.3);
    TrackEstimate estimate;
    double now = 0.0;
    for (int step = 0; step < 8; ++step) {
      now += random.uniform();
      // Some are late, and some come early.
      const double timestamp = std::max(0.0, now + random.uniform(-1.5, 0.3));
      const auto learned = estimate.update(course.report(timestamp, random), limits, now, 1.0);
      EXPECT_EQ(learned.outcome, TrackEstimate::Outcome::agrees);
      EXPECT_FALSE(learned.excess.any());
      ASSERT_EQ(estimate.hypotheses().size(), 1u);
      EXPECT_TRUE(estimate.is_valid(now));
      const Hypothesis& believed = estimate.hypotheses().front();
      for (const double ahead : {0.0, 0.4, 2.0}) {
        const double time = now + ahead;
        const State state = course.at(time);
        for (const ReachableSet& set : believed.sets) {
          if (set.time > time || set.end < time) continue;
          EXPECT_LE(norm(state.position - set.centre_at(time)), set.radius_at(time).total() * (1.0 + 1e-9));
        }
        const Bound bound = TrackEstimate::bound(believed, now, now + 2.0);
        EXPECT_LE(norm(state.position - bound.centre_at(time)), bound.radius_at(time) * (1.0 + 1e-9));
        EXPECT_GE(TrackEstimate::largest_speed(believed, now, now + 2.0),
                  std::hypot(state.velocity.x, state.velocity.y) * (1.0 - 1e-9));
        const ReachableSet& tight = TrackEstimate::tightest(believed, time);
        for (const ReachableSet& set : believed.sets)
          if (set.time <= now && set.end >= time) {
            EXPECT_LE(tight.radius_at(time).total(), set.radius_at(time).total());
          }
      }
    }
  }
}

TEST(TrackEstimate, TakesAWrongReportBack) {
  SCOPED_TRACE(seed);
  const TrackClass limits{.acceleration_limit = 0.3};
  for (std::uint64_t k = 0; k < 100; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 1, k);
    const Course course = any_course(random, 0.3);
    TrackEstimate estimate;
    using Outcome = TrackEstimate::Outcome;
    EXPECT_EQ(estimate.update(course.report(0.0, random), limits, 0.0, 1.0).outcome, Outcome::agrees);
    TrackReport wrong = course.report(1.0, random);
    wrong.state.position += 50.0 * random.unit_vector();
    const auto learned = estimate.update(wrong, limits, 1.0, 1.0);
    EXPECT_EQ(learned.outcome, Outcome::contradicts);
    EXPECT_GT(learned.excess.position, 40.0);
    EXPECT_TRUE(learned.ends_certainty);
    EXPECT_EQ(estimate.hypotheses().size(), 2u) << "either may be wrong";
    EXPECT_EQ(estimate.update(course.report(2.0, random), limits, 2.0, 1.0).outcome, Outcome::resolves);
    ASSERT_EQ(estimate.hypotheses().size(), 1u);
    const ReachableSet& set = TrackEstimate::tightest(estimate.hypotheses().front(), 2.0);
    EXPECT_LE(norm(course.at(2.0).position - set.centre_at(2.0)), set.radius_at(2.0).total());
  }
}

TEST(TrackEstimate, KnowsARepeatedReport) {
  Random random(seed);
  const Course course = any_course(random, 0.3);
  const TrackReport report = course.report(1.0, random);
  TrackEstimate estimate;
  estimate.update(report, {.acceleration_limit = 0.3}, 1.0, 1.0);
  EXPECT_EQ(estimate.update(report, {.acceleration_limit = 0.3}, 1.5, 1.0).outcome,
            TrackEstimate::Outcome::repeated);
  EXPECT_EQ(estimate.timestamp(), 1.0);
}

TEST(TrackEstimate, IsWorthAskingTheLongerItIsUnheard) {
  Random random(seed);
  const Course course = any_course(random, 0.3);
  TrackEstimate estimate;
  estimate.update(course.report(0.0, random), {.acceleration_limit = 0.3}, 0.0, 1.0);
  double last = 0.0;
  for (double time = 0.5; time < 8.0; time += 0.5) {
    EXPECT_GT(estimate.worth_asking(time), last);
    last = estimate.worth_asking(time);
  }
}

}  // namespace
}  // namespace kinesphere::track_estimate_test
