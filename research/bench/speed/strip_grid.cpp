#include "research/bench/speed/strip_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "research/bench/speed/multiversion.hpp"

namespace kinesphere::program {
namespace {

/// Spheres that are tested together. Arrays have this many extra spheres at their end, which are near no
/// other.
constexpr std::uint32_t strip_lanes = 8;

/// Most cells for each sphere; more would cost more to clear than they save.
constexpr double most_cells_each = 2.0;

struct Strips {
  const float* x;
  const float* y;
  const float* z;
  const float* radius;
  const std::uint32_t* body;
  const std::uint32_t* starts;
  StripLayout layout;
  float largest_radius;
  float margin;
  bool forward;
};

/// Appends the spheres from j on with a set bit in `hits`, which are near sphere i.
[[gnu::noinline]] void note_near(const Strips& strips, std::uint32_t i, std::uint32_t j, std::uint32_t end,
                                 std::uint32_t hits, std::vector<SpherePair>& near) {
  for (; hits != 0 && j < end; hits >>= 1, ++j) {
    if ((hits & 1u) == 0) continue;
    const bool smaller =
        strips.radius[j] < strips.radius[i] || (strips.radius[j] == strips.radius[i] && j > i);
    if (strips.forward || smaller) near.push_back({strips.body[i], strips.body[j]});
  }
}

KINESPHERE_INLINE int cell_along(const StripLayout& layout, std::size_t axis, float at) {
  const float cell = (at - layout.lower[axis]) * layout.per_edge[axis];
  const float last = static_cast<float>(layout.cells[axis] - 1);
  return static_cast<int>(cell < 0.0f ? 0.0f : cell > last ? last : cell);
}

/// Appends the spheres of [begin, end) that are near sphere i and are found from it.
KINESPHERE_INLINE void find_in_range(const Strips& strips, std::uint32_t i, std::uint32_t begin,
                                     std::uint32_t end, std::vector<SpherePair>& near) {
  const float at_x = strips.x[i], at_y = strips.y[i], at_z = strips.z[i], radius = strips.radius[i];
  for (std::uint32_t j = begin; j < end; j += strip_lanes) {
    std::uint32_t hits = 0;  // one bit for each lane
    for (std::uint32_t lane = 0; lane < strip_lanes; ++lane) {
      const float x = strips.x[j + lane] - at_x;
      const float y = strips.y[j + lane] - at_y;
      const float z = strips.z[j + lane] - at_z;
      const float reach = strips.radius[j + lane] + radius;
      hits |= x * x + y * y + z * z < reach * reach ? 1u << lane : 0u;
    }
    if (i - j < strip_lanes) hits &= ~(1u << (i - j));
    if (hits != 0) [[unlikely]]
      note_near(strips, i, j, end, hits, near);
  }
}

/// Returns the starts of the cells of a strip, which end with the start of the next strip.
KINESPHERE_INLINE const std::uint32_t* strip_at(const Strips& strips, int y, int z) {
  const int first_cell = (z * strips.layout.cells[1] + y) * strips.layout.cells[0];
  return strips.starts + first_cell;
}

KINESPHERE_INLINE void find_near_of(const Strips& strips, std::uint32_t i, int row_y, int row_z,
                                    std::vector<SpherePair>& near) {
  const float radius = strips.radius[i];
  const float reach = radius + (strips.forward ? strips.largest_radius : radius) + strips.margin;
  const int first_x = cell_along(strips.layout, 0, strips.x[i] - reach);
  const int last_x = cell_along(strips.layout, 0, strips.x[i] + reach);
  const int first_y = cell_along(strips.layout, 1, strips.y[i] - reach);
  const int last_y = cell_along(strips.layout, 1, strips.y[i] + reach);
  const int first_z = strips.forward ? row_z : cell_along(strips.layout, 2, strips.z[i] - reach);
  const int last_z = cell_along(strips.layout, 2, strips.z[i] + reach);
  for (int z = first_z; z <= last_z; ++z) {
    for (int y = strips.forward && z == row_z ? row_y : first_y; y <= last_y; ++y) {
      const std::uint32_t* const row = strip_at(strips, y, z);
      const bool own = strips.forward && z == row_z && y == row_y;
      find_in_range(strips, i, own ? i + 1 : row[first_x], row[last_x + 1], near);
    }
  }
}

KINESPHERE_INLINE void find_all_generic(const Strips& strips, std::vector<SpherePair>& near) {
  for (int z = 0; z < strips.layout.cells[2]; ++z) {
    for (int y = 0; y < strips.layout.cells[1]; ++y) {
      const std::uint32_t* const row = strip_at(strips, y, z);
      for (std::uint32_t i = row[0]; i < row[strips.layout.cells[0]]; ++i)
        find_near_of(strips, i, y, z, near);
    }
  }
}
KINESPHERE_VERSIONS(find_all, (const Strips& strips, std::vector<SpherePair>& near), (strips, near))

struct Range {
  float lower = std::numeric_limits<float>::infinity();
  float upper = -std::numeric_limits<float>::infinity();
};

KINESPHERE_INLINE void range_of_generic(const float* values, std::size_t size, Range& range) {
  float lower[strip_lanes], upper[strip_lanes];
  std::fill(lower, lower + strip_lanes, range.lower);
  std::fill(upper, upper + strip_lanes, range.upper);
  std::size_t at = 0;
  for (; at + strip_lanes <= size; at += strip_lanes) {
    for (std::size_t lane = 0; lane < strip_lanes; ++lane) {
      const float value = values[at + lane];
      lower[lane] = value < lower[lane] ? value : lower[lane];
      upper[lane] = value > upper[lane] ? value : upper[lane];
    }
  }
  for (; at < size; ++at) {
    lower[0] = std::min(lower[0], values[at]);
    upper[0] = std::max(upper[0], values[at]);
  }
  range = {*std::min_element(lower, lower + strip_lanes), *std::max_element(upper, upper + strip_lanes)};
}
KINESPHERE_VERSIONS(range_of, (const float* values, std::size_t size, Range& range), (values, size, range))

/// Computes the cell of each sphere. Rounding can put a sphere outside only at the upper end, so only that
/// end is clamped.
KINESPHERE_INLINE void number_cells_generic(const Frame& centres, const StripLayout& layout, std::size_t size,
                                            std::uint32_t* cell_of) {
  const int last_x = layout.cells[0] - 1, last_y = layout.cells[1] - 1, last_z = layout.cells[2] - 1;
  for (std::size_t at = 0; at < size; ++at) {
    const int x = static_cast<int>((centres.x[at] - layout.lower[0]) * layout.per_edge[0]);
    const int y = static_cast<int>((centres.y[at] - layout.lower[1]) * layout.per_edge[1]);
    const int z = static_cast<int>((centres.z[at] - layout.lower[2]) * layout.per_edge[2]);
    const int row = (z < last_z ? z : last_z) * layout.cells[1] + (y < last_y ? y : last_y);
    cell_of[at] = static_cast<std::uint32_t>(row * layout.cells[0] + (x < last_x ? x : last_x));
  }
}
KINESPHERE_VERSIONS(number_cells,
                    (const Frame& centres, const StripLayout& layout, std::size_t size,
                     std::uint32_t* cell_of),
                    (centres, layout, size, cell_of))

}  // namespace

void StripGrid::lay_out(const Frame& centres, std::size_t size) {
  const float* const coordinates[] = {centres.x, centres.y, centres.z};
  const float edges[] = {settings_.column_edge, settings_.row_edge, settings_.row_edge};
  std::array<Range, 3> ranges;
  double cells = 1.0;
  float farthest = 0.0f;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    range_of(coordinates[axis], size, ranges[axis]);
    cells *= std::floor((ranges[axis].upper - ranges[axis].lower) / edges[axis]) + 1.0;
    farthest = std::max({farthest, -ranges[axis].lower, ranges[axis].upper});
  }
  margin_ = 0x1p-20f * farthest;
  const double most_cells = most_cells_each * static_cast<double>(size) + 64.0;
  const auto coarser = static_cast<float>(std::max(1.0, std::cbrt(cells / most_cells)));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    layout_.lower[axis] = ranges[axis].lower;
    layout_.per_edge[axis] = 1.0f / (coarser * edges[axis]);
    layout_.cells[axis] =
        static_cast<int>((ranges[axis].upper - ranges[axis].lower) * layout_.per_edge[axis]) + 1;
  }
}

