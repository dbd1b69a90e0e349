// Dates, times of day and angles as loggers write them: ddmmyy, hhmmss, ddmm.mmm.
#include "formats/fields/clock_days.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/number_text.hpp"
#include "formats/fields/time_text.hpp"

namespace kinesphere::program {
namespace {

/// Returns the number of two digits at a place; -1 where there are none.
int two_digits(std::string_view text, std::size_t at) {
  if (text.size() < at + 2) return -1;
  const char tens = text[at], ones = text[at + 1];
  const bool are_digits = '0' <= tens && tens <= '9' && '0' <= ones && ones <= '9';
  return are_digits ? 10 * (tens - '0') + (ones - '0') : -1;
}

}  // namespace

std::optional<LoggedClock> logged_clock(std::string_view digits) {
  const int hour = two_digits(digits, 0), minute = two_digits(digits, 2), second = two_digits(digits, 4);
  if (hour < 0 || hour > 23 || minute < 0 || minute > 59 || second < 0 || second > 60) return std::nullopt;
  const std::string_view decimals = digits.substr(6);
  if (!decimals.empty() && (decimals.size() < 2 || decimals.front() != '.' ||
                            decimals.find_first_not_of("0123456789", 1) != std::string_view::npos))
    return std::nullopt;
  const double fraction = decimals.empty() ? 0.0 : *parse_number("0" + std::string(decimals));
  return LoggedClock{3600.0 * hour + 60.0 * minute + second + fraction,
                     fmt::format("{:02}:{:02}:{:02}{}", hour, minute, second, decimals)};
}

std::optional<std::chrono::sys_days> logged_date(std::string_view digits) {
  const int day = two_digits(digits, 0), month = two_digits(digits, 2), year = two_digits(digits, 4);
  if (digits.size() != 6 || day < 0 || month < 0 || year < 0) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(year_of_two_digits(year)),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  return date.ok() ? std::optional(std::chrono::sys_days(date)) : std::nullopt;
}

std::string logged_time(std::chrono::sys_days day, const LoggedClock& clock) {
  const std::chrono::year_month_day date(day);
  return fmt::format("{:04}-{:02}-{:02}T{}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), clock.text);
}

std::chrono::sys_days PassingDays::day_of(const LoggedClock& clock) {
  constexpr double half_a_day = 43'200.0;
  if (last_ && clock.second < *last_ - half_a_day) day_ += std::chrono::days(1);
  last_ = clock.second;
  return day_;
}

std::optional<double> degrees_and_minutes(std::string_view text, std::string_view hemisphere) {
  const auto number = parse_number(text);
  const std::size_t letter = std::string_view("NESW").find(hemisphere);
  if (!number || *number < 0.0 || hemisphere.size() != 1 || letter == std::string_view::npos)
    return std::nullopt;
  const double whole = std::floor(*number / 100.0), minutes = *number - 100.0 * whole;
  if (!(minutes < 60.0)) return std::nullopt;
  const double degrees = whole + minutes / 60.0;
  return letter < 2 ? degrees : -degrees;
}

}  // namespace kinesphere::program
