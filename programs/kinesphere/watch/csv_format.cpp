// Tables with a report in each line: with a map of columns, or AIS as marinecadastre.gov publishes it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ascii_text.hpp"
#include "number_text.hpp"
#include "program_error.hpp"
#include "tracks/column_names.hpp"
#include "watch/json_reading.hpp"
#include "watch/line_fields.hpp"
#include "watch/measures.hpp"
#include "watch/report_format.hpp"

namespace kinesphere::program {
namespace {

enum class CsvKey {
  id,
  time,
  arrival,
  x,
  y,
  z,
  lat,
  lon,
  alt,
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
};
constexpr std::size_t csv_key_count = static_cast<std::size_t>(CsvKey::stamp_error) + 1;

enum class CsvUnit { none, time, length, speed };

struct CsvKeyName {
  std::string_view name;
  CsvUnit unit = CsvUnit::none;
  std::array<std::string_view, 4> others{};  ///< other names in headers, in lower case letters and digits
};

/// Names of the keys, in the order of CsvKey.
constexpr std::array<CsvKeyName, csv_key_count> csv_keys{{{"id", CsvUnit::none, {"hex", "track_id"}},
                                                          {"time", CsvUnit::time, {"stamp"}},
                                                          {"arrival", CsvUnit::time, {"received"}},
                                                          {"x", CsvUnit::length, {}},
                                                          {"y", CsvUnit::length, {}},
                                                          {"z", CsvUnit::length, {}},
                                                          {"lat", CsvUnit::none, {}},
                                                          {"lon", CsvUnit::none, {}},
                                                          {"alt", CsvUnit::length, {}},
                                                          {"vx", CsvUnit::speed, {}},
                                                          {"vy", CsvUnit::speed, {}},
                                                          {"vz", CsvUnit::speed, {}},
                                                          {"speed", CsvUnit::speed, {"gs", "sog"}},
                                                          {"course", CsvUnit::none, {"cog", "track"}},
                                                          {"climb", CsvUnit::speed, {"vertical_rate"}},
                                                          {"position_error", CsvUnit::length, {}},
                                                          {"height_error", CsvUnit::length, {}},
                                                          {"velocity_error", CsvUnit::speed, {}},
                                                          {"climb_error", CsvUnit::speed, {}},
                                                          {"stamp_error", CsvUnit::time, {}}}};

/// The place of a quantity, and the size of its unit.
struct CsvColumn {
  std::size_t place = 0;
  double unit = 1.0;
};

using CsvColumns = std::array<std::optional<CsvColumn>, csv_key_count>;

std::optional<CsvColumn>& column_for(CsvColumns& columns, CsvKey key) {
  return columns[static_cast<std::size_t>(key)];
}

std::string csv_key_list() {
  std::string list;
  for (const CsvKeyName& key : csv_keys) list += (list.empty() ? "" : ", ") + std::string(key.name);
  return list;
}

double csv_unit(CsvUnit unit, std::string_view name, std::string_view entry) {
  constexpr std::array measures{Measure::time, Measure::time, Measure::length, Measure::speed};
  const double size =
      unit == CsvUnit::none ? 0.0 : unit_named(name, measures[static_cast<std::size_t>(unit)]);
  if (size > 0.0) return size;
  throw ProgramError(fmt::format("--columns: expected a unit behind the colon, but got '{}'", entry));
}

/// Returns a column by its name in the header or its number from 1.
std::size_t place_of(std::string_view name, const std::vector<std::string_view>& header, std::size_t columns,
                     std::string_view entry) {
  for (const bool exact : {true, false})
    for (std::size_t place = 0; place < header.size(); ++place)
      if (exact ? header[place] == name : same_name(header[place], name)) return place;
  const double number = parse_number(name).value_or(0.0);
  for (std::size_t place = 0; place < columns; ++place)
    if (number == static_cast<double>(place + 1)) return place;
  throw ProgramError(
      fmt::format("--columns: expected a column's name or number from 1 to {} in '{}', but the stream has {}",
                  columns, entry, header.empty() ? "no header" : "no such column"));
}

/// Parses id=NAME[:UNIT],...
CsvColumns columns_said(const std::string& said, const std::vector<std::string_view>& header,
                        std::size_t count) {
  CsvColumns columns;
  for (std::string_view rest = said; !rest.empty();) {
    const std::string_view entry = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(entry.size() + 1, rest.size()));
    const std::size_t equals = entry.find('=');
    const auto key = std::find_if(csv_keys.begin(), csv_keys.end(), [&](const CsvKeyName& each) {
      return each.name == entry.substr(0, equals);
    });
    if (equals == std::string_view::npos || key == csv_keys.end())
      throw ProgramError(fmt::format("--columns: expected KEY=COLUMN with one of the keys {}, but got '{}'",
                                     csv_key_list(), entry));
    auto& column = columns[static_cast<std::size_t>(key - csv_keys.begin())];
    if (column) throw ProgramError(fmt::format("--columns: expected '{}' once", key->name));
    std::string_view name = entry.substr(equals + 1);
    column.emplace();
    const bool is_whole_name =
        std::any_of(header.begin(), header.end(), [&](auto each) { return same_name(each, name); });
    if (const std::size_t colon = name.rfind(':'); colon != std::string_view::npos && !is_whole_name) {
      column->unit = csv_unit(key->unit, name.substr(colon + 1), entry);
      name = name.substr(0, colon);
    }
    column->place = place_of(name, header, count, entry);
  }
  return columns;
}

/// Returns the columns with the usual names, as `kinesphere tracks` knows them, or with the keys of
/// --columns.
CsvColumns usual_columns(const std::vector<std::string_view>& header) {
  CsvColumns columns;
  const auto set = [&](CsvKey key, std::size_t place, double unit) {
    auto& column = column_for(columns, key);
    if (column && column->place != place)
      throw ProgramError(fmt::format("columns '{}' and '{}' may both be meant: say which with --columns",
                                     header[column->place], header[place]));
    column = CsvColumn{place, unit};
  };
  for (std::size_t place = 0; place < header.size(); ++place) {
    bool is_key = false;
    for (std::size_t key = 0; key < csv_key_count && !is_key; ++key) {
      is_key = same_name(csv_keys[key].name, header[place]) ||
               std::any_of(
                   csv_keys[key].others.begin(), csv_keys[key].others.end(),
                   [&](std::string_view other) { return !other.empty() && same_name(other, header[place]); });
      if (is_key) set(static_cast<CsvKey>(key), place, 1.0);
    }
    const auto meaning = is_key ? std::nullopt : meaning_of(header[place]);
    if (!meaning) continue;
    const double length = length_unit_named(meaning->unit).value_or(1.0);
    switch (meaning->quantity) {
      case Quantity::id:
        set(CsvKey::id, place, 1.0);
        break;
      case Quantity::time: {
        const TimeUnit unit = time_unit_named(meaning->unit).value_or(TimeUnit{});
        set(CsvKey::time, place, unit.seconds / unit.rate);
        break;
      }
      case Quantity::frame:
        break;
      case Quantity::x:
        set(CsvKey::x, place, length);
        break;
      case Quantity::y:
        set(CsvKey::y, place, length);
        break;
      case Quantity::z:
        set(CsvKey::z, place, length);
        break;
      case Quantity::longitude:
        set(CsvKey::lon, place, 1.0);
        break;
      case Quantity::latitude:
        set(CsvKey::lat, place, 1.0);
        break;
    }
  }
  // A height may be called z or alt.
  auto &z = column_for(columns, CsvKey::z), &alt = column_for(columns, CsvKey::alt);
  if (column_for(columns, CsvKey::lat) && !alt) std::swap(z, alt);
  if (column_for(columns, CsvKey::x) && !z) std::swap(z, alt);
  return columns;
}

/// Returns the columns MMSI, BaseDateTime, LAT, LON, SOG and COG, or since 2025 mmsi, base_date_time,
/// latitude, longitude, sog and cog.
CsvColumns ais_columns(const std::vector<std::string_view>& header) {
  CsvColumns columns;
  const auto set = [&](CsvKey key, std::initializer_list<std::string_view> names, double unit, bool needed) {
    for (const std::string_view name : names)
      for (std::size_t place = 0; place < header.size(); ++place)
        if (same_name(header[place], name)) {
          column_for(columns, key) = CsvColumn{place, unit};
          return;
        }
    if (needed)
      throw ProgramError(
          fmt::format("--format ais: expected a column {}, but the stream has none", *names.begin()));
  };
  set(CsvKey::id, {"MMSI"}, 1.0, true);
  set(CsvKey::time, {"BaseDateTime", "base_date_time"}, 1.0, true);
  set(CsvKey::lat, {"LAT", "latitude"}, 1.0, true);
  set(CsvKey::lon, {"LON", "longitude"}, 1.0, true);
  set(CsvKey::speed, {"SOG"}, knot, false);
  set(CsvKey::course, {"COG"}, 1.0, false);
  return columns;
}

class CsvFormat final : public ReportFormat {
 public:
  CsvFormat(FormatChoices choices, bool is_ais) : choices_(std::move(choices)), is_ais_(is_ais) {}

