// `kinesphere watch` in use: alerts, their times, refused input, its end, the served state.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <thread>

#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "program/watch/live_watch.hpp"

#ifdef KINESPHERE_WITH_HTTPLIB
#include <httplib.h>

#include "program/serving/raw_connection.hpp"
#endif

namespace kinesphere::program::watch_program_test {
namespace {

using Json = nlohmann::json;

std::vector<Json> json_lines(const std::string& text) {
  std::vector<Json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(Json::parse(line));
  return lines;
}

/// Two tracks that fly towards each other along x, a report each second, and meet at time 10.
std::string head_on(double seconds = 20) {
  std::ostringstream text;
  for (int t = 0; t <= seconds; ++t) {
    text << R"({"id": "west", "stamp": )" << t << R"(, "position": [)" << 10 * (t - 10)
         << R"(, 0, 0], "velocity": [10, 0, 0]})"
         << "\n";
    text << R"({"id": "east", "stamp": )" << t + 0.5 << R"(, "position": [)" << -10 * (t + 0.5 - 10)
         << R"(, 1, 0], "velocity": [-10, 0, 0]})"
         << "\n";
  }
  return text.str();
}

const std::string promises =
    " --acceleration 1 --position-error 0.5 --velocity-error 0.1 --only all --look-ahead 0 ";

class WatchProgram : public ProgramTest {
 protected:
  /// Returns the alerts of a run that must succeed.
  std::vector<Json> alerts(const std::string& arguments) {
    const ProgramRun result = run("watch " + arguments + " --summary '" + path("summary.json") + "'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    err_ = result.err;
    summary_ = Json::parse(read_text(path("summary.json")));
    std::filesystem::remove(path("summary.json"));
    return json_lines(result.out);
  }
  Json summary_;
  std::string err_;
};

TEST_F(WatchProgram, TellsOfAnEncounter) {
  const std::string file = write("s.jsonl", head_on());
  const auto lines = alerts(file + " --separation sphere:30" + promises);
  ASSERT_EQ(lines.size(), 4u) << err_;
  const std::vector<std::string> expected{"undecided", "within", "undecided", "apart"};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(lines[k]["event"], "verdict");
    EXPECT_EQ(lines[k]["verdict"], expected[k]);
    EXPECT_EQ(lines[k]["first"], "east");
    EXPECT_EQ(lines[k]["second"], "west");
    EXPECT_EQ(lines[k]["separation"], "sphere:30");
    EXPECT_EQ(lines[k]["since"], k > 0 ? lines[k - 1]["time"] : Json());
  }
  // The two are 30 m apart from 8.5 to 11.5.
  EXPECT_LT(lines[0]["time"], 8.5);
  EXPECT_GT(lines[1]["time"], 8.5);
  EXPECT_LT(lines[2]["time"], 11.5);
  EXPECT_GT(lines[3]["time"], 11.5);
  EXPECT_LT(lines[0]["distance"][0], 30.0 + 1e-3);
  EXPECT_GT(lines[0]["distance"][1], 30.0);
  EXPECT_NEAR(lines[0]["closest_distance"].get<double>(), 1.0, 0.1);
  EXPECT_NEAR(lines[0]["closest_time"].get<double>(), 10.0, 0.1);
  EXPECT_NEAR(lines[0]["likely_time"].get<double>(), 8.5, 0.1);
  EXPECT_TRUE(lines[0]["ask"] == "east" || lines[0]["ask"] == "west");
  EXPECT_EQ(lines[0]["ask_by"], lines[0]["time"]) << "it is needed now";
  EXPECT_EQ(lines[1]["until"], lines[1]["ask_by"]);
  EXPECT_EQ(lines[0]["rests_on"]["first"],
            "position: 0.5 (--position-error); velocity: 0.1 (--velocity-error)");
  EXPECT_EQ(lines[0]["rests_on"]["both"], "acceleration: 1; speed: any");
  EXPECT_EQ(summary_["reports"], 42);
  EXPECT_EQ(summary_["alerts"], 4);
  EXPECT_EQ(summary_["from"], 0);
  EXPECT_EQ(summary_["to"], 20.5);
  EXPECT_EQ(summary_["separations"][0],
            (Json{{"separation", "sphere:30"}, {"undecided", 2}, {"within", 1}, {"apart", 1}}));
  EXPECT_NE(err_.find("reports  "), std::string::npos) << err_;
}

TEST_F(WatchProgram, TellsOfEachSeparation) {
  const std::string file = write("s.jsonl", head_on());
  const auto lines = alerts(file + " --separation cylinder:60:20 --separation 'sphere 30'" + promises);
  EXPECT_EQ(
      std::count_if(lines.begin(), lines.end(),
                    [](const Json& line) { return line["separation"] == "sphere 30" && line["level"] == 1; }),
      4);
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const Json& line) {
                            return line["separation"] == "cylinder:60:20" && line["level"] == 0;
                          }),
            4);
}

