// The reports of each format, from small samples as their sources write them, and the refused lines.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "formats/streams/report_format.hpp"
#include "program/support.hpp"

namespace kinesphere::program::formats_test {
namespace {

/// Stores everything that it receives.
class CollectedReports final : public ReportSink {
 public:
  struct Report {
    std::string id;
    SourceReport report;
  };
  void take(const SourceReport& report) override { reports.push_back({std::string(report.id), report}); }
  void time_is(const FileTime& arrival, TimeKind) override { times.push_back(arrival); }
  void pass_over(Passed reason) override { passed.push_back(reason); }
  void refuse(std::size_t line, const std::string& reason) override {
    refused.push_back(std::to_string(line) + ": " + reason);
  }

  std::vector<Report> reports;
  std::vector<FileTime> times;
  std::vector<Passed> passed;
  std::vector<std::string> refused;
  std::shared_ptr<ReportFormat> format;  ///< has the texts of declarations
};

/// Reads all records of a text.
CollectedReports read_all(StreamFormat name, std::string_view text, const FormatChoices& choices = {}) {
  CollectedReports kept;
  kept.format = make_format(name, choices);
  RecordCutter cutter(records_of(name));
  cutter.feed(text);
  const auto read = [&](const Record& record) {
    try {
      kept.format->read(record, kept);
    } catch (const WrongInput& error) {
      kept.refuse(record.line, error.what());
    }
  };
  while (const auto record = cutter.next()) read(*record);
  if (const auto record = cutter.rest()) read(*record);
  return kept;
}

double seconds(const FileTime& time) { return static_cast<double>(time.whole) + time.fraction; }

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-9) {
  EXPECT_LT(norm(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

constexpr std::string_view aircraft = R"({ "now" : 1700000000.5,
  "messages" : 12,
  "aircraft" : [
{"hex":"4ca1fa","type":"adsb_icao","flight":"RYR1  ","alt_baro":35000,"alt_geom":35600,"gs":450.0,"track":90.0,"baro_rate":-600,"lat":51.5,"lon":-0.5,"nic":8,"rc":186,"seen_pos":0.25,"version":2,"nac_p":9,"nac_v":2,"sil":3,"gva":2,"mlat":[],"tisb":[],"seen":0.1,"rssi":-20.1},
{"hex":"400a02","alt_baro":"ground","gs":5.0,"track":0,"lat":51.47,"lon":-0.45,"seen_pos":2.5,"nac_p":8},
{"hex":"~2abc0","alt_baro":12000},
{"hex":"400a03","alt_baro":1000,"lat":51.0,"lon":0.0,"seen_pos":1,"rc":0,"nac_p":0},
{"hex":"400a04","alt_baro":1000,"lat":"north","lon":0.0,"seen_pos":1},
{"hex":"400a05","alt_baro":1000,"lat":95.0,"lon":0.0,"seen_pos":1}
  ]
}
)";

TEST(ReadsbFormat, SaysWhereAircraftAreAndHowFarOff) {
  const CollectedReports kept = read_all(StreamFormat::readsb, aircraft);
  ASSERT_EQ(kept.reports.size(), 2u);
  const auto& [id, report] = kept.reports[0];
  EXPECT_EQ(id, "4ca1fa");
  EXPECT_DOUBLE_EQ(seconds(report.stamp), 1700000000.25);
  EXPECT_DOUBLE_EQ(seconds(*report.arrival), 1700000000.5);
  EXPECT_TRUE(report.geographic);
  expect_near(report.position, {-0.5, 51.5, 35000 * foot});
  expect_near(*report.velocity, {450.0 * knot, 0.0, -10.0 * foot});
  EXPECT_EQ(report.position_error->bound, 186.0);
  EXPECT_EQ(report.position_error->declaration, "rc");
  EXPECT_DOUBLE_EQ(report.velocity_error->bound, 7.5);
  EXPECT_EQ(report.velocity_error->declaration, "2.5 times the 95 % of nac_v");
  EXPECT_DOUBLE_EQ(report.climb_error->bound, 2.5 * 15.0 * foot);
  EXPECT_FALSE(report.height_error);
  const SourceReport& on_ground = kept.reports[1].report;
  EXPECT_FALSE(on_ground.has_height);
  EXPECT_DOUBLE_EQ(on_ground.position_error->bound, 2.5 * 92.6);
  EXPECT_EQ(kept.passed, (std::vector{Passed::no_position, Passed::no_bound}));
  ASSERT_EQ(kept.refused.size(), 2u);
  EXPECT_EQ(kept.refused[0], "1: expected a number as \"lat\" of aircraft 400a04");
  EXPECT_NE(kept.refused[1].find("400a05"), std::string::npos);
  EXPECT_EQ(kept.times.size(), 1u);
}

TEST(ReadsbFormat, DeclaresAsItIsTold) {
  FormatChoices choices;
  choices.containment = 4.0;
  choices.position_bound = FormatChoices::PositionBound::accuracy;
  choices.altitude = FormatChoices::Altitude::geometric;
  const CollectedReports kept = read_all(StreamFormat::readsb, aircraft, choices);
  const SourceReport& report = kept.reports[0].report;
  EXPECT_DOUBLE_EQ(report.position_error->bound, 120.0);
  EXPECT_DOUBLE_EQ(report.position.z, 35600 * foot);
  EXPECT_DOUBLE_EQ(report.height_error->bound, 180.0);
}

TEST(ReadsbFormat, TakesNoPositionsOfOthersUnlessTheirErrorIsSaid) {
  constexpr std::string_view text = R"({"now": 100, "aircraft": [
{"hex":"a","type":"mlat","alt_baro":1000,"lat":51.0,"lon":0.0,"seen_pos":1,"rc":0},
{"hex":"b","alt_baro":1000,"lat":51.0,"lon":0.0,"seen_pos":1,"mlat":["gs","lat","lon"],"tisb":[]},
{"hex":"c","type":"tisb_icao","alt_baro":1000,"lat":51.0,"lon":0.0,"seen_pos":1,"nac_p":8,"tisb":["lat"]},
{"hex":"d","type":"adsr_icao","alt_baro":1000,"lat":51.0,"lon":0.0,"seen_pos":1,"nac_p":8,"mlat":[],"tisb":[]},
{"hex":"e","type":"adsb_icao","alt_baro":1000,"lat":51.0,"lon":0.0,"seen_pos":1,"rc":75,"sil":0,"nac_p":8}]})";
  const CollectedReports kept = read_all(StreamFormat::readsb, text);
  ASSERT_EQ(kept.reports.size(), 2u);
  EXPECT_EQ(kept.reports[0].id, "d");
  EXPECT_EQ(kept.reports[1].id, "e");
  EXPECT_DOUBLE_EQ(kept.reports[1].report.position_error->bound, 2.5 * 92.6) << "rc is of no integrity";
  EXPECT_EQ(kept.passed, std::vector(3, Passed::no_bound));
  FormatChoices choices;
  choices.position_error_is_said = true;
  const CollectedReports all = read_all(StreamFormat::readsb, text, choices);
  ASSERT_EQ(all.reports.size(), 5u);
  EXPECT_FALSE(all.reports[2].report.position_error) << "that of the option";
}

