// Recordings as scenes: straight lines, splines that swing out, tolerances, planes.
#include "tracks/track_scene.hpp"

#include <gtest/gtest.h>

#include "kinesphere/limits.hpp"
#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "program/tracks/simulated_events.hpp"
#include "simulation/oracle/comparison.hpp"
#include "simulation/tracks/linear_tracks.hpp"
#include "tracks/reading_summary.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::track_scene_test {
namespace {

TrackSet parse(const std::string& text, const TrackOptions& options = {}) {
  return parse_tracks({{"t.csv", text}}, options);
}

constexpr const char* square = "id,t,x,y\na,0,0,0\na,1,1,0\na,2,1,1\na,3,0,1\nb,0,-0.5,0.5\nb,3,-0.5,0.5\n";

TEST(TrackScene, LinesGoStraightFromSampleToSample) {
  const TrackSet track_set = parse(square);
  const auto motion = require(LinearTracks::create({track_set.tracks[0].samples}));
  EXPECT_EQ(motion.state(0, 1.5).position, (Vec3{1, 0.5, 0}));
  EXPECT_EQ(motion.definition(0, 1.5).acceleration_limit, 0.0);
  ASSERT_EQ(motion.turns().size(), 2u);
  EXPECT_EQ(motion.turns()[0].velocity, (Vec3{0, 1, 0}));
  // A turn counts from its report on, which has its very time.
  LinearTracks reported = motion;
  EXPECT_EQ(reported.state(0, 1.0).velocity, (Vec3{1, 0, 0}));
  EXPECT_TRUE(reported.set_velocity(0, 1.0, {0, 1, 0}));
  EXPECT_EQ(reported.state(0, 1.0).velocity, (Vec3{0, 1, 0}));
  EXPECT_EQ(reported.state(0, 2.0).velocity, (Vec3{0, 1, 0}));
  EXPECT_EQ(reported.set_velocity(0, 1.5, {0, 1, 0}).error().code, ErrorCode::unsupported);
  EXPECT_EQ(reported.set_velocity(0, 2.0, {0, 1, 0}).error().code, ErrorCode::unsupported);
  EXPECT_EQ(reported.set_velocity(7, 2.0, {0, 1, 0}).error().code, ErrorCode::unknown_body);
  EXPECT_THROW(reported.state(1, 0.0), BadResult);
  EXPECT_THROW(reported.trajectory(0, 2.0, 1.0), BadResult);
  const Trajectory lines = motion.trajectory(0, -1.0, 5.0);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines.front().state_at(-1.0).position, (Vec3{-1, 0, 0}));
  EXPECT_EQ(lines.back().state_at(5.0).position, (Vec3{-2, 1, 0}));
  EXPECT_EQ(motion.trajectory(0, 1.0, 1.5).front().velocity, (Vec3{0, 1, 0}));
}

TEST(TrackScene, LinesAndCurvesAgreeWithTheOracle) {
  // Walks with sudden turns in a small space.
  constexpr std::uint64_t seed = 2005;
  Random random(seed);
  std::string text = "id,t,x,y\n";
  for (int id = 0; id < 20; ++id) {
    for (int k = 0; k < 50; ++k)
      text += std::to_string(id) + "," + std::to_string(0.5 * k + 0.01 * id) + "," +
              std::to_string(random.uniform(0, 20)) + "," + std::to_string(random.uniform(0, 20)) + "\n";
  }
  const TrackSet track_set = parse(text);
  std::size_t found[2];
  for (const Interpolation interpolation : {Interpolation::spline, Interpolation::linear}) {
    const Scene scene = scene_of(track_set, {.distance = 1.0, .interpolation = interpolation}).scene;
    EXPECT_EQ(scene.world.dimensions, 2);
    const std::vector<Event> events = events_of(scene);
    const ContactComparison comparison = require(compare_with_oracle(scene, events));
    EXPECT_TRUE(comparison.agrees()) << *comparison.first_difference << ", seed " << seed;
    for (const Event& event : events) EXPECT_NE(event.kind, EventKind::bound_violation) << event.time;
    found[interpolation == Interpolation::linear] = events.size();
  }
  EXPECT_GT(found[0], 1000u);
  EXPECT_GT(found[1], 1000u);
}

/// Returns options with this gap limit (seconds).
TrackOptions with_gap(double max_gap) {
  TrackOptions options;
  options.max_gap = max_gap;
  return options;
}

TEST(TrackScene, WarnsOfSplinesThatSwingOutFar) {
  // One with a jump, and one with a wide turn.
  const TrackSet track_set = parse(
      "id,t,x,y\na,-100,300,0\na,0,0,0\na,100,0,10\na,105,0,40\na,205,0,50\na,305,300,50\n"
      "b,0,0,0\nb,100,100,0\nb,200,100,100\nb,300,0,100\n",
      with_gap(1000));
  const TrackScene curves = scene_of(track_set, {.distance = 5.0});
  EXPECT_EQ(curves.overshoots.tracks, 1u);
  EXPECT_EQ(curves.overshoots.straightened, 0u);
  EXPECT_EQ(curves.overshoots.largest.id, "a");
  EXPECT_GT(curves.overshoots.largest.size, 10.0);
  const auto warnings = warnings_of(track_set, curves);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("id 'a' after "), std::string::npos) << warnings[0];
  EXPECT_EQ(scene_of(track_set, {.distance = 5.0, .interpolation = Interpolation::linear}).overshoots.tracks,
            0u);
}

