// Tables of pNEUMA: a vehicle in each row, with groups of a place and a time.
#include <fmt/format.h>

#include <algorithm>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"

namespace kinesphere::program {
namespace {

constexpr std::string_view pneuma_names[] = {"track_id", "type",  "traveled_d", "avg_speed", "lat",
                                             "lon",      "speed", "lon_acc",    "lat_acc",   "time"};

}  // namespace

bool is_pneuma(std::string_view text) {
  return std::ranges::equal(fields_of(text.substr(0, text.find('\n')), ';'), pneuma_names);
}

RowTable read_pneuma(const RecordingText& recording) {
  constexpr std::size_t first = 4, group = 6;
  constexpr std::size_t latitude = 0, longitude = 1, speed = 2, time = 5;
  RowTable table("pNEUMA", {"id", "time_s", "lon", "lat", "speed_kmh", "type"});
  LineCutter lines(recording.text);
  lines.next();
  while (const auto line = lines.next()) {
    auto fields = fields_of(*line, ';');
    while (!fields.empty() && fields.back().empty()) fields.pop_back();
    if (fields.empty()) continue;
    if (fields.size() < first + group || (fields.size() - first) % group != 0)
      throw ProgramError(
          fmt::format("{}:{}: expected {} fields of a vehicle and {} of each of its places, but got {}{}",
                      recording.file, lines.line(), first, group, fields.size(),
                      lines.has_end() ? "" : " in the last line, which may be cut off"));
    for (std::size_t k = first; k < fields.size(); k += group)
      table.add_row(lines.line(), fields[0], fields[k + time], fields[k + longitude], fields[k + latitude],
                    fields[k + speed], fields[1]);
  }
  return table;
}

}  // namespace kinesphere::program
