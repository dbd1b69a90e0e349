// The exact course of gaps: roots by hand, against dense samples, and where rounding is worst.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinesphere/random.hpp"
#include "simulation/oracle/gap_course.hpp"
#include "simulation/oracle/pair_table.hpp"

namespace kinesphere::gap_course_test {
namespace {

Trajectory still(const Vec3& position) { return {{.begin = -1e9, .end = 1e9, .position = position}}; }
Trajectory straight(const Vec3& position, const Vec3& velocity, double begin = 0.0) {
  return {{.begin = begin, .end = 1e9, .position = position, .velocity = velocity}};
}

TEST(GapCourse, HeadOn) {
  const Trajectory a = straight({-10, 0, 0}, {2, 0, 0});
  const Trajectory b = still({0, 0, 0});
  const GapCourse gap(a, b, 1.0);
  EXPECT_EQ(gap.gap_at(0.0), 9.0);
  EXPECT_EQ(gap.gap_at(5.0), -1.0);
  EXPECT_NEAR(gap.first_time(LevelCrossing::falls_to, 0.0, 0, 100).value(), 4.5, 1e-14);
  EXPECT_NEAR(gap.first_time(LevelCrossing::falls_to, -0.5, 0, 100).value(), 4.75, 1e-14);
  EXPECT_EQ(gap.first_time(LevelCrossing::falls_to, 0.0, 0, 4.4), std::nullopt);
  EXPECT_EQ(gap.first_time(LevelCrossing::falls_to, 0.0, 5.6, 100), std::nullopt);
  EXPECT_NEAR(gap.first_time(LevelCrossing::rises_to, 0.0, 5, 100).value(), 5.5, 1e-14);
  EXPECT_EQ(gap.first_time(LevelCrossing::rises_to, 3.0, 0, 100).value(), 0.0) << "it is that large already";
  EXPECT_NEAR(gap.first_time(LevelCrossing::rises_to, 3.0, 5, 100).value(), 7.0, 1e-14);
  EXPECT_EQ(gap.first_time(LevelCrossing::falls_to, 0.0, 4.9, 100).value(), 4.9)
      << "it is that small already";
  EXPECT_NEAR(gap.first_time(LevelCrossing::falls_to, 0.0, 0, 4.5).value_or(4.5), 4.5, 1e-14)
      << "at the very end";
}

TEST(GapCourse, LevelBelowTheRadiiIsNeverReached) {
  const Trajectory a = straight({-10, 0, 0}, {2, 0, 0});
  const Trajectory b = still({0, 0, 0});
  EXPECT_EQ(GapCourse(a, b, 1.0).first_time(LevelCrossing::falls_to, -1.5, 0, 100), std::nullopt);
}

TEST(GapCourse, TangentIsFoundOnceItIsDeeperThanRounding) {
  const Trajectory b = still({0, 0, 0});
  for (const double depth : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Trajectory a = straight({-10, 1.0 - depth, 0}, {1, 0, 0});
    const auto time = GapCourse(a, b, 1.0).first_time(LevelCrossing::falls_to, 0.0, 0, 100);
    ASSERT_TRUE(time) << depth;
    EXPECT_NEAR(*time, 10.0 - std::sqrt(2 * depth - depth * depth), 1e-5) << depth;
    const Trajectory apart = straight({-10, 1.0 + depth, 0}, {1, 0, 0});
    EXPECT_FALSE(GapCourse(apart, b, 1.0).first_time(LevelCrossing::falls_to, 0.0, 0, 100)) << depth;
  }
}

TEST(GapCourse, StandingExactlyAtTheLevelHasReachedIt) {
  const Trajectory a = still({0, 0, 0});
  const Trajectory b = still({2, 0, 0});
  const GapCourse gap(a, b, 2.0);
  EXPECT_EQ(gap.first_time(LevelCrossing::falls_to, 0.0, 3, 9).value(), 3.0);
  EXPECT_EQ(gap.first_time(LevelCrossing::rises_to, 0.0, 3, 9).value(), 3.0);
  EXPECT_EQ(gap.first_time(LevelCrossing::falls_to, -1e-12, 3, 9), std::nullopt);
  EXPECT_EQ(gap.first_time(LevelCrossing::rises_to, 1e-12, 3, 9), std::nullopt);
  EXPECT_EQ(GapCourse(a, b, 0.0).first_time(LevelCrossing::falls_to, 2.0, 3, 9).value(), 3.0);
}

TEST(GapCourse, WallOfACubic) {
  // z = 1 + s^3 - 3 s goes through 0 between 0 and 1, has its minimum at 1, and comes back.
  const Trajectory a{
      {.begin = 2.0, .end = 9.0, .position = {0, 0, 1}, .velocity = {0, 0, -3}, .jerk = {0, 0, 6}}};
  const GapCourse gap(a, HalfSpace{{0, 0, 1}, -1.0}, 0.5);  // wall at z = -1, gap = z + 0.5
  const double falls = gap.first_time(LevelCrossing::falls_to, 0.0, 2, 9).value();
  EXPECT_NEAR(gap.gap_at(falls), 0.0, 1e-14);
  EXPECT_LT(falls, 3.0);
  const double rises = gap.first_time(LevelCrossing::rises_to, 0.0, 3.0, 9).value();
  EXPECT_NEAR(gap.gap_at(rises), 0.0, 1e-14);
  EXPECT_GT(rises, 3.0);
  EXPECT_EQ(gap.first_time(LevelCrossing::falls_to, -0.51, 2, 9), std::nullopt);
  const auto double_root = gap.first_time(LevelCrossing::falls_to, -0.5, 2, 9);
  if (double_root) {
    EXPECT_NEAR(*double_root, 3.0, 1e-6);
  }
}

TEST(GapCourse, SmallAndFastFromFarAwayIsNotLostInRounding) {
  // A bullet of a centimetre crosses another a long way down one single segment.
  for (const double distance : {10.0, 1e3, 1e5, 1e6}) {
    const Trajectory a = straight({-distance, 0.005, 0}, {1000, 0, 0});
    const Trajectory b = still({0, 0, 0});
    const GapCourse gap(a, b, 0.02);
    const double half_way = std::sqrt(0.02 * 0.02 - 0.005 * 0.005);
    const auto hit = gap.first_time(LevelCrossing::falls_to, 0.0, 0, 3e3 + distance);
    ASSERT_TRUE(hit) << distance;
    EXPECT_NEAR(*hit, (distance - half_way) / 1000.0, 1e-15 * distance + 1e-12) << distance;
    const auto leaves = gap.first_time(LevelCrossing::rises_to, 1e-6, *hit, 3e3 + distance);
    ASSERT_TRUE(leaves) << distance;
    EXPECT_NEAR(*leaves, (distance + half_way) / 1000.0, 1e-15 * distance + 1e-6) << distance;
  }
}

TEST(GapCourse, LongParallelFlightFarFromTheOrigin) {
  const Vec3 place{1e6, -1e6, 1e6};
  const Trajectory a = straight(place, {100, 0, 0});
  const Trajectory b = straight(place + Vec3{0, 3, 0}, {100, -1e-4, 0});
  const auto hit = GapCourse(a, b, 2.0).first_time(LevelCrossing::falls_to, 0.0, 0, 1e6);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(*hit, 1e4, 0.05);
}

/// A random trajectory whose pieces fit together, with jerk if wanted.
Trajectory random_trajectory(Random& random, int pieces, bool jerk) {
  Trajectory trajectory;
  Segment piece{
      .begin = 0.0, .position = 4.0 * random.point_in_ball(), .velocity = 2.0 * random.point_in_ball()};
  for (int k = 0; k < pieces; ++k) {
    piece.end = piece.begin + random.uniform(0.2, 1.5);
    piece.acceleration = 6.0 * random.point_in_ball();
    piece.jerk = jerk ? 6.0 * random.point_in_ball() : Vec3{};
    trajectory.push_back(piece);
    const State at_end = piece.state_at(piece.end);
    piece.begin = piece.end;
    piece.position = at_end.position;
    piece.velocity = at_end.velocity;
  }
  return trajectory;
}

TEST(GapCourse, AgreesWithDenseSamples) {
  Random random(13);
  int found = 0;
  for (int round = 0; round < 300; ++round) {
    const Trajectory a = random_trajectory(random, 6, round % 2 == 0);
    const Trajectory b = random_trajectory(random, 4, round % 3 == 0);
    const double last = std::min(a.back().end, b.back().end);
    const double from = 0.3 * last * random.uniform();
    const double radii = random.uniform(0.0, 3.0);
    const GapCourse gap = round % 5 == 0 ? GapCourse(a, HalfSpace{random.unit_vector(), -3.0}, 0.5 * radii)
                                         : GapCourse(a, b, radii);
    const double level = random.uniform(-0.2, 1.0);
    for (const LevelCrossing overlap : {LevelCrossing::falls_to, LevelCrossing::rises_to}) {
      const double sign = overlap == LevelCrossing::falls_to ? 1.0 : -1.0;
      const auto time = gap.first_time(overlap, level, from, last);
      const double until = time.value_or(last);
      constexpr int samples = 2000;
      for (int k = 0; k < samples && until > from; ++k) {
        const double t = from + (until - from) * k / samples;
        ASSERT_GT(sign * (gap.gap_at(t) - level), -1e-9) << round << " at " << t << " before " << until;
      }
      if (!time) continue;
      ++found;
      ASSERT_LE(sign * (gap.gap_at(*time) - level), 1e-9) << round;
      ASSERT_GE(*time, from);
      ASSERT_LE(*time, last);
    }
  }
  EXPECT_GT(found, 200);
}

TEST(GapCourse, LeastIsWhereTwoPassEachOther) {
  const Trajectory a = straight({-10, 1, 0}, {2, 0, 0});
  const Trajectory b = straight({10, -2, 0}, {-3, 0, 0});
  const auto passing = GapCourse(a, b, 0.5).least(0.0, 10.0);
  EXPECT_NEAR(passing.time, 4.0, 1e-7);  // a square root of rounding: the gap is flat there
  EXPECT_NEAR(passing.gap, 2.5, 1e-14);
  const auto before = GapCourse(a, b, 0.5).least(1.0, 3.0);
  EXPECT_EQ(before.time, 3.0);
  EXPECT_NEAR(before.gap, std::sqrt(9.0 + 25.0) - 0.5, 1e-14);
  const auto at_once = GapCourse(a, b, 0.5).least(7.0, 7.0);
  EXPECT_EQ(at_once.time, 7.0);
}

TEST(GapCourse, LeastIsAsDeepAsTwoRadiiWhereCentresMeet) {
  const Trajectory a = straight({-10, 0, 0}, {2, 0, 0});
  const Trajectory b = straight({10, 0, 0}, {-3, 0, 0});
  const auto least = GapCourse(a, b, 0.5).least(0.0, 10.0);
  EXPECT_NEAR(least.time, 4.0, 1e-14);
  EXPECT_NEAR(least.gap, -0.5, 1e-14);
}

TEST(GapCourse, LeastIsNoneOfDenseSamplesLess) {
  Random random(17);
  int inside = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    const Trajectory a = random_trajectory(random, 6, round % 2 == 0);
    const Trajectory b = random_trajectory(random, 4, round % 3 == 0);
    const double last = std::min(a.back().end, b.back().end);
    const double from = 0.5 * last * random.uniform();
    const double to = random.uniform(from, last);
    const GapCourse gap(a, b, random.uniform(0.0, 3.0));
    const auto least = gap.least(from, to);
    EXPECT_LE(from, least.time);
    EXPECT_LE(least.time, to);
    EXPECT_NEAR(gap.gap_at(least.time), least.gap, 1e-12);
    inside += from < least.time && least.time < to;
    constexpr int samples = 2000;
    for (int k = 0; k <= samples; ++k)
      EXPECT_GE(gap.gap_at(from + (to - from) * k / samples), least.gap - 1e-12);
  }
  EXPECT_GT(inside, 40);
}

TEST(PairTable, HasOneValueForEachPairAndKeepsItWhenItGrows) {
  PairTable<int> table;
  table.resize(5);
  int next = 0;
  for (std::uint32_t a = 0; a < 5; ++a)
    for (std::uint32_t b = a + 1; b < 5; ++b) table(a, b) = ++next;
  table.resize(40);
  next = 0;
  for (std::uint32_t a = 0; a < 5; ++a)
    for (std::uint32_t b = a + 1; b < 5; ++b) {
      EXPECT_EQ(table(a, b), ++next);
      EXPECT_EQ(table(b, a), next);
    }
  EXPECT_EQ(table(38, 39), 0);
  PairTable<int> single;
  single.resize(1);
  single.resize(2);
  single(1, 0) = 7;
  EXPECT_EQ(single(0, 1), 7);
}

}  // namespace
}  // namespace kinesphere::gap_course_test
