#include "world/neighbours.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace kinesphere {
namespace {

/// What packing leaves to a list beyond what is there.
constexpr std::uint32_t most_spare = 2;
/// In so small a table room is cheaper than packing.
constexpr std::size_t few = std::size_t{1} << 14;
/// Lists of this capacity or more have one of four capacities between one power of two and the next, so that
/// a list that grows finds the place of another one.
constexpr std::uint32_t long_list = 64;

constexpr std::uint32_t crowd_step = 32;

std::uint32_t quarter_of_octave(std::uint32_t capacity) { return std::bit_floor(capacity) / 4; }

/// The least capacity that a list may have and that is not smaller.
std::uint32_t possible_capacity(std::uint32_t capacity) {
  if (capacity < long_list) return capacity;
  const std::uint32_t quarter = quarter_of_octave(capacity);
  return (capacity + quarter - 1) / quarter * quarter;
}

/// For a list that has no room left. Short lists are many: to double them would leave a third of the memory
/// empty. Long ones would be moved too often if they did not grow in proportion.
std::uint32_t grown_capacity(std::uint32_t size) {
  const std::uint32_t room = size < long_list ? std::max<std::uint32_t>(2, size / 8) : size / 2;
  return possible_capacity(size + room);
}

/// The same for equal capacities only, and less than 64 + 4 * 26.
std::size_t hole_kind(std::uint32_t capacity) {
  if (capacity < long_list) return capacity;
  const auto octave = static_cast<std::uint32_t>(std::countr_zero(std::bit_floor(capacity) / long_list));
  return long_list + 4 * octave + (capacity - std::bit_floor(capacity)) / quarter_of_octave(capacity);
}

}  // namespace

std::optional<Neighbours::Place> Neighbours::find(std::uint32_t body, std::uint32_t partner) const {
  const auto list = of(body);
  const auto found = std::find_if(list.begin(), list.end(),
                                  [partner](const Neighbour& other) { return other.partner == partner; });
  if (found == list.end()) return std::nullopt;
  return static_cast<Place>(found - list.begin());
}

void Neighbours::replace(std::uint32_t body, std::span<const std::uint32_t> found) {
  constexpr std::uint32_t seen = 0;
  if (++stamp_ == seen) {
    for (List& list : lists_) list.stamp = seen;
    ++stamp_;
  }
  for (const std::uint32_t partner : found) lists_[partner].stamp = stamp_;
  for (auto place = lists_[body].size; place-- > 0;) {
    const std::uint32_t partner = side(body, place).partner;
    if (lists_[partner].stamp == stamp_) {
      lists_[partner].stamp = seen;
    } else {
      unlink(body, place);
    }
  }
  for (const std::uint32_t partner : found) {
    if (lists_[partner].stamp == seen) continue;
    lists_[partner].stamp = seen;
    link(body, partner);
  }
}

void Neighbours::add(std::uint32_t body, const Neighbour& neighbour) {
  if (lists_[body].size == lists_[body].capacity) move(body, grown_capacity(lists_[body].size));
  side(body, lists_[body].size++) = neighbour;
}

/// To a place of this capacity: a hole, if there is one, or at the end.
void Neighbours::move(std::uint32_t body, std::uint32_t capacity) {
  std::uint32_t& hole = holes_[hole_kind(capacity)];
  std::uint32_t first = hole;
  if (first != none) {
    hole = sides_[first].partner;
  } else {
    if (sides_.capacity() - sides_.size() < capacity) pack(capacity);
    first = static_cast<std::uint32_t>(sides_.size());
    sides_.resize(sides_.size() + capacity);
  }
  List& list = lists_[body];
  std::copy_n(sides_.data() + list.first, list.size, sides_.data() + first);
  if (list.capacity > 0) {
    std::uint32_t& left = holes_[hole_kind(list.capacity)];
    sides_[list.first].partner = std::exchange(left, list.first);
  }
  list.first = first;
  list.capacity = capacity;
}

/// Leaves no holes, and makes room for `room` more and for an eighth of all; where many lists are empty yet,
/// for what they will hold if they come to be like the others, four times as many at most. Cost: O(all), once
/// in so many moves that each pays for some copies.
void Neighbours::pack(std::uint32_t room) {
  std::size_t all = 0;
  std::size_t filled = 0;
  for (List& list : lists_) {
    const std::uint32_t spare = list.size < long_list ? most_spare : list.size / 8;
    list.capacity = std::min(list.capacity, possible_capacity(list.size + spare));
    all += list.capacity;
    filled += list.size > 0;
  }
  const std::size_t to_come = filled > 0 ? std::min(4 * all, all / filled * (lists_.size() - filled)) : 0;
  std::vector<Neighbour> packed;
  packed.reserve(room + all + std::max({to_come, all / 8, std::min(all, few)}));
  packed.resize(all);
  std::uint32_t next = 0;
  for (List& list : lists_) {
    const Neighbour* const from = sides_.data() + list.first;
    for (Place place = 0; place < list.size; ++place) packed[next + place] = from[place];
    list.first = next;
    next += list.capacity;
  }
  sides_ = std::move(packed);
  holes_.fill(none);
}

void Neighbours::link(std::uint32_t a, std::uint32_t b) {
  const Place place_a = lists_[a].size;
  const Place place_b = lists_[b].size;
  add(a, {.partner = b, .mirror = place_b});
  add(b, {.partner = a, .mirror = place_a});
  for (const std::uint32_t body : {a, b})
    if (lists_[body].size % crowd_step == 0 && lists_[body].size > 2 * crowd_step) crowded_.push_back(body);
}

void Neighbours::build(const std::vector<std::vector<Neighbour>>& lists) {
  *this = {};
  make_room(lists.size());
  for (std::uint32_t body = 0; body < lists.size(); ++body)
    for (const Neighbour& neighbour : lists[body]) add(body, neighbour);
}

void Neighbours::unlink(std::uint32_t body, Place place) {
  const Neighbour gone = side(body, place);
  take_out(gone.partner, gone.mirror);
  take_out(body, place);
}

/// The last one takes its place.
void Neighbours::take_out(std::uint32_t body, Place place) {
  const Place end = --lists_[body].size;
  if (place == end) return;
  const Neighbour last = side(body, end);
  side(body, place) = last;
  mirror_of(last).mirror = place;
}

void Neighbours::remove_all(std::uint32_t body) {
  while (lists_[body].size > 0) unlink(body, lists_[body].size - 1);
}

bool Neighbours::is_sound(std::size_t bodies) const {
  if (lists_.size() != bodies) return false;
  for (std::uint32_t body = 0; body < bodies; ++body) {
    std::vector<std::uint32_t> partners;
    for (Place place = 0; place < lists_[body].size; ++place) {
      const auto& [watch, partner, mirror] = of(body)[place];
      if (std::isnan(watch) || partner >= bodies || partner == body || mirror >= lists_[partner].size)
        return false;
      const Neighbour& there = of(partner)[mirror];
      if (there.partner != body || there.mirror != place) return false;
      const bool partner_does = there.watch < Neighbour::partner_does;
      if (partner_does != (watch == Neighbour::partner_does)) return false;
      partners.push_back(partner);
    }
    std::sort(partners.begin(), partners.end());
    if (std::adjacent_find(partners.begin(), partners.end()) != partners.end()) return false;
  }
  return true;
}

}  // namespace kinesphere
