// `kinesphere watch` on recordings that are read as a whole, and on JSON records as they come.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "program/support.hpp"
#include "program/watch/live_watch.hpp"

namespace kinesphere::program::recordings_watch_test {
namespace {

using Json = nlohmann::json;

const std::string promises = " --largest-speed 30 --acceleration 3 --position-error 5 --velocity-error 1 ";

class RecordingsWatch : public ProgramTest {
 protected:
  /// Returns the events of a run that must succeed.
  std::string events(const std::string& text, const std::string& arguments) {
    const ProgramRun result =
        run("watch " + write("f", text) + promises + arguments + " --summary '" + path("summary.json") + "'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    err_ = result.err;
    summary_ = Json::parse(read_text(path("summary.json")));
    std::filesystem::remove(path("summary.json"));
    std::string told;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) {
      last_ = Json::parse(line);
      told += last_["event"].get<std::string>() + " ";
    }
    return told;
  }
  Json summary_, last_;
  std::string err_;
};

std::string sentence(const std::string& text, const std::string& source) {
  const auto sum = [](const std::string& of) {
    return std::accumulate(of.begin(), of.end(), 0, [](int a, char c) { return a ^ c; });
  };
  const std::string tag = "s:" + source;
  return fmt::format("\\{}*{:02X}\\${}*{:02X}\r\n", tag, sum(tag), text, sum(text));
}

/// Two boats that go towards each other at 10 kt along 54° N, 2 km apart at first. Each step is 10 s.
double east_of(int boat, int step) { return boat == 0 ? step * 51.444 : 2000.0 - step * 51.444; }
constexpr double metres_of_minute = 1855.3 * 0.58779;  // cos 54°

std::string log_of_boats() {
  std::string log;
  for (int step = 0; step < 40; ++step)
    for (const int boat : {0, 1})
      log += sentence(
          fmt::format("GPRMC,12{:02}{:02}.00,A,5400.0000,N,008{:07.4f},E,10.0,{},010324,,,A", step / 6,
                      step % 6 * 10, 1.0 + east_of(boat, step) / metres_of_minute, boat == 0 ? 90 : 270),
          boat == 0 ? "ANNA" : "BERTA");
  return log;
}

TEST_F(RecordingsWatch, LogsOfReceiversWithTheirVelocities) {
  const std::string log = log_of_boats();
  EXPECT_EQ(events(log, "--separation sphere:100m:60s"), "predicted verdict prediction_ended ");
  EXPECT_EQ(summary_["format"], "NMEA 0183");
  EXPECT_EQ(summary_["reports"], 80);
  EXPECT_EQ(last_["first"], "ANNA");
  EXPECT_TRUE(last_["time"].get<std::string>().starts_with("2024-03-01T12:0")) << last_;
  // The prediction comes 60 s before the closest approach, which is 194 s behind the begin.
  EXPECT_NE(run("watch " + path("f") + promises + "--separation sphere:100m:60s --text --quiet")
                .out.find("12:02:15Z  predicted"),
            std::string::npos);
  // Sentences of AIS may follow: the log is then one of AIS.
  expect_wrong_input("watch " + write("ais", log + "!AIVDM,1,1,,A,139>Jh@P1p0TWh0NW>`3Q?v00000,0*67\n") +
                         " --quiet --separation sphere:100m",
                     {"expected a time of receipt, in this line or in others around it"});
  // From a pipe, too.
  const ProgramRun piped =
      run("watch" + promises + "--separation sphere:100m:60s --text", "cat " + path("f") + " | ");
  EXPECT_NE(piped.out.find("predicted"), std::string::npos) << piped.err;
  EXPECT_NE(piped.err.find("standard input is read as a whole: alerts come once it has ended"),
            std::string::npos)
      << piped.err;
}

TEST_F(RecordingsWatch, TracksOneAfterTheOtherAreTakenByTime) {
#ifndef KINESPHERE_WITH_EXPAT
  GTEST_SKIP() << "built without expat";
#endif
  std::string gpx = "<gpx>";
  for (const int boat : {0, 1}) {
    gpx += fmt::format("<trk><name>boat {}</name><trkseg>\n", boat);
    for (int step = 0; step < 60; ++step)
      gpx += fmt::format("<trkpt lat=\"54\" lon=\"{}\"><time>2024-03-01T12:{:02}:{:02}Z</time></trkpt>\n",
                         8.0 + east_of(boat, step) / metres_of_minute / 60.0, step / 6, step % 6 * 10);
    gpx += "</trkseg></trk>";
  }
  EXPECT_EQ(events(gpx + "</gpx>", "--separation sphere:200m --only within"), "verdict verdict ");
  EXPECT_EQ(summary_["format"], "GPX");
  EXPECT_EQ(summary_["reports"], 120);
  EXPECT_EQ(summary_["late"], 0);
  EXPECT_NE(err_.find("reports have no velocities"), std::string::npos) << err_;
  const std::size_t second = gpx.find("<trk>", 10);
  EXPECT_EQ(events(gpx.substr(0, second) + "</gpx>", "--separation sphere:200m"), "");
  EXPECT_NE(err_.find("all reports are of one track, so no pair was watched"), std::string::npos) << err_;
  expect_wrong_input("watch " + write("g", gpx) + promises + " --quiet --separation sphere:100m",
                     {"expected GPX"});
}

TEST_F(RecordingsWatch, ARunThatIsStartedAgainWritesTheSameAlerts) {
  const std::string arguments = "watch " + write("f", log_of_boats()) + promises +
                                "--quiet --separation sphere:100m:60s --alerts '" + path("alerts") +
                                "' --snapshot '" + path("state") + "'";
  EXPECT_EQ(run(arguments).exit_code, 0);
  const std::string first = read_text(path("alerts"));
  EXPECT_EQ(std::ranges::count(first, '\n'), 3);
  EXPECT_EQ(run(arguments).exit_code, 0);
  EXPECT_EQ(read_text(path("alerts")), first);
}

TEST_F(RecordingsWatch, JsonRecordsAsTheyCome) {
  const auto record = [](std::string_view id, int time, double x, std::string_view more = "") {
    return fmt::format("{{\"t\": {}, \"robot_id\": \"{}\", \"pos\": {{\"x\": {}, \"y\": 0}}{}}}\n", time, id,
                       x, more);
  };
  const std::string columns = " --columns id=robot_id,time=t,x=pos.x,y=pos.y ";
  LiveWatch watch("-" + promises + columns + "--separation sphere:20 --only within --text", path("err"));
  for (int time = 0; time < 4; ++time) watch.write(record("a", time, 0) + record("b", time, 1));
  EXPECT_NE(watch.line().find("within"), std::string::npos) << watch.err();
  // A key that comes later is a column from then on; a damaged line ends nothing.
  watch.write(record("a", 4, 0, ", \"note\": [1, 2]") + "{\"t\": 5, \"rob\n" + record("a", 5, 500));
  watch.write(record("b", 5, 1) + record("a", 6, 530) + record("b", 6, 1) + record("a", 90, 900) +
              record("b", 90, 1));
  EXPECT_NE(watch.line().find("over"), std::string::npos) << watch.err();
  watch.end_input();
  EXPECT_EQ(watch.wait(), 0);
  EXPECT_NE(watch.err().find(":10: expected"), std::string::npos) << watch.err();
  // What the columns are is asked. A time of ROS is one column.
  const auto ros = [](std::string_view name, int second) {
    return fmt::format(
        R"({{"msg":{{"header":{{"stamp":{{"secs":{},"nsecs":5000000}}}},"robot":"{}","pose":{{"position":)"
        R"({{"x":0,"y":0}},"orientation":{{"x":0,"y":0,"z":0,"w":1}}}}}}}})"
        "\n",
        second, name);
  };
  const std::string bridge = ros("a", 7) + ros("b", 7) + ros("a", 8) + ros("b", 8);
  expect_wrong_input(
      "watch " + write("f", bridge) + promises + "--quiet --separation sphere:20",
      {"say --columns id=...,time=msg.header.stamp,x=msg.pose.position.x,y=msg.pose.position.y"});
  EXPECT_EQ(events(bridge,
                   "--separation sphere:20 --columns "
                   "id=msg.robot,time=msg.header.stamp,x=msg.pose.position.x,y=msg.pose.position.y"),
            "verdict ");
  EXPECT_EQ(summary_["to"], 8.005);
  // Dates of AIS-catcher have no separators.
  std::string catcher;
  for (int k = 0; k < 8; ++k)
    catcher += fmt::format(R"({{"mmsi":21100000{},"rxtime":"202403011200{:02}","lat":54,"lon":8}})"
                           "\n",
                           k % 2, k / 2);
  EXPECT_EQ(events(catcher, "--separation sphere:200m --columns id=mmsi,time=rxtime,lon=lon,lat=lat"),
            "verdict ");
  EXPECT_EQ(summary_["to"], "2024-03-01T12:00:03");
  // The first records may be of another kind, and a record may be a list of objects.
  EXPECT_EQ(events("{\"op\":\"hello\"}\n[{\"id\":\"a\",\"time\":0,\"x\":0,\"y\":0},{\"id\":\"b\",\"time\":0,"
                   "\"x\":3,\"y\":0}]\n"
                   "[{\"id\":\"a\",\"time\":1,\"x\":0,\"y\":0},{\"id\":\"b\",\"time\":1,\"x\":3,\"y\":0}]\n",
                   "--separation sphere:20"),
            "verdict ");
  // Heights that come later do not count, which is told.
  std::string later;
  for (int k = 0; k < 8; ++k)
    later += fmt::format("{{\"id\":\"{}\",\"time\":{},\"x\":0,\"y\":0{}}}\n", k % 2 == 0 ? "a" : "b", k / 2,
                         k < 4 ? "" : fmt::format(",\"z\":{}", 900 * (k % 2)));
  EXPECT_EQ(events(later, "--separation sphere:20"), "verdict ");
  EXPECT_NE(err_.find("heights do not count, because the first report had none"), std::string::npos) << err_;
  EXPECT_EQ(summary_["format"], "json");
}

TEST_F(RecordingsWatch, TablesBetweenBlanks) {
  EXPECT_EQ(events("id  time x y\na 0 0 0\nb 0 3 0\na 1 0 0\nb 1 3 0\n", "--separation sphere:20"),
            "verdict ");
  expect_wrong_input(
      "watch " + write("f", "1 0 0 0\n2 0 3 0\n") + promises + "--quiet --separation sphere:20",
      {"say --columns id=...,time=...,x=...,y=... with the numbers"});
  // SUMO's table has speeds and angles: the two are predicted ten seconds ahead.
  std::string cars = "timestep_time;vehicle_id;vehicle_x;vehicle_y;vehicle_speed;vehicle_angle\n";
  for (int k = 0; k < 25; ++k)
    cars += fmt::format("{0}.00;v1;{1};0;10;90\n{0}.00;v2;{2};0;10;270\n", k, 10 * k, 600 - 10 * k);
  EXPECT_EQ(events(cars, "--separation sphere:8 --only predicted"), "predicted ");
  EXPECT_EQ(last_["time"], 20);
}

TEST_F(RecordingsWatch, HintsCanBePasted) {
  const std::string table = write(
      "birds.csv", "Bird ring,seen at,x [m],y [m],Bird's age\na,0,0,0,1\nb,0,3,0,1\na,1,0,0,1\nb,1,3,0,1\n");
  const ProgramRun asked = run("tracks " + table + " --distance 5");
  EXPECT_EQ(asked.exit_code, 2);
  const std::size_t begin = asked.err.find("--columns '");
  ASSERT_NE(begin, std::string::npos) << asked.err;
  EXPECT_EQ(asked.err.substr(begin, asked.err.find('\'', begin + 11) + 1 - begin),
            "--columns 'id=...,time=...,x=x [m],y=y [m]'");
}

TEST_F(RecordingsWatch, LimitsThatNobodyMeans) {
  const std::string table = write("t.csv", "id,time,x,y\na,0,0,0\nb,0,3,0\na,1,0,0\nb,1,3,0\n");
  const std::string rest = " --separation sphere:5 --position-error 1 --quiet";
  for (const char* option : {"--largest-speed 1e20", "--acceleration 1e20", "--largest-speed 1e16km/h"})
    expect_wrong_input("watch " + table + rest + " " + option, {"expected at most 1e+15, but got '1e"});
  for (const char* option :
       {"--largest-speed -1", "--largest-speed nan", "--largest-speed 3ft", "--acceleration inf"})
    expect_wrong_input("watch " + table + rest + " " + option, {"expected a number >= 0 and perhaps a unit"});
  expect_wrong_input("watch " + table + rest + " --largest-speed 1 --forget 1e14",
                     {"--forget: expected at most 1e+10 s, but got '1e14'"});
  expect_wrong_input("tracks " + table + " --distance 1e30", {"--distance: expected at most 1e+15"});
}

}  // namespace
}  // namespace kinesphere::program::recordings_watch_test
