// Reads the rows of text files as samples.
#include "tracks/raw_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <utility>

#include "ascii_text.hpp"
#include "number_text.hpp"
#include "program_error.hpp"
#include "tracks/text_table.hpp"

namespace kinesphere::program {
namespace {

bool is_missing(std::string_view field) {
  constexpr std::string_view names[] = {"", "nan", "-nan", "na", "n/a", "null", "none"};
  return std::any_of(std::begin(names), std::end(names),
                     [field](std::string_view name) { return same_name(field, name); });
}

/// Returns the field on one line and shortened, for errors.
std::string shown(std::string_view field) {
  std::string text(field.substr(0, 60));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return field.size() > 60 ? text + "..." : text;
}

std::string whole_id(std::string_view field) {
  const auto number = field.find('.') != std::string_view::npos ? parse_number(field) : std::nullopt;
  const bool whole = number && std::floor(*number) == *number && std::abs(*number) < 1e15;
  return whole ? fmt::format("{}", static_cast<long long>(*number)) : std::string(field);
}

bool is_date(TimeKind kind) { return kind == TimeKind::date || kind == TimeKind::utc; }

/// Larger numbers are not Unix times in seconds.
constexpr std::int64_t last_likely_second = 100'000'000'000;

}  // namespace

/// Reads the rows of one file.
class RawRecording::FileReader {
 public:
  FileReader(RawRecording& recording, const TextTable& table, const TrackColumns& columns)
      : recording_(recording), table_(table), columns_(columns) {}

  void read(const TableRow& row) {
    const Place place{static_cast<std::uint32_t>(recording_.files_.size() - 1), row.line};
    const std::string_view id = row.fields[columns_.id];
    if (id.empty()) fail(row, columns_.id, "an id", "");
    const std::string_view time_field = row.fields[columns_.time];
    const bool has_time = !is_missing(time_field);
    std::optional<FileTime> time;
    if (has_time) time = time_in(row, place);
    const auto position = position_in(row);
    RawTrack& track = track_named(whole_id(id));
    if (time && position) {
      track.samples.push_back({*time, *position, place});
      return;
    }
    recording_.count(recording_.missing_, place);
    if (time && recording_.options_.missing == MissingPolicy::split) track.breaks.push_back(*time);
  }

 private:
  [[noreturn]] void fail(const TableRow& row, std::size_t column, std::string_view expected,
                         std::string_view advice) const {
    const std::string_view field = row.fields[column];
    throw ProgramError(fmt::format("{}:{}: expected {} (column {}), but got {}{}", table_.file(), row.line,
                                   expected, column + 1,
                                   field.empty() ? "nothing" : fmt::format("'{}'", shown(field)), advice));
  }

  void allow_missing(const TableRow& row, std::size_t column, std::string_view what) const {
    if (recording_.options_.missing != MissingPolicy::fail) return;
    fail(row, column, fmt::format("a number as {}", what), " (see --missing)");
  }

  FileTime time_in(const TableRow& row, const Place& place) {
    const std::string_view field = row.fields[columns_.time];
    TimeKind kind = columns_.time_kind;
    std::optional<FileTime> time = parse_decimal_time(field);
    if (const auto date = parse_date_time(field)) {
      // YYYYMMDD alone is a number; a date has a time of day.
      time = date->time;
      kind = date->has_offset ? TimeKind::utc : TimeKind::date;
    }
    if (!time) {
      const bool dates = recording_.time_kind_ && is_date(*recording_.time_kind_);
      fail(row, columns_.time, dates ? "a date such as 2024-01-31T12:30:00Z as time" : "a number as time",
           field.find_first_of("-/:") != std::string_view::npos && !dates
               ? " (dates are read as in 2024-01-31T12:30:00Z)"
               : "");
    }
    agree_on(kind, row, place);
    if (!is_date(kind)) check_number(*time, row);
    return *time;
  }

  /// Checks that all times are of one kind.
  void agree_on(TimeKind kind, const TableRow& row, const Place& place) {
    auto& known = recording_.time_kind_;
    if (!known) {
      known = kind;
      recording_.first_time_ = place;
    }
    if (*known == kind) return;
    constexpr auto name = [](TimeKind each) -> std::string_view {
      switch (each) {
        case TimeKind::date:
          return "a date without a zone as time";
        case TimeKind::utc:
          return "a date with a zone as time";
        default:
          return "a number as time";
      }
    };
    fail(row, columns_.time, name(*known),
         fmt::format(", unlike {}", recording_.name(recording_.first_time_)));
  }

  void check_number(const FileTime& time, const TableRow& row) const {
    if (!columns_.time_problem.empty())
      throw ProgramError(fmt::format("{}: {}", table_.file(), columns_.time_problem));
    if (!columns_.time_unit_said && std::abs(time.whole) > last_likely_second) {
      fail(row, columns_.time, "seconds as time",
           ": say --time-unit ms, us or ns, or s if these are seconds");
    }
  }

