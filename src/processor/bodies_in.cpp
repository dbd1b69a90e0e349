#include "processor/bodies_in.hpp"

#include <algorithm>

#include "broadphase/neighbour_search.hpp"

namespace kinesphere {

/// A swept sphere contains its body until its window ends, which is not in the past. Only a body that was
/// changed or violated its bound can be outside, and such a body is dirty.
std::vector<std::uint32_t> bodies_in(const Box& box, const WorldState& state, const DirtyList& dirty,
                                     double now) {
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t number : dirty.numbers())
    if (state.bodies[number].dirty) numbers.push_back(number);
  NeighbourSearch search;
  for (const std::uint32_t number : search.in_box(state.broad_phase, box, now))
    if (!state.bodies[number].dirty) numbers.push_back(number);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

}  // namespace kinesphere
