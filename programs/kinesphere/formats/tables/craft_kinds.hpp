// Kinds of craft, and what streams say of them.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace kinesphere::program {

/// Kinds of craft with limits of their own; docs/watch-streams.md has the source of each figure.
enum class MotionPreset {
  vessel_at_rest,
  vessel,
  small_craft,
  high_speed_craft,
  wing_in_ground,
  aid_to_navigation,
  search_aircraft,
  airliner,
  light_aircraft,
  high_performance,
  rotorcraft,
  glider,
  balloon,
  parachutist,
  ultralight,
  unmanned_aircraft,
  drone,
  ground_vehicle,
  obstacle,
};
inline constexpr std::size_t preset_count = static_cast<std::size_t>(MotionPreset::obstacle) + 1;

/// Returns "vessel-at-rest" and so on.
std::string_view name_of(MotionPreset preset);
std::optional<MotionPreset> motion_preset_named(std::string_view name);

// What streams say.

/// Presets that emitter categories may say.
inline constexpr MotionPreset emitter_presets[] = {
    MotionPreset::light_aircraft, MotionPreset::high_performance,  MotionPreset::rotorcraft,
    MotionPreset::glider,         MotionPreset::balloon,           MotionPreset::parachutist,
    MotionPreset::ultralight,     MotionPreset::unmanned_aircraft, MotionPreset::ground_vehicle,
    MotionPreset::obstacle};
/// Returns the preset of an emitter category of ADS-B, A0 to D7; nothing for one of which nothing is known,
/// and for those with the limits that are the default for aircraft.
std::optional<MotionPreset> preset_of_emitter(std::string_view category);
/// Returns "A1" and so on for the categories of OpenSky's state vectors; empty for others.
std::string_view emitter_of_opensky(int category);
/// Returns the preset of a type of ship and cargo of AIS, 0 to 99.
std::optional<MotionPreset> preset_of_ship_type(int type);
/// Returns the preset of a navigational status of AIS, 0 to 15.
std::optional<MotionPreset> preset_of_status(int status);
// The same for the texts in tables of AIS: numbers or words, such as "At anchor" and "HSC".
std::optional<MotionPreset> preset_of_ship_type(std::string_view text);
std::optional<MotionPreset> preset_of_status(std::string_view text);
/// Returns the preset of a "Type of mobile" of the Danish Maritime Authority: "AtoN", "SAR Airborne".
std::optional<MotionPreset> preset_of_mobile(std::string_view text);

}  // namespace kinesphere::program