TEST(ReadsbFormat, RefusesWhatIsNoAircraftJson) {
  for (const char* const text :
       {R"({"aircraft": []})", R"({"now": "noon", "aircraft": []})", R"({"now": 1})",
        R"({"now": 1, "aircraft": 3})", R"({"now": 1, "aircraft": [3]})",
        R"({"now": 1, "aircraft": [{"hex": "a",]})", "3", R"({"now": 1, "aircraft": [)"}) {
    const CollectedReports kept = read_all(StreamFormat::readsb, text);
    ASSERT_EQ(kept.refused.size(), 1u) << text;
    EXPECT_TRUE(kept.refused[0].starts_with("1: expected ")) << kept.refused[0];
    EXPECT_TRUE(kept.reports.empty());
  }
}

TEST(OpenskyFormat, ReadsStateVectors) {
  const CollectedReports kept = read_all(StreamFormat::opensky, R"({"time":1458564121,"states":[
    ["ab1644","UAL421  ","United States",1458564120,1458564120,-81.1264,35.4021,11277.6,false,240.5,180.0,-1.5,null,11500.2,"1712",false,0],
    ["ac96b8","","United States",null,1458564000,null,null,null,true,0,0,null,null,null,null,false,0],
    ["ad0002","","X",1458564119,1458564120,-81,35,1000,false,10,0,null,null,null,null,false,2],
    ["ad0001","","X",1458564119,1458564120,-81,35,null,true,10,0,null,null,null,null,false,0],
    [7]]}
{"time":1458564131,"states":null}
{"time":"noon","states":[]})");
  ASSERT_EQ(kept.reports.size(), 2u) << kept.refused.size();
  const auto& [id, report] = kept.reports[0];
  EXPECT_EQ(id, "ab1644");
  EXPECT_EQ(seconds(report.stamp), 1458564120.0);
  EXPECT_EQ(seconds(*report.arrival), 1458564121.0);
  expect_near(report.position, {-81.1264, 35.4021, 11277.6});
  expect_near(*report.velocity, {0.0, -240.5, -1.5});
  EXPECT_FALSE(kept.reports[1].report.has_height);
  EXPECT_FALSE(kept.reports[1].report.has_climb);
  EXPECT_EQ(kept.passed, (std::vector{Passed::no_position, Passed::no_bound}));
  EXPECT_EQ(kept.times.size(), 2u);
  ASSERT_EQ(kept.refused.size(), 2u);
  EXPECT_EQ(kept.refused[1], "8: expected \"time\": seconds");
}

