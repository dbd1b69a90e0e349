#include "broadphase/grid.hpp"

#include <limits>
#include <utility>

namespace kinesphere {
namespace {

constexpr std::int32_t most_along_an_axis = 1 << 20;
/// A grid for at most this number of swept spheres has a single cell; a search tests all of them.
constexpr std::size_t few = 32;

}  // namespace

void SweptSphereSpread::add(const SweptSphereSpread& more) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lower_[axis] = std::min(lower_[axis], more.lower_[axis]);
    upper_[axis] = std::max(upper_[axis], more.upper_[axis]);
  }
  widest_ = std::max(widest_, more.widest_);
  largest_ = std::max(largest_, more.largest_);
  exceeded_ = exceeded_ || more.exceeded_;
}

float SweptSphereSpread::extent() const {
  float extent = widest_;
  for (std::size_t axis = 0; axis < 3; ++axis) extent = std::max(extent, upper_[axis] - lower_[axis]);
  return extent;
}

Grid::Grid(const SweptSphereSpread& spread, std::size_t spheres, float coarseness) {
  const bool all_in_one = spheres <= few;
  const float edge = std::max(all_in_one ? 4.0f * spread.extent() : coarseness * spread.widest(), 0x1p-20f);
  edge_ = {edge / float{slices}, edge, edge};
  for (std::size_t axis = 0; axis < 3; ++axis) per_edge_[axis] = 1.0f / edge_[axis];
  if (all_in_one) {
    folded_ = {true, true, true};
    return;
  }
  folded_ = {spread.is_exceeded(), spread.is_exceeded(), spread.is_exceeded()};
  std::size_t all_cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float lower = spread.lower()[axis];
    first_[axis] = cell_of(lower, axis);
    const std::int32_t all = cell_of(std::max(lower, spread.upper()[axis]), axis) - first_[axis] + 1;
    count_[axis] = std::min(all, most_along_an_axis);
    if (count_[axis] < all) folded_[axis] = true;
    all_cells *= static_cast<std::size_t>(count_[axis]);
  }
  while (all_cells > 8 * spheres) {
    const auto most = std::max_element(count_.begin(), count_.end());
    all_cells /= static_cast<std::size_t>(*most);
    *most = (*most + 1) / 2;
    all_cells *= static_cast<std::size_t>(*most);
    folded_[static_cast<std::size_t>(most - count_.begin())] = true;
  }
}

std::int32_t Grid::cell_of(float coordinate, std::size_t axis) const {
  const float cells = coordinate * per_edge_[axis];
  const float within = !(cells > -SweptSphereSpread::limit) ? -SweptSphereSpread::limit
                       : cells < SweptSphereSpread::limit   ? cells
                                                            : SweptSphereSpread::limit;
  const auto cut = static_cast<std::int32_t>(within);
  return cut - (within < static_cast<float>(cut) ? 1 : 0);
}

/// Returns the cell's index along the axis, 0 <= index < count_[axis].
std::int32_t Grid::wrapped(std::int32_t cell, std::size_t axis) const {
  const std::int32_t way = cell - first_[axis];
  if (0 <= way && way < count_[axis]) return way;
  const std::int32_t rest = way % count_[axis];
  return rest < 0 ? rest + count_[axis] : rest;
}

Grid::Cell Grid::cell_around(const FloatAabb& aabb) const {
  Cell cell;
  for (std::size_t axis = 0; axis < 3; ++axis) cell[axis] = cell_of(aabb.middle(axis), axis);
  return cell;
}

std::uint32_t Grid::index_of(const Cell& cell) const {
  std::uint32_t index = 0;
  for (std::size_t axis = 3; axis-- > 0;)
    index = index * along(axis) + static_cast<std::uint32_t>(wrapped(cell[axis], axis));
  return index;
}

Grid::Cell Grid::nearest_image(std::uint32_t index, const Cell& to) const {
  Cell image;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto here = static_cast<std::int32_t>(index % along(axis));
    index /= along(axis);
    if (!folded_[axis]) {
      image[axis] = first_[axis] + here;
      continue;
    }
    const std::int32_t count = count_[axis];
    std::int32_t way = here - wrapped(to[axis], axis);
    if (2 * way > count) way -= count;
    if (2 * way < -count) way += count;
    image[axis] = to[axis] + way;
  }
  return image;
}

float Grid::looseness(const Cell& cell, const FloatAabb& aabb) const {
  // Without a branch: which side reaches out farthest is unpredictable.
  float most = 0.0f;
  float sum = 0.0f;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto here = static_cast<float>(cell[axis]);
    const float below = here * edge_[axis] - aabb.lower[axis];
    const float above = aabb.upper[axis] - (here + 1.0f) * edge_[axis];
    most = std::max(most, std::max(below, above));
    sum += aabb.lower[axis] + aabb.upper[axis];
  }
  // A coordinate that is infinite or NaN makes the sum so.
  return std::isfinite(sum) ? most * (1.0f + 0x1p-20f) : std::numeric_limits<float>::infinity();
}

Box Grid::box_of(const Cell& cell) const {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    box.lower[axis] = double(cell[k]) * double(edge_[k]);
    box.upper[axis] = (double(cell[k]) + 1.0) * double(edge_[k]);
  }
  return box;
}

std::optional<Grid::CellRange> Grid::cells_near(const FloatAabb& aabb, float reach) const {
  // The range is built in place and not copied at the end: a copy would wait for the separate writes to its
  // parts.
  std::optional<CellRange> range(std::in_place);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int32_t all = count_[axis];
    const std::int32_t first = cell_of(aabb.lower[axis] - reach, axis);
    const std::int32_t last = cell_of(aabb.upper[axis] + reach, axis);
    const float cells = (aabb.width(axis) + 2.0f * reach) * per_edge_[axis];
    std::int32_t begin = 0;
    std::int32_t count = all;
    // Otherwise all cells of the axis, also if a coordinate is infinite or NaN.
    if (cells < SweptSphereSpread::limit) {
      if (folded_[axis]) {
        count = std::min(last - first + 1, all);
        begin = count == all ? 0 : wrapped(first, axis);
      } else {
        begin = std::max(first - first_[axis], 0);
        count = std::min(last - first_[axis] + 1, all) - begin;
      }
    }
    if (count <= 0) {
      range.reset();
      return range;
    }
    range->begin[axis] = static_cast<std::uint32_t>(begin);
    range->count[axis] = static_cast<std::uint32_t>(count);
  }
  return range;
}

bool Grid::is_valid() const {
  constexpr auto most = static_cast<std::int32_t>(SweptSphereSpread::limit);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float size = edge_[axis];
    if (!(size > 0.0f && size < std::numeric_limits<float>::infinity() && per_edge_[axis] == 1.0f / size) ||
        first_[axis] < -most || first_[axis] > most || count_[axis] < 1 || count_[axis] > most_along_an_axis)
      return false;
  }
  return true;
}

}  // namespace kinesphere
