// Classes of tracks by their limits of motion: presets, and those of --class.
#include "watch/motion_classes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "ascii_text.hpp"
#include "columns/column_names.hpp"
#include "number_text.hpp"
#include "program_error.hpp"
#include "watch/measures.hpp"

namespace kinesphere::program {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Horizontal and vertical limits, in metres and seconds.
struct PresetRow {
  std::string_view name;
  double acceleration, vertical_acceleration;
  double speed, vertical_speed;
};

/// In the order of MotionPreset. docs/watch.md has the source of each figure.
constexpr PresetRow preset_rows[preset_count] = {
    {"vessel-at-rest", 0.05, 0.05, 1.0, 1.0},
    {"vessel", 0.3, 0.3, 30.0, 30.0},
    {"small-craft", 5.0, 5.0, 40.0, 40.0},
    {"high-speed-craft", 2.0, 2.0, 50.0, 50.0},
    {"wing-in-ground", 6.0, 3.0, 160.0, 20.0},
    {"aid-to-navigation", unlimited, unlimited, 1.0, 1.0},
    {"search-aircraft", 17.0, 10.0, 400.0, 60.0},
    {"airliner", 6.0, 3.0, 400.0, 60.0},
    {"light-aircraft", 17.0, 10.0, 400.0, 60.0},
    {"high-performance", 90.0, 100.0, 800.0, 350.0},
    {"rotorcraft", 17.0, 10.0, 200.0, 60.0},
    {"glider", 17.0, 20.0, 160.0, 60.0},
    {"balloon", 5.0, 5.0, 130.0, 30.0},
    {"parachutist", 50.0, 50.0, 160.0, 150.0},
    {"ultralight", 40.0, 40.0, 130.0, 60.0},
    {"unmanned-aircraft", 40.0, 40.0, 400.0, 60.0},
    {"drone", 40.0, 40.0, 60.0, 40.0},
    {"ground-vehicle", 10.0, 3.0, 70.0, 20.0},
    {"obstacle", 5.0, 5.0, 20.0, 20.0},
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

/// Returns a whole number from 0 to 99; nothing for other text.
std::optional<int> code_in(std::string_view text) {
  const auto number = parse_number(text);
  if (!number || !(*number >= 0.0 && *number <= 99.0) || *number != std::floor(*number)) return std::nullopt;
  return static_cast<int>(*number);
}

}  // namespace

std::string promise_text(const MotionLimits& limits) {
  return fmt::format("acceleration: {}; speed: {}", spread_text(limits.acceleration),
                     spread_text(limits.largest_speed));
}

std::string_view name_of(MotionPreset preset) { return preset_rows[static_cast<std::size_t>(preset)].name; }

std::optional<MotionPreset> motion_preset_named(std::string_view name) {
  for (std::size_t k = 0; k < preset_count; ++k)
    if (same_name(preset_rows[k].name, name)) return static_cast<MotionPreset>(k);
  return std::nullopt;
}

MotionClass motion_class(MotionPreset preset) {
  const PresetRow& row = preset_rows[static_cast<std::size_t>(preset)];
  MotionClass result{.name = std::string(row.name),
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

MotionClass parse_motion_class(const std::string& text) {
  if (const auto preset = motion_preset_named(text)) return motion_class(*preset);
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) {
    std::string names;
    for (const PresetRow& row : preset_rows) names += fmt::format("{}, ", row.name);
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

std::optional<MotionPreset> preset_of_emitter(std::string_view category) {
  // A0, B0, C0 and D: no information. A2 to A5, small to heavy: the default. B7, space vehicles, have no
  // limits here.
  constexpr std::pair<std::string_view, MotionPreset> presets[] = {
      {"A1", MotionPreset::light_aircraft}, {"A6", MotionPreset::high_performance},
      {"A7", MotionPreset::rotorcraft},     {"B1", MotionPreset::glider},
      {"B2", MotionPreset::balloon},        {"B3", MotionPreset::parachutist},
      {"B4", MotionPreset::ultralight},     {"B6", MotionPreset::unmanned_aircraft},
      {"C1", MotionPreset::ground_vehicle}, {"C2", MotionPreset::ground_vehicle},
      {"C3", MotionPreset::obstacle},       {"C4", MotionPreset::obstacle},
      {"C5", MotionPreset::obstacle}};
  for (const auto& [name, preset] : presets)
    if (same_name(name, category)) return preset;
  return std::nullopt;
}

std::string_view emitter_of_opensky(int category) {
  constexpr std::string_view emitters[] = {"",   "",   "A1", "A2", "A3", "A4", "A5", "A6", "A7", "B1", "B2",
                                           "B3", "B4", "B5", "B6", "B7", "C1", "C2", "C3", "C4", "C5"};
  const bool is_known = category >= 0 && category < static_cast<int>(std::size(emitters));
  return is_known ? emitters[category] : std::string_view();
}

std::optional<MotionPreset> preset_of_ship_type(int type) {
  if (type >= 40 && type <= 49) return MotionPreset::high_speed_craft;
  if (type >= 20 && type <= 29) return MotionPreset::wing_in_ground;
  return std::nullopt;
}

std::optional<MotionPreset> preset_of_status(int status) {
  // At anchor, moored, aground.
  if (status == 1 || status == 5 || status == 6) return MotionPreset::vessel_at_rest;
  return std::nullopt;
}

std::optional<MotionPreset> preset_of_ship_type(std::string_view text) {
  if (const auto code = code_in(text)) return preset_of_ship_type(*code);
  const std::string plain = plain_name(text);
  if (plain == "hsc" || plain.starts_with("highspeed")) return MotionPreset::high_speed_craft;
  if (plain == "wig" || plain.starts_with("winginground")) return MotionPreset::wing_in_ground;
  return std::nullopt;
}

std::optional<MotionPreset> preset_of_status(std::string_view text) {
  if (const auto code = code_in(text)) return preset_of_status(*code);
  const std::string plain = plain_name(text);
  if (plain == "atanchor" || plain == "moored" || plain == "aground") return MotionPreset::vessel_at_rest;
  return std::nullopt;
}

std::optional<MotionPreset> preset_of_mobile(std::string_view text) {
  const std::string plain = plain_name(text);
  if (plain == "sarairborne") return MotionPreset::search_aircraft;
  if (plain == "aton" || plain == "basestation") return MotionPreset::aid_to_navigation;
  return std::nullopt;
}

}  // namespace kinesphere::program
