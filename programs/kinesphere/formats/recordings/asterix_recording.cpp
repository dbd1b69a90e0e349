// ASTERIX of EUROCONTROL as decoders write it in JSON: reports of CAT021 (ADS-B) and CAT048 (radars), and
// tracks of CAT062.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/tables/json_rows.hpp"

namespace kinesphere::program {
namespace {

using simdjson::dom::element;

/// Where the items of a category are: number/name, with | between those of several decoders and editions, the
/// best first. Numbers are in seconds, degrees, NM (x, y, range), m/s, and feet, or with *100 behind the name
/// in flight levels.
struct CategoryItems {
  int category;
  std::string_view time, address, track;
  std::string_view longitude{}, latitude{}, x{}, y{}, range{}, azimuth{};
  std::string_view barometric{}, geometric{}, vx{}, vy{};
};
constexpr CategoryItems categories[] = {
    {.category = 21,
     .time = "073/time_reception_position|073/Time of Message Reception for Position|"
             "071/time_applicability_position|071/Time of Applicability for Position|"
             "077/time_report_transmission|077/Time of ASTERIX Report Transmission|"
             "077/Time of Report Transmission|030/ToD|030/Time of Day",
     .address = "080/TAddr|080/Target Address",
     .track = "161/TrackN|161/Track Number",
     .longitude = "131/Lon|131/Longitude|130/Lon|130/Longitude",
     .latitude = "131/Lat|131/Latitude|130/Lat|130/Latitude",
     .barometric = "145/FL*100|145/Flight Level*100",
     .geometric = "140/geometric_height|140/Geometric Height"},
    {.category = 48,
     .time = "140/ToD|140/Time of Day",
     .address = "220/ACAddr|220/Aircraft Address",
     .track = "161/Tn|161/Track Number",
     .x = "042/X|042/X-Component",
     .y = "042/Y|042/Y-Component",
     .range = "040/RHO",
     .azimuth = "040/THETA",
     .barometric = "090/FL*100|090/Flight Level*100",
     .geometric = "110/3D_Height|110/3D Height"},
    {.category = 62,
     .time = "070/ToT|070/Time of Track Information",
     .address = "380/ADR/ADR|380/ADR/Target Address",
     .track = "040/TrkN|040/Track Number",
     .longitude = "105/Lon|105/Longitude",
     .latitude = "105/Lat|105/Latitude",
     .barometric = "136/MFL|136/Measured Flight Level*100",
     .geometric = "130/Alt|130/Altitude",
     .vx = "185/Vx",
     .vy = "185/Vy"}};

/// Returns an item of a record, I062/105 as "I105" or "105".
std::optional<element> item_of(element record, std::string_view number) {
  const auto with_letter = member(record, fmt::format("I{}", number));
  return with_letter ? with_letter : member(record, number);
}

/// Returns the text at the first of the places that has one; some decoders have values in an object with
/// their meaning.
std::string value_at(element record, std::string_view places) {
  while (!places.empty()) {
    std::string_view path = take_part(places, '|');
    const bool is_level = path.ends_with("*100");
    if (is_level) path.remove_suffix(4);
    const auto item = item_of(record, take_part(path, '/'));
    std::string text = text_at(item, path);
    if (text.empty()) text = text_at(item, fmt::format("{}/val", path));
    if (const auto level = is_level ? parse_number(text) : std::nullopt)
      return fmt::format("{}", 100.0 * *level);
    if (!text.empty()) return text;
  }
  return {};
}

/// A report of an aircraft, or a track of a system.
struct AsterixReport {
  std::size_t line;
  double time;  ///< seconds since the first midnight
  std::string sensor, address, track, first, second, vx, vy, height;
  bool is_geographic;
};

class AsterixReader {
 public:
  explicit AsterixReader(const RecordingText& recording) : recording_(recording) {}

  RowTable read() {
    for_each_object(recording_.file, recording_.text, [&](element object, std::size_t line) {
      line_ = line;
      walk(object, 0);
    });
    if (reports_.empty())
      throw ProgramError(
          fmt::format("{}: expected records of CAT021, CAT048 or CAT062 with a time, a place and an address "
                      "or track number, but there are none",
                      recording_.file));
    return table();
  }

 private:
  /// Finds the records in an object, under the keys that decoders have around them.
  void walk(element object, int category) {
    for (const char* const key : {"category", "cat"})
      if (const auto number = parse_number(text_at(object, key))) category = static_cast<int>(*number);
    if (item_of(object, "010")) return add(object, category);
    simdjson::dom::object members;
    if (object.get(members)) return;
    for (const auto& [key, value] : members) {
      simdjson::dom::array list;
      const bool is_record = key.size() == 6 && key.starts_with("CAT");
      if (!value.get(list))
        for (const element each : list) walk(each, category);
      else
        walk(value, is_record ? static_cast<int>(parse_number(key.substr(3)).value_or(0.0)) : category);
    }
  }