/// Compares with a monitor that gets these reports directly.
TEST_F(WatchProgram, TellsWhatAMonitorTells) {
  std::ostringstream text;
  Random random(7);
  std::vector<std::pair<TrackId, TrackReport>> reports;
  std::vector<State> states;
  for (int k = 0; k < 30; ++k)
    states.push_back({40.0 * random.point_in_ball(), 5.0 * random.point_in_ball()});
  for (int t = 0; t < 20; ++t) {
    for (std::size_t k = 0; k < states.size(); ++k) {
      const double stamp = t + static_cast<double>(k) / 32.0;
      State& state = states[k];
      TrackReport report{.timestamp = stamp,
                         .state = {state.position + state.velocity * stamp, state.velocity}};
      report.position_error = 0.25;
      report.velocity_error = 0.125;
      // Includes late reports and jumps.
      if (k == 3 && t == 9) report.state.position.x += 50.0;
      if (k == 5 && t > 12) continue;
      reports.push_back({k, report});
      text << R"({"id": ")" << k << R"(", "stamp": )" << Json(stamp).dump() << R"(, "position": )"
           << Json({report.state.position.x, report.state.position.y, report.state.position.z}).dump()
           << R"(, "velocity": )" << Json({state.velocity.x, state.velocity.y, state.velocity.z}).dump()
           << "}\n";
    }
  }
  MonitorDefinition definition{.classes = {{.acceleration_limit = 1.0}},
                               .separations = {{0, 0, {Separation::sphere(12.0), Separation::sphere(6.0)}}},
                               .tolerance = 6e-4,
                               .stale_after = 3.0,
                               .drop_after = 5.0};
  Monitor monitor = Monitor::create(definition).value();
  std::vector<std::string> expected;
  const auto go_on = [&](double time) {
    for (const MonitorEvent& event : monitor.events(time)) {
      std::string line =
          std::string(name_of(event.kind)) + " " + Json(std::round(event.time * 1e6) / 1e6).dump() + " ";
      if (event.kind == MonitorEventKind::verdict) {
        std::string a = std::to_string(event.first), b = std::to_string(event.second);
        line += std::min(a, b) + " " + std::max(a, b) + " " + std::to_string(event.level) + " " +
                std::string(name_of(event.verdict)) + " " + std::string(name_of(event.before));
      } else {
        line += std::to_string(event.first);
      }
      expected.push_back(line);
    }
  };
  for (const auto& [id, report] : reports) {
    go_on(std::max(monitor.time(), report.timestamp));
    monitor.report(id, report).value();
    go_on(monitor.time());
  }
  std::vector<std::string> reported;
  for (const Json& line :
       alerts(write("s.jsonl", text.str()) +
              " --separation sphere:12 --separation sphere:6 --acceleration 1 --position-error 0.25 "
              "--velocity-error 0.125 --silence 3 --forget 5 --only all --look-ahead 0")) {
    std::string each = line["event"].get<std::string>() + " " +
                       Json(std::round(line["time"].get<double>() * 1e6) / 1e6).dump() + " ";
    if (line["event"] == "verdict")
      each += line["first"].get<std::string>() + " " + line["second"].get<std::string>() + " " +
              line["level"].dump() + " " + line["verdict"].get<std::string>() + " " +
              line["before"].get<std::string>();
    else
      each += line["track"].get<std::string>();
    reported.push_back(each);
  }
  // Alerts of one instant are in the order of the tracks' numbers, which differ here.
  std::sort(expected.begin(), expected.end());
  std::sort(reported.begin(), reported.end());
  EXPECT_EQ(reported, expected);
  EXPECT_GT(expected.size(), 50u);
  EXPECT_EQ(summary_["tracks"], monitor.size()) << "those that left are forgotten";
  for (const char* kind : {"contradiction", "resolved", "stale", "dropped", "verdict"})
    EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), [&](const std::string& line) {
      return line.starts_with(kind);
    })) << kind;
}

