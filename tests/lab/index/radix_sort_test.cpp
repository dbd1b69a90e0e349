#include "lab/index/radix_sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::radix_sort_test {
namespace {

constexpr std::uint64_t seed = 2811;

/// `key_bits` of a key, from `lowest` on, and a low half that has nothing to do with it.
std::vector<std::uint64_t> values(std::size_t count, int key_bits, int lowest, Random& random) {
  std::vector<std::uint64_t> values(count);
  const std::uint64_t keys = (std::uint64_t{1} << key_bits) - 1;
  for (std::uint64_t& value : values)
    value = (random.bits() & keys) << (32 + lowest) | (random.bits() & 0xffffffffu);
  return values;
}

TEST(RadixSort, orders_by_high_halves_and_keeps_the_order_of_equal_ones) {
  std::uint64_t k = 0;
  for (const std::size_t count : {0u, 1u, 2u, 100u, 5000u})
    for (const auto& [key_bits, lowest] : {std::pair{32, 0}, {30, 0}, {3, 0}, {2, 10}, {2, 21}, {1, 31}}) {
      Random random = Random::at(seed, k++, 0);
      auto sorted = values(count, key_bits, lowest, random);
      auto expected = sorted;
      std::stable_sort(expected.begin(), expected.end(),
                       [](std::uint64_t a, std::uint64_t b) { return a >> 32 < b >> 32; });
      sort_by_high_halves(sorted);
      EXPECT_EQ(sorted, expected) << "seed " << seed << ", case " << k - 1;
    }
}

}  // namespace
}  // namespace kinesphere::radix_sort_test
