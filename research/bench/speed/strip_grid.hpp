// Which spheres are near each other? Sorted into strips: rows of cells along x, each row contiguous in
// memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "research/bench/speed/step_kernel.hpp"

namespace kinesphere::program {

/// Who looks for whom, so that each pair is found once.
enum class StripOrder {
  forward,  ///< each sphere for those behind it in the order of strips: best for spheres of one size
  smaller,  ///< the larger for the smaller, so small ones need not look as far as the largest reach
};

struct StripSettings {
  float row_edge;     ///< of the strips' square cross-section (length)
  float column_edge;  ///< how finely spheres are sorted along a strip (length)
  StripOrder order;
};

/// Cells along x, y and z, from the outermost spheres on.
struct StripLayout {
  std::array<float, 3> lower;
  std::array<float, 3> per_edge;  ///< cells per length
  std::array<int, 3> cells;
};

class StripGrid {
 public:
  explicit StripGrid(const StripSettings& settings) : settings_(settings) {}

  /// Replaces `near` by the pairs whose centres are nearer than the sum of their `radii`. Cost: a counting
  /// sort, then for each sphere the strips it may reach, eight spheres at a time.
  void find(const Frame& centres, const std::vector<float>& radii, std::vector<SpherePair>& near);
  std::size_t bytes() const;

 private:
  void lay_out(const Frame& centres, std::size_t size);
  void sort(const Frame& centres, const std::vector<float>& radii);

  StripSettings settings_;
  StripLayout layout_{};
  float margin_ = 0.0f;  ///< more than rounding can move a sphere across the edge of a cell (length)
  std::vector<std::uint32_t> cell_of_;  ///< by body
  std::vector<std::uint32_t> starts_;   ///< of cells in the arrays below, and their end
  std::vector<float> x_, y_, z_, radius_;
  std::vector<std::uint32_t> body_;
};

}  // namespace kinesphere::program
