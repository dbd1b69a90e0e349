// Classes of tracks by their limits of motion: presets, and those of --class.
#include "watch/tracks/motion_classes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Horizontal and vertical limits, in metres and seconds.
struct PresetRow {
  double acceleration, vertical_acceleration;
  double speed, vertical_speed;
};

/// In the order of MotionPreset. docs/watch-streams.md has the source of each figure.
constexpr PresetRow preset_rows[preset_count] = {
    {0.05, 0.05, 1.0, 1.0},            // vessel-at-rest
    {0.3, 0.3, 30.0, 30.0},            // vessel
    {5.0, 5.0, 40.0, 40.0},            // small-craft
    {2.0, 2.0, 50.0, 50.0},            // high-speed-craft
    {6.0, 3.0, 160.0, 20.0},           // wing-in-ground
    {unlimited, unlimited, 1.0, 1.0},  // aid-to-navigation
    {17.0, 10.0, 400.0, 60.0},         // search-aircraft
    {6.0, 3.0, 400.0, 60.0},           // airliner
    {17.0, 10.0, 400.0, 60.0},         // light-aircraft
    {90.0, 100.0, 800.0, 350.0},       // high-performance
    {17.0, 10.0, 200.0, 60.0},         // rotorcraft
    {17.0, 20.0, 160.0, 60.0},         // glider
    {5.0, 5.0, 130.0, 30.0},           // balloon
    {50.0, 50.0, 160.0, 150.0},        // parachutist
    {40.0, 40.0, 130.0, 60.0},         // ultralight
    {40.0, 40.0, 400.0, 60.0},         // unmanned-aircraft
    {40.0, 40.0, 60.0, 40.0},          // drone
    {10.0, 3.0, 70.0, 20.0},           // ground-vehicle
    {5.0, 5.0, 20.0, 20.0},            // obstacle
};

/// Speeds up to which a craft that is said to be at rest is believed: half of the largest speed of its class,
/// and 0.7 of it once it is believed, so that a ship that swings at anchor keeps its class.
constexpr double believed = 0.5, still_believed = 0.7;

std::string spread_text(const ErrorBound& spread) {
  if (!std::isfinite(spread.total())) return "any";
  return spread.horizontal() == spread.vertical()
             ? fmt::format("{:.4g}", spread.horizontal())
             : fmt::format("{:.4g}:{:.4g}", spread.horizontal(), spread.vertical());
}

ErrorBound limit_of(double horizontal, double vertical) {
  return horizontal == vertical ? ErrorBound(horizontal) : ErrorBound::cylinder(horizontal, vertical);
}

}  // namespace

std::string promise_text(const MotionLimits& limits) {
  return fmt::format("acceleration: {}; speed: {}", spread_text(limits.acceleration),
                     spread_text(limits.largest_speed));
}

MotionClass motion_class(MotionPreset preset) {
  const PresetRow& row = preset_rows[static_cast<std::size_t>(preset)];
  MotionClass result{.name = std::string(name_of(preset)),
                     .limits = {limit_of(row.acceleration, row.vertical_acceleration),
                                limit_of(row.speed, row.vertical_speed)},
                     .given_up_to = row.speed,
                     .kept_up_to = row.speed};
  if (preset == MotionPreset::vessel_at_rest) {
    result.is_at_rest = true;
    result.given_up_to = believed * row.speed;
    result.kept_up_to = still_believed * row.speed;
  }
  return result;
}

ErrorBound parse_spread(std::string_view text, Measure measure, std::string_view option) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return ErrorBound(parse_measure(text, measure, option));
  return ErrorBound::cylinder(parse_measure(text.substr(0, colon), measure, option),
                              parse_measure(text.substr(colon + 1), measure, option));
}

MotionClass parse_motion_class(const std::string& text) {
  if (const auto preset = motion_preset_named(text)) return motion_class(*preset);
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) {
    std::string names;
    for (std::size_t k = 0; k < preset_count; ++k)
      names += fmt::format("{}, ", name_of(static_cast<MotionPreset>(k)));
    throw ProgramError(
        fmt::format("--class: expected {}or limits as 5:2,40:10 (acceleration and largest speed), but got "
                    "'{}'",
                    names, text));
  }
  MotionClass result{.name = text};
  const auto limit = [](const std::string& part, Measure measure) {
    return trimmed(part).empty() ? ErrorBound(unlimited) : parse_spread(part, measure, "--class");
  };
  result.limits = {limit(text.substr(0, comma), Measure::acceleration),
                   limit(text.substr(comma + 1), Measure::speed)};
  if (!std::isfinite(result.limits.acceleration.total()) &&
      !std::isfinite(result.limits.largest_speed.total()))
    throw ProgramError(fmt::format("--class: expected a limit before or behind the comma of '{}'", text));
  return result;
}

}  // namespace kinesphere::program
