#include "core/neighbour_lists.hpp"

#include <algorithm>
#include <bit>
#include <iterator>

namespace kinesphere::core {
namespace {

/// Inserts a number into a short list in ascending order, unless it is there.
void insert_sorted(std::vector<std::uint32_t>& list, std::uint32_t number) {
  auto place = list.end();
  while (place != list.begin() && *(place - 1) > number) --place;
  if (place == list.begin() || *(place - 1) != number) list.insert(place, number);
}

}  // namespace

std::uint32_t NeighbourLists::take(std::uint32_t room) {
  std::uint32_t list;
  if (free_[room].empty()) {
    if (numbers_.empty()) numbers_.resize(spare);
    list = static_cast<std::uint32_t>(numbers_.size() - spare);
    numbers_.resize(numbers_.size() + (least_room << room));
  } else {
    list = free_[room].back();
    free_[room].pop_back();
  }
  numbers_[list] = 0;
  numbers_[list + 1] = room;
  return list;
}

void NeighbourLists::give_back(std::uint32_t list) { free_[numbers_[list + 1]].push_back(list); }

void NeighbourLists::grow(std::uint32_t& list) {
  const std::uint32_t larger = take(numbers_[list + 1] + 1);
  const std::uint32_t count = numbers_[list];
  std::copy_n(numbers_.begin() + list + header, count, numbers_.begin() + larger + header);
  numbers_[larger] = count;
  give_back(list);
  list = larger;
}

void NeighbourLists::add_to(std::uint32_t& list, std::uint32_t number) {
  if (numbers_[list] == capacity(list)) grow(list);
  std::uint32_t* const run = numbers_.data() + list;
  run[header + run[0]++] = number;
}

void NeighbourLists::erase(std::uint32_t list, std::uint32_t number) {
  std::uint32_t* const run = numbers_.data() + list + header;
  const std::uint32_t last = --numbers_[list];
  std::uint32_t place = 0;
  while (run[place] != number) ++place;
  run[place] = run[last];
}

void NeighbourLists::assign(std::uint32_t& list, std::span<const std::uint32_t> numbers) {
  numbers_[list] = 0;
  while (capacity(list) < numbers.size()) grow(list);
  std::copy(numbers.begin(), numbers.end(), numbers_.begin() + list + header);
  numbers_[list] = static_cast<std::uint32_t>(numbers.size());
}

void find_changes(std::span<const std::uint32_t> list, std::span<const std::uint32_t> present,
                  std::vector<std::uint32_t>& gone, std::vector<std::uint32_t>& fresh) {
  gone.clear();
  fresh.clear();
  if (list.size() <= most_compared && present.size() <= most_compared) {
    const ListMatches matches = compare_lists(list.data(), list.size(), present.data(), present.size());
    for (std::uint64_t left = matches.unmatched_of_list; left != 0; left &= left - 1)
      gone.push_back(list[static_cast<std::size_t>(std::countr_zero(left))]);
    for (std::uint64_t left = matches.unmatched_of_present; left != 0; left &= left - 1)
      insert_sorted(fresh, present[static_cast<std::size_t>(std::countr_zero(left))]);
    return;
  }
  std::vector<std::uint32_t> before(list.begin(), list.end()), after(present.begin(), present.end());
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  after.erase(std::unique(after.begin(), after.end()), after.end());
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(gone));
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(fresh));
}

}  // namespace kinesphere::core
