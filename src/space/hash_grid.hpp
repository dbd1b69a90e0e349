// A hierarchical hash grid: which registered boxes overlap a given one?
//
// Unbounded space: only cells that hold something exist. Each level has cells four times as large as the one
// below. A box lies on the finest level whose cells are at least as large as the box, in the one cell where
// its lower corner is; a search looks farther down by the largest box of the level, for those that reach up
// to it. So radii may differ by any ratio, and a box is moved in O(1). Boxes are kept as floats, rounded
// outward.
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
#include "space/box_block.hpp"

namespace kinesphere {

class HashGrid {
 public:
  /// Registers body number `body`, or moves it to a new box. Cost: O(1), amortised.
  void set(std::uint32_t body, const Box& box);
  void remove(std::uint32_t body);
  bool contains(std::uint32_t body) const { return body < places_.size() && places_[body].level >= 0; }
  std::size_t size() const { return size_; }
  /// Of the cells on the finest level in use: about twice the typical box (length).
  double finest_edge() const { return std::ldexp(1.0, finest_exponent_); }

  /// No registered box is wider on any axis (length).
  double largest_extent() const;

  /// Calls visit(body) or visit(body, FloatBox of it) once for each registered body whose box overlaps `box`,
  /// touching included. `visit` may not change the grid. Cost: the cells that the box meets, on each level in
  /// use, and what they hold.
  template <class Visit>
  void for_each_overlap(const Box& box, Visit visit) const;

  /// Calls visit(Box, number of bodies) for each cell that holds something, level by level. The boxes of its
  /// bodies begin in it.
  template <class Visit>
  void for_each_cell(Visit visit) const;

  /// What is wrong with the body's registration, if anything: it must stand, as `box`, in the cell of its
  /// lower corner and in no other. Cost: all cells.
  std::optional<std::string> check(std::uint32_t body, const Box& box) const;

  /// Everything as it is, for a search visits bodies in the order in which cells and entries stand, and when
  /// cells are dropped depends on how many are empty and on the size of the table.
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [levels, places, size, finest_exponent, size_sum, changes] = self;
    archive(levels, places, size, finest_exponent, size_sum, changes);
  }
  /// For one that was read: true when it could have come about by registrations. Cost: all cells.
  bool is_sound() const;

 private:
  /// Cell coordinates stay within 32 bits: a float box at distance X is at least X * 2^-24 wide, and so are
  /// its cells. Where it is a mere point all that lies farther shares the outermost cell.
  static constexpr double coordinate_limit = 2147483000.0;

