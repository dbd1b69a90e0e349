// Parses the names of columns: quantity and unit.
#include "formats/tables/column_names.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/line_text.hpp"

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
     "vesselid shipid sourcemmsi deviceid droneid drone uavid uav robotid playerid entityid icao24 hex "
     "trajectoryid particle particleid tag tagid animalid individuallocalidentifier identity objid targetid "
     "instanceid cellid carid persid personnr bodyid individual individualid individualidentifier subjectid "
     "birdid fishid actorid satid satelliteid noradid noradcatid nodeid userid identifiant taxiid busid "
     "boatid "
     "aircraftid "
     "tracknumber tracknum trackno tracknr"},
    {Quantity::time, "time", Measure::time,
     "t timestamp datetime basedatetime utc timeutc timestamputc datetimeutc unixtime epoch stamp tstamp "
     "headerstamp fixtime utctime date/time date&time epochutc timegmt datetimegmt localtime timestamplocal "
     "zeit uhrzeit zeitstempel temps tiempo msgtime trialtime simt simtime seconds:s secs:s sec:s "
     "milliseconds:ms rxuxtime tst heure hora"},
    {Quantity::frame, "frame", Measure::none,
     "frameid frameno framenr framenumber frameindex frameidx framenum framecount imagenumber fnum fr "
     "timestep"},
    {Quantity::date, "date", Measure::none, "datum utcdate dateutc gpsdate localdate fecha"},
    {Quantity::arrival, "arrival", Measure::time, "received"},
    {Quantity::x, "x", Measure::length,
     "posx xpos positionx xposition posepositionx px centerx xcenter centroidx xcentroid east easting "
     "points0 position0 pos0"},
    {Quantity::y, "y", Measure::length,
     "posy ypos positiony yposition posepositiony py centery ycenter centroidy ycentroid north northing "
     "points1 position1 pos1"},
    {Quantity::z, "z", Measure::length,
     "posz zpos positionz zposition posepositionz pz centerz zcenter centroidz zcentroid points2 position2 "
     "pos2 alt "
     "altitude ele elevation geometrycoordinates2 flightlevel:FL fl:FL"},
    {Quantity::longitude, "lon", Measure::angle,
     "lng long longitude locationlong locationlon gpslon gpslongitude decimallongitude geometrycoordinates0 "
     "positionlong"},
    {Quantity::latitude, "lat", Measure::angle,
     "latitude locationlat gpslat gpslatitude decimallatitude geometrycoordinates1 positionlat"},
    {Quantity::vx, "vx", Measure::speed, "velx velocityx velocity0"},
    {Quantity::vy, "vy", Measure::speed, "vely velocityy velocity1"},
    {Quantity::vz, "vz", Measure::speed, "velz velocityz velocity2"},
    {Quantity::speed, "speed", Measure::speed, "gs:? sog:? speedoverground:?"},
    {Quantity::course, "course", Measure::none, "cog track courseoverground"},
    {Quantity::climb, "climb", Measure::speed, "verticalrate:?"},
    {Quantity::position_error, "position_error", Measure::length, "positionerror"},
    {Quantity::height_error, "height_error", Measure::length, "heighterror"},
    {Quantity::velocity_error, "velocity_error", Measure::speed, "velocityerror"},
    {Quantity::climb_error, "climb_error", Measure::speed, "climberror"},
    {Quantity::stamp_error, "stamp_error", Measure::time, "stamperror"},
    {Quantity::length, "length", Measure::length, "vehiclelength objectlength"},
    {Quantity::width, "width", Measure::length, "vehiclewidth objectwidth"},
    {Quantity::body_height, "body_height", Measure::length, "bodyheight vehicleheight objectheight"},
    {Quantity::heading, "heading", Measure::angle, "yaw psi headingangle yawangle"}};

const QuantityNames& names_of(Quantity quantity) { return quantities[static_cast<std::size_t>(quantity)]; }

