// Rows of a table as reports, with a map of columns.
#include "formats/streams/row_reports.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/suspicions.hpp"
#include "formats/tables/presets.hpp"
#include "formats/tables/row_reader.hpp"

namespace kinesphere::program {
namespace {

class ReportsOfRows final : public RowReports {
 public:
  ReportsOfRows(const TableHead& head, FormatChoices choices, bool is_ais, const RowTable* recording)
      : head_(head), choices_(std::move(choices)), is_ais_(is_ais), recording_(recording) {}

  void read(const std::vector<std::string_view>& fields, std::size_t line, ReportSink& sink) override try {
    fields_ = &fields;
    if (!reader_) begin();
    refuse_other_header(line);
    if (reader_->leaves_out(*fields_)) return sink.pass_over(Passed::filtered);
    if (fields_->size() < columns_needed_)
      throw MalformedRecord(
          fmt::format("expected {} columns or more, but got {}", columns_needed_, fields_->size()));
    const std::size_t columns = head_.names.empty() ? head_.columns() : head_.names.size();
    // Those behind a comma or a tab too many are in the wrong columns.
    if (fields_->size() > columns)
      throw MalformedRecord(
          fmt::format("expected {} columns as in the {}, but got {}{}", columns,
                      head_.names.empty() ? "first row" : "header", fields_->size(),
                      head_.separator == ',' ? " (decimal commas are read where ; or tabs separate)" : ""));
    reader_->set_row(*fields_);
    for (std::size_t body = 0; body < reader_->bodies(); ++body) {
      reader_->set_body(body);
      hand_over(sink);
    }
  } catch (const OpenQuestion& question) {
    // A damaged line must not end a stream that has been understood.
    if (has_handed_over_ && !choices_.is_recording) throw MalformedRecord(question.what());
    const std::string place = question.is_about_row() ? fmt::format(":{}", line) : "";
    throw ProgramError(fmt::format("{}{}: {}", head_.file, place, question.what()));
  }

  /// A short stream is asked about at its end.
  void finish() const override {
    if (choices_.is_recording && !reader_ && recording_ != nullptr)
      throw UnusableStream(
          fmt::format("expected positions, but this file ({}) has none", recording_->format));
    if (choices_.is_recording && !reader_)
      throw UnusableStream("expected rows of numbers, but found none" + first_text());
    if (!reader_) check_header();
    ask();
  }
  const RowReader* rows() const override { return reader_ ? &*reader_ : nullptr; }

  void save(ByteWriter& state) const override {
    state(midnights_, last_clock_, reader_ ? reader_->columns().dates : DateOrder::unknown);
  }
  void restore(ByteReader& state) override {
    DateOrder dates = DateOrder::unknown;
    state(midnights_, last_clock_, dates);
    if (head_.columns() > 0) begin();
    has_handed_over_ = reader_.has_value();
    if (reader_) reader_->set_dates(dates);
    // The earlier run has asked.
    if (reader_) checked_ = most_checked;
    is_checking_clock_ = false;
  }

 private:
  /// Returns ": its first line is '...'" of a file with a header alone.
  std::string first_text() const {
    const auto& names = head_.names;
    return names.empty()
               ? ""
               : fmt::format(": its first line is {}", shown_field(fmt::format("{}", fmt::join(names, " "))));
  }

  TableColumns columns_of(const TableHead& head) const {
    ColumnHints hints = choices_.hints;
    // Of several presets of ships the header chooses one; others have the usual names.
    if (hints.format == "csv" || (is_ais_ && hints.format == "ais")) hints.format.clear();
    return find_columns(head, hints, choices_.is_recording ? ColumnUse::positions : ColumnUse::reports);
  }
  /// Throws for a stream whose lines are no rows, such as messages of another kind: the first of them is no
  /// header. A header alone may be that of a stream without reports.
  void check_header() const {
    TableHead head = head_;
    if (head.names.empty()) return;
    head.first.resize(head.names.size());
    columns_of(head);
  }

