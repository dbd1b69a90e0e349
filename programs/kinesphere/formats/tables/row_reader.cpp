// Reads the rows of a table as ids, times, positions and numbers, as their columns say.
#include "formats/tables/row_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/line_text.hpp"

namespace kinesphere::program {
namespace {

/// Larger numbers are not Unix times in seconds.
constexpr std::int64_t last_likely_second = 100'000'000'000;

/// True for a time of day such as 9:30, 09:30:15.5, 09:30:15 PM, and for a duration such as 0 days 09:30:15.
bool is_clock(std::string_view text) {
  if (const std::size_t day = text.find(" day"); day <= 5) return parse_clock(text).has_value();
  const std::size_t colon = text.find(':');
  return colon != std::string_view::npos && colon >= 1 && colon <= 2 && parse_number(text.substr(0, colon));
}

/// True for a date and a clock with the name of a zone behind them: 2024-01-31 12:30:00 CET.
bool ends_in_zone(std::string_view text, DateOrder order) {
  const std::size_t blank = std::min(text.rfind(' '), text.size());
  const std::string_view name = text.substr(std::min(blank + 1, text.size()));
  const bool are_letters = std::all_of(name.begin(), name.end(), [](char c) { return 'A' <= c && c <= 'Z'; });
  return name.size() >= 2 && are_letters && parse_date_time(text.substr(0, blank), order).has_value();
}

/// Returns the only order in which the numbers of a date are one; nothing for other text.
std::optional<DateOrder> only_order_of(std::string_view text) {
  if (!parse_date_time(text, DateOrder::any) || parse_date_time(text, DateOrder::year_first))
    return std::nullopt;
  const bool day_first = parse_date_time(text, DateOrder::day_first).has_value(),
             month_first = parse_date_time(text, DateOrder::month_first).has_value();
  if (day_first == month_first) return std::nullopt;
  return day_first ? DateOrder::day_first : DateOrder::month_first;
}

/// True for a number that a spreadsheet has rounded: 2.19E+08, which has fewer digits than it should.
bool is_rounded(std::string_view text) {
  const std::size_t exponent = text.find_first_of("eE"), point = text.find('.');
  if (exponent == std::string_view::npos || point > exponent) return false;
  const auto power = parse_number(text.substr(exponent + 1));
  return power && *power > static_cast<double>(exponent - point - 1);
}

/// True for YYYYMMDDhhmmss of the years 1900 to 2199.
bool is_packed_date(std::int64_t number) {
  const std::int64_t clock = number % 1'000'000, date = number / 1'000'000;
  return clock < 240'000 && clock / 100 % 100 < 60 && clock % 100 < 60 && date / 10'000 >= 1900 &&
         date / 10'000 < 2200 && date / 100 % 100 >= 1 && date / 100 % 100 <= 12 && date % 100 >= 1 &&
         date % 100 <= 31;
}

/// Returns how sed separates YYYYMMDDhhmmss, with milliseconds or without seconds, or YYMMDDhhmmss; empty for
/// another number.
std::string_view parts_of_packed_date(std::int64_t number) {
  constexpr std::int64_t thirteen_digits = 1'000'000'000'000, year_69 = 690'000'000'000;
  if (is_packed_date(number)) return R"(([0-9]{8})([0-9]{6})\b/\1T\2)";
  if (is_packed_date(number / 1000)) return R"(([0-9]{8})([0-9]{6})([0-9]{3})\b/\1T\2.\3)";
  if (number < thirteen_digits && is_packed_date(number * 100)) return R"(([0-9]{8})([0-9]{4})\b/\1T\200)";
  if (number < year_69 && is_packed_date(20 * thirteen_digits + number))
    return R"(([0-9]{6})([0-9]{6})\b/20\1T\2)";
  return {};
}

/// True for a number with which files say that they have none.
bool is_marker(double value) {
  constexpr double markers[] = {-999.0, -9999.0, -99999.0, -999999.0, 9999.0, 99999.0, 999999.0};
  return std::find(std::begin(markers), std::end(markers), value) != std::end(markers);
}

}  // namespace

std::string id_of_file(const std::string& file) {
  std::string id = std::filesystem::path(file).filename().string();
  id.resize(std::min(id.find('.', 1), id.size()));
  return id;
}

RowReader::RowReader(const TableHead& head, TableColumns columns)
    : head_(head),
      columns_(std::move(columns)),
      filter_(columns_.where, head, columns_),
      file_id_(id_of_file(head.file)) {
  for (const std::size_t place : columns_.unused) {
    if (place >= head.names.size() || filter_.mentions(place)) continue;
    const std::string_view values = void_values_of(head.names[place]);
    if (!values.empty()) void_columns_.push_back({place, values});
    if (plain_name(head.names[place]) == "likelihood") likelihood_ = place;
  }
}

void RowReader::set_row(const std::vector<std::string_view>& fields) {
  fields_ = &fields;
  missing_.reset();
  has_height_ = false;
  check_void_columns();
  check_likelihood();
}

/// Asks about rows that their file marks as void.
void RowReader::check_void_columns() const {
  for (const auto& [place, values] : void_columns_) {
    if (place >= fields_->size() || !is_word_of(field(place), values)) continue;
    const std::string name = name_in_filter(head_.names[place]);
    throw OpenQuestion(
        fmt::format("'{}' as {} may mean that there is no such position: leave such rows out with --where "
                    "'{} != {}', or keep them with --where '{} != none'",
                    field(place), head_.names[place], name, field(place), name));
  }
}

/// Asks about unlikely places: programs that look for parts of bodies give the best one, however bad.
void RowReader::check_likelihood() const {
  constexpr double likely = 0.5;
  const auto likelihood = likelihood_ && *likelihood_ < fields_->size()
                              ? number_field(field(*likelihood_), columns_.decimal_comma)
                              : std::nullopt;
  if (!likelihood || *likelihood >= likely) return;
  const std::string name = name_in_filter(head_.names[*likelihood_]);
  throw OpenQuestion(
      fmt::format("the likelihood {0} says that the position may be anywhere: leave such rows out with "
                  "--where '{1} >= 0.6', or keep them with --where '{1} != none'",
                  *likelihood, name));
}

std::string RowReader::wrong_text(std::size_t column, std::string_view expected) const {
  const std::string where = columns_.has_named_fields && column < head_.names.size()
                                ? fmt::format("'{}'", head_.names[column])
                                : fmt::format("column {}", column + 1);
  return fmt::format("expected {} ({}), but got {}", expected, where, shown_field(field(column)));
}

std::string_view RowReader::name_of(Quantity quantity) const {
  if (quantity == Quantity::longitude) return "longitude";
  return quantity == Quantity::latitude ? "latitude" : key_of(quantity);
}

void RowReader::set_body(std::size_t body) {
  body_ = body;
  missing_.reset();
  if (columns_.bodies.empty()) return;
  columns_[columns_.geographic ? Quantity::longitude : Quantity::x]->place = columns_.bodies[body].x;
  columns_[columns_.geographic ? Quantity::latitude : Quantity::y]->place = columns_.bodies[body].y;
  if (const auto& z = columns_.bodies[body].z) columns_[Quantity::z]->place = *z;
}

std::string_view RowReader::id() {
  if (!columns_.bodies.empty()) return columns_.bodies[body_].id;
  if (columns_.id_is_file) return file_id_;
  const std::size_t column = columns_[Quantity::id]->place;
  const std::string_view text = field(column);
  const auto number = text.find('.') != std::string_view::npos ? parse_number(text) : std::nullopt;
  const bool whole = number && std::floor(*number) == *number && std::abs(*number) < 1e15;
  if (whole) id_ = fmt::format("{}", static_cast<long long>(*number));
  const std::string_view id = whole ? std::string_view(id_) : text;
  if (whole && is_rounded(text) && !filter_.mentions(column))
    throw OpenQuestion(
        fmt::format("the id {} looks rounded, as spreadsheets do with long numbers: write ids in full, or "
                    "keep it with --where '{} != none'",
                    text, where_name(Quantity::id)));
  if (text.empty())
    throw WrongInput(fmt::format("{} (--where '{} != \"\"' leaves such rows out)",
                                 wrong_text(column, "an id"), where_name(Quantity::id)));
  if (is_nobody(head_.names.empty() ? "" : head_.names[column], id) && !filter_.mentions(column)) {
    const std::string name = where_name(Quantity::id);
    throw OpenQuestion(
        fmt::format("the id {0} is that of nobody in most files: leave its rows out with --where '{1} != "
                    "{2}', or keep them with --where '{1} != \"\"'",
                    id, name, name_in_filter(std::string(id))));
  }
  return id;
}

/// Returns the column's name as --where takes it.
std::string RowReader::where_name(Quantity quantity) const {
  return head_.names.empty() ? std::string(key_of(quantity))
                             : name_in_filter(head_.names[columns_[quantity]->place]);
}

/// Asks about numbers that stand for no position: 0 and 0 as degrees, -999, 9999 and the like far from all
/// others, the largest of a type, and heights such as -9999.
void RowReader::check_place(double x, double y, std::optional<double> z) {
  const Quantity along = columns_.geographic ? Quantity::longitude : Quantity::x;
  const Quantity across = columns_.geographic ? Quantity::latitude : Quantity::y;
  constexpr double no_heights[] = {-9999.0, -99999.0, -999999.0, -32768.0};
  const bool is_no_height =
      z && std::find(std::begin(no_heights), std::end(no_heights), *z) != std::end(no_heights);
  // Trackers write 0 or -1 for what they have lost.
  constexpr double least_of_others = 10.0;
  const std::size_t fewest_others = x == 0.0 ? 10 : 4;
  const bool is_lost = (x == 0.0 || x == -1.0) && spans_[0].count >= fewest_others &&
                       std::min(spans_[0].least, spans_[1].least) >= least_of_others;
  const bool is_none = columns_.geographic ? x == 0.0 : is_marker(x) || is_lost;
  if (x == y && is_none && !filter_.mentions(columns_[along]->place))
    throw OpenQuestion(
        fmt::format("{0} as {1} and {2} is no position in most files: leave such rows out with --where '{3} "
                    "!= {0} or {4} != {0}', or keep them with --where '{3} != none'",
                    x, name_of(along), name_of(across), where_name(along), where_name(across)));
  if (!columns_.geographic && !(x == y && is_none)) {
    check_coordinate(along, x, spans_[0]);
    check_coordinate(across, y, spans_[1]);
  }
  if (z) check_coordinate(Quantity::z, *z, spans_[2], is_no_height);
}

/// Asks about a number that stands for none, and else adds it to those of the file.
void RowReader::check_coordinate(Quantity quantity, double value, Span& span, bool is_none) const {
  constexpr double largest = 1e30, least_distance = 100.0;
  // Heights of aircraft may be 9999.
  const bool may_be_none = is_marker(value) && (quantity != Quantity::z || value < 0.0);
  const double distance = std::max(span.least - value, value - span.most);
  const bool is_far =
      distance > std::max(span.most - span.least, least_distance) || (value < 0.0 && span.least >= 0.0);
  if ((is_none || std::abs(value) >= largest || (may_be_none && is_far)) &&
      !filter_.mentions(columns_[quantity]->place))
    throw OpenQuestion(
        fmt::format("{0} as {1} is no position in most files: leave such rows out with --where '{2} != {0}', "
                    "or keep them with --where '{2} != none'",
                    value, name_of(quantity), where_name(quantity)));
  if (is_marker(value)) return;
  ++span.count;
  span.least = std::min(span.least, value);
  span.most = std::max(span.most, value);
}

std::optional<TimeField> RowReader::time(Quantity quantity) {
  const auto& column = columns_[quantity];
  if (!column) return std::nullopt;
  std::string_view text = field(column->place);
  if (quantity == Quantity::time) text = with_nanoseconds(with_date(text));
  auto time = time_field(text, columns_.dates);
  // Only one of the orders of day and month may be possible, as in 20/03/2021.
  if (!time && columns_.dates == DateOrder::unknown)
    if (const auto order = only_order_of(text)) {
      columns_.dates = *order;
      columns_.format += *order == DateOrder::day_first ? ", dates day first" : ", dates month first";
      time = time_field(text, *order);
    }
  if (!time && is_missing(text)) {
    if (!missing_) missing_ = {column->place, "time"};
    return std::nullopt;
  }
  if (!time && columns_.decimal_comma) time = time_field(with_decimal_point(text, buffer_), columns_.dates);
  if (!time && columns_.times_are_clocks)
    if (const auto clock = parse_clock(text)) time = TimeField{*clock, TimeKind::number};
  if (!time) {
    const bool has_date = text.data() == date_and_clock_.data();
    if (parse_date_time(text, DateOrder::any))
      throw OpenQuestion(fmt::format("{}: say --dates day-first or --dates month-first{}",
                                     wrong_text(has_date ? columns_[Quantity::date]->place : column->place,
                                                "a date whose order of day and month is known"),
                                     parse_date_time(text, DateOrder::year_first) ? ", or year-first" : ""));
    if (text.find_first_of("-/:") == std::string_view::npos)
      throw WrongInput(wrong_text(column->place, "a number as time") + number_advice(field(column->place)));
    throw WrongInput(
        wrong_text(column->place, "a time") +
        (columns_.times_are_clocks ? ": write 9:30 as 09:30:00, or as 00:09:30"
         : is_clock(text) ? ", which has no date: write it as in 2024-01-31T12:30:00Z, or the date in a "
                            "column called date, or say --time-unit clock to count from midnight"
         : ends_in_zone(text, columns_.dates) ? ": of names of zones UTC and GMT are read, as others may be "
                                                "of several zones: write offsets, such as +01:00 for CET"
                                              : " (dates are read as in 2024-01-31T12:30:00Z)"));
  }
  if (time->kind != TimeKind::number) return time;
  if (columns_.decimal_comma) check_decimals(column->place);
  time->kind = columns_.time_kind;
  if (quantity != Quantity::time) return time;
  if (!columns_.time_problem.empty()) throw OpenQuestion(columns_.time_problem, false);
  check_date(text, time->time);
  if (!columns_.time_unit_said) check_size(time->time);
  has_time_ = true;
  return time;
}

/// Returns the clock time behind the date of another column; nothing if that is missing.
std::string_view RowReader::with_date(std::string_view clock) {
  if (!columns_[Quantity::date] || !is_clock(clock)) return clock;
  std::string date(field(columns_[Quantity::date]->place));
  if (is_missing(date)) return {};
  // Sheets write a day as its midnight.
  if (date.find(':') != std::string::npos) date.resize(std::min(date.find_first_of(" T"), date.size()));
  if (date.size() == 8 && parse_number(date)) date.insert(6, "-").insert(4, "-");
  date_and_clock_ = date + ' ' + std::string(clock);
  return date_and_clock_;
}

/// Returns whole seconds with their nanoseconds; nothing if these are missing.
std::string_view RowReader::with_nanoseconds(std::string_view seconds) {
  if (!columns_.nanoseconds || is_missing(seconds)) return seconds;
  const std::string_view rest = field(*columns_.nanoseconds);
  if (is_missing(rest)) return {};
  constexpr double most = 1e9;
  const auto whole = parse_number(seconds), nanoseconds = parse_number(rest);
  if (!whole || std::floor(*whole) != *whole || *whole < 0.0)
    throw WrongInput(wrong_text(columns_[Quantity::time]->place, "whole seconds beside nanoseconds"));
  if (!nanoseconds || std::floor(*nanoseconds) != *nanoseconds || *nanoseconds < 0.0 || *nanoseconds >= most)
    throw WrongInput(wrong_text(*columns_.nanoseconds, "nanoseconds from 0 to 999999999"));
  date_and_clock_ = fmt::format("{:.0f}.{:09.0f}", *whole, *nanoseconds);
  return date_and_clock_;
}

/// Asks about numbers beside dates, which may be clocks or the seconds of a day.
void RowReader::check_date(std::string_view text, const FileTime& time) const {
  constexpr std::int64_t largest_clock = 1'000'000;
  if (!columns_[Quantity::date] || columns_.time_kind != TimeKind::number || time.whole > largest_clock)
    return;
  throw OpenQuestion(fmt::format(
      "the time {} and the date {} may belong together: write both as one column, as in 2024-01-31T12:30:00, "
      "or say {} to take the time alone",
      shown_field(text), shown_field(field(columns_[Quantity::date]->place)), columns_.time_advice));
}

/// Asks about numbers that are no likely seconds. Receivers on the earth know the date, so that what is one
/// of our time as milliseconds since 1970 is that.
void RowReader::check_size(const FileTime& time) {
  if (std::abs(time.whole) <= last_likely_second) return;
  if (const std::string_view parts = parts_of_packed_date(time.whole); !parts.empty())
    throw OpenQuestion(
        fmt::format("{}, which may be a date without separators: these are read as 20240131T123015, which "
                    "sed -E 's/\\b{}/' writes",
                    wrong_text(columns_[Quantity::time]->place, "a time"), parts));
  constexpr std::int64_t year_1990 = 631'152'000'000, year_2100 = 4'102'444'800'000;
  if (!columns_.geographic || has_time_ || time.whole < year_1990 || time.whole > year_2100)
    throw OpenQuestion(wrong_text(columns_[Quantity::time]->place, "seconds as time") +
                       ": say --time-unit ms, us or ns, or s if these are seconds");
  columns_.time_unit = {1.0, 1e3};
  columns_.time_unit_said = true;
  columns_.format += ", times in ms since 1970";
}

/// Refuses a table in which 1.234 may be a thousand, as other numbers have decimal commas, or 1,234, as
/// others have decimal points.
void RowReader::check_decimals(std::size_t column) {
  constexpr std::string_view digits = "0123456789";
  std::string_view text = field(column);
  const std::size_t mark = text.find_first_of(".,");
  if (mark == std::string_view::npos || text.find_first_of(".,", mark + 1) != std::string_view::npos) return;
  const std::size_t first_digit = std::min(text.find_first_of("123456789"), mark);
  const std::size_t before = mark - first_digit, behind = text.size() - mark - 1;
  const bool may_be_thousands = before >= 1 && before <= 3 && first_digit <= 1 && behind == 3 &&
                                text.find_first_not_of(digits, mark + 1) == std::string_view::npos;
  const std::size_t sign = text[mark] == ',' ? 1 : 0;
  const Marked& other = marked_[1 - sign];
  const std::string& unlike = may_be_thousands && other.thousands.empty() ? other.decimal : other.thousands;
  if (!unlike.empty())
    throw WrongInput(
        fmt::format("{}, unlike {} before: leave out what separates thousands, or write all decimals alike",
                    wrong_text(column, "the same decimal sign in all numbers"), shown_field(unlike)));
  std::string& first_seen = may_be_thousands ? marked_[sign].thousands : marked_[sign].decimal;
  if (first_seen.empty()) first_seen = text;
}

std::optional<double> RowReader::number(Quantity quantity) {
  const auto& column = columns_[quantity];
  if (!column) return std::nullopt;
  const std::string_view text = field(column->place);
  if (const auto number = number_field(text, columns_.decimal_comma)) {
    if (columns_.decimal_comma) check_decimals(column->place);
    return number;
  }
  if (!is_missing(text))
    throw WrongInput(wrong_text(column->place, fmt::format("a number as {}", name_of(quantity))) +
                     number_advice(text));
  if (!missing_) missing_ = {column->place, name_of(quantity)};
  return std::nullopt;
}

std::optional<double> RowReader::turned_axis() const {
  std::array<double, 4> parts{};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto number = columns_.rotation && (*columns_.rotation)[k] < fields_->size()
                            ? number_field(field((*columns_.rotation)[k]), columns_.decimal_comma)
                            : std::nullopt;
    if (!number) return std::nullopt;
    parts[k] = *number;
  }
  const auto [w, x, y, z] = parts;
  return std::atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z);
}