/// Calls `visit` with each word, until it returns true; returns whether it did.
template <class Visitor>
bool any_word(std::string_view words, Visitor visit) {
  while (!words.empty())
    if (visit(take_part(words, ' '))) return true;
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

/// What may stand between a name and its unit. R writes "x (m)" as x..m.
constexpr std::string_view between_words = " _-.:,([{/";

/// Returns the text behind `at` as a unit: without brackets, blanks, the word "in" and, of a height, what it
/// is above: "(ft MSL)", "_m_agl", "[ft] above sea level".
std::string_view unit_behind(std::string_view name, std::size_t at) {
  std::string_view unit = name.substr(at);
  while (!unit.empty() && between_words.find(unit.front()) != std::string_view::npos) unit.remove_prefix(1);
  for (std::string_view in : {"in_", "in "})
    if (unit.starts_with(in)) unit.remove_prefix(in.size());
  const std::size_t end = std::min(unit.find_first_of(" _)]}"), unit.size());
  const std::string_view behind = unit.substr(end);
  const std::size_t word = std::min(behind.find_first_not_of(" _)]}("), behind.size());
  if (is_word_of(behind.substr(word, behind.find_first_of(" _)]}", word) - word),
                 "msl amsl asl agl hae above wgs84 ellipsoid ellipsoidal"))
    unit = unit.substr(0, end);
  while (!unit.empty() && std::string_view(" )]}.").find(unit.back()) != std::string_view::npos)
    unit.remove_suffix(1);
  return unit;
}

/// True if a unit may begin at `at`: behind a separator, or at the end of a word in camelCase.
bool may_begin_unit(std::string_view name, std::size_t at) {
  if (between_words.find(name[at]) != std::string_view::npos) return true;
  const auto is_upper = [](char c) { return lower_case(c) != c; };
  return is_upper(name[at]) && !is_upper(name[at - 1]) &&
         between_words.find(name[at - 1]) == std::string_view::npos;
}

/// True if a word of the name, also of camelCase, is one of `words`.
bool has_word(std::string_view name, std::string_view words) {
  std::string separate;
  for (std::size_t at = 0; at < name.size(); ++at) {
    const bool is_upper = lower_case(name[at]) != name[at];
    if (at > 0 && is_upper && lower_case(name[at - 1]) == name[at - 1]) separate += ' ';
    const bool is_between = between_words.find(name[at]) != std::string_view::npos || name[at] == ')';
    separate += is_between ? ' ' : lower_case(name[at]);
  }
  return any_word(separate, [&](std::string_view word) { return is_word_of(word, words); });
}

/// Words of names. *altitud may stand anywhere in a plain name, ~alt is a word of a name, also of camelCase,
/// and others are whole names.
struct HintWords {
  NameHint hint;
  std::string_view words;
};

/// In the order of NameHint.
constexpr HintWords hint_words[] = {
    // The last two parts are Höhe in UTF-8 and in Latin 1.
    {NameHint::height,
     "*altitud *altura *elevation *height *flightlevel *hoehe *hauteur *geoalt *gpsalt *baroalt *relalt "
     "*altgeo *altbaro *h\xC3\xB6he *h\xF6"
     "he "
     "~z ~alt ~alti ~galt ~elev ~h ~hgt ~fl ~afl ~cfl ~msl ~amsl ~agl ~hae ~depth ~tiefe ~up ~down "
     "level lvl floor storey story etage deck quota modec vertical zcoord coordz"},
    {NameHint::longitude, "*longitud *l\xC3\xA4ngengrad *laengengrad ~lon ~lng ~long"},
    {NameHint::latitude, "*latitud *breitengrad ~lat"},
    {NameHint::part_of_time,
     "~nsec ~nsecs ~nanosec ~nanosecs ~nanoseconds ~usec ~usecs ~microsec ~microseconds ~msec ~msecs ~millis "
     "~millisec ~fraction gpsweek gpswk"},
    {NameHint::part_of_clock,
     "seconds secs sec second minutes minute mins min hours hour hrs hr milliseconds"},
    {NameHint::scene,
     "scene scenario case recording session trial video clip match game experiment replicate run "
     "simulation arena camera cam cameraid sensor tank cage well plate period half quarter"},
    {NameHint::id,
     "name label vehicle vessel ship boat car robot player bird fish mouse cell device callsign flight "
     "subject target who imei serial"},
    {NameHint::aircraft, "icao icao24 hex modes squawk callsign flight registration altbaro altgeom"},
    {NameHint::zone,
     "zone utmzone gridzone map mapid building buildingid floorid levelid centername refframe timesystem tz "
     "timezone utcoffset tzoffset timezoneoffset"}};

}  // namespace

