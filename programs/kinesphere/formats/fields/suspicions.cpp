// Finds numbers that may mean something else than they seem.
#include "formats/fields/suspicions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace kinesphere::program {

void TimeCheck::add(const FileTime& time) {
  const std::int64_t clock = time.whole;
  is_clock_ = is_clock_ && clock >= 0 && clock < 240'000 && clock % 100 < 60 && clock / 100 % 100 < 60;
  has_seconds_ = has_seconds_ || clock % 100 != 0;
  first_clock_ = std::min(first_clock_, clock);
  last_clock_ = std::max(last_clock_, clock);
  const double number = static_cast<double>(time.whole) + time.fraction;
  least_ = std::min(least_, number);
  largest_ = std::max(largest_, number);
  // As parts of a day with 8 decimals or more. Few numbers of fewer decimals are whole seconds of a day.
  constexpr double day = 86'400.0, shortest = 1e5;
  const double second = number * day, decimals = number * shortest;
  are_parts_of_days_ = are_parts_of_days_ && std::abs(second - std::round(second)) < 1e-3;
  has_decimals_ = has_decimals_ || std::abs(decimals - std::round(decimals)) > 1e-4;
}

std::string TimeCheck::clock_suspicion() const {
  if (!is_clock_ || !has_seconds_ || last_clock_ < 10'000 || last_clock_ / 100 == first_clock_ / 100)
    return {};
  return fmt::format(
      "the times {} to {} may be those of a clock (hhmmss): write them as in 2024-01-31T12:30:15, or say "
      "--time-unit s if they are seconds",
      first_clock_, last_clock_);
}

std::string TimeCheck::day_suspicion(std::size_t samples) const {
  // 1980 to 2100: of spreadsheets and modified Julian dates, of MATLAB, and Julian dates.
  constexpr struct {
    double first, last;
  } years[] = {{29'220.0, 73'050.0}, {723'181.0, 767'011.0}, {2'444'239.0, 2'488'070.0}};
  const bool may_be_days = std::any_of(std::begin(years), std::end(years), [&](const auto& days) {
    return least_ >= days.first && largest_ <= days.last;
  });
  const double span = largest_ - least_, count = static_cast<double>(samples);
  if (samples < 2 || !(span >= 0.0)) return {};
  if (least_ >= 1970.0 && largest_ <= 2100.0 && span < 1e-4 * count)
    return fmt::format(
        "the times {} to {} may be years: write dates, as in 2024-01-31T12:30:15, or say --time-unit s if "
        "they are seconds",
        least_, largest_);
  // About a minute. Cameras of 120 or 240 frames a second have longer steps, which are whole seconds, too.
  constexpr double longest_step = 7.5e-4;
  const bool are_parts_of_a_day =
      are_parts_of_days_ && has_decimals_ && least_ >= 0.0 && largest_ <= 2.0 && span < longest_step * count;
  if (!are_parts_of_a_day && !(may_be_days && span < 0.01 * count)) return {};
  return fmt::format(
      "the times {} to {} may be days, as spreadsheets, MATLAB and astronomers have them: say --time-unit d, "
      "or s if they are seconds",
      least_, largest_);
}

void DegreeCheck::add(double x, double y) {
  least_x_ = std::min(least_x_, x);
  largest_x_ = std::max(largest_x_, x);
  least_y_ = std::min(least_y_, y);
  largest_y_ = std::max(largest_y_, y);
  all_whole_ = all_whole_ && x == std::floor(x) && y == std::floor(y);
}

std::string DegreeCheck::suspicion() const {
  const double spread = std::max(largest_x_ - least_x_, largest_y_ - least_y_);
  const double offset = std::max(std::abs(least_x_ + largest_x_) / 2, std::abs(least_y_ + largest_y_) / 2);
  // A lower ratio would ask about rooms and roads near their origin; a higher one would miss wide regions.
  constexpr double least_ratio = 8.0, least_offset = 1.0;
  const bool in_range = std::abs(least_x_) <= 180.0 && std::abs(largest_x_) <= 180.0 &&
                        std::abs(least_y_) <= 90.0 && std::abs(largest_y_) <= 90.0;
  if (all_whole_ || !in_range || offset < std::max(least_ratio * spread, least_offset)) return {};
  return fmt::format(
      "x ({:.9g} to {:.9g}) and y ({:.9g} to {:.9g}) may be degrees: say --positions lonlat if x is the "
      "longitude and y the latitude (lon=... and lat=... with --columns where it is the other way round), or "
      "--positions plane if they are lengths",
      least_x_, largest_x_, least_y_, largest_y_);
}

}  // namespace kinesphere::program