  /// A row of names in another order begins rows whose numbers would be taken for others.
  void refuse_other_header(std::size_t line) const {
    const auto& names = head_.names;
    const auto may_be_number = [](std::string_view field) {
      return !field.empty() && std::string_view("0123456789+-.").find(field[0]) != std::string_view::npos;
    };
    if (names.empty() || std::any_of(fields_->begin(), fields_->end(), may_be_number)) return;
    const auto known = std::count_if(fields_->begin(), fields_->end(), [&](std::string_view field) {
      return !field.empty() && std::find(names.begin(), names.end(), field) != names.end();
    });
    if (known >= 3)
      throw UnusableStream(
          fmt::format("line {} is another header, whose columns are not in the places of the first: what "
                      "follows it has to be read by itself",
                      line));
  }

  /// Finds the columns. Precondition: the head of the table is complete.
  void begin() {
    TableColumns columns = columns_of(head_);
    if (recording_ != nullptr) {
      columns.format = recording_->format;
      columns.has_named_fields = true;
      columns.id_is_file = columns.id_is_file || recording_->is_one_body;
      if (recording_->place_on_body != TableColumns::Place::middle) columns.place = recording_->place_on_body;
    }
    reader_.emplace(head_, std::move(columns));
    for (const TableColumns::Body& body : reader_->columns().bodies)
      columns_needed_ = std::max({columns_needed_, body.x + 1, body.y + 1, body.z.value_or(0) + 1});
    for (const auto& column : reader_->columns().of)
      if (column) columns_needed_ = std::max(columns_needed_, column->place + 1);
    if (const auto rest = reader_->columns().nanoseconds)
      columns_needed_ = std::max(columns_needed_, *rest + 1);
    // Such names may be ids elsewhere, so one that is read as an id does not count.
    const auto& id = reader_->columns()[Quantity::id];
    const auto of_id = id ? std::optional(id->place) : std::nullopt;
    name_column_ = column_called({"vesselname", "shipname", "callsign", "flight"}, of_id);
    if (!name_column_ && is_ais_) name_column_ = column_called({"name"}, of_id);
    ground_column_ = column_called({"onground", "isonground"});
    find_class_columns();
  }

  /// Returns the first column with one of these names, in their order; nothing if there is none.
  std::optional<std::size_t> column_called(std::initializer_list<std::string_view> wanted,
                                           std::optional<std::size_t> without = {}) const {
    for (const std::string_view name : wanted)
      for (std::size_t place = 0; place < head_.names.size(); ++place)
        if (place != without && plain_name(head_.names[place]) == name) return place;
    return std::nullopt;
  }
  /// True if the row has no height and says that it is on the ground, there or in a column of its own.
  bool is_on_ground() const {
    const auto& z = reader_->columns().z();
    if (!z || reader_->has_height()) return false;
    if (same_name((*fields_)[z->place], "ground")) return true;
    if (!ground_column_ || *ground_column_ >= fields_->size()) return false;
    const std::string_view said = (*fields_)[*ground_column_];
    return said == "1" || said == "-1" || same_name(said, "true") || same_name(said, "t") ||
           same_name(said, "yes");
  }

  /// Returns a number in metres and seconds.
  std::optional<double> number(Quantity quantity) {
    const auto number = reader_->number(quantity);
    return number ? std::optional(*number * reader_->columns()[quantity]->unit) : std::nullopt;
  }
  /// Makes a number one of this unit in seconds.
  static void scale(TimeField& time, double unit) {
    if (time.kind == TimeKind::date || time.kind == TimeKind::utc) return;
    if (unit != 1.0) time.time = time_of((static_cast<double>(time.time.whole) + time.time.fraction) * unit);
    time.kind = TimeKind::number;
  }
  std::optional<DeclaredError> error(Quantity quantity) {
    const auto error = number(quantity);
    if (!error) return std::nullopt;
    if (*error < 0.0)
      throw MalformedRecord(reader_->wrong_text(reader_->columns()[quantity]->place, "an error >= 0"));
    return DeclaredError{*error, "said by the stream"};
  }

