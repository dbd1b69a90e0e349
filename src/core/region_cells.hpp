// RegionCells finds the safe regions within reach of a safe region.
//
// A region's `reach` is its radius with that of its ball and the tolerance: two balls are neighbours if the
// centres of their regions are no farther apart than the sum of their reaches. Regions of similar reach,
// within a factor of four, form a level, which divides space into cells of one width. A cell is a chain of
// blocks of eight regions. The first blocks of all cells are in one hash table, in which cells that follow
// each other on x are neighbours.
//
// Lengths are in region units (Core), and coordinates of centres are single-precision numbers, so that they
// are exact here. The comparison is to the safe side: reaches are raised by more than its rounding. So the
// widths of cells influence the cost of a search only, not what it finds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/balls.hpp"
#include "core/near_lanes.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere::core {

/// The memory of a search, to reuse, and what it has found.
struct RegionSearch {
  struct Cell {
    std::uint64_t name;
    std::uint32_t head;
  };
  std::vector<Cell> cells;            ///< to search, of which there are `listed`
  std::vector<std::uint32_t> places;  ///< of blocks to search, of which there are `count`
  std::size_t listed = 0, count = 0;
  std::vector<std::uint32_t> found;  ///< balls, in any order

  void add_place(std::uint32_t place) {
    if (count == places.size()) places.resize(2 * count + 64);
    places[count++] = place;
  }
};

class RegionCells {
 public:
  /// `period`: of the space, in region units; 0 on axes that do not repeat. `dimensions`: 2 or 3.
  RegionCells(const Vec3& period, int dimensions);

  /// Returns a reach that covers the rounding of comparisons. All reaches below are raised.
  static float raised(float reach) { return reach * (1.0F + 0x1p-18F); }
  /// Enters the safe region of a ball, and sets its slot. `reach` > 0.
  void enter(Balls& balls, std::uint32_t ball, float reach);
  void leave(Balls& balls, std::uint32_t ball);
  /// Fetches what enter() will read.
  void prefetch(const Ball& ball, float reach) const;
  /// Returns the reach with which the region in this slot was entered.
  float reach_of(std::uint32_t slot) const { return blocks_[slot / lanes].reach[slot % lanes]; }
  /// Finds all balls whose regions come within reach of that of `ball`.
  void search(const Ball& ball, float reach, RegionSearch& search) const;
  /// Returns true if a search finds the one by the other. The reaches are those of the two.
  bool are_near(const Ball& a, float reach_of_a, const Ball& b, float reach_of_b) const;
  /// Chooses levels and the widths of cells anew, for the regions that there are. All slots change. Cost:
  /// O(n). Regions that enter do so by themselves, every now and then.
  void rebuild(Balls& balls);
  /// Returns the median reach of the regions when levels were chosen (region units).
  double median_reach() const { return double{median_}; }
  /// Returns the cells that are not empty (region units), each with the number of regions in it.
  std::vector<std::pair<Box, std::size_t>> filled() const;
  std::size_t bytes() const { return blocks_.capacity() * sizeof(RegionBlock); }

 private:
  static constexpr std::uint32_t lanes = RegionBlock::lanes;
  static constexpr std::size_t most_levels = 16;
  static constexpr double wanted_in_cell = 7.0;

  struct Level {
    float top = std::numeric_limits<float>::infinity();  ///< reaches are below it
    std::uint32_t regions = 0;
    float largest_reach = 0.0F;
    double width = 1.0;
    std::array<double, 3> by_width{1.0, 1.0, 1.0};
    std::array<std::int64_t, 3> count{};  ///< cells of each axis that repeats
  };
  struct Range {
    std::int64_t first, last;
    double count() const { return static_cast<double>(last - first) + 1.0; }
  };
  struct Entry {
    std::uint32_t ball;
    float reach;
  };

  std::size_t level_of(float reach) const;
  void set_width(Level& level, double width);
  std::int64_t cell_on(const Level& level, int axis, double x) const;
  Range range_on(const Level& level, int axis, double x, double reach) const;
  std::pair<std::uint64_t, std::uint32_t> cell_of(const Ball& ball, float reach) const;
  void insert(Balls& balls, std::uint32_t ball, float reach);
  bool list_cells(std::size_t number, const RegionQuery& query, RegionSearch& search) const;
  void list_blocks(RegionSearch& search) const;
  std::vector<Entry> entries() const;
  double crowding(std::size_t level) const;
  double wanted_width(std::size_t number, double narrowest) const;
  void insert_all(Balls& balls, const std::vector<Entry>& all);

  Vec3 period_;
  FloatPeriods float_periods_;
  int dimensions_;
  std::array<Level, most_levels> levels_;
  std::vector<RegionBlock> blocks_;  ///< the hash table, then further blocks
  std::uint32_t mask_;               ///< length of the hash table, less 1
  std::size_t regions_ = 0, entered_ = 0;
  float median_ = 0.0F;  ///< reach, when levels were chosen
};

}  // namespace kinesphere::core
