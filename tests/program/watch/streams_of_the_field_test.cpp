// Streams as their senders write them: what cannot be used is told, and nothing is dropped without a word.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program/support.hpp"
#include "program/watch/live_watch.hpp"

namespace kinesphere::program::streams_of_the_field_test {
namespace {

using Json = nlohmann::json;

class StreamsOfTheField : public ProgramTest {
 protected:
  /// Returns the verdicts of a run that must succeed.
  std::string verdicts(const std::string& text, const std::string& arguments) {
    const ProgramRun result =
        run("watch " + write("stream", text) + " --summary '" + path("summary.json") + "' " + arguments);
    err_ = result.err;
    EXPECT_EQ(result.exit_code, 0) << err_;
    summary_ = Json::parse(read_text(path("summary.json")));
    std::filesystem::remove(path("summary.json"));
    std::string told;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) {
      const Json alert = Json::parse(line);
      if (alert["event"] == "verdict") told += alert["verdict"].get<std::string>() + " ";
      rests_on_ = alert.value("rests_on", Json());
    }
    return told;
  }
  void expect_refused(const std::string& text, const std::string& arguments,
                      std::initializer_list<std::string_view> parts) {
    expect_wrong_input("watch " + write("stream", text) + " --quiet " + arguments, parts);
  }
  Json summary_, rests_on_;
  std::string err_;
};

const std::string cylinder = "--separation cylinder:5NM:1000ft --only all --look-ahead 0";
const std::string promises =
    " --separation sphere:5 --largest-speed 1 --acceleration 1 --position-error 0.1 --only all --look-ahead "
    "0 ";

/// Two aircraft that fly towards each other, with these keys.
std::string head_on(std::string_view list, double now, std::string_view first, std::string_view second) {
  return fmt::format(
      R"({{"now":{:.1f},"{}":[{{"hex":"a1","lat":50.0,"lon":8.0,"seen_pos":0.5,"track":90,{}}},)"
      R"({{"hex":"a2","lat":50.01,"lon":8.1,"seen_pos":0.2,"track":270,{}}}]}})"
      "\n",
      now, list, first, second);
}

TEST_F(StreamsOfTheField, AircraftInOtherShapes) {
  // dump1090-mutability.
  EXPECT_EQ(verdicts(head_on("aircraft", 1566891938, R"("nucp":7,"altitude":30000,"vert_rate":0,"speed":450)",
                             R"("nucp":7,"altitude":30200,"vert_rate":0,"speed":450)"),
                     cylinder),
            "undecided ");
  EXPECT_NE(rests_on_["first"].get<std::string>().find("position: the radius of nucp"), std::string::npos);
  // API v2 of ADSBexchange: milliseconds.
  EXPECT_EQ(verdicts(head_on("ac", 1717430000123, R"("rc":186,"alt_baro":30000,"gs":450)",
                             R"("rc":186,"alt_baro":30200,"gs":450)"),
                     cylinder),
            "undecided ");
  EXPECT_EQ(summary_["from"], 1717430000.123);
  // An aircraft in each line, as readsb --net-json-port sends them.
  std::string one_by_one;
  for (const auto& [hex, lon, track] : {std::tuple("a1", 8.0, 90), std::tuple("a2", 8.1, 270)})
    one_by_one += fmt::format(
        R"({{"now":1566891938.0,"hex":"{}","lat":50.0,"lon":{},"seen_pos":0.5,"track":{},"rc":186,"alt_baro":30000,"gs":450}})"
        "\n",
        hex, lon, track);
  EXPECT_EQ(verdicts(one_by_one, cylinder), "within ");
  EXPECT_EQ(summary_["reports"], 2);
  // Over several lines, and without an aircraft.
  std::string lines;
  for (const char c : head_on("ac", 1717430001000, R"("rc":186,"alt_baro":30000,"gs":450)",
                              R"("rc":186,"alt_baro":30200,"gs":450)"))
    lines += c == ',' || c == '{' ? std::string{c, '\n'} : std::string{c};
  EXPECT_EQ(verdicts(lines + "{\"ac\":null,\"now\":1717430002000}\n", cylinder), "undecided ");
  EXPECT_EQ(summary_["malformed"], 0);
}

TEST_F(StreamsOfTheField, WhatHasNoHeightIsUndecidedAndToldOnce) {
  const std::string stream =
      head_on("aircraft", 1566891938, R"("rc":186,"gs":450)", R"("rc":186,"alt_baro":30200,"gs":450)") +
      head_on("aircraft", 1566891939, R"("rc":186,"gs":450)", R"("rc":186,"alt_baro":30200,"gs":450)");
  EXPECT_EQ(verdicts(stream, cylinder), "undecided ");
  EXPECT_EQ(summary_["no_height"], 2);
  EXPECT_NE(rests_on_["first"].get<std::string>().find("height: unknown"), std::string::npos);
  EXPECT_TRUE(err_.starts_with("kinesphere: warning: ")) << err_;
  EXPECT_NE(err_.find("some reports have no height"), std::string::npos) << err_;
  EXPECT_EQ(err_.find("warning: ", 20), std::string::npos) << err_;
  EXPECT_EQ(summary_["warnings"][0]["what"], "no_height");
  EXPECT_EQ(summary_["warnings"][0]["times"], 2);
  // On the ground there is nothing to separate from.
  expect_refused(head_on("aircraft", 1566891938, R"("rc":186,"alt_baro":"ground","gs":5)",
                         R"("rc":186,"alt_baro":"ground","gs":5)"),
                 cylinder, {"2 on the ground"});
  // Of tables, too: the first has no height, and decides nothing.
  EXPECT_EQ(verdicts("id,time,x,y,z\nu,0,0,0,\nv,0,1,0,900\nu,1,0,0,\nv,1,1,0,900\n", promises),
            "undecided ");
}

TEST_F(StreamsOfTheField, SpeedsWithoutCoursesAreDiscs) {
  const std::string head = "MMSI,BaseDateTime,LAT,LON,SOG,COG\n";
  const auto ships = [&](const char* motion) {
    return head + fmt::format("1,2022-01-03T00:00:00,29.9,-90.0,{0}\n2,2022-01-03T00:00:00,29.91,-90.0,{0}\n",
                              motion);
  };
  // The two are 1109 m apart. The faster they may go, the sooner that they are within 1500 m is in doubt.
  const auto within_until = [&](const char* motion) {
    const ProgramRun result =
        run("watch " + write("s.csv", ships(motion)) + " --quiet --separation sphere:1500m");
    const Json alert = Json::parse(result.out.substr(0, result.out.find('\n')));
    EXPECT_EQ(alert["verdict"], "within") << result.out;
    EXPECT_EQ(alert["rests_on"].dump().find("velocity: 1.25 (default of ais)") == std::string::npos,
              std::string_view(motion).starts_with("102.3"));
    return alert["until"].get<std::string>();
  };
  EXPECT_LT(within_until("102.3,360.0"), within_until("8.0,360.0"));
  EXPECT_LT(within_until("8.0,360.0"), within_until("0.0,360.0"));
  EXPECT_EQ(within_until("0.0,360.0"), within_until("0.0,90.0")) << "at rest the course says nothing";
}

TEST_F(StreamsOfTheField, SparseStreamsGoOn) {
  std::string ship = "MMSI,BaseDateTime,LAT,LON,SOG,COG\n";
  for (int minute = 0; minute < 60; minute += 3)
    ship += fmt::format("211000000,2023-11-15T10:{:02}:12,53.5,8.0,0.0,{}\n", minute, minute);
  verdicts(ship, "--separation sphere:500m");
  EXPECT_EQ(summary_["reports"], 20);
  EXPECT_EQ(summary_["ahead"], 0);
  // Two ships that report every 20 minutes: others confirm the time, however far ahead it is.
  std::string ships = "id,time,x,y\n";
  for (int k = 0; k < 10; ++k)
    for (const char* id : {"a", "b", "c"})
      ships += fmt::format("{},{},{},0\n", id, 1200 * k, 100 * (id[0] - 'a'));
  verdicts(ships, promises);
  EXPECT_EQ(summary_["reports"], 30);
}

TEST_F(StreamsOfTheField, AClockThatIsSetBackIsTold) {
  const auto reports = [](int from, int count) {
    std::string rows;
    for (int k = 0; k < count; ++k) rows += fmt::format("u,{0},0,0\nv,{0},9,0\n", from + k);
    return rows;
  };
  const std::string before = "id,time,x,y\n" + reports(3600, 200);
  EXPECT_EQ(verdicts(before + reports(0, 40), promises), "");
  EXPECT_EQ(err_.find("a clock was set back"), std::string::npos) << "80 reports may be late";
  EXPECT_EQ(verdicts(before + reports(0, 60), promises), "");
  EXPECT_NE(err_.find("warning: " + path("stream") + ": the last 100 reports are older than all others"),
            std::string::npos)
      << err_;
}

TEST_F(StreamsOfTheField, AStreamOfWhichNothingCanBeUsedIsAnError) {
  expect_refused(
      head_on("aircraft", 1566891938, R"("rc":0,"alt_baro":30000,"gs":450)",
              R"("nac_p":0,"alt_baro":30000,"gs":450)"),
      cylinder,
      {"expected reports of format readsb that can be used, but there are none", "2 of unknown accuracy"});
  expect_refused("id,time,x,y\nu,0,,\nv,0,nan,inf\n", promises, {"2 without a position"});
  std::string mostly;
  for (int k = 0; k < 300; ++k)
    mostly += head_on(
        "aircraft", 1566891938 + k, R"("rc":0,"alt_baro":30000,"gs":450)",
        k % 3 == 0 ? R"("rc":186,"alt_baro":30000,"gs":450)" : R"("nac_p":0,"alt_baro":30000,"gs":450)");
  verdicts(mostly, cylinder);
  EXPECT_NE(err_.find("most reports cannot be used"), std::string::npos) << err_;
  // Before it ends, too, where no report has a position.
  std::string nowhere = "id,time,x,y\n";
  for (int k = 0; k < 101; ++k) nowhere += fmt::format("u,{},,\n", k);
  const ProgramRun blind = run("watch " + write("stream", nowhere) + promises);
  EXPECT_NE(blind.err.find("most reports cannot be used: 0 taken, 100 without a position or its time"),
            std::string::npos)
      << blind.err;
  // Lines of other messages, none of which has a number of its own, are no headers.
  const std::string aprs =
      "FLR01>OGFLR,qAS,LSZH:/235950h4718.00N/00829.21En/A=001322\nFLR02>OGFLR,qAS,LSZH:/235951h4717.46N\n";
  expect_refused(aprs, promises, {"expected columns for id, time", "it has the columns FLR01>OGFLR, qAS"});
  expect_refused("hello, to, all, of, you\n", promises, {"it has the columns hello, to, all, of, you"});
  verdicts("id,time,x,y\n", promises);
  EXPECT_EQ(summary_["reports"], 0) << "a stream without reports";
  std::string endless = aprs;
  for (int k = 0; k < 20; ++k) endless += aprs;
  LiveWatch living("-" + promises, path("err"));
  living.write(endless);
  EXPECT_EQ(living.wait(), 2) << "before the stream ends";
  EXPECT_NE(living.err().find("it has the columns FLR01>OGFLR, qAS"), std::string::npos) << living.err();
}

TEST_F(StreamsOfTheField, ClocksGoOnBehindMidnight) {
  // From 23:59:50 on; the report of v at 23:59:59 comes late. Once without days, and once with them.
  const auto stream = [](std::string_view before, std::string_view behind, std::size_t count) {
    std::vector<std::string> rows;
    for (int k = 0; k < 20; ++k)
      for (const char id : {'u', 'v'})
        rows.push_back(fmt::format("{},{}:{:02},0,{}\n", id, k < 10 ? before : behind, (50 + k) % 60,
                                   id == 'u' ? 0 : 20 - k));
    std::rotate(rows.begin() + 19, rows.begin() + 20, rows.begin() + 24);
    std::string text = "id,time,x,y\n";
    for (std::size_t k = 0; k < count; ++k) text += rows[k];
    return text;
  };
  const std::string clock = promises + "--time-unit clock ";
  const std::string expected = verdicts(stream("2024-02-29 23:59", "2024-03-01 00:00", 40), promises);
  EXPECT_TRUE(expected.ends_with("within ")) << expected;
  EXPECT_EQ(verdicts(stream("23:59", "00:00", 40), clock), expected);
  EXPECT_EQ(summary_["reports"], 40);
  EXPECT_EQ(summary_["too_old"], 0);
  // Also where it is started again behind midnight.
  const std::string kept = clock + "--snapshot " + path("state") + " ";
  const std::string before = verdicts(stream("23:59", "00:00", 26), kept);
  EXPECT_EQ(before + verdicts(stream("23:59", "00:00", 40), kept), expected);
  EXPECT_EQ(summary_["too_old"], 0);
}

/// The numbers of such rows would be those of other columns.
TEST_F(StreamsOfTheField, RowsWithMoreFieldsThanTheHeaderAreMalformed) {
  std::string decimal_commas = "id,time,x,y\n", merged = decimal_commas;
  for (int k = 0; k < 9; ++k) decimal_commas += fmt::format("u,{},5,{},5,0,0\nv,{},5,{},5,9,0\n", k, k, k, k);
  expect_refused(
      decimal_commas, promises,
      {"18 malformed", "expected 4 columns as in the header, but got 7 (decimal commas are read where"});
  merged += "u,0,0,0\nu,1,0,0u,2,0,0\nv,2,0,9\nu,3,0,0,\n";
  verdicts(merged, promises);
  EXPECT_EQ(summary_["reports"], 3);
  EXPECT_EQ(summary_["malformed"], 1);
  verdicts("u,0,0,0\nu,1,0,0,0\nv,2,0,9\n", promises + "--columns id=1,time=2,x=3,y=4");
  EXPECT_EQ(summary_["malformed"], 1) << "without a header, more than the first row has";
}

TEST_F(StreamsOfTheField, OneStreamAtATime) {
  const std::string row = "id,time,x,y\nu,0,0,0\n";
  const std::string a = write("a.csv", row), b = write("b b.csv", row);
  expect_wrong_input("watch " + a + " --separation sphere:5 '" + b + "'",
                     {"expected one stream, but got", "b b.csv", "kinesphere tracks " + a + " '" + b + "'"});
}

TEST_F(StreamsOfTheField, RecordsOfReceiversInJson) {
  const std::string limits =
      " --separation sphere:500m --acceleration 1 --largest-speed 30 "
      "--position-error 10 --velocity-error 1 --only all --look-ahead 0 ";
  std::string catcher, features;
  for (int k = 0; k < 3; ++k) {
    for (int ship = 0; ship < 2; ++ship) {
      catcher += fmt::format(
          R"({{"class":"AIS","rxtime":"20240331235950","channel":"A","nmea":["!AIVDM,1,1,,A,13u?etPv2;0n:dDPwUM)"
          R"(1U1Cb069D,0*24"],"type":1,"mmsi":{},"lon":8.{}2,"lat":54,"rxuxtime":{}}})"
          "\n",
          211000000 + ship, ship, 1711929590 + k);
      features += fmt::format(
          R"({{"type":"Feature","geometry":{{"type":"Point","coordinates":[8.{}2,54]}},"properties":{{"id":"u{}",)"
          R"("time":{}}}}})"
          "\n",
          ship, ship, 1711929590 + k);
    }
  }
  verdicts(catcher, limits);
  EXPECT_EQ(summary_["reports"], 6);
  verdicts(features, limits +
                         "--columns "
                         "id=properties.id,time=properties.time,lon=geometry.coordinates.0,lat=geometry."
                         "coordinates.1 ");
  EXPECT_EQ(summary_["reports"], 6);
  expect_refused(
      features, limits,
      {"say --columns id=properties.id,time=properties.time,lon=geometry.coordinates.0,lat=geometry."
       "coordinates.1"});
}

