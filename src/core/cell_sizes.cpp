// Which levels of reach there are, how wide their cells, and which chains these get.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/even_spacing.hpp"
#include "core/region_cells.hpp"
#include "number/infinity.hpp"
#include "number/roots.hpp"

namespace kinesphere::core {
namespace {

/// Widest cells, in reaches of the largest region of their level.
constexpr double widest = 32.0;
/// So many regions are to be in the cell of a region, with itself.
constexpr double wanted_in_cell = 7.0;
/// Chains that a small world may have, whose cells at the border are a large part of all.
constexpr std::size_t chains_of_small_worlds = 8192;
/// Returns how many chains a level of so many regions may have.
constexpr std::size_t most_chains_of(std::size_t regions) { return 2 * regions + 512; }

constexpr float infinite = std::numeric_limits<float>::infinity();

}  // namespace

void RegionCells::set_width(Level& level, double width) {
  level.width = width;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Axis& a = level.axes[axis];
    const double period = period_[static_cast<int>(axis)];
    a.count = period > 0.0 ? std::max<std::int64_t>(static_cast<std::int64_t>(period / width), 1) : 0;
    a.width = period > 0.0 ? period / static_cast<double>(a.count) : width;
    a.by_width = 1.0 / a.width;
    a.filled = a.count > 0 ? Range{0, a.count - 1} : Range();
    a.reserved = Range();
  }
}

/// Returns the slots of some regions, if there are any: of those in some 32 blocks, evenly spread.
std::vector<std::uint32_t> RegionCells::sample() const {
  std::vector<std::uint32_t> some;
  for (std::size_t step = blocks_.size() / 32; step > 0 && some.empty(); step /= 2)
    for (std::size_t place = 0; place < blocks_.size(); place += step)
      for (std::uint32_t lane = 0; lane < links_[place].count; ++lane)
        some.push_back(static_cast<std::uint32_t>(place) * lanes + lane);
  return some;
}

/// Counts how many regions are in the cell of a region, on average.
RegionCells::Crowding RegionCells::crowding(std::size_t number,
                                            const std::vector<std::uint32_t>& some) const {
  const Level& level = levels_[number];
  const auto cell_in = [&](const RegionBlock& block, std::uint32_t lane) {
    return cell_of(level, block.x[lane], block.y[lane], block.z[lane]);
  };
  Crowding crowd;
  for (const std::uint32_t slot : some) {
    if (level_of(reach_of(slot)) != number) continue;
    const auto cell = cell_in(blocks_[slot / lanes], slot % lanes);
    crowd.regions += 1.0;
    for (std::uint32_t place = chain_of(level, cell); place != none; place = links_[place].next)
      for (std::uint32_t lane = 0; lane < links_[place].count; ++lane)
        if (level_of(blocks_[place].reach[lane]) == number && cell_in(blocks_[place], lane) == cell)
          crowd.in_cells += 1.0;
  }
  return crowd;
}

/// Returns the width of cells that suits a level where some regions are so crowded in the present ones.
/// `narrowest`: of all levels.
double RegionCells::wanted_width(const Level& level, double narrowest, const Crowding& crowd) const {
  const double by = std::clamp(wanted_in_cell * crowd.regions / crowd.in_cells, 0x1p-9, 0x1p9);
  const double width = level.width * (dimensions_ == 2 ? std::sqrt(by) : cube_root(by));
  return std::clamp(width, narrowest, widest * static_cast<double>(level.largest_reach));
}

void RegionCells::rebuild(Balls& balls) {
  entered_ = 0;
  if (regions_ == 0) return;
  if (!levels_suit()) return sort(balls);
  refine(balls);
}

void RegionCells::sort(Balls& balls) {
  entered_ = 0;
  if (regions_ == 0) return;
  choose_levels();
  insert_all(balls);
  refine(balls);
}

/// Returns the median reach of some regions, and the top of the first level that suits them: it has nearly
/// all regions, but none that are much larger than most.
std::pair<float, float> RegionCells::typical_reaches() const {
  std::vector<float> reaches;
  for (const std::uint32_t slot : sample()) reaches.push_back(reach_of(slot));
  std::sort(reaches.begin(), reaches.end());
  const float median = reaches[reaches.size() / 2];
  return {median, std::min(1.25F * reaches[reaches.size() - 1 - reaches.size() / 32], 2.0F * median)};
}

bool RegionCells::levels_suit() const {
  const auto [median, top] = typical_reaches();
  return median < 1.25F * median_ && median > 0.8F * median_ && top < 1.15F * levels_[0].top &&
         top > 0.75F * levels_[0].top && regions_ <= 2 * built_for_;
}

