#pragma once

#include <cstdint>
#include <vector>

#include "engine/dirty_list.hpp"
#include "engine/world_state.hpp"

namespace kinesphere {

/// All that may be in a box now, by number. Cost: a search, and those that were added or changed since time
/// moved on.
std::vector<std::uint32_t> bodies_in(const Box& box, const WorldState& tables, const DirtyList& unsettled,
                                     double now);

}  // namespace kinesphere
