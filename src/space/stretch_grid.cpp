#include "space/stretch_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "number/bit_cast.hpp"
#include "number/powers.hpp"

namespace kinesphere {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
/// The widest stretches of a level are less than 2 to this power times as wide as its narrowest ones.
constexpr std::uint32_t octaves_of_level = 2;
/// Cells are sliced so often on x, on which those that a search reads follow each other: thin ones cost
/// nothing, and fewer stretches are read in vain. Measured with the catalogue of satellites, as the octaves.
constexpr float slices = 8.0F;
constexpr std::uint32_t cells_for_each = 4;
/// Narrowest cells, and so most of them on an axis: roundings are not much less.
constexpr float narrowest = 0x1p-20F;

/// Part of all lengths of a stretch by which its radius is enlarged, and what is added to that in units of
/// the grid: more than near_stretches() needs, and than all roundings here.
constexpr double length_lost = 0x1p-18, unit_lost = 0x1p-40;

/// Returns a number that grows with the binary logarithm of the width, below 256.
std::uint32_t octave_of(float width) { return bit_cast<std::uint32_t>(width) >> 23; }

std::int32_t whole(float value) {
  const auto cut = static_cast<std::int32_t>(value);
  return cut - static_cast<std::int32_t>(static_cast<float>(cut) > value);
}

std::int32_t wrapped(std::int32_t cell, std::int32_t count) {
  if (0 <= cell && cell < count) return cell;
  const std::int32_t rest = cell % count;
  return rest < 0 ? rest + count : rest;
}

}  // namespace

float StretchGrid::Entry::half_width(std::size_t axis) const { return std::abs(half_way[axis]) + radius; }

void StretchGrid::fill(std::span<const Stretch> stretches) {
  compared_ = 0;
  convert(stretches);
  choose_levels();
  sort();
}

void StretchGrid::convert(std::span<const Stretch> stretches) {
  entries_.clear();
  if (stretches.empty()) return;
  Vec3 lower = stretches.front().middle, upper = lower;
  double widest = 0.0;
  for (const Stretch& stretch : stretches) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], stretch.middle[axis]);
      upper[axis] = std::max(upper[axis], stretch.middle[axis]);
    }
    widest = std::max(widest, norm_one(stretch.half_way) + stretch.radius);
  }
  const Vec3 base = 0.5 * lower + 0.5 * upper;
  // Twice: the first power alone may be beyond the range of numbers.
  const int exponent = std::max(exponent_of(0.5 * norm_one(upper - lower) + widest), -1000) / 2 + 1;
  const double scale = power_of_two(-exponent);
  const auto scaled = [scale](double length) { return length * scale * scale; };
  for (const Stretch& stretch : stretches) {
    const Vec3 middle = stretch.middle - base;
    Entry& entry = entries_.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      entry.middle[static_cast<std::size_t>(axis)] = static_cast<float>(scaled(middle[axis]));
      entry.half_way[static_cast<std::size_t>(axis)] = static_cast<float>(scaled(stretch.half_way[axis]));
    }
    const double size = norm_one(middle) + norm_one(stretch.half_way) + stretch.radius;
    const double lost = length_lost * size + 0x1p-48 * (norm_one(stretch.middle) + norm_one(base));
    entry.radius = static_cast<float>(scaled(stretch.radius + lost) + unit_lost);
    entry.number = stretch.number;
  }
}

void StretchGrid::choose_levels() {
  std::array<std::uint32_t, 256> levels{};
  const auto octave = [](const Entry& entry) {
    return octave_of(std::max({entry.half_width(0), entry.half_width(1), entry.half_width(2)}));
  };
  for (Entry& entry : entries_) {
    entry.level = octave(entry);
    ++levels[entry.level];
  }
  // From the widest on, lest a few that are wider than all others share a level with these.
  std::uint32_t count = 0, lowest = 256;
  for (std::uint32_t k = 256; k-- > 0;) {
    if (levels[k] == 0) continue;
    if (lowest == 256 || k < lowest) {
      ++count;
      lowest = k - std::min(k, octaves_of_level - 1);
    }
    levels[k] = count;
  }
  levels_.assign(count,
                 {.lower = {infinite, infinite, infinite}, .upper = {-infinite, -infinite, -infinite}});
  for (Entry& entry : entries_) {
    entry.level = count - levels[entry.level];
    Level& level = levels_[entry.level];
    ++level.size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      level.widest[axis] = std::max(level.widest[axis], entry.half_width(axis));
      level.lower[axis] = std::min(level.lower[axis], entry.middle[axis]);
      level.upper[axis] = std::max(level.upper[axis], entry.middle[axis]);
    }
  }
  std::size_t cells = 0;
  for (Level& level : levels_) {
    choose_cells(level);
    level.origin = cells;
    cells += static_cast<std::size_t>(level.count[0]) * static_cast<std::size_t>(level.count[1]) *
             static_cast<std::size_t>(level.count[2]);
  }
  starts_.assign(cells + 2, 0);
}

