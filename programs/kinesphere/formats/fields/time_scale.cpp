// Converts the times of a file to those of the computation, and back.
#include "formats/fields/time_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace kinesphere::program {
namespace {

/// A number with a fixed number of decimals, without trailing zeros.
struct Decimal {
  std::int64_t whole;
  std::string decimals;  ///< with the point before them; empty for none
};

/// Fraction in [0, 1).
Decimal rounded(std::int64_t whole, double fraction, int decimals) {
  std::string text = fmt::format("{:.{}f}", fraction, decimals);
  if (text.front() == '1') ++whole;
  text.erase(0, 1);
  text.erase(text.find_last_not_of('0') + 1);
  if (text == ".") text.clear();
  return {whole, text};
}

/// Returns how many decimals of a number of this size are exact.
int certain_decimals(double size) {
  return std::clamp(14 - static_cast<int>(std::floor(std::log10(std::max(std::abs(size), 1e-300)))), 0, 17);
}

std::string number_text(const Decimal& number) {
  if (number.whole >= 0 || number.decimals.empty()) return fmt::format("{}{}", number.whole, number.decimals);
  // For example, -2 + 0.75 is -1.25.
  const int decimals = static_cast<int>(number.decimals.size()) - 1;
  const Decimal positive = rounded(-number.whole - 1, 1.0 - std::stod("0" + number.decimals), decimals);
  return fmt::format("-{}{}", positive.whole, positive.decimals);
}

std::string date_text(const Decimal& time, bool utc) {
  using namespace std::chrono;
  const sys_seconds whole{seconds(time.whole)};
  const auto day = floor<days>(whole);
  const year_month_day date(day);
  const hh_mm_ss clock(whole - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}{}{}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count(), time.decimals,
                     utc ? "Z" : "");
}

}  // namespace

void TimeScale::set_origin(const FileTime& first, const FileTime& last) {
  const double span = static_cast<double>(last.whole - first.whole) + 1.0;
  std::int64_t step = 1;
  while (static_cast<double>(step) < 64.0 * span && step < (std::int64_t{1} << 60)) step *= 2;
  // Rounds down, also for negative numbers.
  origin_ = first.whole - ((first.whole % step) + step) % step;
}

double TimeScale::seconds(const FileTime& time) const {
  const auto whole = static_cast<double>(time.whole - origin_);
  const double sum = whole + time.fraction;
  // The result is rounded as if the file's number had been rounded once.
  const double lost = time.fraction - (sum - whole);
  return (sum + (lost + time.rest)) * unit_ / rate_;
}

std::string TimeScale::shortest(double seconds) const {
  const double own = seconds * rate_ / unit_;
  for (int digits = 15; digits <= 16; ++digits) {
    std::string text = fmt::format("{:.{}g}", own, digits);
    const auto time = parse_decimal_time(text);
    if (time && this->seconds(*time) == seconds) return text;
  }
  return fmt::format("{}", own);
}

std::string TimeScale::text(double seconds, int most_decimals) const {
  const bool frames = kind_ == TimeKind::frames;
  if (is_number() && (frames || origin_ == 0)) {
    const double own =
        frames ? static_cast<double>(origin_) * unit_ / rate_ + seconds : seconds * rate_ / unit_;
    if (most_decimals >= 17) return frames ? fmt::format("{}", own) : shortest(seconds);
    const double whole = std::floor(own);
    if (std::abs(whole) < 0x1p61)
      return number_text(rounded(static_cast<std::int64_t>(whole), own - whole, most_decimals));
  }
  const double own = seconds * rate_ / unit_;
  const double whole = std::floor(own);
  const int decimals = std::min({certain_decimals(own), is_number() ? 17 : 9, most_decimals});
  const Decimal time = rounded(origin_ + static_cast<std::int64_t>(whole), own - whole, decimals);
  return is_number() ? number_text(time) : date_text(time, kind_ == TimeKind::utc);
}

std::optional<double> TimeScale::since_1970(double seconds) const {
  const double own = static_cast<double>(origin_) + seconds / unit_;
  if (!is_number()) return own;
  constexpr double earliest = 1e8;  // in 1973
  if (kind_ != TimeKind::number || unit_ != 1.0 || rate_ != 1.0 || own < earliest) return std::nullopt;
  return own;
}

Moment moment_of(const TimeScale& times, double seconds) {
  const auto since_1970 = times.since_1970(seconds);
  if (!since_1970) return {{}, times.text(seconds, 1)};
  if (!times.is_number()) {
    const std::string text = times.text(seconds, 0);
    const std::size_t day = text.find('T');
    return {text.substr(0, day), text.substr(day + 1)};
  }
  const std::string text = date_text({static_cast<std::int64_t>(std::floor(*since_1970)), {}}, true);
  const std::size_t day = text.find('T');
  return {text.substr(0, day), text.substr(day + 1)};
}

}  // namespace kinesphere::program
