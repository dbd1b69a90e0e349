// The inner loop of a search among stretches, compiled for each vector width. All widths give equal results.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace kinesphere {

/// Stretches by slot: their middles on three axes, their half ways, and their radii. `stretch_lanes` numbers
/// behind the last slot can be read, of any value.
using StretchColumns = std::array<const float*, 7>;
inline constexpr std::size_t stretch_lanes = 16;

/// The slots from `first` to before `last`.
struct StretchRange {
  std::uint32_t first, last;
};

/// Writes to `found` the slots in the ranges whose stretches come within the sum of the radii of this one,
/// and returns their number. There must be room for all. Numbers are at most 4 in absolute value. Some that
/// hardly touch may be left out: radii must be enlarged by 2^-18 of all numbers of their stretch, and 2^-40.
std::size_t near_stretches(const StretchColumns& columns, const std::array<float, 7>& stretch,
                           std::span<const StretchRange> ranges, std::uint32_t* found);

}  // namespace kinesphere
