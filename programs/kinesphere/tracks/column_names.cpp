// Parses the names of columns: quantity and unit.
#include "tracks/column_names.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "ascii_text.hpp"

namespace kinesphere::program {
namespace {

struct KnownName {
  std::string_view name;  ///< lower case, letters and digits only
  Quantity quantity;
};

constexpr KnownName known_names[] = {
    {"id", Quantity::id},
    {"mmsi", Quantity::id},
    {"trackid", Quantity::id},
    {"agent", Quantity::id},
    {"agentid", Quantity::id},
    {"ped", Quantity::id},
    {"pedid", Quantity::id},
    {"pedestrian", Quantity::id},
    {"pedestrianid", Quantity::id},
    {"person", Quantity::id},
    {"personid", Quantity::id},
    {"object", Quantity::id},
    {"objectid", Quantity::id},
    {"vehicleid", Quantity::id},
    {"vesselid", Quantity::id},
    {"icao24", Quantity::id},
    {"t", Quantity::time},
    {"time", Quantity::time},
    {"timestamp", Quantity::time},
    {"datetime", Quantity::time},
    {"basedatetime", Quantity::time},
    {"utc", Quantity::time},
    {"timeutc", Quantity::time},
    {"timestamputc", Quantity::time},
    {"datetimeutc", Quantity::time},
    {"unixtime", Quantity::time},
    {"epoch", Quantity::time},
    {"frame", Quantity::frame},
    {"frameid", Quantity::frame},
    {"frameno", Quantity::frame},
    {"framenr", Quantity::frame},
    {"framenumber", Quantity::frame},
    {"frameindex", Quantity::frame},
    {"x", Quantity::x},
    {"posx", Quantity::x},
    {"positionx", Quantity::x},
    {"east", Quantity::x},
    {"easting", Quantity::x},
    {"y", Quantity::y},
    {"posy", Quantity::y},
    {"positiony", Quantity::y},
    {"north", Quantity::y},
    {"northing", Quantity::y},
    {"lon", Quantity::longitude},
    {"lng", Quantity::longitude},
    {"long", Quantity::longitude},
    {"longitude", Quantity::longitude},
    {"lat", Quantity::latitude},
    {"latitude", Quantity::latitude},
    {"z", Quantity::z},
    {"posz", Quantity::z},
    {"positionz", Quantity::z},
    {"alt", Quantity::z},
    {"altitude", Quantity::z},
};

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), lower_case);
  return result;
}

std::optional<Quantity> quantity_named(std::string_view lower_name) {
  std::string plain(lower_name);
  std::erase_if(plain, [](char c) { return c == ' ' || c == '_' || c == '-' || c == '.'; });
  const auto known = std::find_if(std::begin(known_names), std::end(known_names),
                                  [&](const KnownName& each) { return each.name == plain; });
  if (known == std::end(known_names)) return std::nullopt;
  return known->quantity;
}

bool is_unit_of(Quantity quantity, std::string_view unit) {
  switch (quantity) {
    case Quantity::id:
    case Quantity::frame:
      return false;
    case Quantity::time:
      return time_unit_named(unit).has_value();
    case Quantity::longitude:
    case Quantity::latitude:
      return unit == "deg";
    default:
      return length_unit_named(unit).has_value();
  }
}

}  // namespace

std::optional<TimeUnit> time_unit_named(std::string_view name) {
  constexpr std::pair<std::string_view, TimeUnit> units[] = {{"s", {}},
                                                             {"ms", {1.0, 1e3}},
                                                             {"us", {1.0, 1e6}},
                                                             {"ns", {1.0, 1e9}},
                                                             {"min", {60.0, 1.0}},
                                                             {"h", {3600.0, 1.0}},
                                                             {"d", {86400.0, 1.0}}};
  for (const auto& [unit, value] : units)
    if (unit == name) return value;
  return std::nullopt;
}

std::optional<double> length_unit_named(std::string_view name) {
  constexpr std::pair<std::string_view, double> units[] = {{"m", 1.0},    {"km", 1e3},    {"cm", 0.01},
                                                           {"mm", 0.001}, {"ft", 0.3048}, {"nmi", 1852.0}};
  for (const auto& [unit, value] : units)
    if (unit == name) return value;
  return std::nullopt;
}

std::optional<ColumnMeaning> meaning_of(std::string_view column_name) {
  const std::string name = lower(column_name);
  if (const auto quantity = quantity_named(name)) return ColumnMeaning{*quantity, ""};
  const std::size_t bracket = name.find_first_of("([/");
  const std::size_t cut = bracket != std::string::npos ? bracket : name.find_last_of("_ ");
  if (cut == std::string::npos) return std::nullopt;
  std::string unit = name.substr(cut + 1);
  std::erase_if(unit, [](char c) { return c == ')' || c == ']' || c == ' '; });
  const auto quantity = quantity_named(std::string_view(name).substr(0, cut));
  if (!quantity || !is_unit_of(*quantity, unit)) return std::nullopt;
  return ColumnMeaning{*quantity, std::move(unit)};
}

}  // namespace kinesphere::program
