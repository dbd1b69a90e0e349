// `kinesphere-bench frames` with tiny sizes: its percentiles, and counts that are the same in every run.
#include <algorithm>

#include "program/support.hpp"
#include "research/tests/bench/bench_table.hpp"

namespace kinesphere::program::bench_frames_test {
namespace {

using Table = std::vector<std::vector<std::string>>;

class BenchFramesTest : public ProgramTest {
 protected:
  Table bench(const std::string& options, const std::string& table) const {
    const ProgramRun result = run("frames --quick --output '" + path("out") + "-bench' " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return csv_rows(read_text(path("out-bench/" + table)));
  }
};

/// Returns the numbers of a column, of the rows of this play.
std::vector<double> numbers(const Table& table, const std::string& play, const std::string& column) {
  std::vector<double> values;
  for (std::size_t row = 0; row + 1 < table.size(); ++row)
    if (csv_cell(table, row, "play") == play) values.push_back(std::stod(csv_cell(table, row, column)));
  return values;
}

TEST_F(BenchFramesTest, PercentilesAreThoseOfTheFrames) {
  const Table table = bench("", "frames.csv");
  const Table frames = csv_rows(read_text(path("out-bench/every_frame.csv")));
  // Four games without and with spread starts of windows, each in two units.
  ASSERT_EQ(table.size(), 1u + 2 * 8);
  ASSERT_EQ(frames.size(), 1u + 8 * 120);
  for (std::size_t row = 0; row + 1 < table.size(); ++row) {
    const std::string unit = csv_cell(table, row, "unit");
    std::vector<double> costs = numbers(frames, csv_cell(table, row, "play"), unit);
    const auto number = [&](const char* column) { return std::stod(csv_cell(table, row, column)); };
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

TEST_F(BenchFramesTest, CountsAreTheSameInEveryRun) {
  const Table first = bench("--only eventful", "every_frame.csv");
  const Table second = bench("--only eventful", "every_frame.csv");
  for (const char* count : {"work", "starts", "restarts", "searches", "hot_pairs", "probes"}) {
    EXPECT_EQ(numbers(first, "eventful", count), numbers(second, "eventful", count));
    const std::vector<double> counts = numbers(first, "eventful", count);
    EXPECT_GT(*std::ranges::max_element(counts), 0.0) << count;
  }
}

TEST_F(BenchFramesTest, AnExplosionShowsInItsFrame) {
  const Table frames = bench("--only eventful", "every_frame.csv");
  const std::vector<double> restarts = numbers(frames, "eventful", "restarts");
  // All balls are blown away at once, at the beginning of this frame.
  EXPECT_EQ(std::ranges::max_element(restarts) - restarts.begin(), 60);
  EXPECT_GE(restarts[60], 100.0);
}

TEST_F(BenchFramesTest, NoFrameDoesMoreThanOneStartOfAllBodies) {
  const Table table = bench("--only thin,steady,dense", "frames.csv");
  for (std::size_t row = 1; row + 1 < table.size(); row += 2) {
    ASSERT_EQ(csv_cell(table, row, "unit"), "work");
    const auto number = [&](const char* column) { return std::stod(csv_cell(table, row, column)); };
    const double start_of_all = 3.2 * number("n");
    EXPECT_LE(number("worst"), start_of_all + 2.0 * number("p90")) << csv_cell(table, row, "play");
  }
}

TEST_F(BenchFramesTest, RefusesWrongOptions) {
  expect_wrong_input("frames --only still", {"--only", "thin, steady", "still"});
  expect_wrong_input("frames --quick --full", {"--full", "--quick"});
}

}  // namespace
}  // namespace kinesphere::program::bench_frames_test