/// Chooses levels, and widths of cells as if the regions of a level were spread evenly.
void RegionCells::choose_levels() {
  auto [median, bound] = typical_reaches();
  median_ = median;
  for (Level& level : levels_) {
    level.top = bound;
    level.regions = 0;
    level.largest_reach = 0.0F;
    bound *= 4.0F;
  }
  struct Extent {
    float lower[3]{infinite, infinite, infinite}, upper[3]{-infinite, -infinite, -infinite};
  };
  std::array<Extent, most_levels> extents;
  for_each_region([&](const RegionBlock& block, std::uint32_t lane, std::uint32_t) {
    const std::size_t number = level_of(block.reach[lane]);
    ++levels_[number].regions;
    levels_[number].largest_reach = std::max(levels_[number].largest_reach, block.reach[lane]);
    const float centre[3] = {block.x[lane], block.y[lane], block.z[lane]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extents[number].lower[axis] = std::min(extents[number].lower[axis], centre[axis]);
      extents[number].upper[axis] = std::max(extents[number].upper[axis], centre[axis]);
    }
  });
  for (std::size_t number = 0; number < most_levels; ++number) {
    Level& level = levels_[number];
    double edges[3], width = 2.0 * static_cast<double>(level.top);
    for (std::size_t axis = 0; axis < 3; ++axis)
      edges[axis] = double{extents[number].upper[axis]} - double{extents[number].lower[axis]};
    if (level.regions > 0) width = even_spacing(edges, level.regions / wanted_in_cell);
    const double most = std::max(widest * static_cast<double>(level.largest_reach), 0.5 * double{median_});
    set_width(level, level.regions > 0 ? std::clamp(width, 0.5 * double{median_}, most) : width);
  }
}

/// Chooses the widths of cells anew until they suit.
void RegionCells::refine(Balls& balls) {
  double slack = 1.25;
  for (int round = 0; round < 8; ++round) {
    bool is_fine = true;
    const std::vector<std::uint32_t> some = sample();
    for (std::size_t number = 0; number < most_levels; ++number) {
      Level& level = levels_[number];
      if (level.regions == 0) continue;
      const Crowding crowd = crowding(number, some);
      if (!(crowd.regions > 0.0)) continue;
      const double width = wanted_width(level, 0.5 * static_cast<double>(median_), crowd);
      // Few regions tell little.
      const double fine = slack + 1.0 / std::sqrt(crowd.regions);
      if (width < fine * level.width && width * fine > level.width) continue;
      set_width(level, width);
      is_fine = false;
    }
    if (is_fine) return;
    insert_all(balls);
    slack = 1.08;
  }
}

/// Inserts all regions anew.
void RegionCells::insert_all(Balls& balls) {
  struct Entry {
    std::uint32_t ball;
    float reach;
  };
  std::vector<Entry> all;
  all.reserve(regions_);
  for (Level& level : levels_) {
    level.regions = 0;
    level.largest_reach = 0.0F;
    set_width(level, level.width);
  }
  for_each_region([&](const RegionBlock& block, std::uint32_t lane, std::uint32_t ball) {
    all.push_back({ball, block.reach[lane]});
    Level& level = levels_[level_of(block.reach[lane])];
    ++level.regions;
    const auto cell = cell_of(level, block.x[lane], block.y[lane], block.z[lane]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Range& filled = level.axes[axis].filled;
      filled = {std::min(filled.first, cell[axis]), std::max(filled.last, cell[axis])};
    }
  });
  choose_chains();
  for (Level& level : levels_) level.regions = 0;
  regions_ = 0;
  for (const Entry& entry : all) insert(balls, entry.ball, entry.reach);
}

/// Makes empty chains. Each of the cells of a level that are filled, and of those around, gets its own,
/// unless there are too many of them.
void RegionCells::choose_chains() {
  built_for_ = std::max<std::size_t>(regions_, 64);
  const std::size_t most = std::max(std::bit_ceil(built_for_) / 2, chains_of_small_worlds);
  std::size_t taken = 0;
  for (Level& level : levels_) {
    const double cells = level.regions > 0 ? reserve_cells(level) : infinity;
    const std::size_t allowed = std::min(most - taken, most_chains_of(level.regions));
    level.shares = !(cells <= static_cast<double>(allowed));
    if (level.shares) {
      level.axes[0].stride = 1;
      level.axes[1].stride = 0x9E3779B1U;
      level.axes[2].stride = 0x85EBCA77U;
      level.origin = 0x27D4EB2FU * static_cast<std::uint32_t>(&level - levels_.data());
      continue;
    }
    level.origin = static_cast<std::uint32_t>(taken);
    for (const Axis& axis : level.axes)
      level.origin -= static_cast<std::uint32_t>(axis.reserved.first) * axis.stride;
    taken += static_cast<std::size_t>(cells);
  }
  // There may have been many more.
  blocks_ = std::vector<RegionBlock>();
  balls_ = std::vector<BallBlock>();
  links_ = std::vector<Link>();
  chains_ = static_cast<std::uint32_t>(std::max({taken, built_for_ / 8, std::size_t{64}}));
  mask_ = std::bit_ceil(chains_) - 1;
  add_blocks(chains_);
}

/// Chooses the cells of a level that are to have chains of their own, and strides. Returns their number.
double RegionCells::reserve_cells(Level& level) const {
  double cells = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Axis& a = level.axes[axis];
    const std::int64_t around = a.count > 0 || static_cast<int>(axis) >= dimensions_ ? 0 : 1;
    a.reserved = {a.filled.first - around, a.filled.last + around};
    a.stride = static_cast<std::uint32_t>(std::min(cells, 0x1p31));
    cells *= a.reserved.count();
  }
  return cells;
}

}  // namespace kinesphere::core
