// The checksum is XXH64: published values, and damage that sums over whole words do not detect.
#include "archive/checksum.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace kinesphere::checksum_test {
namespace {

std::uint64_t checksum_of(std::string_view text) { return checksum(std::as_bytes(std::span(text))); }

/// The input of the reference implementation's own check (xxHash, tests/sanity_test.c).
std::vector<std::byte> sanity_buffer(std::size_t size) {
  std::vector<std::byte> bytes;
  std::uint64_t generator = 2654435761u;
  while (bytes.size() < size) {
    bytes.push_back(static_cast<std::byte>(generator >> 56));
    generator *= 11400714785074694797u;
  }
  return bytes;
}

TEST(Checksum, GivesThePublishedSumsOfTexts) {
  EXPECT_EQ(checksum_of(""), 0xEF46DB3751D8E999u);
  EXPECT_EQ(checksum_of("a"), 0xD24EC4F1A98C6E5Bu);
  EXPECT_EQ(checksum_of("abc"), 0x44BC2CF5AD770999u);
  EXPECT_EQ(checksum_of("Nobody inspects the spammish repetition"), 0xFBCEA83C8A378BF1u);
}

TEST(Checksum, GivesTheSumsOfTheReferenceForEachPathThroughIt) {
  struct Vector {
    std::size_t size;
    std::uint64_t without_seed, with_seed;
  };
  constexpr std::uint64_t seed = 2654435761u;
  for (const auto& [size, without_seed, with_seed] : {
           Vector{0, 0xEF46DB3751D8E999u, 0xAC75FDA2929B17EFu},
           Vector{1, 0xE934A84ADB052768u, 0x5014607643A9B4C3u},
           Vector{4, 0x9136A0DCA57457EEu, 0xCAAB286BD8E9FDB5u},
           Vector{14, 0x8282DCC4994E35C8u, 0xC3BD6BF63DEB6DF0u},
           Vector{222, 0xB641AE8CB691C174u, 0x20CB8AB7AE10C14Au},
       }) {
    const auto bytes = sanity_buffer(size);
    EXPECT_EQ(checksum(bytes), without_seed) << size;
    EXPECT_EQ(checksum(bytes, seed), with_seed) << size;
  }
}

TEST(Checksum, ShowsAnyTwoFlippedBits) {
  const auto good = sanity_buffer(75);
  const std::uint64_t sum = checksum(good);
  const auto flip = [](std::vector<std::byte>& bytes, std::size_t bit) {
    bytes[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
  };
  int unnoticed = 0;
  for (std::size_t first = 0; first < 8 * good.size(); ++first) {
    auto bad = good;
    flip(bad, first);
    for (std::size_t second = first + 1; second < 8 * good.size(); ++second) {
      flip(bad, second);
      unnoticed += checksum(bad) == sum;
      flip(bad, second);
    }
  }
  EXPECT_EQ(unnoticed, 0);
}

}  // namespace
}  // namespace kinesphere::checksum_test
