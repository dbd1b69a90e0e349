// A grid: each swept sphere has a cell, and a search with a point in common reads that cell, however cells
// are folded.
#include "broadphase/grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "kinesphere/random.hpp"
#include "support/bound_cases.hpp"

namespace kinesphere::grid_test {
namespace {

constexpr std::uint64_t seed = 4513;

FloatAabb cube(const std::array<float, 3>& middle, float half) {
  FloatAabb aabb;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    aabb.lower[axis] = middle[axis] - half;
    aabb.upper[axis] = middle[axis] + half;
  }
  return aabb;
}

SweptSphereSpread spread_of(const std::vector<FloatAabb>& all) {
  SweptSphereSpread error;
  for (const FloatAabb& aabb : all) error.add(aabb);
  return error;
}

/// Returns boxes with an edge of 1 in a box of this half edge, without rounding.
std::vector<FloatAabb> crowd(Random& random, std::size_t count, double half_edge) {
  std::vector<FloatAabb> all;
  const auto coordinate = [&] {
    return static_cast<float>(std::floor(64.0 * random.uniform(-half_edge, half_edge)) / 64.0);
  };
  for (std::size_t k = 0; k < count; ++k)
    all.push_back(cube({coordinate(), coordinate(), coordinate()}, 0.5f));
  return all;
}

bool meet(const FloatAabb& a, const FloatAabb& b) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (a.upper[axis] < b.lower[axis] || b.upper[axis] < a.lower[axis]) return false;
  return true;
}

TEST(Grid, SearchesLookAtTheCellsOfAllThatTheyMeet) {
  // Cells for each; so far apart that cells are folded; one so far away that all axes are folded.
  for (const auto& [half_edge, outlier] :
       {std::pair(4.0, 0.0f), std::pair(200.0, 0.0f), std::pair(4.0, 0x1p40f)}) {
    Random random(seed);
    std::vector<FloatAabb> all = crowd(random, 600, half_edge);
    if (outlier > 0.0f) all.push_back(cube({outlier, 0.0f, 0.0f}, 0.5f));
    const Grid grid(spread_of(all), all.size(), 1.0f);
    ASSERT_TRUE(grid.is_valid());
    EXPECT_EQ(grid.edge(), 1.0f);
    EXPECT_LE(grid.cells(), 8 * all.size());
    float reach = 0.0f;
    std::vector<std::uint32_t> cells;
    for (const FloatAabb& aabb : all) {
      const Grid::Cell cell = grid.cell_around(aabb);
      cells.push_back(grid.index_of(cell));
      ASSERT_LT(cells.back(), grid.cells());
      ASSERT_EQ(grid.nearest_image(cells.back(), cell), cell);
      reach = std::max(reach, grid.looseness(cell, aabb));
    }
    std::size_t met = 0, cells_read = 0;
    for (const FloatAabb& query : crowd(random, 100, half_edge)) {
      std::set<std::uint32_t> read;
      const auto range = grid.cells_near(query, reach);
      if (range) {
        std::uint32_t before = 0;
        grid.for_each_row(*range, [&](std::uint32_t first, std::uint32_t last) {
          ASSERT_LT(first, last);
          ASSERT_LE(last, grid.cells());
          ASSERT_TRUE(grid.wraps(*range) || first >= before) << "not in order";
          before = last;
          for (std::uint32_t cell = first; cell < last; ++cell) ASSERT_TRUE(read.insert(cell).second);
        });
      }
      cells_read += read.size();
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (!meet(query, all[k])) continue;
        ++met;
        ASSERT_TRUE(read.contains(cells[k])) << "seed " << seed << ", half edge " << half_edge;
      }
    }
    EXPECT_TRUE(met > 100 || half_edge > 100.0);
    // A box that reaches everywhere reads all cells.
    EXPECT_EQ(cells_read == 100 * grid.cells(), outlier > 0.0f);
  }
}

TEST(Grid, HasOneCellForFew) {
  Random random(seed);
  const Grid grid(spread_of(crowd(random, 32, 1000.0)), 32, 1.0f);
  EXPECT_EQ(grid.cells(), 1u);
  EXPECT_TRUE(grid.cells_near(cube({0x1p20f, 0.0f, 0.0f}, 0.1f), 0.0f));
}

TEST(Grid, LooksNowhereBesidesAllCells) {
  Random random(seed);
  const Grid grid(spread_of(crowd(random, 600, 4.0)), 600, 1.0f);
  EXPECT_FALSE(grid.cells_near(cube({0x1p20f, 0.0f, 0.0f}, 0.1f), 1.0f));
}

TEST(Grid, LooksEverywhereForWhatIsNoNumberOrInfinite) {
  Random random(seed);
  const Grid grid(spread_of(crowd(random, 600, 4.0)), 600, 1.0f);
  constexpr float endless = std::numeric_limits<float>::infinity();
  for (const float odd : {endless, std::numeric_limits<float>::quiet_NaN()}) {
    for (const auto& [query, reach] :
         {std::pair(cube({0.0f, 0.0f, 0.0f}, odd), 0.0f), std::pair(cube({0.0f, 0.0f, 0.0f}, 0.5f), odd)}) {
      std::size_t read = 0;
      const auto range = grid.cells_near(query, reach);
      ASSERT_TRUE(range);
      grid.for_each_row(*range, [&](std::uint32_t first, std::uint32_t last) { read += last - first; });
      EXPECT_EQ(read, grid.cells());
    }
    EXPECT_EQ(grid.looseness({}, cube({0.0f, 0.0f, 0.0f}, odd)), endless);
    FloatAabb odd_on_one_axis = cube({0.0f, 0.0f, 0.0f}, 100.0f);
    odd_on_one_axis.upper[1] = odd;
    EXPECT_EQ(grid.looseness({}, odd_on_one_axis), endless);
  }
}

TEST(Grid, CellsAreCubesCutAlongX) {
  Random random(seed);
  const Grid grid(spread_of(crowd(random, 600, 4.0)), 600, 4.0f);
  const Box box = grid.box_of({1, -1, 0});
  EXPECT_EQ(box.lower, (Vec3{1.0, -4.0, 0.0}));
  EXPECT_EQ(box.upper, (Vec3{2.0, 0.0, 4.0}));
  EXPECT_EQ(grid.edge(), 4.0f);
}

}  // namespace
}  // namespace kinesphere::grid_test
