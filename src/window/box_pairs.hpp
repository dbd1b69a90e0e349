// Which of many boxes overlap others' boxes?
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kinesphere/bound.hpp"
#include "space/space.hpp"

namespace kinesphere {

/// All pairs (a, b), a < b, of boxes of different owners that may overlap: of two that do, also in another
/// image where space repeats, the pair is among them, once. `owners` has one for each box, less than 2^32 -
/// 2; `size` is about the size of most boxes (length, > 0). Cost: linear, if most boxes are not much larger
/// than that and do not overlap many others.
std::vector<std::pair<std::uint32_t, std::uint32_t>> overlapping_pairs(std::span<const Box> boxes,
                                                                       std::span<const std::uint32_t> owners,
                                                                       const Space& space, double size);

}  // namespace kinesphere
