// Lengths, speeds, accelerations and times of the command line, with their units.
#include "watch/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "number_text.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
double parse_measure(std::string_view text, Measure measure, std::string_view option) {
  std::size_t end = std::min(text.find_first_not_of("0123456789.+-eE"), text.size());
  // An e that no digit follows is not part of the number.
  while (end > 0 && (text[end - 1] == 'e' || text[end - 1] == 'E')) --end;
  std::string_view unit = text.substr(end);
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  const auto number = parse_number(text.substr(0, end));
  const double size = unit.empty() ? 1.0 : unit_named(unit, measure).value_or(0.0);
  if (!number || size == 0.0 || *number < 0.0)
    throw ProgramError(fmt::format("{}: expected a number >= 0 and perhaps a unit ({}), but got '{}'", option,
                                   unit_list(measure), text));
  return *number * size;
}

ErrorBound parse_spread(std::string_view text, Measure measure, std::string_view option) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return ErrorBound(parse_measure(text, measure, option));
  return ErrorBound::cylinder(parse_measure(text.substr(0, colon), measure, option),
                              parse_measure(text.substr(colon + 1), measure, option));
}

}  // namespace kinesphere::program
