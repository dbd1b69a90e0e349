#include "archive/checksum.hpp"

#include <array>
#include <bit>
#include <cstring>

#include "archive/archive.hpp"

namespace kinesphere {
namespace {

constexpr std::uint64_t prime_1 = 0x9E3779B185EBCA87u;
constexpr std::uint64_t prime_2 = 0xC2B2AE3D27D4EB4Fu;
constexpr std::uint64_t prime_3 = 0x165667B19E3779F9u;
constexpr std::uint64_t prime_4 = 0x85EBCA77C2B2AE63u;
constexpr std::uint64_t prime_5 = 0x27D4EB2F165667C5u;

/// Removes the next little-endian number from the front of the bytes. Precondition: there are enough bytes.
template <class Word>
Word take(std::span<const std::byte>& bytes) {
  Word word;
  std::memcpy(&word, bytes.data(), sizeof word);
  bytes = bytes.subspan(sizeof word);
  return detail::little_endian(word);
}

std::uint64_t mixed(std::uint64_t lane, std::uint64_t word) {
  return std::rotl(lane + word * prime_2, 31) * prime_1;
}

/// Returns the sum of all whole 32-byte stripes, and removes them from the bytes.
std::uint64_t sum_of_stripes(std::span<const std::byte>& bytes, std::uint64_t seed) {
  std::array<std::uint64_t, 4> lanes{seed + prime_1 + prime_2, seed + prime_2, seed, seed - prime_1};
  while (bytes.size() >= 32)
    for (std::uint64_t& lane : lanes) lane = mixed(lane, take<std::uint64_t>(bytes));
  std::uint64_t sum =
      std::rotl(lanes[0], 1) + std::rotl(lanes[1], 7) + std::rotl(lanes[2], 12) + std::rotl(lanes[3], 18);
  for (const std::uint64_t lane : lanes) sum = (sum ^ mixed(0, lane)) * prime_1 + prime_4;
  return sum;
}

}  // namespace

std::uint64_t checksum(std::span<const std::byte> bytes, std::uint64_t seed) {
  const std::uint64_t size = bytes.size();
  std::uint64_t sum = (size >= 32 ? sum_of_stripes(bytes, seed) : seed + prime_5) + size;
  while (bytes.size() >= 8)
    sum = std::rotl(sum ^ mixed(0, take<std::uint64_t>(bytes)), 27) * prime_1 + prime_4;
  if (bytes.size() >= 4) sum = std::rotl(sum ^ take<std::uint32_t>(bytes) * prime_1, 23) * prime_2 + prime_3;
  while (!bytes.empty()) sum = std::rotl(sum ^ take<std::uint8_t>(bytes) * prime_5, 11) * prime_1;
  sum = (sum ^ sum >> 33) * prime_2;
  sum = (sum ^ sum >> 29) * prime_3;
  return sum ^ sum >> 32;
}

}  // namespace kinesphere
