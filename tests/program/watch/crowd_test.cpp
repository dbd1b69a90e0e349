// Tracks at one spot, ids without end: a watch with more input than its limits allow.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "program/support.hpp"

namespace kinesphere::program::crowd_test {
namespace {

using Json = nlohmann::json;

const std::string at_rest =
    " --separation sphere:30 --acceleration 1 --position-error 1 --velocity-error 1 --only all --look-ahead "
    "0 ";

/// The tracks move, so that they are no group (TrackGroups).
std::string report_line(const std::string& id, double stamp, double x) {
  return fmt::format("{{\"id\": \"{}\", \"stamp\": {}, \"position\": [{}, 0, 0], \"velocity\": [1, 0, 0]}}\n",
                     id, stamp, x);
}

class WatchedCrowd : public ProgramTest {
 protected:
  ProgramRun watch(const std::string& text, const std::string& options) {
    const ProgramRun result = run("watch " + write("crowd.jsonl", text) + at_rest + options + " --summary '" +
                                  path("summary.json") + "'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    summary_ = Json::parse(read_text(path("summary.json")));
    std::filesystem::remove(path("summary.json"));
    return result;
  }
  Json summary_;
};

TEST_F(WatchedCrowd, IdsWithoutEndAreNotTakenBeyondALimit) {
  std::string text;
  for (int k = 0; k < 500; ++k) text += report_line("spoof" + std::to_string(k), 0.01 * k, 1000.0 * k);
  // Tracks that are watched already stay.
  text += report_line("spoof7", 5.5, 7000.0);
  const ProgramRun result = watch(text, "--most-tracks 100");
  EXPECT_EQ(summary_["tracks"], 100);
  EXPECT_EQ(summary_["reports"], 101);
  EXPECT_EQ(summary_["crowded"], 400);
  EXPECT_NE(result.err.find("warning"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("--most-tracks"), std::string::npos) << result.err;
  EXPECT_EQ(watch(text, "--most-tracks 500").err.find("warning"), std::string::npos);
  EXPECT_EQ(summary_["tracks"], 500);
}

/// Ids without end at one place, where they are a group.
TEST_F(WatchedCrowd, AGroupHasNoMoreMembersThanTracksMayBe) {
  std::string text;
  for (int k = 0; k < 500; ++k)
    text += fmt::format(R"({{"id": "spoof{}", "stamp": {}, "position": [1, 1, 1], "velocity": [0, 0, 0]}})"
                        "\n",
                        k, 0.01 * k);
  const ProgramRun result = watch(text, "--most-tracks 100");
  EXPECT_EQ(summary_["groups"], 1);
  // The first nineteen tracks were watched by themselves before.
  EXPECT_LE(summary_["tracks"], 100);
  EXPECT_GT(summary_["grouped"], 50);
  EXPECT_GT(summary_["crowded"], 250);
}

TEST_F(WatchedCrowd, NewTracksAreNotTakenWhileHalfOfTheOpenPairsThatMayBeAre) {
  std::string text;
  for (int k = 0; k < 400; ++k) text += report_line("here" + std::to_string(k), 0.001 * k, 0.01 * k);
  watch(text, "--most-pairs 1000 --quiet");
  // 33 tracks make 528 pairs, 32 make 496.
  EXPECT_EQ(summary_["tracks"], 33);
  EXPECT_EQ(summary_["crowded"], 367);
  EXPECT_EQ(summary_["dropped_in_crowds"], 0);
}

TEST_F(WatchedCrowd, TracksThatGatherAreDroppedAndOthersStay) {
  std::string text;
  // Two tracks far away stay; a hundred others come together.
  for (const char* far : {"far1", "far2"}) text += report_line(far, 0, 1e6);
  for (int k = 0; k < 100; ++k) text += report_line("here" + std::to_string(k), 0.0, 200.0 * k);
  for (int k = 0; k < 100; ++k) text += report_line("here" + std::to_string(k), 1.0, 0.01 * k);
  const ProgramRun result = watch(text, "--most-pairs 500");
  EXPECT_GT(summary_["dropped_in_crowds"], 0);
  EXPECT_EQ(summary_["dropped"], summary_["dropped_in_crowds"]);
  std::set<std::string> dropped;
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) {
    const Json alert = Json::parse(line);
    if (alert["event"] != "dropped") continue;
    EXPECT_EQ(alert["reason"], "crowd");
    dropped.insert(alert["track"].get<std::string>());
  }
  EXPECT_EQ(dropped.size(), summary_["dropped_in_crowds"]);
  EXPECT_EQ(dropped.count("far1") + dropped.count("far2"), 0u);
  EXPECT_NE(result.err.find("--most-pairs"), std::string::npos) << result.err;
}

TEST_F(WatchedCrowd, LimitsAreChecked) {
  const std::string file = write("one.jsonl", report_line("a", 0, 0));
  for (const char* wrong : {"--most-tracks 0", "--most-tracks -1", "--most-pairs 0", "--most-pairs many"})
    expect_wrong_input("watch " + file + at_rest + wrong, {std::string_view(wrong).substr(0, 6)});
}

}  // namespace
}  // namespace kinesphere::program::crowd_test