TEST_F(WatchProgram, CountsWhatItDoesNotTake) {
  std::string text = head_on(5);
  text += R"({"id": "west", "stamp": 5, "position": [-50, 0, 0], "velocity": [10, 0, 0]})"
          "\n";  // again
  text += R"({"id": "west", "stamp": 4.5, "position": [-55, 0, 0], "velocity": [10, 0, 0]})"
          "\n";  // late
  text += R"({"id": "west", "stamp": 5000, "position": [0, 0, 0], "velocity": [10, 0, 0]})"
          "\n";  // ahead
  text += R"({"id": "west", "stamp": 6, "position": [-40, 0, 0], "velocity": [10, 0, 0]})"
          "\n";
  text += R"({"id": "west", "stamp": -500, "position": [-40, 0, 0], "velocity": [10, 0, 0]})"
          "\n";  // stale
  text += R"({"id": "west", "stamp": 6})"
          "\n";
  text += "mumble\n";
  const auto lines = alerts(write("s.jsonl", text) + " --separation sphere:3" + promises);
  EXPECT_TRUE(lines.empty());
  EXPECT_EQ(summary_["reports"], 14);
  EXPECT_EQ(summary_["late"], 1);
  EXPECT_EQ(summary_["repeated"], 1);
  EXPECT_EQ(summary_["ahead"], 1);
  EXPECT_EQ(summary_["too_old"], 1);
  EXPECT_EQ(summary_["no_position"], 1);
  EXPECT_EQ(summary_["malformed"], 1);
  EXPECT_EQ(summary_["first_malformed"][0]["line"], 19);
  EXPECT_NE(err_.find("s.jsonl:19: expected a JSON object"), std::string::npos) << err_;
}

