// Lengths, speeds, accelerations and times of the command line, with their units.
#include "watch/measures.hpp"

namespace kinesphere::program {
ErrorBound parse_spread(std::string_view text, Measure measure, std::string_view option) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return ErrorBound(parse_measure(text, measure, option));
  return ErrorBound::cylinder(parse_measure(text.substr(0, colon), measure, option),
                              parse_measure(text.substr(colon + 1), measure, option));
}

}  // namespace kinesphere::program
