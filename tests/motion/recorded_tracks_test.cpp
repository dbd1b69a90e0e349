// Splines through samples.
#include "kinesphere/motion/recorded_tracks.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "motion/motion_properties.hpp"

namespace kinesphere::recorded_tracks_test {
namespace {

Track random_track(Random& random, std::size_t samples) {
  Track track;
  double time = random.uniform(-100, 100);
  for (std::size_t k = 0; k < samples; ++k) {
    track.push_back({time, 100 * random.point_in_ball()});
    // Gaps from a millisecond to many seconds, as in recordings.
    time += random.uniform() < 0.3 ? random.uniform(0.001, 0.01) : random.uniform(0.1, 30);
  }
  return track;
}

RecordedTracks tracks_of(const Track& track) { return RecordedTracks::create({track}).value(); }

RC_GTEST_PROP(RecordedTracks, PassThroughTheirSamples, (std::uint64_t seed)) {
  Random random(seed);
  const Track track = random_track(random, *rc::gen::inRange<std::size_t>(2, 40));
  const RecordedTracks motion = tracks_of(track);
  RC_ASSERT(motion.first_time(0) == track.front().time);
  RC_ASSERT(motion.last_time(0) == track.back().time);
  for (const TrackSample& sample : track) {
    RC_ASSERT(norm(motion.state(0, sample.time).position - sample.position) < 1e-9);
  }
}

RC_GTEST_PROP(RecordedTracks, AreSmooth, (std::uint64_t seed)) {
  Random random(seed);
  const Track track = random_track(random, *rc::gen::inRange<std::size_t>(3, 40));
  const Trajectory trajectory = tracks_of(track).trajectory(0, track.front().time, track.back().time);
  RC_ASSERT(trajectory.size() == track.size() - 1);
  const double limit = tracks_of(track).definition(0, track.front().time).acceleration_limit;
  for (std::size_t k = 1; k < trajectory.size(); ++k) {
    const Segment& before = trajectory[k - 1];
    const Segment& after = trajectory[k];
    const State end = before.state_at(before.end);
    const double speed = 1.0 + norm(before.velocity) + norm(after.velocity);
    RC_ASSERT(before.end == after.begin);
    RC_ASSERT(norm(end.position - after.position) < 1e-9);
    RC_ASSERT(norm(end.velocity - after.velocity) < 1e-10 * speed);
    RC_ASSERT(norm(before.acceleration_at(before.end) - after.acceleration) <= 1e-12 * limit);
  }
  RC_ASSERT(trajectory.front().acceleration == Vec3{});
  RC_ASSERT(norm(trajectory.back().acceleration_at(track.back().time)) <= 1e-12 * limit);
}

RC_GTEST_PROP(RecordedTracks, LimitIsTheLargestAccelerationAndNoMore, (std::uint64_t seed)) {
  Random random(seed);
  const Track track = random_track(random, *rc::gen::inRange<std::size_t>(2, 20));
  const RecordedTracks motion = tracks_of(track);
  double largest = 0.0;
  for (const Segment& segment : motion.trajectory(0, track.front().time, track.back().time)) {
    for (int i = 0; i <= 16; ++i) {
      const double t = segment.begin + i / 16.0 * (segment.end - segment.begin);
      largest = std::max(largest, norm(segment.acceleration_at(t)));
    }
  }
  const double limit = motion.definition(0, track.front().time).acceleration_limit;
  RC_ASSERT(largest <= limit);
  RC_ASSERT(limit <= largest * (1.0 + 1e-11));
}

TEST(RecordedTracks, TwoSamplesMakeAStraightLine) {
  const RecordedTracks motion = tracks_of({{2.0, {0, 0, 0}}, {4.0, {4, 8, -2}}});
  EXPECT_EQ(motion.state(0, 3.0), (State{{2, 4, -1}, {2, 4, -1}}));
  EXPECT_EQ(motion.state(0, 1.0), (State{{-2, -4, 1}, {2, 4, -1}}));
  EXPECT_EQ(motion.state(0, 5.0), (State{{6, 12, -3}, {2, 4, -1}}));
  EXPECT_EQ(motion.definition(0, 3.0).acceleration_limit, 0.0);
}

// The natural spline through (0, 0), (1, 1), (2, 0) has the acceleration -3 in its middle: M (1 + 1) 2 = 6
// (-1 - 1).
TEST(RecordedTracks, AreTheNaturalSpline) {
  const RecordedTracks motion = tracks_of({{0.0, {0, 0, 0}}, {1.0, {1, 0, 0}}, {2.0, {0, 0, 0}}});
  EXPECT_DOUBLE_EQ(motion.definition(0, 0.0).acceleration_limit, 3.0 * (1.0 + 1e-12));
  EXPECT_DOUBLE_EQ(motion.state(0, 0.0).velocity.x, 1.5);
  EXPECT_DOUBLE_EQ(motion.state(0, 0.5).position.x, 1.5 * 0.5 - 0.5 * 0.125);
  EXPECT_DOUBLE_EQ(motion.state(0, 1.0).velocity.x, 0.0);
}

/// Returns the energy of the bending, the integral of |acceleration|^2.
double bending(const RecordedTracks& motion) {
  double sum = 0.0;
  for (const Segment& segment : motion.trajectory(0, motion.first_time(0), motion.last_time(0))) {
    const Vec3 &a = segment.acceleration, b = segment.acceleration_at(segment.end);
    sum += (segment.end - segment.begin) / 3.0 * (dot(a, a) + dot(a, b) + dot(b, b));
  }
  return sum;
}

RC_GTEST_PROP(RecordedTracks, StayAtTheirEnds, (std::uint64_t seed)) {
  Random random(seed);
  const Track track = random_track(random, *rc::gen::inRange<std::size_t>(2, 40));
  const auto motion = RecordedTracks::create({track}, Outside::stay).value();
  const double speed = motion.definition(0, track.front().time).acceleration_limit;
  for (const TrackSample& sample : track)
    RC_ASSERT(norm(motion.state(0, sample.time).position - sample.position) < 1e-9);
  for (const TrackSample* end : {&track.front(), &track.back()}) {
    RC_ASSERT(norm(motion.state(0, end->time).velocity) <= 1e-12 * (1.0 + speed));
    const double outside = end == &track.front() ? end->time - 9.0 : end->time + 9.0;
    RC_ASSERT(norm(motion.state(0, outside).position - end->position) <= 1e-10 * (1.0 + speed));
  }
  RC_ASSERT(bending(motion) >= bending(tracks_of(track)) * (1.0 - 1e-9));
}

// From rest to rest in one step: 3 s^2 - 2 s^3.
TEST(RecordedTracks, StayAfterAStepFromRestToRest) {
  const auto motion = RecordedTracks::create({{{1.0, {0, 0, 0}}, {2.0, {4, 0, 0}}}}, Outside::stay).value();
  EXPECT_DOUBLE_EQ(motion.state(0, 1.25).position.x, 4.0 * (3.0 / 16 - 2.0 / 64));
  EXPECT_DOUBLE_EQ(motion.state(0, 99.0).position.x, 4.0);
  EXPECT_EQ(motion.state(0, -99.0).position.x, 0.0);
}

TEST(RecordedTracks, RestAtOneEndAlone) {
  const Track track{{0.0, {0, 0, 0}}, {1.0, {1, 0, 0}}};
  const auto motion = RecordedTracks::create({track, track}, {{.first = true}, {.last = true}}).value();
  EXPECT_DOUBLE_EQ(motion.state(0, 0.0).velocity.x, 0.0);
  EXPECT_DOUBLE_EQ(motion.state(0, 1.0).velocity.x, 1.5);
  EXPECT_DOUBLE_EQ(motion.state(1, 0.0).velocity.x, 1.5);
  EXPECT_DOUBLE_EQ(motion.state(1, 1.0).velocity.x, 0.0);
  const auto wrong = RecordedTracks::create({track, track}, std::vector<RestingEnds>(1));
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().message,
            "RecordedTracks::create: ends must be one for each track, and so 2, but is 1");
}

TEST(RecordedTracks, AreAskedWithinTheirSamplesAloneIfTheyVanish) {
  const auto motion = RecordedTracks::create({{{2.0, {0, 0, 0}}, {4.0, {4, 0, 0}}}}, Outside::vanish).value();
  const auto clone = motion.clone();
  EXPECT_EQ(clone->state(0, 4.0).position.x, 4.0);
  EXPECT_EQ(clone->definition(0, 2.0).position.x, 0.0);
  EXPECT_EQ(clone->trajectory(0, 2.5, 4.0).size(), 1u);
  const auto expect_refused = [&](auto question, const std::string& message) {
    try {
      question();
      ADD_FAILURE() << message;
    } catch (const BadResult& refused) {
      EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
      EXPECT_EQ(refused.error().message, message);
    }
  };
  expect_refused(
      [&] { clone->state(0, 4.5); },
      "state: t of body 0 must not lie after its last sample, because it has vanished then: 4, but "
      "is 4.5");
  expect_refused(
      [&] { clone->definition(0, 1.5); },
      "state: t of body 0 must not lie before its first sample, because it is not there yet: 2, but "
      "is 1.5");
  expect_refused(
      [&] { clone->trajectory(0, 3.0, 5.0); },
      "trajectory: end of body 0 must not lie after its last sample, because it has vanished then: "
      "4, but is 5");
}

std::string error_of(const Track& wrong) {
  const auto result = RecordedTracks::create({{{0.0, {}}, {1.0, {}}}, wrong});
  if (result) return "none";
  EXPECT_EQ(result.error().argument, "tracks");
  EXPECT_EQ(result.error().body, (BodyId{1, 0}));
  return result.error().message;
}

TEST(RecordedTracks, NameWhatIsWrong) {
  const std::string prefix = "RecordedTracks::create: tracks of body 1";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of({}), prefix + " must have at least 2 samples, but is 0");
  EXPECT_EQ(error_of({{0.0, {}}}), prefix + " must have at least 2 samples, but is 1");
  EXPECT_EQ(error_of({{0.0, {}}, {1.5, {}}, {1.5, {}}}),
            prefix + ", sample 2, must be later than the one before it, 1.5, but is 1.5");
  EXPECT_EQ(error_of({{0.0, {}}, {1.5, {0, nan, 0}}}),
            prefix + ", sample 1, must be finite, but is (0, nan, 0)");
  EXPECT_EQ(error_of({{0.0, {}}, {nan, {}}}), prefix + ", sample 1, must be finite, but is nan");
  EXPECT_EQ(error_of({{0.0, {}}, {1e-300, {1e200, 0, 0}}}),
            prefix + ", sample 0, must give a curve that does not overflow, but is (0, 0, 0)");
}

}  // namespace
}  // namespace kinesphere::recorded_tracks_test
