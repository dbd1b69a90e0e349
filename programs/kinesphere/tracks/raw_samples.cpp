// Reads the rows of text files as samples.
#include "tracks/raw_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/units.hpp"
#include "formats/recordings/file_kind.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/tables/row_reader.hpp"
#include "formats/tables/table_head.hpp"
#include "tracks/midnights.hpp"

namespace kinesphere::program {
namespace {

/// Height of a sample without one, until all samples have come.
constexpr double missing_height = std::numeric_limits<double>::quiet_NaN();

bool is_date(TimeKind kind) { return kind == TimeKind::date || kind == TimeKind::utc; }

/// Returns the columns that a table of these messages would have.
TableColumns columns_of_messages(StreamFormat format, bool geographic, bool has_heights) {
  TableColumns columns;
  columns.format = name_of(format);
  columns.geographic = columns.in_metres = geographic;
  columns.positions_said = columns.time_unit_said = true;
  const Column said{.has_unit = true};
  columns[geographic ? Quantity::longitude : Quantity::x] = said;
  columns[geographic ? Quantity::latitude : Quantity::y] = said;
  if (has_heights) columns[Quantity::z] = said;
  return columns;
}

}  // namespace

/// Takes the reports of one file.
class RawTrackSet::FileReader final : public ReportSink {
 public:
  FileReader(RawTrackSet& track_set, StreamFormat format, const FormatChoices& choices)
      : track_set_(track_set), format_(format), reader_(make_format(format, choices)) {}

  void read(std::string_view text) {
    if (records_of(format_) == RecordCutter::Kind::whole)
      read({.text = text, .line = 1});
    else
      read_records(text);
    guarded([&] { reader_->finish(*this); });
    if (is_table(format_)) {
      if (reader_->rows()->columns().times_are_clocks) track_set_.pass_clocks_through_midnights();
      note_orders();
      note_ids();
      settle_heights(reader_->rows()->columns().z());
      if (reader_->rows()->columns().id_is_file) track_set_.add_file_id(reader_->rows()->file_id());
      return track_set_.add_columns(reader_->rows()->columns(), file());
    }
    settle_heights(Column{});
    track_set_.add_columns(columns_of_messages(format_, geographic_.value_or(false), has_heights_), file());
    if (malformed_ > 0)
      track_set_.counts_.warnings.push_back(fmt::format("{}:{} (so many damaged messages are left out: {})",
                                                        file(), first_malformed_, malformed_));
  }
  /// Null for messages.
  const RowReader* rows() const { return reader_->rows(); }