TEST_F(WatchProgram, BelievesALeapThatOthersConfirm) {
  std::string text = head_on(5);
  for (const char* id : {"west", "east", "west"})
    text += std::string(R"({"id": ")") + id + R"(", "stamp": 5000, "position": [0, 0, 0]})" + "\n";
  alerts(write("s.jsonl", text) + " --separation sphere:3 --largest-speed 20 --forget 10" + promises);
  EXPECT_EQ(summary_["to"], 5000);
  EXPECT_EQ(summary_["ahead"], 0);
  EXPECT_EQ(summary_["dropped"], 2);
}

TEST_F(WatchProgram, GoesByTimesOfArrival) {
  std::string text;
  const auto report = [&](const char* id, double stamp, double arrival) {
    text += Json{{"id", id}, {"stamp", stamp}, {"arrival", arrival}, {"position", {0, 0, 0}}}.dump() + "\n";
  };
  report("a", 0, 1);
  report("b", 900, 1);  // ahead, and waits with the first
  report("b", 1, 2);
  report("a", 2, 1000);  // this arrival is not confirmed
  report("b", 3, 4);
  report("a", 900, 5);
  report("a", 5, 7);
  text += R"({"id": "a", "stamp": 6, "position": [0, 0, 0]})"
          "\n";
  alerts(write("s.jsonl", text) + " --separation sphere:3 --largest-speed 1 --position-error 1");
  EXPECT_EQ(summary_["reports"], 4);
  EXPECT_EQ(summary_["ahead"], 3);
  EXPECT_EQ(summary_["malformed"], 1);
  EXPECT_EQ(summary_["from"], 1);
  EXPECT_EQ(summary_["to"], 7);
  // With the clock of timestamps the third goes on with the first, so that the second does not count.
  alerts(path("s.jsonl") + " --clock stamps --separation sphere:3 --largest-speed 1 --position-error 1");
  EXPECT_EQ(summary_["reports"], 6);
  EXPECT_EQ(summary_["ahead"], 2);
  EXPECT_EQ(summary_["to"], 6);
}

TEST_F(WatchProgram, StopsAtTooManyMalformedLines) {
  std::string text = head_on(5);
  for (int k = 0; k < 15; ++k) text += "mumble " + std::to_string(k) + "\n";
  const std::string file = write("s.jsonl", text);
  alerts(file + " --separation sphere:3" + promises);
  EXPECT_EQ(summary_["malformed"], 15);
  EXPECT_EQ(summary_["first_malformed"].size(), 10u);
  alerts(file + " --separation sphere:3 --most-malformed 15" + promises);
  const ProgramRun stopped =
      run("watch " + file + " --separation sphere:3 --most-malformed 14 --quiet --summary '" +
          path("sum.json") + "'" + promises);
  EXPECT_EQ(stopped.exit_code, 2);
  EXPECT_NE(stopped.err.find("s.jsonl:27: expected a JSON object"), std::string::npos) << stopped.err;
  EXPECT_NE(stopped.err.find("--most-malformed allows 14"), std::string::npos) << stopped.err;
  EXPECT_EQ(Json::parse(read_text(path("sum.json")))["reports"], 12);
  expect_wrong_input("watch " + write("bad.txt", "mumble\nmumble\n") +
                         " --format jsonl --quiet --separation sphere:3" + promises,
                     {"bad.txt", "expected reports of format jsonl", "2 malformed"});
}

TEST_F(WatchProgram, TakesItsFileBehindAnyOption) {
  const std::string file = write("s.jsonl", head_on(2));
  const ProgramRun first = run("watch " + file + " --separation sphere:3 --only within" + promises);
  EXPECT_EQ(first.exit_code, 0) << first.err;
  for (const std::string options :
       {" --only within --separation sphere:3 ", " --separation sphere:3 --only within "})
    EXPECT_EQ(run("watch" + promises + options + file).out, first.out) << options;
  EXPECT_EQ(run("watch" + promises + " --separation sphere:3 --area 0,0,1000 " + file).exit_code, 0);
  EXPECT_EQ(run("watch" + promises + " --separation sphere:3 --class '1,9=id = a' " + file).exit_code, 0);
}

TEST_F(WatchProgram, RefusesWrongOptions) {
  const std::string file = write("s.jsonl", head_on(2));
  expect_wrong_input("watch " + file, {"--separation"});
  expect_wrong_input("watch " + file + " --separation cube:3" + promises, {"--separation", "cube:3"});
  expect_wrong_input("watch " + file + " --separation sphere:3 --position-error 1",
                     {"--acceleration, --largest-speed", "jsonl"});
  expect_wrong_input("watch " + file + " --separation sphere:3 --acceleration 1",
                     {"--position-error", "s.jsonl"});
  expect_wrong_input("watch " + file + " --separation sphere:3 --acceleration 1 --position-error 1",
                     {"--velocity-error"});
  expect_wrong_input("watch " + file + " --separation sphere:3 --acceleration 1kt",
                     {"--acceleration", "1kt", "m/s2"});
  expect_wrong_input("watch " + file + " --separation sphere:3 --format xml" + promises,
                     {"--format", "table|readsb|sbs|nmea|csv|jsonl", "xml"});
  expect_wrong_input("watch " + file + " --separation sphere:3 --clock mine" + promises, {"--clock", "mine"});
  expect_wrong_input("watch " + file + " --separation sphere:3 --silence 0" + promises, {"--silence", "0"});
  expect_wrong_input("watch " + file + " --separation sphere:3 --origin north" + promises,
                     {"--origin", "north"});
  expect_wrong_input("watch " + file + " --separation sphere:3 --radius 7000km" + promises,
                     {"--radius", "7000km"});
  expect_wrong_input("watch " + file + " --separation sphere:3 --containment 0.5" + promises,
                     {"--containment"});
  expect_wrong_input("watch " + file + " --separation sphere:3 --summary " + file + promises,
                     {"--summary", "s.jsonl"});
  expect_wrong_input("watch " + path("none") + " --separation sphere:3" + promises, {"none", "cannot read"});
  expect_wrong_input("watch " + path(".") + " --separation sphere:3" + promises, {"it is a folder"});
  expect_wrong_input("watch " + write("empty", "") + " --separation sphere:3" + promises,
                     {"empty", "it is empty"});
  expect_wrong_input("watch " + write("odd", "1,2,3,4\n") + " --separation sphere:3" + promises,
                     {"odd", "--format"});
  const std::string earth =
      write("e.jsonl", R"({"id": "a", "stamp": 1, "lat": 50, "lon": 8, "velocity": [0, 0]})"
                       "\n");
  expect_wrong_input("watch " + earth + " --separation sphere:3" + promises, {"--largest-speed, --forget"});
  expect_wrong_input(
      "watch " + earth + " --separation sphere:3 --largest-speed 400 --radius 4990km --forget 60" + promises,
      {"--radius", "24 km"});
}

TEST_F(WatchProgram, ReadsGzippedAndStandardInput) {
  const std::string file = write("s.jsonl", head_on());
  const std::string options = " --separation sphere:30 --quiet" + promises;
  const std::string plain = run("watch " + file + options).out;
  EXPECT_EQ(run("watch" + options, "cat '" + file + "' | ").out, plain);
  ASSERT_EQ(run_shell("gzip -k '" + file + "'").exit_code, 0);
  EXPECT_EQ(run("watch " + file + ".gz" + options).out, plain);
  EXPECT_EQ(run("watch - " + options, "gzip -c '" + file + "' | ").out, plain);
  const std::string packed = read_text(file + ".gz");
  const ProgramRun damaged = run("watch " + write("cut.gz", packed.substr(0, packed.size() / 2)) + options);
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_NE(damaged.err.find("cut.gz: cannot read: damaged gzip data"), std::string::npos) << damaged.err;
}

constexpr std::string_view two_aircraft = R"({ "now" : 1700000000.1, "aircraft" : [
{"hex":"4ca1fa","alt_baro":35000,"gs":450,"track":90,"baro_rate":0,"lat":51.5,"lon":-0.1,"seen_pos":0.2,"rc":75,"nac_v":2},
{"hex":"400a01","flight":"BAW\u003c7 ","alt_baro":35000,"gs":450,"track":270,"baro_rate":0,"lat":51.5,"lon":0.1,"seen_pos":0.5,"nac_p":10,"nac_v":2},
{"hex":"400a02","alt_baro":35000,"gs":450,"track":270,"baro_rate":0,"lat":51.5,"lon":20,"seen_pos":0.5,"nac_p":10}]}
{"now": 1700000001.1, "aircraft": [
{"hex":"4ca1fa","alt_baro":35000,"gs":450,"track":90,"baro_rate":0,"lat":51.5,"lon":-0.1,"seen_pos":1.2,"rc":75,"nac_v":2}]}
)";

