// The fix that a sentence RMC of a receiver of satellite navigation gives.
#pragma once

#include <optional>
#include <string_view>

#include "formats/fields/time_text.hpp"

namespace kinesphere::program {

struct GpsFix {
  FileTime time{};                          ///< UTC, seconds since 1970
  double longitude = 0.0, latitude = 0.0;   ///< degrees
  std::optional<double> speed{}, course{};  ///< over ground: knots, degrees clockwise from north
};

/// Returns the fix of a line with a sentence RMC of any talker; nothing for another line, a wrong checksum,
/// and a receiver without a fix or a date.
std::optional<GpsFix> gps_fix_in(std::string_view line);

}  // namespace kinesphere::program
