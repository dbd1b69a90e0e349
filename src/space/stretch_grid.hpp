// A grid of stretches, sorted by cell, to find all pairs that may come near each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinesphere/vec3.hpp"
#include "space/stretch_lanes.hpp"

namespace kinesphere {

/// A ball that moves straight on for some time: at s in [-1, 1] its centre is middle + half_way s. Numbers
/// are finite, and the radius is not negative.
struct Stretch {
  std::uint32_t number;  ///< for the caller
  Vec3 middle;
  Vec3 half_way{};
  double radius = 0.0;
};

/// Stretches of similar width form a level with cells of its own, so that a few wide ones do not make the
/// cells of all others wide. Each stretch has a slot: those of narrow levels come first, and those of a cell
/// are in their order at fill(). Far cells may share an index, and so their slots.
///
/// Lengths in here are in single precision, from the middle of all stretches and in units of about their
/// extent; radii are enlarged by more than all roundings.
class StretchGrid {
 public:
  /// Replaces the contents. Cost: linear.
  void fill(std::span<const Stretch> stretches);
  std::uint32_t slots() const { return static_cast<std::uint32_t>(numbers_.size()); }
  std::uint32_t number_at(std::uint32_t slot) const { return numbers_[slot]; }
  /// Returns the slots behind this one of all stretches that it may touch, and of few others. Searches
  /// from all slots find each pair that touches once. The result is valid until the next search.
  std::span<const std::uint32_t> search_behind(std::uint32_t slot);
  /// How many slots the searches since fill() have compared.
  std::size_t compared() const { return compared_; }

 private:
  /// A stretch in units of the grid.
  struct Entry {
    std::array<float, 3> middle;
    std::array<float, 3> half_way;
    float radius;
    std::uint32_t number;
    std::uint32_t level;

    float half_width(std::size_t axis) const;
  };
  struct Level {
    std::array<float, 3> widest{};                 ///< half of the greatest width on each axis
    std::array<float, 3> lower, upper;             ///< of all middles
    std::array<float, 3> per_edge{};               ///< cells for each unit
    std::array<std::int32_t, 3> first{}, count{};  ///< cells; beyond them, indices repeat
    std::uint32_t size = 0;                        ///< stretches
    std::size_t origin = 0;                        ///< where those of its cells begin in starts_
  };
  /// Indices of cells on an axis, some of which may follow at 0.
  struct CellRange {
    std::int32_t first, count;
  };

  void convert(std::span<const Stretch> stretches);
  void choose_levels();
  void choose_cells(Level& level);
  void sort();
  std::size_t cell_of(const Entry& entry) const;
  CellRange range_of(const Level& level, std::size_t axis, float lower, float upper) const;
  void add_ranges(const Level& level, const std::array<float, 7>& stretch, std::uint32_t behind);

  std::vector<Entry> entries_;
  std::vector<Level> levels_;                  ///< from narrow to wide
  std::vector<std::size_t> cells_;             ///< by entry
  std::vector<std::uint32_t> starts_;          ///< first slot of each cell, and the end of the last one
  std::array<std::vector<float>, 7> columns_;  ///< by slot: middle, half way, radius; and some numbers more
  std::vector<std::uint32_t> numbers_, levels_at_;  ///< by slot
  std::vector<StretchRange> ranges_;                ///< to search
  std::vector<std::uint32_t> found_;
  std::size_t compared_ = 0;
};

}  // namespace kinesphere
