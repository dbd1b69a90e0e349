// Clock times of a track set that passes midnight.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracks/raw_samples.hpp"

namespace kinesphere::program {

struct Midnights {
  bool has_passed = false;
  std::optional<Place> unclear;  ///< a row that may be of either day; then no time was changed
};

/// Adds a day to the clock times (seconds since midnight) of a file behind each midnight: where all its rows
/// are in the order of their times, or where those of each track are together and each track passes midnight.
/// Rows of another order are left as they are.
Midnights pass_midnights(std::vector<RawTrack>& tracks, std::uint32_t file);

}  // namespace kinesphere::program