 private:
  void take(const SourceReport& report) override {
    const bool is_on_ground = report.on_ground && !report.has_height;
    if (report.may_have_height && !report.has_height && !is_on_ground) return take_incomplete(report);
    count_row();
    RawTrack* const found = track_of(report);
    if (found == nullptr) return track_set_.count(track_set_.counts_.ignored, place_);
    RawTrack& track = *found;
    const TimeField time = report.written.time.value_or(TimeField{report.stamp, report.time_kind});
    agree_on(time.kind, report.row);
    Vec3 position = report.row != nullptr ? report.written.position : report.position;
    if (report.row == nullptr) {
      agree_on_places(report);
      if (is_repeated(track, report)) return track_set_.count(track_set_.counts_.repeated, place_);
      if (!report.has_height) position.z = missing_height;
      has_heights_ = has_heights_ || report.has_height;
    } else {
      if (is_on_ground) position.z = missing_height;
      has_heights_ = has_heights_ || report.may_have_height;
      track.radius = std::max(track.radius, report.extent);
      track.length = std::max(track.length, report.written.length);
      track.width = std::max(track.width, report.written.width);
      track.height = std::max(track.height, report.written.height);
      add_scenes(*report.row, time.time);
    }
    track.samples.push_back({time.time, position, place_, is_on_ground, report.written.heading});
  }
  void take_incomplete(const SourceReport& report) override {
    count_row();
    RawTrack* const found = track_of(report);
    if (found == nullptr) return track_set_.count(track_set_.counts_.ignored, place_);
    RawTrack& track = *found;
    const auto& time = report.written.time;
    if (time) agree_on(time->kind, report.row);
    const auto& missing = *report.row->missing();
    const MissingPolicy policy = track_set_.options_.missing;
    if (policy == MissingPolicy::fail)
      throw WrongInput(report.row->wrong_text(missing.column, fmt::format("a number as {}", missing.what)) +
                       " (see --missing)");
    track_set_.count(track_set_.counts_.missing, place_);
    ++track.placeless;
    if (time && policy == MissingPolicy::split) track.timed_placeless.push_back({time->time, place_});
  }
  void time_is(const FileTime&, TimeKind) override {}
  void warn(const std::string& warning) override { track_set_.counts_.warnings.push_back(warning); }
  void begin_row(std::size_t line) override {
    place_ = {this_file(), static_cast<int>(line)};
    is_counted_ = false;
  }
  void pass_over(Passed reason) override {
    count_row();
    track_set_.count(reason == Passed::filtered ? track_set_.counts_.filtered : track_set_.counts_.missing,
                     place_);
  }
  void refuse(std::size_t line, const std::string& reason) override {
    if (is_table(format_)) throw ProgramError(fmt::format("{}:{}: {}", file(), line, reason));
    count_row();
    place_.line = static_cast<int>(line);
    track_set_.count(track_set_.counts_.malformed, place_);
    if (malformed_++ == 0) first_malformed_ = fmt::format("{}: {}", line, reason);
  }

  const std::string& file() const { return track_set_.files_.back(); }

  void read_records(std::string_view text) {
    RecordCutter cutter(is_table(format_) ? RecordCutter::Kind::rows : records_of(format_));
    constexpr std::size_t block = std::size_t{1} << 20;
    for (; !text.empty(); text.remove_prefix(std::min(block, text.size()))) {
      cutter.feed(text.substr(0, block));
      while (const auto record = cutter.next()) read(*record);
    }
    if (const auto record = cutter.rest()) read(*record);
  }
  void read(const Record& record) {
    begin_row(record.line);
    guarded([&] {
      try {
        reader_->read(record, *this);
      } catch (const WrongInput& error) {
        refuse(record.line, error.what());
      }
    });
  }
  template <class Action>
  void guarded(Action action) const {
    try {
      action();
    } catch (const UnusableStream& error) {
      throw ProgramError(fmt::format("{}: {}", file(), error.what()));
    }
  }

  /// Counts a row of a table once, however many bodies it has, and each message.
  void count_row() {
    if (!is_table(format_) || !std::exchange(is_counted_, true)) ++track_set_.counts_.rows;
  }

  /// Returns null for an id that --ignore names.
  RawTrack* track_of(const SourceReport& report) const {
    track_set_.identities_.note(report.id);
    const auto id = track_set_.identities_.name_of(report.id);
    if (!id) return nullptr;
    auto& tracks = track_set_.tracks_;
    const auto [place, is_new] = track_set_.track_of_.emplace(*id, tracks.size());
    if (is_new) tracks.push_back({.id = place->first});
    RawTrack& track = tracks[place->second];
    track.is_joined = track.is_joined || *id != report.id;
    return &track;
  }

