// Registration in the hierarchical hash grid.
#include "space/hash_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace kinesphere {
namespace {

constexpr float float_infinity = std::numeric_limits<float>::infinity();

float rounded_down(double value) {
  const float nearest = static_cast<float>(value);
  return static_cast<double>(nearest) <= value ? nearest : std::nextafter(nearest, -float_infinity);
}

float rounded_up(double value) { return -rounded_down(-value); }

/// Cell edges differ by this power of two from level to level.
constexpr int exponent_step = 2;
/// The finest cells are 2^this as large as the typical box.
constexpr int finest_above_mean = 1;
}  // namespace

FloatBox::FloatBox(const Box& box)
    : lower{rounded_down(box.lower.x), rounded_down(box.lower.y), rounded_down(box.lower.z)},
      upper{rounded_up(box.upper.x), rounded_up(box.upper.y), rounded_up(box.upper.z)} {}

float FloatBox::extent() const {
  return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]});
}

double HashGrid::CellRange::count() const {
  const auto length = [](std::int32_t a, std::int32_t b) { return static_cast<double>(b) - a + 1.0; };
  return length(first.x, last.x) * length(first.y, last.y) * length(first.z, last.z);
}

HashGrid::CellRange HashGrid::Level::range_of(const FloatBox& box) const {
  const auto coordinate = [this](float position) {
    return static_cast<std::int32_t>(std::floor(in_cells(position)));
  };
  const auto index = [&](const std::array<float, 3>& corner) {
    return CellIndex{coordinate(corner[0]), coordinate(corner[1]), coordinate(corner[2])};
  };
  return {index(box.lower), index(box.upper)};
}

std::size_t HashGrid::hash(const CellIndex& index) {
  std::uint64_t h = static_cast<std::uint32_t>(index.x) * 0x9e3779b97f4a7c15u;
  h = (h ^ static_cast<std::uint32_t>(index.y)) * 0xc2b2ae3d27d4eb4fu;
  h = (h ^ (h >> 29) ^ static_cast<std::uint32_t>(index.z)) * 0x165667b19e3779f9u;
  return static_cast<std::size_t>(h ^ (h >> 32));
}

const HashGrid::Cell* HashGrid::Level::find(const CellIndex& index) const {
  const std::size_t mask = slots.size() - 1;
  for (std::size_t slot = hash(index) & mask; slots[slot] != 0; slot = (slot + 1) & mask) {
    const Cell& cell = cells[slots[slot] - 1];
    if (cell.index == index) return &cell;
  }
  return nullptr;
}

HashGrid::Cell& HashGrid::Level::find_or_create(const CellIndex& index) {
  if (const Cell* cell = find(index)) return const_cast<Cell&>(*cell);
  if (2 * (cells.size() + 1) > slots.size()) rehash();
  cells.push_back({index, {}});
  ++empty_cells;
  const std::size_t mask = slots.size() - 1;
  std::size_t slot = hash(index) & mask;
  while (slots[slot] != 0) slot = (slot + 1) & mask;
  slots[slot] = static_cast<std::uint32_t>(cells.size());
  return cells.back();
}

/// Drops the empty cells and makes room for twice as many as remain.
void HashGrid::Level::rehash() {
  std::erase_if(cells, [](const Cell& cell) { return cell.entries.empty(); });
  empty_cells = 0;
  std::size_t capacity = 64;
  while (capacity < 4 * (cells.size() + 1)) capacity *= 2;
  slots.assign(capacity, 0);
  for (std::size_t number = 0; number < cells.size(); ++number) {
    std::size_t slot = hash(cells[number].index) & (capacity - 1);
    while (slots[slot] != 0) slot = (slot + 1) & (capacity - 1);
    slots[slot] = static_cast<std::uint32_t>(number + 1);
  }
}

