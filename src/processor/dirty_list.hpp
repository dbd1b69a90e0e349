// DirtyList lists the bodies that must be recertified before time advances.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bodies/bodies.hpp"

namespace kinesphere {

/// Sorts numbers in ascending order, and removes those that repeat. Most have been in order before.
inline void make_ascending(std::vector<std::uint32_t>& numbers) {
  if (std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal()) == numbers.end()) return;
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Contains all dirty bodies in the order in which they became dirty, and possibly some that are no longer
/// dirty.
class DirtyList {
 public:
  void reserve(std::size_t bodies) { numbers_.reserve(bodies); }
  bool empty() const { return numbers_.empty(); }
  const std::vector<std::uint32_t>& numbers() const { return numbers_; }
  /// Returns true if the body is dirty. Cost: its record is not accessed while the list is empty.
  bool lists(const Bodies& bodies, std::uint32_t number) const {
    return !numbers_.empty() && bodies[number].dirty;
  }
  void add(Bodies& bodies, std::uint32_t number) {
    if (bodies[number].dirty) return;
    bodies[number].dirty = true;
    numbers_.push_back(number);
  }
  void assign(std::span<const std::uint32_t> numbers) { numbers_.assign(numbers.begin(), numbers.end()); }
  /// Sorts the list in ascending order and removes duplicates and bodies that are not dirty. Returns the
  /// list. Cost: O(n log n).
  const std::vector<std::uint32_t>& sort(const Bodies& bodies) {
    make_ascending(numbers_);
    std::erase_if(numbers_, [&](std::uint32_t number) { return !bodies[number].dirty; });
    return numbers_;
  }
  void clear() { numbers_.clear(); }

  static void serialize(auto& self, auto& archive) { archive(self.numbers_); }

 private:
  std::vector<std::uint32_t> numbers_;
};

}  // namespace kinesphere
