// A time that never comes, a distance that has no end.
#pragma once

#include <limits>

namespace kinesphere {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace kinesphere
