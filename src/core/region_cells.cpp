#include "core/region_cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <tuple>

#include "number/roots.hpp"

namespace kinesphere::core {
namespace {

std::int64_t wrapped(std::int64_t cell, std::int64_t count) {
  if (count == 0) return cell;
  if (cell < 0) return cell + count;
  return cell >= count ? cell - count : cell;
}

std::uint64_t name_of(std::size_t level, std::int64_t x, std::int64_t y, std::int64_t z) {
  constexpr std::int64_t bits = (1 << 20) - 1;
  return static_cast<std::uint64_t>(level) << 60 | static_cast<std::uint64_t>(z & bits) << 40 |
         static_cast<std::uint64_t>(y & bits) << 20 | static_cast<std::uint64_t>(x & bits);
}

/// Place in the hash table of the cell with x = 0.
std::uint32_t row_of(std::size_t level, std::int64_t y, std::int64_t z) {
  std::uint64_t h = static_cast<std::uint64_t>(y) * 0x9E3779B97F4A7C15u +
                    static_cast<std::uint64_t>(z) * 0xC2B2AE3D27D4EB4Fu +
                    static_cast<std::uint64_t>(level) * 0x165667B19E3779F9u;
  h ^= h >> 29;
  return static_cast<std::uint32_t>(h * 0xBF58476D1CE4E5B9u >> 32);
}

}  // namespace

RegionCells::RegionCells(const Vec3& period, int dimensions)
    : period_(period), dimensions_(dimensions), blocks_(64), mask_(63) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(period[axis] > 0.0)) continue;
    float_periods_.length[axis] = static_cast<float>(period[axis]);
    float_periods_.inverse[axis] = 1.0F / float_periods_.length[axis];
    float_periods_.any = true;
  }
  for (Level& level : levels_) set_width(level, 1.0);
}

std::size_t RegionCells::level_of(float reach) const {
  std::size_t level = 0;
  while (level + 1 < most_levels && reach >= levels_[level].top) ++level;
  return level;
}

void RegionCells::set_width(Level& level, double width) {
  level.width = width;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    level.by_width[a] = 1.0 / width;
    if (!(period_[axis] > 0.0)) continue;
    level.count[a] = std::max<std::int64_t>(static_cast<std::int64_t>(period_[axis] / width), 1);
    level.by_width[a] = static_cast<double>(level.count[a]) / period_[axis];
  }
}

/// Cell on an axis. On an axis that repeats, centres lie in the primary box, hardly beyond for rounding, and
/// ranges reach one box beyond.
std::int64_t RegionCells::cell_on(const Level& level, int axis, double x) const {
  const double cell = std::floor(x * level.by_width[static_cast<std::size_t>(axis)]);
  return static_cast<std::int64_t>(std::clamp(cell, -0x1p60, 0x1p60));
}

RegionCells::Range RegionCells::range_on(const Level& level, int axis, double x, double reach) const {
  const Range range{cell_on(level, axis, x - reach), cell_on(level, axis, x + reach)};
  const std::int64_t count = level.count[static_cast<std::size_t>(axis)];
  return count > 0 && range.last - range.first >= count ? Range{0, count - 1} : range;
}

void RegionCells::enter(Balls& balls, std::uint32_t ball, float reach) {
  insert(balls, ball, reach);
  const bool is_crowded = regions_ > 16 * (std::size_t{mask_} + 1);
  if (++entered_ > regions_ + 64 || is_crowded) rebuild(balls);
}

/// Returns the name of the cell of a region, and its place in the hash table.
std::pair<std::uint64_t, std::uint32_t> RegionCells::cell_of(const Ball& ball, float reach) const {
  const std::size_t number = level_of(reach);
  const Level& level = levels_[number];
  const std::int64_t x = wrapped(cell_on(level, 0, ball.centre[0]), level.count[0]);
  const std::int64_t y = wrapped(cell_on(level, 1, ball.centre[1]), level.count[1]);
  const std::int64_t z = wrapped(cell_on(level, 2, ball.centre[2]), level.count[2]);
  return {name_of(number, x, y, z), (row_of(number, y, z) + static_cast<std::uint32_t>(x)) & mask_};
}

void RegionCells::prefetch(const Ball& ball, float reach) const {
  const char* const block = reinterpret_cast<const char*>(&blocks_[cell_of(ball, reach).second]);
  prefetch_line(block);
  prefetch_line(block + 64);
  prefetch_line(block + 128);
}

