// Lists in one table, mirrored into plain ones.
#include "contact/chains.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "archive/archive.hpp"
#include "archive/heap_counter.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere {
namespace {

using Numbers = std::vector<std::uint32_t>;

Numbers content(const Chains<std::uint32_t>& chains, std::uint32_t list) {
  return {chains.of(list).begin(), chains.of(list).end()};
}

/// Side by side with plain lists.
struct Pair {
  static constexpr std::uint32_t lists = 6;
  Chains<std::uint32_t> chains;
  std::vector<Numbers> plain = std::vector<Numbers>(lists);

  void change(Random& random) {
    const auto list = static_cast<std::uint32_t>(random.bits() % lists);
    const auto value = static_cast<std::uint32_t>(random.bits() % 4);
    if (random.bits() % 20 == 0) {
      chains.clear(list);
      plain[list].clear();
    } else if (random.bits() % 2 == 0) {
      chains.erase(list, value);
      std::erase(plain[list], value);
    } else {
      chains.add(list, value);
      plain[list].push_back(value);
    }
  }
  void expect_equal(const Chains<std::uint32_t>& found) const {
    for (std::uint32_t list = 0; list < lists; ++list) {
      EXPECT_EQ(content(found, list), plain[list]);
      EXPECT_EQ(found.of(list).empty(), plain[list].empty());
    }
  }
};

TEST(Chains, AreListsInTheOrderOfAddition) {
  Random random(1);
  Pair pair;
  for (int step = 0; step < 5000 && !testing::Test::HasFailure(); ++step) {
    pair.change(random);
    pair.expect_equal(pair.chains);
  }
}

TEST(Chains, ComeBackFromBytesAsTheyWere) {
  Random random(2);
  Pair pair;
  for (int round = 0; round < 50; ++round) {
    for (int step = 0; step < 20; ++step) pair.change(random);
    ByteWriter writer;
    writer(pair.chains);
    ByteReader reader(writer.bytes());
    Chains<std::uint32_t> read;
    read.add(9, 9);
    reader(read);
    EXPECT_FALSE(reader.failed());
    EXPECT_EQ(read.size(), pair.chains.size());
    pair.expect_equal(read);
  }
}

TEST(Chains, UseTheirMemoryAgain) {
  Chains<std::uint32_t> chains;
  EXPECT_EQ(heap_bytes(chains), 0u);
  for (std::uint32_t value = 0; value < 100; ++value) chains.add(value % 3, value);
  const std::size_t bytes = heap_bytes(chains);
  EXPECT_GE(bytes, 100 * 2 * sizeof(std::uint32_t));
  for (int round = 0; round < 10; ++round) {
    for (std::uint32_t value = 0; value < 100; ++value) chains.erase(value % 3, value);
    for (std::uint32_t value = 0; value < 100; ++value) chains.add(value % 3, value);
  }
  EXPECT_EQ(heap_bytes(chains), bytes);
}

}  // namespace
}  // namespace kinesphere