  /// Checks that all times are of one kind.
  void agree_on(TimeKind kind, const RowReader* row) {
    auto& known = track_set_.time_kind_;
    if (!known) {
      known = kind;
      track_set_.first_time_ = place_;
    }
    if (*known == kind) return;
    const std::string as_before = fmt::format("{} as time", name_of(*known));
    const std::string expected = row != nullptr
                                     ? row->wrong_text(row->columns()[Quantity::time]->place, as_before)
                                     : fmt::format("expected {}, but got {}", as_before, name_of(kind));
    throw WrongInput(fmt::format("{}, unlike {}", expected, track_set_.name(track_set_.first_time_)));
  }
  void agree_on_places(const SourceReport& report) {
    if (geographic_.value_or(report.geographic) != report.geographic)
      throw WrongInput(fmt::format("expected the position of {} in the same words as the first: {}",
                                   report.id, *geographic_ ? "latitude and longitude" : "x and y"));
    geographic_ = report.geographic;
  }
  static bool is_repeated(const RawTrack& track, const SourceReport& report) {
    if (track.samples.empty()) return false;
    const RawSample& last = track.samples.back();
    return last.position.x == report.position.x && last.position.y == report.position.y &&
           std::abs(seconds_between(last.time, report.stamp)) <= report.same_within;
  }
  void add_scenes(const RowReader& row, const FileTime& time) {
    const auto& names = row.head().names;
    if (!scene_columns_) {
      scene_columns_.emplace();
      for (const std::size_t place : row.columns().unused)
        if (place < names.size() &&
            (hints_at(names[place], NameHint::scene) || hints_at(names[place], NameHint::zone)) &&
            !row.filter().mentions(place))
          scene_columns_->push_back(place);
    }
    for (const std::size_t column : *scene_columns_)
      track_set_.scenes_.add(names[column], row.fields()[column], time);
  }
  /// Ids of ships and aircraft are the same in all files, and so are those that an option names.
  void note_ids() {
    const RowReader& rows = *reader_->rows();
    const auto& id = rows.columns()[Quantity::id];
    if (!id || rows.filter().mentions(id->place)) return;
    const auto& names = rows.head().names;
    const bool is_of_craft =
        !names.empty() && (hints_at(names[id->place], NameHint::aircraft) || rows.columns().is_ais);
    if (!is_of_craft) track_set_.id_column_ = id->place;
  }
  std::uint32_t this_file() const { return static_cast<std::uint32_t>(track_set_.files_.size() - 1); }

  /// Counts the rows of each track by their order in time.
  void note_orders() const {
    for (RawTrack& track : track_set_.tracks_) {
      if (track.is_joined) continue;
      const RawSample* before = nullptr;
      for (const RawSample& sample : track.samples) {
        if (sample.place.file != this_file()) continue;
        const RawSample* const earlier = std::exchange(before, &sample);
        if (earlier == nullptr) continue;
        if (is_earlier(earlier->time, sample.time)) ++track.forward;
        if (!is_earlier(sample.time, earlier->time)) continue;
        if (track.backward++ == 0) track.first_backward = sample.place;
      }
    }
  }

  /// Gives a height to aircraft on the ground, and leaves out samples without a height where others have one.
  void settle_heights(const std::optional<Column>& column) {
    for (RawTrack& track : track_set_.tracks_) {
      for (RawSample& sample : track.samples) {
        if (!std::isnan(sample.position.z)) continue;
        if (sample.on_ground && has_heights_) track_set_.count(track_set_.counts_.on_ground, sample.place);
        if (!has_heights_) {
          sample.position.z = 0.0;
        } else if (sample.on_ground && track_set_.ground_) {
          sample.position.z = height_of_ground(*column);
        } else {
          if (!sample.on_ground) track_set_.count(track_set_.counts_.missing, sample.place);
          ++track.placeless;
          track.timed_placeless.push_back({sample.time, sample.place});
        }
      }
      std::erase_if(track.samples, [](const RawSample& sample) { return std::isnan(sample.position.z); });
    }
  }
  /// Returns --ground in the unit of a column of heights.
  double height_of_ground(const Column& column) const {
    const bool is_known = !is_table(format_) || reader_->rows()->columns().in_metres;
    if (!is_known && has_unit_behind(track_set_.options_.ground))
      throw ProgramError(
          fmt::format("--ground: expected a number without a unit, because the unit of heights in {} is not "
                      "known, but got '{}': say --unit",
                      file(), track_set_.options_.ground));
    return is_known ? *track_set_.ground_ / column.unit : *track_set_.ground_;
  }