void RegionCells::insert(Balls& balls, std::uint32_t ball, float reach) {
  Ball& b = balls[ball];
  Level& level = levels_[level_of(reach)];
  ++level.regions;
  ++regions_;
  level.largest_reach = std::max(level.largest_reach, reach);
  const auto [name, head] = cell_of(b, reach);
  std::uint32_t place = none;
  for (std::uint32_t next = head; next != none; next = blocks_[next].next) {
    const RegionBlock& block = blocks_[next];
    if (block.count == 0 && place == none) place = next;
    if (block.count == 0 || block.count == lanes || block.cell != name) continue;
    place = next;
    break;
  }
  if (place == none) {
    place = static_cast<std::uint32_t>(blocks_.size());
    blocks_.emplace_back().next = blocks_[head].next;
    blocks_[head].next = place;
  }
  RegionBlock& block = blocks_[place];
  block.cell = name;
  const std::uint32_t lane = block.count++;
  block.x[lane] = b.centre[0], block.y[lane] = b.centre[1], block.z[lane] = b.centre[2];
  block.reach[lane] = reach;
  block.balls[lane] = ball;
  b.slot = place * lanes + lane;
}

void RegionCells::leave(Balls& balls, std::uint32_t ball) {
  const std::uint32_t slot = balls[ball].slot, lane = slot % lanes;
  RegionBlock& block = blocks_[slot / lanes];
  --levels_[level_of(block.reach[lane])].regions;
  --regions_;
  const std::uint32_t last = --block.count;
  block.x[lane] = block.x[last], block.y[lane] = block.y[last], block.z[lane] = block.z[last];
  block.reach[lane] = block.reach[last];
  block.balls[lane] = block.balls[last];
  balls[block.balls[lane]].slot = slot;
  balls[ball].slot = none;
  block.reach[last] = std::numeric_limits<float>::quiet_NaN();
}

bool RegionCells::are_near(const Ball& a, float reach_of_a, const Ball& b, float reach_of_b) const {
  RegionBlock block;
  block.x[0] = b.centre[0], block.y[0] = b.centre[1], block.z[0] = b.centre[2];
  block.reach[0] = reach_of_b;
  const std::uint32_t place = 0;
  std::uint32_t found[lanes];
  const RegionQuery query{a.centre[0], a.centre[1], a.centre[2], reach_of_a};
  return regions_within_reach(&block, &place, 1, query, float_periods_, found) == 1;
}

std::vector<std::pair<Box, std::size_t>> RegionCells::filled() const {
  std::map<std::tuple<std::size_t, std::int64_t, std::int64_t, std::int64_t>, std::size_t> counts;
  for (const RegionBlock& block : blocks_)
    for (std::uint32_t lane = 0; lane < block.count; ++lane) {
      const std::size_t number = level_of(block.reach[lane]);
      const Level& level = levels_[number];
      ++counts[{number, cell_on(level, 0, block.x[lane]), cell_on(level, 1, block.y[lane]),
                cell_on(level, 2, block.z[lane])}];
    }
  std::vector<std::pair<Box, std::size_t>> all;
  for (const auto& [cell, count] : counts) {
    const auto& [number, x, y, z] = cell;
    const std::array<double, 3>& by_width = levels_[number].by_width;
    const Vec3 lower{static_cast<double>(x) / by_width[0], static_cast<double>(y) / by_width[1],
                     static_cast<double>(z) / by_width[2]};
    all.push_back({{lower, lower + Vec3{1.0 / by_width[0], 1.0 / by_width[1], 1.0 / by_width[2]}}, count});
  }
  return all;
}

std::vector<RegionCells::Entry> RegionCells::entries() const {
  std::vector<Entry> all;
  all.reserve(regions_);
  for (const RegionBlock& block : blocks_)
    for (std::uint32_t lane = 0; lane < block.count; ++lane)
      all.push_back({block.balls[lane], block.reach[lane]});
  return all;
}

/// Mean number of regions in the cell of a region.
double RegionCells::crowding(std::size_t level) const {
  double sum = 0.0;
  for (std::uint32_t head = 0; head <= mask_; ++head)
    for (std::uint32_t one = head; one != none; one = blocks_[one].next)
      for (std::uint32_t other = head; other != none; other = blocks_[other].next)
        if (blocks_[one].cell == blocks_[other].cell && blocks_[one].cell >> 60 == level)
          sum += static_cast<double>(blocks_[one].count) * static_cast<double>(blocks_[other].count);
  return sum / levels_[level].regions;
}

/// Returns the width of cells that suits a level, given the present one. `narrowest`: of all levels.
double RegionCells::wanted_width(std::size_t number, double narrowest) const {
  const Level& level = levels_[number];
  const double by = std::clamp(wanted_in_cell / crowding(number), 0x1p-9, 0x1p9);
  const double width = level.width * (dimensions_ == 2 ? std::sqrt(by) : cube_root(by));
  return std::clamp(width, narrowest, 4.0 * static_cast<double>(level.largest_reach));
}