  void hand_over(ReportSink& sink) {
    const TableColumns& columns = reader_->columns();
    SourceReport report{.id = reader_->id()};
    report.row = &*reader_;
    if (name_column_ && *name_column_ < fields_->size()) report.name = (*fields_)[*name_column_];
    auto stamp = reader_->time();
    report.written.time = stamp;
    if (auto arrival = reader_->time(Quantity::arrival)) {
      scale(*arrival, columns[Quantity::arrival]->unit);
      report.arrival = arrival->time;
    }
    const auto position = reader_->position();
    if (!stamp || !position) return sink.take_incomplete(report);
    report.written.position = *position;
    scale(*stamp, columns.time_unit.seconds / columns.time_unit.rate);
    if (columns.times_are_clocks && !choices_.is_recording) add_days(stamp->time);
    report.stamp = stamp->time;
    report.time_kind = stamp->kind;
    report.geographic = columns.geographic;
    report.in_metres = columns.in_metres;
    report.position = {position->x * columns.x().unit, position->y * columns.y().unit,
                       columns.z() ? position->z * columns.z()->unit : 0.0};
    report.has_height = reader_->has_height();
    report.may_have_height = columns.z().has_value();
    report.on_ground = is_on_ground();
    read_size(report);
    if (choices_.is_recording) return sink.take(report);
    read_velocity(report);
    report.position_error = error(Quantity::position_error);
    report.height_error = error(Quantity::height_error);
    report.velocity_error = error(Quantity::velocity_error);
    report.climb_error = error(Quantity::climb_error);
    report.stamp_error = number(Quantity::stamp_error);
    add_class(report);
    has_handed_over_ = true;
    if (checked_ < most_checked) check_first(*position, report);
    if (is_checking_clock_) check_clock(report);
    sink.take(report);
  }

  /// Makes a time of day one since the first midnight. A clock that falls by half a day or more has passed
  /// midnight; one that is ahead by 23 hours or more is late, from before it.
  void add_days(FileTime& time) {
    constexpr std::int64_t hour = 3600, day = 24 * hour;
    if (time.whole >= day) return;
    const std::int64_t ahead = time.whole - last_clock_.value_or(time.whole);
    const bool is_late = ahead >= 23 * hour;
    if (ahead <= -12 * hour) ++midnights_;
    if (!is_late) last_clock_ = time.whole;
    time.whole += day * (midnights_ - (is_late && midnights_ > 0 ? 1 : 0));
  }
  /// A length or width of 0 says that it is not known.
  void read_size(SourceReport& report) {
    if (!choices_.hints.sizes) return;
    const auto length = number(Quantity::length), width = number(Quantity::width);
    const TableColumns& columns = reader_->columns();
    report.written.heading =
        columns.rotation ? reader_->turned_axis()
                         : reader_->number(columns[Quantity::heading] ? Quantity::heading : Quantity::course);
    if (!length || !width || !(*length > 0.0 && *width > 0.0)) return;
    report.written.length = *length;
    report.written.width = *width;
    report.written.height = std::max(0.0, number(Quantity::body_height).value_or(0.0));
    report.extent = std::hypot(*length, *width) / 2;
  }

  /// Gathers the first reports, and asks before the last of them is taken.
  void check_first(const Vec3& position, const SourceReport& report) {
    degree_check_.add(position.x, position.y);
    const auto number = parse_number(report.id);
    counts_rows_ = counts_rows_ && number && (!last_number_ || *number == *last_number_ + 1.0);
    last_number_ = number;
    if (!first_stamp_) first_stamp_ = report.stamp;
    stamps_ += !last_stamp_ || is_earlier(*last_stamp_, report.stamp) ? 1 : 0;
    last_stamp_ = report.stamp;
    has_later_ = has_later_ || is_earlier(*first_stamp_, report.stamp);
    ++checked_;
    if (checked_ == most_checked) ask();
  }
  /// A stream of clock times shows itself with its second minute.
  void check_clock(const SourceReport& report) {
    // Seconds since the start of something may look like a clock after midnight.
    constexpr std::int64_t one_o_clock = 10'000;
    is_checking_clock_ = !reader_->columns().time_unit_said && report.time_kind == TimeKind::number &&
                         first_stamp_->whole >= one_o_clock;
    if (!is_checking_clock_) return;
    time_check_.add(report.stamp);
    is_checking_clock_ = time_check_.may_be_clock();
    if (const std::string suspicion = time_check_.clock_suspicion(); !suspicion.empty())
      throw UnusableStream(suspicion);
  }
  void ask() const {
    if (!reader_ || choices_.is_recording) return;
    ask_about_row_numbers();
    ask_about_degrees();
    const bool is_said = reader_->columns().time_unit_said;
    if (const std::string suspicion = time_check_.day_suspicion(stamps_); !is_said && !suspicion.empty())
      throw UnusableStream(suspicion);
  }
  /// Asks about ids that are one more in each row.
  void ask_about_row_numbers() const {
    const auto& id = reader_->columns()[Quantity::id];
    if (!id || checked_ < 3 || !counts_rows_ || !has_later_ || reader_->filter().mentions(id->place)) return;
    throw UnusableStream(
        fmt::format("each row has an id of its own in column {}, up to {}, as a row number is: say id=... "
                    "with --columns, or keep it with --where 'id != none'",
                    id->place + 1, *last_number_));
  }
  /// Asks about lengths that may be degrees.
  void ask_about_degrees() const {
    const TableColumns& columns = reader_->columns();
    const std::string suspicion = degree_check_.suspicion();
    if (columns.positions_said || columns.x().has_unit || suspicion.empty()) return;
    throw UnusableStream(suspicion);
  }

