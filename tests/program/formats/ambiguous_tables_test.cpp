// Tables whose numbers would be something else if they were read as they look.
#include <fmt/format.h>

#include "formats/recordings/file_kind.hpp"
#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::ambiguous_tables_test {
namespace {

TrackSet parse(const std::vector<NamedText>& texts, const TrackOptions& options = {}) {
  return parse_tracks(texts, options);
}
std::string error_in(const std::string& text, const TrackOptions& options = {}) {
  return error_of([&] { parse({{"f", text}}, options); });
}
TrackOptions with_columns(const std::string& columns) {
  TrackOptions options;
  options.hints.columns = columns;
  return options;
}
TrackOptions clocks() {
  TrackOptions options;
  options.hints.time_unit = "clock";
  return options;
}

/// Returns the times of a track as the file tells them.
std::vector<std::string> times_of(const TrackSet& track_set, const std::string& id) {
  std::vector<std::string> times;
  for (const RecordedTrack& track : track_set.tracks)
    if (track.id == id)
      for (const TrackSample& sample : track.samples) times.push_back(track_set.times.text(sample.time));
  return times;
}
using Times = std::vector<std::string>;

TEST(AmbiguousTables, ListsOfNamedBodiesAreNoColumnsOfBodies) {
  // The two change their places in the list.
  const std::string frames = R"({"t":0,"objects":[{"id":"a","x":0,"y":0},{"id":"b","x":9,"y":0}]})"
                             "\n"
                             R"({"t":1,"objects":[{"id":"b","x":8,"y":0},{"id":"a","x":1,"y":0}]})"
                             "\n";
  const std::string error = error_in(frames);
  EXPECT_TRUE(error.starts_with("f: 'objects.0.id' may name another body in each row than 'objects.0.x'"))
      << error;
  EXPECT_NE(error.find("jq -c '(arrays[], objects) | . + .objects[] | del(.objects)'"), std::string::npos);
  EXPECT_NE(error_in("t,id1,x1,y1,id2,x2,y2\n0,a,0,0,b,9,0\n1,b,8,0,a,1,0\n").find("'id1' may name"),
            std::string::npos);
  EXPECT_NE(error_in("t,name_1,x_1,y_1,name_2,x_2,y_2\n0,a,0,0,b,9,0\n").find("'name_1' may name"),
            std::string::npos);
  TrackOptions same;
  same.hints.format = "table";
  EXPECT_EQ(parse({{"f", "t,id1,x1,y1,id2,x2,y2\n0,a,0,0,b,9,0\n1,a,1,0,b,8,0\n"}}, same).tracks.size(), 2u);
  // Without names the place in the list is all that there is.
  const std::string places = R"({"t":0,"at":[{"x":0,"y":0},{"x":9,"y":0}]})"
                             "\n"
                             R"({"t":1,"at":[{"x":1,"y":0},{"x":8,"y":0}]})"
                             "\n";
  EXPECT_EQ(parse({{"f", places}}).tracks[1].id, "at.1");
}

TEST(AmbiguousTables, AnotherHeaderInTheMiddleIsNoRow) {
  const std::string first = "id,time,x,y\na,0,0,5\na,1,1,5\n";
  EXPECT_EQ(error_in(first + "id,time,y,x\na,2,5,2\n"),
            "f: line 4 is another header, whose columns are not in the places of the first: what follows it "
            "has to be "
            "read by itself");
  EXPECT_EQ(parse({{"f", first + "id,time,x,y\na,2,2,5\n"}}).samples, 3u);
}

TEST(AmbiguousTables, WideTablesOfGames) {
  const std::string wide =
      "period_id,timestamp,frame_id,ball_x,ball_y,home_1_x,home_1_y,home_1_d,away_2_x,away_2_y\n"
      "1,0.00,0,50,50,0,0,,9,1\n1,0.04,1,50,50,1,0,,8,1\n";
  EXPECT_NE(error_in(wide).find("--format table if each such pair is a body"), std::string::npos)
      << error_in(wide);
  TrackOptions bodies;
  bodies.hints.format = "table";
  EXPECT_EQ(parse({{"f", wide}}, bodies).tracks.size(), 3u);
  // The clock begins again.
  EXPECT_NE(error_in(wide + "2,0.00,2,50,50,0,0,,9,1\n2,0.04,3,50,50,1,0,,8,1\n", bodies)
                .find("--where 'period_id = 1'"),
            std::string::npos);
}

TEST(AmbiguousTables, SecondsBesideMinutesAreAskedAbout) {
  for (const char* header : {"id,hours,minutes,seconds,x,y", "id,hr,min,sec,x,y", "id,hour,minute,secs,x,y"})
    EXPECT_NE(
        error_in(std::string(header) + "\na,1,2,3,0,0\na,1,2,4,0,0\n").find("may be a part of the time"),
        std::string::npos)
        << header;
  EXPECT_EQ(parse({{"f", "id,minutes_left,seconds,x,y\na,1,2,0,0\na,1,3,0,0\n"}}).samples, 2u);
}

TEST(AmbiguousTables, NanosecondsBelongToTheirSeconds) {
  for (const char* header : {"id,sec,nanosec,x,y", "id,header.stamp.secs,header.stamp.nsecs,x,y",
                             "id,sim_time_sec,sim_time_nsec,x,y", "id,stamp_sec,stamp_nanosec,x,y",
                             "id,stamp.seconds,stamp.nanoseconds,x,y"}) {
    const TrackSet read =
        parse({{"f", std::string(header) + "\na,7,999999999,0,0\na,9,5,1,0\na,10,0,2,0\n"}});
    EXPECT_EQ(times_of(read, "a"), (Times{"7.999999999", "9.000000005", "10"})) << header;
    EXPECT_TRUE(read.unused.empty()) << header;
  }
  const std::string rows = "id,sec,nanosec,x,y\na,7,5,0,0\na,8,5,1,0\n";
  EXPECT_EQ(times_of(parse({{"f", rows}}, with_columns("id=id,time=sec,x=x,y=y")), "a"),
            (Times{"7.000000005", "8.000000005"}));
  EXPECT_EQ(times_of(parse({{"f", rows}}, with_columns("id=id,time=sec:s,x=x,y=y")), "a"), (Times{"7", "8"}));
  EXPECT_EQ(error_in("id,sec,nanosec,x,y\na,7.5,5,0,0\n"),
            "f:2: expected whole seconds beside nanoseconds (column 2), but got '7.5'");
  EXPECT_EQ(error_in("id,sec,nanosec,x,y\na,7,1000000000,0,0\n"),
            "f:2: expected nanoseconds from 0 to 999999999 (column 3), but got '1000000000'");
  EXPECT_EQ(error_in("id,sec,nanosec,x,y\na,7,,0,0\n"),
            "f:2: expected a number as time (column 2), but got '7' (see --missing)");
  EXPECT_NE(error_in("id,gps_week,seconds,x,y\na,1,2,0,0\n").find("'gps_week' may be a part"),
            std::string::npos);
}

TEST(AmbiguousTables, ThousandsAreNoDecimals) {
  // 1.234 among decimal commas, and 1,234 among decimal points, whichever comes first.
  for (const char* rows : {"a;0;1.234;0,5\n", "a;0;0,5;1.234\n", "a;0;12,5;0\na;1;-123.456;0\n",
                           "a;0;1,234;0.5\n", "a;0;0.5;1,234\n", "a;0;1.234;5,678\n"}) {
    const std::string error = error_in(std::string("id;time;x;y\n") + rows);
    EXPECT_NE(error.find("leave out what separates thousands"), std::string::npos) << rows << error;
  }
  // These are decimals: a number with a leading 0, with other than three of them, and all with one sign.
  for (const char* rows :
       {"a;0;0.123;0,5\na;1;0;0\n", "a;0;1.25;0,5\na;1;0;0\n", "a;0;1234.567;0,5\na;1;0;0\n",
        "a;0;1,234;5,678\na;1;0;0,25\n", "a;0;1.234;5.678\na;1;0;0.25\n"})
    EXPECT_NO_THROW(parse({{"f", std::string("id;time;x;y\n") + rows}})) << rows;
  EXPECT_EQ(error_in("id,time,x,y\na,0,\"1,234\",0\n"),
            "f:2: expected a number as x (column 3), but got '1,234': leave out what separates thousands, or "
            "make a "
            "decimal comma a point");
}

TEST(AmbiguousTables, ClocksGoOnBehindMidnight) {
  // In the order of the times, with a row that is late.
  const std::string log =
      "id,time,x,y\na,23:59:58,0,0\nb,23:59:58.5,9,0\na,00:00:00,1,0\nb,23:59:59.5,8,0\na,00:00:02,2,0\n"
      "b,00:00:00.5,7,0\nc,00:00:01,5,5\nc,00:00:02,5,6\n";
  const TrackSet read = parse({{"f", log}}, clocks());
  EXPECT_EQ(times_of(read, "a"), (Times{"86398", "86400", "86402"}));
  EXPECT_EQ(times_of(read, "b"), (Times{"86398.5", "86399.5", "86400.5"}));
  EXPECT_EQ(times_of(read, "c"), (Times{"86401", "86402"}));
  EXPECT_TRUE(read.warnings.empty());
  // The rows of each body together, each over midnight.
  const std::string bodies =
      "id,time,x,y\na,20:00:00,0,0\na,02:00:00,1,0\na,08:00:00,1,0\nb,20:00:00,9,0\nb,02:00:00,8,0\n";
  const TrackSet each = parse({{"f", bodies}}, clocks());
  EXPECT_EQ(times_of(each, "a"), (Times{"72000", "93600", "115200"}));
  EXPECT_EQ(times_of(each, "b"), (Times{"72000", "93600"}));
  // A pause of most of the day.
  const std::string pause = "id,time,x,y\na,00:00:00,0,0\na,00:10:00,1,0\na,23:50:00,1,0\na,23:59:00,1,0\n";
  TrackOptions whole = clocks();
  whole.max_gap = 1e6;
  EXPECT_EQ(times_of(parse({{"f", pause}}, whole), "a"), (Times{"0", "600", "85800", "86340"}));
  // The same day for all, though the second body begins half a day before the end of the first.
  const std::string day = "id,time,x,y\na,08:00:00,0,0\na,21:00:00,1,0\nb,08:00:00,9,0\nb,21:00:00,8,0\n";
  EXPECT_EQ(times_of(parse({{"f", day}}, clocks()), "b"), (Times{"28800", "75600"}));
}

TEST(AmbiguousTables, ClocksOfAnUnclearDayAreRefused) {
  EXPECT_EQ(
      error_in("id,time,x,y\na,23:59:59,0,0\na,00:00:01,1,0\nb,00:00:00,9,0\nb,00:00:01,8,0\n", clocks()),
      "f:4: the clock passes midnight in this file, and this row may be of either day: write dates before "
      "the "
      "times");
  // A row from before midnight behind the first of the day, or the newest rows first.
  EXPECT_TRUE(error_in("id,time,x,y\na,00:00:01,0,0\na,23:59:59,1,0\na,00:00:02,1,0\n", clocks())
                  .starts_with("f:3: the clock passes midnight in this file"));
  // Two of one scene, and then two of another, which may be at the same time.
  const std::string scenes =
      "id,time,x,y\na,08:00:00,0,0\nb,08:00:00,0,0\na,21:00:00,1,0\nb,21:00:00,1,0\nc,08:00:00,9,0\n"
      "d,08:00:00,8,0\nc,21:00:00,9,0\nd,21:00:00,8,0\n";
  EXPECT_TRUE(error_in(scenes, clocks()).starts_with("f:6: the clock passes midnight in this file"));
  const NamedText night{"night", "id,time,x,y\na,23:59:59,0,0\na,00:00:01,1,0\n"};
  const NamedText morning{"morning", "id,time,x,y\nb,00:00:00,9,0\nb,00:00:01,8,0\n"};
  EXPECT_EQ(
      error_of([&] {
        parse({night, morning}, clocks());
      }),
      "morning: the clock passes midnight in another file, so that the day of this file is unclear: write "
      "dates before the times");
  EXPECT_EQ(
      error_of([&] {
        parse({morning, night}, clocks());
      }),
      "night: the clock passes midnight in this file alone, so that the day of this file is unclear: write "
      "dates before the times");
}

TEST(AmbiguousTables, MissingNumbersOfOtherPrograms) {
  TrackOptions skip;
  skip.missing = MissingPolicy::skip;
  for (const char* none : {".", "1.#QNAN0", "-1.#IND00", "1.#INF", "\xE2\x80\x94"})
    EXPECT_EQ(
        parse({{"f", fmt::format("id,time,x,y\na,0,0,0\na,1,{},0\na,2,1,0\n", none)}}, skip).missing.count,
        1u)
        << none;
  // Python and JavaScript write these, although JSON has none of them.
  for (const char* none : {"NaN", "Infinity", "-Infinity"}) {
    const std::string rows = fmt::format(
        "{{\"id\":\"NaN \\\"Infinity\",\"time\":0,\"x\":0,\"y\":0}}\n"
        "{{\"id\":\"NaN \\\"Infinity\",\"time\":1,\"x\":{0},\"y\":[{0}]}}\n"
        "{{\"id\":\"NaN \\\"Infinity\",\"time\":2,\"x\":0,\"y\":0}}\n",
        none);
    const TrackSet read = parse({{"f", rows}}, skip);
    EXPECT_EQ(read.missing.count, 1u) << none;
    EXPECT_EQ(read.tracks[0].id, "NaN \"Infinity");
  }
}

TEST(AmbiguousTables, AnglesOfLoggers) {
  const std::string fit =
      "id,timestamp,position_lat,position_long\na,0,560740871,95443718\na,1,560740871,95443718\n";
  EXPECT_NE(error_in(fit).find(":semicircles if it is of FIT"), std::string::npos) << error_in(fit);
  const TrackSet read =
      parse({{"f", fit}},
            with_columns("id=id,time=timestamp,lon=position_long:semicircles,lat=position_lat:semicircles"));
  const Vec3 place = read.coordinates.as_in_file(read.tracks[0].samples[0].position);
  EXPECT_NEAR(place.x, 95443718.0, 1.0);
  EXPECT_NE(error_in("id,time,lat,lon\na,0,4730.25,800.5\n").find("47 30.25 for 4730.25"), std::string::npos);
}

TEST(AmbiguousTables, FilesThatAreNoTables) {
  EXPECT_NE(other_file_kind("\x1F\x8B\x08").find("gzip twice"), std::string::npos);
  EXPECT_NE(other_file_kind("version https://git-lfs.github.com/spec/v1\n").find("git lfs pull"),
            std::string::npos);
  EXPECT_NE(error_in("[{\"id\":\"document\",\"version\":\"1.0\"},{\"id\":\"a\"}]").find("CZML"),
            std::string::npos);
  EXPECT_NE(error_in("{'id': 'a', 'time': 0}\n").find("json.dumps"), std::string::npos);
  for (const char* before : {"data: ", "robots/a/pose ", "\x1E"})
    EXPECT_NE(
        error_in(std::string(before) + "{\"id\":\"a\",\"time\":0,\"x\":0}\n").find("JSON behind other text"),
        std::string::npos);
  EXPECT_NE(error_in("$node_(0) set X_ 5.0\n").find("ns-2"), std::string::npos);
  EXPECT_NE(
      error_in("id,time,geometry\na,0,POINT (8.5 47.25)\n").find("both coordinates of column 'geometry'"),
      std::string::npos);
  EXPECT_EQ(error_in("id;time;a;b\na;0;47,25;8,5\n").find("both coordinates"), std::string::npos);
  EXPECT_NE(error_in("X1\tY1\tX2\tY2\n0\t0\t1\t1\n").find("NR-2\"\\t\"$0}' numbers them"), std::string::npos);
  EXPECT_NE(error_in("@0000016CE3671C8D4CA1FA58C901375147EFD09357;\n").find("Mode S"), std::string::npos);
  const std::string bodies =
      R"({"a":[{"x":0},{"x":1},{"x":2},{"x":3}],"b":[{"x":0},{"x":1},{"x":2},{"x":3}]})";
  EXPECT_NE(error_in(bodies).find("jq -c 'to_entries[] | {id: .key} + .value[]'"), std::string::npos);
}

}  // namespace
}  // namespace kinesphere::program::ambiguous_tables_test
