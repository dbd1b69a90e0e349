// Sorting many numbers by keys of 32 bits, in three passes over memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace kinesphere {

/// By the high halves; those with equal ones stay in their order. Cost: O(n), and as much memory again.
inline void sort_by_high_halves(std::vector<std::uint64_t>& values) {
  constexpr int digit_bits = 11;
  constexpr std::uint64_t digit_mask = (1u << digit_bits) - 1;
  std::vector<std::uint64_t> sorted(values.size());
  for (int shift = 32; shift < 64; shift += digit_bits) {
    const auto digit = [shift](std::uint64_t value) { return value >> shift & digit_mask; };
    std::array<std::size_t, digit_mask + 2> places{};  // of the first one with each digit
    for (const std::uint64_t value : values) ++places[digit(value) + 1];
    for (std::size_t k = 1; k < places.size(); ++k) places[k] += places[k - 1];
    for (const std::uint64_t value : values) sorted[places[digit(value)]++] = value;
    values.swap(sorted);
  }
}

}  // namespace kinesphere
