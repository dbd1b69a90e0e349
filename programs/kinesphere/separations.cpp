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
  const auto length = [&](std::size_t place) {
    const double value = parse_measure(parts[place], Measure::length, "--separation");
    if (value > 0.0) return value;
    throw ProgramError(fmt::format("--separation: expected lengths > 0, but got '{}'", text));
  };
  const std::string_view shape = parts.empty() ? "" : parts.front();
  if (shape == "sphere" && parts.size() == 2) return {text, Separation::sphere(length(1))};
  if (shape == "cylinder" && parts.size() == 3) return {text, Separation::cylinder(length(1), length(2))};
  if (shape == "ellipsoid" && parts.size() == 3) return {text, Separation::ellipsoid(length(1), length(2))};
  throw ProgramError(
      fmt::format("--separation: expected sphere:RADIUS, cylinder:HORIZONTAL:VERTICAL or "
                  "ellipsoid:HORIZONTAL:VERTICAL, but "
                  "got '{}'",
                  text));
}

}  // namespace kinesphere::program
