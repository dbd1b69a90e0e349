// Flight logs of gliders (IGC): the fixes of B records.
#include <fmt/format.h>

#include <algorithm>

#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/clock_days.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/tables/row_reader.hpp"

namespace kinesphere::program {
namespace {

class IgcReader {
 public:
  explicit IgcReader(const RecordingText& recording)
      : lines_(recording.text), file_(recording.file), geometric_(recording.geometric) {}

  RowTable read() {
    while (const auto line = lines_.next()) {
      if (line->starts_with("HFDTE")) read_date(*line);
      if (line->starts_with('B')) read_fix(*line);
    }
    if (fixes_.empty())
      throw ProgramError(fmt::format("{}: expected B records with a fix in 3D, but there are none", file_));
    // Recorders without a sensor of pressure write 0.
    const bool has_pressure =
        std::ranges::any_of(fixes_, [](const IgcFix& fix) { return fix.pressure_altitude != 0.0; });
    const bool by_pressure = has_pressure && !geometric_;
    RowTable table(by_pressure ? "IGC (barometric altitude)" : "IGC (altitude of satellite navigation)",
                   {"id", "time", "lon", "lat", "alt"});
    table.is_one_body = true;
    const std::string id = id_of_file(file_);
    for (const IgcFix& fix : fixes_)
      table.add_row(fix.line, id, fix.time, fix.longitude, fix.latitude,
                    by_pressure ? fix.pressure_altitude : fix.altitude);
    if (invalid_ > 0)
      table.warnings.push_back(
          fmt::format("{}: B records without a fix in 3D are left out: {}", file_, invalid_));
    return table;
  }

 private:
  struct IgcFix {
    std::string time;
    double longitude, latitude, pressure_altitude, altitude;
    std::size_t line;
  };

  /// `first` and `last` are columns, from 1.
  [[noreturn]] void fail(std::string_view expected, std::size_t first, std::size_t last,
                         std::string_view got) const {
    throw ProgramError(fmt::format("{}:{}: expected {} (columns {} to {}), but got {}", file_, lines_.line(),
                                   expected, first, last, shown_field(got)));
  }

  /// HFDTE280724, or HFDTEDATE:280724,01.
  void read_date(std::string_view line) {
    const std::size_t begin = std::min(line.find_first_of("0123456789"), line.size());
    const auto date = logged_date(line.substr(begin, 6));
    if (!date) fail("a date, ddmmyy", begin + 1, begin + 6, line.substr(begin));
    // A header that is repeated must not set the clock back.
    if (!days_) days_.emplace(*date);
  }

  void read_fix(std::string_view line) {
    if (!days_)
      throw ProgramError(
          fmt::format("{}:{}: expected a date (a record HFDTE) before the first fix", file_, lines_.line()));
    constexpr std::size_t least = 35;
    if (line.size() < least) fail("a whole B record", 1, least, line);
    const auto clock = logged_clock(line.substr(1, 6));
    if (!clock) fail("a time of day, hhmmss", 2, 7, line.substr(1, 6));
    const auto latitude = angle(line.substr(7, 7), line.substr(14, 1), "NS");
    if (!latitude) fail("a latitude, ddmmmmm and N or S", 8, 15, line.substr(7, 8));
    const auto longitude = angle(line.substr(15, 8), line.substr(23, 1), "EW");
    if (!longitude) fail("a longitude, dddmmmmm and E or W", 16, 24, line.substr(15, 9));
    const auto pressure = parse_number(line.substr(25, 5)), height = parse_number(line.substr(30, 5));
    if (!pressure) fail("an altitude by pressure", 26, 30, line.substr(25, 5));
    if (!height) fail("an altitude", 31, 35, line.substr(30, 5));
    const std::string time = logged_time(days_->day_of(*clock), *clock);
    if (line[24] != 'A') {
      ++invalid_;
      return;
    }
    fixes_.push_back({time, *longitude, *latitude, *pressure, *height, lines_.line()});
  }

  /// Returns degrees of minutes with three decimals and no point.
  static std::optional<double> angle(std::string_view digits, std::string_view letter,
                                     std::string_view letters) {
    if (letters.find(letter) == std::string_view::npos) return std::nullopt;
    const std::size_t point = digits.size() - 3;
    return degrees_and_minutes(fmt::format("{}.{}", digits.substr(0, point), digits.substr(point)), letter);
  }

  LineCutter lines_;
  const std::string& file_;
  bool geometric_;
  std::optional<PassingDays> days_;
  std::vector<IgcFix> fixes_;
  std::size_t invalid_ = 0;
};

}  // namespace

bool is_igc(std::string_view text) {
  const std::string_view head = text.substr(0, 4096);
  return (head.starts_with("A") && head.find("\nHFDTE") != std::string_view::npos) ||
         head.starts_with("HFDTE");
}

RowTable read_igc(const RecordingText& recording) { return IgcReader(recording).read(); }

}  // namespace kinesphere::program
