// Alerts of `kinesphere watch --text` as people read them: distances now, times, columns.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "program/support.hpp"

namespace kinesphere::program::alert_text_test {
namespace {

using Json = nlohmann::json;

class AlertText : public ProgramTest {
 protected:
  /// Returns the output of a run that must succeed.
  std::string alerts(const std::string& stream, const std::string& options) {
    const ProgramRun result = run("watch " + write("stream", stream) + " " + options + " --quiet");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  }
};

/// The two ships lie still, the latest report of one is 20 minutes old, and no velocity is known.
TEST_F(AlertText, TellsTheLikelyDistanceAndNotTheMeanOfItsLimits) {
  const std::string stream = "id,time,x,y\na,0,0,0\nb,1200,700,0\n";
  const std::string options =
      "--separation sphere:926 --largest-speed 15 --position-error 50 --silence 7200 --forget 14400 "
      "--leap 3600";
  EXPECT_EQ(alerts(stream, options + " --text"),
            "1200  predicted  a and b: sphere:926, now 700 (0 to 18800)\n");
  const Json alert = Json::parse(alerts(stream, options));
  EXPECT_EQ(alert["likely_distance"], 700);
  EXPECT_EQ(alert["distance"], (Json{0, 18800}));
  EXPECT_EQ(alert["vertical_distance"], Json());
  EXPECT_EQ(alert["likely_vertical"], Json());
}

TEST_F(AlertText, LeavesOutLimitsThatSayLittleMore) {
  const std::string stream = "id,time,x,y,vx,vy\na,0,0,0,0,0\nb,0,100,0,0,0\na,1,0,0,0,0\nb,1,100,0,0,0\n";
  EXPECT_EQ(alerts(stream,
                   "--separation sphere:120 --acceleration 1 --position-error 2 --velocity-error 1 --text "
                   "--only within"),
            "0  within     a and b: sphere:120, now 100\n");
}

TEST_F(AlertText, TellsTheVerticalDistanceOfCylinders) {
  const std::string head = "id,time,x,y,z,vx,vy,vz\n";
  const std::string stream = head + "a,0,0,0,1000,100,0,0\nb,0,9000,0,1250,-100,0,-2\n";
  const std::string options =
      " --unit m --acceleration 5 --position-error 10:20 --velocity-error 1 --look-ahead 60";
  EXPECT_EQ(
      alerts(stream, "--separation cylinder:5NM:1000ft --text" + options),
      "0  within     a and b: cylinder:5NM:1000ft, now 4.86 NM and 820 ft, closest 0.00 NM and 525 ft in "
      "45 s\n");
  const Json alert = Json::parse(alerts(stream, "--separation cylinder:5NM:1000ft" + options));
  EXPECT_EQ(alert["likely_vertical"], 250);
  EXPECT_EQ(alert["vertical_distance"], (Json{210, 290}));
  EXPECT_EQ(alert["likely_distance"], 9000);
  // Without a unit of heights in the option they are numbers of the stream.
  EXPECT_NE(alerts(stream, "--separation cylinder:9260:305 --text" + options).find("now 9000 and 250,"),
            std::string::npos);
  // A sphere and an ellipsoid have one distance; heights of an ellipsoid are stretched to its width.
  EXPECT_NE(alerts(stream, "--separation ellipsoid:12000:1000 --text" + options).find("now 9487,"),
            std::string::npos)
      << alerts(stream, "--separation ellipsoid:12000:1000 --text" + options);
}

TEST_F(AlertText, SaysThatAHeightIsNotKnown) {
  const std::string stream =
      "id,time,x,y,z,vx,vy,vz\na,0,0,0,1000,1,0,0\nb,0,90,0,,0,0,\na,1,1,0,1000,1,0,0\nb,1,90,0,,0,0,\n";
  const std::string text =
      alerts(stream,
             "--separation cylinder:100:50 --acceleration 1 --largest-speed 9 --position-error 1 "
             "--velocity-error 1 --dimensions 3 --only undecided --text");
  EXPECT_NE(text.find("undecided  a and b: cylinder:100:50, now 90 at any height"), std::string::npos)
      << text;
}

TEST_F(AlertText, TellsAsFarAheadAsItLooks) {
  // The closest approach is 59 min 59 s ahead, and 2 h 46 min.
  const std::string stream = R"({"id": "a", "stamp": 0, "position": [0, 0], "velocity": [1, 0]}
{"id": "b", "stamp": 0, "position": [3599, 0], "velocity": [0, 0]}
{"id": "c", "stamp": 0, "position": [0, 10000], "velocity": [1, -1]}
)";
  const std::string promises = " --acceleration 1e-6 --position-error 2 --velocity-error 0.5 --text";
  const std::string far = alerts(stream, "--separation sphere:50:3h" + promises);
  EXPECT_NE(far.find("a and b: sphere:50:3h, now 3599, closest 0 in 59 min 59 s\n"), std::string::npos)
      << far;
  EXPECT_NE(far.find("a and c: sphere:50:3h, now 10000, closest 0 in 2 h 46 min\n"), std::string::npos)
      << far;
  // What comes later than an hour and the look-ahead time says nothing.
  const std::string near = alerts(stream, "--separation sphere:10001:1min" + promises);
  EXPECT_NE(near.find("a and c: sphere:10001:1min, now 10000\n"), std::string::npos) << near;
}

TEST_F(AlertText, KeepsNamesOfAlertsAndTracksApart) {
  const std::string stream = R"({"id": "d", "stamp": 0, "position": [0, 0, 0], "velocity": [0, 0, 0]}
{"id": "e", "stamp": 0, "position": [40, 0, 0], "velocity": [0, 0, 0]}
{"id": "d", "stamp": 1, "position": [500, 0, 0], "velocity": [0, 0, 0]}
{"id": "d", "stamp": 2, "position": [0, 0, 0], "velocity": [0, 0, 0]}
)";
  const std::string promises = " --acceleration 5 --position-error 2 --velocity-error 0.5 --text";
  const std::string text = alerts(stream, "--separation sphere:50 --only within,tracks" + promises);
  EXPECT_EQ(text,
            "0  within         d and e: sphere:50, now 40\n"
            "1  contradiction  d\n"
            "2  resolved       d\n");
}

/// A day has the date of the stream's first day; later ones are said.
TEST_F(AlertText, SaysTheDateOnLaterDays) {
  const auto stream = [](const char* first, const char* second, const char* third) {
    std::string text = "id,time,x,y,vx,vy\n";
    for (const char* time : {first, second, third})
      for (const char* track : {"a", "b"})
        text += fmt::format("{},{},{},0,0,0\n", track, time, *track == 'a' || time == second ? 0 : 90);
    return text;
  };
  const std::string options =
      "--separation sphere:50 --largest-speed 1 --position-error 1 --velocity-error 1 --silence 10000 "
      "--forget 20000 --look-ahead 0 --text";
  const std::string dates =
      alerts(stream("2026-02-28T22:59:00Z", "2026-02-28T23:59:00Z", "2026-03-01T00:59:00Z"), options);
  EXPECT_EQ(dates,
            "23:59:00Z  within     a and b: sphere:50, now 0 (0 to 2)\n"
            "2026-03-01 00:59:00Z  over       a and b: sphere:50, now 90\n");
  EXPECT_EQ(alerts(stream("1772319540", "1772323140", "1772326740"), options), dates);
}

}  // namespace
}  // namespace kinesphere::program::alert_text_test
