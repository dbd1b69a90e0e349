// A hierarchical hash grid: which registered boxes overlap a given one?
//
// Unbounded space: only cells that hold something exist. Each level has cells four times as large as the one
// below. A box lies on the finest level whose cells are at least as large as the box, in the one cell where
// its lower corner is; a search looks farther down by the largest box of the level, for those that reach up
// to it. So radii may differ by any ratio, and a box is moved in O(1). Boxes are compared in whole steps of
// 1/4096 cell, eight at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "kinesphere/vec3.hpp"
#include "simulation/grid/box_block.hpp"
#include "simulation/grid/float_box.hpp"
#include "simulation/grid/prefetch.hpp"

namespace kinesphere {

class HashGrid {
 public:
  /// Registers body number `body`, or moves it to a new box. Cost: O(1), amortised.
  void set(std::uint32_t body, const Box& box);
  void remove(std::uint32_t body);
  bool contains(std::uint32_t body) const { return body < places_.size() && places_[body].level >= 0; }
  std::size_t size() const { return size_; }
  /// Of the cells on the finest level in use: about four times the typical box (length).
  double finest_edge() const { return std::ldexp(1.0, finest_exponent_); }

  /// Calls visit(body) once for each registered body whose box
  /// overlaps `box`, touching included, and perhaps for some that it misses by less than a step. `visit` may
  /// not change the grid. Cost: the cells that the box meets, on each level in use, and what they hold.
  template <class Visit>
  void for_each_overlap(const Box& box, Visit visit) const;

 private:
  static constexpr int cell_bits = 12;
  static constexpr std::int64_t steps_per_cell = std::int64_t{1} << cell_bits;
  /// Cell coordinates stay within 32 bits: a box at distance X counts as at least X * 2^-24 wide. What a
  /// search looks for may lie farther out, and endless boxes do.
  static constexpr double coordinate_limit = 2147483000.0 * steps_per_cell;

  struct CellIndex {
    std::int32_t x, y, z;
    friend bool operator==(const CellIndex&, const CellIndex&) = default;
  };
  /// A box in steps of a level, ends included.
  struct Steps {
    std::array<std::int64_t, 3> lower;
    std::array<std::int64_t, 3> upper;

    /// The cell of the lower corner.
    CellIndex cell() const { return {cell_on(lower[0]), cell_on(lower[1]), cell_on(lower[2])}; }
    StepBox low_bits() const;
    /// No wider than half of what a StepBox can be compared over.
    bool is_narrow() const;
    /// The same for boxes that begin in the cell: its part between them and the end of the cell.
    Steps seen_from(const CellIndex& cell) const;
    static std::int32_t cell_on(std::int64_t step) { return static_cast<std::int32_t>(step >> cell_bits); }
  };
  struct CellRange {
    CellIndex first, last;
    double count() const;
    bool contains(const CellIndex& at) const {
      return first.x <= at.x && at.x <= last.x && first.y <= at.y && at.y <= last.y && first.z <= at.z &&
             at.z <= last.z;
    }
  };
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  /// What belongs to a block of boxes. The bodies of a cell stand in a chain of blocks, all of which but the
  /// first one are full.
  struct Link {
    std::uint32_t next = none;  ///< the block behind it
    std::uint32_t size = 0;     ///< how many places are in use
  };
  /// Of the table of cells.
  struct Slot {
    CellIndex index{};
    std::uint32_t first_block = none;  ///< of the cell; none: the slot is free
    bool is_free() const { return first_block == none; }
  };

  class Level {
   public:
    /// Cells of this edge, a power of two (length).
    explicit Level(double edge = 1.0) : steps_per_length_(steps_per_cell / edge) { rehash(); }

    double edge() const { return steps_per_cell / steps_per_length_; }
    std::size_t bodies() const { return bodies_; }

    void insert(const FloatBox& box, std::uint32_t body);
    void erase(const FloatBox& box, std::uint32_t body);
    /// Gives a body another box, if that belongs into the same cell.
    bool move_in_cell(const FloatBox& from, const FloatBox& to, std::uint32_t body);
    template <class Visit>
    void for_each_overlap(const FloatBox& box, Visit& visit) const;

   private:
    Steps steps_of(const FloatBox& box) const;
    /// Where a box is registered.
    CellIndex cell_of(const FloatBox& box) const;
    /// A position in whole steps, rounded down, within what cell coordinates can hold.
    std::int64_t step_at(float position) const {
      double steps = position * steps_per_length_;
      if (!(std::abs(steps) <= coordinate_limit)) steps = outermost(position);
      const auto towards_zero = static_cast<std::int64_t>(steps);
      return towards_zero - static_cast<std::int64_t>(steps < static_cast<double>(towards_zero));
    }
    double outermost(float position) const;
    /// The cells in which boxes that overlap this one are registered.
    CellRange cells_around(const Steps& box) const;

