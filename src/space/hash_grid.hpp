// A hierarchical hash grid: which registered boxes overlap a given one?
//
// Unbounded space: only cells that hold something exist. Each level has cells four times as large as the one
// below; a box lies on the finest level whose cells are as large as the box, so it stands in at most eight of
// them, and radii may differ by any ratio. Boxes are kept as floats, rounded outward.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// A box in single precision that contains the double one it was made from.
struct FloatBox {
  std::array<float, 3> lower;
  std::array<float, 3> upper;

  FloatBox() = default;
  explicit FloatBox(const Box& box);

  bool overlaps(const FloatBox& other) const {
    return lower[0] <= other.upper[0] && other.lower[0] <= upper[0] && lower[1] <= other.upper[1] &&
           other.lower[1] <= upper[1] && lower[2] <= other.upper[2] && other.lower[2] <= upper[2];
  }
  float extent() const;

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [low, high] = self;
    archive(low, high);
  }
  friend bool operator==(const FloatBox&, const FloatBox&) = default;
};

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

  /// Calls visit(body) once for each registered body whose box overlaps `box`, touching included. `visit` may
  /// not change the grid. Cost: the cells that the box meets, on each level in use, and what they hold.
  template <class Visit>
  void for_each_overlap(const Box& box, Visit visit) const;

  /// Calls visit(Box, number of bodies) for each cell that holds something, level by level.
  template <class Visit>
  void for_each_cell(Visit visit) const;

  /// What is wrong with the body's registration, if anything: it must stand, as `box`, in every cell that the
  /// box meets and in no other. Cost: all cells.
  std::optional<std::string> check(std::uint32_t body, const Box& box) const;

  /// Everything as it is, for a search visits bodies in the order in which cells and entries stand, and when
  /// cells are dropped depends on how many are empty and on the size of the table.
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [levels, places, size, finest_exponent, exponent_sum, changes] = self;
    archive(levels, places, size, finest_exponent, exponent_sum, changes);
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
  struct Entry {
    FloatBox box;
    std::uint32_t body;
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [where, who] = self;
      archive(where, who);
    }
  };
  struct Cell {
    CellIndex index;
    std::vector<Entry> entries;
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [at, held] = self;
      archive(at, held);
    }
  };
  struct Level {
    double cells_per_length = 0.0;  ///< 1 / edge, a power of two
    std::size_t bodies = 0;
    std::size_t empty_cells = 0;
    std::vector<Cell> cells;
    std::vector<std::uint32_t> slots;  ///< open addressing; cell number + 1, 0 is free

    CellRange range_of(const FloatBox& box) const;
    /// A position in units of cells, within what cell coordinates can hold.
    double in_cells(float position) const {
      constexpr float limit = std::numeric_limits<float>::max();
      const double finite = std::clamp(position, -limit, limit);
      return std::clamp(finite * cells_per_length, -coordinate_limit, coordinate_limit);
    }
    /// Two overlapping boxes may share several cells: they count in the one where their overlap begins. For a
    /// cell that both meet.
    bool overlap_begins_in(const CellIndex& cell, const FloatBox& a, const FloatBox& b) const {
      const auto reaches = [&](std::size_t axis, std::int32_t coordinate) {
        return in_cells(std::max(a.lower[axis], b.lower[axis])) >= coordinate;
      };
      return reaches(0, cell.x) && reaches(1, cell.y) && reaches(2, cell.z);
    }
    const Cell* find(const CellIndex& index) const;
    Cell& find_or_create(const CellIndex& index);
    void rehash();

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [scale, body_count, empty_count, all_cells, table] = self;
      archive(scale, body_count, empty_count, all_cells, table);
    }
    /// True when the table finds each cell.
    bool table_is_sound() const;
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

  static std::size_t hash(const CellIndex& index);
  static int exponent_of(float extent);

  std::vector<Level> levels_;
  std::vector<Place> places_;
  std::size_t size_ = 0;
  int finest_exponent_ = 0;        ///< log2 of the edge on level 0
  std::int64_t exponent_sum_ = 0;  ///< of the extents of all registered boxes
  std::size_t changes_since_tuning_ = 0;
};

template <class Visit>
void HashGrid::for_each_overlap(const Box& box, Visit visit) const {
  const FloatBox query(box);
  for (const Level& level : levels_) {
    if (level.bodies == 0) continue;
    const CellRange range = level.range_of(query);
    const auto visit_cell = [&](const Cell& cell) {
      for (const Entry& entry : cell.entries)
        if (entry.box.overlaps(query) && level.overlap_begins_in(cell.index, entry.box, query))
          visit(entry.body);
    };
    if (range.count() > static_cast<double>(level.cells.size())) {
      for (const Cell& cell : level.cells)
        if (range.contains(cell.index)) visit_cell(cell);
      continue;
    }
    for (std::int32_t z = range.first.z; z <= range.last.z; ++z)
      for (std::int32_t y = range.first.y; y <= range.last.y; ++y)
        for (std::int32_t x = range.first.x; x <= range.last.x; ++x)
          if (const Cell* cell = level.find({x, y, z})) visit_cell(*cell);
  }
}

template <class Visit>
void HashGrid::for_each_cell(Visit visit) const {
  for (const Level& level : levels_) {
    const double edge = 1.0 / level.cells_per_length;
    for (const Cell& cell : level.cells) {
      const auto [x, y, z] = cell.index;
      const Vec3 lower = Vec3{1.0 * x, 1.0 * y, 1.0 * z} * edge;
      if (!cell.entries.empty()) visit(Box{lower, lower + Vec3{edge, edge, edge}}, cell.entries.size());
    }
  }
}

}  // namespace kinesphere
