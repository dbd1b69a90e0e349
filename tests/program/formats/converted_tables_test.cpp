// Files of other formats that tracks reads: GPX, XYZ, dumps of LAMMPS.
#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::converted_tables_test {
namespace {

Recording parse(const std::string& text, const TrackOptions& options = {}) {
  return parse_tracks({{"f", text}}, options);
}
std::string error_in(const std::string& text, const TrackOptions& options = {}) {
  return error_of([&] { parse(text, options); });
}

TrackOptions frames(double rate) {
  TrackOptions options;
  options.hints.frame_rate = rate;
  return options;
}

const std::string point_a =
    R"(<trkpt lat="47.0" lon="8.0"><ele>10</ele><time>2024-01-01T00:00:00Z</time></trkpt>)";
const std::string point_b = R"(<trkpt lon="8.0001" lat="47.0"><time>2024-01-01T00:00:10Z</time></trkpt>)";

TEST(ConvertedTables, ReadsGpx) {
#ifndef KINESPHERE_WITH_EXPAT
  GTEST_SKIP() << "built without expat";
#endif
  const auto gpx = [](const std::string& body) {
    return R"(<?xml version="1.0"?><gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1">)" + body +
           "</gpx>";
  };
  const Recording two =
      parse(gpx("<trk><name>a, b</name><trkseg>" + point_a + "\n" + point_b + "</trkseg></trk><trk><trkseg>" +
                point_a + point_b + "</trkseg></trk><wpt lat=\"1\" lon=\"1\"/>"));
  EXPECT_EQ(two.format, "GPX");
  ASSERT_EQ(two.tracks.size(), 2u);
  EXPECT_EQ(two.tracks[0].id, "a  b");
  EXPECT_EQ(two.tracks[1].id, "track 2");
  EXPECT_TRUE(two.is_plane);
  EXPECT_EQ(two.warnings.size(), 1u) << "one of two points has a height";
  EXPECT_EQ(two.times.text(two.tracks[0].samples[1].time), "2024-01-01T00:00:10Z");
  EXPECT_NEAR(norm(two.tracks[0].samples[1].position - two.tracks[0].samples[0].position), 7.6, 0.1);
  EXPECT_EQ(error_in(gpx("<trk><trkseg>\n\n<trkpt lat=\"north\" "
                         "lon=\"8\"><time>2024-01-01T00:00:00Z</time></trkpt></trkseg></trk>")),
            "f:3: expected a number as latitude (column 4), but got 'north'");
  EXPECT_EQ(error_in("<gpx>\n<trk></gpx>"), "f:2: expected GPX: mismatched tag");
  EXPECT_TRUE(
      error_in("<!DOCTYPE gpx [<!ENTITY a \"aaaa\">]><gpx>&a;</gpx>").starts_with("f:1: expected GPX: "));
}

