// Parses times in files: dates or numbers.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace kinesphere::program {

/// A time of a file: whole + fraction + rest, 0 <= fraction < 1. Unit: that of the file; for dates seconds
/// since 1970-01-01T00:00:00Z.
struct FileTime {
  std::int64_t whole = 0;
  double fraction = 0.0;
  double rest = 0.0;  ///< what rounding took from the fraction, so that sums are rounded once
};

/// Returns a time of seconds. Range: up to 2^61 seconds.
inline FileTime time_of(double seconds) {
  const double whole = std::floor(seconds);
  return {static_cast<std::int64_t>(whole), seconds - whole};
}

/// Returns true for the range of time_of().
inline bool is_time(double seconds) { return std::abs(seconds) < 0x1p61; }

inline FileTime later_by(FileTime time, double seconds) {
  const double fraction = time.fraction + seconds;
  const double whole = std::floor(fraction);
  return {time.whole + static_cast<std::int64_t>(whole), fraction - whole};
}

/// The kind of a file's times.
enum class TimeKind {
  number,  ///< numbers of a unit
  frames,  ///< frame numbers
  date,    ///< dates in an unknown zone
  utc,     ///< dates with Z or an offset
};

/// Returns "a number", "a date with a zone" and so on.
std::string_view name_of(TimeKind kind);

/// What the parts of a date such as 03/04/2025 are.
enum class DateOrder {
  unknown,  ///< such dates are not read
  day_first,
  month_first,
  year_first,  ///< with two digits
  any,         ///< whichever exists, to find out whether a text is a date
};

/// Parses a decimal number of absolute value below 2^61. The decimals are rounded on their own, so that
/// 1700000000.123 loses nothing to its whole part.
std::optional<FileTime> parse_decimal_time(std::string_view text);

constexpr bool is_earlier(const FileTime& a, const FileTime& b) {
  return a.whole != b.whole ? a.whole < b.whole : a.fraction < b.fraction;
}
/// Returns later - earlier, in their unit.
constexpr double seconds_between(const FileTime& earlier, const FileTime& later) {
  return static_cast<double>(later.whole - earlier.whole) + (later.fraction - earlier.fraction);
}

/// Returns the year of which these are the last two digits: 1969 to 2068, as POSIX has it.
constexpr int year_of_two_digits(int two) { return two + (two < 69 ? 2000 : 1900); }

struct DateTime {
  FileTime time;
  bool has_offset = false;  ///< it ended in Z or an offset such as +02:00; otherwise it is taken as UTC
};

/// ISO 8601: a date YYYY-MM-DD, T or one blank, hh:mm[:ss[.fraction]] and perhaps Z, UTC, GMT, +hh, +hhmm or
/// +hh:mm; also without - and : (YYYYMMDDThhmmss, or _ for T). A date YYYY-MM-DD alone is its midnight. A
/// second 60 is the first of the next minute. Days must exist. So are YYYY/MM/DD, D-Mon-YYYY, D Mon YYYY and
/// Mon D, YYYY with English names of months; and D/M/YYYY, M/D/YYYY and those with a year of two digits, also
/// with . or - between them, where `order` says which. Month, day and hour may have one digit, and AM or PM
/// may stand behind the clock, but for a time without - and :.
std::optional<DateTime> parse_date_time(std::string_view text, DateOrder order = DateOrder::unknown);
/// Parses a time of day, or a duration, such as 25:00:15.5, 9:30 PM, 0 days 00:00:15, or 05:12.3 (minutes).
/// Returns seconds since midnight; nothing for 9:30, which may be either.
std::optional<FileTime> parse_clock(std::string_view text);

struct TimeField {
  FileTime time{};
  TimeKind kind = TimeKind::number;
};
/// Parses a number or a date; returns nothing for other text.
std::optional<TimeField> time_field(std::string_view text, DateOrder order = DateOrder::unknown);

}  // namespace kinesphere::program
