#include "core/neighbour_lists.hpp"

#include <algorithm>

namespace kinesphere::core {

std::uint32_t NeighbourLists::take(std::uint32_t room) {
  std::uint32_t list;
  if (free_[room].empty()) {
    list = static_cast<std::uint32_t>(numbers_.size());
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

void NeighbourLists::insert(std::uint32_t& list, std::uint32_t number) {
  if (numbers_[list] == capacity(list)) grow(list);
  std::uint32_t* const run = numbers_.data() + list + header;
  std::uint32_t place = numbers_[list]++;
  for (; place > 0 && run[place - 1] > number; --place) run[place] = run[place - 1];
  run[place] = number;
}

void NeighbourLists::erase(std::uint32_t list, std::uint32_t number) {
  std::uint32_t* const run = numbers_.data() + list + header;
  const std::uint32_t count = --numbers_[list];
  std::uint32_t place = 0;
  while (run[place] != number) ++place;
  for (; place < count; ++place) run[place] = run[place + 1];
}

void NeighbourLists::assign(std::uint32_t& list, std::span<const std::uint32_t> numbers) {
  numbers_[list] = 0;
  while (capacity(list) < numbers.size()) grow(list);
  std::copy(numbers.begin(), numbers.end(), numbers_.begin() + list + header);
  numbers_[list] = static_cast<std::uint32_t>(numbers.size());
}

}  // namespace kinesphere::core