int HashGrid::exponent_of(float extent) {
  // The smallest e with extent <= 2^e; a point counts as the smallest normal float, infinity as the greatest.
  int exponent = 0;
  using Limits = std::numeric_limits<float>;
  const float normal = std::clamp(extent, Limits::min(), Limits::max());
  const float fraction = std::frexp(normal, &exponent);
  return fraction == 0.5f ? exponent - 1 : exponent;
}

int HashGrid::level_for(float extent) const {
  const int above = exponent_of(extent) - finest_exponent_;
  return above <= 0 ? 0 : (above + exponent_step - 1) / exponent_step;
}

double HashGrid::cells_per_length(std::size_t level) const {
  return std::ldexp(1.0, -(finest_exponent_ + exponent_step * static_cast<int>(level)));
}

double HashGrid::largest_extent() const {
  for (std::size_t level = levels_.size(); level-- > 0;)
    if (levels_[level].bodies > 0) return 1.0 / cells_per_length(level);
  return 0.0;
}

void HashGrid::insert(std::uint32_t body, const FloatBox& box) {
  const int number = level_for(box.extent());
  while (levels_.size() <= static_cast<std::size_t>(number)) {
    Level level;
    level.cells_per_length = cells_per_length(levels_.size());
    level.rehash();
    levels_.push_back(std::move(level));
  }
  Level& level = levels_[static_cast<std::size_t>(number)];
  const CellRange range = level.range_of(box);
  for (std::int32_t z = range.first.z; z <= range.last.z; ++z)
    for (std::int32_t y = range.first.y; y <= range.last.y; ++y)
      for (std::int32_t x = range.first.x; x <= range.last.x; ++x) {
        Cell& cell = level.find_or_create({x, y, z});
        if (cell.entries.empty()) --level.empty_cells;
        cell.entries.push_back({box, body});
      }
  ++level.bodies;
  places_[body] = {number, box};
}

void HashGrid::erase(std::uint32_t body) {
  Place& place = places_[body];
  Level& level = levels_[static_cast<std::size_t>(place.level)];
  const CellRange range = level.range_of(place.box);
  for (std::int32_t z = range.first.z; z <= range.last.z; ++z)
    for (std::int32_t y = range.first.y; y <= range.last.y; ++y)
      for (std::int32_t x = range.first.x; x <= range.last.x; ++x) {
        Cell& cell = const_cast<Cell&>(*level.find({x, y, z}));
        const auto entry = std::find_if(cell.entries.begin(), cell.entries.end(),
                                        [body](const Entry& e) { return e.body == body; });
        *entry = cell.entries.back();
        cell.entries.pop_back();
        if (cell.entries.empty()) ++level.empty_cells;
      }
  --level.bodies;
  place.level = -1;
  if (level.empty_cells > 64 && level.empty_cells > level.cells.size() / 2) level.rehash();
}

void HashGrid::set(std::uint32_t body, const Box& box) {
  if (body >= places_.size()) places_.resize(body + 1);
  const FloatBox rounded(box);
  if (contains(body)) {
    exponent_sum_ -= exponent_of(places_[body].box.extent());
    erase(body);
  } else {
    ++size_;
  }
  exponent_sum_ += exponent_of(rounded.extent());
  insert(body, rounded);
  retune_if_worthwhile();
}

void HashGrid::remove(std::uint32_t body) {
  if (!contains(body)) return;
  exponent_sum_ -= exponent_of(places_[body].box.extent());
  erase(body);
  --size_;
}

/// Fits the finest level to the typical box, at most once in as many changes as there are bodies.
void HashGrid::retune_if_worthwhile() {
  if (++changes_since_tuning_ < size_) return;
  changes_since_tuning_ = 0;
  const double mean = static_cast<double>(exponent_sum_) / static_cast<double>(size_);
  const int wanted = static_cast<int>(std::floor(mean + 0.5)) + finest_above_mean;
  if (std::abs(mean + finest_above_mean - finest_exponent_) < 0.75) return;
  finest_exponent_ = wanted;
  levels_.clear();
  for (std::uint32_t body = 0; body < places_.size(); ++body)
    if (places_[body].level >= 0) insert(body, FloatBox(places_[body].box));
}

