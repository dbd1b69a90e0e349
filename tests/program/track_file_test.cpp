// Recorded tracks: the formats, the columns, the gaps, and every way to get a file wrong.
#include "track_file.hpp"

#include <zlib.h>

#include "input_file.hpp"
#include "support.hpp"

namespace kinesphere::program {
namespace {

using TrackFileTest = FolderTest;

Recording parse(const std::string& text, const TrackOptions& options = {}) {
  return parse_tracks(text, "t.txt", options);
}

std::string error_in(const std::string& text, const TrackOptions& options = {}) {
  return error_of([&] { parse(text, options); });
}

TEST(TrackFile, ReadsObsmat) {
  const Recording recording = parse(
      " 1.0e+00 7.000000e+00 1.5 0 2.5 0.1 0 0.2\n 11.0 7.0 1.75 0 2.75 0.1 0 0.2\n"
      " 1.0 8.0 3 0 4 0 0 0\n 11.0 8.0 3 0 5 0 0 0\n");
  EXPECT_EQ(recording.columns.format, "UCY obsmat");
  EXPECT_FALSE(recording.columns.z);
  ASSERT_EQ(recording.tracks.size(), 2u);
  EXPECT_EQ(recording.tracks[0].id, "7");
  EXPECT_EQ(recording.tracks[0].samples[1].time, 11.0 / 25.0);
  EXPECT_EQ(recording.tracks[0].samples[1].position, (Vec3{1.75, 2.75, 0}));
}

TEST(TrackFile, ReadsPedPy) {
  const Recording recording =
      parse("# framerate: 50 fps\n# id frame x/m y/m z/m\n1\t0\t2\t3\t1.76\n1\t5\t4\t6\t1.76\n");
  EXPECT_EQ(recording.columns.format, "PedPy");
  ASSERT_EQ(recording.tracks.size(), 1u);
  EXPECT_EQ(recording.tracks[0].samples[1].time, 0.1);
  EXPECT_EQ(recording.tracks[0].samples[1].position, (Vec3{4, 6, 0}));
}

TEST(TrackFile, ReadsMosquitoes) {
  const Recording recording = parse(
      "object;oldobject;time;XSplined;YSplined;ZSplined;VXSplined\n1;4;0.18;1;2;3;0\n1;4;0.2;1;2;4;0\n"
      "1;5;0.22;9;9;9;0\n1;5;0.24;9;9;9;0\n");
  EXPECT_EQ(recording.columns.format, "mosquito tracks");
  ASSERT_EQ(recording.tracks.size(), 2u);
  EXPECT_EQ(recording.tracks[1].id, "5");
  EXPECT_EQ(recording.tracks[0].samples[0].time, 0.18);
  EXPECT_EQ(recording.tracks[0].samples[1].position, (Vec3{1, 2, 4}));
}

TEST(TrackFile, ReadsPlainTables) {
  EXPECT_FALSE(parse("id,time,x,y\na,0,1,2\na,1,1,2\n").columns.z);
  EXPECT_TRUE(parse("id,time,x,y,z\na,0,1,2,3\na,1,1,2,3\n").columns.z);
  TrackOptions frames;
  frames.hints.frame_rate = 4.0;
  EXPECT_EQ(parse("id,frame,x,y\na,0,1,2\na,1,1,2\n", frames).tracks[0].samples[1].time, 0.25);
}

TEST(TrackFile, TakesColumnsByNameOrNumber) {
  TrackOptions options;
  options.hints.columns = "id=who,time=2,x=east,y=4,z=up";
  const Recording recording = parse("who;when;east;north;up\nann;1;2;3;4\nann;2;3;4;5\n", options);
  EXPECT_EQ(recording.tracks[0].id, "ann");
  EXPECT_EQ(recording.tracks[0].samples[0].time, 1.0);
  EXPECT_EQ(recording.tracks[0].samples[0].position, (Vec3{2, 3, 4}));
}

TEST(TrackFile, SortsRowsThatAreMixed) {
  const Recording recording = parse("id,time,x,y\na,2,2,0\nb,1,0,0\na,1,1,0\nb,2,0,0\na,3,3,0\n");
  ASSERT_EQ(recording.tracks.size(), 2u);
  ASSERT_EQ(recording.tracks[0].samples.size(), 3u);
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(recording.tracks[0].samples[static_cast<std::size_t>(k)].position.x, k + 1.0);
}

TEST(TrackFile, CutsTracksAtGaps) {
  // The median interval is 1, so 2.5 still holds a track together and 2.6 does not.
  const std::string text =
      "id,time,x,y\na,0,0,0\na,1,0,0\na,3.5,0,0\na,4.5,0,0\nb,0,0,0\nb,1,0,0\nb,3.6,0,0\nb,4.6,0,0\nb,9,0,"
      "0\n";
  const Recording recording = parse(text);
  EXPECT_EQ(recording.sample_interval, 1.0);
  EXPECT_EQ(recording.max_gap, 2.5);
  ASSERT_EQ(recording.tracks.size(), 3u);
  EXPECT_EQ(recording.ids, 2u);
  EXPECT_EQ(recording.tracks[1].id, "b");
  EXPECT_EQ(recording.tracks[2].id, "b");
  EXPECT_EQ(recording.tracks[2].samples.front().time, 3.6);
  EXPECT_EQ(recording.left_out, 1u);
  EXPECT_EQ(recording.samples, 8u);
  TrackOptions options;
  options.max_gap = 5;
  EXPECT_EQ(parse(text, options).tracks.size(), 2u);
}

TEST(TrackFile, NamesTheLineOfAWrongRow) {
  EXPECT_EQ(error_in("id,time,x,y\na,0,1,2\na,soon,1,2\n"),
            "t.txt:3: expected a number as time (column 2), but got 'soon'");
  EXPECT_EQ(error_in("id,time,x,y\na,0,1,2\n\na,1,nan,2\n"),
            "t.txt:4: expected a number as x (column 3), but got 'nan'");
  EXPECT_EQ(error_in("id,time,x,y\na,0,1,2\n,1,1,2\n"),
            "t.txt:3: expected an id (column 1), but got nothing");
  EXPECT_EQ(error_in("id,time,x,y\na,0,1,2\nb,0,1,2\na,1,1,2\na,0,3,4\n"),
            "t.txt:5: expected one sample of id 'a' at time 0, but line 2 has one too");
  EXPECT_EQ(error_in("id,time,x,y\na,0,1,2\na,1,1\n"), "t.txt:3: expected 4 columns, but got 3");
  EXPECT_EQ(error_in("id,time,x,y\na,0,1,2\nb,1,1,2\n"),
            "t.txt: expected an id with two samples at most 0 apart, but there is none");
}

TEST(TrackFile, NamesWhatItDoesNotRecognise) {
  EXPECT_EQ(error_in("i,x,y,z\n0,1,2,3\n"),
            "t.txt: expected a UCY obsmat, PedPy or mosquito file, or columns id, time, x, y, or --columns; "
            "it has the columns i, x, y, z");
  EXPECT_NE(error_in("1 2 3\n").find("it has no header"), std::string::npos);
  EXPECT_EQ(error_in("id,frame,x,y\na,0,1,2\na,1,1,2\n"),
            "t.txt: expected --frame-rate, because column 'frame' counts frames");
}

TEST(TrackFile, NamesWrongHints) {
  const auto with_columns = [](const std::string& columns) {
    TrackOptions options;
    options.hints.columns = columns;
    return error_in("who,when,x,y\na,0,1,2\na,1,1,2\n", options);
  };
  for (const char* wrong : {"id", "id=1,time=2,x=3", "id=1,time=2,x=3,y=4,w=1", "id=1,id=1,time=2,x=3,y=4"}) {
    EXPECT_EQ(with_columns(wrong),
              std::string("--columns: expected id=...,time=...,x=...,y=... and perhaps z=..., "
                          "but got '") +
                  wrong + "'");
  }
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
  EXPECT_EQ(read_tracks(name, {}).tracks.size(), 1u);
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
  const char* format;
  std::size_t ids, tracks, samples;
};

class RealRecording : public ::testing::TestWithParam<Expected> {};

TEST_P(RealRecording, IsReadWhole) {
  const Expected& expected = GetParam();
  const std::string file = recording(expected.name);
  if (file.empty()) GTEST_SKIP() << "no recording " << expected.name << " (see KINESPHERE_DATA)";
  const Recording found = read_tracks(file, {});
  EXPECT_EQ(found.columns.format, expected.format);
  EXPECT_EQ(found.ids, expected.ids);
  EXPECT_EQ(found.tracks.size(), expected.tracks);
  EXPECT_EQ(found.samples, expected.samples);
  EXPECT_EQ(found.left_out, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, RealRecording,
                         ::testing::Values(Expected{"ucy_students03/ucy_students03_obsmat.txt.gz",
                                                    "UCY obsmat", 428, 428, 21846},
                                           Expected{"pedpy_bottleneck/pedpy_bottleneck_040_c_56_h-.txt.gz",
                                                    "PedPy", 75, 75, 63110},
                                           Expected{"mosquito3d/anopheles_swarm_splined.csv.gz",
                                                    "mosquito tracks", 83, 83, 29999}),
                         [](const auto& each) {
                           std::string name = each.param.name;
                           name.resize(name.find('/'));
                           return name;
                         });

}  // namespace
}  // namespace kinesphere::program
