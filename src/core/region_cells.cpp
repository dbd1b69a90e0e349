#include "core/region_cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

namespace kinesphere::core {
namespace {

std::int64_t wrapped(std::int64_t cell, std::int64_t count) {
  if (count == 0) return cell;
  if (cell < 0) return cell + count;
  return cell >= count ? cell - count : cell;
}

/// Rounds towards minus infinity.
std::int64_t whole(double value) {
  value = std::clamp(value, -0x1p60, 0x1p60);
  const auto below = static_cast<std::int64_t>(value);
  return below - static_cast<std::int64_t>(static_cast<double>(below) > value);
}

}  // namespace

RegionCells::RegionCells(const Vec3& period, int dimensions) : period_(period), dimensions_(dimensions) {
  add_blocks(chains_);
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

/// Returns the cell of a centre. On an axis that repeats, centres lie in the primary box, hardly beyond for
/// rounding.
std::array<std::int64_t, 3> RegionCells::cell_of(const Level& level, float x, float y, float z) const {
  const auto on = [](const Axis& axis, float at) {
    return wrapped(whole(double{at} * axis.by_width), axis.count);
  };
  return {on(level.axes[0], x), on(level.axes[1], y), on(level.axes[2], z)};
}

std::uint32_t RegionCells::chain_of(const Level& level, const std::array<std::int64_t, 3>& cell) const {
  std::uint32_t chain = level.origin;
  for (std::size_t axis = 0; axis < 3; ++axis)
    chain += static_cast<std::uint32_t>(cell[axis]) * level.axes[axis].stride;
  return within_table(chain);
}

void RegionCells::enter(Balls& balls, std::uint32_t ball, float reach) {
  insert(balls, ball, reach);
  const bool is_crowded = regions_ > 16 * std::size_t{chains_};
  if (++entered_ > 2 * regions_ + 64 || is_crowded) rebuild(balls);
}

void RegionCells::add_unsorted(Balls& balls, std::uint32_t ball, float reach) {
  ++regions_;
  std::size_t place = blocks_.size() - 1;
  // Those of all chains come first.
  if (place < chains_ || links_[place].count == lanes) {
    add_blocks(1);
    ++place;
  }
  put(balls, ball, reach, static_cast<std::uint32_t>(place));
}

void RegionCells::prefetch(const Ball& ball, float reach) const {
  const Level& level = levels_[level_of(reach)];
  const auto cell = cell_of(level, ball.centre[0], ball.centre[1], ball.centre[2]);
  const char* const block = reinterpret_cast<const char*>(&blocks_[chain_of(level, cell)]);
  prefetch_line(block);
  prefetch_line(block + 64);
}

void RegionCells::insert(Balls& balls, std::uint32_t ball, float reach) {
  const Ball& b = balls[ball];
  Level& level = levels_[level_of(reach)];
  ++level.regions;
  ++regions_;
  level.largest_reach = std::max(level.largest_reach, reach);
  const auto cell = cell_of(level, b.centre[0], b.centre[1], b.centre[2]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Axis& a = level.axes[axis];
    if (a.filled.contains(cell[axis])) continue;
    a.filled = {std::min(a.filled.first, cell[axis]), std::max(a.filled.last, cell[axis])};
    if (!a.reserved.contains(cell[axis])) level.shares = true;
  }
  std::uint32_t place = chain_of(level, cell);
  while (links_[place].count == lanes && links_[place].next != none) place = links_[place].next;
  if (links_[place].count == lanes) {
    const auto fresh = static_cast<std::uint32_t>(blocks_.size());
    add_blocks(1);
    place = links_[place].next = fresh;
  }
  put(balls, ball, reach, place);
}

/// Puts a region into a block that has room.
void RegionCells::put(Balls& balls, std::uint32_t ball, float reach, std::uint32_t place) {
  Ball& b = balls[ball];
  const std::uint32_t lane = links_[place].count++;
  RegionBlock& block = blocks_[place];
  block.x[lane] = b.centre[0], block.y[lane] = b.centre[1], block.z[lane] = b.centre[2];
  block.reach[lane] = reach;
  balls_[place].balls[lane] = ball;
  b.slot = place * lanes + lane;
}

void RegionCells::add_blocks(std::size_t count) {
  const std::size_t size = blocks_.size() + count;
  const auto extend = [=](auto& all) {
    // Hardly more than there are: they are a good part of the memory of a world.
    if (size > all.capacity()) all.reserve(size + size / 16);
    all.resize(size);
  };
  extend(blocks_);
  extend(balls_);
  extend(links_);
}

void RegionCells::leave(Balls& balls, std::uint32_t ball) {
  const std::uint32_t slot = balls[ball].slot, place = slot / lanes, lane = slot % lanes;
  RegionBlock& block = blocks_[place];
  --levels_[level_of(block.reach[lane])].regions;
  --regions_;
  const std::uint32_t last = --links_[place].count, moved = balls_[place].balls[last];
  block.x[lane] = block.x[last], block.y[lane] = block.y[last], block.z[lane] = block.z[last];
  block.reach[lane] = block.reach[last];
  balls_[place].balls[lane] = moved;
  balls[moved].slot = slot;
  balls[ball].slot = none;
  block.reach[last] = std::numeric_limits<float>::quiet_NaN();
}

bool RegionCells::are_near(const Ball& a, float reach_of_a, const Ball& b, float reach_of_b) const {
  RegionBlock block;
  block.x[0] = b.centre[0], block.y[0] = b.centre[1], block.z[0] = b.centre[2];
  block.reach[0] = reach_of_b;
  const BallBlock balls{};
  const std::uint32_t place = 0;
  std::uint32_t found[lanes];
  const RegionQuery query{a.centre[0], a.centre[1], a.centre[2], reach_of_a};
  return regions_within_reach(&block, &balls, &place, 1, query, float_periods_, found) == 1;
}

std::vector<std::pair<Box, std::size_t>> RegionCells::filled() const {
  std::map<std::pair<std::size_t, std::array<std::int64_t, 3>>, std::size_t> counts;
  for (std::size_t place = 0; place < blocks_.size(); ++place)
    for (std::uint32_t lane = 0; lane < links_[place].count; ++lane) {
      const RegionBlock& block = blocks_[place];
      const std::size_t number = level_of(block.reach[lane]);
      ++counts[{number, cell_of(levels_[number], block.x[lane], block.y[lane], block.z[lane])}];
    }
  std::vector<std::pair<Box, std::size_t>> all;
  for (const auto& [key, count] : counts) {
    Vec3 lower, width;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      width[static_cast<int>(axis)] = levels_[key.first].axes[axis].width;
      lower[static_cast<int>(axis)] =
          static_cast<double>(key.second[axis]) * levels_[key.first].axes[axis].width;
    }
    all.push_back({{lower, lower + width}, count});
  }
  return all;
}

void RegionCells::start_search(const Ball& ball, float reach, RegionSearch& search) const {
  search.query = {ball.centre[0], ball.centre[1], ball.centre[2], reach};
  search.count = 0;
  search.crosses = search.may_repeat = false;
  for (const Level& level : levels_) {
    if (level.regions == 0) continue;
    const std::array<Range, 3> near = cells_near(level, search.query);
    double cells = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double count = near[axis].count();
      cells *= std::max(count, 0.0);
      if (const std::int64_t around = level.axes[axis].count; around > 0)
        search.crosses = search.crosses || near[axis].first < 0 || near[axis].last >= around ||
                         count + 1.0 >= static_cast<double>(around);
    }
    if (!(cells > 0.0)) continue;
    if (cells > static_cast<double>(blocks_.size())) return list_all(search);
    search.may_repeat = search.may_repeat || level.shares;
    search.reserve(static_cast<std::size_t>(cells) + 1);
    list_cells(level, near, search);
  }
  follow_chains(search);
}