TEST(SbsFormat, PutsPositionsAndVelocitiesTogether) {
  const std::string day = "2026/03/01,12:00:";
  const auto message = [&](int type, const char* seconds, const char* rest) {
    return "MSG," + std::to_string(type) + ",1,1,4CA1FA,1," + day + seconds + "," + day + seconds + rest +
           "\r\n";
  };
  const CollectedReports kept = read_all(
      StreamFormat::sbs,
      message(3, "00.000", ",,35000,,,51.5,-0.5,,,0,0,0,0") + message(1, "00.100", ",RYR1,,,,,,,,,,,") +
          message(4, "00.500", ",,,450,90,,,-600,,,,,") +
          message(3, "01.000", ",,35000,,,51.5,-0.4,,,0,0,0,0") +
          message(3, "09.000", ",,,,,51.5,-0.3,,,0,0,0,-1") + message(3, "09.500", ",,35000,,,,,,,0,0,0,0") +
          "STA,,5,179,400AE7,10103,2008/11/28,14:58:51.153,2008/11/28,14:58:51.153,RM\n" +
          message(3, "10.000", ",,35000,,,north,-0.3,,,0,0,0,0") + "MSG,3,1\nmumble\n");
  ASSERT_EQ(kept.reports.size(), 3u);
  EXPECT_EQ(kept.reports[0].id, "4CA1FA");
  EXPECT_FALSE(kept.reports[0].report.velocity);
  const SourceReport& second = kept.reports[1].report;
  ASSERT_TRUE(second.velocity);
  expect_near(*second.velocity, {450.0 * knot, 0.0, -10.0 * foot});
  EXPECT_NEAR(second.velocity_age, 0.5, 1e-9);
  EXPECT_EQ(second.time_kind, TimeKind::date);
  EXPECT_EQ(second.stamp.whole, 1772366401);
  EXPECT_FALSE(kept.reports[2].report.velocity) << "it is too old";
  EXPECT_FALSE(kept.reports[2].report.has_height);
  EXPECT_EQ(kept.passed, (std::vector{Passed::no_position}));
  ASSERT_EQ(kept.refused.size(), 3u);
  EXPECT_EQ(kept.refused[0], "8: expected a number as a latitude (field 15), but got 'north'");
  EXPECT_EQ(kept.refused[1], "9: expected 22 fields, but got 3");
  EXPECT_EQ(kept.refused[2], "10: expected a message of SBS (MSG,...), but got 'mumble'");
}

/// Receivers write local times.
TEST(SbsFormat, KnowsTheZoneOfALiveReceiver) {
  for (const std::int64_t zone : {-5 * 3600, 0, 20700, 3600}) {
    CollectedReports kept;
    const auto format = make_format(StreamFormat::sbs, {});
    Record record{.text =
                      "MSG,3,1,1,4CA1FA,1,2026/03/01,12:00:00.000,2026/03/"
                      "01,12:00:01.500,,35000,,,51.5,-0.5,,,0,0,0,0"};
    constexpr std::int64_t noon = 1772366400;
    record.read_at = FileTime{noon + 2 - zone, 0.5};
    format->read(record, kept);
    ASSERT_EQ(kept.reports.size(), 1u);
    EXPECT_EQ(seconds(kept.reports[0].report.stamp), static_cast<double>(noon - zone));
    EXPECT_EQ(seconds(*kept.reports[0].report.arrival), static_cast<double>(noon - zone) + 1.5);
    // Messages of a log are read minutes later, or at another time of the day.
    record.read_at = FileTime{noon + 300 - zone, 0.0};
    format->read(record, kept);
    EXPECT_EQ(seconds(kept.reports[1].report.stamp), static_cast<double>(noon));
  }
}