constexpr std::string_view absurd =
    "id,t,x,y\na,0,0,0\na,43200,3500,0\na,43201,0,5500\na,86400,0,0\na,129600,3500,0\n"
    "b,0,0,0\nb,43200,100,100\nb,86400,100,0\nb,129600,0,0\n";

/// Splines that swing out farther than their samples are apart become straight lines, those of others stay.
TEST(TrackScene, ReplacesAbsurdSplinesByStraightLines) {
  const TrackSet track_set = parse(std::string(absurd), with_gap(1e5));
  const TrackScene scene = scene_of(track_set, {.distance = 20.0});
  EXPECT_EQ(scene.overshoots.tracks, 0u);
  EXPECT_EQ(scene.overshoots.straightened, 1u);
  EXPECT_EQ(scene.overshoots.is_straight, (std::vector<bool>{true, false}));
  EXPECT_GT(scene.overshoots.most_absurd.size, 1e6);
  const auto warnings = warnings_of(track_set, scene);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("replaced by straight lines"), std::string::npos) << warnings[0];
  EXPECT_DOUBLE_EQ(scene.scene.world.contact_tolerance, 20e-6);

  const Motion& motion = *scene.scene.motion;
  const RecordedTracks splines = splines_through(track_set);
  for (const double time : {-10.0, 0.0, 1000.0, 43200.5, 60000.0, 129600.0, 130000.0}) {
    EXPECT_EQ(motion.state(1, time), splines.state(1, time)) << time;
    for (const Segment& segment : motion.trajectory(0, time, time + 50.0))
      EXPECT_EQ(norm(segment.acceleration), 0.0) << time;
  }
  EXPECT_NEAR(motion.state(0, 21600.0).position.x, 1750.0 + motion.state(0, 0.0).position.x, 1e-9);
  EXPECT_EQ(motion.definition(0, 0.0).acceleration_limit, 0.0);
  EXPECT_EQ(motion.definition(1, 0.0).acceleration_limit, splines.definition(1, 0.0).acceleration_limit);
  EXPECT_EQ(scene.scene.turns.size(), 3u);
  const std::vector<Event> events = events_of(scene.scene);
  ASSERT_GE(events.size(), 2u);
  for (const Event& event : events) EXPECT_NE(event.kind, EventKind::bound_violation) << event.time;
}

/// Curves that reach farther than the world at the usual tolerance get a coarser one.
TEST(TrackScene, ReachesAsFarAsItsCurves) {
  TrackOptions options;
  options.outside = Outside::go_on;
  const TrackSet track_set = parse(
      "id,t,x,y\na,0,0,0\na,1,1000,0\nb,0,0,1\nb,1,1,1\nc,0,9,0\nc,100000,9,0\nc,200000,9,0\nc,300000,9,0\nc,"
      "400000,9,0\n",
      options);
  const TrackScene curves = scene_of(track_set, {.distance = 20.0});
  EXPECT_GT(curves.scene.world.contact_tolerance, 20e-6);
  EXPECT_LT(curves.scene.world.contact_tolerance, 0.02);
  const std::vector<Event> events = events_of(curves.scene);
  ASSERT_GE(events.size(), 2u);
  for (const Event& event : events) EXPECT_NE(event.kind, EventKind::bound_violation) << event.time;
  const std::string message = error_of([&] { scene_of(track_set, {.distance = 20.0, .tolerance = 1e-6}); });
  EXPECT_NE(message.find("the spline of id 'a' after"), std::string::npos) << message;
}

TEST(TrackScene, ToleratesWhatTheExtentAllows) {
  const TrackSet track_set = parse("id,t,x,y\na,0,-4e9,0\na,1,4e9,0\nb,0,0,0\nb,1,1,0\n");
  EXPECT_GT(scene_of(track_set, {.distance = 1.0}).scene.world.contact_tolerance, 1e-3);
  EXPECT_EQ(error_of([&] { scene_of(track_set, {.distance = 1.0, .tolerance = 1e-6}); }),
            "--tolerance: expected 0.00364 or more, as id 'a' is 4e+09 from the recording's middle, but got "
            "1e-06");
  EXPECT_EQ(error_of([&] { scene_of(track_set, {.distance = 1.0, .tolerance = 2.0}); }),
            "--tolerance: expected less than the distance 1, but got 2");
}

TEST(TrackScene, WarnsOfWhatWasLeftOut) {
  std::string text = "id,t,x,y\n";
  for (int k = 0; k < 50; ++k) text += "a," + std::to_string(k < 45 ? k : 100 * k) + ",0,0\n";
  const TrackSet track_set = parse(text);
  const auto warnings = warnings_of(track_set, scene_of(track_set, {.distance = 1.0}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "5 of 50 rows (10 %) were left out, alone between two gaps: a longer --max-gap keeps them");
}

}  // namespace
}  // namespace kinesphere::program::track_scene_test
