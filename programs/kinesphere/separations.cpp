// Separations of the command line.
#include "separations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "columns/units.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

/// Returns the parts of "a:b c".
std::vector<std::string_view> separation_parts(std::string_view text) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find_first_of(": "));
    text.remove_prefix(std::min(part.size() + 1, text.size()));
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

}  // namespace

NamedSeparation parse_separation(const std::string& text) {
  const auto parts = separation_parts(text);
  const auto positive = [&](std::size_t place, Measure measure) {
    const double value = parse_measure(parts[place], measure, "--separation");
    if (value > 0.0) return value;
    throw ProgramError(fmt::format("--separation: expected lengths and times > 0, but got '{}'", text));
  };
  const std::string_view shape = parts.empty() ? "" : parts.front();
  const std::size_t lengths = shape == "sphere" ? 1 : shape == "cylinder" || shape == "ellipsoid" ? 2 : 0;
  if (lengths == 0 || parts.size() < 1 + lengths || parts.size() > 2 + lengths)
    throw ProgramError(
        fmt::format("--separation: expected sphere:RADIUS, cylinder:HORIZONTAL:VERTICAL or "
                    "ellipsoid:HORIZONTAL:VERTICAL, with or without :TIME behind it, but got '{}'",
                    text));
  const double horizontal = positive(1, Measure::length);
  const double vertical = lengths == 2 ? positive(2, Measure::length) : horizontal;
  const double look_ahead = parts.size() == 2 + lengths ? positive(1 + lengths, Measure::time) : 0.0;
  return {text, shape == "cylinder" ? Separation::cylinder(horizontal, vertical, look_ahead)
                                    : Separation::ellipsoid(horizontal, vertical, look_ahead)};
}

}  // namespace kinesphere::program