void RegionCells::rebuild(Balls& balls) {
  entered_ = 0;
  std::vector<Entry> all = entries();
  if (all.empty()) return;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end(),
                   [](const Entry& a, const Entry& b) { return a.reach < b.reach; });
  const float median = middle->reach;
  bool is_fine =
      median < 1.25F * median_ && median > 0.8F * median_ && std::size_t{mask_} + 1 >= regions_ / 4;
  if (!is_fine) {
    median_ = median;
    float top = 2.0F * median;
    for (Level& level : levels_) {
      level.top = top;
      set_width(level, 2.0 * static_cast<double>(top));
      top *= 4.0F;
    }
    insert_all(balls, all);
  }
  double slack = 1.25;
  for (int round = 0; round < 8; ++round) {
    is_fine = true;
    for (std::size_t number = 0; number < most_levels; ++number) {
      Level& level = levels_[number];
      if (level.regions == 0) continue;
      const double width = wanted_width(number, 0.5 * static_cast<double>(median_));
      if (width < slack * level.width && width * slack > level.width) continue;
      set_width(level, width);
      is_fine = false;
    }
    if (is_fine) return;
    insert_all(balls, all);
    slack = 1.08;
  }
}

void RegionCells::insert_all(Balls& balls, const std::vector<Entry>& all) {
  // While cells were too narrow there may have been many blocks.
  blocks_ = std::vector<RegionBlock>(std::bit_ceil(std::max<std::size_t>(all.size() / 4, 64)));
  mask_ = static_cast<std::uint32_t>(blocks_.size() - 1);
  regions_ = 0;
  for (Level& level : levels_) {
    level.regions = 0;
    level.largest_reach = 0.0F;
  }
  for (const Entry& entry : all) insert(balls, entry.ball, entry.reach);
}

void RegionCells::search(const Ball& ball, float reach, RegionSearch& search) const {
  const RegionQuery query{ball.centre[0], ball.centre[1], ball.centre[2], reach};
  search.count = 0;
  bool crosses = false;
  for (std::size_t level = 0; level < most_levels; ++level)
    if (levels_[level].regions > 0) crosses = list_cells(level, query, search) || crosses;
  list_blocks(search);
  search.found.resize(search.count * lanes);
  search.found.resize(regions_within_reach(blocks_.data(), search.places.data(), search.count, query,
                                           crosses ? float_periods_ : FloatPeriods(), search.found.data()));
}

/// Appends the blocks of all cells that may have a region within reach. Returns true if some of them may be
/// within reach in another image only.
bool RegionCells::list_cells(std::size_t number, const RegionQuery& query, RegionSearch& search) const {
  const Level& level = levels_[number];
  const double far = static_cast<double>(query.reach) + static_cast<double>(level.largest_reach);
  const std::array<Range, 3> ranges{range_on(level, 0, query.x, far), range_on(level, 1, query.y, far),
                                    range_on(level, 2, query.z, far)};
  const auto& [xs, ys, zs] = ranges;
  const double cells = xs.count() * ys.count() * zs.count();
  const bool takes_all = cells > static_cast<double>(blocks_.size());
  search.cells.resize(
      std::max(search.cells.size(), search.listed + (takes_all ? 0 : static_cast<std::size_t>(cells))));
  bool crosses = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const std::int64_t count = level.count[axis]; count > 0)
      crosses = crosses || ranges[axis].first < 0 || ranges[axis].last >= count ||
                ranges[axis].count() + 1.0 >= static_cast<double>(count);
  if (takes_all) {
    for (std::uint32_t place = 0; place < blocks_.size(); ++place)
      if (blocks_[place].count > 0 && blocks_[place].cell >> 60 == number) search.add_place(place);
    return crosses;
  }
  for (std::int64_t z = zs.first; z <= zs.last; ++z)
    for (std::int64_t y = ys.first; y <= ys.last; ++y) {
      const std::int64_t in_y = wrapped(y, level.count[1]), in_z = wrapped(z, level.count[2]);
      const std::uint32_t row = row_of(number, in_y, in_z);
      const std::uint64_t name = name_of(number, 0, in_y, in_z);
      for (std::int64_t x = xs.first; x <= xs.last; ++x) {
        const std::int64_t in_x = wrapped(x, level.count[0]);
        const std::uint32_t head = (row + static_cast<std::uint32_t>(in_x)) & mask_;
        const char* const block = reinterpret_cast<const char*>(&blocks_[head]);
        prefetch_line(block + 128);
        prefetch_line(block);
        prefetch_line(block + 64);
        search.cells[search.listed++] = {name | static_cast<std::uint64_t>(in_x & ((1 << 20) - 1)), head};
      }
    }
  return crosses;
}

void RegionCells::list_blocks(RegionSearch& search) const {
  for (std::size_t k = 0; k < search.listed; ++k)
    for (std::uint32_t place = search.cells[k].head; place != none; place = blocks_[place].next)
      if (blocks_[place].cell == search.cells[k].name && blocks_[place].count > 0) search.add_place(place);
  search.listed = 0;
}

}  // namespace kinesphere::core