TEST_F(WatchProgram, WatchesAircraft) {
  const auto lines = alerts(write("aircraft.json", two_aircraft) +
                            " --separation cylinder:10NM:1000ft --separation cylinder:5NM:1000ft");
  ASSERT_GE(lines.size(), 1u);
  EXPECT_EQ(lines[0]["verdict"], "within");
  EXPECT_EQ(lines[0]["first"], "400a01");
  EXPECT_EQ(lines[0]["first_name"], "BAW<7");
  EXPECT_FALSE(lines[0].contains("second_name")) << "no name has been told";
  EXPECT_EQ(lines[0]["time"], 1700000000.1);
  EXPECT_EQ(lines[0]["rests_on"]["first"],
            "position: 2.5 times the 95 % of nac_p; height: 78.81 (default of readsb); velocity: 2.5 times "
            "the 95 % of nac_v; "
            "climb: 2.5 times the 95 % of nac_v");
  EXPECT_EQ(lines[0]["rests_on"]["second"].get<std::string>().substr(0, 13), "position: rc;");
  // 0.2 degrees at 51.5 north are 13.89 km, and the two have come nearer since.
  EXPECT_LT(lines[0]["distance"][0], 13890.0);
  EXPECT_GT(lines[0]["distance"][1], 13890.0 - 0.7 * 2 * 232);
  EXPECT_EQ(summary_["outside"], 1);
  EXPECT_EQ(summary_["repeated"], 1);
  EXPECT_EQ(summary_["format"], "readsb");
}

TEST_F(WatchProgram, DrawsAMapAndWhenPairsHadAlerts) {
  const std::string file = write("aircraft.json", two_aircraft),
                    options = file + " --separation cylinder:10NM:1000ft";
  const std::string alerts = run("watch " + options).out;
  const ProgramRun drawn = run("watch " + options + " --plot " + path("w.svg"));
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_EQ(drawn.out, alerts);
  const std::string svg = read_text(path("w.svg"));
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
  for (const char* text :
       {"2 tracks, 1 pair with alerts", "longitude (degrees)", "time from 2023-11-14 on (UTC)", ">22:13:21<",
        "BAW&lt;7 and 4ca1fa<", "height=\"14.0\""})
    EXPECT_NE(svg.find(text), std::string::npos) << text << "\n" << svg;
  EXPECT_EQ(svg.find("nan"), std::string::npos);

  // The two are within from 8.5 to 11.5 s, about: that is drawn although its end is not told.
  ASSERT_EQ(run("watch " + write("s.jsonl", head_on()) + " --separation sphere:30 --plot " + path("h.svg") +
                " --acceleration 1 --position-error 0.5 --velocity-error 0.1")
                .exit_code,
            0);
  const std::string of_pair = read_text(path("h.svg"));
  const std::size_t bar = of_pair.find("height=\"14.0\"");
  ASSERT_NE(bar, std::string::npos);
  const std::size_t width = of_pair.rfind("width=\"", bar) + 7;
  EXPECT_NEAR(std::stod(of_pair.substr(width)), 370.0 * 3.0 / 20.5, 30.0);
  EXPECT_NE(of_pair.find("time (s)"), std::string::npos);
  expect_wrong_input("watch " + options + " --plot " + path("w.png"), {"w.png", ".svg"});
}

TEST_F(WatchProgram, WatchesVesselsWithDates) {
  std::string text = "MMSI,BaseDateTime,LAT,LON,SOG,COG,Heading\n";
  for (int t = 10; t < 60; t += 10) {
    text += "367000001,2023-01-01T00:00:" + std::to_string(t) + ",29.9,-90.0100,0.0,0.0,511\n";
    text += "367000002,2023-01-01T00:00:" + std::to_string(t) + ",29.9,-90.0105,0.0,0.0,511\n";
  }
  const auto lines = alerts(write("ais.csv", text) + " --separation sphere:500m");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0]["time"], "2023-01-01T00:00:10");
  EXPECT_EQ(lines[0]["first"], "367000001");
  EXPECT_EQ(lines[0]["verdict"], "within");
  EXPECT_EQ(summary_["to"], "2023-01-01T00:00:50");
}

TEST_F(WatchProgram, TellsAtOnceAndEndsWhenAskedTo) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    LiveWatch live("--separation sphere:30 --summary '" + path("sum.json") + "'" + promises, path("err"));
    const std::string text = head_on();
    live.write(text);
    for (const char* verdict : {"undecided", "within", "undecided", "apart"})
      EXPECT_EQ(Json::parse(live.line())["verdict"], verdict) << "though the stream goes on";
    live.signal(signal);
    EXPECT_EQ(live.wait(), 0);
    const Json summary = Json::parse(read_text(path("sum.json")));
    EXPECT_EQ(summary["reports"], 42);
    EXPECT_EQ(summary["alerts"], 4);
    EXPECT_NE(live.err().find("42"), std::string::npos) << live.err();
  }
}

