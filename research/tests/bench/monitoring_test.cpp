// Monitors on recorded tracks: certain verdicts are compared with the exact truth.
#include <gtest/gtest.h>

#include "program/support.hpp"
#include "research/monitoring/alarms.hpp"
#include "research/monitoring/soak.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::monitoring_test {
namespace {

struct RecordedSet {
  std::string name;
  std::string file;
  std::string format;
  double distance;
  ReportingSettings reporting;

  friend std::ostream& operator<<(std::ostream& out, const RecordedSet& set) { return out << set.name; }
};

/// Returns the sky of a recording; empty if the recording is not installed.
std::vector<RecordedSky> sky_of(const std::string& name, const std::string& format) {
  const std::string file = recorded_file(name);
  if (file.empty()) return {};
  TrackOptions options;
  options.hints.format = format;
  const TrackSet read = read_tracks({file}, options);
  std::vector<Track> tracks;
  for (const RecordedTrack& track : read.tracks) tracks.push_back(track.samples);
  return {RecordedSky::create(tracks, read.is_plane ? 2 : 3).value()};
}

class RecordedSkies : public testing::TestWithParam<RecordedSet> {};

TEST_P(RecordedSkies, NothingThatIsCertainIsWrong) {
  const RecordedSet& set = GetParam();
  const auto skies = sky_of(set.file, set.format);
  if (skies.empty()) GTEST_SKIP() << "no recording " << set.file << " (see KINESPHERE_DATA)";
  const RecordedSky& sky = skies.front();
  constexpr double tolerance = 1e-3;
  const auto clearly = sky.within(set.distance * (1.0 - 1e-9)).value();
  const auto loosely = sky.within((set.distance + tolerance) * (1.0 + 1e-9)).value();
  for (std::uint64_t seed = 11; seed < 13; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ReportingSettings reporting = set.reporting;
    reporting.seed = seed;
    const std::vector<Delivery> deliveries = sky.deliveries(reporting);
    Monitor monitor = Monitor::create({.dimensions = sky.dimensions(),
                                       .start_time = deliveries.front().time,
                                       .classes = {sky.promise()},
                                       .separations = {{0, 0, {Separation::sphere(set.distance)}}},
                                       .tolerance = tolerance})
                          .value();
    const VerdictHistory history = watch(monitor, sky, deliveries);
    const Correctness correctness = correctness_of(history, sky, clearly, loosely);
    EXPECT_EQ(correctness.wrong_time, 0.0);
    EXPECT_GT(correctness.within_time, 10.0);
    EXPECT_LT(correctness.undecided_time, 0.7 * correctness.pair_time);
    const AlarmScore score = score_of(alarms_of(history, sky), clearly, 0.0);
    EXPECT_GT(score.approaches, 400u);
    EXPECT_EQ(score.missed + score.late, 0u);
    EXPECT_EQ(monitor.counters().contradictions, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(
    , RecordedSkies,
    testing::Values(
        RecordedSet{"students",
                    "ucy_students03/ucy_students03_obsmat.txt.gz",
                    "ucy",
                    0.5,
                    {.interval = 0.8, .delay = 0.3, .position_error = 0.1, .velocity_error = 0.2}},
        RecordedSet{"bottleneck",
                    "pedpy_bottleneck/pedpy_bottleneck_040_c_56_h-.txt.gz",
                    "",
                    0.4,
                    {.interval = 0.4, .delay = 0.1, .position_error = 0.05, .velocity_error = 0.2}},
        RecordedSet{"mosquitoes",
                    "mosquito3d/anopheles_swarm_splined.csv.gz",
                    "",
                    0.1,
                    {.interval = 0.1, .delay = 0.04, .position_error = 0.005, .velocity_error = 0.02}}),
    [](const auto& set) { return set.param.name; });

TEST(RecordedPolling, AFifthOfTenHertzKeepsEveryPairDecided) {
  const auto skies = sky_of("ucy_students03/ucy_students03_obsmat.txt.gz", "ucy");
  if (skies.empty()) GTEST_SKIP() << "no recording of students (see KINESPHERE_DATA)";
  const RecordedSky& sky = skies.front();
  const PollingSettings settings{.distance = 1.5, .tolerance = 1.5};
  const Polling needed = poll_when_needed(sky, settings);
  EXPECT_EQ(needed.undecided_time, 0.0);
  EXPECT_LT(static_cast<double>(needed.reports), 0.2 * 10.0 * sky.track_time());
  const std::uint64_t floor = polling_floor(sky, settings, 0.01);
  EXPECT_LT(static_cast<double>(needed.reports), 1.35 * static_cast<double>(floor));
  EXPECT_GT(needed.reports, floor);
}

TEST(MonitorSoak, MissesNothingWhateverGoesWrong) {
  SoakSettings settings;
  settings.faults.tracks = 2000;
  settings.faults.width = 8000.0;
  settings.reports = 300'000;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    settings.faults.seed = seed;
    const Soak result = soak(settings);
    EXPECT_EQ(result.missed, 0u) << "seed " << seed;
    EXPECT_EQ(result.wrongly_within, 0u) << "seed " << seed;
    EXPECT_GT(result.approaches, 300u);
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
