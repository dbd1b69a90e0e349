// Local minima of a gap: by hand, against dense samples, and where rounding could invent some.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinesphere/motion/recorded_tracks.hpp"
#include "kinesphere/random.hpp"
#include "simulation/oracle/gap_course.hpp"
#include "simulation/tracks/linear_tracks.hpp"

namespace kinesphere::gap_minima_test {
namespace {

Trajectory through(const Track& track, bool straight) {
  const double begin = track.front().time, end = track.back().time;
  if (straight) return LinearTracks::create({track})->trajectory(0, begin, end);
  return RecordedTracks::create({track})->trajectory(0, begin, end);
}

TEST(GapMinima, PassingIsOneAndEndsCount) {
  const Trajectory moves = {{.begin = 0, .end = 10, .position = {-5, 1, 0}, .velocity = {1, 0, 0}}};
  const Trajectory stays = {{.begin = 0, .end = 10}};
  const GapCourse gap(moves, stays, 0.0);
  const auto whole = gap.minima(0, 10);
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_NEAR(whole[0].time, 5.0, 1e-14);
  EXPECT_EQ(whole[0].gap, 1.0);
  EXPECT_FALSE(whole[0].is_at_end);
  const auto before = gap.minima(0, 4), after = gap.minima(7, 10);
  ASSERT_EQ(before.size(), 1u);
  EXPECT_EQ(before[0].time, 4.0);
  EXPECT_TRUE(before[0].is_at_end);
  ASSERT_EQ(after.size(), 1u);
  EXPECT_EQ(after[0].time, 7.0);
  EXPECT_TRUE(after[0].is_at_end);
  // Bodies that keep their distance have one minimum.
  const GapCourse same(moves, moves, 0.0);
  EXPECT_EQ(same.minima(0, 10).size(), 1u);
}

TEST(GapMinima, AMinimumAtASampleIsOne) {
  // Both curves are symmetrical about the sample at 5, far from the origin.
  for (const double far : {0.0, 1e3, 1e6}) {
    for (const bool straight : {false, true}) {
      Track a, b;
      for (int k = 0; k <= 10; ++k) {
        const double t = 0.1 * k, u = t - 0.5;
        a.push_back({t, {far + u, far + u * u, 0}});
        b.push_back({t, {far - u, far - 0.3, 0.1}});
      }
      const Trajectory first = through(a, straight), second = through(b, straight);
      const auto minima = GapCourse(first, second, 0.0).minima(0, 1);
      ASSERT_EQ(minima.size(), 1u) << far << straight;
      EXPECT_NEAR(minima[0].time, 0.5, 1e-7) << far;
    }
  }
}

TEST(GapMinima, CoOrbitalBodiesHaveTwelve) {
  // Two epicycles of equal period: the distance has as many minima as the second turns around the first.
  Track a, b;
  for (int k = 0; k <= 480; ++k) {
    const double phase = 2.0 * std::numbers::pi * 12.0 * k / 480.0;
    a.push_back({60.0 * k, {7e6 * std::cos(phase), 7e6 * std::sin(phase), 0}});
    b.push_back({60.0 * k,
                 {7e6 * std::cos(phase) + 400.0 + 100.0 * std::sin(phase),
                  7e6 * std::sin(phase) + 50.0 * std::cos(phase), 0}});
  }
  const Trajectory first = through(a, false), second = through(b, false);
  std::size_t inside = 0;
  for (const GapCourse::Minimum& minimum : GapCourse(first, second, 0.0).minima(0, 60.0 * 480))
    inside += !minimum.is_at_end;
  EXPECT_EQ(inside, 12u);
}

TEST(GapMinima, AreThoseOfDenseSamples) {
  constexpr std::uint64_t seed = 2042;
  Random random(seed);
  constexpr int steps = 40000;
  std::size_t all = 0;
  for (int round = 0; round < 40; ++round) {
    const bool straight = round % 2 == 1;
    const auto walk = [&](double begin) {
      Track track;
      for (int k = 0; k <= 8; ++k)
        track.push_back(
            {begin + 0.5 * k, {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)}});
      return track;
    };
    const Trajectory first = through(walk(0.0), straight), second = through(walk(-0.2), straight);
    const double from = 0.0, to = 3.8, step = (to - from) / steps;
    const GapCourse gap(first, second, 0.25);
    const auto minima = gap.minima(from, to);
    std::vector<double> sampled(steps + 1);
    for (int k = 0; k <= steps; ++k) sampled[static_cast<std::size_t>(k)] = gap.gap_at(from + k * step);
    // Each sample that is lower than those beside it has a minimum near it that is as low, and there are no
    // others.
    std::size_t found = 0;
    for (std::size_t k = 0; k <= steps; ++k) {
      const bool below_last = k == 0 || sampled[k] < sampled[k - 1];
      const bool below_next = k == steps || sampled[k] <= sampled[k + 1];
      if (!below_last || !below_next) continue;
      ASSERT_LT(found, minima.size()) << "round " << round << ", seed " << seed;
      EXPECT_NEAR(minima[found].time, from + static_cast<double>(k) * step, 1.01 * step) << "round " << round;
      EXPECT_LE(minima[found].gap, sampled[k] + 1e-12) << "round " << round;
      EXPECT_EQ(minima[found].is_at_end, k == 0 || k == steps) << "round " << round;
      ++found;
    }
    EXPECT_EQ(found, minima.size()) << "round " << round << ", seed " << seed;
    EXPECT_NEAR(gap.least(from, to).gap,
                std::min_element(minima.begin(), minima.end(),
                                 [](const auto& a, const auto& b) { return a.gap < b.gap; })
                    ->gap,
                1e-12);
    all += found;
  }
  EXPECT_GT(all, 100u);
}

}  // namespace
}  // namespace kinesphere::gap_minima_test
