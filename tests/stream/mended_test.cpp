// Replaces numbers in snapshots and recordings at random by strange ones.
#include "stream/any_bytes.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::stream::mended_test {
namespace {

/// Returns place, kind and value in the form that try_mended() reads.
std::vector<std::uint8_t> damage(Random& random) {
  std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(random.bits())};
  for (auto edits = random.bits() % 2 + 1; edits > 0; --edits) {
    const std::uint64_t where = random.bits();
    const std::uint8_t how = random.bits() % 4 != 0 ? 5 : static_cast<std::uint8_t>(random.bits() % 9);
    const std::size_t at = bytes.size();
    bytes.insert(bytes.end(),
                 {0, static_cast<std::uint8_t>(where % 64), static_cast<std::uint8_t>(where >> 8), how});
    for (int k = 0; k < 8; ++k)
      bytes.push_back(static_cast<std::uint8_t>(random.bits() % (k == 0 ? 40 : 256)));
    EXPECT_EQ(bytes.size(), at + 12);
  }
  return bytes;
}

TEST(Mended, StrangeNumbersAreRefusedOrHarmless) {
  for (std::uint64_t seed = 1; seed <= 12000; ++seed) {
    Random random(seed);
    ASSERT_NO_THROW(try_mended(damage(random))) << "seed " << seed;
  }
}

}  // namespace
}  // namespace kinesphere::stream::mended_test
