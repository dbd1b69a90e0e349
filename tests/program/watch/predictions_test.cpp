// `kinesphere watch` with look-ahead times, an own track, and kinds of alerts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "program/support.hpp"

namespace kinesphere::program::watch_predictions_test {
namespace {

using Json = nlohmann::json;

constexpr double start = 1700000000.0, knots = 1852.0 / 3600.0;

/// Ships on the equator, with a report every ten seconds for half an hour: 1 and 2 go towards each other at
/// 15 knots and are closest after 25 minutes; 3 crosses the course of 2, far from 1.
std::string ships() {
  constexpr double degree = 111319.5;  // metres
  std::string text = "id,time,lat,lon,speed_kt,course\n";
  const auto add = [&](int id, double t, double east, double north, double speed, double course) {
    text += fmt::format("{},{:.0f},{:.7f},{:.7f},{},{}\n", id, start + t, north / degree, east / degree,
                        speed, course);
  };
  for (int t = 0; t <= 1800; t += 10) {
    const double way = 15.0 * knots * (t - 1500.0);
    add(1, t, way, 0.0, 15.0, 90.0);
    add(2, t, -way, 100.0, 15.0, 270.0);
    add(3, t, 9000.0, 100.0 + 10.0 * knots * (t - 300.0), 10.0, 0.0);
  }
  return text;
}

const std::string limits =
    " --dimensions 2 --acceleration 0.3 --largest-speed 30 --position-error 25 --velocity-error 1.25 "
    "--silence 210";

class WatchPredictions : public ProgramTest {
 protected:
  std::vector<Json> alerts(const std::string& arguments) {
    const ProgramRun result = run("watch " + write("ships.csv", ships()) + limits + " --summary '" +
                                  path("summary.json") + "' " + arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    err_ = result.err;
    summary_ = Json::parse(read_text(path("summary.json")));
    std::filesystem::remove(path("summary.json"));
    std::vector<Json> lines;
    std::istringstream stream(result.out);
    for (std::string line; std::getline(stream, line);) lines.push_back(Json::parse(line));
    return lines;
  }
  static double seconds(const Json& time) { return time.get<double>() - start; }

  Json summary_;
  std::string err_;
};

TEST_F(WatchPredictions, ComeAheadByTheTimeOfTheSeparation) {
  const auto lines = alerts("--separation sphere:0.25NM:12min --only predicted");
  std::vector<Json> of_the_two;
  for (const Json& line : lines)
    if (line["first"] == "1" && line["second"] == "2") of_the_two.push_back(line);
  ASSERT_EQ(of_the_two.size(), 2u) << Json(lines).dump(1);
  EXPECT_EQ(of_the_two[0]["event"], "predicted");
  EXPECT_NEAR(seconds(of_the_two[0]["time"]), 1500.0 - 720.0, 10.0);
  EXPECT_NEAR(seconds(of_the_two[0]["closest_time"]), 1500.0, 5.0);
  EXPECT_NEAR(of_the_two[0]["closest_distance"].get<double>(), 100.0, 5.0);
  // Within 463 m from 29 s before that on.
  EXPECT_NEAR(seconds(of_the_two[0]["likely_time"]), 1500.0 - 29.3, 5.0);
  EXPECT_EQ(of_the_two[0]["separation"], "sphere:0.25NM:12min");
  EXPECT_EQ(of_the_two[1]["event"], "prediction_ended");
  EXPECT_EQ(of_the_two[1]["since"], of_the_two[0]["time"]);
  EXPECT_EQ(summary_["predicted"], summary_["predictions_ended"]);
  EXPECT_GT(summary_["held_back"], 0);
}

TEST_F(WatchPredictions, AreOfTheOwnTrackAlone) {
  const std::string separation = "--separation sphere:0.25NM:12min --only all ";
  const auto pairs_with = [](const std::vector<Json>& lines, const char* id) {
    return std::count_if(lines.begin(), lines.end(), [&](const Json& line) {
      return line.contains("second") && (line["first"] == id || line["second"] == id);
    });
  };
  const auto all = alerts(separation);
  EXPECT_GT(pairs_with(all, "3"), 0);
  const auto own = alerts(separation + "--own 1");
  EXPECT_EQ(pairs_with(own, "3"), 0);
  EXPECT_EQ(pairs_with(own, "1"), static_cast<std::ptrdiff_t>(own.size()));
  EXPECT_EQ(pairs_with(own, "2"), pairs_with(all, "1"));
  EXPECT_TRUE(alerts(separation + "--own 4").empty());
  EXPECT_NE(err_.find("--own 4"), std::string::npos) << err_;
}

TEST_F(WatchPredictions, AlertsAreOfTheKindsAskedFor) {
  const auto kinds = [this](const std::string& only) {
    std::set<std::string> found;
    for (const Json& line : alerts("--separation sphere:0.25NM:12min --only " + only))
      found.insert(line["event"] == "verdict"
                       ? line["before"].get<std::string>() + ">" + line["verdict"].get<std::string>()
                       : line["event"].get<std::string>());
    return found;
  };
  EXPECT_EQ(kinds("undecided"), (std::set<std::string>{"apart>undecided", "undecided>apart"}));
  EXPECT_EQ(kinds("within,predicted"),
            (std::set<std::string>{"undecided>within", "predicted", "prediction_ended"}));
}

TEST_F(WatchPredictions, RefuseTimesThatAreNone) {
  for (const char* separation : {"sphere:5:-1min", "sphere:5:10km", "cylinder:5:10:1min:2"})
    expect_wrong_input(
        fmt::format("watch {} {} --separation {}", write("ships.csv", ships()), limits, separation),
        {"--separation"});
  expect_wrong_input("watch " + path("ships.csv") + " --separation sphere:5 --only likely",
                     {"--only", "likely"});
  expect_wrong_input("watch " + path("ships.csv") + limits + " --separation sphere:5 --hold -3", {"--hold"});
}

}  // namespace
}  // namespace kinesphere::program::watch_predictions_test
