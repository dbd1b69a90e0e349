#include "processor/bodies_in.hpp"

#include "number/infinity.hpp"

namespace kinesphere {

std::vector<std::uint32_t> registered_in(const Box& box, const WorldState& state) {
  const Vec3 centre = 0.5 * (box.lower + box.upper);
  const double radius = norm(box.upper - centre);
  if (radius < infinity) return state.core.find(centre, radius);
  std::vector<std::uint32_t> all;
  for (std::uint32_t number = 0; number < state.bodies.numbers(); ++number)
    if (state.core.contains(number)) all.push_back(number);
  return all;
}

/// A safe region contains its body until its own time, which is not in the past. Only a body that was changed
/// or violated its bound can be outside, and such a body is dirty. One that has only another velocity from
/// now on is still where it was.
std::vector<std::uint32_t> bodies_in(const Box& box, const WorldState& state, const DirtyList& dirty) {
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t number : dirty.moved())
    if (DirtyList::may_have_moved(state.bodies[number])) numbers.push_back(number);
  for (const std::uint32_t number : registered_in(box, state))
    if (!DirtyList::may_have_moved(state.bodies[number])) numbers.push_back(number);
  make_ascending(numbers);
  return numbers;
}

}  // namespace kinesphere
