// The boxes that a rank knows, and the ranks to which a box must be sent; in periodic space in any image.
#include "distributed/halo_region.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "kinesphere/world_definition.hpp"

namespace kinesphere::halo_region_test {
namespace {

constexpr int here = 1;

Box cube(double lower, double upper) { return {{lower, lower, lower}, {upper, upper, upper}}; }

/// Ranks 0, 1 and 2 know the cubes from 0 to 10, from 10 to 20 and from 20 to 30.
HaloRegions three(const Space& space) {
  HaloRegions known(3, here, space);
  for (int rank = 0; rank < 3; ++rank) known[rank].add(cube(10.0 * rank, 10.0 * rank + 10.0));
  return known;
}

TEST(HaloRegions, CoversOnce) {
  const Space space;
  HaloRegions known = three(space);
  EXPECT_FALSE(known.cover(cube(11, 12)));
  EXPECT_TRUE(known.cover(cube(9, 12)));
  EXPECT_TRUE(known.covers(cube(9, 12)));
  EXPECT_FALSE(known.cover(cube(9, 12)));
  EXPECT_EQ(known.here().boxes().size(), 2u);
  EXPECT_FALSE(known.covers(cube(1, 2))) << "another rank knows it";
}

TEST(HaloRegions, TellsWhichOthersMeet) {
  const Space space;
  const HaloRegions known = three(space);
  EXPECT_EQ(known.ranks_that_meet(cube(11, 12)), std::vector<int>{});
  EXPECT_EQ(known.ranks_that_meet(cube(9, 12)), std::vector<int>{0});
  EXPECT_EQ(known.ranks_that_meet(cube(5, 25)), (std::vector<int>{0, 2}));
  EXPECT_EQ(known.ranks_that_meet(cube(31, 32)), std::vector<int>{});
}

TEST(HaloRegions, KnowsImages) {
  WorldDefinition definition;
  definition.box = cube(0, 30);
  definition.periodic = {true, true, true};
  const Space space(definition);
  HaloRegions known = three(space);
  EXPECT_EQ(known.ranks_that_meet(cube(31, 32)), std::vector<int>{0});
  EXPECT_EQ(known.ranks_that_meet(cube(-2, -1)), std::vector<int>{2});
  EXPECT_EQ(known.ranks_that_meet(cube(28, 32)), (std::vector<int>{0, 2}));
  EXPECT_FALSE(known.cover(cube(-19, -18)));
  EXPECT_TRUE(known.cover(cube(-1, 1)));
}

}  // namespace
}  // namespace kinesphere::halo_region_test