std::string plain_name(std::string_view name) {
  std::string plain;
  for (char c : name)
    if (c != ' ' && c != '_' && c != '-' && c != '.' && c != ':') plain += lower_case(c);
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
    if (!meaning || !meaning->unit.empty()) continue;
    if (is_unit_of(measure_of(meaning->quantity), unit))
      return ColumnMeaning{meaning->quantity, std::string(unit)};
    if (meaning->quantity == Quantity::time && (same_name(unit, "utc") || same_name(unit, "gmt")))
      return meaning;
  }
  return std::nullopt;
}

std::optional<ColumnMeaning> meaning_of_ending(std::string_view column_name) {
  for (std::size_t at = 0; at < column_name.size(); ++at) {
    const bool begins_word =
        at == 0 || std::string_view(" _-./:").find(column_name[at - 1]) != std::string_view::npos;
    if (begins_word)
      if (const auto meaning = meaning_of(column_name.substr(at))) return meaning;
  }
  return std::nullopt;
}

namespace {

/// Returns the name in lower case, without its unit, and with _ for brackets: x_1 of "X(1) [cm]".
std::string name_of_axis(std::string_view column_name) {
  for (std::size_t at = 1; at < column_name.size(); ++at) {
    const std::string_view unit = unit_behind(column_name, at);
    if (may_begin_unit(column_name, at) &&
        (is_unit_of(Measure::length, unit) || is_unit_of(Measure::angle, unit)))
      column_name = column_name.substr(0, at);
  }
  std::string name;
  for (const char c : trimmed(column_name)) name += c == '(' || c == '[' || c == '{' ? '_' : lower_case(c);
  while (name.ends_with(')') || name.ends_with(']') || name.ends_with('}')) name.pop_back();
  return name;
}

}  // namespace

AxisAndBody axis_and_body(std::string_view column_name) {
  // The first that fits counts, so that "longitude" stands before "lon", with which it begins.
  constexpr std::pair<std::string_view, Quantity> axes[] = {{"longitude", Quantity::longitude},
                                                            {"long", Quantity::longitude},
                                                            {"lon", Quantity::longitude},
                                                            {"lng", Quantity::longitude},
                                                            {"latitude", Quantity::latitude},
                                                            {"lat", Quantity::latitude},
                                                            {"altitude", Quantity::z},
                                                            {"alt", Quantity::z},
                                                            {"posx", Quantity::x},
                                                            {"posy", Quantity::y},
                                                            {"posz", Quantity::z},
                                                            {"x", Quantity::x},
                                                            {"y", Quantity::y},
                                                            {"z", Quantity::z}};
  const std::string name = name_of_axis(column_name);
  for (const auto& [word, axis] : axes) {
    for (const bool is_first : {true, false}) {
      if (name.size() <= word.size() || !(is_first ? name.starts_with(word) : name.ends_with(word))) continue;
      std::string_view rest =
          std::string_view(name).substr(is_first ? word.size() : 0, name.size() - word.size());
      const bool is_apart =
          std::string_view(" _-./").find(is_first ? rest.front() : rest.back()) != std::string_view::npos;
      if (is_apart) rest = rest.substr(is_first ? 1 : 0, rest.size() - 1);
      const bool is_number = is_first && rest.find_first_not_of("0123456789") == std::string_view::npos;
      if (!rest.empty() && (is_apart || is_number)) return {axis, std::string(rest)};
    }
  }
  return {};
}

