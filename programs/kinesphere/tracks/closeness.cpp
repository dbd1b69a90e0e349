// How close counts as an approach: --distance or --separation.
#include "tracks/closeness.hpp"

#include <fmt/format.h>

#include "base/program_error.hpp"
#include "formats/fields/separations.hpp"
#include "formats/fields/units.hpp"

namespace kinesphere::program {
Closeness closeness_of(const std::string& distance_text, const std::string& separation_text) {
  if (distance_text.empty() == separation_text.empty())
    throw ProgramError("expected either --distance LENGTH or --separation cylinder:HORIZONTAL:VERTICAL");
  if (!distance_text.empty()) {
    const double distance = parse_measure(distance_text, Measure::length, "--distance");
    if (distance > 0)
      return {.distance = distance,
              .vertical = {},
              .has_unit = has_unit_behind(distance_text),
              .option = "--distance",
              .given = distance_text,
              .text = fmt::format("below {}", distance)};
    throw ProgramError(fmt::format("--distance: expected a distance > 0, but got '{}'", distance_text));
  }
  const NamedSeparation named = parse_separation(separation_text);
  const Separation& separation = named.separation;
  if (separation.look_ahead > 0.0)
    throw ProgramError(
        fmt::format("--separation: expected no time, which a recording needs no prediction for, but got '{}'",
                    named.name));
  Closeness closeness{.distance = separation.horizontal,
                      .vertical = {},
                      .has_unit = named.has_unit,
                      .option = "--separation",
                      .given = named.name,
                      .text = fmt::format("below {}", separation.horizontal)};
  if (named.name.starts_with("sphere")) return closeness;
  if (named.name.starts_with("cylinder")) {
    closeness.vertical = separation.vertical;
    closeness.text = "within " + named.name;
    return closeness;
  }
  throw ProgramError(fmt::format(
      "--separation: expected sphere:RADIUS or cylinder:HORIZONTAL:VERTICAL, but got '{}'", named.name));
}

void check_closeness(const Closeness& closeness, const TrackSet& track_set) {
  if (closeness.vertical && track_set.has_sizes)
    throw ProgramError("--sizes: expected --distance or a sphere, because a cylinder is about points");
  if (closeness.has_unit && !track_set.in_metres)
    throw ProgramError(
        fmt::format("{}: expected numbers without a unit, because the unit of lengths is not known, but got "
                    "'{}': say --unit",
                    closeness.option, closeness.given));
  if (closeness.vertical && !track_set.has_heights)
    throw ProgramError(
        "--separation: expected a column of heights (z or alt) for a cylinder, but there is none");
}

TrackOptions reading_for(const Closeness& closeness, TrackOptions reading) {
  if (!closeness.vertical) return reading;
  if (reading.projection == ProjectionChoice::earth)
    throw ProgramError(
        "--projection: expected plane with a cylinder, because z is not vertical in the earth's space");
  if (reading.projection == ProjectionChoice::automatic) reading.projection = ProjectionChoice::ground;
  return reading;
}

}  // namespace kinesphere::program