TEST(SbsFormat, TakesVelocitiesOfPositionMessages) {
  const CollectedReports kept = read_all(
      StreamFormat::sbs,
      "MSG,3, 0,  0,4006B3,      "
      "0,2009/06/19,06:15:05.984,2009/06/19,06:20:05.984,,18225,390,090,51.4870,-1.9225,-2400,4244,0,0,0,0\n"
      "ID ,,64,522,4006B3,1509068,2009/06/19,07:12:42.179,2009/06/19,07:12:42.179,BAW4J\n");
  ASSERT_EQ(kept.reports.size(), 1u);
  expect_near(*kept.reports[0].report.velocity, {390 * knot, 0, -40.0 * foot});
  EXPECT_TRUE(kept.refused.empty());
}

TEST(AisFormat, ReadsMarinecadastre) {
  const CollectedReports kept =
      read_all(StreamFormat::ais,
               "MMSI,BaseDateTime,LAT,LON,SOG,COG,Heading,VesselName,IMO,CallSign,VesselType,Status,Length,"
               "Width,Draft,Cargo,TransceiverClass\n"
               "367390380,2023-01-01T00:00:01,29.94672,-90.01,10.0,90.0,511.0,\"TUG, THE\",,,31,0,,,,,A\n"
               "367390381,2023-01-01T00:00:02,29.9,-90.02,102.3,360.0,511.0,,,,31,0,,,,,B\n"
               "367390382,2023-01-01T00:00:03,91.0,181.0,0.0,0.0,511.0,,,,31,0,,,,,B\n"
               "367390383,2023-02-30T00:00:03,29.9,-90.02,0.0,0.0,511.0,,,,31,0,,,,,B\n"
               "367390384,2023-01-01T00:00:03,29.9\n");
  ASSERT_EQ(kept.reports.size(), 2u);
  EXPECT_EQ(kept.reports[0].id, "367390380");
  expect_near(*kept.reports[0].report.velocity, {10.0 * knot, 0.0, 0.0});
  EXPECT_EQ(seconds(kept.reports[0].report.stamp), 1672531201.0);
  EXPECT_FALSE(kept.reports[1].report.velocity) << "not available";
  EXPECT_EQ(kept.passed, (std::vector{Passed::no_position}));
  ASSERT_EQ(kept.refused.size(), 2u);
  EXPECT_EQ(kept.refused[0],
            "5: expected a time (column 2), but got '2023-02-30T00:00:03' (dates are read as in "
            "2024-01-31T12:30:00Z)");
  EXPECT_EQ(kept.refused[1], "6: expected 6 columns or more, but got 3");
  // The form of the file since 2025.
  const CollectedReports later = read_all(StreamFormat::ais,
                                          "mmsi,base_date_time,longitude,latitude,sog,cog,heading\n"
                                          "367390380,2025-01-01 00:00:01,-90.01,29.94672,10.0,90.0,511\n");
  ASSERT_EQ(later.reports.size(), 1u);
  expect_near(later.reports[0].report.position, {-90.01, 29.94672, 0.0});
}

TEST(CsvFormat, FindsColumnsByTheirUsualNames) {
  const CollectedReports kept =
      read_all(StreamFormat::csv,
               "# a comment\nid;time;x;y;z;vx;vy;vz;position_error;velocity_error\n"
               "ann;1.5;1;2;3;0.1;0.2;0.3;0.5;0.01\n\"b;ob\";2;1;2;;;;;;\nann;3;1;east;3;0;0;0;"
               ";\nann;4;1;1;1;0;0;0;-1;\n");
  ASSERT_EQ(kept.reports.size(), 2u);
  const SourceReport& report = kept.reports[0].report;
  expect_near(report.position, {1, 2, 3});
  expect_near(*report.velocity, {0.1, 0.2, 0.3});
  EXPECT_EQ(report.position_error->bound, 0.5);
  EXPECT_EQ(report.velocity_error->bound, 0.01);
  EXPECT_EQ(kept.reports[1].id, "b;ob");
  EXPECT_FALSE(kept.reports[1].report.has_height);
  EXPECT_FALSE(kept.reports[1].report.velocity);
  EXPECT_FALSE(kept.reports[1].report.position_error);
  ASSERT_EQ(kept.refused.size(), 2u);
  EXPECT_EQ(kept.refused[0], "5: expected a number as y (column 4), but got 'east'");
  EXPECT_EQ(kept.refused[1], "6: expected an error >= 0 (column 9), but got '-1'");
}

