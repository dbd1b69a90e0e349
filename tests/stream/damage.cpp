#include "stream/damage.hpp"

#include <cmath>
#include <cstring>
#include <limits>

namespace kinesphere::stream {
namespace {

double number_of(const std::vector<std::byte>& bytes, std::size_t at) {
  double value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// Returns the first place from `at` on where eight bytes are a double of a size usual in worlds.
std::size_t next_double(const std::vector<std::byte>& bytes, std::size_t at) {
  for (std::size_t k = at; k + 8 <= bytes.size(); ++k) {
    const double value = std::abs(number_of(bytes, k));
    if ((value > 1e-12 && value < 1e12) || std::isinf(value)) return k;
  }
  return at;
}

/// Returns the first place from `at` on where eight bytes are a small whole number, like the size of a list.
std::size_t next_count(const std::vector<std::byte>& bytes, std::size_t at) {
  for (std::size_t k = at; k + 8 <= bytes.size(); ++k) {
    std::uint64_t value;
    std::memcpy(&value, bytes.data() + k, sizeof value);
    if (value > 0 && value < 4096) return k;
  }
  return at;
}

double strange_double(std::uint8_t number, double before) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  static const double all[] = {0.0,     -0.0,      1.0,     -1.0,     std::nan(""), inf,    -inf,   5e-324,
                               1e-310,  0x1p-1022, 1e-300,  0x1p-300, 0x1p-301,     1e-77,  1e-30,  1e30,
                               -1e30,   1e31,      -1e31,   1e76,     -3e231,       0x1p62, 0x1p63, -0x1p63,
                               0x1p300, 0x1p301,   1.7e308, -1.7e308, 1e100,        1e101,  0x1p41, 0x1p480};
  constexpr std::size_t count = sizeof all / sizeof *all;
  if (number < count) return all[number];
  switch (number % 6) {
    case 0:
      return std::nextafter(before, inf);
    case 1:
      return std::nextafter(before, -inf);
    case 2:
      return -before;
    case 3:
      return before * 2.0;
    case 4:
      return before + 1.0;
    default:
      return before * 1e12;
  }
}

void overwrite(std::vector<std::byte>& bytes, std::size_t at, const void* with, std::size_t size) {
  if (at + size <= bytes.size()) std::memcpy(bytes.data() + at, with, size);
}

}  // namespace

void damage(std::vector<std::byte>& bytes, std::size_t first, std::size_t behind,
            std::span<const std::uint8_t> how) {
  if (bytes.size() <= first + behind) return;
  const std::size_t margin = bytes.size() - first - behind;
  std::size_t at = first + (65536u * how[0] + 256u * how[1] + how[2]) % margin;
  const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  const auto value = how.subspan(4, 8);
  static const std::uint32_t whole[] = {
      0,   1,          2,          0x7fffffff, 0x80000000, 0xffffffff, 0xfffffffe, 300,
      301, 0xfffffed4, 0xfffffed3, 0x7f800000, 0x7fc00000, 0xff800000, 0x00000001, 0x7f7fffff};
  switch (how[3] % 9) {
    case 0:
      *place = std::byte{value[0]};
      break;
    case 1:
      *place ^= std::byte{value[0]};
      break;
    case 2:
      bytes.insert(place, std::byte{value[0]});
      break;
    case 3:
      bytes.erase(place);
      break;
    case 4:
      overwrite(bytes, at, value.data(), 8);
      break;
    case 5:
    case 6: {
      at = next_double(bytes, at);
      if (at + 8 > bytes.size() - behind) return;
      const double strange = strange_double(value[0], number_of(bytes, at));
      overwrite(bytes, at, &strange, sizeof strange);
      break;
    }
    case 7:
      overwrite(bytes, at, &whole[value[0] % std::size(whole)], 4);
      break;
    default: {
      at = next_count(bytes, at);
      if (at + 8 > bytes.size() - behind) return;
      bytes[at] = static_cast<std::byte>(static_cast<std::uint8_t>(bytes[at]) + value[0]);
    }
  }
}

}  // namespace kinesphere::stream
