// Parses the names of columns: quantity and unit.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/fields/units.hpp"

namespace kinesphere::program {

/// What a column has. Heights and altitudes are z.
enum class Quantity {
  id,
  time,
  frame,
  date,  ///< of a clock time in another column
  arrival,
  x,
  y,
  z,
  longitude,
  latitude,
  vx,
  vy,
  vz,
  speed,
  course,
  climb,
  position_error,
  height_error,
  velocity_error,
  climb_error,
  stamp_error,
  length,
  width,
  body_height,
  heading,  ///< which way a body points
};
inline constexpr std::size_t quantity_count = static_cast<std::size_t>(Quantity::heading) + 1;

Measure measure_of(Quantity quantity);
/// Returns the key of --columns: id, time, lon and so on.
std::string_view key_of(Quantity quantity);
/// Knows the keys, and alt for z.
std::optional<Quantity> quantity_of_key(std::string_view key);
/// Returns all keys, separated by commas.
std::string key_list();

/// Returns the name in lower case, without blanks, - _ . and : between words.
std::string plain_name(std::string_view name);

struct ColumnMeaning {
  Quantity quantity;
  std::string unit;         ///< unit in the name, like x/m, "time [ms]", lat_deg; empty if there is none
  bool needs_unit = false;  ///< the usual unit of this name is not that of metres and seconds
};

/// Knows the usual names in any case, with or without blanks, - and _ between words; returns nothing for
/// others.
std::optional<ColumnMeaning> meaning_of(std::string_view column_name);
/// Returns the meaning of the end of a name, from one of its words on: that of "position.x" in
/// field.pose.position.x.
std::optional<ColumnMeaning> meaning_of_ending(std::string_view column_name);
/// What a column has of a body, and the body that the rest of its name tells: x1, fish_2.y, z_head, lat_a.
struct AxisAndBody {
  Quantity axis = Quantity::x;  ///< x, y, z, longitude or latitude
  std::string body;             ///< in lower case; empty for another name
};
AxisAndBody axis_and_body(std::string_view column_name);
/// Returns the unit of this measure at the end of a name such as east_cm or "up [ft]"; empty if there is
/// none.
std::string_view unit_in_name(std::string_view column_name, Measure measure);
/// What a name may say besides the quantity of its numbers.
enum class NameHint {
  height,         ///< a word for heights: geoaltitude, z_raw, altGeom, floor
  longitude,      ///< a word for longitudes or of the earth: geo_lon, X_WGS84
  latitude,       ///< likewise
  part_of_time,   ///< beside another column with its seconds: nanosec, gps_week
  part_of_clock,  ///< seconds, minutes or hours, of which a time may need all
  scene,          ///< to which scene, trial, match or part of it a row belongs: scene_id, gameId, period
  id,             ///< ids, or kinds of bodies: name, vehicle
  aircraft,       ///< what only tables of aircraft have: icao24, callsign, squawk, alt_baro
  zone,           ///< in which zone, map or building the coordinates of a row are
};
bool hints_at(std::string_view column_name, NameHint hint);
/// True for a name that ends as whole seconds do: stamp.sec, secs.
bool is_whole_seconds(std::string_view column_name);
/// True for whole seconds and their nanoseconds: stamp.sec and stamp.nanosec.
bool are_parts_of_time(std::string_view seconds, std::string_view nanoseconds);
/// Returns the values with which a column says that its row means nothing, such as "true 1" of `lost`; empty
/// for other columns.
std::string_view void_values_of(std::string_view column_name);
/// True for an id that is nobody in most files: missing, negative, unknown, noise; 0 for MMSI and ICAO 24.
bool is_nobody(std::string_view column_name, std::string_view id);

}  // namespace kinesphere::program