  void read_velocity(SourceReport& report) {
    auto speed = number(Quantity::speed), course = number(Quantity::course);
    if (is_ais_ || reader_->columns().is_ais) {
      // AIS has these values for an unknown speed or course.
      if (speed && *speed >= 102.25 * knot) speed.reset();
      if (course && *course >= 360.0) course.reset();
    }
    const auto vz = number(Quantity::vz), climb = number(Quantity::climb);
    const auto upward = vz ? vz : climb;
    set_velocity(report, speed, course, upward);
    if (const auto vx = number(Quantity::vx), vy = number(Quantity::vy); vx && vy)
      report.velocity = Vec3{*vx, *vy, upward.value_or(0.0)};
    if (report.velocity && !report.ground_speed)
      report.ground_speed = std::hypot(report.velocity->x, report.velocity->y);
  }

  /// Finds the columns that say what a track is; tables of AIS have such.
  void find_class_columns() {
    if (!is_ais_ && !reader_->columns().is_ais) return;
    status_ = column_called({"status", "navigationalstatus", "navstatus"});
    type_ = column_called({"vesseltype", "shiptype"});
    mobile_ = column_called({"typeofmobile"});
    if (status_) sayable_.push_back(MotionPreset::vessel_at_rest);
    if (type_)
      sayable_.insert(sayable_.end(), {MotionPreset::high_speed_craft, MotionPreset::wing_in_ground});
    if (mobile_)
      sayable_.insert(sayable_.end(), {MotionPreset::search_aircraft, MotionPreset::aid_to_navigation});
  }
  void add_class(SourceReport& report) const {
    const auto text = [&](const std::optional<std::size_t>& place) {
      return place && *place < fields_->size() ? (*fields_)[*place] : std::string_view();
    };
    report.said_status = preset_of_status(text(status_));
    report.said_kind = preset_of_mobile(text(mobile_));
    if (!report.said_kind) report.said_kind = preset_of_ship_type(text(type_));
    report.sayable = sayable_;
  }

  const TableHead& head_;
  FormatChoices choices_;
  bool is_ais_;
  const RowTable* recording_;
  std::optional<RowReader> reader_;  ///< empty before the first row of values
  bool has_handed_over_ = false;
  std::size_t columns_needed_ = 0;
  std::optional<std::int64_t> last_clock_;  ///< the latest time of day; seconds
  std::int64_t midnights_ = 0;              ///< that clocks have passed
  std::optional<std::size_t> name_column_, ground_column_;
  std::optional<std::size_t> status_, type_, mobile_;  ///< columns
  std::vector<MotionPreset> sayable_;
  /// Reports that are checked. More would delay the question; fewer would ask about more rooms, of which they
  /// show a small part.
  static constexpr int most_checked = 20;
  int checked_ = 0;
  DegreeCheck degree_check_;
  bool counts_rows_ = true;  ///< ids are one more in each row
  bool has_later_ = false;   ///< a report is later than the first
  std::optional<double> last_number_;
  std::optional<FileTime> first_stamp_, last_stamp_;
  std::size_t stamps_ = 0;  ///< of the reports that are checked, those later than the one before
  TimeCheck time_check_;
  bool is_checking_clock_ = true;
  const std::vector<std::string_view>* fields_ = nullptr;  ///< of the row
};

}  // namespace

std::unique_ptr<RowReports> make_row_reports(const TableHead& head, const FormatChoices& choices, bool is_ais,
                                             const RowTable* recording) {
  return std::make_unique<ReportsOfRows>(head, choices, is_ais, recording);
}

}  // namespace kinesphere::program
