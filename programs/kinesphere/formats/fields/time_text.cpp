// Parses times in files: dates or numbers.
#include "formats/fields/time_text.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"

namespace kinesphere::program {
namespace {

constexpr double too_large = 0x1p61;

bool is_digit(char c) { return '0' <= c && c <= '9'; }
bool is_letter(char c) { return 'a' <= (c | 32) && (c | 32) <= 'z'; }

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
  std::size_t digits_ahead() const {
    return static_cast<std::size_t>(std::find_if_not(rest_.begin(), rest_.end(), is_digit) - rest_.begin());
  }
  bool take_word(std::string_view word) {
    if (!same_name(rest_.substr(0, word.size()), word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  /// Reads [text]; returns true if there is none.
  bool pass_over_brackets() {
    if (!take('[')) return true;
    rest_.remove_prefix(std::min(rest_.find(']'), rest_.size()));
    return take(']');
  }
  std::string_view all_digits_ahead() { return ahead(is_digit); }
  std::string_view letters_ahead() { return ahead(is_letter); }

 private:
  template <class Condition>
  std::string_view ahead(Condition condition) {
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), condition);
    const std::string_view digits = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
    rest_.remove_prefix(digits.size());
    return digits;
  }

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

/// Reads the day of a year from 001, as ephemerides have it. Returns days since 1970-01-01.
std::optional<std::int64_t> read_day_of_year(Reader& reader, std::optional<int> year) {
  const auto day = reader.digits(3, 366);
  const auto first = year ? days_of(*year, 1, 1) : std::nullopt,
             last = year ? days_of(*year, 12, 31) : std::nullopt;
  if (!first || !last || !day || *day < 1 || *first + *day - 1 > *last) return std::nullopt;
  return *first + *day - 1;
}

/// Returns days since 1970-01-01. `extended`: the parts have - or / between them.
std::optional<std::int64_t> read_date(Reader& reader, bool& extended) {
  const auto year = reader.digits(4, 9999);
  const char between = reader.take('-') ? '-' : reader.take('/') ? '/' : reader.take('.') ? '.' : '\0';
  extended = between != '\0';
  if (between == '-' && reader.digits_ahead() == 3) return read_day_of_year(reader, year);
  const auto month = extended ? reader.few_digits(2) : reader.digits(2, 12);
  if (extended && !reader.take(between)) return std::nullopt;
  const auto day = extended ? reader.few_digits(2) : reader.digits(2, 31);
  if (!year || !month || !day) return std::nullopt;
  return days_of(*year, *month, *day);
}

/// Reads a year of four digits, or of two.
std::optional<int> read_year(Reader& reader) {
  if (reader.digits_ahead() != 2) return reader.digits(4, 9999);
  return year_of_two_digits(*reader.digits(2, 99));
}

/// Reads D/M/YYYY or M/D/YYYY, or a date with a year of two digits. Returns days since 1970-01-01.
std::optional<std::int64_t> read_ordered_date(Reader& reader, DateOrder order) {
  const auto first = reader.few_digits(2);
  const char between = reader.take('/') ? '/' : reader.take('.') ? '.' : reader.take('-') ? '-' : '\0';
  const auto second = reader.few_digits(2);
  if (!first || between == '\0' || !second || !reader.take(between)) return std::nullopt;
  const bool may_be_day = reader.digits_ahead() <= 2;
  Reader ahead = reader;
  const auto third = ahead.few_digits(2);
  const auto year = read_year(reader);
  const auto day_first = year ? days_of(*year, *second, *first) : std::nullopt;
  const auto month_first = year ? days_of(*year, *first, *second) : std::nullopt;
  const auto year_first =
      third && may_be_day ? days_of(year_of_two_digits(*first), *second, *third) : std::nullopt;
  if (order == DateOrder::year_first || (order == DateOrder::any && !day_first && !month_first)) {
    reader = ahead;
    return year_first;
  }
  if (order == DateOrder::any) return day_first ? day_first : month_first;
  return order == DateOrder::day_first ? day_first : month_first;
}

/// Returns the month, from 1, whose English name begins with these letters, three or more.
std::optional<int> month_named(std::string_view letters) {
  constexpr std::string_view names[] = {"january",   "february", "march",    "april",
                                        "may",       "june",     "july",     "august",
                                        "september", "october",  "november", "december"};
  for (int month = 1; letters.size() >= 3 && month <= 12; ++month)
    if (same_name(names[month - 1].substr(0, letters.size()), letters)) return month;
  return std::nullopt;
}

/// Reads a day with the month's name, 29-Feb-2024, 29 Feb 2024 or Feb 29, 2024, perhaps behind "Thu, ".
/// Returns days since 1970-01-01.
std::optional<std::int64_t> read_named_date(Reader& reader) {
  const auto pass_over_signs = [&] {
    while (reader.take(' ') || reader.take(',') || reader.take('-') || reader.take('.')) {
    }
  };
  auto day = reader.few_digits(2);
  pass_over_signs();
  auto month = month_named(reader.letters_ahead());
  pass_over_signs();
  if (!day && !month) {  // the word was the day of the week
    day = reader.few_digits(2);
    pass_over_signs();
    month = month_named(reader.letters_ahead());
    pass_over_signs();
  }
  if (!day) day = reader.few_digits(2);
  pass_over_signs();
  const auto year = read_year(reader);
  return day && month && year ? days_of(*year, *month, *day) : std::nullopt;
}

/// Returns seconds since midnight. `extended`: there is : between the parts, the hour may have one digit, and
/// AM or PM may follow.
std::optional<FileTime> read_clock(Reader& reader, bool extended) {
  const auto hour = extended ? reader.few_digits(2) : reader.digits(2, 24);
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
  if (extended) {
    reader.take(' ');
    const bool after_noon = reader.take_word("pm") || reader.take_word("p.m.");
    const bool of_twelve = after_noon || reader.take_word("am") || reader.take_word("a.m.");
    if (of_twelve && (*hour < 1 || *hour > 12)) return std::nullopt;
    // Twelve is the hour before one.
    if (of_twelve) time.whole += 3600 * (*hour % 12 + (after_noon ? 12 : 0) - *hour);
  }
  return with_sign(false, time);
}

/// Reads +01:00, +0100 or +01, and +1 behind the name of a zone. Returns seconds.
std::optional<int> read_signed_offset(Reader& reader, bool is_named) {
  const int sign = reader.take('+') ? 1 : -1;
  if (sign < 0 && !reader.take('-')) return std::nullopt;
  const auto hours = is_named ? reader.few_digits(2) : reader.digits(2, 23);
  if (!hours || *hours > 23) return std::nullopt;
  if (reader.take(':') || reader.digits_ahead() > 0) {
    const auto minutes = reader.digits(2, 59);
    if (!minutes) return std::nullopt;
    return sign * (*hours * 3600 + *minutes * 60);
  }
  return sign * *hours * 3600;
}

/// Returns seconds east of Greenwich. The name of a zone may follow, as in "+0100 CET".
std::optional<int> read_offset(Reader& reader) {
  if (reader.take_word("Z")) return 0;
  const bool is_named = reader.take_word("UTC") || reader.take_word("GMT");
  Reader ahead = reader;
  const auto offset = read_signed_offset(ahead, is_named);
  if (!offset) return is_named ? std::optional(0) : std::nullopt;
  reader = ahead;
  if (reader.take(' ')) {
    const bool has_brackets = reader.take('(');
    if (reader.letters_ahead().empty() || (has_brackets && !reader.take(')'))) return std::nullopt;
  }
  return offset;
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

std::optional<FileTime> parse_clock(std::string_view text) {
  Reader reader(text);
  // Durations and days of more than 24 hours.
  constexpr std::size_t most_digits = 5;
  std::int64_t whole = 0;
  int parts = 0;
  std::int64_t days = 0;
  // As Python writes them: 1 days 02:03:04, or 1 day, 2:03:04.
  Reader ahead = reader;
  if (const auto count = ahead.few_digits(most_digits);
      count && ahead.take(' ') && (ahead.take_word("days") || ahead.take_word("day"))) {
    days = *count;
    reader = ahead;
    reader.take(',');
    reader.take(' ');
  }
  for (; parts < 3 && (parts == 0 || reader.take(':')); ++parts) {
    const auto number = reader.few_digits(most_digits);
    if (!number || (parts > 0 && *number >= 60)) return std::nullopt;
    whole = 60 * whole + *number;
  }
  const bool has_decimals = reader.take('.') || reader.take(',');
  FileTime time{};
  if (has_decimals) {
    const std::string_view digits = reader.all_digits_ahead();
    if (digits.empty()) return std::nullopt;
    set_fraction(digits, time);
  }
  reader.take(' ');
  const bool after_noon = reader.take_word("pm") || reader.take_word("p.m.");
  const bool of_twelve = after_noon || reader.take_word("am") || reader.take_word("a.m.");
  // 9:30 may be hours and minutes, or minutes and seconds.
  if (parts == 2 && of_twelve && !has_decimals)
    whole *= 60;
  else if (parts == 2 && !has_decimals)
    return std::nullopt;
  time.whole += 86'400 * days + whole;
  const std::int64_t hour = whole / 3600;
  if (parts < 2 || !reader.at_end() || (of_twelve && (hour < 1 || hour > 12))) return std::nullopt;
  if (of_twelve) time.whole += 3600 * (hour % 12 + (after_noon ? 12 : 0) - hour);
  return time;
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
  if (text.size() < 6) return std::nullopt;
  Reader reader(text);
  bool extended = true;
  std::optional<std::int64_t> days;
  if (const std::string_view begin = text.substr(0, 4); std::any_of(begin.begin(), begin.end(), is_letter)) {
    days = read_named_date(reader);
  } else if (order != DateOrder::unknown && text.find_first_of("/.-") < 3) {
    days = read_ordered_date(reader, order);
  } else {
    days = read_date(reader, extended);
  }
  if (days && extended && reader.at_end()) return DateTime{{*days * 86400, 0.0}, false};
  const auto take_between = [&] {
    return reader.take('T') || reader.take('t') || reader.take(' ') || (!extended && reader.take('_'));
  };
  if (!days || !take_between()) return std::nullopt;
  const auto clock = read_clock(reader, extended);
  if (!clock) return std::nullopt;
  DateTime result{{*days * 86400 + clock->whole, clock->fraction, clock->rest}, false};
  if (reader.at_end()) return result;
  reader.take(' ');
  const auto offset = read_offset(reader);
  // Java writes the name of the zone behind its offset.
  if (!offset || !reader.pass_over_brackets() || !reader.at_end()) return std::nullopt;
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
