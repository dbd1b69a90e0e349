// NeighbourLists holds, for each ball, the numbers of its neighbours, in no particular order.
//
// A list is a run of 16 * 2^k numbers in one array: its length, its room k, and the neighbours. Most lists
// are one cache line. Runs that become too small are reused.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/near_lanes.hpp"

namespace kinesphere::core {

class NeighbourLists {
 public:
  /// Returns a new, empty list.
  std::uint32_t add() { return take(0); }
  void remove(std::uint32_t list) { give_back(list); }
  /// Returns the numbers of a list. Behind them there are at least `spare` numbers to read, of any value.
  std::span<const std::uint32_t> at(std::uint32_t list) const {
    const std::uint32_t* const run = numbers_.data() + list;
    return {run + header, run[0]};
  }
  bool contains(std::uint32_t list, std::uint32_t number) const {
    const auto numbers = at(list);
    return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
  }
  /// Adds a number to a list that does not contain it, at its end. The list may move.
  void add_to(std::uint32_t& list, std::uint32_t number);
  /// Erases a number from a list that contains it. The last one takes its place.
  void erase(std::uint32_t list, std::uint32_t number);
  /// Replaces the contents of a list by these numbers. The list may move.
  void assign(std::uint32_t& list, std::span<const std::uint32_t> numbers);
  /// Address of a list, to prefetch.
  const void* address(std::uint32_t list) const { return numbers_.data() + list; }
  std::size_t bytes() const { return numbers_.capacity() * sizeof(std::uint32_t); }

 private:
  static constexpr std::uint32_t header = 2;
  static constexpr std::size_t spare = most_list_lanes;
  static constexpr std::uint32_t least_room = 16;

  std::uint32_t take(std::uint32_t room);
  void give_back(std::uint32_t list);
  std::uint32_t capacity(std::uint32_t list) const { return (least_room << numbers_[list + 1]) - header; }
  void grow(std::uint32_t& list);

  std::vector<std::uint32_t> numbers_;               ///< with `spare` ones at the end, if any
  std::array<std::vector<std::uint32_t>, 28> free_;  ///< runs to reuse, by room
};

/// Sets `gone` to the numbers of a list that are not present any more, and `fresh` to those present that are
/// not in it, in ascending order. Numbers of `present` may be repeated.
void find_changes(std::span<const std::uint32_t> list, std::span<const std::uint32_t> present,
                  std::vector<std::uint32_t>& gone, std::vector<std::uint32_t>& fresh);

}  // namespace kinesphere::core
