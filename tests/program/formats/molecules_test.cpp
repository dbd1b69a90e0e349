// Trajectories of molecules in boxes of any shape.
#include <fmt/format.h>

#include <cmath>

#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::molecules_test {
namespace {

TrackSet parse(const std::string& text) { return parse_tracks({{"f", text}}, {}); }
std::string error_in(const std::string& text) {
  return error_of([&] { parse(text); });
}

using Frame = std::vector<Vec3>;

/// A ball that goes straight on through the faces of a cell is read as it moves.
TEST(Molecules, GoOnThroughTheFacesOfACell) {
  const Vec3 a{4, 0, 0}, b{1.5, 5, 0}, c{-1, 2, 6};
  const Vec3 velocity{0.6, -0.5, 0.7};
  std::vector<Frame> straight, wrapped;
  for (int k = 0; k < 60; ++k) {
    const Vec3 at = velocity * static_cast<double>(k);
    straight.push_back({at});
    Vec3 inside = at;
    inside -= c * std::floor(inside.z / c.z);
    inside -= b * std::floor(inside.y / b.y);
    inside -= a * std::floor(inside.x / a.x);
    wrapped.push_back({inside});
  }
  const auto expect_straight = [&](const TrackSet& track_set, double tolerance) {
    ASSERT_EQ(track_set.tracks.size(), 1u);
    ASSERT_EQ(track_set.tracks[0].samples.size(), straight.size());
    for (std::size_t k = 0; k < straight.size(); ++k)
      EXPECT_LT(
          norm(track_set.coordinates.as_in_file(track_set.tracks[0].samples[k].position) - straight[k][0]),
          tolerance);
    EXPECT_EQ(track_set.warnings.size(), 1u) << "distances through the faces are not seen";
  };
  std::string xyz;
  for (std::size_t k = 0; k < wrapped.size(); ++k)
    xyz += fmt::format(
        "1\nLattice=\"4 0 0 1.5 5 0 -1 2 6\" Properties=species:S:1:pos:R:3 Time={}\nO {} {} {}\n", k,
        wrapped[k][0].x, wrapped[k][0].y, wrapped[k][0].z);
  expect_straight(parse(xyz), 1e-9);
  EXPECT_NE(error_in("1\nLattice=\"4 1 0 0 5 0 0 0 6\" Properties=species:S:1:pos:R:3 Time=0\nO 0 0 0\n")
                .find("Lattice=\"X 0 0 XY Y 0 XZ YZ Z\""),
            std::string::npos);
}

TEST(Molecules, OfTiltedBoxesOfLammpsAreUnwrapped) {
  const auto dump = [](const std::string& columns, int second_x) {
    std::string text;
    for (const int x : {0, second_x})
      text += fmt::format(
          "ITEM: TIME\n{}\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 10 1\n0 10 0\n0 "
          "10 0\n"
          "ITEM: ATOMS id {}\n1 {} 0 0\n",
          x, columns, x);
    return text;
  };
  // Unwrapped positions are not unwrapped once more, however fast their atoms are.
  const TrackSet fast = parse(dump("xu yu zu", 9));
  EXPECT_EQ(fast.tracks[0].samples[1].position, (Vec3{9, 0, 0}));
  EXPECT_EQ(error_in(dump("x y z", 9)),
            "f:9: expected unwrapped positions, xu yu zu, in a tilted box: dump these, as in: dump 1 all "
            "custom 100 "
            "FILE id xu yu zu");
}

}  // namespace
}  // namespace kinesphere::program::molecules_test
