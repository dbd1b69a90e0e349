// Verdicts of `kinesphere-bench speed`, on made-up results.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "research/bench/speed/verdicts.hpp"

namespace kinesphere::program::verdicts_test {
namespace {

/// Returns a row that took equally long in each of three turns; the default engine took a millisecond.
SpeedRow row(const std::string& detector, std::optional<double> rate, double detection, double moves,
             std::optional<double> missed = std::nullopt) {
  return {.detector = detector,
          .rate = rate,
          .detection = detection,
          .turns = {3, {detection, 1e-3}},
          .moves = moves,
          .missed = missed};
}

SpeedRow world(double moves) { return row("world", std::nullopt, 1e-3, moves, 0.0); }

TEST(SpeedRow, IsComparedTurnByTurn) {
  SpeedRow rival = row("tuned", 60.0, 2e-3, 60.0);
  rival.turns = {{2e-3, 1e-3}, {30e-3, 10e-3}, {1e-3, 2e-3}};
  EXPECT_DOUBLE_EQ(rival.to_world(world(10.0)), 2.0);
  EXPECT_DOUBLE_EQ(rival.to_world(world(10.0), 1.0), 60.001 / 10.002);
}

TEST(SpeedRow, SlowestSafeStepsMissNothing) {
  const std::vector<SpeedRow> rows{world(1.0),
                                   row("tuned", 240.0, 1.0, 240.0, 0.0),
                                   row("tuned", 60.0, 1.0, 60.0, 0.0),
                                   row("tuned", 30.0, 1.0, 30.0, 0.1),
                                   row("tuned", 10.0, 1.0, 10.0),
                                   row("swept", 10.0, 1.0, 10.0, 0.0)};
  EXPECT_EQ(find_slowest_safe(rows, "tuned"), &rows[2]);
  EXPECT_EQ(find_slowest_safe(rows, "swept"), &rows[5]);
  EXPECT_EQ(find_slowest_safe(rows, "world"), nullptr);
}

TEST(Verdicts, AgainstTheSlowestSweptStepsThatMissNothing) {
  SpeedResults results;
  results["anything"] = {world(1.0), row("swept", 4.0, 0.1e-3, 4.0, 0.5),
                         row("swept", 15.0, 0.4e-3, 15.0, 0.0), row("swept", 60.0, 1e-3, 60.0, 0.0)};
  auto found = verdicts(results);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].against, "swept at 15 Hz");
  EXPECT_DOUBLE_EQ(found[0].measured, 2.5);
  EXPECT_FALSE(found[0].met());
  // At 1 us for a step or probe: 0.4 + 0.015 ms to 1 + 0.001 ms.
  EXPECT_DOUBLE_EQ(found[1].measured, 0.415 / 1.001);
  EXPECT_FALSE(found[1].met());
  // No fixed steps are safe, so there is nothing to compare with.
  for (SpeedRow& one : results["anything"]) one.missed = 0.25;
  EXPECT_TRUE(verdicts(results).empty());
}

}  // namespace
}  // namespace kinesphere::program::verdicts_test
