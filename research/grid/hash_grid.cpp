// Registration of boxes in the hierarchical hash grid.
#include "research/grid/hash_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "number/bit_cast.hpp"

namespace kinesphere {
namespace {

/// Returns the largest float that is not above `value`. It has no branches, as half of all values are rounded
/// up first and no branch predictor foresees which.
float rounded_down(double value) {
  const float nearest = static_cast<float>(value);
  const auto above = static_cast<std::int32_t>(static_cast<double>(nearest) > value);
  const auto bits = bit_cast<std::int32_t>(nearest);
  const std::int32_t sign = (bits >> 31) | 1;
  return bit_cast<float>(bits - above * sign);
}

float rounded_up(double value) { return -rounded_down(-value); }

/// Base-two logarithm of the ratio of cell edges between neighbouring levels.
constexpr int exponent_step = 2;
/// Base-two logarithm of the ratio of the finest cell edge to the typical box.
constexpr int finest_above_mean = 2;

}  // namespace

FloatBox::FloatBox(const Box& box)
    : lower{rounded_down(box.lower.x), rounded_down(box.lower.y), rounded_down(box.lower.z)},
      upper{rounded_up(box.upper.x), rounded_up(box.upper.y), rounded_up(box.upper.z)} {}

StepBox HashGrid::Steps::low_bits() const {
  const auto low = [](const std::array<std::int64_t, 3>& steps) {
    return std::array{static_cast<StepBox::Step>(steps[0]), static_cast<StepBox::Step>(steps[1]),
                      static_cast<StepBox::Step>(steps[2])};
  };
  return {low(lower), low(upper)};
}

bool HashGrid::Steps::is_narrow() const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (upper[axis] - lower[axis] > StepBox::farthest / 2) return false;
  return true;
}

HashGrid::Steps HashGrid::Steps::seen_from(const CellIndex& cell) const {
  Steps part = *this;
  const std::array<std::int64_t, 3> index{cell.x, cell.y, cell.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t origin = index[axis] << cell_bits;
    part.lower[axis] = std::max(lower[axis], origin);
    part.upper[axis] = std::min(upper[axis], origin + steps_per_cell - 1);
  }
  return part;
}

double HashGrid::CellRange::count() const {
  const auto length = [](std::int32_t a, std::int32_t b) { return static_cast<double>(b) - a + 1.0; };
  return length(first.x, last.x) * length(first.y, last.y) * length(first.z, last.z);
}

HashGrid::Steps HashGrid::Level::steps_of(const FloatBox& box) const {
  return {{step_at(box.lower[0]), step_at(box.lower[1]), step_at(box.lower[2])},
          {step_at(box.upper[0]), step_at(box.upper[1]), step_at(box.upper[2])}};
}

/// Returns a position beyond the range of cell coordinates, clamped to that range (steps).
double HashGrid::Level::outermost(float position) const {
  constexpr float farthest = std::numeric_limits<float>::max();
  const double steps = std::clamp(position, -farthest, farthest) * steps_per_length_;
  return std::clamp(steps, -coordinate_limit, coordinate_limit);
}

HashGrid::CellIndex HashGrid::Level::cell_of(const FloatBox& box) const {
  const auto cell = [&](std::size_t axis) { return Steps::cell_on(step_at(box.lower[axis])); };
  return {cell(0), cell(1), cell(2)};
}

HashGrid::CellRange HashGrid::Level::cells_around(const Steps& box) const {
  const auto first = [&](std::size_t axis) { return Steps::cell_on(box.lower[axis] - reach_[axis]); };
  const auto last = [&](std::size_t axis) { return Steps::cell_on(box.upper[axis]); };
  return {{first(0), first(1), first(2)}, {last(0), last(1), last(2)}};
}

std::uint32_t HashGrid::Level::take_block() {
  if (free_blocks_.empty()) {
    blocks_.emplace_back();
    links_.emplace_back();
    return static_cast<std::uint32_t>(blocks_.size() - 1);
  }
  const std::uint32_t block = free_blocks_.back();
  free_blocks_.pop_back();
  return block;
}

void HashGrid::Level::insert(const FloatBox& box, std::uint32_t body) {
  const Steps steps = steps_of(box);
  const CellIndex index = steps.cell();
  std::size_t slot = slot_of(index);
  if (slots_[slot].is_free()) {
    if (2 * (cells_ + 1) > slots_.size()) {
      rehash();
      slot = slot_of(index);
    }
    slots_[slot] = {index, take_block()};
    ++cells_;
    ++empty_cells_;
  }
  std::uint32_t& front = slots_[slot].first_block;
  if (links_[front].size == BoxBlock::width) {
    const std::uint32_t full = front;
    front = take_block();
    links_[front].next = full;
  } else if (links_[front].size == 0) {
    --empty_cells_;
  }
  blocks_[front].put(links_[front].size++, steps.low_bits(), body);
  ++bodies_;
  widen_reach(steps);
}

void HashGrid::Level::widen_reach(const Steps& steps) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    reach_[axis] = std::max(reach_[axis], steps.upper[axis] - steps.lower[axis]);
}

HashGrid::Level::Standing HashGrid::Level::find(const CellIndex& index, std::uint32_t body) const {
  const std::size_t slot = slot_of(index);
  for (std::uint32_t block = slots_[slot].first_block;; block = links_[block].next) {
    const std::size_t place = blocks_[block].find(body, links_[block].size);
    if (place < BoxBlock::width) return {slot, block, place};
  }
}

bool HashGrid::Level::move_in_cell(const FloatBox& from, const FloatBox& to, std::uint32_t body) {
  const Steps steps = steps_of(to);
  const CellIndex index = steps.cell();
  if (cell_of(from) != index) return false;
  const Standing at = find(index, body);
  blocks_[at.block].put(at.place, steps.low_bits(), body);
  widen_reach(steps);
  return true;
}

