// Feeds of GTFS-realtime as JSON: where the vehicles of public transport are.
#include <map>
#include <utility>

#include "base/ascii_text.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/tables/json_rows.hpp"

namespace kinesphere::program {

bool is_gtfs(std::string_view text) {
  const std::string plain = plain_name(text.substr(0, 4096));
  const bool is_json = plain.find_first_of("{[") == plain.find_first_not_of("\t\r\n");
  return is_json && plain.find("\"gtfsrealtimeversion\"") != plain.npos;
}

/// Who asks again and again gets positions several times, which count once.
RowTable read_gtfs(const RecordingText& recording) {
  RowTable table("GTFS-realtime", {"id", "time", "lon", "lat", "speed_m/s", "course"});
  std::map<std::string, std::array<std::string, 3>> last;
  std::size_t untimed = 0;
  for_each_object(recording.file, recording.text, [&](simdjson::dom::element feed, std::size_t line) {
    const std::string now = text_at(feed, "header/timestamp");
    simdjson::dom::array entities;
    if (feed["entity"].get(entities)) return;
    for (const simdjson::dom::element entity : entities) {
      const auto vehicle = member(entity, "vehicle");
      std::array<std::string, 3> place{text_at(vehicle, "timestamp"), text_at(vehicle, "position/longitude"),
                                       text_at(vehicle, "position/latitude")};
      if (place[1].empty() || place[2].empty()) continue;
      std::string id;
      for (const char* const name : {"vehicle/id", "vehicle/label", "vehicle/license_plate"})
        if (id.empty()) id = text_at(vehicle, name);
      if (id.empty()) id = text_at(entity, "id");
      // The time of the feed is that of no measurement, and at least a bound for it.
      untimed += place[0].empty() ? 1 : 0;
      if (place[0].empty()) place[0] = now;
      if (last[id] == place) continue;
      table.add_row(line, id, place[0], place[1], place[2], text_at(vehicle, "position/speed"),
                    text_at(vehicle, "position/bearing"));
      last[id] = std::move(place);
    }
  });
  if (untimed > 0)
    table.warnings.push_back(
        fmt::format("{}: positions without a time have that of their feed: {}", recording.file, untimed));
  return table;
}

}  // namespace kinesphere::program
