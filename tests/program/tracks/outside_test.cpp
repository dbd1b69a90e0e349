// Before the first and after the last sample of an id: --outside.
#include <fmt/format.h>

#include <algorithm>

#include "program/support.hpp"
#include "tracks/track_file.hpp"
#include "tracks/track_scene.hpp"
#include "tracks/vanishings.hpp"

namespace kinesphere::program::outside_test {
namespace {

/// One comes to (50, 0) at 4 s, where its log ends; another passes 1 from there at 25 s. A third begins
/// beside it at 90 s, and a fourth has one sample.
std::string hovering() {
  std::string text = "id,time,x,y\n";
  for (int t = 0; t < 5; ++t) text += fmt::format("hover,{},{},0\n", t, 46 + t);
  for (int t = 0; t < 100; ++t) text += fmt::format("pass,{},{},1\n", t, 2 * t);
  for (int t = 90; t < 95; ++t) text += fmt::format("late,{},50,3\n", t);
  return text + "once,60,10,1\n";
}

TrackSet parse(const std::string& text, Outside outside) {
  TrackOptions options;
  options.outside = outside;
  return parse_tracks({{"t.csv", text}}, options);
}

const RecordedTrack& track_of(const TrackSet& track_set, const std::string& id) {
  return *std::find_if(track_set.tracks.begin(), track_set.tracks.end(),
                       [&](const RecordedTrack& track) { return track.id == id; });
}

std::vector<Vanishing> vanishings(const TrackSet& track_set, const ApproachChoice& choice, double distance) {
  return vanishings_in(track_set, ApproachFilter(choice, track_set),
                       closeness_of(fmt::format("{}", distance), ""));
}

TEST(Outside, VanishNamesWhoVanishedNearWhom) {
  const TrackSet track_set = parse(hovering(), Outside::vanish);
  EXPECT_EQ(track_set.tracks.size(), 3u) << "one sample is no track";
  const auto found = vanishings(track_set, {}, 3.5);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].id, "hover");
  EXPECT_FALSE(found[0].has_appeared);
  EXPECT_EQ(found[0].time, 4.0);
  EXPECT_EQ(found[0].other, "pass");
  EXPECT_DOUBLE_EQ(found[0].other_time, 25.0);
  EXPECT_DOUBLE_EQ(found[0].distance, 1.0);
  EXPECT_EQ(found[1].id, "late");
  EXPECT_TRUE(found[1].has_appeared);
  EXPECT_DOUBLE_EQ(found[1].distance, 2.0);
  EXPECT_EQ(vanishings(track_set, {}, 1.5).size(), 1u);
  EXPECT_TRUE(vanishings(track_set, {}, 0.9).empty());
  EXPECT_TRUE(vanishings(track_set, {.until = "20"}, 1.5).empty()) << "not yet";
  EXPECT_EQ(vanishings(track_set, {.only = {"late"}}, 3.5).size(), 2u)
      << "the other passed its place, and it appears where one vanished";
  EXPECT_TRUE(vanishings(parse(hovering(), Outside::stay), {}, 3.5).empty()) << "nobody vanishes";
}

TEST(Outside, VanishingsAreThoseOfAPlainSearch) {
  std::string text = "id,time,x,y\n";
  unsigned state = 71;
  const auto next = [&] { return (state = state * 1664525u + 1013904223u) >> 16; };
  for (int id = 0; id < 30; ++id)
    for (unsigned k = 0, begin = next() % 40; k < 10; ++k)
      text += fmt::format("b{},{},{},{}\n", id, begin + k, next() % 1000 * 0.1, next() % 1000 * 0.1);
  TrackOptions options;
  options.counts_handovers = true;
  const TrackSet track_set = parse_tracks({{"t.csv", text}}, options);
  std::size_t expected = 0;
  for (const RecordedTrack& track : track_set.tracks) {
    for (const bool is_first : {true, false}) {
      const TrackSample& end = is_first ? track.samples.front() : track.samples.back();
      bool is_near = false;
      for (const RecordedTrack& other : track_set.tracks) {
        if (other.id == track.id) continue;
        for (std::size_t k = 1; k < other.samples.size(); ++k) {
          const TrackSample &from = other.samples[k - 1], &to = other.samples[k];
          for (int part = 0; part <= 2000; ++part) {
            const double s = part / 2000.0, time = from.time + s * (to.time - from.time);
            const bool is_outside = is_first ? time <= end.time : time >= end.time;
            const Vec3 at = from.position + (to.position - from.position) * s;
            is_near = is_near || (is_outside && norm(at - end.position) < 4.0);
          }
        }
      }
      expected += is_near ? 1 : 0;
    }
  }
  EXPECT_GT(expected, 20u);
  EXPECT_EQ(vanishings(track_set, {}, 4.0).size(), expected);
}