TEST(CsvFormat, TakesAMapOfColumnsWithUnits) {
  FormatChoices choices;
  choices.hints.columns = "id=1,time=ms:ms,lat=3,lon=4,alt=height:ft,speed=6:kt,course=7";
  const CollectedReports kept =
      read_all(StreamFormat::csv, "who,ms,a,b,height,v,dir\nx,1500,50,8,1000,100,180\n", choices);
  ASSERT_EQ(kept.reports.size(), 1u);
  const SourceReport& report = kept.reports[0].report;
  EXPECT_DOUBLE_EQ(seconds(report.stamp), 1.5);
  expect_near(report.position, {8, 50, 304.8});
  expect_near(*report.velocity, {0, -100 * knot, 0});
  choices.hints.columns = "id=1,time=2,x=3,y=4";
  EXPECT_EQ(read_all(StreamFormat::csv, "a,0,1,2\na,1,1,2\n", choices).reports.size(), 2u)
      << "without a header";
}

TEST(CsvFormat, RefusesWrongMaps) {
  const auto error = [](const char* columns) {
    return error_of([&] {
      FormatChoices choices;
      choices.hints.columns = columns;
      read_all(StreamFormat::csv, "who,t,a,b\nx,1,50,8\n", choices);
    });
  };
  for (const auto& [columns, part] : {std::pair{"id=who,time=t,x=a", "x=...,y=..."},
                                      {"id=who,time=t,x=a,y=nothing", "'nothing'"},
                                      {"id=who,time=t,x=a,y=9", "1 to 4"},
                                      {"id=who,wide=t", "wide=t"},
                                      {"id=who,id=t", "'id' once"},
                                      {"id=who,time=t:ft,x=a,y=b", "time=t:ft"},
                                      {"id=who,time=t,x=a,y=b,vx=a", "vx and vy"}})
    EXPECT_NE(error(columns).find(part), std::string::npos) << error(columns);
  EXPECT_NE(error_of([] { read_all(StreamFormat::csv, "who,t,a,b\nx,1,50,8\n"); }).find("--columns"),
            std::string::npos);
}

TEST(CsvFormat, KnowsNoColumnsBeyondItsHeader) {
  // The first line of a stream may be damaged, and longer than its header.
  const std::string text = "who,when,east,north\na,1,5,6,7,8\n";
  EXPECT_EQ(error_of([&] {
              read_all(StreamFormat::csv, text, {.hints = {.columns = "id=1,time=2,x=3,y=6"}, .source = "t"});
            }),
            "--columns: expected 'y' to be a column's name or number from 1 to 4, but got '6': t has the "
            "columns who, when, "
            "east, north");
}

TEST(CsvFormat, RemembersTheOrderOfDayAndMonth) {
  const std::string header = "id,time,x,y\n", later = "a,03/04/2021 12:00:00,1,2\n";
  CollectedReports before = read_all(StreamFormat::csv, header + "a,20/03/2021 12:00:00,1,2\n" + later);
  ASSERT_EQ(before.reports.size(), 2u);
  constexpr double april_3 = 1'617'451'200.0;
  EXPECT_EQ(seconds(before.reports[1].report.stamp), april_3);
  // A run that continues behind the first rows.
  CollectedReports after;
  const auto next = make_format(StreamFormat::csv, {});
  take_state(*before.format, *next);
  next->read({.text = std::string_view(later).substr(0, later.size() - 1), .line = 9}, after);
  ASSERT_EQ(after.reports.size(), 1u);
  EXPECT_EQ(seconds(after.reports[0].report.stamp), april_3);
}

