#pragma once

#include <cstdint>
#include <vector>

#include "processor/dirty_list.hpp"
#include "processor/world_state.hpp"

namespace kinesphere {

/// Returns all bodies whose safe regions come near the box, in any order. Cost: one search.
std::vector<std::uint32_t> registered_in(const Box& box, const WorldState& state);

/// Returns all bodies that may be in the box now, in ascending order. Cost: one search, plus one step for
/// each body in DirtyList::moved().
std::vector<std::uint32_t> bodies_in(const Box& box, const WorldState& state, const DirtyList& dirty);

}  // namespace kinesphere