  void add(element record, int category) {
    const auto* const items = std::ranges::find(categories, category, &CategoryItems::category);
    if (items == std::end(categories)) return;
    const auto value = [&](std::string_view places) { return value_at(record, places); };
    const auto second = parse_number(value(items->time));
    AsterixReport report{
        .line = line_,
        .time = second.value_or(0.0),
        .sensor = fmt::format("cat {} of {}/{}", category, value("010/SAC"), value("010/SIC")),
        .address = address_of(value(items->address)),
        .track = value(items->track),
        .first = value(items->longitude),
        .second = value(items->latitude),
        .vx = value(items->vx),
        .vy = value(items->vy),
        .height = value(recording_.geometric ? items->geometric : items->barometric),
        .is_geographic = !items->longitude.empty()};
    if (!report.is_geographic) set_place_of_radar(*items, record, report);
    if (!second || report.first.empty() || report.second.empty() ||
        (report.address.empty() && report.track.empty())) {
      ++incomplete_;
      return;
    }
    report.time += 86'400.0 * day_of(*second);
    if (!report.address.empty()) addresses_[report.sensor + report.track].insert(report.address);
    reports_.push_back(std::move(report));
  }

  /// Returns the days since the first midnight. A clock that falls by half a day has passed another one; one
  /// that is as much ahead is late, from before it.
  int day_of(double second) {
    constexpr double half_a_day = 43'200.0;
    const double ahead = second - last_second_.value_or(second);
    if (ahead < -half_a_day) ++midnights_;
    const bool is_late = ahead > half_a_day && midnights_ > 0;
    if (!is_late) last_second_ = second;
    return midnights_ - (is_late ? 1 : 0);
  }

  /// Sets x and y, from the radar. Without its own calculation they are those of the slant range.
  void set_place_of_radar(const CategoryItems& items, element record, AsterixReport& report) {
    report.first = value_at(record, items.x);
    report.second = value_at(record, items.y);
    const auto range = parse_number(value_at(record, items.range)),
               azimuth = parse_number(value_at(record, items.azimuth));
    if (!report.second.empty() || !range || !azimuth) return;
    ++slant_;
    const double angle = *azimuth * (3.14159265358979323846 / 180.0);
    report.first = fmt::format("{}", *range * std::sin(angle));
    report.second = fmt::format("{}", *range * std::cos(angle));
  }

  /// Addresses of 24 bits may be written as numbers.
  static std::string address_of(const std::string& text) {
    const auto number = text.size() == 6 ? std::nullopt : parse_number(text);
    return number ? fmt::format("{:06X}", static_cast<std::uint32_t>(*number)) : text;
  }

  /// Reports without an address have the only one of their track, if there is one.
  std::string id_of(const AsterixReport& report) const {
    if (!report.address.empty()) return report.address;
    const auto known = addresses_.find(report.sensor + report.track);
    if (known != addresses_.end() && known->second.size() == 1) return *known->second.begin();
    return fmt::format("track {} ({})", report.track, report.sensor);
  }

  RowTable table() const {
    const bool is_geographic = std::ranges::any_of(reports_, &AsterixReport::is_geographic);
    RowTable table(fmt::format("ASTERIX ({} altitude)", recording_.geometric ? "geometric" : "barometric"),
                   {"id", "time", is_geographic ? "lon" : "x_NM", is_geographic ? "lat" : "y_NM", "sensor",
                    "vx_m/s", "vy_m/s", "alt_ft"});
    const auto warn = [&](std::size_t count, std::string_view what) {
      if (count > 0) table.warnings.push_back(fmt::format("{}: {}: {}", recording_.file, what, count));
    };
    std::size_t plane = 0;
    for (const AsterixReport& report : reports_) {
      plane += report.is_geographic ? 0 : 1;
      if (report.is_geographic != is_geographic) continue;
      table.add_row(report.line, id_of(report), report.time, report.first, report.second, report.sensor,
                    report.vx, report.vy, report.height);
    }
    table.use_heights_of_all(recording_.file);
    table.warnings.push_back(fmt::format("{}: its times are seconds since midnight UTC", recording_.file));
    warn(incomplete_, "records without a time, a place, or an address and track number are left out");
    if (is_geographic) warn(plane, "reports of radars, whose places count from the radar, are left out");
    if (!is_geographic) warn(slant_, "places are by slant ranges, as the radar calculated none");
    return table;
  }

  const RecordingText& recording_;
  std::size_t line_ = 1, incomplete_ = 0, slant_ = 0;
  std::optional<double> last_second_;  ///< of the day
  int midnights_ = 0;
  std::vector<AsterixReport> reports_;
  std::map<std::string, std::set<std::string>> addresses_;  ///< by sensor and track number
};

}  // namespace

bool is_asterix(std::string_view text) {
  const std::string_view begin = text.substr(0, 4096);
  const std::string_view content =
      trimmed(begin.substr(std::min(begin.find_first_not_of("\r\n"), begin.size())));
  return (content.starts_with('{') || content.starts_with('[')) &&
         (begin.find("\"CAT0") != begin.npos || begin.find("\"data_blocks\"") != begin.npos ||
          (begin.find("\"category\"") != begin.npos && begin.find("\"I010\"") != begin.npos));
}

RowTable read_asterix(const RecordingText& recording) { return AsterixReader(recording).read(); }

}  // namespace kinesphere::program
