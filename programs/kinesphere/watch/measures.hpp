// Lengths, speeds, accelerations and times of the command line, with their units.
#pragma once

#include <string>
#include <string_view>

#include "kinesphere/monitor/report.hpp"

namespace kinesphere::program {

enum class Measure { length, speed, acceleration, time };

inline constexpr double knot = 1852.0 / 3600.0;
inline constexpr double foot = 0.3048;

/// "5NM", "1000 ft", "0.3g", "50": a number and perhaps a unit; one without a unit is of metres and seconds,
/// or of whatever the stream has. Throws ProgramError naming `option` for another text, for a number that is
/// not finite and for a negative one.
double parse_measure(std::string_view text, Measure measure, std::string_view option);
/// How many metres and seconds a unit is; 0 for an unknown one.
double unit_named(std::string_view unit, Measure measure);
/// "3": in all directions; "3:1": horizontal and upright. Throws as parse_measure().
ErrorBound parse_spread(std::string_view text, Measure measure, std::string_view option);

}  // namespace kinesphere::program
