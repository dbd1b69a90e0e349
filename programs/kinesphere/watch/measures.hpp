// Lengths, speeds, accelerations and times of the command line, with their units.
#pragma once

#include <string>
#include <string_view>

#include "columns/units.hpp"
#include "kinesphere/monitor/report.hpp"

namespace kinesphere::program {

/// Parses "3", for all directions, or "3:1", for horizontal and vertical. Throws like parse_measure().
ErrorBound parse_spread(std::string_view text, Measure measure, std::string_view option);

}  // namespace kinesphere::program
