#pragma once

#include <cstdint>
#include <vector>

#include "engine/tables.hpp"
#include "engine/unsettled.hpp"

namespace kinesphere {

/// All that may be in a box now, by number. Cost: a search, and those that were added or changed since time
/// moved on.
std::vector<std::uint32_t> bodies_in(const Box& box, const Tables& tables, const Unsettled& unsettled,
                                     double now);

}  // namespace kinesphere
