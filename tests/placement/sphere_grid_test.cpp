// Spheres near a sphere, of all sizes, against a plain look at each pair.
#include "placement/sphere_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace kinesphere::sphere_grid_test {
namespace {

TEST(SphereGrid, FindsAllThatAreNear) {
  constexpr std::uint64_t seed = 6105;
  SCOPED_TRACE(seed);
  for (std::uint64_t k = 0; k < 20; ++k) {
    Random random = Random::at(seed, k, 0);
    SphereRoom room{.box = {{0, 0, 0}, {10, 8, 6}},
                    .periodic = {.x = k % 2 == 0, .z = k % 3 == 0},
                    .dimensions = 3,
                    .gap = 0.0};
    std::vector<double> ranges;
    for (int sphere = 0; sphere < 150; ++sphere)
      ranges.push_back(random.uniform() < 0.1 ? 1.0 : 0.05 + 0.2 * random.uniform());
    room.radii = ranges;
    SphereGrid grid(room, ranges);
    std::vector<Vec3> centres;
    for (std::uint32_t sphere = 0; sphere < 150; ++sphere)
      centres.push_back(room.random_centre(sphere, random));
    std::vector<std::uint32_t> order(150);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return ranges[a] > ranges[b]; });
    std::vector<std::uint32_t> entered;
    for (const std::uint32_t sphere : order) {
      std::set<std::uint32_t> found;
      EXPECT_TRUE(grid.all_near(sphere, centres[sphere], [&](std::uint32_t other) {
        found.insert(other);
        return true;
      }));
      for (const std::uint32_t other : entered)
        if (norm(room.offset(centres[sphere], centres[other])) <= ranges[sphere] + ranges[other]) {
          EXPECT_TRUE(found.contains(other)) << sphere << ' ' << other;
        }
      grid.enter(sphere, centres[sphere]);
      entered.push_back(sphere);
    }
    int visits = 0;
    EXPECT_FALSE(
        grid.all_near(order.back(), centres[order.back()], [&](std::uint32_t) { return ++visits < 0; }));
    EXPECT_EQ(visits, 1) << "it stops where it is told";
    grid.clear();
    EXPECT_TRUE(grid.all_near(0, centres[0], [](std::uint32_t) { return false; })) << "nobody is in";
  }
}

}  // namespace
}  // namespace kinesphere::sphere_grid_test