/// Erases a body; the last box of the first block of the cell takes its place.
void HashGrid::Level::erase(const FloatBox& box, std::uint32_t body) {
  const Standing at = find(cell_of(box), body);
  std::uint32_t& front = slots_[at.slot].first_block;
  const std::size_t last = --links_[front].size;
  blocks_[at.block].put(at.place, blocks_[front].box(last), blocks_[front].body(last));
  --bodies_;
  if (last > 0) return;
  if (links_[front].next != none) {
    free_blocks_.push_back(front);
    front = std::exchange(links_[front].next, none);
  } else if (++empty_cells_ > 64 && empty_cells_ > cells_ / 2) {
    rehash();
  }
}

/// Drops the empty cells and sizes the table for at least twice as many cells as remain.
void HashGrid::Level::rehash() {
  std::vector<Slot> kept;
  for (const Slot& slot : slots_) {
    if (slot.is_free()) continue;
    if (links_[slot.first_block].size > 0) {
      kept.push_back(slot);
    } else {
      free_blocks_.push_back(slot.first_block);
    }
  }
  cells_ = kept.size();
  empty_cells_ = 0;
  std::size_t capacity = 64;
  while (capacity < 4 * (cells_ + 1)) capacity *= 2;
  slots_.assign(capacity, {});
  for (const Slot& slot : kept) slots_[slot_of(slot.index)] = slot;
}

namespace {

/// Returns the bits of a width, which is clamped to [smallest normal float, greatest float]: a point counts
/// as the former, an infinite width as the latter.
std::uint32_t bits_of(float width) {
  using Limits = std::numeric_limits<float>;
  return bit_cast<std::uint32_t>(std::clamp(width, Limits::min(), Limits::max()));
}

constexpr int mantissa_bits = 23;
constexpr int exponent_bias = 127;

}  // namespace

/// Returns the smallest e with width <= 2^e.
int HashGrid::exponent_of(float width) {
  const std::uint32_t rounded_up = bits_of(width) + ((1u << mantissa_bits) - 1u);
  return static_cast<int>(rounded_up >> mantissa_bits) - exponent_bias;
}

/// Returns about 2^octave_bits times log2 of a width: linear between powers of two, as the bits of a float
/// are.
std::int16_t HashGrid::size_of(float width) {
  return static_cast<std::int16_t>(static_cast<int>(bits_of(width) >> (mantissa_bits - octave_bits)) -
                                   (exponent_bias << octave_bits));
}

/// Returns the extent of a box, or the resolution of single precision at its distance if that is larger, so
/// that cell coordinates fit into 32 bits.
float HashGrid::width_of(const FloatBox& box) {
  float farthest = 0.0f;
  for (std::size_t axis = 0; axis < 3; ++axis)
    farthest = std::max({farthest, std::abs(box.lower[axis]), std::abs(box.upper[axis])});
  return std::max(box.extent(), 0x1p-24f * farthest);
}

HashGrid::Place HashGrid::place_for(const FloatBox& box) const {
  const float width = width_of(box);
  const int above = exponent_of(width) - finest_exponent_;
  const int level = above <= 0 ? 0 : (above + exponent_step - 1) / exponent_step;
  return {static_cast<std::int16_t>(level), size_of(width), box};
}

double HashGrid::edge_of(std::size_t level) const {
  return std::ldexp(1.0, finest_exponent_ + exponent_step * static_cast<int>(level));
}

void HashGrid::insert(std::uint32_t body, const Place& place) {
  const auto level = static_cast<std::size_t>(place.level);
  while (levels_.size() <= level) levels_.emplace_back(edge_of(levels_.size()));
  levels_[level].insert(place.box, body);
}

void HashGrid::set(std::uint32_t body, const Box& box) {
  if (body >= places_.size()) places_.resize(body + 1);
  const Place next = place_for(FloatBox(box));
  Place& place = places_[body];
  if (!contains(body)) {
    ++size_;
    size_sum_ += next.size;
    insert(body, next);
  } else {
    size_sum_ += next.size - place.size;
    Level& level = levels_[static_cast<std::size_t>(place.level)];
    if (next.level != place.level || !level.move_in_cell(place.box, next.box, body)) {
      level.erase(place.box, body);
      insert(body, next);
    }
  }
  place = next;
  retune_if_worthwhile();
}

void HashGrid::remove(std::uint32_t body) {
  if (!contains(body)) return;
  Place& place = places_[body];
  size_sum_ -= place.size;
  levels_[static_cast<std::size_t>(place.level)].erase(place.box, body);
  place.level = nowhere;
  --size_;
}

/// Fits the finest level to the typical box and registers all bodies anew if the level is off. Runs at most
/// once in as many changes as there are bodies, so a change stays O(1) amortised.
void HashGrid::retune_if_worthwhile() {
  if (++changes_since_tuning_ < size_) return;
  changes_since_tuning_ = 0;
  const double mean = static_cast<double>(size_sum_) / ((1 << octave_bits) * static_cast<double>(size_));
  const int wanted = static_cast<int>(std::floor(mean + 0.5)) + finest_above_mean;
  if (std::abs(mean + finest_above_mean - finest_exponent_) < 0.75) return;
  finest_exponent_ = wanted;
  levels_.clear();
  for (std::uint32_t body = 0; body < places_.size(); ++body) {
    if (!contains(body)) continue;
    places_[body] = place_for(FloatBox(places_[body].box));
    insert(body, places_[body]);
  }
}

}  // namespace kinesphere