  void read(const Record& record, ReportSink& sink) override {
    if (!record.is_whole) throw MalformedRecord("expected a line, but it is too long");
    std::string_view text = record.text;
    if (record.line == 1 && text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (text.find_first_not_of(" \t\r") == std::string_view::npos || text.starts_with('#')) return;
    if (first_line_.empty()) {
      separator_ = field_separator_of(text);
      split(text);
      first_line_ = text;
      if (begin()) return;
    } else {
      split(text);
    }
    // A file that is appended to another repeats the header.
    if (fields_ == header_) return;
    if (fields_.size() < columns_needed_)
      throw MalformedRecord(
          fmt::format("expected {} columns or more, but got {}", columns_needed_, fields_.size()));
    hand_over(sink);
  }

  nlohmann::json save() const override { return first_line_; }
  void restore(const nlohmann::json& state) override {
    first_line_ = state.get<std::string>();
    if (first_line_.empty()) return;
    separator_ = field_separator_of(first_line_);
    split(first_line_);
    begin();
  }

 private:
  void split(std::string_view line) {
    if (!split_fields(line, separator_, fields_)) throw MalformedRecord("expected a quote that ends a field");
  }

  /// Returns true if the first line is a header.
  bool begin() {
    const bool has_header = std::none_of(fields_.begin(), fields_.end(), [](std::string_view field) {
      return parse_number(field).has_value();
    });
    if (has_header) {
      header_text_.assign(fields_.begin(), fields_.end());
      header_.assign(header_text_.begin(), header_text_.end());
    }
    columns_ = is_ais_                    ? ais_columns(header_)
               : choices_.columns.empty() ? usual_columns(header_)
                                          : columns_said(choices_.columns, header_, fields_.size());
    const auto has = [this](CsvKey key) { return column(key).has_value(); };
    const bool plane = has(CsvKey::x) && has(CsvKey::y), earth = has(CsvKey::lat) && has(CsvKey::lon);
    if (!has(CsvKey::id) || !has(CsvKey::time) || plane == earth)
      throw ProgramError(
          "--columns: expected columns for id, time, and either x and y or lat and lon, by their usual names "
          "or "
          "as id=...,time=...,x=...,y=...");
    if (has(CsvKey::vx) != has(CsvKey::vy) || has(CsvKey::speed) != has(CsvKey::course) ||
        (has(CsvKey::vx) && has(CsvKey::speed)))
      throw ProgramError("--columns: expected either vx and vy or speed and course, or neither");
    is_geographic_ = earth;
    for (const auto& each : columns_)
      if (each) columns_needed_ = std::max(columns_needed_, each->place + 1);
    return has_header;
  }

  const std::optional<CsvColumn>& column(CsvKey key) const { return columns_[static_cast<std::size_t>(key)]; }

  /// Returns nothing if there is no such column or its field is empty.
  std::optional<double> number_at(CsvKey key) const {
    const auto& from = column(key);
    if (!from || fields_[from->place].empty()) return std::nullopt;
    const std::string_view field = fields_[from->place];
    if (const auto number = parse_number(field)) return *number * from->unit;
    throw MalformedRecord(fmt::format("expected a number as {} (column {}), but got '{}'",
                                      csv_keys[static_cast<std::size_t>(key)].name, from->place + 1,
                                      field.substr(0, 40)));
  }
  TimeField time_at(CsvKey key) const {
    const CsvColumn& from = *column(key);
    const std::string_view field = fields_[from.place];
    auto time = time_field(field);
    if (!time)
      throw MalformedRecord(
          fmt::format("expected a time (column {}), but got '{}'", from.place + 1, field.substr(0, 40)));
    if (from.unit != 1.0 && time->kind == TimeKind::number)
      time->time = time_of((static_cast<double>(time->time.whole) + time->time.fraction) * from.unit);
    return *time;
  }
  std::optional<DeclaredError> error_at(CsvKey key, std::string_view declaration) const {
    const auto error = number_at(key);
    if (!error) return std::nullopt;
    if (*error < 0.0)
      throw MalformedRecord(
          fmt::format("expected an error >= 0 (column {}), but got {}", column(key)->place + 1, *error));
    return DeclaredError{*error, declaration};
  }

  void hand_over(ReportSink& sink) {
    SourceReport report{.id = fields_[column(CsvKey::id)->place]};
    if (report.id.empty())
      throw MalformedRecord(fmt::format("expected an id (column {})", column(CsvKey::id)->place + 1));
    const TimeField time = time_at(CsvKey::time);
    report.stamp = time.time;
    report.time_kind = time.kind;
    if (column(CsvKey::arrival) && !fields_[column(CsvKey::arrival)->place].empty())
      report.arrival = time_at(CsvKey::arrival).time;
    report.geographic = is_geographic_;
    const auto x = number_at(is_geographic_ ? CsvKey::lon : CsvKey::x);
    const auto y = number_at(is_geographic_ ? CsvKey::lat : CsvKey::y);
    const auto z = number_at(is_geographic_ ? CsvKey::alt : CsvKey::z);
    if (!x || !y || (is_ais_ && (*x == 181.0 || *y == 91.0))) return sink.pass_over(Passed::no_position);
    if (is_geographic_ && !is_place(*x, *y))
      throw MalformedRecord(fmt::format("expected a latitude and a longitude, but got {} and {}", *y, *x));
    report.position = {*x, *y, z.value_or(0.0)};
    report.has_height = z.has_value();
    read_velocity(report);
    constexpr std::string_view said = "said by the stream";
    report.position_error = error_at(CsvKey::position_error, said);
    report.height_error = error_at(CsvKey::height_error, said);
    report.velocity_error = error_at(CsvKey::velocity_error, said);
    report.climb_error = error_at(CsvKey::climb_error, said);
    report.stamp_error = number_at(CsvKey::stamp_error);
    sink.take(report);
  }

  void read_velocity(SourceReport& report) const {
    auto speed = number_at(CsvKey::speed), course = number_at(CsvKey::course);
    // AIS has these values for an unknown speed or course.
    if (is_ais_ && ((speed && *speed >= 102.25 * knot) || (course && *course >= 360.0))) speed.reset();
    const auto vz = number_at(CsvKey::vz), climb = number_at(CsvKey::climb);
    const auto upward = vz ? vz : climb;
    report.has_climb = upward.has_value();
    if (speed && course) {
      report.velocity = going(*speed, *course, upward.value_or(0.0));
    } else if (const auto vx = number_at(CsvKey::vx), vy = number_at(CsvKey::vy); vx && vy) {
      report.velocity = Vec3{*vx, *vy, upward.value_or(0.0)};
    }
  }

  FormatChoices choices_;
  bool is_ais_;
  /// The first line after blank ones and comments; empty before it has been read.
  std::string first_line_;
  bool is_geographic_ = false;
  char separator_ = ',';
  CsvColumns columns_;
  std::size_t columns_needed_ = 0;
  std::vector<std::string> header_text_;
  std::vector<std::string_view> header_;
  std::vector<std::string_view> fields_;
};

}  // namespace

std::unique_ptr<ReportFormat> make_csv_format(const FormatChoices& choices) {
  return std::make_unique<CsvFormat>(choices, false);
}

std::unique_ptr<ReportFormat> make_ais_format(const FormatChoices& choices) {
  return std::make_unique<CsvFormat>(choices, true);
}

}  // namespace kinesphere::program