void RegionCells::finish_search(RegionSearch& search) const {
  if (search.room.size() < search.count * lanes) search.room.resize(2 * search.count * lanes);
  const std::size_t found =
      regions_within_reach(blocks_.data(), balls_.data(), search.places.data(), search.count, search.query,
                           search.crosses ? float_periods_ : FloatPeriods(), search.room.data());
  search.found = std::span(search.room).first(found);
}

/// Returns the cells on each axis in which there may be regions within reach. On an axis that repeats, they
/// may go on into the next boxes.
std::array<RegionCells::Range, 3> RegionCells::cells_near(const Level& level,
                                                          const RegionQuery& query) const {
  const double far = static_cast<double>(query.reach) + static_cast<double>(level.largest_reach);
  const auto on = [far](const Axis& axis, float at) -> Range {
    const Range range{whole((double{at} - far) * axis.by_width), whole((double{at} + far) * axis.by_width)};
    if (axis.count == 0)
      return {std::max(range.first, axis.filled.first), std::min(range.last, axis.filled.last)};
    return range.last - range.first >= axis.count ? Range{0, axis.count - 1} : range;
  };
  return {on(level.axes[0], query.x), on(level.axes[1], query.y), on(level.axes[2], query.z)};
}

/// Lists up to `most_steps` cells on an axis from `first` on: where their chains are, seen from that of cell
/// 0, and the square of how far the cells are from `at`, at least, with room for rounding.
std::span<const RegionCells::Step> RegionCells::steps_on(const Axis& axis, const Range& range,
                                                         std::int64_t first, float at, double far,
                                                         std::array<Step, most_steps>& steps) {
  const bool is_everywhere = axis.count > 0 && range.count() >= static_cast<double>(axis.count);
  const double margin = 0x1p-40 * (std::abs(double{at}) + far + axis.width);
  std::size_t count = 0;
  for (std::int64_t cell = first; cell <= range.last && count < most_steps; ++cell) {
    const double lower = static_cast<double>(cell) * axis.width;
    const double gap = std::max(lower - double{at}, double{at} - (lower + axis.width));
    const double least = is_everywhere ? 0.0 : std::max(gap - margin, 0.0);
    steps[count++] = {static_cast<std::uint32_t>(wrapped(cell, axis.count)) * axis.stride, least * least};
  }
  return std::span(steps).first(count);
}

