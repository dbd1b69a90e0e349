#include "lab/index/morton.hpp"

#include <gtest/gtest.h>

namespace kinesphere::morton_test {
namespace {

TEST(Morton, a_coordinate_takes_every_third_bit) {
  EXPECT_EQ(with_gaps(0x3ff), 0x09249249u);
  EXPECT_EQ(with_gaps(0b101), 0b1000001u);
  EXPECT_EQ(morton_key({1, 0, 0}, 1.0), 1u);
  EXPECT_EQ(morton_key({0, 1, 0}, 1.0), 2u);
  EXPECT_EQ(morton_key({0, 0, 1}, 1.0), 4u);
  EXPECT_EQ(morton_key({3, 2, 5}, 1.0), 0b100011101u);
}

TEST(Morton, points_of_a_cell_share_a_key) {
  EXPECT_EQ(morton_key({8.0, 4.0, 0.0}, 4.0), morton_key({11.9, 7.9, 3.9}, 4.0));
  EXPECT_NE(morton_key({8.0, 4.0, 0.0}, 4.0), morton_key({12.0, 4.0, 0.0}, 4.0));
}

TEST(Morton, repeats_after_1024_cells_on_either_side_of_zero) {
  EXPECT_EQ(morton_key({-1.0, -1024.0, 2047.0}, 1.0), morton_key({1023.0, 0.0, 1023.0}, 1.0));
}

TEST(Morton, takes_points_at_any_distance) {
  for (const double far : {0x1p52, 0x1p80, 1e300, -1e300})
    EXPECT_LT(morton_key({far, far, far}, 1e-30), 1u << 30);
}

}  // namespace
}  // namespace kinesphere::morton_test
