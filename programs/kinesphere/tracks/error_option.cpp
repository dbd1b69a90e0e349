// How far positions are declared to be off: --error.
#include "tracks/error_option.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/program_error.hpp"
#include "formats/fields/units.hpp"

namespace kinesphere::program {

PositionErrors errors_of(const std::string& given, const Closeness& closeness, const TrackSet& track_set) {
  if (given.empty()) return {};
  if (closeness.vertical)
    throw ProgramError("--error: expected --distance or a sphere, because a cylinder has two limits");
  const std::size_t colon = std::min(given.find(':'), given.size());
  const std::string length = given.substr(0, colon), speed = given.substr(std::min(colon + 1, given.size()));
  PositionErrors errors{.at_samples = parse_measure(length, Measure::length, "--error"), .samples = {}};
  if (colon < given.size()) errors.growth = parse_measure(speed, Measure::speed, "--error");
  const bool has_unit = has_unit_behind(length) || (!speed.empty() && has_unit_behind(speed));
  if (has_unit && !track_set.in_metres)
    throw ProgramError(fmt::format(
        "--error: expected numbers without a unit, because the unit of lengths is not known, but got "
        "'{}': say --unit",
        given));
  for (const RecordedTrack& track : track_set.tracks) {
    std::vector<double>& times = errors.samples.emplace_back();
    for (const TrackSample& sample : track.samples) times.push_back(sample.time);
  }
  return errors;
}

double largest_error(const PositionErrors& errors, const TrackSet& track_set) {
  double largest = 0.0;
  for (std::uint32_t k = 0; errors.any() && k < track_set.tracks.size(); ++k)
    largest = std::max(largest, errors.largest(k, track_set.tracks[k].from(), track_set.tracks[k].until()));
  return 2.0 * largest;
}

}  // namespace kinesphere::program
