// Lengths, speeds, accelerations and times of the command line, with their units.
#pragma once

#include <string>
#include <string_view>

#include "columns/units.hpp"
#include "kinesphere/monitor/report.hpp"

namespace kinesphere::program {

/// Parses "5NM", "1000 ft", "0.3g", "50": a number with an optional unit; without one it is in metres and
/// seconds, or in the units of the stream. Throws ProgramError naming `option` for other text and for a
/// number that is not finite or is negative.
double parse_measure(std::string_view text, Measure measure, std::string_view option);
/// Parses "3", for all directions, or "3:1", for horizontal and vertical. Throws like parse_measure().
ErrorBound parse_spread(std::string_view text, Measure measure, std::string_view option);

}  // namespace kinesphere::program
