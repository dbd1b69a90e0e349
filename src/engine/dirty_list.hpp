// Bodies that have to be settled before time moves on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bodies.hpp"

namespace kinesphere {

/// Those that are dirty, in the order in which they have become so; and some that are not dirty any more.
class DirtyList {
 public:
  void reserve(std::size_t bodies) { numbers_.reserve(bodies); }
  bool empty() const { return numbers_.empty(); }
  const std::vector<std::uint32_t>& numbers() const { return numbers_; }
  void add(Bodies& bodies, std::uint32_t number) {
    if (bodies[number].dirty) return;
    bodies[number].dirty = true;
    numbers_.push_back(number);
  }
  void assign(std::span<const std::uint32_t> numbers) { numbers_.assign(numbers.begin(), numbers.end()); }
  /// Those that are dirty, each once, in ascending order; there are no others then.
  const std::vector<std::uint32_t>& sort(const Bodies& bodies) {
    if (numbers_.size() > 1) {
      std::sort(numbers_.begin(), numbers_.end());
      numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
    }
    std::erase_if(numbers_, [&](std::uint32_t number) { return !bodies[number].dirty; });
    return numbers_;
  }
  /// The same of those that have come to where they are since windows started.
  std::vector<std::uint32_t> arrivals(const Bodies& bodies) const {
    std::vector<std::uint32_t> arrived;
    for (const std::uint32_t number : numbers_)
      if (bodies[number].dirty && bodies[number].relocated) arrived.push_back(number);
    std::sort(arrived.begin(), arrived.end());
    arrived.erase(std::unique(arrived.begin(), arrived.end()), arrived.end());
    return arrived;
  }
  void clear() { numbers_.clear(); }

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    archive(self.numbers_);
  }

 private:
  std::vector<std::uint32_t> numbers_;
};

}  // namespace kinesphere
