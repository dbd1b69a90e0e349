// The order of cells is Z-order, and cells contain each other as their edges say.
#include "research/rivals/event_driven/cell.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <ostream>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::cell_test {

void showValue(const Cell& cell, std::ostream& out) {
  out << "level " << cell.level << " (" << cell.index[0] << ", " << cell.index[1] << ", " << cell.index[2]
      << ")";
}

namespace {

constexpr std::uint64_t seed = 3101;

/// Returns the bits of the three indices interleaved, the most significant first and sign bits flipped.
std::vector<bool> interleaved(const Cell& cell) {
  std::vector<bool> bits;
  for (int bit = 63; bit >= 0; --bit)
    for (const std::int64_t index : cell.index) {
      const bool set = (static_cast<std::uint64_t>(index) >> bit & 1u) != 0;
      bits.push_back(bit == 63 ? !set : set);
    }
  return bits;
}

Cell random_cell(Random& random, int level, int bits) {
  Cell cell{level, {}};
  for (std::int64_t& index : cell.index) {
    const auto magnitude = static_cast<std::int64_t>(random.bits() >> (64 - bits));
    index = random.bits() % 2 == 0 ? magnitude : -1 - magnitude;
  }
  return cell;
}

TEST(CellOrder, is_that_of_interleaved_bits) {
  for (std::uint64_t k = 0; k < 20000; ++k) {
    Random random = Random::at(seed, k, 0);
    const int bits = 1 + static_cast<int>(random.bits() % 44);
    const Cell a = random_cell(random, 3, bits);
    Cell b = random_cell(random, 3, bits);
    // The test includes pairs that differ little.
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (random.bits() % 2 == 0) b.index[axis] = a.index[axis] + (random.bits() % 3 == 0 ? 1 : 0);
    ASSERT_EQ(a < b, interleaved(a) < interleaved(b)) << "seed " << seed << ", case " << k;
    ASSERT_EQ(b < a, interleaved(b) < interleaved(a)) << "seed " << seed << ", case " << k;
  }
}

TEST(CellOrder, goes_by_level_first) {
  EXPECT_LT((Cell{0, {5, 5, 5}}), (Cell{1, {-5, 0, 0}}));
  EXPECT_FALSE((Cell{1, {-5, 0, 0}}) < (Cell{0, {5, 5, 5}}));
}

RC_GTEST_PROP(CellOrder, keeps_the_subcells_of_a_cell_together,
              (std::int8_t x, std::int8_t y, std::int8_t z)) {
  // Compares all cells of a block of 2 x 2 x 2 cells and their surroundings, 4 x 4 x 4 subcells each.
  const auto parent_of = [](const Cell& cell) {
    return Cell{2, {cell.index[0] >> 2, cell.index[1] >> 2, cell.index[2] >> 2}};
  };
  std::vector<Cell> cells;
  CellRange{0, {4 * x - 4, 4 * y - 4, 4 * z - 4}, {4 * x + 7, 4 * y + 7, 4 * z + 7}}.for_each_cell(
      [&](const Cell& cell) { cells.push_back(cell); });
  std::sort(cells.begin(), cells.end());
  std::size_t changes = 0;
  for (std::size_t k = 1; k < cells.size(); ++k) changes += !(parent_of(cells[k]) == parent_of(cells[k - 1]));
  RC_ASSERT(changes == 26u);
}

TEST(CellRange, visits_each_cell_once) {
  const CellRange range{2, {-1, 3, 0}, {1, 4, 0}};
  std::vector<Cell> cells;
  range.for_each_cell([&](const Cell& cell) { cells.push_back(cell); });
  EXPECT_EQ(cells.size(), 6u);
  for (const Cell& cell : cells) {
    EXPECT_TRUE(range.contains(cell));
    EXPECT_EQ(std::count(cells.begin(), cells.end(), cell), 1);
  }
  EXPECT_FALSE(range.contains({2, {2, 3, 0}}));
  EXPECT_FALSE(range.contains({2, {0, 2, 0}}));
  EXPECT_FALSE(range.contains({1, {0, 3, 0}}));
}

/// The reference compares the finest cells that make up the two.
TEST(Intersect, is_to_have_a_finest_cell_in_common) {
  const auto finest = [](const CellRange& range) {
    CellRange fine{0, range.first, range.last};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      fine.first[axis] = range.first[axis] * (1 << range.level);
      fine.last[axis] = (range.last[axis] + 1) * (1 << range.level) - 1;
    }
    return fine;
  };
  int intersections = 0;
  for (std::uint64_t k = 0; k < 20000; ++k) {
    Random random = Random::at(seed, k, 1);
    const auto draw = [&] {
      CellRange range{static_cast<int>(random.bits() % 4), {}, {}};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        range.first[axis] =
            static_cast<std::int64_t>(random.bits() % 32) / (1 << range.level) - 16 / (1 << range.level);
        range.last[axis] = range.first[axis] + static_cast<std::int64_t>(random.bits() % 2);
      }
      return range;
    };
    const CellRange a = draw();
    const CellRange b = draw();
    bool expected = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      expected = expected && finest(a).first[axis] <= finest(b).last[axis] &&
                 finest(b).first[axis] <= finest(a).last[axis];
    ASSERT_EQ(intersect(a, b), expected) << "seed " << seed << ", case " << k;
    ASSERT_EQ(intersect(b, a), expected) << "seed " << seed << ", case " << k;
    intersections += expected;
  }
  EXPECT_GT(intersections, 200);
}

}  // namespace
}  // namespace kinesphere::cell_test
