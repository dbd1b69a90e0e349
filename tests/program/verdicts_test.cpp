// What `kinesphere bench speed` makes of its results, with results made up.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bench/speed/verdicts.hpp"

namespace kinesphere::program {
namespace {

/// Took as long in each of three turns; the default engine took a millisecond.
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

const Verdict* find(const std::vector<Verdict>& verdicts, const std::string& goal,
                    const std::string& against) {
  const auto found = std::find_if(verdicts.begin(), verdicts.end(), [&](const Verdict& one) {
    return one.goal == goal && one.against.starts_with(against);
  });
  return found == verdicts.end() ? nullptr : &*found;
}

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

TEST(Verdicts, NothingWithoutResults) { EXPECT_TRUE(verdicts({}).empty()); }

TEST(Verdicts, DetectionAndTotal) {
  SpeedResults results;
  results["paper1-1000"] = {world(20.0), row("tuned", 60.0, 0.5e-3, 60.0), row("tuned", 240.0, 2e-3, 240.0)};
  const auto found = verdicts(results);
  const Verdict* const at_240 = find(found, "1", "tuned at 240 Hz");
  ASSERT_NE(at_240, nullptr);
  EXPECT_DOUBLE_EQ(at_240->measured, 0.5);
  EXPECT_TRUE(at_240->met());
  const Verdict* const at_60 = find(found, "1 stretch", "tuned at 60 Hz");
  ASSERT_NE(at_60, nullptr);
  EXPECT_DOUBLE_EQ(at_60->measured, 2.0);
  EXPECT_FALSE(at_60->met());
  // At 1 us for a step or probe: 0.5 + 0.06 ms to 1 + 0.02 ms.
  const Verdict* const total = find(found, "2", "tuned at 60 Hz");
  ASSERT_NE(total, nullptr);
  EXPECT_DOUBLE_EQ(total->measured, 0.56 / 1.02);
  EXPECT_FALSE(total->met());
  EXPECT_EQ(find(found, "1", "bullet"), nullptr);
}

TEST(Verdicts, AgainstTheSlowestStepsThatMissNothing) {
  SpeedResults results;
  results["drones"] = {world(1.0), row("tuned", 4.0, 1e-3, 4.0, 0.25), row("tuned", 60.0, 1e-3, 60.0, 0.0),
                       row("swept", 4.0, 1e-3, 4.0, 0.5), row("swept", 60.0, 1e-3, 60.0, 0.125)};
  const auto found = verdicts(results);
  EXPECT_NE(find(found, "3", "tuned at 60 Hz"), nullptr);
  // None is safe: the fastest steps, and what they miss.
  EXPECT_NE(find(found, "3", "swept at 60 Hz missing 12 %"), nullptr);
}

TEST(Verdicts, Growth) {
  SpeedResults results;
  results["dense-1000"] = {world(20.0)};
  results["dense-1000000"] = {row("world", std::nullopt, 4e-3, 20.0)};
  results["dense-1000000"].front().bytes = 500.0;
  results["dense-1000000"].front().building = 1.5;
  const auto found = verdicts(results);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_DOUBLE_EQ(found[0].measured, 4.0);
  EXPECT_FALSE(found[0].met());
  EXPECT_TRUE(found[1].met());
  EXPECT_TRUE(found[2].met());
}

}  // namespace
}  // namespace kinesphere::program
