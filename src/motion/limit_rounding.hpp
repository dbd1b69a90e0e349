// Factors that keep |acceleration| <= limit true although the two sides are rounded.
#pragma once

namespace kinesphere {

/// Makes an acceleration whose length is a limit obey it: the product of a vector and a quotient, and two
/// norms, are off by at most 9 roundings of 2^-53 together.
inline constexpr double slightly_less = 1.0 - 1e-15;

/// Makes a limit that was computed from accelerations contain them, after rounding in the states too.
inline constexpr double slightly_more = 1.0 + 1e-12;

}  // namespace kinesphere
