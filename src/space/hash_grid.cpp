// Registration in the hierarchical hash grid.
#include "space/hash_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace kinesphere {
namespace {

/// The next float below one that is not -infinity.
float just_below(float value) {
  if (value == 0.0f) return -std::numeric_limits<float>::denorm_min();
  const auto bits = std::bit_cast<std::int32_t>(value);
  return std::bit_cast<float>(value > 0.0f ? bits - 1 : bits + 1);
}

float rounded_down(double value) {
  const float nearest = static_cast<float>(value);
  return static_cast<double>(nearest) <= value ? nearest : just_below(nearest);
}

float rounded_up(double value) { return -rounded_down(-value); }

/// Cell edges differ by this power of two from level to level.
constexpr int exponent_step = 2;
/// The finest cells are 2^this as large as the typical box.
constexpr int finest_above_mean = 1;

/// floor() of what fits 32 bits.
std::int32_t whole(double value) {
  const auto towards_zero = static_cast<std::int32_t>(value);
  return towards_zero - static_cast<std::int32_t>(value < towards_zero);
}

}  // namespace

FloatBox::FloatBox(const Box& box)
    : lower{rounded_down(box.lower.x), rounded_down(box.lower.y), rounded_down(box.lower.z)},
      upper{rounded_up(box.upper.x), rounded_up(box.upper.y), rounded_up(box.upper.z)} {}

double HashGrid::CellRange::count() const {
  const auto length = [](std::int32_t a, std::int32_t b) { return static_cast<double>(b) - a + 1.0; };
  return length(first.x, last.x) * length(first.y, last.y) * length(first.z, last.z);
}

HashGrid::CellIndex HashGrid::Level::cell_of(const FloatBox& box) const {
  return {whole(in_cells(box.lower[0])), whole(in_cells(box.lower[1])), whole(in_cells(box.lower[2]))};
}

/// The extent of a box in cells, with room for rounding, here and where a search takes it off.
double HashGrid::Level::reach_of(const FloatBox& box) const {
  constexpr float limit = std::numeric_limits<float>::max();
  return std::min(box.extent(), limit) * cells_per_length * (1.0 + 0x1p-20) + 0x1p-20;
}

HashGrid::CellRange HashGrid::Level::cells_around(const FloatBox& box) const {
  const auto first = [&](std::size_t axis) { return whole(in_cells(box.lower[axis]) - reach); };
  const auto last = [&](std::size_t axis) { return whole(in_cells(box.upper[axis])); };
  return {{first(0), first(1), first(2)}, {last(0), last(1), last(2)}};
}

void HashGrid::Cell::push(const FloatBox& box, std::uint32_t body) {
  if (size == blocks.size() * BoxBlock::width) blocks.emplace_back();
  blocks[size / BoxBlock::width].put(size % BoxBlock::width, box, body);
  ++size;
}

void HashGrid::Cell::erase(std::uint32_t body) {
  std::size_t place = 0;
  while (blocks[place / BoxBlock::width].body(place % BoxBlock::width) != body) ++place;
  --size;
  BoxBlock& last = blocks.back();
  const std::size_t last_place = size % BoxBlock::width;
  blocks[place / BoxBlock::width].put(place % BoxBlock::width, last.box(last_place), last.body(last_place));
  last.clear(last_place);
  if (last_place == 0) blocks.pop_back();
}

HashGrid::Cell& HashGrid::Level::find_or_create(const CellIndex& index) {
  if (const Cell* cell = find(index)) return const_cast<Cell&>(*cell);
  if (2 * (cells.size() + 1) > slots.size()) rehash();
  cells.push_back({index, 0, {}});
  ++empty_cells;
  slots[free_slot(index)] = {index, static_cast<std::uint32_t>(cells.size())};
  return cells.back();
}

std::size_t HashGrid::Level::free_slot(const CellIndex& index) const {
  const std::size_t mask = slots.size() - 1;
  std::size_t slot = first_slot(hash(index));
  while (slots[slot].cell != 0) slot = (slot + 1) & mask;
  return slot;
}

/// Drops the empty cells and makes room for twice as many as remain.
void HashGrid::Level::rehash() {
  std::erase_if(cells, [](const Cell& cell) { return cell.size == 0; });
  empty_cells = 0;
  std::size_t capacity = 64;
  while (capacity < 4 * (cells.size() + 1)) capacity *= 2;
  slots.assign(capacity, {});
  for (std::size_t number = 0; number < cells.size(); ++number) {
    const CellIndex& index = cells[number].index;
    slots[free_slot(index)] = {index, static_cast<std::uint32_t>(number + 1)};
  }
}

namespace {

/// A point counts as the smallest normal float, infinity as the greatest.
std::uint32_t bits_of(float extent) {
  using Limits = std::numeric_limits<float>;
  return std::bit_cast<std::uint32_t>(std::clamp(extent, Limits::min(), Limits::max()));
}

constexpr int mantissa_bits = 23;
constexpr int exponent_bias = 127;

}  // namespace

/// The smallest e with extent <= 2^e.
int HashGrid::exponent_of(float extent) {
  const std::uint32_t rounded_up = bits_of(extent) + ((1u << mantissa_bits) - 1u);
  return static_cast<int>(rounded_up >> mantissa_bits) - exponent_bias;
}

