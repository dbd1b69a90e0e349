// Differences: numbers as a recording holds them, by how far they are from expected ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "archive/archive.hpp"
#include "kinesphere/vec3.hpp"
#include "number/bit_cast.hpp"

namespace kinesphere {

/// A number that is archived in as few bytes as it needs, 7 bits in each.
struct Varint {
  std::uint64_t value = 0;

  static void serialize(const Varint& self, ByteWriter& archive) {
    std::uint64_t rest = self.value;
    for (; rest >= 0x80; rest >>= 7) archive(static_cast<std::uint8_t>(rest | 0x80));
    archive(static_cast<std::uint8_t>(rest));
  }
  static void serialize(Varint& self, ByteReader& archive) {
    self.value = 0;
    std::uint8_t byte = 0x80;
    for (int shift = 0; byte >= 0x80; shift += 7) {
      if (shift > 63) return archive.refuse();
      archive(byte);
      self.value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
    }
  }
};

/// The differences of up to eight doubles from expected ones: how many doubles lie between, with a sign.
/// Every bit pattern is restored. Archived as one byte that tells which differ, and a Varint for each of
/// those.
template <std::size_t count>
class Differences {
 public:
  void set(std::size_t k, double value, double expected) {
    const std::uint64_t difference = place_of(value) - place_of(expected);
    differences_[k] = difference << 1 ^ (difference >> 63 ? ~std::uint64_t{0} : 0);
  }
  void set(std::size_t k, const Vec3& value, const Vec3& expected) {
    set(k, value.x, expected.x);
    set(k + 1, value.y, expected.y);
    set(k + 2, value.z, expected.z);
  }
  double number(std::size_t k, double expected) const {
    const std::uint64_t folded = differences_[k];
    return number_at(place_of(expected) + (folded >> 1 ^ (folded & 1 ? ~std::uint64_t{0} : 0)));
  }
  Vec3 vector(std::size_t k, const Vec3& expected) const {
    return {number(k, expected.x), number(k + 1, expected.y), number(k + 2, expected.z)};
  }

  friend bool operator==(const Differences&, const Differences&) = default;

  static void serialize(auto& self, auto& archive) {
    static_assert(count <= 8);
    unsigned differing = 0;
    for (std::size_t k = 0; k < count; ++k) differing |= (self.differences_[k] != 0 ? 1u : 0u) << k;
    auto which = static_cast<std::uint8_t>(differing);
    archive(which);
    for (std::size_t k = 0; k < count; ++k) {
      Varint difference{self.differences_[k]};
      if (which >> k & 1) archive(difference);
      if constexpr (!std::is_const_v<std::remove_reference_t<decltype(self)>>)
        self.differences_[k] = which >> k & 1 ? difference.value : 0;
    }
  }

 private:
  static constexpr std::uint64_t sign = std::uint64_t{1} << 63;

  /// Returns the place of a double among all of them, in ascending order.
  static std::uint64_t place_of(double number) {
    const auto bits = bit_cast<std::uint64_t>(number);
    return bits & sign ? ~bits : bits | sign;
  }
  static double number_at(std::uint64_t place) {
    return bit_cast<double>(place & sign ? place ^ sign : ~place);
  }

  std::array<std::uint64_t, count> differences_{};
};

}  // namespace kinesphere
