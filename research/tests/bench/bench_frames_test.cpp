// `kinesphere-bench frames` with tiny sizes: its percentiles, and counts that are the same in every run.
#include <algorithm>

#include "research/tests/bench/bench_table.hpp"

namespace kinesphere::program::bench_frames_test {
namespace {

class BenchFrames : public BenchTest {};

/// Returns the numbers of a column, of the rows of this play.
std::vector<double> numbers(const BenchRows& table, const std::string& play, const std::string& column) {
  std::vector<double> values;
  for (std::size_t row = 0; row + 1 < table.size(); ++row)
    if (csv_cell(table, row, "play") == play) values.push_back(csv_number(table, row, column));
  return values;
}

TEST_F(BenchFrames, PercentilesAreThoseOfTheFrames) {
  bench("frames");
  const BenchRows table = BenchTest::table("frames.csv"), frames = BenchTest::table("every_frame.csv");
  // Four games, each in two units.
  ASSERT_EQ(table.size(), 1u + 2 * 4);
  ASSERT_EQ(frames.size(), 1u + 4 * 120);
  for (std::size_t row = 0; row + 1 < table.size(); ++row) {
    const std::string unit = csv_cell(table, row, "unit");
    std::vector<double> costs = numbers(frames, csv_cell(table, row, "play"), unit);
    const auto number = [&](const char* column) { return csv_number(table, row, column); };
    SCOPED_TRACE(csv_cell(table, row, "play") + " " + unit);
    EXPECT_EQ(number("first"), *std::max_element(costs.begin(), costs.begin() + 20));
    std::sort(costs.begin() + 20, costs.end());
    EXPECT_EQ(number("median"), costs[20 + 49]);
    EXPECT_EQ(number("p90"), costs[20 + 89]);
    EXPECT_EQ(number("p99"), costs[20 + 98]);
    EXPECT_EQ(number("p999"), costs.back());
    EXPECT_EQ(number("worst"), costs.back());
    if (number("median") > 0.0) {
      EXPECT_NEAR(number("worst_to_median") * number("median"), number("worst"), 1e-6 * number("worst"));
    } else {
      EXPECT_EQ(csv_cell(table, row, "worst_to_median"), "");
    }
  }
}

TEST_F(BenchFrames, CountsAreTheSameInEveryRunAndShowTheExplosion) {
  bench("frames --only eventful");
  const BenchRows first = table("every_frame.csv");
  bench("frames --only eventful");
  const BenchRows second = table("every_frame.csv");
  for (const char* count : {"work", "starts", "restarts", "searches", "hot_pairs", "probes"})
    EXPECT_EQ(numbers(first, "eventful", count), numbers(second, "eventful", count));
  // All balls are blown away at once, at the beginning of this frame.
  const std::vector<double> restarts = numbers(first, "eventful", "restarts");
  EXPECT_EQ(std::ranges::max_element(restarts) - restarts.begin(), 60);
  EXPECT_GE(restarts[60], 100.0);
}

TEST_F(BenchFrames, NoFrameDoesMoreThanOneStartOfAllBodies) {
  bench("frames --only thin,steady,dense");
  const BenchRows table = BenchTest::table("frames.csv");
  for (std::size_t row = 1; row + 1 < table.size(); row += 2) {
    ASSERT_EQ(csv_cell(table, row, "unit"), "work");
    const auto number = [&](const char* column) { return csv_number(table, row, column); };
    const double start_of_all = 3.2 * number("n");
    EXPECT_LE(number("worst"), start_of_all + 2.0 * number("p90")) << csv_cell(table, row, "play");
  }
}

TEST_F(BenchFrames, ACrowdThatIsSteeredStandsBesideAGrid) {
  bench("frames --only steered");
  const BenchRows table = BenchTest::table("steered.csv");
  ASSERT_EQ(table.size(), 1u + 2);
  for (std::size_t row = 0; row < 2; ++row)
    for (const char* column : {"grid", "velocities", "push", "game", "two_threads"})
      EXPECT_GT(csv_number(table, row, column), 0.0);
}

}  // namespace
}  // namespace kinesphere::program::bench_frames_test
