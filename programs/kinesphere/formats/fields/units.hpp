// Units in headers and options: their names and sizes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kinesphere::program {

enum class Measure { none, length, speed, acceleration, time, angle };

inline constexpr double knot = 1852.0 / 3600.0;
inline constexpr double foot = 0.3048;

/// A unit of time: `seconds` each or, with `rate`, that many to a second. One of the two is 1.
struct TimeUnit {
  double seconds = 1.0;
  double rate = 1.0;
};

/// Returns the size of a unit in metres, seconds or degrees, or in their quotients, in any case of letters;
/// nothing for an unknown one.
std::optional<double> unit_named(std::string_view unit, Measure measure);
/// Knows the units of time, so that 1/1000 stays exact; nothing for other names.
std::optional<TimeUnit> time_unit_named(std::string_view name);
/// Returns the usual names, for messages.
std::string unit_list(Measure measure);

/// Parses "5NM", "1000 ft", "0.3g", "50": a number with an optional unit; without one it is in metres and
/// seconds, or in the units of the stream. Throws ProgramError naming `option` for other text and for a
/// number that is not finite or is negative.
double parse_measure(std::string_view text, Measure measure, std::string_view option);

/// True for a number with a unit, as parse_measure knows it.
bool has_unit_behind(std::string_view number);

/// True for px and pixel: lengths of unknown size.
bool is_pixel(std::string_view unit);
/// True for a name of a unit of any measure, in brackets or not.
bool is_unit(std::string_view text);
/// Returns the text without blanks and brackets around it.
std::string_view without_brackets(std::string_view text);

}  // namespace kinesphere::program
