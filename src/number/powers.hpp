// Powers of two, computed without the math library.
#pragma once

#include <cassert>
#include <cstdint>

#include "number/bit_cast.hpp"

namespace kinesphere {

/// Returns 2^exponent. Precondition: -1022 <= exponent <= 1023.
constexpr double power_of_two(int exponent) {
  assert(-1022 <= exponent && exponent <= 1023);
  return bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

/// Returns the greatest integer e with 2^e <= |value|, for |value| >= 2^-1022; -1023 for smaller values, 1024
/// for infinity and NaN.
constexpr int exponent_of(double value) {
  return static_cast<int>(bit_cast<std::uint64_t>(value) >> 52 & 0x7ffu) - 1023;
}

}  // namespace kinesphere