  struct CellIndex {
    std::int32_t x, y, z;
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [i, j, k] = self;
      archive(i, j, k);
    }
    friend bool operator==(const CellIndex&, const CellIndex&) = default;
  };
  struct CellRange {
    CellIndex first, last;
    friend bool operator==(const CellRange&, const CellRange&) = default;
    double count() const;
    bool contains(const CellIndex& at) const {
      return first.x <= at.x && at.x <= last.x && first.y <= at.y && at.y <= last.y && first.z <= at.z &&
             at.z <= last.z;
    }
  };
  struct Cell {
    CellIndex index;
    std::uint32_t size;  ///< the bodies, in the first places of the blocks
    std::vector<BoxBlock> blocks;

    void push(const FloatBox& box, std::uint32_t body);
    /// The last one takes its place.
    void erase(std::uint32_t body);
    bool is_sound() const;
    template <class Visit>
    void for_each(Visit visit) const {
      for (std::uint32_t k = 0; k < size; ++k) {
        const BoxBlock& block = blocks[k / BoxBlock::width];
        visit(block.box(k % BoxBlock::width), block.body(k % BoxBlock::width));
      }
    }
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [at, count, held] = self;
      archive(at, count, held);
    }
  };
  /// Of the table of cells.
  struct Slot {
    CellIndex index{};
    std::uint32_t cell = 0;  ///< its number + 1; 0 is free
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [at, number] = self;
      archive(at, number);
    }
  };
  struct Level {
    double cells_per_length = 0.0;  ///< 1 / edge, a power of two
    double reach = 0.0;             ///< no box has been larger since the level was made, in cells
    std::size_t bodies = 0;
    std::size_t empty_cells = 0;
    std::vector<Cell> cells;
    std::vector<Slot> slots;  ///< open addressing

    /// Where a box is registered.
    CellIndex cell_of(const FloatBox& box) const;
    /// Where boxes that overlap this one are registered.
    CellRange cells_around(const FloatBox& box) const;
    double reach_of(const FloatBox& box) const;
    /// A position in units of cells, within what cell coordinates can hold.
    double in_cells(float position) const {
      constexpr float limit = std::numeric_limits<float>::max();
      const double finite = std::clamp(position, -limit, limit);
      return std::clamp(finite * cells_per_length, -coordinate_limit, coordinate_limit);
    }
    /// Fibonacci hashing: the high bits of a sum of products, so that the next cell costs one addition.
    static constexpr std::uint64_t step_x = 0x9e3779b97f4a7c15u;
    static constexpr std::uint64_t step_y = 0xc2b2ae3d27d4eb4fu;
    static constexpr std::uint64_t step_z = 0x165667b19e3779f9u;
    static std::uint64_t hash(const CellIndex& index) {
      return static_cast<std::uint64_t>(index.x) * step_x + static_cast<std::uint64_t>(index.y) * step_y +
             static_cast<std::uint64_t>(index.z) * step_z;
    }
    std::size_t first_slot(std::uint64_t hashed) const {
      return static_cast<std::size_t>(hashed >> (64 - std::countr_zero(slots.size())));
    }
    const Cell* find(const CellIndex& index, std::uint64_t hashed) const {
      for (std::size_t slot = first_slot(hashed);; slot = (slot + 1) & (slots.size() - 1)) {
        if (slots[slot].cell == 0) return nullptr;
        if (slots[slot].index == index) return &cells[slots[slot].cell - 1];
      }
    }
    const Cell* find(const CellIndex& index) const { return find(index, hash(index)); }
    Cell& find_or_create(const CellIndex& index);
    void rehash();

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [scale, largest, body_count, empty_count, all_cells, table] = self;
      archive(scale, largest, body_count, empty_count, all_cells, table);
    }
    /// True when the table finds each cell.
    bool table_is_sound() const;

   private:
    std::size_t free_slot(const CellIndex& index) const;
  };
  struct Place {
    int level = -1;
    FloatBox box{};
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [number, registered] = self;
      archive(number, registered);
    }
  };

  int level_for(float extent) const;
  double cells_per_length(std::size_t level) const;
  bool places_are_sound() const;
  void insert(std::uint32_t body, const FloatBox& box);
  void erase(std::uint32_t body);
  void retune_if_worthwhile();

  static int exponent_of(float extent);
  static std::int64_t size_of(float extent);
  /// In size_of() an octave counts as 2^4.
  static constexpr int octave_bits = 4;

  std::vector<Level> levels_;
  std::vector<Place> places_;
  std::size_t size_ = 0;
  int finest_exponent_ = 0;    ///< log2 of the edge on level 0
  std::int64_t size_sum_ = 0;  ///< of size_of() of all registered boxes
  std::size_t changes_since_tuning_ = 0;
};

template <class Visit>
void HashGrid::for_each_overlap(const Box& box, Visit visit) const {
  const FloatBox query(box);
  const BoxBlock::Query wanted(query);
  for (const Level& level : levels_) {
    if (level.bodies == 0) continue;
    const CellRange range = level.cells_around(query);
    const auto visit_cell = [&](const Cell& cell) {
      for (const BoxBlock& block : cell.blocks) {
        BoxBlock::for_each(block.overlapping(wanted), [&](std::size_t place) {
          if constexpr (std::is_invocable_v<Visit, std::uint32_t, FloatBox>) {
            visit(block.body(place), block.box(place));
          } else {
            visit(block.body(place));
          }
        });
      }
    };
    if (range.count() > static_cast<double>(level.cells.size())) {
      for (const Cell& cell : level.cells)
        if (range.contains(cell.index)) visit_cell(cell);
      continue;
    }
    for (std::int32_t z = range.first.z; z <= range.last.z; ++z)
      for (std::int32_t y = range.first.y; y <= range.last.y; ++y) {
        std::uint64_t hashed = Level::hash({range.first.x, y, z});
        for (std::int32_t x = range.first.x; x <= range.last.x; ++x, hashed += Level::step_x)
          if (const Cell* cell = level.find({x, y, z}, hashed)) visit_cell(*cell);
      }
  }
}

template <class Visit>
void HashGrid::for_each_cell(Visit visit) const {
  for (const Level& level : levels_) {
    const double edge = 1.0 / level.cells_per_length;
    for (const Cell& cell : level.cells) {
      const auto [x, y, z] = cell.index;
      const Vec3 lower = Vec3{1.0 * x, 1.0 * y, 1.0 * z} * edge;
      if (cell.size > 0) visit(Box{lower, lower + Vec3{edge, edge, edge}}, std::size_t{cell.size});
    }
  }
}

}  // namespace kinesphere
