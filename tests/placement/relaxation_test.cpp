// Spheres that push each other apart end without overlap, or not at all.
#include "placement/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace kinesphere::relaxation_test {
namespace {

TEST(Relaxation, LeavesNoOverlap) {
  for (const bool is_periodic : {false, true})
    for (const int dimensions : {2, 3}) {
      SphereRoom room{.box = {{0, 0, 0}, {8, 8, dimensions == 3 ? 8.0 : 1.0}},
                      .periodic = {.x = is_periodic, .y = is_periodic},
                      .dimensions = dimensions,
                      .gap = 1e-6,
                      .radii = std::vector<double>(dimensions == 3 ? 330 : 45, 0.55)};
      const auto centres = relax_spheres(room, 6106);
      ASSERT_TRUE(centres);
      for (std::uint32_t a = 0; a < room.count(); ++a) {
        for (int axis = 0; axis < dimensions; ++axis) {
          EXPECT_GE((*centres)[a][axis], room.lowest(a, axis));
          EXPECT_LE((*centres)[a][axis], room.highest(a, axis));
        }
        for (std::uint32_t b = 0; b < a; ++b) EXPECT_FALSE(room.overlap(a, (*centres)[a], b, (*centres)[b]));
      }
      EXPECT_EQ(relax_spheres(room, 6106), centres) << "the seed decides";
    }
}

TEST(Relaxation, GivesUpWhereThereIsNoRoom) {
  const SphereRoom room{.box = {{0, 0, 0}, {2, 2, 2}},
                        .periodic = {},
                        .dimensions = 3,
                        .gap = 1e-6,
                        .radii = std::vector<double>(9, 0.5)};
  EXPECT_FALSE(relax_spheres(room, 1)) << "eight fit";
}

}  // namespace
}  // namespace kinesphere::relaxation_test