TEST_F(StreamsOfTheField, LengthsOfUnknownUnit) {
  const std::string stream = "id,time,x,y\nu,0,0,0\nv,0,3,0\nu,1,0,0\nv,1,3,0\n";
  const std::string numbers =
      " --separation sphere:5 --largest-speed 1 --position-error 0.1 --only all --look-ahead 0";
  EXPECT_EQ(verdicts(stream, numbers), "within undecided within ");
  for (const char* options : {"--separation sphere:5m --largest-speed 1 --position-error 0.1",
                              "--separation sphere:5 --largest-speed 1kt --position-error 0.1",
                              "--separation sphere:5 --largest-speed 1 --position-error 0.1:1ft"})
    expect_refused(stream, options,
                   {"expected numbers without a unit, because the unit of the lengths of ", "say --unit"});
  EXPECT_EQ(verdicts(stream,
                     " --separation sphere:500cm --unit m --largest-speed 1 --position-error 0.1 --only all"),
            "within undecided within ");
  EXPECT_EQ(verdicts("id,time,x_cm,y_cm\nu,0,0,0\nv,0,300,0\nu,1,0,0\nv,1,300,0\n",
                     " --separation sphere:5m --largest-speed 1 --position-error 0.1 --only all"),
            "within undecided within ");
  expect_refused("{\"id\": \"u\", \"stamp\": 0, \"position\": [0, 0]}\n",
                 "--separation sphere:5m --largest-speed 1 --position-error 0.1",
                 {"--separation: expected numbers without a unit", "'sphere:5m'"});
}

