// `kinesphere-bench run`: scenes under other detectors than the world.
#include <cmath>
#include <string>

#include "research/tests/bench/bench_table.hpp"

namespace kinesphere::program::bench_run_test {
namespace {

constexpr std::string_view small_scene = R"({
  "bodies": 40, "radius": [1, 5], "box": [[0, 0, 0], [60, 60, 60]], "seconds": 2, "response": "bounce" })";

class BenchRun : public BenchTest {};

TEST_F(BenchRun, RefusesOptionsThatDoNotFitTheDetector) {
  const std::string scene = write("s.json", small_scene);
  expect_wrong_input("", {"expected a command: paper, speed"});
  expect_wrong_input(
      "run " + scene + " --detector eye",
      {"--detector", "world, paper, ballistic, hubbard, hayward, fixed-step, brute-force, oracle", "eye"});
  expect_wrong_input("run " + scene + " --detector fixed-step", {"--step"});
  expect_wrong_input("run " + scene + " --step 0.1", {"--step", "fixed-step"});
  expect_wrong_input("run " + scene + " --threads 2 --detector paper", {"--threads", "--detector world"});
  expect_wrong_input("run " + scene + " --record " + path("r") + " --detector paper", {"--record", "world"});
  expect_wrong_input("verify " + scene + " --cell-edge 1", {"--cell-edge", "paper"});
}

TEST_F(BenchRun, EngineAndOracleWriteTheSameContacts) {
  const std::string scene =
      "run " + write("s.json", small_scene) + " --response pass_through --quiet --contacts ";
  EXPECT_EQ(run(scene + path("engine.csv")).exit_code, 0);
  EXPECT_EQ(run(scene + path("oracle.csv") + " --detector oracle").exit_code, 0);
  const auto engine = csv_rows(read_text(path("engine.csv")));
  const auto oracle = csv_rows(read_text(path("oracle.csv")));
  ASSERT_GT(engine.size(), 10u);
  ASSERT_EQ(engine.size(), oracle.size());
  for (std::size_t row = 1; row < engine.size(); ++row) {
    EXPECT_NEAR(std::stod(engine[row][0]), std::stod(oracle[row][0]), 1e-4);
    for (std::size_t column = 1; column < 5; ++column) EXPECT_EQ(engine[row][column], oracle[row][column]);
  }
}

TEST_F(BenchRun, VerifySaysWhatFixedStepsOverlook) {
  const ProgramRun result =
      run("verify " + write("s.json", small_scene) + " --detector fixed-step --step 0.5");
  EXPECT_EQ(result.exit_code, exit_disagreement) << result.out << result.err;
  EXPECT_NE(result.out.find("fixed-step, 0.5 s"), std::string::npos) << result.out;
}

TEST_F(BenchRun, NoticesThatStandardOutputCannotBeWritten) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  const ProgramRun result =
      run_shell("'" KINESPHERE_PROGRAM "' gas --quick --output " + path("gas") + " >/dev/full");
  EXPECT_EQ(result.exit_code, exit_wrong_input);
  EXPECT_EQ(result.err, "kinesphere-bench: standard output: cannot write: No space left on device\n");
}

}  // namespace
}  // namespace kinesphere::program::bench_run_test
