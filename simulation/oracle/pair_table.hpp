// A table with a value for every unordered pair of different bodies.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace kinesphere {

template <class Value>
class PairTable {
 public:
  /// Makes room for bodies 0 ... count - 1. Values of pairs that were there before stay.
  void resize(std::uint32_t count) { values_.resize(place(0, count)); }
  Value& operator()(std::uint32_t a, std::uint32_t b) {
    return values_[place(std::min(a, b), std::max(a, b))];
  }
  const Value& operator()(std::uint32_t a, std::uint32_t b) const {
    return values_[place(std::min(a, b), std::max(a, b))];
  }

 private:
  static std::size_t place(std::size_t smaller, std::size_t larger) {
    return larger * (larger - 1) / 2 + smaller;
  }

  std::vector<Value> values_;
};

}  // namespace kinesphere