TEST_F(StreamsOfTheField, LongLengthsAreWrittenOut) {
  const ProgramRun far =
      run("watch " + write("stream", "id,time,x,y\nu,0,0,0\nv,0,500000000,0\nu,1,0,0\nv,1,500000000,0\n") +
          " --separation sphere:600000000 --largest-speed 1 --position-error 0.1 --text --quiet");
  EXPECT_NE(far.out.find("now 500000000"), std::string::npos) << far.out << far.err;
}

TEST_F(StreamsOfTheField, TimesThatAreNoSeconds) {
  const auto stream = [](auto time_of) {
    std::string text = "id,time,x,y\n";
    for (int k = 0; k < 200; ++k) text += fmt::format("u,{0},0,0\nv,{0},9,0\n", time_of(k));
    return text;
  };
  expect_refused(stream([](int k) { return fmt::format("{:.8f}", 45351.5 + k / 86400.0); }), promises,
                 {"may be days", "--time-unit d"});
  expect_refused(stream([](int k) { return fmt::format("10{:02}{:02}", 15 + k / 60, k % 60); }), promises,
                 {"the times 101500 to 101600 may be those of a clock"});
  EXPECT_EQ(verdicts(stream([](int k) { return fmt::format("{}", 101500 + k); }), promises), "");
  EXPECT_EQ(summary_["reports"], 400);
}

