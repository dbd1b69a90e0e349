// Time to collision by hand, and its least value along curves against dense samples.
#include "simulation/tracks/time_to_collision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kinesphere/random.hpp"
#include "simulation/tracks/scene_of_tracks.hpp"

namespace kinesphere::time_to_collision_test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

TEST(TimeToCollision, IsThatOfStraightCourses) {
  EXPECT_EQ(time_to_collision({10, 0, 0}, {-2, 0, 0}, 2.0), 4.0);
  EXPECT_EQ(time_to_collision({10, 0, 0}, {2, 0, 0}, 2.0), never) << "apart from each other";
  EXPECT_EQ(time_to_collision({10, 2.001, 0}, {-2, 0, 0}, 2.0), never) << "just past each other";
  EXPECT_NEAR(time_to_collision({10, 2, 0}, {-2, 0, 0}, 2.0), 5.0, 1e-6) << "along the edge";
  EXPECT_EQ(time_to_collision({1, 0, 0}, {5, 0, 0}, 2.0), 0.0) << "in touch";
  EXPECT_EQ(time_to_collision({10, 0, 0}, {0, 0, 0}, 2.0), never);
}

TEST(TimeToCollision, LeastAlongCurvesIsThatOfDenseSamples) {
  constexpr std::uint64_t seed = 1972;
  Random random(seed);
  int on_course = 0;
  for (int round = 0; round < 80; ++round) {
    const auto walk = [&] {
      Track track;
      for (int k = 0; k <= 6; ++k)
        track.push_back({1.0 * k, {random.uniform(0, 6), random.uniform(0, 6), 0}});
      return track;
    };
    const Interpolation interpolation = round % 2 == 0 ? Interpolation::linear : Interpolation::spline;
    const auto scene = scene_of_tracks({walk(), walk()}, 100.0, interpolation);
    const std::vector<double> radii{0.1, 0.05};
    std::vector<Approach> approaches{{.first = 0, .second = 1, .begin = 0.0, .end = 6.0}};
    find_closest(*scene->motion, approaches, radii);
    if (approaches[0].closest.distance <= 0.0) continue;
    const LeastTimeToCollision least = least_time_to_collision(*scene->motion, approaches[0], radii);
    const Trajectory first = scene->motion->trajectory(0, 0.0, 6.0),
                     second = scene->motion->trajectory(1, 0.0, 6.0);
    double sampled = never;
    for (std::size_t piece = 0; piece < first.size(); ++piece)
      for (int k = 0; k <= 5000; ++k) {
        const double time = first[piece].begin + (first[piece].end - first[piece].begin) * k / 5000;
        const State a = first[piece].state_at(time), b = second[piece].state_at(time);
        sampled =
            std::min(sampled, time_to_collision(b.position - a.position, b.velocity - a.velocity, 0.15));
      }
    EXPECT_LE(least.seconds, sampled * (1 + 1e-6)) << "round " << round << ", seed " << seed;
    on_course += least.seconds < never;
  }
  EXPECT_GE(on_course, 20);
}

}  // namespace
}  // namespace kinesphere::time_to_collision_test
