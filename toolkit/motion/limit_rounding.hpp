// Factors that keep |acceleration| <= limit true despite rounding on both sides.
#pragma once

namespace kinesphere {

/// Scales a limit down so that an acceleration of that length obeys it. The product of a vector and a
/// quotient, and two norms, have a relative error of at most 9 roundings of 2^-53 together.
inline constexpr double slightly_less = 1.0 - 1e-15;

/// Scales a limit that was computed from accelerations up so that it contains them, including rounding in the
/// states.
inline constexpr double slightly_more = 1.0 + 1e-12;

}  // namespace kinesphere