/// Appends the first blocks of cells that may have a region within reach.
void RegionCells::list_cells(const Level& level, const std::array<Range, 3>& near,
                             RegionSearch& search) const {
  const auto& [xs, ys, zs] = near;
  const auto& [on_x, on_y, on_z] = level.axes;
  const RegionQuery& query = search.query;
  const double far = static_cast<double>(query.reach) + static_cast<double>(level.largest_reach);
  std::array<Step, most_steps> of_x, of_y, of_z;
  std::uint32_t* place = search.places.data() + search.count;
  const auto list = [&](std::span<const Step> row, std::uint32_t chain, double left) {
    for (const Step& step : row) {
      // Without a branch, which would be mispredicted.
      *place = within_table(chain + step.chains);
      const char* const block = reinterpret_cast<const char*>(&blocks_[*place]);
      prefetch_line(block);
      prefetch_line(block + 64);
      place += static_cast<std::ptrdiff_t>(step.away <= left);
    }
  };
  for (std::int64_t x = xs.first; x <= xs.last; x += most_steps) {
    const auto row = steps_on(on_x, xs, x, query.x, far, of_x);
    for (std::int64_t y = ys.first; y <= ys.last; y += most_steps) {
      const auto rows = steps_on(on_y, ys, y, query.y, far, of_y);
      for (std::int64_t z = zs.first; z <= zs.last; z += most_steps)
        for (const Step& layer : steps_on(on_z, zs, z, query.z, far, of_z))
          for (const Step& step : rows)
            list(row, level.origin + layer.chains + step.chains, far * far - layer.away - step.away);
    }
  }
  search.count = static_cast<std::size_t>(place - search.places.data());
}

/// Lists all blocks that have regions.
void RegionCells::list_all(RegionSearch& search) const {
  search.count = 0;
  search.crosses = true;
  search.may_repeat = false;
  search.reserve(blocks_.size());
  for (std::uint32_t place = 0; place < blocks_.size(); ++place)
    if (links_[place].count > 0) search.places[search.count++] = place;
}

/// Appends the further blocks of all chains of which the first ones are listed.
void RegionCells::follow_chains(RegionSearch& search) const {
  for (std::size_t k = 0; k < search.count; ++k) {
    const std::uint32_t next = links_[search.places[k]].next;
    if (next == none) continue;
    search.reserve(1);
    search.places[search.count++] = next;
  }
}

}  // namespace kinesphere::core