TEST_F(StreamsOfTheField, WhatCannotBeTrueIsToldWhileItRuns) {
  std::string jumps = "id,time,x,y\n", sorted_by_id = jumps;
  for (int k = 0; k < 40; ++k) jumps += fmt::format("u,{},{},0\n", k, 1000 * (k % 2));
  verdicts(jumps, promises);
  EXPECT_NE(err_.find("reports contradict those before, so that alerts may be wrong or missing"),
            std::string::npos)
      << err_;
  for (const char* id : {"u", "v"})
    for (int k = 0; k < 150; ++k) sorted_by_id += fmt::format("{},{},{},0\n", id, 10 * k, id[0] - 'u');
  verdicts(sorted_by_id, promises);
  EXPECT_NE(err_.find("have to be sorted"), std::string::npos) << err_;
  // Within --forget, so that all are taken.
  std::string briefly_sorted_by_id = "id,time,x,y\n";
  for (const char* id : {"u", "v"})
    for (int k = 0; k < 40; ++k)
      briefly_sorted_by_id += fmt::format("{},{},0,{}\n", id, k, 9 * (id[0] - 'u'));
  // A pipe cannot be sorted.
  const ProgramRun piped = run("watch --separation sphere:5 " + promises,
                               "cat '" + write("stream", briefly_sorted_by_id) + "' | ");
  EXPECT_NE(piped.err.find("34 of 80 reports are more than 5 s older than others before them"),
            std::string::npos)
      << piped.err;
  std::string wrong_clock = "id,time,x,y\n";
  for (int k = 0; k < 150; ++k) wrong_clock += fmt::format("u,{0},0,0\nw,{1},3,0\nv,{0},9,0\n", k, k + 3600);
  verdicts(wrong_clock, promises);
  EXPECT_EQ(summary_["reports"], 300) << "the first wrong time does not count either";
  EXPECT_EQ(err_.find("have no velocities"), std::string::npos) << "nothing is predicted";
  verdicts(wrong_clock, " --separation sphere:5 --largest-speed 1 --position-error 0.1");
  EXPECT_NE(err_.find("have no velocities"), std::string::npos) << err_;
  EXPECT_NE(err_.find("100 reports are stamped ahead of all others"), std::string::npos) << err_;
  std::string backwards = "id,time,x,y\n";
  for (int k = 0; k < 150; ++k) backwards += fmt::format("u,{0},0,0\nv,{0},9,0\n", 150 - k);
  verdicts(backwards, promises);
  EXPECT_NE(err_.find("rows have to be in the order of their times"), std::string::npos) << err_;
}