TEST(JsonLinesFormat, ReadsTheLibrarysOwnNames) {
  const CollectedReports kept = read_all(
      StreamFormat::jsonl,
      R"({"id": "d1", "stamp": 12.5, "position": [1, 2, 3], "velocity": [4, 5, 6], "position_error": [3, 1], "velocity_error": 0.5, "stamp_error": 0.1, "arrival": 13})"
      "\n"
      R"({"id": 17, "stamp": "2026-03-01T12:00:00Z", "lat": 50, "lon": 8, "velocity": null})"
      "\n\n"
      R"({"id": "d1", "stamp": 12.5})"
      "\n"
      R"({"id": "d1", "stamp": 12.5, "position": [1, 2], "colour": "red"})"
      "\n"
      R"({"id": "d1", "stamp": 12.5, "position": [1]})"
      "\n"
      R"({"id": "d1", "stamp": true, "position": [1, 2]})"
      "\n"
      R"({"id": "d1", "stamp": 1, "position": [1, 2]} {})"
      "\n"
      R"({"id": "d1", "stamp": 1, "posi)"
      "\n"
      R"({"id": "d1", "stamp": 1, "position": [1, 2], "position_error": -1})");
  ASSERT_EQ(kept.reports.size(), 2u);
  const SourceReport& report = kept.reports[0].report;
  EXPECT_EQ(kept.reports[0].id, "d1");
  expect_near(report.position, {1, 2, 3});
  expect_near(*report.velocity, {4, 5, 6});
  EXPECT_EQ(report.position_error->bound, 3.0);
  EXPECT_EQ(report.height_error->bound, 1.0);
  EXPECT_EQ(report.velocity_error->bound, 0.5);
  EXPECT_FALSE(report.climb_error);
  EXPECT_EQ(report.stamp_error, 0.1);
  EXPECT_EQ(seconds(*report.arrival), 13.0);
  EXPECT_EQ(kept.reports[1].id, "17");
  EXPECT_EQ(kept.reports[1].report.time_kind, TimeKind::utc);
  EXPECT_TRUE(kept.reports[1].report.geographic);
  EXPECT_EQ(kept.passed, (std::vector{Passed::no_position}));
  ASSERT_EQ(kept.refused.size(), 6u);
  EXPECT_NE(kept.refused[0].find("5: expected id, name, stamp"), std::string::npos) << kept.refused[0];
  EXPECT_EQ(kept.refused[1], "6: expected [x, y] or [x, y, z] as \"position\"");
  EXPECT_EQ(kept.refused[2], "7: expected a time as \"stamp\"");
  EXPECT_EQ(kept.refused[3], "8: expected one JSON object in a line, but there is more");
  EXPECT_TRUE(kept.refused[4].starts_with("9: expected JSON")) << kept.refused[4];
  EXPECT_EQ(kept.refused[5], "10: expected a number >= 0 as \"position_error\"");
}

TEST(StreamFormats, AreRecognised) {
  EXPECT_EQ(recognised_format(aircraft), StreamFormat::readsb);
  EXPECT_EQ(recognised_format(R"(  {"aircraft": [], "now": 3})"), StreamFormat::readsb);
  EXPECT_EQ(recognised_format(R"({"time":1458564121,"states":[["a")"), StreamFormat::opensky);
  EXPECT_EQ(recognised_format("MSG,3,1,1,4CA1FA"), StreamFormat::sbs);
  EXPECT_EQ(recognised_format("\xEF\xBB\xBFMMSI,BaseDateTime,LAT,LON\r\n"), StreamFormat::ais);
  EXPECT_EQ(recognised_format("id,time,x,y\n1,2,3,4"), StreamFormat::csv);
  EXPECT_EQ(recognised_format(R"({"id":"a","stamp":1,"position":[0,0]})"), StreamFormat::jsonl);
  EXPECT_EQ(recognised_format(R"({"id":"a","note":{"now":1}})"), std::nullopt);
  EXPECT_EQ(recognised_format(R"([{"hex":"a","lat":1},{"hex":"b"}])"), std::nullopt);
  EXPECT_EQ(recognised_format("{\n\"now\": 1,\n\"aircraft\": []"), StreamFormat::readsb);
  EXPECT_EQ(recognised_format("1,2,3,4"), std::nullopt);
  EXPECT_EQ(recognised_format(""), std::nullopt);
}

/// A program that is asked to stop does not read a long recording to its end.
TEST(RecordingFormat, EndsWhereItIsStopped) {
  std::string text = "3\nTime=0\nA 0 0 0\nB 9 0 0\nC 5 0 0\n";
  for (int time = 1; time < 100; ++time) text += fmt::format("3\nTime={}\nA 0 0 0\nB 9 0 0\nC 5 0 0\n", time);
  const auto reports_until = [&](int rows) {
    FormatChoices choices;
    int asked = 0;
    choices.is_stopped = [&] { return ++asked > rows; };
    return read_all(StreamFormat::recording, text, choices).reports.size();
  };
  EXPECT_EQ(reports_until(1'000'000), 300u);
  EXPECT_LE(reports_until(350), 60u);
  EXPECT_EQ(reports_until(10), 0u);
}

}  // namespace
}  // namespace kinesphere::program::formats_test