/// Returns the number of a longitude or latitude, negative in the west or south. `letters` name the
/// hemispheres.
std::optional<double> RowReader::degrees(Quantity quantity, const std::optional<std::size_t>& hemisphere,
                                         std::string_view letters) {
  const std::size_t column = columns_[quantity]->place;
  auto degrees = number_field(field(column), columns_.decimal_comma);
  if (degrees && columns_.decimal_comma) check_decimals(column);
  if (!degrees) degrees = angle_field(field(column), columns_.decimal_comma, letters);
  if (!degrees) degrees = number(quantity);  // missing, or wrong
  if (!degrees || !hemisphere) return degrees;
  const std::string_view letter = *hemisphere < fields_->size() ? field(*hemisphere) : std::string_view();
  const bool is_negative = same_name(letter, letters.substr(1));
  if (!is_negative && !(same_name(letter, letters.substr(0, 1)) && *degrees >= 0.0))
    throw WrongInput(wrong_text(
        *hemisphere, fmt::format("{} or {} of {}", letters[0], letters[1], shown_field(field(column)))));
  return is_negative ? -std::abs(*degrees) : degrees;
}

std::optional<Vec3> RowReader::position() {
  const bool geographic = columns_.geographic;
  const Quantity along = geographic ? Quantity::longitude : Quantity::x;
  const Quantity across = geographic ? Quantity::latitude : Quantity::y;
  const auto x = geographic ? degrees(along, columns_.east_or_west, "EW") : number(along);
  const auto y = geographic ? degrees(across, columns_.north_or_south, "NS") : number(across);
  const auto z = number(Quantity::z);
  has_height_ = z.has_value();
  if (!x || !y) return std::nullopt;
  check_place(*x, *y, z);
  if (geographic) {
    const double longitude = *x * columns_.x().unit, latitude = *y * columns_.y().unit;
    if (longitude == 181.0 || latitude == 91.0) {
      const bool first = longitude == 181.0;
      missing_ = {(first ? columns_.x() : columns_.y()).place, name_of(first ? along : across)};
      return std::nullopt;
    }
    // Whole numbers are ten-millionths in messages of MAVLink and GPS.
    constexpr double least_whole = 1e6;
    const char* const unit_advice =
        std::abs(*x) >= least_whole || std::abs(*y) >= least_whole
            ? ": say --columns ...,lon=...:degE7,lat=...:degE7 if it is in 1e-7 degrees, or :semicircles if "
              "it is of FIT"
        : std::abs(*x) <= 18e3 && std::abs(*y) <= 9e3
            ? ": degrees and minutes are read with a blank between them, 47 30.25 for 4730.25"
            : "";
    if (!(std::abs(longitude) <= 360.0))
      throw WrongInput(wrong_text(columns_.x().place, "a longitude from -360 to 360 degrees") + unit_advice);
    if (!(std::abs(latitude) <= 90.0))
      throw WrongInput(wrong_text(columns_.y().place, "a latitude from -90 to 90 degrees") + unit_advice);
    // No aircraft or balloon flies as high; in feet they do.
    constexpr double highest = 20e3;
    if (z && !columns_.z()->has_unit && std::abs(*z) > highest)
      throw OpenQuestion(fmt::format("{}: say its unit, {}",
                                     wrong_text(columns_.z()->place, "a height in metres up to 20000"),
                                     columns_.height_advice));
  }
  return Vec3{*x, *y, z.value_or(0.0)};
}

}  // namespace kinesphere::program