TEST_F(StreamsOfTheField, TablesOfShipsAreKnownByTheirColumns) {
  const std::string rows =
      "211;2024-01-01T00:00:00Z;8.0;54.0\n212;2024-01-01T00:00:00Z;8.0;54.0\n"
      "211;2024-01-01T00:00:09Z;8.0;54.0\n212;2024-01-01T00:00:09Z;8.0;54.0\n";
  for (const char* header : {"mmsi;date_time_utc;lon;lat\n", "SourceMMSI;t;longitude;latitude\n"}) {
    EXPECT_EQ(verdicts(header + rows, "--separation sphere:200m"), "within ") << header;
    EXPECT_EQ(summary_["format"], "ais");
  }
}

TEST_F(StreamsOfTheField, PositionsAloneNeedALargestSpeed) {
  expect_refused("id,time,x,y\nu,0,0,0\nv,0,3,0\n",
                 "--separation sphere:5 --acceleration 1 --position-error 0.1",
                 {"--largest-speed: expected it, because", "has positions without velocities"});
  // A track that loses its velocity later ends nothing.
  verdicts("id,time,x,y,vx,vy\nu,0,0,0,0,0\nv,0,30,0,0,0\nu,1,0,0,,\nv,1,30,0,0,0\n",
           "--separation sphere:5 --acceleration 1 --position-error 0.1 --velocity-error 0.1");
  EXPECT_EQ(summary_["no_velocity"], 1);
}

