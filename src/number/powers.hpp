// Powers of two, without a call of the mathematical library.
#pragma once

#include <cassert>
#include <cstdint>

#include "number/bit_cast.hpp"

namespace kinesphere {

/// 2^exponent, for exponents from -1022 to 1023.
constexpr double power_of_two(int exponent) {
  assert(-1022 <= exponent && exponent <= 1023);
  return bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

/// The greatest whole e with 2^e <= value, for values that are not below 2^-1022; -1023 for smaller ones,
/// 1024 for infinity. The sign does not count.
constexpr int exponent_of(double value) {
  return static_cast<int>(bit_cast<std::uint64_t>(value) >> 52 & 0x7ffu) - 1023;
}

}  // namespace kinesphere
