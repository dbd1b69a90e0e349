// Data that TrackEstimate::is_valid() refuses: each would later abort, or be believed.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "monitor/track_estimate.hpp"
#include "number/infinity.hpp"

namespace kinesphere::soundness_test {
namespace {

using Hypotheses = std::vector<Hypothesis>;

constexpr double now = 1.0;

/// Two hypotheses: the second report contradicts the first one.
Hypotheses contradicting() {
  const TrackClass promise{.acceleration_limit = 1.0, .largest_speed = 10.0};
  TrackEstimate estimate;
  for (const double x : {0.0, 500.0}) {
    const TrackReport report{.timestamp = now, .state = {{x, 0, 0}, {1, 0, 0}}, .position_error = 1.0};
    estimate.update(report, promise, now, 1.0);
  }
  return {estimate.hypotheses().begin(), estimate.hypotheses().end()};
}

bool is_valid(const Hypotheses& hypotheses) {
  ByteWriter written;
  written(hypotheses);
  ByteReader reader(written.bytes());
  TrackEstimate estimate;
  reader(estimate);
  return !reader.failed() && estimate.is_valid(now);
}

TEST(Soundness, WhatWasLearnedIsSound) {
  ASSERT_EQ(contradicting().size(), 2u);
  EXPECT_TRUE(is_valid(contradicting()));
}

TEST(Soundness, WhatCannotBeLearnedIsNot) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  struct Damage {
    std::string what;
    std::function<void(Hypotheses&)> done;
  };
  const std::vector<Damage> damages{
      {"no hypothesis", [](Hypotheses& all) { all.clear(); }},
      {"more hypotheses than fit",
       [](Hypotheses& all) {
         all.push_back(all.back());
         all.push_back(all.back());
       }},
      {"a stamp beyond all times", [](Hypotheses& all) { all[0].latest.timestamp = 1e31; }},
      {"a state that is no number", [](Hypotheses& all) { all[0].latest.state.position.x = nan; }},
      {"a state at infinity", [](Hypotheses& all) { all[0].latest.state.velocity.y = infinity; }},
      {"an error that is no number", [](Hypotheses& all) { all[0].latest.velocity_error = nan; }},
      {"plans that end never or always", [](Hypotheses& all) { all[0].plans.end = nan; }},
      {"no claim", [](Hypotheses& all) { (all[0].sets.clear(), all[0].latest_sets = 0); }},
      {"no claim of the latest report", [](Hypotheses& all) { all[0].latest_sets = 0; }},
      {"more claims than there are", [](Hypotheses& all) { ++all[0].latest_sets; }},
      {"no claim that holds now",
       [](Hypotheses& all) {
         for (ReachableSet& set : all[0].sets) set.time = 2.0;
       }},
      {"no claim that holds for ever",
       [](Hypotheses& all) {
         for (ReachableSet& set : all[0].sets) set.end = 3.0;
       }},
      {"a claim from beyond all times", [](Hypotheses& all) { all[0].sets[0].time = -1e31; }},
      {"a position that overflows", [](Hypotheses& all) { all[0].sets[0].position.z = -1e300; }},
      {"a velocity that overflows", [](Hypotheses& all) { all[0].sets[0].velocity.x = 1e300; }},
      {"an acceleration that overflows", [](Hypotheses& all) { all[0].sets[0].acceleration.x = 1e300; }},
      {"a radius below zero", [](Hypotheses& all) { all[0].sets[0].radius = -1.0; }},
      {"a speed without limit", [](Hypotheses& all) { all[0].sets[0].speed = infinity; }},
      {"a growth without limit", [](Hypotheses& all) { all[0].sets[0].growth = infinity; }},
  };
  for (const Damage& damage : damages) {
    Hypotheses all = contradicting();
    damage.done(all);
    EXPECT_FALSE(is_valid(all)) << damage.what;
  }
}

/// Every report within limits is valid, whenever a plan or an acceleration begins or ends.
TEST(Soundness, NothingThatIsReportedOverflows) {
  constexpr double most = 1e100;
  for (const double limit : {0.0, 1e-300, 1e-200, 1.0, most})
    for (const double largest_speed : {1.0, most, infinity})
      for (const double stamp : {-1e30, 0.0, 1e30})
        for (const double valid_until : {-1e30 + 1e15, 1.0, 1e29, 1e31, 1e200, 1e300, infinity}) {
          const TrackClass promise{.acceleration_limit = limit, .largest_speed = largest_speed};
          TrackReport report{.timestamp = stamp, .state = {{1e30, -1e30, 0}, {most, most, -most}}};
          if (valid_until > stamp) report.plan = TrackReport::Plan{{0, most, most}, most, valid_until};
          TrackEstimate estimate;
          estimate.update(report, promise, now, 1.0);
          EXPECT_TRUE(estimate.is_valid(now))
              << limit << ", " << largest_speed << ", " << stamp << ", " << valid_until;
        }
}

}  // namespace
}  // namespace kinesphere::soundness_test