TEST_F(StreamsOfTheField, TablesMeanWhatTheySay) {
  EXPECT_EQ(verdicts("id,time,x_cm,y_cm\nu,0,0,0\nv,0,300,0\n", promises).substr(0, 7), "within ");
  expect_refused("id,time,x_cm,y\nu,0,0,0\n", promises,
                 {"column 'y' does not say its unit, but column 'x_cm' does"});
  expect_refused("id,time,lat,lon,sog,cog\nu,0,50,8,10,90\n", promises,
                 {"column 'sog' does not say its unit", "speed=sog:kt"});
  for (const char* craft : {"mmsi", "icao24"})
    expect_refused(fmt::format("{},time,lat,lon,speed,course\n211,0,50,8,10,90\n", craft), promises,
                   {"column 'speed' does not say its unit, which for speeds of ships and aircraft",
                    "speed=speed:kt", "(or :m/s)"});
  EXPECT_EQ(
      verdicts(
          "date,time,id,lat,n,lon,e\n2024-02-29,23:59:59,u,0,N,8,W\n2024-02-29,23:59:59,v,0.00003,S,8,W\n",
          promises)
          .substr(0, 7),
      "within ");
  expect_refused("id,time,x,y\nu,1700000000000,0,0\n", promises,
                 {":2: expected seconds as time", "--time-unit ms"});
  expect_refused(head_on("aircraft", 0.0, R"("gs":450)", R"("gs":450)"), cylinder + " --where 'speed > 1'",
                 {"--where: expected a table"});
  expect_refused("id,time,x,y,valid\nu,0,0,0,false\n", promises, {":2:", "--where 'valid != false'"});
  // Questions of a stream that has been understood end nothing, but their rows are not taken.
  verdicts("id,time,x,y,valid\nu,0,0,0,true\nu,1,0,0,false\n", promises);
  EXPECT_EQ(summary_["malformed"], 1);
  EXPECT_EQ(verdicts("id,time,x,y,valid\nu,0,0,0,true\nv,0,3,0,true\nw,0,4,0,false\n",
                     promises + "--where 'valid != false'")
                .substr(0, 7),
            "within ");
  EXPECT_EQ(summary_["filtered"], 1);
  EXPECT_EQ(verdicts("id;time;x;y\nu;0,5;0;0\nv;0,5;0,25;0\n", promises).substr(0, 7), "within ");
  EXPECT_EQ(verdicts("# id,time,x,y\nu,0,0,0\nv,0,3,0\n", promises).substr(0, 7), "within ");
  // Rows that end before the last body's column are malformed.
  EXPECT_EQ(
      verdicts("# made by hand\n\n# in metres\nid,time,x,y\na,0,0,0\nb,0,3,0\na,1,0,0\nb,1,3,0\n", promises)
          .substr(0, 7),
      "within ");
  EXPECT_EQ(verdicts("time,x1,y1,z1,x2,y2,z2\n0,0,0,0,3,0,0\n1,0,0,0,3,0\n", promises).substr(0, 7),
            "within ");
  EXPECT_EQ(summary_["malformed"], 1);
  expect_refused(std::string("\xFF\xFEi\0d\0,\0", 8), promises, {"UTF-16"});
  // Recordings that are wrong are told as by tracks.
  expect_refused("<?xml version=\"1.0\"?><gpx></gpx>", promises, {"expected tracks (trk) whose points"});
  expect_refused("scorer,a,a\nbodyparts,b,b\ncoords,x,y\n0,1,2\n", promises, {"a table of DeepLabCut"});
  expect_refused("AXXX001\nHFDTE010124\nB000000\n", promises, {"a flight log (IGC)"});
  expect_refused("Format Version,1.23,Take Name,a\n,,\n", promises, {"OptiTrack): make a table"});
  expect_refused("2\nwater\nO 1 2 3\nH 4 5 6\n", promises, {"--frame-rate"});
  expect_refused("$GPGSV,1,1,00*79\n", promises,
                 {"$GPRMC and $GPGGA of receivers of GPS are read from a file"});
  expect_refused("{\"name\":\"a\"}\n", promises, {"say --columns"});
}