  RawTrackSet& track_set_;
  StreamFormat format_;
  std::unique_ptr<ReportFormat> reader_;
  Place place_;              ///< of the record
  bool is_counted_ = false;  ///< the row was counted
  std::optional<std::vector<std::size_t>> scene_columns_;
  std::optional<bool> geographic_;
  bool has_heights_ = false;
  std::size_t malformed_ = 0;
  std::string first_malformed_;  ///< its line and what was expected
};

RawTrackSet::RawTrackSet(const TrackOptions& options, bool several_files)
    : options_(options), several_files_(several_files), identities_(options.identities) {
  if (options.ground.empty()) return;
  const bool is_below = options.ground.starts_with('-');
  const double size = parse_measure(options.ground.substr(is_below ? 1 : 0), Measure::length, "--ground");
  ground_ = is_below ? -size : size;
}

/// Records in JSON are read as a whole; tables are those that look like nothing else.
StreamFormat RawTrackSet::format_of(std::string_view text, const std::string& file) const {
  const ColumnHints& hints = options_.hints;
  const StreamFormat format = format_of_text(text, hints).value_or(StreamFormat::csv);
  if (!is_read_whole(format)) return is_table(format) ? StreamFormat::csv : format;
  if (recording_kind_of(text, hints) != nullptr) return StreamFormat::recording;
  throw ProgramError(fmt::format("{}: expected a file of --format {}, but it is none", file, hints.format));
}

/// Throws ProgramError for bytes that are no text of a table.
void RawTrackSet::refuse_other_kinds(std::string_view text, const std::string& file) {
  if (const std::string other = other_file_kind(text); !other.empty())
    throw ProgramError(fmt::format("{}: expected a table in a text file, but it is {}", file, other));
  if (text.find('\0') != std::string::npos)
    throw ProgramError(
        fmt::format("{}: expected a text file, but it has zero bytes: if it is one that was cut off, leave "
                    "them out with tr -d '\\0'",
                    file));
}

void RawTrackSet::read(const std::string& text, const std::string& file) {
  const StreamFormat format = format_of(text, file);
  files_.push_back(file);
  FormatChoices choices = options_;
  choices.source = file;
  choices.is_recording = true;
  // The errors of positions do not count.
  choices.position_error_is_said = true;
  const bool is_text_table = is_table(format) && !is_read_whole(format);
  if (is_text_table) refuse_other_kinds(text, file);
  FileReader reader(*this, format, choices);
  const std::size_t rows_before = counts_.rows;
  try {
    reader.read(text);
  } catch (const ProgramError&) {
    const bool may_be_below = is_text_table && counts_.rows == rows_before;
    const auto header = may_be_below ? line_of_later_header(text) : std::nullopt;
    if (!header) throw;
    const std::string from = fmt::format("tail -n +{}", *header), word = shell_word(file);
    throw ProgramError(fmt::format(
        "{}: expected the header as the first line, but line {} looks like it: leave out what is above, with "
        "{} | kinesphere tracks - ...",
        file, *header,
        file.ends_with(".gz") ? fmt::format("zcat {} | {}", word, from) : fmt::format("{} {}", from, word)));
  }
  if (files_.size() == 1) head_ = reader.rows() != nullptr ? reader.rows()->head() : TableHead{.file = file};
}

void RawTrackSet::pass_clocks_through_midnights() {
  const Midnights midnights = pass_midnights(tracks_, static_cast<std::uint32_t>(files_.size() - 1));
  constexpr std::string_view advice = "write dates before the times";
  if (midnights.unclear)
    throw ProgramError(
        fmt::format("{}: the clock passes midnight in this file, and this row may be of either "
                    "day: {}",
                    name(*midnights.unclear), advice));
  if (passed_midnight_.value_or(midnights.has_passed) != midnights.has_passed)
    throw ProgramError(
        fmt::format("{}: the clock passes midnight {}, so that the day of this file is unclear: {}",
                    files_.back(), midnights.has_passed ? "in this file alone" : "in another file", advice));
  passed_midnight_ = midnights.has_passed;
}

void RawTrackSet::add_file_id(const std::string& id) {
  const auto [place, is_new] = file_of_.emplace(id, files_.back());
  if (!is_new)
    throw ProgramError(
        fmt::format("{}: expected files of different names, because each is a body called like it, but "
                    "{} is called {}, too",
                    files_.back(), place->second, id));
}

void RawTrackSet::add_columns(const TableColumns& columns, const std::string& file) {
  if (files_.size() == 1) {
    columns_ = columns;
    return;
  }
  if (columns.has_own_origin && files_.size() == 2)
    counts_.warnings.push_back(
        fmt::format("{} and {}: {}: approaches between their bodies mean nothing unless these are the same",
                    files_[0], files_[1], columns.format));
  const auto agree = [&](bool is_same, std::string_view what) {
    if (!is_same) throw ProgramError(fmt::format("{}: expected {} as in {}", file, what, files_.front()));
  };
  const auto is_same_unit = [](const Column& a, const Column& b) {
    return a.unit == b.unit && a.has_unit == b.has_unit;
  };
  agree(columns.geographic == columns_.geographic, "positions of the same kind");
  agree(columns.z().has_value() == columns_.z().has_value(), "the same number of dimensions");
  agree(is_same_unit(columns.x(), columns_.x()) && is_same_unit(columns.y(), columns_.y()) &&
            (!columns.z() || is_same_unit(*columns.z(), *columns_.z())),
        "lengths of the same unit");
  agree(columns.time_kind == columns_.time_kind && columns.time_unit.seconds == columns_.time_unit.seconds &&
            columns.time_unit.rate == columns_.time_unit.rate && columns.film == columns_.film,
        "times of the same unit");
}

void RawTrackSet::ask_about_ids() const {
  if (!several_files_ || !id_column_) return;
  struct Span {
    FileTime first, last;
  };
  for (const RawTrack& track : tracks_) {
    std::map<std::uint32_t, Span> of_file;
    for (const RawSample& sample : track.samples) {
      Span& span = of_file.try_emplace(sample.place.file, Span{sample.time, sample.time}).first->second;
      if (is_earlier(sample.time, span.first)) span.first = sample.time;
      if (is_earlier(span.last, sample.time)) span.last = sample.time;
    }
    for (auto one = of_file.begin(); one != of_file.end(); ++one) {
      const auto other = std::find_if(std::next(one), of_file.end(), [&](const auto& each) {
        return is_earlier(each.second.first, one->second.last) &&
               is_earlier(one->second.first, each.second.last);
      });
      if (other == of_file.end()) continue;
      const std::string name = head_.names.empty() ? "id" : name_in_filter(head_.names[*id_column_]);
      throw ProgramError(fmt::format(
          "{} and {} both have the id '{}' at the same times: say {} if each file is one body, --where '{} "
          "!= none' if the id is one body in both, or read them one by one if they are of different scenes",
          files_[one->first], files_[other->first], track.id, columns_.file_advice, name));
    }
  }
}

TimeScale RawTrackSet::time_scale() const {
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

std::string RawTrackSet::name(const Place& place) const {
  return fmt::format("{}:{}", files_[place.file], place.line);
}

void RawTrackSet::count(Tally& tally, const Place& place) const {
  constexpr std::size_t shown_places = 3;
  if (tally.count++ >= shown_places) return;
  tally.first_places.push_back(!several_files_ ? fmt::format("line {}", place.line) : name(place));
}

}  // namespace kinesphere::program
