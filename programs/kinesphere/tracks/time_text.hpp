// Parses times in files: dates or numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace kinesphere::program {

/// An unrounded time: whole + fraction, 0 <= fraction < 1. Unit: that of the file; for dates seconds since
/// 1970-01-01T00:00:00Z.
struct FileTime {
  std::int64_t whole = 0;
  double fraction = 0.0;
};

/// Parses a decimal number of absolute value below 2^61. The decimals are rounded on their own, so that
/// 1700000000.123 loses nothing to its whole part.
std::optional<FileTime> parse_decimal_time(std::string_view text);

struct DateTime {
  FileTime time;
  bool has_offset = false;  ///< it ended in Z or an offset such as +02:00; otherwise it is taken as UTC
};

/// ISO 8601: a date YYYY-MM-DD, T or one blank, hh:mm[:ss[.fraction]] and perhaps Z, +hh, +hhmm or +hh:mm;
/// also without - and : (YYYYMMDDThhmmss). A date YYYY-MM-DD alone is its midnight. A second 60 is the first
/// of the next minute. Days must exist.
std::optional<DateTime> parse_date_time(std::string_view text);

}  // namespace kinesphere::program