TEST_F(WatchProgram, KeepsItsStateWhenItsTerminalCloses) {
  LiveWatch live("--separation sphere:30 --snapshot '" + path("state") + "'" + promises, path("err"));
  live.write(head_on());
  EXPECT_EQ(Json::parse(live.line())["verdict"], "undecided");
  // The shell sends one, and the system another.
  live.signal(SIGHUP);
  live.signal(SIGHUP);
  EXPECT_EQ(live.wait(), 0);
  EXPECT_TRUE(std::filesystem::exists(path("state")));
}

TEST_F(WatchProgram, GoesOnUnderNohup) {
  const auto before = std::signal(SIGHUP, SIG_IGN);
  LiveWatch live("--separation sphere:30" + promises, path("err"));
  std::signal(SIGHUP, before);
  const std::string text = head_on();
  live.write(text.substr(0, text.size() / 2));
  EXPECT_EQ(Json::parse(live.line())["verdict"], "undecided");
  live.signal(SIGHUP);
  live.write(text.substr(text.size() / 2));
  live.end_input();
  EXPECT_EQ(live.wait(), 0);
  EXPECT_NE(live.err().find("42"), std::string::npos) << live.err();
}

TEST_F(WatchProgram, WaitsForNothingThatIsNotNeeded) {
  LiveWatch live("--separation sphere:30" + promises, path("err"));
  // Times that confirm each other, and then two tracks that meet.
  for (const char* id : {"far", "away", "here"})
    live.write(std::string(R"({"id": ")") + id + R"(", "stamp": 1, "position": [)" +
               (*id == 'h'   ? "0"
                : *id == 'f' ? "1e5"
                             : "-1e5") +
               R"(, 0, 0], "velocity": [0, 0, 0]})" + "\n");
  live.write(R"({"id": "there", "stamp": 2, "position": [5, 0, 0], "velocity": [0, 0, 0]})"
             "\n");
  const Json alert = Json::parse(live.line());
  EXPECT_EQ(alert["verdict"], "within");
  EXPECT_EQ(alert["time"], 2);
  live.end_input();
  EXPECT_EQ(live.wait(), 0);
}

TEST_F(WatchProgram, LetsTimePassByTheClockOfTheMachine) {
  using namespace std::chrono;
  LiveWatch live("--separation sphere:30 --clock arrival --silence 200ms --forget 400ms" + promises,
                 path("err"));
  const double now = duration<double>(system_clock::now().time_since_epoch()).count();
  live.write(R"({"id": "only", "stamp": )" + Json(now).dump() +
             R"(, "position": [0, 0, 0], "velocity": [0, 0, 0]})" + "\n");
  const Json stale = Json::parse(live.line());
  EXPECT_EQ(stale["event"], "stale");
  EXPECT_EQ(stale["track"], "only");
  EXPECT_NEAR(stale["time"].get<double>(), now + 0.2, 1e-3);
  EXPECT_EQ(Json::parse(live.line())["event"], "dropped");
  live.write(R"({"id": "only", "stamp": )" + Json(now + 1e4).dump() +
             R"(, "position": [0, 0, 0], "velocity": [0, 0, 0]})" + "\n");
  live.end_input();
  EXPECT_EQ(live.wait(), 0);
  EXPECT_NE(live.err().find("stamped ahead"), std::string::npos) << live.err();
}

#ifdef KINESPHERE_WITH_HTTPLIB

TEST_F(WatchProgram, ServesItsState) {
  LiveWatch live("--separation sphere:30 --serve 0" + promises, path("err"));
  live.write(head_on(9));
  EXPECT_EQ(Json::parse(live.line())["verdict"], "undecided");
  EXPECT_EQ(Json::parse(live.line())["verdict"], "within");
  const int port = live.port();
  httplib::Client client("127.0.0.1", port);
  Json state;
  // The last report may not have been processed yet.
  for (int k = 0; k < 100 && (state.is_null() || state["time"] != 9.5); ++k) {
    const auto answer = client.Get("/state.json");
    ASSERT_TRUE(answer);
    ASSERT_EQ(answer->status, 200);
    EXPECT_EQ(answer->get_header_value("Content-Type"), "application/json");
    state = Json::parse(answer->body);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(state["time"], 9.5);
  EXPECT_EQ(state["stream"], "standard input");
  EXPECT_EQ(state["geographic"], false);
  EXPECT_EQ(state["dimensions"], 3);
  EXPECT_TRUE(state["origin"].is_null());
  EXPECT_EQ(
      state["separations"],
      Json::parse(R"([{"name": "sphere:30", "shape": "ellipsoid", "horizontal": 30, "vertical": 30}])"));
  EXPECT_EQ(state["counts"]["reports"], 20);
  EXPECT_EQ(state["counts"]["alerts"], 2);
  ASSERT_EQ(state["tracks"].size(), 2u);
  for (const Json& track : state["tracks"])
    EXPECT_NEAR(track["places"][0]["x"].get<double>(), track["id"] == "west" ? -5.0 : 5.0, 0.1);
  EXPECT_EQ(state["tracks"][0]["places"].size(), 1u);
  EXPECT_GE(state["tracks"][0]["places"][0]["radius"][0], 0.5);
  ASSERT_EQ(state["pairs"].size(), 1u);
  EXPECT_EQ(state["pairs"][0]["verdict"], "within");
  EXPECT_EQ(state["pairs"][0]["first"].get<std::string>() < state["pairs"][0]["second"].get<std::string>(),
            true);
  const auto metrics = client.Get("/metrics");
  ASSERT_TRUE(metrics);
  EXPECT_TRUE(metrics->get_header_value("Content-Type").starts_with("text/plain"));
  for (const char* line :
       {"\n# TYPE kinesphere_watch_reports_total counter\nkinesphere_watch_reports_total 20\n",
        "\nkinesphere_watch_tracks 2\n", "\nkinesphere_watch_pairs_within 1\n",
        "\nkinesphere_watch_alerts_total 2\n"})
    EXPECT_NE(metrics->body.find(line), std::string::npos) << line << metrics->body;
  EXPECT_EQ(client.Get("/", {{"Host", "example.org"}})->status, 403);
  EXPECT_EQ(client.Get("/nothing")->status, 404);
  expect_wrong_input("watch --separation sphere:30 --serve " + std::to_string(port) + promises,
                     {"--serve", std::to_string(port)}, "echo '{\"id\": 1, \"stamp\": 1}' | ");
  live.signal(SIGTERM);
  EXPECT_EQ(live.wait(), 0);
}

/// Hostile clients see no memory of the watch, and delay neither other clients nor its end.
TEST_F(WatchProgram, ServesHostileClientsNothingElse) {
  LiveWatch live("--format jsonl --separation sphere:30 --serve 0" + promises, path("err"));
  const int port = live.port();
  const std::string host = "Host: 127.0.0.1:" + std::to_string(port) + "\r\n";
  const auto response = [&](const std::string& head) {
    const RawConnection connection(port, 5);
    connection.send(head);
    return connection.response();
  };
  const std::string metrics = body_of(response("GET /metrics HTTP/1.1\r\n" + host + "\r\n"));
  EXPECT_TRUE(metrics.starts_with("# "));
  for (const char* const range : {"60000-120000", "-99999", "0-0,5-99999", "99999-"})
    EXPECT_EQ(body_of(response("GET /metrics HTTP/1.1\r\n" + host + "Range: bytes=" + range + "\r\n\r\n")),
              metrics);
  EXPECT_EQ(
      status_of(response("POST /state.json HTTP/1.1\r\n" + host + "Content-Length: 3000000000\r\n\r\n")),
      405);
  std::vector<std::unique_ptr<RawConnection>> slow;
  for (int k = 0; k < 80; ++k) {
    slow.push_back(std::make_unique<RawConnection>(port, 1));
    slow.back()->send("GET /sta");
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(body_of(response("GET /metrics HTTP/1.1\r\n" + host + "\r\n")), metrics);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
  const auto asked = std::chrono::steady_clock::now();
  live.signal(SIGTERM);
  live.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(2));
}

/// Clients that send requests without a pause do not delay the stream.
TEST_F(WatchProgram, GoesOnWhileManyAsk) {
  LiveWatch live("--format jsonl --separation sphere:30 --serve 0" + promises, path("err"));
  const int port = live.port();
  const std::string head = "GET /state.json HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n";
  std::atomic<bool> is_over = false;
  std::vector<std::thread> clients;
  for (int k = 0; k < 4; ++k)
    clients.emplace_back([&] {
      while (!is_over) {
        const RawConnection connection(port, 5);
        connection.send(head);
        connection.response();
      }
    });
  live.write(head_on(9));
  EXPECT_EQ(Json::parse(live.line())["verdict"], "undecided");
  EXPECT_EQ(Json::parse(live.line())["verdict"], "within");
  is_over = true;
  for (std::thread& client : clients) client.join();
  live.end_input();
  EXPECT_EQ(live.wait(), 0);
}

TEST_F(WatchProgram, ServesAStateBeforeTheFirstReport) {
  LiveWatch live("--format jsonl --separation cylinder:30:10 --serve 0" + promises, path("err"));
  httplib::Client client("127.0.0.1", live.port());
  const auto answer = client.Get("/state.json");
  ASSERT_TRUE(answer);
  const Json state = Json::parse(answer->body);
  for (const char* unknown : {"time", "geographic", "dimensions", "origin"})
    EXPECT_TRUE(state.at(unknown).is_null()) << unknown;
  for (const char* empty : {"tracks", "pairs", "needed"}) EXPECT_EQ(state.at(empty), Json::array()) << empty;
  EXPECT_EQ(state["separations"][0]["shape"], "cylinder");
  EXPECT_EQ(state["separations"][0]["vertical"], 10);
  EXPECT_EQ(state["counts"]["reports"], 0);
  live.end_input();
  live.wait();
}

#ifdef KINESPHERE_WITH_GEOGRAPHICLIB

TEST_F(WatchProgram, ServesPlacesOnTheEarthAndOnItsMap) {
  LiveWatch live(
      "--separation sphere:5km --largest-speed 300 --origin 50,8 --radius 100km --serve 0" + promises,
      path("err"));
  // The radius of curvature of the parallel at 50 degrees north is 4108 km: 0.1 degrees are 7170 m.
  for (const char* id : {"a", "b", "c"})
    live.write(std::string(R"({"id": ")") + id + R"(", "stamp": 1, "lat": 50, "lon": 8.1, "alt": 500})" +
               "\n");
  httplib::Client client("127.0.0.1", live.port());
  Json state;
  for (int k = 0; k < 100 && (state.is_null() || state["tracks"].size() < 3); ++k) {
    const auto answer = client.Get("/state.json");
    ASSERT_TRUE(answer);
    state = Json::parse(answer->body);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(state["geographic"], true);
  EXPECT_EQ(state["origin"], Json::parse(R"({"lon": 8, "lat": 50, "radius": 100000})"));
  ASSERT_EQ(state["tracks"].size(), 3u);
  const Json& place = state["tracks"][0]["places"][0];
  EXPECT_NEAR(place["x"].get<double>(), 7170, 10);
  EXPECT_NEAR(place["y"].get<double>(), 5, 2);
  EXPECT_NEAR(place["z"].get<double>(), 500, 1e-9);
  EXPECT_NEAR(place["lon"].get<double>(), 8.1, 1e-9);
  EXPECT_NEAR(place["lat"].get<double>(), 50, 1e-9);
  live.end_input();
  live.wait();
}

#endif

/// Sets an environment variable until destruction.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* const before = std::getenv(name)) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~Environment() {
    if (before_)
      ::setenv(name_, before_->c_str(), 1);
    else
      ::unsetenv(name_);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST_F(WatchProgram, SaysHowItsMapIsBuilt) {
  const Environment nowhere("KINESPHERE_VIEWER", path("nowhere"));
  LiveWatch live("--format jsonl --separation sphere:30 --serve 0" + promises, path("err"));
  const auto answer = httplib::Client("127.0.0.1", live.port()).Get("/");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_TRUE(answer->get_header_value("Content-Type").starts_with("text/plain"));
  for (const char* part : {"/state.json", "/metrics", "cmake --preset browser"})
    EXPECT_NE(answer->body.find(part), std::string::npos) << part << answer->body;
  live.end_input();
  live.wait();
}

TEST_F(WatchProgram, ServesItsMapAndNothingElseOfTheFolder) {
  std::filesystem::create_directories(path("pages/assets"));
  write("pages/map.html", "<p>the map</p>");
  write("pages/index.html", "<p>the viewer</p>");
  write("pages/assets/map.js", "let there = 'be light';");
  const Environment pages("KINESPHERE_VIEWER", path("pages"));
  LiveWatch live("--format jsonl --separation sphere:30 --serve 0" + promises, path("err"));
  httplib::Client client("127.0.0.1", live.port());
  const auto page = client.Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->body, "<p>the map</p>");
  EXPECT_TRUE(page->get_header_value("Content-Type").starts_with("text/html"));
  EXPECT_EQ(page->get_header_value("X-Content-Type-Options"), "nosniff");
  const std::string policy = page->get_header_value("Content-Security-Policy");
  EXPECT_NE(policy.find("default-src 'none'; script-src 'self';"), std::string::npos) << policy;
  EXPECT_EQ(policy.find("unsafe"), std::string::npos) << policy;
  const auto script = client.Get("/assets/map.js", {{"Accept-Encoding", "gzip, br"}});
  EXPECT_EQ(script->body, "let there = 'be light';");
  EXPECT_EQ(script->get_header_value("Content-Type"), "text/javascript");
  EXPECT_EQ(script->get_header_value("Content-Encoding"), "");
  for (const char* other : {"/index.html", "/map.html", "/assets/../index.html", "/assets/none.js"})
    EXPECT_EQ(client.Get(other)->status, 404) << other;
  EXPECT_EQ(client.Get("/", {{"Host", "example.org"}})->status, 403);
  EXPECT_EQ(client.Get("/assets/map.js", {{"Host", "example.org"}})->status, 403);
  live.end_input();
  live.wait();
}

#endif

}  // namespace
}  // namespace kinesphere::program::watch_program_test
