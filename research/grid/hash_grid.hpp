// A hierarchical hash grid, which finds the registered boxes that overlap a given box.
//
// The grid covers unbounded space: only cells that hold something exist. Each level has cells four times as
// large as the level below. A box is registered on the finest level with cells at least as large as the box,
// in one cell: that of its lower corner. A search extends its range downward by the largest box of the level,
// for boxes that reach up to it. So radii may differ by any ratio, and a box is moved in O(1). Boxes are
// compared in whole steps of 1/4096 cell, eight at a time.
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
#include "research/grid/box_block.hpp"
#include "research/grid/float_box.hpp"
#include "research/grid/prefetch.hpp"

namespace kinesphere {

class HashGrid {
 public:
  /// Registers body number `body`, or moves it to a new box. Cost: O(1), amortised.
  void set(std::uint32_t body, const Box& box);
  void remove(std::uint32_t body);
  bool contains(std::uint32_t body) const { return body < places_.size() && places_[body].level >= 0; }
  std::size_t size() const { return size_; }
  /// Returns the cell edge of the finest level in use (length): about four times the typical box.
  double finest_edge() const { return std::ldexp(1.0, finest_exponent_); }

  /// Calls visit(body) once for each registered body with a box that overlaps `box`, touching included, and
  /// perhaps for some that miss it by less than a step. `visit` may not change the grid. Cost: the cells that
  /// the box meets, on each level in use, and the boxes in them.
  template <class Visit>
  void for_each_overlap(const Box& box, Visit visit) const;

 private:
  static constexpr int cell_bits = 12;
  static constexpr std::int64_t steps_per_cell = std::int64_t{1} << cell_bits;
  /// Largest coordinate of a box in steps; keeps cell coordinates within 32 bits. A box at distance X counts
  /// as at least X * 2^-24 wide. Queries and infinite boxes may lie farther out and are clamped.
  static constexpr double coordinate_limit = 2147483000.0 * steps_per_cell;

  struct CellIndex {
    std::int32_t x, y, z;
    friend bool operator==(const CellIndex&, const CellIndex&) = default;
  };
  /// A box in whole steps of a level, ends included.
  struct Steps {
    std::array<std::int64_t, 3> lower;
    std::array<std::int64_t, 3> upper;

    /// Returns the cell of the lower corner.
    CellIndex cell() const { return {cell_on(lower[0]), cell_on(lower[1]), cell_on(lower[2])}; }
    StepBox low_bits() const;
    /// Returns true if no side is longer than half the range in which a StepBox can be compared.
    bool is_narrow() const;
    /// Returns the box, clamped below to the begin and above to the end of the cell. Boxes that begin in the
    /// cell overlap the result exactly if they overlap this box.
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
  /// Link is the part of a block that is kept outside it. The bodies of a cell are in a chain of blocks, all
  /// full but the first.
  struct Link {
    std::uint32_t next = none;  ///< the next block of the chain
    std::uint32_t size = 0;     ///< number of places in use
  };
  /// A slot of the hash table of cells.
  struct Slot {
    CellIndex index{};
    std::uint32_t first_block = none;  ///< first block of the cell; none if the slot is free
    bool is_free() const { return first_block == none; }
  };

  class Level {
   public:
    /// `edge` is the cell edge (length), a power of two.
    explicit Level(double edge = 1.0) : steps_per_length_(steps_per_cell / edge) { rehash(); }

    double edge() const { return steps_per_cell / steps_per_length_; }
    std::size_t bodies() const { return bodies_; }

    void insert(const FloatBox& box, std::uint32_t body);
    void erase(const FloatBox& box, std::uint32_t body);
    /// Gives a body another box and returns true, if that box belongs into the same cell; else changes
    /// nothing.
    bool move_in_cell(const FloatBox& from, const FloatBox& to, std::uint32_t body);
    template <class Visit>
    void for_each_overlap(const FloatBox& box, Visit& visit) const;

   private:
    Steps steps_of(const FloatBox& box) const;
    /// Returns the cell in which a box is registered.
    CellIndex cell_of(const FloatBox& box) const;
    /// Returns a position in whole steps, rounded down and clamped to the range of cell coordinates.
    std::int64_t step_at(float position) const {
      double steps = position * steps_per_length_;
      if (!(std::abs(steps) <= coordinate_limit)) steps = outermost(position);
      const auto towards_zero = static_cast<std::int64_t>(steps);
      return towards_zero - static_cast<std::int64_t>(steps < static_cast<double>(towards_zero));
    }
    double outermost(float position) const;
    /// Returns the cells in which boxes that overlap this one are registered.
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
    /// Returns the slot of the cell, or the free slot in which it would be inserted.
    std::size_t slot_of(const CellIndex& index, std::uint64_t hashed, int shift) const {
      auto slot = static_cast<std::size_t>(hashed >> shift);
      while (!slots_[slot].is_free() && !(slots_[slot].index == index))
        slot = (slot + 1) & (slots_.size() - 1);
      return slot;
    }
    std::size_t slot_of(const CellIndex& index) const { return slot_of(index, hash(index), hash_shift()); }
    /// The slot, block and place of a registered body.
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
    std::array<std::int64_t, 3> reach_{};  ///< largest extent of any box since the level was made (steps)
    std::size_t bodies_ = 0;
    std::size_t cells_ = 0;  ///< number of cells in the table
    std::size_t empty_cells_ = 0;
    std::vector<BoxBlock> blocks_;
    std::vector<Link> links_;  ///< one per block; kept apart so that they are cached before the blocks are
    std::vector<std::uint32_t> free_blocks_;
    std::vector<Slot> slots_;  ///< hash table of cells, open addressing
  };
  static constexpr std::int16_t nowhere = -1;
  struct Place {
    std::int16_t level = nowhere;
    std::int16_t size = 0;  ///< result of size_of()
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
  /// Resolution of size_of(): an octave counts as 2^octave_bits.
  static constexpr int octave_bits = 4;

  std::vector<Level> levels_;
  std::vector<Place> places_;
  std::size_t size_ = 0;
  int finest_exponent_ = 0;    ///< log2 of the cell edge on level 0
  std::int64_t size_sum_ = 0;  ///< sum of the sizes of all registered boxes
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
  // Blocks found in cells, prefetched together and visited once 64 are found or the search ends.
  std::array<std::uint32_t, 64> found;
  std::size_t found_count = 0;
  const auto visit_found = [&](const BoxBlock::Query& query) {
    // Overlaps of several blocks are gathered into one bit set: most blocks have none, and a branch for each
    // block would be mispredicted.
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
      // A free slot has no blocks, so it needs no test.
      for (std::int32_t x = range.first.x; x <= range.last.x; ++x, hashed += step_x)
        find_blocks(slots_[slot_of({x, y, z}, hashed, shift)], query);
    }
  visit_found(query);
}

}  // namespace kinesphere
