// RegionCells finds the safe regions within reach of a safe region.
//
// A region's `reach` is its radius with that of its ball and the tolerance: two balls are neighbours if the
// centres of their regions are no farther apart than the sum of their reaches. Regions of similar reach form
// a level, which divides space into cells of one width. The regions of a cell are in one of the chains of
// blocks, eight to a block. The chains of cells that follow each other on x do so, too. If there are chains
// enough for all cells of a level, each has its own; otherwise strides are such that the cells of a search
// seldom share one. Regions of other cells in a chain cost time, and may be found twice.
//
// Lengths are in region units (Core), and coordinates of centres are single-precision numbers, so that they
// are exact here. The comparison is to the safe side: reaches are raised by more than its rounding. So the
// widths of cells influence the cost of a search only, not what it finds.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/balls.hpp"
#include "core/near_lanes.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere::core {

/// The memory of a search, to reuse, and what it has found.
struct RegionSearch {
  RegionQuery query;
  bool crosses = false;               ///< some may be within reach in another image only
  std::vector<std::uint32_t> places;  ///< of blocks to search, of which there are `count`
  std::size_t count = 0;
  std::span<std::uint32_t> found;   ///< balls, in any order
  bool may_repeat = false;          ///< some of them may have been found more than once
  std::vector<std::uint32_t> room;  ///< for those found

