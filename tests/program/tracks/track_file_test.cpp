// Recorded tracks: formats, columns, gaps, and every kind of error in a file.
#include "tracks/track_file.hpp"

#include <zlib.h>

#include <cmath>

#include "base/input_file.hpp"
#include "program/support.hpp"

namespace kinesphere::program::track_file_test {
namespace {

using TrackFileTest = FolderTest;

TrackSet parse(const std::string& text, const TrackOptions& options = {}) {
  return parse_tracks({{"t.txt", text}}, options);
}

std::string error_in(const std::string& text, const TrackOptions& options = {}) {
  return error_of([&] { parse(text, options); });
}

TEST(TrackFile, ReadsObsmat) {
  TrackOptions options;
  options.hints.format = "ucy";
  const TrackSet track_set = parse(
      " 1.0e+00 7.000000e+00 1.5 0 2.5 0.1 0 0.2\n 11.0 7.0 1.75 0 2.75 0.1 0 0.2\n"
      " 1.0 8.0 3 0 4 0 0 0\n 11.0 8.0 3 0 5 0 0 0\n",
      options);
  EXPECT_EQ(track_set.format, "UCY obsmat");
  EXPECT_TRUE(track_set.is_plane);
  ASSERT_EQ(track_set.tracks.size(), 2u);
  EXPECT_EQ(track_set.tracks[0].id, "7");
  EXPECT_EQ(track_set.tracks[0].samples[1].time, 11.0 / 25.0);
  EXPECT_EQ(track_set.tracks[0].samples[1].position, (Vec3{1.75, 2.75, 0}));
}

TEST(TrackFile, ReadsPedPy) {
  const TrackSet track_set =
      parse("# framerate: 50 fps\n# id frame x/m y/m z/m\n1\t0\t2\t3\t1.76\n1\t5\t4\t6\t1.76\n");
  EXPECT_EQ(track_set.format, "PedPy");
  ASSERT_EQ(track_set.tracks.size(), 1u);
  EXPECT_EQ(track_set.tracks[0].samples[1].time, 0.1);
  EXPECT_EQ(track_set.tracks[0].samples[1].position, (Vec3{4, 6, 0}));
}

TEST(TrackFile, ReadsMosquitoes) {
  const TrackSet track_set = parse(
      "object;oldobject;time;XSplined;YSplined;ZSplined;VXSplined\n1;4;0.18;1;2;3;0\n1;4;0.2;1;2;4;0\n"
      "1;5;0.22;9;9;9;0\n1;5;0.24;9;9;9;0\n");
  EXPECT_EQ(track_set.format, "mosquito tracks");
  ASSERT_EQ(track_set.tracks.size(), 2u);
  EXPECT_EQ(track_set.tracks[1].id, "5");
  EXPECT_EQ(track_set.tracks[0].samples[0].time, 0.18);
  EXPECT_EQ(track_set.tracks[0].samples[1].position, (Vec3{1, 2, 4}));
}

TEST(TrackFile, ReadsPlainTables) {
  EXPECT_TRUE(parse("id,time,x,y\na,0,1,2\na,1,1,2\n").is_plane);
  EXPECT_FALSE(parse("id,time,x,y,z\na,0,1,2,3\na,1,1,2,3\n").is_plane);
  TrackOptions frames;
  frames.hints.frame_rate = 4.0;
  EXPECT_EQ(parse("id,frame,x,y\na,0,1,2\na,1,1,2\n", frames).tracks[0].samples[1].time, 0.25);
}

TEST(TrackFile, TakesColumnsByNameOrNumber) {
  TrackOptions options;
  options.hints.columns = "id=who,time=2,x=east,y=4,z=up";
  options.hints.time_unit = "s";
  const TrackSet track_set = parse("who;when;east;north;up\nann;1;2;3;4\nann;2;3;4;5\n", options);
  EXPECT_EQ(track_set.tracks[0].id, "ann");
  EXPECT_EQ(track_set.tracks[0].samples[0].time, 1.0);
  EXPECT_EQ(track_set.tracks[0].samples[0].position, (Vec3{2, 3, 4}));
}

TEST(TrackFile, SortsRowsThatAreMixed) {
  const TrackSet track_set = parse("id,time,x,y\na,2,2,0\nb,1,0,0\na,1,1,0\nb,2,0,0\na,3,3,0\n");
  ASSERT_EQ(track_set.tracks.size(), 2u);
  ASSERT_EQ(track_set.tracks[0].samples.size(), 3u);
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(track_set.tracks[0].samples[static_cast<std::size_t>(k)].position.x, k + 1.0);
}

TEST(TrackFile, CutsTracksAtGaps) {
  // The median interval of b is 1, so 2.5 would still hold a track together and 2.6 does not; a's is 2.
  const std::string text =
      "id,time,x,y\na,0,0,0\na,2,0,0\na,7,0,0\na,9,0,0\nb,0,0,0\nb,1,0,0\nb,3.6,0,0\nb,4.6,0,0\nb,9,0,0\n"
      "c,3,0,0\nc,4,0,0\n";
  const TrackSet track_set = parse(text);
  EXPECT_EQ(track_set.sample_interval, 2.0);
  EXPECT_EQ(track_set.smallest_max_gap, 2.5);
  EXPECT_EQ(track_set.largest_max_gap, 5.0);
  ASSERT_EQ(track_set.tracks.size(), 4u);
  EXPECT_EQ(track_set.presences.size(), 3u);
  EXPECT_EQ(track_set.tracks[1].id, "b");
  EXPECT_EQ(track_set.tracks[2].id, "b");
  EXPECT_EQ(track_set.tracks[2].samples.front().time, 3.6);
  EXPECT_EQ(track_set.left_out, 1u);
  EXPECT_EQ(track_set.samples, 10u);
  EXPECT_EQ(track_set.rows, 11u);
  TrackOptions options;
  options.max_gap = 5;
  EXPECT_EQ(parse(text, options).tracks.size(), 3u);
}

TEST(TrackFile, FewSamplesHaveTheRhythmOfAll) {
  const std::string text = "id,time,x,y\na,0,0,0\na,1,0,0\na,2,0,0\na,3,0,0\nb,0,0,0\nb,86400,0,0\n";
  EXPECT_EQ(parse(text).tracks.size(), 1u);
  EXPECT_EQ(parse(text).left_out, 2u);
}

TEST(TrackFile, NamesTheLineOfAWrongRow) {
  EXPECT_EQ(error_in("id,time,x,y\na,0,1,2\na,soon,1,2\n"),
            "t.txt:3: expected a number as time (column 2), but got 'soon'");
  EXPECT_EQ(error_in("id,time,x,y\na,0,1,2\n\na,1,nan,2\n"),
            "t.txt:4: expected a number as x (column 3), but got 'nan' (see --missing)");
  EXPECT_EQ(
      error_in("id,time,x,y\na,0,1,2\n,1,1,2\n"),
      "t.txt:3: expected an id (column 1), but got nothing (--where 'id != \"\"' leaves such rows out)");
  EXPECT_EQ(error_in("id,time,x,y\na,0,1,2\nb,0,1,2\na,1,1,2\na,0,3,4\n"),
            "t.txt:5: expected one sample of id 'a' at each time, but t.txt:2 has the same time (see "
            "--duplicates)");
  EXPECT_EQ(error_in("id,time,x,y\na,0,1,2\na,1,1\n"), "t.txt:3: expected 4 columns, but got 3");
  EXPECT_EQ(error_in("id,time,x,y\na,0,1,2\nb,1,1,2\n"),
            "t.txt: expected an id with two samples at most 0 s apart, but there is none: see --max-gap, "
            "and --plan where rows are waypoints");
  EXPECT_EQ(error_in("id,time,x,y\na,7,1,2\nb,7,1,2\n"),
            "t.txt: expected samples at two times or more, but all are at 7");
}

TEST(TrackFile, NamesWhatItDoesNotRecognise) {
  EXPECT_EQ(
      error_in("i,x,y,z\n0,1,2,3\n"),
      "t.txt: expected columns for id, time, x and y (or lon and lat) by their usual names, --columns or "
      "--format; it has the columns i, x, y, z: say --columns id=...,time=...,x=x,y=y,z=z, with id=@file "
      "where each "
      "file is one body");
  EXPECT_NE(error_in("1 2 3\n").find("it has no header and 3 columns"), std::string::npos);
  EXPECT_EQ(error_in("id,mmsi,t,x,y\n1,2,1,2,3\n"),
            "t.txt: columns 'id' and 'mmsi' may both be meant: say which, as in --columns "
            "id=mmsi,time=t,x=x,y=y");
  EXPECT_EQ(error_in("id,t,x,y,lon,lat\n0,0,1,2,3,4\n"),
            "t.txt: columns 'x' and 'lon' may both be meant: say which, as in --columns "
            "id=id,time=t,lon=lon,lat=lat");
  EXPECT_EQ(error_in("id,t,x,x,y\n0,0,1,2,3\n"),
            "t.txt: columns 'x' and 'x' may both be meant: say which, as in --columns id=id,time=t,x=4,y=y");
}

TEST(TrackFile, AsksForWhatIsNotCertain) {
  for (const char* frame : {"frame", "Frame", "FRAME", "frame_id", "Frame Number"}) {
    EXPECT_EQ(error_in(std::string("id,") + frame + ",x,y\na,0,1,2\na,1,1,2\n"),
              std::string("t.txt: expected --frame-rate, because column '") + frame + "' counts frames");
  }
  TrackOptions numbered;
  numbered.hints.columns = "id=1,time=2,x=3,y=4";
  for (const char* text : {"a 0 1 2\na 1 1 2\n", "who,when,x,y\na,0,1,2\na,1,1,2\n"}) {
    EXPECT_EQ(
        error_in(text, numbered),
        "t.txt: expected --time-unit or --frame-rate, because column 2 does not say whether its numbers "
        "are seconds");
  }
  const std::string obsmat = "0 7 1 0 2 0 0 0\n6 7 1 0 2 0 0 0\n12 7 1 0 2 0 0 0\n";
  EXPECT_EQ(
      error_in(obsmat),
      "t.txt: it looks like an obsmat, which does not say its frame rate: expected --format ucy, --format "
      "eth or --frame-rate");
  EXPECT_EQ(
      error_in("id,t,x,y\na,1700000000000,0,0\na,1700000001000,0,0\n"),
      "t.txt:2: expected seconds as time (column 2), but got '1700000000000': say --time-unit ms, us or "
      "ns, or s if these are seconds");
}

TEST(TrackFile, TakesWhatIsSaid) {
  const std::string obsmat = "0 7 1 0 2 0 0 0\n6 7 1 0 2 0 0 0\n12 7 1 0 2 0 0 0\n";
  TrackOptions options;
  options.hints.format = "eth";
  EXPECT_EQ(parse(obsmat, options).tracks[0].samples[2].time, 12.0 / 15.0);
  options.hints.format = "ucy";
  EXPECT_EQ(
      error_in(obsmat, options),
      "t.txt: expected every tenth frame with --format ucy, but got frame numbers 6 apart: say --frame-rate");
  options.hints.frame_rate = 30;
  EXPECT_EQ(parse(obsmat, options).tracks[0].samples[2].time, 12.0 / 30.0);
  options.hints = {};
  options.hints.frame_rate = 24;
  EXPECT_EQ(parse(obsmat, options).tracks[0].samples[2].time, 0.5);

  options.hints = {};
  const std::string times = "ID;T;X;Y\na;1000;0;0\na;3000;0;0\n";
  const auto last_time = [&](const char* unit) {
    options.hints.time_unit = unit;
    return parse(times, options).tracks[0].samples[1].time;
  };
  EXPECT_EQ(last_time(""), 3000.0);
  EXPECT_EQ(last_time("s"), 3000.0);
  EXPECT_EQ(last_time("ms"), 3.0);
  EXPECT_EQ(last_time("us"), 0.003);
  EXPECT_EQ(last_time("min"), 180000.0);
  options.hints.time_unit = "frames";
  EXPECT_EQ(error_in(times, options), "t.txt: expected --frame-rate with --time-unit frames");
  options.hints.time_unit = "fortnight";
  EXPECT_EQ(error_in(times, options),
            "--time-unit: expected s, ms, us, ns, min, h, d, frames or clock, but got 'fortnight'");
  options.hints.time_unit = "";
  EXPECT_EQ(parse("id,time_ms,x_cm,y_cm\na,0,0,0\na,500,100,0\n").tracks[0].samples[1].time, 0.5);
  EXPECT_EQ(parse("id,time_ms,x_cm,y_cm\na,0,0,0\na,500,100,0\n").tracks[0].samples[1].position.x, 1.0);
  options.hints.unit = "nmi";
  EXPECT_EQ(parse("id,t,x,y\na,0,0,0\na,1,2,0\n", options).tracks[0].samples[1].position.x, 3704.0);
}

TEST(TrackFile, KnowsTheUsualNames) {
  for (const char* header : {"id,time,x,y", "MMSI,BaseDateTime,X,Y", "Track_ID,timestamp,easting,northing",
                             "agent,t,pos_x,pos_y", "\"Ped ID\",\"Date Time\",\"x [m]\",\"y [m]\"",
                             "object,time(s),x/m,y/m", "Agent-Id,TIME,East,North"}) {
    SCOPED_TRACE(header);
    EXPECT_EQ(parse(std::string(header) + "\n1,0,1,2\n1,1,3,2\n").tracks[0].samples[1].position.x, 3.0);
  }
}

TEST(TrackFile, ReadsDates) {
  const TrackSet track_set = parse(
      "id,t,x,y\na,2024-02-28T23:59:59.5Z,0,0\na,\"2024-02-29 01:00:00,25+01:00\",1,0\n"
      "a,20240229T000001Z,2,0\n");
  ASSERT_EQ(track_set.tracks[0].samples.size(), 3u);
  const auto& samples = track_set.tracks[0].samples;
  EXPECT_EQ(samples[1].time - samples[0].time, 0.75);
  EXPECT_EQ(samples[2].time - samples[0].time, 1.5);
  EXPECT_EQ(track_set.times.text(samples[0].time), "2024-02-28T23:59:59.5Z");
  EXPECT_EQ(error_in("id,t,x,y\na,2024-02-28T00:00:00Z,0,0\na,2024-02-28T00:00:00,0,0\n"),
            "t.txt:3: expected a date with a zone as time (column 2), but got '2024-02-28T00:00:00', unlike "
            "t.txt:2");
  EXPECT_EQ(error_in("id,t,x,y\na,2024-02-28T00:00:00Z,0,0\na,17,0,0\n"),
            "t.txt:3: expected a date with a zone as time (column 2), but got '17', unlike t.txt:2");
  EXPECT_EQ(error_in("id,t,x,y\na,08/02/2024 00:00,0,0\n"),
            "t.txt:2: expected a date whose order of day and month is known (column 2), but got '08/02/2024 "
            "00:00': "
            "say --dates day-first or --dates month-first");
}

TEST(TrackFile, LargeOffsetsLoseNothing) {
  TrackOptions options;
  const auto check = [&](const char* text, std::string_view last) {
    SCOPED_TRACE(text);
    const TrackSet track_set = parse(text, options);
    const auto& samples = track_set.tracks[0].samples;
    EXPECT_EQ(samples[1].time - samples[0].time, 0.125);
    EXPECT_LT(std::abs(samples[1].time), 64.0);
    EXPECT_EQ(samples[1].position - samples[0].position, (Vec3{0.125, 0.25, 0}));
    EXPECT_LT(norm(samples[1].position), 64.0);
    EXPECT_EQ(track_set.times.text(samples[1].time), last);
    EXPECT_EQ(track_set.coordinates.as_in_file(samples[1].position), (Vec3{500000.125, -5000000.25, 0}));
  };
  check("id,t,x,y\na,1700000000.123,500000,-5000000.5\na,1700000000.248,500000.125,-5000000.25\n",
        "1700000000.248");
  options.hints.time_unit = "ms";
  check("id,t,x,y\na,1700000000123,500000,-5000000.5\na,1700000000248,500000.125,-5000000.25\n",
        "1700000000248");
  options.hints.time_unit = "ns";
  check("id,t,x,y\na,1700000000123000000,500000,-5000000.5\na,1700000000248000000,500000.125,-5000000.25\n",
        "1700000000248000000");
}

TEST(TrackFile, MissingValuesByPolicy) {
  const std::string text =
      "id,t,x,y\na,0,0,0\na,1,NaN,0\na,2,1,0\na,3,,0\na,4,2,\na,5,3,0\na,null,3,0\na,6,4,0\nb,1,N/A,0\n";
  EXPECT_EQ(error_in(text), "t.txt:3: expected a number as x (column 3), but got 'NaN' (see --missing)");
  EXPECT_EQ(error_in("id,t,x,y\na,,0,0\n"),
            "t.txt:2: expected a number as time (column 2), but got nothing (see --missing)");
  TrackOptions options;
  options.max_gap = 10;
  options.missing = MissingPolicy::skip;
  const TrackSet skipped = parse(text, options);
  ASSERT_EQ(skipped.tracks.size(), 1u);
  EXPECT_EQ(skipped.samples, 4u);
  EXPECT_EQ(skipped.missing.count, 5u);
  EXPECT_EQ(skipped.missing.first_places, (std::vector<std::string>{"line 3", "line 5", "line 6"}));
  options.missing = MissingPolicy::split;
  const TrackSet split = parse(text, options);
  ASSERT_EQ(split.tracks.size(), 1u);
  EXPECT_EQ(split.left_out, 2u);
  EXPECT_EQ(split.tracks[0].samples.front().time, 5.0);
  EXPECT_EQ(parse("id,t,x,y\na,0,0,0\na,1,inf,0\na,2,0,0\na,3,0,0\n", options).missing.count, 1u);
}

TEST(TrackFile, DuplicatesByPolicy) {
  const std::string text = "id,t,x,y\na,0,0,0\na,1,2,0\na,1.0,4,0\na,1,6,3\na,2,8,0\n";
  TrackOptions options;
  options.duplicates = DuplicatePolicy::first;
  const TrackSet first = parse(text, options);
  EXPECT_EQ(first.tracks[0].samples[1].position, (Vec3{2, 0, 0}));
  EXPECT_EQ(first.duplicates.count, 2u);
  EXPECT_EQ(first.duplicates.first_places, (std::vector<std::string>{"line 4", "line 5"}));
  options.duplicates = DuplicatePolicy::mean;
  EXPECT_EQ(parse(text, options).tracks[0].samples[1].position, (Vec3{4, 1, 0}));
}

TEST(TrackFile, LeavesOutWhatIsTooFast) {
  TrackOptions options;
  options.max_speed = 2;
  options.max_gap = 10;
  const TrackSet outlier = parse("id,t,x,y\na,0,0,0\na,1,1,0\na,2,900,0\na,3,3,0\na,4,4,0\n", options);
  ASSERT_EQ(outlier.tracks.size(), 1u);
  EXPECT_EQ(outlier.samples, 4u);
  EXPECT_EQ(outlier.too_fast.first_places, (std::vector<std::string>{"line 4"}));
  // The first sample may be the wrong one.
  EXPECT_EQ(parse("id,t,x,y\na,0,900,0\na,1,1,0\na,2,2,0\na,3,3,0\n", options).too_fast.first_places,
            (std::vector<std::string>{"line 2"}));
  // A lasting jump ends one track and begins another.
  EXPECT_EQ(parse("id,t,x,y\na,0,0,0\na,1,1,0\na,2,900,0\na,3,901,0\n", options).tracks.size(), 2u);
  // Two ships under one id: the one with more reports is kept.
  const TrackSet two =
      parse("id,t,x,y\na,0,0,0\na,0.5,900,0\na,1,1,0\na,1.5,901,0\na,2,2,0\na,2.5,902,0\na,3,3,0\n", options);
  ASSERT_EQ(two.tracks.size(), 1u);
  EXPECT_EQ(two.tracks[0].samples.back().position.x, 3.0);
  EXPECT_EQ(two.too_fast.count, 3u);
}

TEST(TrackFile, JoinsFiles) {
  const auto parse_both = [](std::string a, std::string b, const TrackOptions& options = {}) {
    return parse_tracks({{"a.csv", std::move(a)}, {"b.csv", std::move(b)}}, options);
  };
  const std::string first = "id,t,x,y\nann,0,0,0\nann,1,1,0\n";
  // The order of columns and the separator may differ.
  const TrackSet both = parse_both(first, "y;x;t;id\n0;2;2;ann\n0;3;3;ann\n");
  ASSERT_EQ(both.tracks.size(), 1u);
  EXPECT_EQ(both.tracks[0].samples.size(), 4u);
  EXPECT_EQ(error_of([&] { parse_both(first, "id,t,x,y\nann,1,1,0\n"); }),
            "b.csv:2: expected one sample of id 'ann' at each time, but a.csv:3 has the same time (see "
            "--duplicates)");
  EXPECT_EQ(error_of([&] { parse_both(first, "id,t,x,y,z\nann,2,1,0,0\n"); }),
            "b.csv: expected the same number of dimensions as in a.csv");
  EXPECT_EQ(error_of([&] { parse_both(first, "id,time_ms,x,y\nann,2,1,0\n"); }),
            "b.csv: expected times of the same unit as in a.csv");
  TrackOptions options;
  options.duplicates = DuplicatePolicy::first;
  EXPECT_EQ(parse_both(first, "id,t,x,y\nann,1,1,0\n", options).duplicates.first_places,
            std::vector<std::string>{"b.csv:2"});
}

TEST(TrackFile, NamesWrongHints) {
  const auto with_columns = [](const std::string& columns) {
    TrackOptions options;
    options.hints.columns = columns;
    options.hints.time_unit = "s";
    return error_in("who,when,x,y\na,0,1,2\na,1,1,2\n", options);
  };
  EXPECT_EQ(
      with_columns("id=1,time=2,x=3"),
      "--columns: expected id=... (or id=@file), time=... (or frame=...), x=...,y=... (or lon=...,lat=...) "
      "and perhaps z=..., but got 'id=1,time=2,x=3'");
  for (const char* wrong : {"id", "w=1"})
    EXPECT_TRUE(
        with_columns(wrong).starts_with("--columns: expected KEY=COLUMN with one of the keys id, time, "));
  EXPECT_EQ(with_columns("id=1,id=1,time=2,x=3,y=4"), "--columns: expected 'id' once");
  EXPECT_EQ(
      with_columns("id=who,time=5,x=3,y=4"),
      "--columns: expected 'time' to be a column's name or number from 1 to 4, but got '5': t.txt has the "
      "columns who, when, x, y");
  TrackOptions options;
  options.hints.frame_rate = 0.0;
  EXPECT_EQ(error_in("id,frame,x,y\na,0,1,2\na,1,1,2\n", options),
            "--frame-rate: expected a number > 0, but got 0");
}

TEST_F(TrackFileTest, ReadsGzip) {
  const std::string text = "id,time,x,y\na,0,1,2\na,1,1,2\n";
  const std::string name = path("t.csv.gz");
  const gzFile file = gzopen(name.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  EXPECT_EQ(read_input(name), text);
  EXPECT_EQ(read_tracks({name}, {}).tracks.size(), 1u);
  const std::string half = write("half.gz", read_text(name).substr(0, 25));
  const std::string message = error_of([&] { read_input(half); });
  EXPECT_TRUE(message.starts_with(half + ": cannot read: damaged gzip data")) << message;
}

TEST_F(TrackFileTest, NamesFilesThatCannotBeRead) {
  EXPECT_EQ(error_of([&] { read_input(path("none")); }),
            path("none") + ": cannot read: No such file or directory");
  EXPECT_EQ(error_of([&] { read_input(path("")); }),
            path("") + ": cannot read: expected a file, but it is a folder");
}

struct Expected {
  const char* name;
  const char* hint;
  const char* format;
  std::size_t ids, tracks, samples;
};

class RealRecording : public ::testing::TestWithParam<Expected> {};

TEST_P(RealRecording, IsReadWhole) {
  const Expected& expected = GetParam();
  const std::string file = recorded_file(expected.name);
  if (file.empty()) GTEST_SKIP() << "no recording " << expected.name << " (see KINESPHERE_DATA)";
  TrackOptions options;
  options.hints.format = expected.hint;
  const TrackSet found = read_tracks({file}, options);
  EXPECT_EQ(found.format, expected.format);
  EXPECT_EQ(found.presences.size(), expected.ids);
  EXPECT_EQ(found.tracks.size(), expected.tracks);
  EXPECT_EQ(found.samples, expected.samples);
  EXPECT_EQ(found.left_out, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, RealRecording,
                         ::testing::Values(Expected{"ucy_students03/ucy_students03_obsmat.txt.gz", "ucy",
                                                    "UCY obsmat", 428, 428, 21846},
                                           Expected{"pedpy_bottleneck/pedpy_bottleneck_040_c_56_h-.txt.gz",
                                                    "", "PedPy", 75, 75, 63110},
                                           Expected{"mosquito3d/anopheles_swarm_splined.csv.gz", "",
                                                    "mosquito tracks", 83, 83, 29999}),
                         [](const auto& each) {
                           std::string name = each.param.name;
                           name.resize(name.find('/'));
                           return name;
                         });

}  // namespace
}  // namespace kinesphere::program::track_file_test