std::optional<std::string> HashGrid::check(std::uint32_t body, const Box& box) const {
  if (!contains(body)) return "is not registered";
  const FloatBox rounded(box);
  const Place& place = places_[body];
  if (place.box.lower != rounded.lower || place.box.upper != rounded.upper)
    return "is registered with another box";
  for (std::size_t number = 0; number < levels_.size(); ++number) {
    const Level& level = levels_[number];
    const CellRange range = level.range_of(rounded);
    double found = 0.0;
    for (const Cell& cell : level.cells)
      for (const Entry& entry : cell.entries) {
        if (entry.body != body) continue;
        if (!range.contains(cell.index) || static_cast<int>(number) != place.level)
          return "stands in a cell that its box does not meet";
        if (level.find(cell.index) != &cell) return "stands in a cell that the table does not find";
        ++found;
      }
    if (static_cast<int>(number) == place.level && found != range.count())
      return "is missing from a cell that its box meets";
  }
  return std::nullopt;
}

bool HashGrid::Level::table_is_sound() const {
  if (!std::has_single_bit(slots.size()) || 2 * cells.size() > slots.size()) return false;
  if (std::any_of(slots.begin(), slots.end(), [this](std::uint32_t s) { return s > cells.size(); }))
    return false;
  // The search for a cell ends at a free slot.
  const auto free = static_cast<std::size_t>(std::count(slots.begin(), slots.end(), 0u));
  return free + cells.size() == slots.size() && free > 0 &&
         std::all_of(cells.begin(), cells.end(), [this](const Cell& c) { return find(c.index) == &c; });
}

bool HashGrid::places_are_sound() const {
  std::size_t found = 0;
  std::int64_t exponents = 0;
  for (const Place& place : places_) {
    if (place.level < 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(place.box.lower[axis] <= place.box.upper[axis])) return false;
    const float extent = place.box.extent();
    if (std::isnan(extent) || place.level != level_for(extent)) return false;
    if (static_cast<std::size_t>(place.level) >= levels_.size()) return false;
    ++found;
    exponents += exponent_of(extent);
  }
  return found == size_ && exponents == exponent_sum_;
}

bool HashGrid::is_sound() const {
  // Twice what the exponents of floats can come to, so that nothing overflows below.
  constexpr int exponent_limit = 300;
  if (std::abs(finest_exponent_) > exponent_limit || levels_.size() > exponent_limit) return false;
  if (!places_are_sound()) return false;
  std::vector<double> missing(places_.size(), 0.0);
  std::vector<const Cell*> latest(places_.size(), nullptr);
  std::vector<std::size_t> bodies(levels_.size(), 0);
  for (std::uint32_t body = 0; body < places_.size(); ++body) {
    if (!contains(body)) continue;
    const auto number = static_cast<std::size_t>(places_[body].level);
    missing[body] = levels_[number].range_of(places_[body].box).count();
    ++bodies[number];
  }
  for (std::size_t number = 0; number < levels_.size(); ++number) {
    const Level& level = levels_[number];
    if (level.cells_per_length != cells_per_length(number) || level.bodies != bodies[number]) return false;
    if (!level.table_is_sound()) return false;
    std::size_t empty = 0;
    for (const Cell& cell : level.cells) {
      if (cell.entries.empty()) ++empty;
      for (const Entry& entry : cell.entries) {
        if (!contains(entry.body) || latest[entry.body] == &cell) return false;
        const Place& place = places_[entry.body];
        if (place.level != static_cast<int>(number) || !(place.box == entry.box)) return false;
        if (!level.range_of(place.box).contains(cell.index)) return false;
        latest[entry.body] = &cell;
        --missing[entry.body];
      }
    }
    if (empty != level.empty_cells) return false;
  }
  return std::all_of(missing.begin(), missing.end(), [](double cells) { return cells == 0.0; });
}

}  // namespace kinesphere