TEST(ConvertedTables, ReadsXyz) {
  const std::string ours =
      "2\nLattice=\"9 0 0 0 9 0 0 0 9\" pbc=\"F F F\" Properties=species:S:1:id:I:1:pos:R:3 Time=0.125\n"
      "S 7 1 2 3\nS 9 4 5 6\n2\nProperties=species:S:1:id:I:1:pos:R:3 Time=0.25\nS 7 1.5 2 3\nS 9 4 5 6\n";
  const Recording run = parse(ours);
  EXPECT_EQ(run.format, "XYZ");
  ASSERT_EQ(run.tracks.size(), 2u);
  EXPECT_EQ(run.tracks[0].id, "7");
  EXPECT_EQ(run.tracks[0].samples[1].time, 0.25);
  EXPECT_EQ(run.tracks[0].samples[1].position, (Vec3{1.5, 2, 3}));
  // Plain XYZ has neither ids nor times.
  const std::string plain = "1\nwater\nO 1 2 3\n1\nwater\nO 2 2 3\n";
  EXPECT_EQ(error_in(plain), "f: expected --frame-rate, because column 'frame' counts frames");
  EXPECT_EQ(parse(plain, frames(2)).tracks[0].samples[1].time, 0.5);
  EXPECT_EQ(error_in("1\nwater\nO 1 2 3\n1\nwater\nO 2 two 3\n", frames(2)),
            "f:6: expected a number as y (column 4), but got 'two'");
  EXPECT_EQ(error_in("1\nLattice=\"9 0 0 0 9 0 0 0 9\" Properties=species:S:1:pos:R:3 Time=0\nO 1 two 3\n"),
            "f:3: expected a number as y (column 4), but got 'two'");
  EXPECT_EQ(error_in("1\nwater\nO 1 2 3\nwater\n", frames(2)),
            "f:4: expected a number of atoms, but got 'water'");
  EXPECT_EQ(error_in("1\nwater\nO 1 2 3\n1\nwater\nO 2 2 3", frames(2)),
            "f:6: expected a whole line of an atom with 4 columns or more, but got 'O 2 2 3'");
  // Tracks go on through the faces of a periodic box.
  const Recording periodic = parse(
      "1\nLattice=\"10 0 0 0 10 0 0 0 10\" Properties=species:S:1:pos:R:3 Time=0\nO 9 1 1\n"
      "1\nLattice=\"10 0 0 0 10 0 0 0 10\" Properties=species:S:1:pos:R:3 Time=1\nO 0.5 1 9\n");
  EXPECT_EQ(periodic.tracks[0].samples[1].position, (Vec3{10.5, 1, -1}));
  EXPECT_EQ(periodic.warnings.size(), 1u);
}

TEST(ConvertedTables, ReadsDumpsOfLammps) {
  const auto frame = [](int step, const std::string& kinds, const std::string& atoms,
                        const std::string& rows) {
    return "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS " +
           kinds + "\n0 10\n0 10\n-5 5\nITEM: ATOMS " + atoms + "\n" + rows;
  };
  const Recording plain =
      parse(frame(0, "ff ff ff", "id type x y z vx", "1 1 1 2 3 0\n2 1 4 5 6 0\n") +
                frame(100, "ff ff ff", "id type x y z vx", "2 1 4 5 6.5 0\n1 1 1 2 3 0\n"),
            frames(100));
  EXPECT_EQ(plain.format, "LAMMPS dump");
  ASSERT_EQ(plain.tracks.size(), 2u);
  EXPECT_EQ(plain.tracks[1].samples[1].time, 1.0);
  EXPECT_EQ(plain.tracks[1].samples[1].position, (Vec3{4, 5, 6.5}));
  EXPECT_TRUE(plain.warnings.empty());
  const Recording scaled = parse(frame(0, "pp ff pp", "id xs ys zs", "1 0.95 0.5 0.5\n2 0 0 0\n") +
                                     frame(1, "pp ff pp", "id xs ys zs", "1 0.05 0.5 0.5\n2 0 0 0.9\n"),
                                 frames(1));
  EXPECT_LT(norm(scaled.tracks[0].samples[1].position - Vec3{10.5, 5, 0}), 1e-9);
  EXPECT_LT(norm(scaled.tracks[1].samples[1].position - Vec3{0, 0, -6}), 1e-9);
  EXPECT_EQ(scaled.warnings.size(), 1u);
  EXPECT_EQ(error_in(frame(0, "ff ff ff", "type x y z", "1 1 2 3\n")),
            "f:9: expected columns id and x y z, xu yu zu or xs ys zs of atoms");
  EXPECT_EQ(error_in(frame(0, "ff ff ff", "id x y z", "1 1 2\n")),
            "f:10: expected a whole line of an atom, but got '1 1 2'");
  // An unfinished frame counts as far as it goes.
  EXPECT_EQ(parse(frame(0, "ff ff ff", "id x y z", "1 1 2 3\n2 1 2 3\n") +
                      frame(1, "ff ff ff", "id x y z", "1 1 2 3\n") + "",
                  frames(1))
                .tracks.size(),
            1u);
}

}  // namespace
}  // namespace kinesphere::program::converted_tables_test