std::string_view unit_in_name(std::string_view column_name, Measure measure) {
  for (std::size_t at = 1; at < column_name.size(); ++at) {
    const std::string_view unit = unit_behind(column_name, at);
    if (may_begin_unit(column_name, at) && is_unit_of(measure, unit)) return unit;
  }
  return {};
}

bool hints_at(std::string_view column_name, NameHint hint) {
  // The h of km_h is an hour.
  if (hint == NameHint::height && !unit_in_name(column_name, Measure::speed).empty()) return false;
  std::string plain = plain_name(column_name);
  const bool is_angle = hint == NameHint::longitude || hint == NameHint::latitude;
  if (is_angle && plain.find("wgs84") != plain.npos && plain.find("utm") == plain.npos) return true;
  if (hint == NameHint::scene)
    for (const std::string_view ending : {"id", "no", "number"})
      if (plain.ends_with(ending)) plain.resize(plain.size() - ending.size());
  return any_word(hint_words[static_cast<std::size_t>(hint)].words, [&](std::string_view word) {
    if (word.starts_with('*')) return plain.find(word.substr(1)) != plain.npos;
    return word.starts_with('~') ? has_word(column_name, word.substr(1)) : word == plain;
  });
}

namespace {

/// Returns the name without the first of these endings that it has; empty for others.
std::string without_ending(std::string_view name, std::initializer_list<std::string_view> endings) {
  for (const std::string_view ending : endings)
    if (name.ends_with(ending)) return '.' + std::string(name.substr(0, name.size() - ending.size()));
  return {};
}

}  // namespace

bool is_whole_seconds(std::string_view column_name) {
  const std::string name = plain_name(column_name);
  return (name.ends_with("sec") || name.ends_with("secs")) && !hints_at(column_name, NameHint::part_of_time);
}

bool are_parts_of_time(std::string_view seconds, std::string_view nanoseconds) {
  const std::string of_both = without_ending(plain_name(seconds), {"secs", "sec", "seconds"});
  return !of_both.empty() &&
         of_both ==
             without_ending(plain_name(nanoseconds), {"nanosecs", "nanosec", "nanoseconds", "nsecs", "nsec"});
}

std::string_view void_values_of(std::string_view column_name) {
  std::string plain = plain_name(column_name);
  if (plain.starts_with("is") || plain.starts_with("has")) plain.erase(0, plain[0] == 'i' ? 2 : 3);
  if (plain.ends_with('?')) plain.pop_back();
  if (plain.find("outlier") != plain.npos || is_word_of(plain, "lost missing invalid bad deleted"))
    return "true 1 yes t y";
  if (is_word_of(plain, "visible valid validity detected found tracked present exists inview"))
    return "false 0 no f n";
  if (is_word_of(plain, "fix gpsfix fixtype gpsfixtype")) return "false 0 no none";
  return {};
}

bool is_nobody(std::string_view column_name, std::string_view id) {
  // Whole numbers above 0 are most frequent. The largest of a type are -1 in another.
  if (!id.empty() && id[0] >= '1' && id[0] <= '9')
    return is_word_of(id, "2147483647 4294967295 9223372036854775807 18446744073709551615");
  if (id.starts_with('0'))
    return parse_number(id) == 0.0 && is_word_of(plain_name(column_name), "mmsi icao24 hex");
  if (id.starts_with('-') && parse_number(id)) return true;
  return is_missing(id) ||
         is_word_of(id, "unknown unk undefined unassigned untracked nobody noise no_id noid");
}

}  // namespace kinesphere::program
