// Parses times in files: dates or numbers.
#include "formats/time_text.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "ascii_text.hpp"
#include "number_text.hpp"

namespace kinesphere::program {
namespace {

constexpr double too_large = 0x1p61;

bool is_digit(char c) { return '0' <= c && c <= '9'; }

bool all_digits(std::string_view text) { return std::all_of(text.begin(), text.end(), is_digit); }

/// Sets the fraction to 0.digits.
void set_fraction(std::string_view digits, FileTime& time) {
  time.fraction = *parse_number("0." + std::string(digits));
  // With more digits the numerator is no longer an exact integer.
  constexpr std::size_t most_digits = 18;
  if (digits.size() > most_digits) return;
  std::int64_t numerator = 0;
  double denominator = 1.0;
  for (char c : digits) {
    numerator = 10 * numerator + (c - '0');
    denominator *= 10.0;
  }
  const auto rounded = static_cast<double>(numerator);
  const auto below = static_cast<double>(numerator - static_cast<std::int64_t>(rounded));
  time.rest = (std::fma(-time.fraction, denominator, rounded) + below) / denominator;
}

std::optional<FileTime> with_sign(bool negative, FileTime time) {
  if (time.fraction >= 1.0) time = {time.whole + 1, 0.0};
  if (!negative) return time;
  if (time.fraction == 0.0) return FileTime{-time.whole, 0.0};
  // 1 - fraction is exact only for a fraction of at least a half.
  const double fraction = 1.0 - time.fraction;
  return FileTime{-time.whole - 1, fraction, (1.0 - fraction) - time.fraction - time.rest};
}

/// Reads a text from its front.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }
  bool take(char c) {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// Reads exactly `count` digits; nothing if there are fewer or the number exceeds `most`.
  std::optional<int> digits(std::size_t count, int most) {
    if (rest_.size() < count || !all_digits(rest_.substr(0, count))) return std::nullopt;
    int number = 0;
    for (char c : rest_.substr(0, count)) number = 10 * number + (c - '0');
    rest_.remove_prefix(count);
    return number <= most ? std::optional(number) : std::nullopt;
  }
  /// Reads one digit up to `most` of them.
  std::optional<int> few_digits(std::size_t most) {
    std::size_t count = 0;
    while (count < std::min(most, rest_.size()) && is_digit(rest_[count])) ++count;
    return count == 0 ? std::nullopt : digits(count, std::numeric_limits<int>::max());
  }
  bool take_word(std::string_view word) {
    if (!same_name(rest_.substr(0, word.size()), word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  std::string_view all_digits_ahead() {
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_digit);
    const std::string_view digits = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
    rest_.remove_prefix(digits.size());
    return digits;
  }

 private:
  std::string_view rest_;
};

/// Returns days since 1970-01-01; nothing for a day that does not exist.
std::optional<std::int64_t> days_of(int year, int month, int day) {
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

/// Returns days since 1970-01-01. `extended`: the parts have - or / between them.
std::optional<std::int64_t> read_date(Reader& reader, bool& extended) {
  const auto year = reader.digits(4, 9999);
  const char between = reader.take('-') ? '-' : reader.take('/') ? '/' : '\0';
  extended = between != '\0';
  const auto month = reader.digits(2, 12);
  if (extended && !reader.take(between)) return std::nullopt;
  const auto day = reader.digits(2, 31);
  if (!year || !month || !day) return std::nullopt;
  return days_of(*year, *month, *day);
}

/// Reads D/M/YYYY or M/D/YYYY. Returns days since 1970-01-01.
std::optional<std::int64_t> read_ordered_date(Reader& reader, DateOrder order) {
  const auto first = reader.few_digits(2);
  const char between = reader.take('/') ? '/' : reader.take('.') ? '.' : reader.take('-') ? '-' : '\0';
  const auto second = reader.few_digits(2);
  if (between == '\0' || !reader.take(between)) return std::nullopt;
  const auto year = reader.digits(4, 9999);
  if (!first || !second || !year) return std::nullopt;
  const auto day_first = days_of(*year, *second, *first), month_first = days_of(*year, *first, *second);
  if (order == DateOrder::any) return day_first ? day_first : month_first;
  return order == DateOrder::day_first ? day_first : month_first;
}

/// Returns seconds since midnight. `free`: the hour may have one digit, and AM or PM may follow.
std::optional<FileTime> read_clock(Reader& reader, bool extended, bool free = false) {
  auto hour = free ? reader.few_digits(2) : reader.digits(2, 24);
  if (hour && *hour > 24) return std::nullopt;
  if (extended && !reader.take(':')) return std::nullopt;
  const auto minute = reader.digits(2, 59);
  if (!hour || !minute) return std::nullopt;
  FileTime time{std::int64_t{3600} * *hour + std::int64_t{60} * *minute, 0.0};
  const bool has_seconds = extended ? reader.take(':') : !reader.at_end();
  if (has_seconds) {
    const auto second = reader.digits(2, 60);
    if (!second) return std::nullopt;
    time.whole += *second;
    if (reader.take('.') || reader.take(',')) {
      const std::string_view digits = reader.all_digits_ahead();
      if (digits.empty()) return std::nullopt;
      set_fraction(digits, time);
    }
  }
  if (*hour == 24 && (time.whole > std::int64_t{24} * 3600 || time.fraction > 0)) return std::nullopt;
  if (free) {
    reader.take(' ');
    const bool after_noon = reader.take_word("pm");
    if ((after_noon || reader.take_word("am")) && (*hour < 1 || *hour > 12)) return std::nullopt;
    if (after_noon) time.whole += *hour == 12 ? 0 : 12 * 3600;
  }
  return with_sign(false, time);
}

/// Returns seconds east of Greenwich.
std::optional<int> read_offset(Reader& reader) {
  if (reader.take('Z') || reader.take('z')) return 0;
  const int sign = reader.take('+') ? 1 : -1;
  if (sign < 0 && !reader.take('-')) return std::nullopt;
  const auto hours = reader.digits(2, 23);
  if (!hours) return std::nullopt;
  if (reader.at_end()) return sign * *hours * 3600;
  reader.take(':');
  const auto minutes = reader.digits(2, 59);
  if (!minutes) return std::nullopt;
  return sign * (*hours * 3600 + *minutes * 60);
}

}  // namespace

std::string_view name_of(TimeKind kind) {
  switch (kind) {
    case TimeKind::number:
      return "a number";
    case TimeKind::frames:
      return "a number of a frame";
    case TimeKind::date:
      return "a date without a zone";
    case TimeKind::utc:
      return "a date with a zone";
  }
  return "";
}

std::optional<FileTime> parse_decimal_time(std::string_view text) {
  const auto number = parse_number(text);
  if (!number || std::abs(*number) >= too_large) return std::nullopt;
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string_view before = text.substr(0, point);
  const std::string_view after = text.substr(std::min(point + 1, text.size()));
  if (before.empty() || !all_digits(before) || !all_digits(after)) {
    const double whole = std::floor(*number);
    return FileTime{static_cast<std::int64_t>(whole), *number - whole};
  }
  FileTime time;
  std::from_chars(before.data(), before.data() + before.size(), time.whole);
  if (!after.empty()) set_fraction(after, time);
  return with_sign(negative, time);
}

std::optional<DateTime> parse_date_time(std::string_view text, DateOrder order) {
  // Numbers are most frequent.
  if (text.size() < 8) return std::nullopt;
  Reader reader(text);
  bool extended = false;
  const bool is_ordered = order != DateOrder::unknown && text.find_first_of("/.-") < 3;
  if (is_ordered) extended = true;
  const auto days = is_ordered ? read_ordered_date(reader, order) : read_date(reader, extended);
  if (days && extended && reader.at_end()) return DateTime{{*days * 86400, 0.0}, false};
  if (!days || !(reader.take('T') || reader.take('t') || reader.take(' '))) return std::nullopt;
  const auto clock = read_clock(reader, extended, is_ordered);
  if (!clock) return std::nullopt;
  DateTime result{{*days * 86400 + clock->whole, clock->fraction, clock->rest}, false};
  if (reader.at_end()) return result;
  reader.take(' ');
  const auto offset = read_offset(reader);
  if (!offset || !reader.at_end()) return std::nullopt;
  result.time.whole -= *offset;
  result.has_offset = true;
  return result;
}

std::optional<TimeField> time_field(std::string_view text, DateOrder order) {
  if (const auto number = parse_decimal_time(text)) return TimeField{*number, TimeKind::number};
  if (const auto date = parse_date_time(text, order))
    return TimeField{date->time, date->has_offset ? TimeKind::utc : TimeKind::date};
  return std::nullopt;
}

}  // namespace kinesphere::program