    /// Fibonacci hashing: the high bits of a sum of products, so that the next cell costs one addition.
    static constexpr std::uint64_t step_x = 0x9e3779b97f4a7c15u;
    static constexpr std::uint64_t step_y = 0xc2b2ae3d27d4eb4fu;
    static constexpr std::uint64_t step_z = 0x165667b19e3779f9u;
    static std::uint64_t hash(const CellIndex& index) {
      return static_cast<std::uint64_t>(index.x) * step_x + static_cast<std::uint64_t>(index.y) * step_y +
             static_cast<std::uint64_t>(index.z) * step_z;
    }
    int hash_shift() const { return 64 - std::countr_zero(slots_.size()); }
    /// The slot of the cell, or the free one where it would be.
    std::size_t slot_of(const CellIndex& index, std::uint64_t hashed, int shift) const {
      auto slot = static_cast<std::size_t>(hashed >> shift);
      while (!slots_[slot].is_free() && !(slots_[slot].index == index))
        slot = (slot + 1) & (slots_.size() - 1);
      return slot;
    }
    std::size_t slot_of(const CellIndex& index) const { return slot_of(index, hash(index), hash_shift()); }
    /// Where a body stands.
    struct Standing {
      std::size_t slot;
      std::uint32_t block;
      std::size_t place;
    };
    Standing find(const CellIndex& index, std::uint32_t body) const;
    void widen_reach(const Steps& steps);
    std::uint32_t take_block();
    void rehash();

    double steps_per_length_;
    std::array<std::int64_t, 3> reach_{};  ///< no box has been wider since the level was made (steps)
    std::size_t bodies_ = 0;
    std::size_t cells_ = 0;  ///< those in the table
    std::size_t empty_cells_ = 0;
    std::vector<BoxBlock> blocks_;
    std::vector<Link> links_;  ///< of the blocks: apart from them, to be in the cache before they are
    std::vector<std::uint32_t> free_blocks_;
    std::vector<Slot> slots_;  ///< open addressing
  };
  static constexpr std::int16_t nowhere = -1;
  struct Place {
    std::int16_t level = nowhere;
    std::int16_t size = 0;  ///< as size_of()
    FloatBox box{};
    friend bool operator==(const Place&, const Place&) = default;
  };

  static float width_of(const FloatBox& box);
  Place place_for(const FloatBox& box) const;
  double edge_of(std::size_t level) const;
  void insert(std::uint32_t body, const Place& place);
  void retune_if_worthwhile();

  static int exponent_of(float width);
  static std::int16_t size_of(float width);
  /// In size_of() an octave counts as 2^4.
  static constexpr int octave_bits = 4;

  std::vector<Level> levels_;
  std::vector<Place> places_;
  std::size_t size_ = 0;
  int finest_exponent_ = 0;    ///< log2 of the edge on level 0
  std::int64_t size_sum_ = 0;  ///< of the sizes of all registered boxes
  std::size_t changes_since_tuning_ = 0;
};

template <class Visit>
void HashGrid::for_each_overlap(const Box& box, Visit visit) const {
  const FloatBox query(box);
  for (const Level& level : levels_)
    if (level.bodies() > 0) level.for_each_overlap(query, visit);
}

template <class Visit>
void HashGrid::Level::for_each_overlap(const FloatBox& box, Visit& visit) const {
  const Steps steps = steps_of(box);
  const CellRange range = cells_around(steps);
  // The blocks of some cells come into the cache together.
  std::array<std::uint32_t, 64> found;
  std::size_t found_count = 0;
  const auto visit_found = [&](const BoxBlock::Query& query) {
    // What overlaps in some blocks is visited together: most have nothing, which nobody can foresee.
    constexpr std::size_t together = 64 / BoxBlock::width;
    for (std::size_t first = 0; first < found_count; first += together) {
      const std::size_t end = std::min(first + together, found_count);
      std::uint64_t overlapping = 0;
      for (std::size_t k = first; k < end; ++k) {
        const std::uint32_t block = found[k];
        const BoxBlock::Places places =
            blocks_[block].overlapping(query) & BoxBlock::first(links_[block].size);
        overlapping |= static_cast<std::uint64_t>(places) << (k - first) * BoxBlock::width;
      }
      for (; overlapping != 0; overlapping &= overlapping - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(overlapping));
        const BoxBlock& boxes = blocks_[found[first + bit / BoxBlock::width]];
        const std::size_t place = bit % BoxBlock::width;
        visit(boxes.body(place));
      }
    }
    found_count = 0;
  };
  const auto find_blocks = [&](const Slot& cell, const BoxBlock::Query& query) {
    for (std::uint32_t block = cell.first_block; block != none; block = links_[block].next) {
      prefetch(blocks_[block]);
      found[found_count++] = block;
      if (found_count == found.size()) visit_found(query);
    }
  };
  if (range.count() > static_cast<double>(cells_) || !steps.is_narrow()) {
    for (const Slot& slot : slots_) {
      if (slot.is_free() || !range.contains(slot.index)) continue;
      const BoxBlock::Query part(steps.seen_from(slot.index).low_bits());
      find_blocks(slot, part);
      visit_found(part);
    }
    return;
  }
  const BoxBlock::Query query(steps.low_bits());
  const int shift = hash_shift();
  for (std::int32_t z = range.first.z; z <= range.last.z; ++z)
    for (std::int32_t y = range.first.y; y <= range.last.y; ++y) {
      std::uint64_t hashed = hash({range.first.x, y, z});
      // A free slot has no blocks.
      for (std::int32_t x = range.first.x; x <= range.last.x; ++x, hashed += step_x)
        find_blocks(slots_[slot_of({x, y, z}, hashed, shift)], query);
    }
  visit_found(query);
}

}  // namespace kinesphere
