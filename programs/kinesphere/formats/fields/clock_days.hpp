// Dates, times of day and angles as loggers write them: ddmmyy, hhmmss, ddmm.mmm.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace kinesphere::program {

/// A time of day.
struct LoggedClock {
  double second = 0.0;  ///< since midnight
  std::string text;     ///< as hh:mm:ss, with its decimals
};

/// Parses hhmmss with or without decimals; returns nothing for other text.
std::optional<LoggedClock> logged_clock(std::string_view digits);
/// Parses ddmmyy; returns nothing for other text and for days that do not exist.
std::optional<std::chrono::sys_days> logged_date(std::string_view digits);
/// Returns the time as a table has it: 2024-01-31T12:30:15.5Z.
std::string logged_time(std::chrono::sys_days day, const LoggedClock& clock);

/// Follows a clock through the days: it has passed midnight where it falls by half a day or more.
class PassingDays {
 public:
  explicit PassingDays(std::chrono::sys_days first) : day_(first) {}

  /// Sets the day of the next time, which the log says.
  void set(std::chrono::sys_days day) {
    day_ = day;
    last_.reset();
  }
  /// Returns the day of the next time.
  std::chrono::sys_days day_of(const LoggedClock& clock);

 private:
  std::chrono::sys_days day_;
  std::optional<double> last_;  ///< second of the day
};

/// Returns degrees of "ddmm.mmm" or "dddmm.mmm", negative in the south or west, as `hemisphere` says; nothing
/// for other text.
std::optional<double> degrees_and_minutes(std::string_view text, std::string_view hemisphere);

}  // namespace kinesphere::program
