// Reads the rows of text files as samples.
#include "tracks/raw_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <utility>

#include "formats/converted_table.hpp"
#include "formats/row_reader.hpp"
#include "formats/text_table.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

bool is_date(TimeKind kind) { return kind == TimeKind::date || kind == TimeKind::utc; }

}  // namespace

/// Reads the rows of one file.
class RawRecording::FileReader {
 public:
  FileReader(RawRecording& recording, const TextTable& table, TableColumns columns)
      : recording_(recording), table_(table), reader_(table.head(), std::move(columns)) {
    const auto& names = table.head().names;
    for (const std::size_t place : reader_.columns().unused)
      if (place < names.size() && is_scene(names[place]) && !reader_.filter().mentions(place))
        scene_columns_.push_back(place);
  }

  const TableColumns& columns() const { return reader_.columns(); }

  void read(const TableRow& row) try {
    const Place place{static_cast<std::uint32_t>(recording_.files_.size() - 1), row.line};
    if (reader_.leaves_out(row.fields)) return recording_.count(recording_.filtered_, place);
    reader_.set_row(row.fields);
    for (std::size_t body = 0; body < reader_.bodies(); ++body) {
      reader_.set_body(body);
      add_sample(place, row);
    }
  } catch (const WrongInput& error) {
    throw ProgramError(fmt::format("{}:{}: {}", table_.file(), row.line, error.what()));
  } catch (const OpenQuestion& question) {
    const std::string line = question.is_about_row() ? fmt::format(":{}", row.line) : "";
    throw ProgramError(fmt::format("{}{}: {}", table_.file(), line, question.what()));
  }

 private:
  void add_sample(const Place& place, const TableRow& row) {
    RawTrack& track = track_named(reader_.id());
    const auto time = reader_.time();
    if (time) agree_on(time->kind, place);
    const auto position = reader_.position();
    if (time && position && (reader_.has_height() || !columns().z())) {
      track.samples.push_back({time->time, *position, place});
      track.radius = std::max(track.radius, radius());
      for (const std::size_t column : scene_columns_)
        recording_.scenes_.add(table_.head().names[column], row.fields[column], time->time);
      return;
    }
    const auto& missing = *reader_.missing();
    if (recording_.options_.missing == MissingPolicy::fail)
      throw WrongInput(reader_.wrong_text(missing.column, fmt::format("a number as {}", missing.what)) +
                       " (see --missing)");
    recording_.count(recording_.missing_, place);
    if (time && recording_.options_.missing == MissingPolicy::split) track.breaks.push_back(time->time);
  }

  /// Returns half the diagonal of length and width; 0 if one of them is not known, which is also said by 0.
  double radius() {
    const auto length = reader_.number(Quantity::length), width = reader_.number(Quantity::width);
    if (!length || !width || !(*length > 0.0) || !(*width > 0.0)) return 0.0;
    return std::hypot(*length * columns()[Quantity::length]->unit,
                      *width * columns()[Quantity::width]->unit) /
           2;
  }

  /// Checks that all times are of one kind.
  void agree_on(TimeKind kind, const Place& place) {
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
    throw WrongInput(reader_.wrong_text(columns()[Quantity::time]->place, name(*known)) +
                     fmt::format(", unlike {}", recording_.name(recording_.first_time_)));
  }

  RawTrack& track_named(std::string_view id) const {
    const auto [place, is_new] = recording_.track_of_.emplace(id, recording_.tracks_.size());
    if (is_new) recording_.tracks_.push_back({place->first, {}, 0.0, {}});
    return recording_.tracks_[place->second];
  }

  RawRecording& recording_;
  const TextTable& table_;
  RowReader reader_;
  std::vector<std::size_t> scene_columns_;
};

void RawRecording::read(std::string text, const std::string& file) {
  auto converted = convert_to_table(text, file);
  if (converted) {
    text = std::move(converted->text);
    warnings_.insert(warnings_.end(), converted->warnings.begin(), converted->warnings.end());
  }
  TextTable table(std::move(text), file);
  files_.push_back(file);
  TableColumns columns = find_columns(table.head(), options_.hints, ColumnUse::positions);
  if (converted) columns.format = converted->format;
  FileReader reader(*this, table, std::move(columns));
  const bool is_first = files_.size() == 1;
  if (is_first) head_ = table.head();
  if (!is_first) agree_on_positions(reader.columns(), file);
  for (TableRow row; table.next(row); ++rows_) reader.read(row);
  // The unit of times may turn out with the first row.
  if (is_first) columns_ = reader.columns();
  agree_on_times(reader.columns(), file);
}

void RawRecording::agree(bool is_same, std::string_view what, const std::string& file) const {
  if (!is_same) throw ProgramError(fmt::format("{}: expected {} as in {}", file, what, files_.front()));
}

void RawRecording::agree_on_positions(const TableColumns& columns, const std::string& file) const {
  const auto is_same_unit = [](const Column& a, const Column& b) {
    return a.unit == b.unit && a.has_unit == b.has_unit;
  };
  agree(columns.geographic == columns_.geographic, "positions of the same kind", file);
  agree(columns.z().has_value() == columns_.z().has_value(), "the same number of dimensions", file);
  agree(is_same_unit(columns.x(), columns_.x()) && is_same_unit(columns.y(), columns_.y()) &&
            (!columns.z() || is_same_unit(*columns.z(), *columns_.z())),
        "lengths of the same unit", file);
}

void RawRecording::agree_on_times(const TableColumns& columns, const std::string& file) const {
  agree(columns.time_kind == columns_.time_kind && columns.time_unit.seconds == columns_.time_unit.seconds &&
            columns.time_unit.rate == columns_.time_unit.rate && columns.film == columns_.film,
        "times of the same unit", file);
}

TimeScale RawRecording::time_scale() const {
  if (time_kind_ && is_date(*time_kind_)) return TimeScale(*time_kind_);
  double rate = columns_.time_unit.rate;
  if (columns_.film != TableColumns::Film::none) {
    std::int64_t step = 0;
    std::optional<std::int64_t> before;
    for (const RawTrack& track : tracks_) {
      for (const RawSample& sample : track.samples) {
        if (before) step = std::gcd(step, sample.time.whole - *before);
        before = sample.time.whole;
      }
    }
    const bool ucy = columns_.film == TableColumns::Film::ucy;
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