TEST(Outside, StayReachesToTheEndsOfTheRecording) {
  const TrackSet track_set = parse(hovering(), Outside::stay);
  EXPECT_EQ(track_of(track_set, "hover").until(), 99.0);
  EXPECT_EQ(track_of(track_set, "late").from(), 0.0);
  EXPECT_EQ(track_of(track_set, "once").from(), 0.0) << "one sample is enough";
  EXPECT_EQ(track_of(track_set, "once").until(), 99.0);
  EXPECT_FALSE(track_of(track_set, "pass").reaches_on_to) << "nothing is outside of it";
  for (const Interpolation interpolation : {Interpolation::spline, Interpolation::linear}) {
    const Scene scene = scene_of(track_set, {.distance = 1.5, .interpolation = interpolation}).scene;
    for (std::uint32_t body = 0; body < track_set.tracks.size(); ++body) {
      EXPECT_EQ(scene.bodies[body].appears, 0.0);
      EXPECT_EQ(scene.bodies[body].vanishes, 99.0);
      if (track_set.tracks[body].id != "pass") {
        EXPECT_NEAR(norm(scene.motion->state(body, 50.0).velocity), 0.0, 1e-12);
      }
    }
  }
}

TEST(Outside, GapsWithinAnIdAreStillGaps) {
  const TrackSet track_set = parse(
      "id,time,x,y\na,0,0,0\na,2,0,0\na,4,0,0\na,6,0,0\na,8,0,0\na,10,0,0\n"
      "b,2,1,1\nb,3,2,1\nb,4,3,1\nb,7,9,9\nb,8,9,8\n",
      Outside::stay);
  ASSERT_EQ(track_set.tracks.size(), 3u);
  EXPECT_EQ(track_set.tracks[1].from(), 0.0);
  EXPECT_EQ(track_set.tracks[1].until(), 4.0);
  EXPECT_EQ(track_set.tracks[2].from(), 7.0);
  EXPECT_EQ(track_set.tracks[2].until(), 10.0);
  EXPECT_TRUE(track_set.tracks[2].rests.last);
  EXPECT_FALSE(track_set.tracks[2].rests.first);
}

class OutsideProgram : public ProgramTest {};

TEST_F(OutsideProgram, FindsApproachesOutsideOfSamples) {
  const std::string file = write("t.csv", hovering());
  const ProgramRun vanish = run("tracks " + file + " --distance 1.5");
  EXPECT_NE(vanish.out.find("approaches        0 "), std::string::npos) << vanish.out;
  EXPECT_NE(vanish.out.find("'hover' vanishes at 4, 'pass' 1 from there at 25"), std::string::npos)
      << vanish.out;
  EXPECT_NE(vanish.err.find("--outside stay or go-on"), std::string::npos) << vanish.err;
  const auto expect_at = [&](const std::string& options, const std::string& time) {
    const ProgramRun found = run("tracks " + file + " --distance 1.5 --verify --outside " + options);
    EXPECT_EQ(found.exit_code, 0) << found.err << found.out;
    EXPECT_NE(found.out.find("\n                      " + time + " "), std::string::npos)
        << options << found.out;
    EXPECT_EQ(found.err.find("vanishes"), std::string::npos) << found.err;
  };
  expect_at("stay", "25");
  expect_at("stay --interpolate linear", "25");
  expect_at("go-on", "46");
  expect_at("go-on --interpolate linear", "46");
  expect_wrong_input("tracks " + file + " --distance 1 --outside leave",
                     {"--outside", "go-on|stay|vanish", "'leave'"});
}

}  // namespace
}  // namespace kinesphere::program::outside_test
