// Kinds of craft, and what streams say of them.
#include "formats/tables/craft_kinds.hpp"

#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "formats/tables/column_names.hpp"

namespace kinesphere::program {
namespace {

/// In the order of MotionPreset.
constexpr std::string_view kind_names[preset_count] = {
    "vessel-at-rest",    "vessel",          "small-craft",    "high-speed-craft", "wing-in-ground",
    "aid-to-navigation", "search-aircraft", "airliner",       "light-aircraft",   "high-performance",
    "rotorcraft",        "glider",          "balloon",        "parachutist",      "ultralight",
    "unmanned-aircraft", "drone",           "ground-vehicle", "obstacle",
};

/// Returns a whole number from 0 to 99; nothing for other text.
std::optional<int> code_in(std::string_view text) {
  const auto number = parse_number(text);
  if (!number || !(*number >= 0.0 && *number <= 99.0) || *number != std::floor(*number)) return std::nullopt;
  return static_cast<int>(*number);
}

}  // namespace

std::string_view name_of(MotionPreset preset) { return kind_names[static_cast<std::size_t>(preset)]; }

std::optional<MotionPreset> motion_preset_named(std::string_view name) {
  for (std::size_t k = 0; k < preset_count; ++k)
    if (same_name(kind_names[k], name)) return static_cast<MotionPreset>(k);
  return std::nullopt;
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
