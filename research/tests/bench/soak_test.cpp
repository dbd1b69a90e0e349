// Monitors, and `kinesphere watch`, on reports with all usual faults: nothing is missed.
#include <gtest/gtest.h>

#include "program/support.hpp"
#include "research/monitoring/soak.hpp"

namespace kinesphere::program::monitoring_test {
namespace {

TEST(MonitorSoak, MissesNothingWhateverGoesWrong) {
  SoakSettings settings;
  settings.faults.tracks = 2000;
  settings.faults.width = 8000.0;
  settings.reports = 300'000;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    settings.faults.seed = seed;
    const Soak result = soak(settings);
    EXPECT_EQ(result.verdicts.missed, 0u) << "seed " << seed;
    EXPECT_EQ(result.verdicts.wrongly_within, 0u) << "seed " << seed;
    EXPECT_GT(result.verdicts.approaches, 300u);
    EXPECT_GT(result.faults.outliers, 200u);
    EXPECT_GT(result.faults.swapped, 200u);
    EXPECT_GT(result.faults.gaps, 100u);
    EXPECT_GE(result.counters.contradictions, result.faults.outliers + result.faults.swapped);
  }
}

class WatchSoak : public ProgramTest {
 protected:
  /// Runs `kinesphere watch`, fed by the shell text `before`.
  ProgramRun watch(const std::string& arguments, const std::string& before) const {
    return run_shell(before + "'" KINESPHERE_WATCHING_PROGRAM "' watch --format jsonl --quiet " + arguments);
  }
};

TEST_F(WatchSoak, TheProgramMissesNothingEither) {
  const std::string soak = "soak --reports 150000 --tracks 1500 --width 7000 --seed 5";
  const ProgramRun watched = watch(
      "--separation sphere:60 --acceleration 1 --only all --look-ahead 0 > '" + path("alerts.jsonl") + "'",
      "'" KINESPHERE_PROGRAM "' " + soak + " --write 2>'" + path("faults.txt") + "' | ");
  EXPECT_EQ(watched.exit_code, 0) << watched.err;
  EXPECT_NE(read_text(path("faults.txt")).find(" 150 malformed lines"), std::string::npos);
  const ProgramRun compared = run(soak + " --alerts '" + path("alerts.jsonl") + "'");
  EXPECT_EQ(compared.exit_code, 0) << compared.out << compared.err;
  EXPECT_NE(compared.out.find("approaches"), std::string::npos) << compared.out;
}

/// The alerts are as from several watches that share the pairs: in order for each pair, and not among pairs.
TEST_F(WatchSoak, AlertsMayComeInAnyOrderOfPairs) {
  const std::string soak = "soak --reports 20000 --tracks 200 --width 2500 --seed 5";
  const std::string write_to = "'" KINESPHERE_PROGRAM "' " + soak + " --write 2>/dev/null | ";
  const std::string question = "--separation sphere:60 --acceleration 1 --only all --look-ahead 0";
  const std::string one = watch(question, write_to).out;
  const std::string several =
      watch(question + " --share 1/2", write_to).out + watch(question + " --share 2/2", write_to).out;
  ASSERT_NE(one, several);
  const ProgramRun in_order = run(soak + " --alerts '" + write("one", one) + "'");
  EXPECT_EQ(in_order.exit_code, 0) << in_order.out << in_order.err;
  EXPECT_EQ(in_order.out.find("warnings        0"), std::string::npos) << in_order.out;
  EXPECT_EQ(run(soak + " --alerts '" + write("several", several) + "'").out, in_order.out);
  // The comparison does find what is missing.
  const std::string half = watch(question + " --share 1/2", write_to).out;
  EXPECT_EQ(run(soak + " --alerts '" + write("half", half) + "'").exit_code, exit_disagreement);
}

TEST_F(WatchSoak, ALineThatIsNoAlertOfTheSoakIsNamed) {
  const auto alert = [](const char* time, const char* first, const char* verdict) {
    return std::string(R"({"event":"stale","time":1,"track":"5"})") + "\n" + R"({"event":"verdict","time":)" +
           time + R"(,"first":)" + first + R"(,"second":"7","verdict":)" + verdict + R"(,"before":"apart"})" +
           "\n";
  };
  const auto error_of_alerts = [&](const std::string& alerts) {
    const ProgramRun compared =
        run("soak --reports 1000 --tracks 20 --alerts '" + write("alerts", alerts) + "'");
    EXPECT_EQ(compared.exit_code, exit_wrong_input) << compared.err;
    EXPECT_NE(compared.err.find("alerts:2: "), std::string::npos) << compared.err;
    return compared.err;
  };
  EXPECT_NE(error_of_alerts(alert("1e9", R"("5")", R"("within")")).find("expected a time"),
            std::string::npos);
  EXPECT_NE(error_of_alerts(alert("1", R"("20")", R"("within")")).find("expected a track"),
            std::string::npos);
  EXPECT_NE(error_of_alerts(alert("1", R"("5")", R"("near")")).find("expected a verdict"), std::string::npos);
  EXPECT_NE(error_of_alerts(alert("1", R"(5)", R"("within")")).find("expected an alert"), std::string::npos);
}

}  // namespace
}  // namespace kinesphere::program::monitoring_test