  std::optional<double> number_in(const TableRow& row, std::size_t column, std::string_view what) const {
    const std::string_view field = row.fields[column];
    if (const auto number = parse_number(field)) return number;
    if (!is_missing(field)) fail(row, column, fmt::format("a number as {}", what), "");
    allow_missing(row, column, what);
    return std::nullopt;
  }

  std::optional<Vec3> position_in(const TableRow& row) const {
    if (is_missing(row.fields[columns_.time])) allow_missing(row, columns_.time, "time");
    const bool geographic = columns_.geographic;
    const auto x = number_in(row, columns_.x, geographic ? "longitude" : "x");
    const auto y = number_in(row, columns_.y, geographic ? "latitude" : "y");
    const auto z = columns_.z ? number_in(row, *columns_.z, "z") : std::optional(0.0);
    if (!x || !y || !z) return std::nullopt;
    if (!geographic) return Vec3{*x, *y, *z};
    if (*x == 181.0 || *y == 91.0) {
      allow_missing(row, *x == 181.0 ? columns_.x : columns_.y, *x == 181.0 ? "longitude" : "latitude");
      return std::nullopt;
    }
    if (std::abs(*x) > 360.0) fail(row, columns_.x, "a longitude from -360 to 360 degrees", "");
    if (std::abs(*y) > 90.0) fail(row, columns_.y, "a latitude from -90 to 90 degrees", "");
    return Vec3{*x, *y, *z * columns_.length_unit.value_or(1.0)};
  }

  RawTrack& track_named(std::string id) const {
    const auto [place, is_new] = recording_.track_of_.emplace(std::move(id), recording_.tracks_.size());
    if (is_new) recording_.tracks_.push_back({place->first, {}, {}});
    return recording_.tracks_[place->second];
  }

  RawRecording& recording_;
  const TextTable& table_;
  const TrackColumns& columns_;
};

void RawRecording::read(std::string text, const std::string& file) {
  TextTable table(std::move(text), file);
  const TrackColumns columns = find_columns(table, options_.hints);
  if (files_.empty()) columns_ = columns;
  agree(columns, file);
  files_.push_back(file);
  FileReader reader(*this, table, columns);
  for (TableRow row; table.next(row); ++rows_) reader.read(row);
}

/// Checks that all files have the units and time kind of the first.
void RawRecording::agree(const TrackColumns& columns, const std::string& file) {
  const auto require_same = [&](bool same, std::string_view what) {
    if (!same) throw ProgramError(fmt::format("{}: expected {} as in {}", file, what, files_.front()));
  };
  require_same(columns.time_kind == columns_.time_kind &&
                   columns.time_unit.seconds == columns_.time_unit.seconds &&
                   columns.time_unit.rate == columns_.time_unit.rate && columns.film == columns_.film,
               "times of the same unit");
  require_same(columns.geographic == columns_.geographic, "positions of the same kind");
  require_same(columns.length_unit == columns_.length_unit, "lengths of the same unit");
  require_same(columns.z.has_value() == columns_.z.has_value(), "the same number of dimensions");
}

TimeScale RawRecording::time_scale() const {
  if (time_kind_ && is_date(*time_kind_)) return TimeScale(*time_kind_);
  double rate = columns_.time_unit.rate;
  if (columns_.film != TrackColumns::Film::none) {
    std::int64_t step = 0;
    std::optional<std::int64_t> before;
    for (const RawTrack& track : tracks_) {
      for (const RawSample& sample : track.samples) {
        if (before) step = std::gcd(step, sample.time.whole - *before);
        before = sample.time.whole;
      }
    }
    const bool ucy = columns_.film == TrackColumns::Film::ucy;
    const bool tenth = step % 10 == 0;
    const bool sixth = step % 6 == 0;
    if (ucy ? !tenth : tenth == sixth && step != 0) {
      throw ProgramError(
          fmt::format("{}: expected {} with --format {}, but got frame numbers {} apart: say --frame-rate",
                      files_.front(), ucy ? "every tenth frame" : "every sixth or every tenth frame",
                      ucy ? "ucy" : "eth", step));
    }
    rate = tenth ? 25.0 : 15.0;
  }
  return TimeScale(columns_.time_kind, columns_.time_unit.seconds, rate);
}

std::string RawRecording::name(const Place& place) const {
  return fmt::format("{}:{}", files_[place.file], place.line);
}

void RawRecording::count(Tally& tally, const Place& place) const {
  constexpr std::size_t shown_places = 3;
  if (tally.count++ >= shown_places) return;
  tally.first_places.push_back(!several_files_ ? fmt::format("line {}", place.line) : name(place));
}

}  // namespace kinesphere::program
