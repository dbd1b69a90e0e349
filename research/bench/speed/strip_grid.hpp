// Search for near spheres, sorted into strips: rows of cells along x, each row contiguous in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "research/bench/speed/step_kernel.hpp"

namespace kinesphere::program {

/// The sphere of a pair that finds the other, so that each pair is found once.
enum class StripOrder {
  forward,  ///< each sphere finds those behind it in the order of strips: best for spheres of one size
  smaller,  ///< the larger finds the smaller, so small ones need not search as far as the largest reach
};

struct StripSettings {
  float row_edge;     ///< of the strips' square cross-section (length)
  float column_edge;  ///< resolution of the order along a strip (length)
  StripOrder order;
};

/// Cells along x, y and z, beginning at the outermost spheres.
struct StripLayout {
  std::array<float, 3> lower;
  std::array<float, 3> per_edge;  ///< cells per length
  std::array<int, 3> cells;
};

class StripGrid {
 public:
  explicit StripGrid(const StripSettings& settings) : settings_(settings) {}

  /// Replaces `near` by the pairs with centres nearer than the sum of their `radii`. Cost: a counting sort,
  /// then for each sphere the strips in its reach, eight spheres at a time.
  void find(const Frame& centres, const std::vector<float>& radii, std::vector<SpherePair>& near);
  std::size_t bytes() const;

 private:
  void lay_out(const Frame& centres, std::size_t size);
  void sort(const Frame& centres, const std::vector<float>& radii);

  StripSettings settings_;
  StripLayout layout_{};
  float margin_ = 0.0f;                 ///< larger than rounding of a place relative to a cell (length)
  std::vector<std::uint32_t> cell_of_;  ///< by body
  std::vector<std::uint32_t> starts_;   ///< starts of the cells in the arrays below, and the end of the last
  std::vector<float> x_, y_, z_, radius_;
  std::vector<std::uint32_t> body_;
};

}  // namespace kinesphere::program
