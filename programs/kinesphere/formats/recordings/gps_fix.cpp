// The fix that a sentence RMC of a receiver of satellite navigation gives.
#include "formats/recordings/gps_fix.hpp"

#include <cmath>

#include "base/number_text.hpp"
#include "formats/fields/clock_days.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/nmea/nmea_line.hpp"
#include "formats/recordings/recording_kinds.hpp"

namespace kinesphere::program {

std::optional<GpsFix> gps_fix_in(std::string_view line) {
  const std::size_t begin = line.find('$');
  if (begin == std::string_view::npos || line.size() < begin + 7 || line.substr(begin + 3, 4) != "RMC,")
    return std::nullopt;
  const CheckedText split = split_checksum(line.substr(begin + 1));
  if (split.said && !split.is_whole()) return std::nullopt;
  // Time, validity, latitude and N or S, longitude and E or W, speed, course, date.
  const auto fields = fields_of(split.content, ',');
  if (fields.size() < 10 || fields[2] != "A") return std::nullopt;
  const auto clock = logged_clock(fields[1]);
  const auto day = logged_date(fields[9]);
  const auto latitude = degrees_and_minutes(fields[3], fields[4]);
  const auto longitude = degrees_and_minutes(fields[5], fields[6]);
  if (!clock || !day || !latitude || !longitude || std::abs(*latitude) > 90.0 || std::abs(*longitude) > 180.0)
    return std::nullopt;
  const double whole = std::floor(clock->second);
  return GpsFix{
      .time = {86'400 * std::int64_t{day->time_since_epoch().count()} + static_cast<std::int64_t>(whole),
               clock->second - whole},
      .longitude = *longitude,
      .latitude = *latitude,
      .speed = parse_number(fields[7]),
      .course = parse_number(fields[8])};
}

}  // namespace kinesphere::program