TEST_F(StreamsOfTheField, DegreesAreNoLengthsAndRowNumbersNoIds) {
  // Two animals 55 km apart.
  const std::string animals = "id,time,X,Y\nu,0,8.01,47.00\nv,0,8.01,47.05\nu,1,8.02,47.00\nv,1,8.02,47.05\n";
  const ProgramRun asked = run("watch " + write("stream", animals) + promises);
  EXPECT_EQ(asked.exit_code, 2);
  EXPECT_NE(asked.err.find("x (8.01 to 8.02) and y (47 to 47.05) may be degrees: say --positions lonlat"),
            std::string::npos)
      << asked.err;
  EXPECT_EQ(verdicts(animals, promises + "--positions lonlat"), "");
  EXPECT_EQ(verdicts(animals, promises + "--positions plane").substr(0, 7), "within ");
  EXPECT_EQ(verdicts(animals, promises + "--columns id=id,time=time,x=X:m,y=Y:m").substr(0, 7), "within ");
  EXPECT_EQ(verdicts("id,time,x,y\nu,0,3.5,2.5\nv,0,4.5,2.5\n", promises).substr(0, 7), "within ");
  expect_refused(animals, promises + "--positions utm:33N", {"--positions: expected lonlat or plane"});
  expect_refused(head_on("aircraft", 0.0, R"("gs":450)", R"("gs":450)"), cylinder + " --positions plane",
                 {"--positions: expected a table"});
  // Ids that are numbers of rows; three bodies may be so called at one time.
  const std::string rows = "id,time,x,y\n1,0,0,0\n2,0,9,0\n3,{},0,0\n";
  const ProgramRun numbered = run("watch " + write("stream", fmt::format(fmt::runtime(rows), 1)) + promises);
  EXPECT_NE(numbered.err.find("each row has an id of its own in column 1"), std::string::npos)
      << numbered.err;
  verdicts(fmt::format(fmt::runtime(rows), 1), promises + "--where 'id != none'");
  verdicts(fmt::format(fmt::runtime(rows), 0), promises);
  // A stream is asked about before it ends.
  std::string stream = "id,time,X,Y\n";
  for (int k = 0; k < 30; ++k) stream += fmt::format("u,{},8.{:03},47\n", k, k);
  const ProgramRun result = run("watch " + write("stream", stream + "damaged\n") + promises);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("may be degrees"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("expected 4 columns"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace kinesphere::program::streams_of_the_field_test