/// About 2^octave_bits times log2 of an extent: linear between powers of two, as the bits of a float are.
std::int64_t HashGrid::size_of(float extent) {
  return static_cast<std::int64_t>(bits_of(extent) >> (mantissa_bits - octave_bits)) -
         (exponent_bias << octave_bits);
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
    if (levels_[level].bodies > 0) return levels_[level].reach / cells_per_length(level);
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
  Cell& cell = level.find_or_create(level.cell_of(box));
  if (cell.size == 0) --level.empty_cells;
  cell.push(box, body);
  level.reach = std::max(level.reach, level.reach_of(box));
  ++level.bodies;
  places_[body] = {number, box};
}

void HashGrid::erase(std::uint32_t body) {
  Place& place = places_[body];
  Level& level = levels_[static_cast<std::size_t>(place.level)];
  Cell& cell = level.find_or_create(level.cell_of(place.box));
  cell.erase(body);
  if (cell.size == 0) ++level.empty_cells;
  --level.bodies;
  place.level = -1;
  if (level.empty_cells > 64 && level.empty_cells > level.cells.size() / 2) level.rehash();
}

void HashGrid::set(std::uint32_t body, const Box& box) {
  if (body >= places_.size()) places_.resize(body + 1);
  const FloatBox rounded(box);
  if (contains(body)) {
    size_sum_ -= size_of(places_[body].box.extent());
    erase(body);
  } else {
    ++size_;
  }
  size_sum_ += size_of(rounded.extent());
  insert(body, rounded);
  retune_if_worthwhile();
}

void HashGrid::remove(std::uint32_t body) {
  if (!contains(body)) return;
  size_sum_ -= size_of(places_[body].box.extent());
  erase(body);
  --size_;
}

/// Fits the finest level to the typical box, at most once in as many changes as there are bodies.
void HashGrid::retune_if_worthwhile() {
  if (++changes_since_tuning_ < size_) return;
  changes_since_tuning_ = 0;
  const double mean = static_cast<double>(size_sum_) / ((1 << octave_bits) * static_cast<double>(size_));
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
  bool found = false;
  std::optional<std::string> wrong;
  for (std::size_t number = 0; number < levels_.size(); ++number) {
    const Level& level = levels_[number];
    for (const Cell& cell : level.cells)
      cell.for_each([&](const FloatBox& there, std::uint32_t other) {
        if (other != body) return;
        if (found) wrong = "is registered twice";
        if (static_cast<int>(number) != place.level || cell.index != level.cell_of(rounded))
          wrong = "stands in another cell than that of its lower corner";
        if (level.find(cell.index) != &cell) wrong = "stands in a cell that the table does not find";
        if (there != rounded) wrong = "stands in its cell with another box";
        found = true;
      });
  }
  if (!found) wrong = "is missing from its cell";
  return wrong;
}

bool HashGrid::Level::table_is_sound() const {
  if (!std::has_single_bit(slots.size()) || 2 * cells.size() > slots.size()) return false;
  for (const Slot& slot : slots)
    if (slot.cell > cells.size() || (slot.cell != 0 && cells[slot.cell - 1].index != slot.index))
      return false;
  // The search for a cell ends at a free slot.
  const auto is_free = [](const Slot& slot) { return slot.cell == 0; };
  const auto free = static_cast<std::size_t>(std::count_if(slots.begin(), slots.end(), is_free));
  return free + cells.size() == slots.size() && free > 0 &&
         std::all_of(cells.begin(), cells.end(), [this](const Cell& c) { return find(c.index) == &c; });
}

/// As many blocks as needed, and nothing in the places behind the last body.
bool HashGrid::Cell::is_sound() const {
  if (blocks.size() != (std::size_t{size} + BoxBlock::width - 1) / BoxBlock::width) return false;
  for (std::size_t place = size; place < blocks.size() * BoxBlock::width; ++place)
    if (!blocks[place / BoxBlock::width].is_free(place % BoxBlock::width)) return false;
  return true;
}

bool HashGrid::places_are_sound() const {
  std::size_t found = 0;
  std::int64_t sizes = 0;
  for (const Place& place : places_) {
    if (place.level < 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(place.box.lower[axis] <= place.box.upper[axis])) return false;
    const float extent = place.box.extent();
    if (std::isnan(extent) || place.level != level_for(extent)) return false;
    if (static_cast<std::size_t>(place.level) >= levels_.size()) return false;
    ++found;
    sizes += size_of(extent);
  }
  return found == size_ && sizes == size_sum_;
}

bool HashGrid::is_sound() const {
  // Twice what the exponents of floats can come to, so that nothing overflows below.
  constexpr int exponent_limit = 300;
  if (std::abs(finest_exponent_) > exponent_limit || levels_.size() > exponent_limit) return false;
  if (!places_are_sound()) return false;
  std::vector<bool> found(places_.size(), false);
  std::size_t standing = 0;
  for (std::size_t number = 0; number < levels_.size(); ++number) {
    const Level& level = levels_[number];
    if (level.cells_per_length != cells_per_length(number) || !level.table_is_sound()) return false;
    if (!(level.reach <= 2.0)) return false;
    std::size_t empty = 0;
    std::size_t bodies = 0;
    for (const Cell& cell : level.cells) {
      if (!cell.is_sound()) return false;
      if (cell.size == 0) ++empty;
      bodies += cell.size;
      bool sound = true;
      cell.for_each([&](const FloatBox& box, std::uint32_t body) {
        sound = sound && contains(body) && !found[body];
        if (!sound) return;
        const Place& place = places_[body];
        sound = place.level == static_cast<int>(number) && place.box == box &&
                level.cell_of(box) == cell.index && level.reach_of(box) <= level.reach;
        found[body] = true;
      });
      if (!sound) return false;
    }
    if (empty != level.empty_cells || bodies != level.bodies) return false;
    standing += bodies;
  }
  return standing == size_;
}

}  // namespace kinesphere
