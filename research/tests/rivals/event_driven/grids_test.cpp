// Every coordinate lies in exactly one cell of each level, consistently between levels.
#include "research/rivals/event_driven/grids.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::grids_test {
namespace {

constexpr std::uint64_t seed = 3102;

/// Returns anything from tiny to infinite, often on a plane of the grid or next to one.
double random_coordinate(Random& random, const Grids& grids) {
  const int level = static_cast<int>(random.bits() % (Grids::coarsest_level + 1));
  const auto index = static_cast<std::int64_t>(random.bits() >> (20 + random.bits() % 43));
  const double plane = static_cast<double>(random.bits() % 2 == 0 ? index : -index) * grids.edge(level);
  switch (random.bits() % 5) {
    case 0:
      return plane;
    case 1:
      return std::nextafter(plane, infinity);
    case 2:
      return std::nextafter(plane, -infinity);
    case 3:
      return std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.bits() % 2000) - 1000);
    default:
      return plane + grids.edge(level) * random.uniform();
  }
}

TEST(Grids, hold_each_coordinate_in_one_cell_within_its_parent) {
  for (std::uint64_t k = 0; k < 50000; ++k) {
    Random random = Random::at(seed, k, 0);
    const Grids grids(std::ldexp(random.uniform(0.5, 1.0), static_cast<int>(random.bits() % 60) - 30));
    const double x = random_coordinate(random, grids);
    std::int64_t finer = 0;
    for (int level = 0; level <= Grids::coarsest_level; ++level) {
      const std::int64_t index = grids.index_of(level, x);
      ASSERT_LE(grids.plane(level, index), x) << "seed " << seed << ", case " << k << ", level " << level;
      ASSERT_LT(x, grids.plane(level, index + 1)) << "seed " << seed << ", case " << k << ", level " << level;
      if (level > 0) {
        ASSERT_EQ(index, finer >> 1) << "seed " << seed << ", case " << k << ", level " << level;
      }
      finer = index;
    }
    ASSERT_TRUE(finer == 0 || finer == -1);
  }
}

TEST(Grids, reach_to_infinity) {
  const Grids grids(1.0);
  for (const double x : {1e13, 1e300, infinity}) {
    EXPECT_EQ(grids.index_of(0, x), (std::int64_t{1} << 43) - 1);
    EXPECT_EQ(grids.index_of(0, -x), -(std::int64_t{1} << 43));
    EXPECT_EQ(grids.index_of(Grids::coarsest_level, x), 0);
    EXPECT_EQ(grids.index_of(Grids::coarsest_level, -x), -1);
  }
  EXPECT_EQ(grids.plane(0, std::int64_t{1} << 43), infinity);
  EXPECT_EQ(grids.plane(0, -(std::int64_t{1} << 43)), -infinity);
  EXPECT_EQ(grids.plane(Grids::coarsest_level, 0), 0.0);
  EXPECT_EQ(grids.plane(Grids::coarsest_level, 1), infinity);
}

TEST(Grids, put_a_sphere_where_it_is_at_most_half_as_wide_as_the_cells) {
  const Grids grids(4.0);
  EXPECT_EQ(grids.level_for(0.0), 0);
  EXPECT_EQ(grids.level_for(2.0), 0);
  EXPECT_EQ(grids.level_for(std::nextafter(2.0, 3.0)), 1);
  EXPECT_EQ(grids.level_for(16.0), 3);
  EXPECT_EQ(grids.level_for(1e300), Grids::coarsest_level);
}

}  // namespace
}  // namespace kinesphere::grids_test
