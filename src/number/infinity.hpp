// Infinity: the time of what never happens, and an unlimited distance.
#pragma once

#include <limits>

namespace kinesphere {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace kinesphere