void StripGrid::sort(const Frame& centres, const std::vector<float>& radii) {
  const std::size_t size = radii.size();
  cell_of_.resize(size);
  number_cells(centres, layout_, size, cell_of_.data());
  const int cells = layout_.cells[0] * layout_.cells[1] * layout_.cells[2];
  starts_.assign(static_cast<std::size_t>(cells) + 1, 0);
  for (std::size_t at = 0; at < size; ++at) ++starts_[cell_of_[at]];
  std::uint32_t before = 0;
  for (std::uint32_t& start : starts_) {
    before += start;
    start = before;
  }
  for (auto* const array : {&x_, &y_, &z_})
    array->resize(size + strip_lanes, std::numeric_limits<float>::max());
  radius_.resize(size + strip_lanes, 0.0f);
  body_.resize(size);
  // The loop runs backwards, so that each cell's start ends up at its first sphere.
  for (std::size_t at = size; at-- > 0;) {
    const std::uint32_t place = --starts_[cell_of_[at]];
    x_[place] = centres.x[at];
    y_[place] = centres.y[at];
    z_[place] = centres.z[at];
    radius_[place] = radii[at];
    body_[place] = static_cast<std::uint32_t>(at);
  }
}

void StripGrid::find(const Frame& centres, const std::vector<float>& radii, std::vector<SpherePair>& near) {
  near.clear();
  lay_out(centres, radii.size());
  sort(centres, radii);
  find_all({.x = x_.data(),
            .y = y_.data(),
            .z = z_.data(),
            .radius = radius_.data(),
            .body = body_.data(),
            .starts = starts_.data(),
            .layout = layout_,
            .largest_radius = *std::max_element(radii.begin(), radii.end()),
            .margin = margin_,
            .forward = settings_.order == StripOrder::forward},
           near);
}

std::size_t StripGrid::bytes() const {
  return sizeof(float) * (x_.capacity() + y_.capacity() + z_.capacity() + radius_.capacity()) +
         sizeof(std::uint32_t) * (cell_of_.capacity() + starts_.capacity() + body_.capacity());
}

}  // namespace kinesphere::program
