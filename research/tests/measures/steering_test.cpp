// The grid beside which a crowd that is steered is measured finds what brute force finds, and the world all
// of it.
#include "research/measures/steering.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace kinesphere::steering_test {
namespace {

TEST(Steering, TheGridFindsWhatBruteForceFinds) {
  Random random(1);
  for (const int dimensions : {2, 3}) {
    for (const double edge : {1.5, 4.0, 12.0}) {
      std::vector<Vec3> centres;
      for (int k = 0; k < 200; ++k) {
        // Some are beyond the room.
        Vec3 centre = random.point_in_ball() * (0.6 * edge) + Vec3{0.5, 0.5, 0.5} * edge;
        if (dimensions == 2) centre.z = 0.0;
        centres.push_back(centre);
      }
      std::vector<std::pair<std::uint32_t, std::uint32_t>> found, expected;
      UniformGrid(edge, dimensions, 1.0, centres.size()).find(centres, found);
      for (std::uint32_t a = 0; a < centres.size(); ++a)
        for (std::uint32_t b = a + 1; b < centres.size(); ++b)
          if (norm_squared(centres[a] - centres[b]) < 1.0) expected.emplace_back(a, b);
      std::sort(found.begin(), found.end());
      ASSERT_FALSE(expected.empty());
      EXPECT_EQ(found, expected) << dimensions << " dimensions, edge " << edge;
    }
  }
}

TEST(Steering, TheWorldFindsAllThatTheGridFinds) {
  for (const int dimensions : {2, 3}) {
    const SteeringSettings settings{.bodies = 300, .dimensions = dimensions, .packing = 0.1, .frames = 30};
    const SteeredFrames seen = steer_grid(settings);
    ASSERT_FALSE(seen.pairs.empty());
    EXPECT_EQ(seen.seconds.size(), 30u);
    for (const SteeringBy by : {SteeringBy::velocities, SteeringBy::frames, SteeringBy::game}) {
      const SteeredFrames told = steer_world(settings, by);
      EXPECT_EQ(told.seconds.size(), 30u);
      EXPECT_TRUE(std::ranges::includes(told.pairs, seen.pairs)) << dimensions << " dimensions";
    }
  }
}

}  // namespace
}  // namespace kinesphere::steering_test
