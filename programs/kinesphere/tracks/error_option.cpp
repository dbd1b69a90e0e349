// How far positions are declared to be off: --error, and what bodies promise between samples.
#include "tracks/error_option.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/program_error.hpp"
#include "formats/fields/units.hpp"

namespace kinesphere::program {
namespace {

/// Reads the numbers of the options, which have units only where that of the recording is known.
class ErrorReader {
 public:
  ErrorReader(const ErrorOptions& given, const TrackSet& track_set) : given_(given), track_set_(track_set) {}

  PositionErrors read() const {
    PositionErrors errors;
    const std::size_t colon = std::min(given_.error.find(':'), given_.error.size());
    if (!given_.error.empty())
      errors.at_samples = number(given_.error.substr(0, colon), Measure::length, "--error", given_.error);
    if (colon < given_.error.size())
      errors.growth = number(given_.error.substr(colon + 1), Measure::speed, "--error", given_.error);
    const auto set_limit = [&](const std::string& text, Measure measure, std::string_view option,
                               double& limit) {
      if (!text.empty()) limit = number(text, measure, option, text);
    };
    set_limit(given_.largest_speed, Measure::speed, "--largest-speed", errors.speed_limit);
    set_limit(given_.acceleration, Measure::acceleration, "--acceleration", errors.acceleration_limit);
    if (given_.has_limits() && colon < given_.error.size())
      throw ProgramError(fmt::format(
          "--error: expected LENGTH alone beside --largest-speed and --acceleration, which say how it "
          "grows, but got '{}'",
          given_.error));
    for (const RecordedTrack& track : track_set_.tracks) {
      auto& samples = errors.samples.emplace_back();
      for (std::size_t k = 0; k < track.samples.size(); ++k) {
        const TrackSample &sample = track.samples[k],
                          &next = track.samples[std::min(k + 1, track.samples.size() - 1)];
        samples.push_back({sample.time, norm(next.position - sample.position)});
      }
    }
    return errors;
  }

 private:
  double number(const std::string& text, Measure measure, std::string_view option,
                const std::string& all) const {
    const double number = parse_measure(text, measure, option);
    if (has_unit_behind(text) && !track_set_.in_metres)
      throw ProgramError(
          fmt::format("{}: expected numbers without a unit, because the unit of lengths is not known, but "
                      "got '{}': say --unit",
                      option, all));
    return number;
  }

  const ErrorOptions& given_;
  const TrackSet& track_set_;
};

/// Throws ProgramError for samples that a body cannot reach that keeps the limits.
void require_kept(const PositionErrors& errors, const TrackSet& track_set) {
  constexpr double rounding = 1.0 + 1e-9;
  const double off = 2.0 * errors.at_samples;
  const auto fail = [&](std::string_view option, const RecordedTrack& track, std::size_t k,
                        std::string_view does, double least, double limit) {
    throw ProgramError(
        fmt::format("{}: {} {} by {:.6g} at least around {}, which is more than {:.6g}: expected a larger "
                    "limit, or --error with "
                    "how far positions may be off",
                    option, track.id, does, least, track_set.times.text(track.samples[k].time, 6), limit));
  };
  for (std::size_t body = 0; body < track_set.tracks.size(); ++body) {
    const RecordedTrack& track = track_set.tracks[body];
    double last_whole = 0.0;
    Vec3 last_velocity;
    for (std::size_t k = 0; k + 1 < track.samples.size(); ++k) {
      const TrackSample &one = track.samples[k], &two = track.samples[k + 1];
      const double whole = two.time - one.time;
      const Vec3 velocity = (two.position - one.position) / whole;
      if (const double least = norm(velocity) - off / whole; least > rounding * errors.speed_limit)
        fail("--largest-speed", track, k, "moves", least, errors.speed_limit);
      if (k > 0) {
        const double change = norm(velocity - last_velocity) - off * (1.0 / whole + 1.0 / last_whole);
        const double least = change / (0.5 * (whole + last_whole));
        if (least > rounding * errors.acceleration_limit)
          fail("--acceleration", track, k, "accelerates", least, errors.acceleration_limit);
      }
      last_whole = whole;
      last_velocity = velocity;
    }
  }
}

}  // namespace

std::string ErrorOptions::text() const {
  std::string text = error.empty() ? "nothing" : error;
  if (has_limits()) text += " at samples";
  if (!largest_speed.empty()) text += fmt::format(", and speeds up to {}", largest_speed);
  if (!acceleration.empty()) text += fmt::format(", and accelerations up to {}", acceleration);
  return text;
}

Interpolation interpolation_for(const ErrorOptions& given, const TrackOptions& reading) {
  if (!given.has_limits()) return reading.chosen_interpolation();
  const std::string_view option = given.largest_speed.empty() ? "--acceleration" : "--largest-speed";
  if (reading.interpolation == Interpolation::spline)
    throw ProgramError(fmt::format(
        "{}: expected --interpolate linear, because what a body may do between samples is counted from "
        "the straight way",
        option));
  if (reading.outside != Outside::vanish)
    throw ProgramError(fmt::format(
        "{}: expected --outside vanish, because nothing bounds where a body is beyond its samples", option));
  return Interpolation::linear;
}

PositionErrors errors_of(const ErrorOptions& given, const Closeness& closeness, const TrackSet& track_set) {
  if (!given.any()) return {};
  if (closeness.vertical)
    throw ProgramError(fmt::format("{}: expected --distance or a sphere, because a cylinder has two limits",
                                   !given.error.empty()           ? "--error"
                                   : !given.largest_speed.empty() ? "--largest-speed"
                                                                  : "--acceleration"));
  const PositionErrors errors = ErrorReader(given, track_set).read();
  require_kept(errors, track_set);
  return errors;
}

double largest_error(const PositionErrors& errors, const TrackSet& track_set) {
  double largest = 0.0;
  for (std::uint32_t k = 0; errors.any() && k < track_set.tracks.size(); ++k)
    largest = std::max(largest, errors.largest(k, track_set.tracks[k].from(), track_set.tracks[k].until()));
  return 2.0 * largest;
}

}  // namespace kinesphere::program
