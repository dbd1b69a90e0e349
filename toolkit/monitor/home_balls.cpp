#include "monitor/home_balls.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "number/powers.hpp"

namespace kinesphere {
namespace {

constexpr std::size_t fewest_buckets = 64;
constexpr std::size_t buckets_for_each = 2;

/// Returns the level of a ball, an even number: with every second power of two there are fewer levels to
/// search.
int level_of_ball(const HomeBall& ball) {
  const int exponent = exponent_of(2.0 * ball.radius) + 1;
  return exponent + (exponent & 1);
}

}  // namespace

HomeBalls::Cell HomeBalls::cell_at(const Vec3& place, int exponent) {
  const double edge = power_of_two(exponent);
  const auto index = [edge](double x) { return static_cast<std::int64_t>(std::floor(x / edge)); };
  return {index(place.x), index(place.y), index(place.z)};
}

std::size_t HomeBalls::bucket_of(int exponent, const Cell& cell) const {
  std::uint64_t hash = static_cast<std::uint64_t>(exponent);
  for (const std::int64_t index : cell) {
    hash = (hash ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash) & (first_.size() - 1);
}

std::size_t HomeBalls::bucket_of(const HomeBall& ball) const {
  const int exponent = level_of_ball(ball);
  return bucket_of(exponent, cell_at(ball.centre, exponent));
}

/// Makes room for another ball in the hash table.
void HomeBalls::grow() {
  if (buckets_for_each * (balls_ + 1) <= first_.size()) return;
  first_.assign(std::max(fewest_buckets, 2 * first_.size()), none);
  for (std::uint32_t number = 0; number < entries_.size(); ++number) {
    if (entries_[number].ball.radius == 0.0) continue;
    std::uint32_t& first = first_[bucket_of(entries_[number].ball)];
    entries_[number].next = std::exchange(first, number);
  }
}

void HomeBalls::add(std::uint32_t number, const HomeBall& ball) {
  grow();
  ++balls_;
  if (number >= entries_.size()) entries_.resize(number + 1);
  std::uint32_t& first = first_[bucket_of(ball)];
  entries_[number] = {ball, std::exchange(first, number)};
  const int exponent = level_of_ball(ball);
  const Cell cell = cell_at(ball.centre, exponent);
  Level& level = levels_[exponent];
  if (level.balls++ == 0) level.lowest = level.highest = cell;
  for (std::size_t axis = 0; axis < cell.size(); ++axis) {
    level.lowest[axis] = std::min(level.lowest[axis], cell[axis]);
    level.highest[axis] = std::max(level.highest[axis], cell[axis]);
  }
}

void HomeBalls::remove(std::uint32_t number) {
  const HomeBall ball = std::exchange(entries_[number].ball, {});
  std::uint32_t* link = &first_[bucket_of(ball)];
  while (*link != number) link = &entries_[*link].next;
  *link = entries_[number].next;
  --balls_;
  const auto level = levels_.find(level_of_ball(ball));
  if (--level->second.balls == 0) levels_.erase(level);
}

std::vector<std::uint32_t> HomeBalls::touching(const HomeBall& ball) const {
  std::vector<std::uint32_t> numbers;
  std::vector<Range> ranges;
  double cells = 0.0;
  for (const auto& [exponent, level] : levels_) {
    // Balls of a level reach out of their cells by half an edge at most.
    const double reach = ball.radius + 0.5 * power_of_two(exponent);
    const Vec3 corner{reach, reach, reach};
    Range range{exponent, cell_at(ball.centre - corner, exponent), cell_at(ball.centre + corner, exponent)};
    double count = 1.0;
    for (std::size_t axis = 0; axis < range.lowest.size(); ++axis) {
      std::int64_t& lowest = range.lowest[axis];
      std::int64_t& highest = range.highest[axis];
      lowest = std::max(lowest, level.lowest[axis]);
      highest = std::min(highest, level.highest[axis]);
      count *= static_cast<double>(std::max(highest - lowest + 1, std::int64_t{0}));
    }
    cells += count;
    ranges.push_back(range);
  }
  if (cells > static_cast<double>(balls_)) {
    for (std::uint32_t number = 0; number < entries_.size(); ++number)
      if (const HomeBall& other = entries_[number].ball; other.radius > 0.0 && touch(other, ball))
        numbers.push_back(number);
    return numbers;
  }
  for (const auto& [exponent, lowest, highest] : ranges)
    for (std::int64_t x = lowest[0]; x <= highest[0]; ++x)
      for (std::int64_t y = lowest[1]; y <= highest[1]; ++y)
        for (std::int64_t z = lowest[2]; z <= highest[2]; ++z)
          for (std::uint32_t number = first_[bucket_of(exponent, {x, y, z})]; number != none;
               number = entries_[number].next)
            if (touch(entries_[number].ball, ball)) numbers.push_back(number);
  // Two cells may have the same bucket.
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

}  // namespace kinesphere
