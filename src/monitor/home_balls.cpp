#include "monitor/home_balls.hpp"

#include <algorithm>
#include <cmath>

#include "number/powers.hpp"

namespace kinesphere {
namespace {

int level_of_ball(const HomeBall& ball) { return exponent_of(2.0 * ball.radius) + 1; }

std::array<std::int64_t, 3> cell_at(const Vec3& place, double edge) {
  const auto index = [edge](double x) { return static_cast<std::int64_t>(std::floor(x / edge)); };
  return {index(place.x), index(place.y), index(place.z)};
}

}  // namespace

std::size_t HomeBalls::HashOfCell::operator()(const Cell& cell) const {
  std::uint64_t hash = 0;
  for (const std::int64_t index : cell) {
    hash = (hash ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

void HomeBalls::add(std::uint32_t number, const HomeBall& ball) {
  const int exponent = level_of_ball(ball);
  const Cell cell = cell_at(ball.centre, power_of_two(exponent));
  const auto [at, is_new] = levels_.try_emplace(exponent);
  Level& level = at->second;
  if (is_new) level.lowest = level.highest = cell;
  for (std::size_t axis = 0; axis < cell.size(); ++axis) {
    level.lowest[axis] = std::min(level.lowest[axis], cell[axis]);
    level.highest[axis] = std::max(level.highest[axis], cell[axis]);
  }
  level.cells[cell].push_back({number, ball});
}

void HomeBalls::remove(std::uint32_t number, const HomeBall& ball) {
  const auto level = levels_.find(level_of_ball(ball));
  auto& cells = level->second.cells;
  const auto cell = cells.find(cell_at(ball.centre, power_of_two(level->first)));
  std::erase_if(cell->second, [number](const Entry& entry) { return entry.number == number; });
  if (cell->second.empty()) cells.erase(cell);
  if (cells.empty()) levels_.erase(level);
}

std::vector<std::uint32_t> HomeBalls::touching(const HomeBall& ball) const {
  std::vector<std::uint32_t> numbers;
  const auto add_touching = [&](const std::vector<Entry>& entries) {
    for (const Entry& entry : entries)
      if (touch(entry.ball, ball)) numbers.push_back(entry.number);
  };
  for (const auto& [exponent, level] : levels_) {
    const auto& cells = level.cells;
    const double edge = power_of_two(exponent);
    // Balls of a level reach out of their cells by half an edge at most.
    const double reach = ball.radius + 0.5 * edge;
    const Vec3 corner{reach, reach, reach};
    Cell low = cell_at(ball.centre - corner, edge);
    Cell high = cell_at(ball.centre + corner, edge);
    double count = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::max(low[axis], level.lowest[axis]);
      high[axis] = std::min(high[axis], level.highest[axis]);
      count *= static_cast<double>(std::max(high[axis] - low[axis] + 1, std::int64_t{0}));
    }
    if (count > static_cast<double>(cells.size())) {
      for (const auto& [cell, entries] : cells) add_touching(entries);
      continue;
    }
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z)
          if (const auto found = cells.find(Cell{x, y, z}); found != cells.end()) add_touching(found->second);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace kinesphere
