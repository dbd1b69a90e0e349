// Separations of the command line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinesphere/monitor/separation.hpp"

namespace kinesphere::program {

struct NamedSeparation {
  std::string name;  ///< spelled like in the option
  Separation separation;
  bool has_time = false;  ///< its text says the look-ahead time, perhaps 0
  bool has_unit = false;  ///< its text says the unit of a length
};

/// Parses "sphere:50", "cylinder:5NM:1000ft", "ellipsoid:5NM:1000ft", "well-clear:0.66NM:450ft:35s", each
/// with or without ":60s" behind it for the look-ahead time (>= 0), and "do365:preventive",
/// "do365:corrective" and "do365:warning"; blanks may replace colons. Throws ProgramError.
NamedSeparation parse_separation(const std::string& text);

}  // namespace kinesphere::program