  /// Leaves each of those found once.
  void drop_repeats() {
    if (!may_repeat) return;
    std::sort(found.begin(), found.end());
    found = found.first(static_cast<std::size_t>(std::unique(found.begin(), found.end()) - found.begin()));
    may_repeat = false;
  }
  /// Makes room for so many places more.
  void reserve(std::size_t more) {
    if (places.size() < count + more) places.resize(2 * (count + more));
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
  /// Enters the safe region of a ball as enter() does, but no search is possible before sort(): for many.
  void add_unsorted(Balls& balls, std::uint32_t ball, float reach);
  /// Puts all regions into cells, whose widths suit them. All slots change. Cost: O(n).
  void sort(Balls& balls);
  /// Fetches what enter() will read.
  void prefetch(const Ball& ball, float reach) const;
  /// Returns the reach with which the region in this slot was entered.
  float reach_of(std::uint32_t slot) const { return blocks_[slot / lanes].reach[slot % lanes]; }
  /// Finds all balls whose regions come within reach of that of `ball`.
  void search(const Ball& ball, float reach, RegionSearch& search) const {
    start_search(ball, reach, search);
    finish_search(search);
  }
  /// The same in two steps. The first one fetches what the second one reads; nothing may enter or leave in
  /// between.
  void start_search(const Ball& ball, float reach, RegionSearch& search) const;
  void finish_search(RegionSearch& search) const;
  /// Returns true if a search finds the one by the other. The reaches are those of the two.
  bool are_near(const Ball& a, float reach_of_a, const Ball& b, float reach_of_b) const;
  /// Chooses levels and the widths of cells anew, for the regions that there are. All slots change. Cost:
  /// O(n). Regions that enter do so by themselves, every now and then.
  void rebuild(Balls& balls);
  /// Returns the median reach of the regions when levels were chosen (region units).
  double median_reach() const { return double{median_}; }
  /// Returns the cells that are not empty (region units), each with the number of regions in it.
  std::vector<std::pair<Box, std::size_t>> filled() const;
  std::size_t bytes() const {
    return blocks_.capacity() * sizeof(RegionBlock) + balls_.capacity() * sizeof(BallBlock) +
           links_.capacity() * sizeof(Link);
  }

 private:
  static constexpr std::uint32_t lanes = RegionBlock::lanes;
  static constexpr std::size_t most_levels = 16;

  struct Link {
    std::uint32_t next = none;  ///< block of the same chain
    std::uint32_t count = 0;    ///< regions in this one
  };
  /// Cells on an axis.
  struct Range {
    std::int64_t first = std::int64_t{1} << 61, last = -first;

    bool contains(std::int64_t cell) const { return first <= cell && cell <= last; }
    double count() const { return static_cast<double>(last - first) + 1.0; }
  };
  /// An axis of a level.
  struct Axis {
    double width = 1.0, by_width = 1.0;  ///< of cells
    std::int64_t count = 0;              ///< of cells, if the axis repeats
    Range filled;                        ///< cells in which there have been regions
    Range reserved;                      ///< cells that have chains of their own
    std::uint32_t stride = 1;            ///< from the chain of a cell to that of the next one
  };
  struct Level {
    float top = std::numeric_limits<float>::infinity();  ///< reaches are below it
    std::uint32_t regions = 0;
    float largest_reach = 0.0F;
    double width = 1.0;
    std::array<Axis, 3> axes;
    std::uint32_t origin = 0;  ///< chain of the cell 0, 0, 0
    bool shares = true;        ///< cells of a search may share a chain
  };

  // region_cells.cpp
  std::size_t level_of(float reach) const;
  std::array<std::int64_t, 3> cell_of(const Level& level, float x, float y, float z) const;
  std::uint32_t chain_of(const Level& level, const std::array<std::int64_t, 3>& cell) const;
  std::uint32_t within_table(std::uint32_t chain) const {
    chain &= mask_;
    return chain < chains_ ? chain : chain - chains_;
  }
  void insert(Balls& balls, std::uint32_t ball, float reach);
  void put(Balls& balls, std::uint32_t ball, float reach, std::uint32_t place);
  void add_blocks(std::size_t count);
  std::array<Range, 3> cells_near(const Level& level, const RegionQuery& query) const;
  /// A cell on an axis, as a search sees it.
  struct Step {
    std::uint32_t chains;
    double away;
  };
  static constexpr std::size_t most_steps = 16;
  static std::span<const Step> steps_on(const Axis& axis, const Range& range, std::int64_t first, float at,
                                        double far, std::array<Step, most_steps>& steps);
  void list_cells(const Level& level, const std::array<Range, 3>& near, RegionSearch& search) const;
  void list_all(RegionSearch& search) const;
  void follow_chains(RegionSearch& search) const;

  // cell_sizes.cpp
  /// Calls visit(block, lane, ball) for each region.
  void for_each_region(auto visit) const {
    for (std::size_t place = 0; place < blocks_.size(); ++place)
      for (std::uint32_t lane = 0; lane < links_[place].count; ++lane)
        visit(blocks_[place], lane, balls_[place].balls[lane]);
  }
  std::pair<float, float> typical_reaches() const;
  bool levels_suit() const;
  void choose_levels();
  void refine(Balls& balls);
  void set_width(Level& level, double width);
  std::vector<std::uint32_t> sample() const;
  /// Some regions of a level, and how many there are in their cells.
  struct Crowding {
    double regions = 0.0, in_cells = 0.0;
  };
  Crowding crowding(std::size_t number, const std::vector<std::uint32_t>& some) const;
  double wanted_width(const Level& level, double narrowest, const Crowding& crowd) const;
  void insert_all(Balls& balls);
  void choose_chains();
  double reserve_cells(Level& level) const;

  Vec3 period_;
  FloatPeriods float_periods_;
  int dimensions_;
  std::array<Level, most_levels> levels_;
  // Blocks: the first ones of all chains, then further ones.
  std::vector<RegionBlock> blocks_;
  std::vector<BallBlock> balls_;
  std::vector<Link> links_;
  std::uint32_t chains_ = 64;
  std::uint32_t mask_ = 63;  ///< the least power of two that is not less, less 1
  std::size_t regions_ = 0, entered_ = 0;
  std::size_t built_for_ = 0;  ///< regions when chains were chosen
  float median_ = 0.0F;        ///< reach, when levels were chosen
};

}  // namespace kinesphere::core