/// Cells are as wide as the widest stretch.
void StretchGrid::choose_cells(Level& level) {
  double cells = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float edge = std::max(2.0F * level.widest[axis] / (axis == 0 ? slices : 1.0F), narrowest);
    level.per_edge[axis] = 1.0F / edge;
    level.first[axis] = whole(level.lower[axis] * level.per_edge[axis]);
    level.count[axis] = whole(level.upper[axis] * level.per_edge[axis]) - level.first[axis] + 1;
    cells *= level.count[axis];
  }
  while (cells > double{cells_for_each} * level.size) {
    const auto most = std::max_element(level.count.begin(), level.count.end());
    cells /= *most;
    *most = (*most + 1) / 2;
    cells *= *most;
  }
}

std::size_t StretchGrid::cell_of(const Entry& entry) const {
  const Level& level = levels_[entry.level];
  std::int32_t cell = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    const std::int32_t at = whole(entry.middle[axis] * level.per_edge[axis]) - level.first[axis];
    cell = cell * level.count[axis] + wrapped(at, level.count[axis]);
  }
  return level.origin + static_cast<std::size_t>(cell);
}

/// Puts all into slots, by level and cell.
void StretchGrid::sort() {
  cells_.clear();
  for (const Entry& entry : entries_) {
    cells_.push_back(cell_of(entry));
    ++starts_[cells_.back() + 2];
  }
  for (std::size_t cell = 2; cell < starts_.size(); ++cell) starts_[cell] += starts_[cell - 1];
  for (std::vector<float>& column : columns_) column.resize(entries_.size() + stretch_lanes);
  numbers_.resize(entries_.size());
  levels_at_.resize(entries_.size());
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const Entry& entry = entries_[k];
    const std::uint32_t slot = starts_[cells_[k] + 1]++;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns_[axis][slot] = entry.middle[axis];
      columns_[axis + 3][slot] = entry.half_way[axis];
    }
    columns_[6][slot] = entry.radius;
    numbers_[slot] = entry.number;
    levels_at_[slot] = entry.level;
  }
}

std::span<const std::uint32_t> StretchGrid::search_behind(std::uint32_t slot) {
  std::array<float, 7> stretch;
  StretchColumns columns;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    columns[k] = columns_[k].data();
    stretch[k] = columns_[k][slot];
  }
  ranges_.clear();
  for (std::size_t level = levels_at_[slot]; level < levels_.size(); ++level)
    add_ranges(levels_[level], stretch, slot + 1);
  std::size_t slots = 0;
  for (const StretchRange& range : ranges_) slots += range.last - range.first;
  compared_ += slots;
  if (found_.size() < slots) found_.resize(2 * slots);
  return std::span(found_).first(near_stretches(columns, stretch, ranges_, found_.data()));
}

/// Returns the cells that may have the middles in this range.
StretchGrid::CellRange StretchGrid::range_of(const Level& level, std::size_t axis, float lower,
                                             float upper) const {
  lower = std::max(lower, level.lower[axis]);
  upper = std::min(upper, level.upper[axis]);
  if (!(lower <= upper)) return {0, 0};
  const std::int32_t first = whole(lower * level.per_edge[axis]) - level.first[axis];
  const std::int32_t last = whole(upper * level.per_edge[axis]) - level.first[axis];
  const std::int32_t count = level.count[axis];
  return last - first + 1 >= count ? CellRange{0, count} : CellRange{wrapped(first, count), last - first + 1};
}

/// Appends the slots from `behind` on of cells whose stretches this one may touch.
void StretchGrid::add_ranges(const Level& level, const std::array<float, 7>& stretch, std::uint32_t behind) {
  std::array<CellRange, 3> ranges;
  for (std::size_t axis = 3; axis-- > 0;) {
    const float far = std::abs(stretch[axis + 3]) + stretch[6] + level.widest[axis];
    ranges[axis] = range_of(level, axis, stretch[axis] - far, stretch[axis] + far);
    if (ranges[axis].count == 0) return;
  }
  const auto& [xs, ys, zs] = ranges;
  const std::int32_t within = std::min(xs.count, level.count[0] - xs.first), beyond = xs.count - within;
  const auto add = [&](std::uint32_t first, std::uint32_t last) {
    if (last > std::max(first, behind)) ranges_.push_back({std::max(first, behind), last});
  };
  for (std::int32_t k = 0; k < zs.count; ++k) {
    const std::int32_t z = wrapped(zs.first + k, level.count[2]);
    for (std::int32_t j = 0; j < ys.count; ++j) {
      const std::int32_t y = wrapped(ys.first + j, level.count[1]);
      const std::uint32_t* const row =
          starts_.data() + level.origin + static_cast<std::size_t>((z * level.count[1] + y) * level.count[0]);
      add(row[xs.first], row[xs.first + within]);
      if (beyond > 0) add(row[0], row[beyond]);
    }
  }
}

}  // namespace kinesphere
