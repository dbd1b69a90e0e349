// Track points of OziExplorer (PLT), which the recordings of GeoLife have, too: one body each file.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/clock_days.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/tables/row_reader.hpp"

namespace kinesphere::program {
namespace {

/// Returns the date of days since the end of 1899. They are rounded, by up to 5 ms where they have 7
/// decimals, so that times next to a whole second are that second.
std::string date_of(double days) {
  using namespace std::chrono;
  constexpr auto first = sys_days(year(1899) / December / 30);
  constexpr std::int64_t rounding = 10;
  const std::int64_t rounded = std::llround(days * 86'400e3), second = (rounded + 500) / 1000 * 1000;
  const milliseconds since_first(std::abs(rounded - second) < rounding ? second : rounded);
  const auto whole = floor<std::chrono::days>(since_first);
  const hh_mm_ss clock(since_first - whole);
  return logged_time(first + whole, {0.0, fmt::format("{:02}:{:02}:{:02}.{:03}", clock.hours().count(),
                                                      clock.minutes().count(), clock.seconds().count(),
                                                      clock.subseconds().count())});
}

}  // namespace

bool is_plt(std::string_view text) {
  return text.starts_with("OziExplorer Track Point File") || text.starts_with("Geolife trajectory");
}

RowTable read_plt(const RecordingText& recording) {
  constexpr std::size_t line_of_datum = 2, lines_of_header = 6;
  RowTable table("PLT", {"id", "time", "lat", "lon", "alt_ft"});
  table.is_one_body = true;
  const std::string id = id_of_file(recording.file);
  LineCutter lines(recording.text);
  while (const auto line = lines.next()) {
    const auto fail = [&](std::string_view expected) -> ProgramError {
      return ProgramError(fmt::format("{}:{}: expected {}, but got {}", recording.file, lines.line(),
                                      expected, shown_field(*line)));
    };
    if (lines.line() == line_of_datum && !trimmed(*line).starts_with("WGS 84"))
      throw fail("places of WGS 84 (gpsbabel -i ozi -f FILE -o gpx -F FILE.gpx converts others)");
    if (lines.line() <= lines_of_header || trimmed(*line).empty()) continue;
    const auto fields = fields_of(*line, ',');
    constexpr std::size_t latitude = 0, longitude = 1, height = 3, days = 4, fewest = 5;
    const auto date = fields.size() < fewest ? std::nullopt : parse_number(fields[days]);
    // Less than the year 2200. Points of a route have the day 0.
    if (!date || !(*date > 0.0 && *date < 110'000.0))
      throw fail("latitude, longitude, break, height, days since 1899");
    // -777 is that of a point without height.
    const bool has_height = parse_number(fields[height]) != -777.0;
    table.add_row(lines.line(), id, date_of(*date), fields[latitude], fields[longitude],
                  has_height ? fields[height] : "");
  }
  table.use_heights_of_all(recording.file);
  return table;
}

}  // namespace kinesphere::program
