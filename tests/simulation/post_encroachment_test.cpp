// Post-encroachment time by hand, and along curves against dense samples.
#include "simulation/tracks/post_encroachment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinesphere/random.hpp"
#include "simulation/tracks/scene_of_tracks.hpp"

namespace kinesphere::post_encroachment_test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

PostEncroachment between(const Track& first, const Track& second, double radius,
                         Interpolation interpolation = Interpolation::linear) {
  const auto scene = scene_of_tracks({first, second}, 1000.0, interpolation);
  const std::vector<double> radii{radius, radius};
  std::vector<Approach> approaches{{.first = 0,
                                    .second = 1,
                                    .begin = std::max(first.front().time, second.front().time),
                                    .end = std::min(first.back().time, second.back().time)}};
  find_closest(*scene->motion, approaches, radii);
  return post_encroachment(*scene->motion, approaches[0], radii);
}

TEST(PostEncroachment, IsThatOfStraightCourses) {
  // One passes the crossing at 5 s at 2 m/s, the other at 8 s at 1 m/s; two discs of radius 1 m.
  const Track eastward{{0, {-10, 0, 0}}, {10, {10, 0, 0}}};
  const Track northward{{0, {0, -8, 0}}, {10, {0, 2, 0}}};
  const PostEncroachment crossing = between(eastward, northward, 1.0);
  // At 5 s + a the first is at (2a, 0), at 8 s - b the second at (0, -b): 4 a^2 + b^2 = 4 where 3 - a - b is
  // least, which is at a = 1 / sqrt(5), b = 4 / sqrt(5).
  EXPECT_NEAR(crossing.seconds, 3.0 - std::sqrt(5.0), 1e-6);
  EXPECT_NEAR(crossing.at, 8.0 - 4.0 / std::sqrt(5.0), 1e-3);
  // One follows 12 m behind the other at 2 m/s.
  const Track behind{{0, {-22, 0, 0}}, {10, {-2, 0, 0}}};
  EXPECT_NEAR(between(eastward, behind, 1.0).seconds, 5.0, 1e-6);
  EXPECT_NEAR(between(behind, eastward, 1.0).seconds, 5.0, 1e-6) << "in either order";
  const Track beside{{0, {-10, 2.001, 0}}, {10, {10, 2.001, 0}}};
  EXPECT_EQ(between(eastward, beside, 1.0).seconds, never) << "just beside each other";
  const Track through{{0, {10, 0, 0}}, {10, {-10, 0, 0}}};
  EXPECT_EQ(between(eastward, through, 1.0).seconds, 0.0) << "in touch at some time";
}

TEST(PostEncroachment, AlongCurvesIsThatOfDenseSamples) {
  constexpr std::uint64_t seed = 1978;
  Random random(seed);
  int finite = 0;
  for (int round = 0; round < 60; ++round) {
    const auto walk = [&] {
      Track track;
      for (int k = 0; k <= 6; ++k)
        track.push_back({1.0 * k, {random.uniform(0, 6), random.uniform(0, 6), 0}});
      return track;
    };
    const Track a = walk(), b = walk();
    const Interpolation interpolation = round % 2 == 0 ? Interpolation::linear : Interpolation::spline;
    const double radius = 0.1;
    const PostEncroachment least = between(a, b, radius, interpolation);
    const auto scene = scene_of_tracks({a, b}, 1000.0, interpolation);
    std::vector<Vec3> places[2];
    constexpr int samples = 1200;
    for (std::uint32_t body = 0; body < 2; ++body)
      for (const Segment& segment : scene->motion->trajectory(body, 0.0, 6.0))
        for (int k = 0; k < samples / 6; ++k)
          places[body].push_back(segment.state_at(segment.begin + k * 6.0 / samples).position);
    const double step = 6.0 / samples;
    double sampled = never, nearly = never;
    // Between two samples the places move by less than this.
    const double slack = 20.0 * step;
    for (std::size_t i = 0; i < places[0].size(); ++i)
      for (std::size_t k = 0; k < places[1].size(); ++k) {
        const double lag = std::abs(static_cast<double>(i) - static_cast<double>(k)) * step;
        if (lag >= sampled) continue;
        const double distance = norm(places[0][i] - places[1][k]);
        if (distance <= 2 * radius + slack) nearly = std::min(nearly, lag);
        if (distance <= 2 * radius) sampled = lag;
      }
    EXPECT_LE(least.seconds, sampled * (1 + 1e-6) + 1e-6) << "round " << round << ", seed " << seed;
    EXPECT_GE(least.seconds, nearly - 2 * step) << "round " << round << ", seed " << seed;
    finite += least.seconds > 0.0 && least.seconds < never;
  }
  EXPECT_GE(finite, 20);
}

}  // namespace
}  // namespace kinesphere::post_encroachment_test
