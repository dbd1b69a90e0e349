// Separations of the command line.
#include "formats/fields/separations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/program_error.hpp"
#include "formats/fields/units.hpp"

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

/// Alerts of DO-365 for aircraft en route, with the figures of DAIDALUS 2.0.4's DO_365B_no_SUM.conf
/// (DWC_Phase_I): DTHR, ZTHR, TTHR and alerting_time of alerts 1 to 3.
struct NamedVolume {
  std::string_view name, separation;
};
constexpr NamedVolume named_volumes[] = {{"do365:preventive", "well-clear:0.66NM:700ft:35s:55s"},
                                         {"do365:corrective", "well-clear:0.66NM:450ft:35s:55s"},
                                         {"do365:warning", "well-clear:0.66NM:450ft:35s:25s"}};

/// Returns the definition of a named separation; any other text as it is.
std::string_view without_name(std::string_view text) {
  for (const auto& [name, separation] : named_volumes)
    if (text == name) return separation;
  return text;
}

/// What the parts of a separation are, in the order in which they are given.
struct SeparationForm {
  std::string_view shape;
  std::size_t lengths, times;  ///< number of each; one more time is the look-ahead
};
constexpr SeparationForm separation_forms[] = {
    {"sphere", 1, 0}, {"cylinder", 2, 0}, {"ellipsoid", 2, 0}, {"well-clear", 2, 1}};

}  // namespace

NamedSeparation parse_separation(const std::string& text) {
  const auto parts = separation_parts(without_name(text));
  const auto wrong = [&](std::string_view expected) {
    return ProgramError(fmt::format("--separation: expected {}, but got '{}'", expected, text));
  };
  const auto* form =
      std::find_if(std::begin(separation_forms), std::end(separation_forms),
                   [&](const SeparationForm& one) { return !parts.empty() && one.shape == parts.front(); });
  if (form == std::end(separation_forms) || parts.size() < 1 + form->lengths + form->times ||
      parts.size() > 2 + form->lengths + form->times)
    throw wrong(
        "sphere:RADIUS, cylinder:HORIZONTAL:VERTICAL, ellipsoid:HORIZONTAL:VERTICAL or "
        "well-clear:HORIZONTAL:VERTICAL:MODIFIED_TAU, with or without :TIME behind it, or do365:preventive, "
        "do365:corrective or do365:warning");
  const auto measure = [&](std::size_t place, Measure unit) {
    const double value = parse_measure(parts[place], unit, "--separation");
    if (value > 0.0 || (unit == Measure::time && value == 0.0)) return value;
    throw wrong("lengths > 0 and times >= 0");
  };
  Separation separation;
  separation.horizontal = measure(1, Measure::length);
  separation.vertical = form->lengths == 2 ? measure(2, Measure::length) : separation.horizontal;
  if (form->shape == "cylinder") separation.shape = Separation::Shape::cylinder;
  if (form->times == 1) {
    separation.shape = Separation::Shape::well_clear;
    separation.modified_tau = measure(3, Measure::time);
  }
  const std::size_t last = 1 + form->lengths + form->times;
  const bool has_time = parts.size() > last;
  if (has_time) separation.look_ahead = measure(last, Measure::time);
  const bool has_unit =
      std::any_of(parts.begin() + 1, parts.begin() + 1 + std::ptrdiff_t(form->lengths), has_unit_behind);
  return {text, separation, has_time, has_unit};
}

}  // namespace kinesphere::program
