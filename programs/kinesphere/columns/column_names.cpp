// Parses the names of columns: quantity and unit.
#include "columns/column_names.hpp"

#include <algorithm>
#include <array>

#include "ascii_text.hpp"

namespace kinesphere::program {
namespace {

struct QuantityNames {
  Quantity quantity;
  std::string_view key;
  Measure measure;
  /// Names in headers besides the key: lower case, without blanks, - _ and . between words. A unit may follow
  /// a colon; ? after it says that the name does not tell.
  std::string_view names;
};

constexpr QuantityNames quantities[quantity_count] = {
    {Quantity::id, "id", Measure::none,
     "mmsi trackid agent agentid ped pedid pedestrian pedestrianid person personid object objectid vehicleid "
     "vesselid icao24 hex trajectoryid particle particleid tag tagid animalid individuallocalidentifier"},
    {Quantity::time, "time", Measure::time,
     "t timestamp datetime basedatetime utc timeutc timestamputc datetimeutc unixtime epoch stamp zeit "
     "seconds:s secs:s milliseconds:ms"},
    {Quantity::frame, "frame", Measure::none, "frameid frameno framenr framenumber frameindex"},
    {Quantity::arrival, "arrival", Measure::time, "received"},
    {Quantity::x, "x", Measure::length, "posx positionx px east easting"},
    {Quantity::y, "y", Measure::length, "posy positiony py north northing"},
    {Quantity::z, "z", Measure::length, "posz positionz pz alt altitude ele elevation"},
    {Quantity::longitude, "lon", Measure::angle,
     "lng long longitude locationlong locationlon gpslon gpslongitude"},
    {Quantity::latitude, "lat", Measure::angle, "latitude locationlat gpslat gpslatitude"},
    {Quantity::vx, "vx", Measure::speed, "velx velocityx"},
    {Quantity::vy, "vy", Measure::speed, "vely velocityy"},
    {Quantity::vz, "vz", Measure::speed, "velz velocityz"},
    {Quantity::speed, "speed", Measure::speed, "gs:? sog:?"},
    {Quantity::course, "course", Measure::none, "cog track"},
    {Quantity::climb, "climb", Measure::speed, "verticalrate:?"},
    {Quantity::position_error, "position_error", Measure::length, "positionerror"},
    {Quantity::height_error, "height_error", Measure::length, "heighterror"},
    {Quantity::velocity_error, "velocity_error", Measure::speed, "velocityerror"},
    {Quantity::climb_error, "climb_error", Measure::speed, "climberror"},
    {Quantity::stamp_error, "stamp_error", Measure::time, "stamperror"},
    {Quantity::length, "length", Measure::length, "vehiclelength objectlength"},
    {Quantity::width, "width", Measure::length, "vehiclewidth objectwidth"}};

const QuantityNames& names_of(Quantity quantity) { return quantities[static_cast<std::size_t>(quantity)]; }

/// Calls `visit` with each word, until it returns true; returns whether it did.
template <class Visitor>
bool any_word(std::string_view words, Visitor visit) {
  while (!words.empty()) {
    const std::string_view word = words.substr(0, words.find(' '));
    words.remove_prefix(std::min(word.size() + 1, words.size()));
    if (visit(word)) return true;
  }
  return false;
}

std::optional<ColumnMeaning> whole_name(std::string_view name) {
  const std::string plain = plain_name(name);
  for (const QuantityNames& each : quantities) {
    if (plain == each.key) return ColumnMeaning{each.quantity, ""};
    std::optional<ColumnMeaning> meaning;
    any_word(each.names, [&](std::string_view word) {
      const std::size_t colon = std::min(word.find(':'), word.size());
      if (word.substr(0, colon) != plain) return false;
      const std::string_view unit = word.substr(std::min(colon + 1, word.size()));
      const bool asks = unit == "?";
      meaning = ColumnMeaning{each.quantity, asks ? "" : std::string(unit), asks};
      return true;
    });
    if (meaning) return meaning;
  }
  return std::nullopt;
}

/// `nm` may be a nanometre or a nautical mile, so it is no unit in a name.
bool is_unit_of(Measure measure, std::string_view unit) {
  if (unit == "nm") return false;
  if (measure == Measure::length && (is_pixel(unit) || unit_named(unit, Measure::angle))) return true;
  return unit_named(unit, measure).has_value();
}

/// Returns the text behind `at` as a unit: without brackets, blanks and the word "in".
std::string_view unit_behind(std::string_view name, std::size_t at) {
  std::string_view unit = name.substr(at);
  while (!unit.empty() && std::string_view(" _-,([/").find(unit.front()) != std::string_view::npos)
    unit.remove_prefix(1);
  for (std::string_view in : {"in_", "in "})
    if (unit.starts_with(in)) unit.remove_prefix(in.size());
  while (!unit.empty() && std::string_view(" )]").find(unit.back()) != std::string_view::npos)
    unit.remove_suffix(1);
  return unit;
}

/// True if a unit may begin at `at`: behind a separator, or at the end of a word in camelCase.
bool may_begin_unit(std::string_view name, std::size_t at) {
  constexpr std::string_view between = " _,([/";
  if (between.find(name[at]) != std::string_view::npos) return true;
  const auto is_upper = [](char c) { return lower_case(c) != c; };
  return is_upper(name[at]) && !is_upper(name[at - 1]) &&
         between.find(name[at - 1]) == std::string_view::npos;
}

}  // namespace

std::string plain_name(std::string_view name) {
  std::string plain;
  for (char c : name)
    if (c != ' ' && c != '_' && c != '-' && c != '.') plain += lower_case(c);
  return plain;
}

Measure measure_of(Quantity quantity) { return names_of(quantity).measure; }
std::string_view key_of(Quantity quantity) { return names_of(quantity).key; }

std::optional<Quantity> quantity_of_key(std::string_view key) {
  if (key == "alt") return Quantity::z;
  for (const QuantityNames& each : quantities)
    if (each.key == key) return each.quantity;
  return std::nullopt;
}

std::string key_list() {
  std::string list;
  for (const QuantityNames& each : quantities) list += (list.empty() ? "" : ", ") + std::string(each.key);
  return list;
}

std::optional<ColumnMeaning> meaning_of(std::string_view column_name) {
  if (const auto meaning = whole_name(column_name)) return meaning;
  for (std::size_t at = 1; at < column_name.size(); ++at) {
    if (!may_begin_unit(column_name, at)) continue;
    const auto meaning = whole_name(column_name.substr(0, at));
    const std::string_view unit = unit_behind(column_name, at);
    if (meaning && meaning->unit.empty() && is_unit_of(measure_of(meaning->quantity), unit))
      return ColumnMeaning{meaning->quantity, std::string(unit)};
  }
  return std::nullopt;
}

std::string_view unit_in_name(std::string_view column_name, Measure measure) {
  for (std::size_t at = 1; at < column_name.size(); ++at) {
    const std::string_view unit = unit_behind(column_name, at);
    if (may_begin_unit(column_name, at) && is_unit_of(measure, unit)) return unit;
  }
  return {};
}

bool looks_like_height(std::string_view column_name) {
  const std::string plain = plain_name(column_name);
  for (std::string_view part : {"altitude", "elevation", "height"})
    if (plain.find(part) != std::string::npos) return true;
  std::string words;
  for (char c : column_name)
    words += c == '_' || c == '-' || c == '.' || c == '/' || c == '(' ? ' ' : lower_case(c);
  return any_word(words, [](std::string_view word) {
    return any_word("z alt elev hgt fl msl agl depth", [&](std::string_view each) { return each == word; });
  });
}

std::string_view void_values_of(std::string_view column_name) {
  const std::string plain = plain_name(column_name);
  if (plain == "lost" || plain == "outlier" || plain == "algorithmmarkedoutlier" ||
      plain == "manuallymarkedoutlier")
    return "true 1 yes t";
  if (plain == "visible" || plain == "valid" || plain == "isvalid") return "false 0 no f";
  return {};
}

}  // namespace kinesphere::program
