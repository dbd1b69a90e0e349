// Kicked bodies of islands that have run side by side, held against each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/beside.hpp"
#include "engine/tables.hpp"
#include "parallel/crew.hpp"
#include "window/windows.hpp"

namespace kinesphere {

/// A kick, and whose it is: of the group at this place, or another process's (Sea::nobody).
struct GroupKick {
  std::uint32_t own;
  const BodyKick* kick;
};

/// Pairs of kicks (by their places here) of different groups whose bodies may meet while both windows last;
/// at least one of each pair is among the first `fresh` kicks. Kicks count as if each had been there from
/// `begin` on. Cost: as of a window's start for the fresh ones, and a search for each of the others.
std::vector<Windows::Pair> meetings(const Tables& tables, std::span<const GroupKick> kicks, std::size_t fresh,
                                    double begin, Shift& shift);

}  // namespace kinesphere
