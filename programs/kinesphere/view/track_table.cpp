// Writes a track set of real motion as JSON for the viewer's page.
#include "view/track_table.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "base/escaped_text.hpp"
#include "base/program_error.hpp"
#include "scenes/summary.hpp"
#include "tracks/track_scene.hpp"

namespace kinesphere::program {
namespace {

constexpr std::string_view ending = "\n]}\n";

/// fmt writes the shortest decimal number that reads back as the same double.
void add(std::string& text, const RecordedTrack& track) {
  const auto end = std::back_inserter(text);
  fmt::format_to(end, R"({{"id": {}, "times": [)", json_text(track.id));
  const char* separator = "";
  for (const TrackSample& sample : track.samples) {
    fmt::format_to(end, "{}{}", separator, sample.time);
    separator = ",";
  }
  text += R"(], "positions": [)";
  separator = "";
  for (const TrackSample& sample : track.samples) {
    fmt::format_to(end, "{}{},{},{}", separator, sample.position.x, sample.position.y, sample.position.z);
    separator = ",";
  }
  text += "]}";
}

}  // namespace

std::string track_table(const TrackSet& track_set, const std::string& name, std::size_t limit) {
  // The page follows these curves. JSON has no number for an overflow.
  splines_through(track_set);
  std::string text = fmt::format(R"({{"name": {}, "plane": {}, "unit": {}, "tracks": [)", json_text(name),
                                 track_set.is_plane, track_set.in_metres ? R"("m")" : "null");
  const char* separator = "\n";
  for (const RecordedTrack& track : track_set.tracks) {
    text += separator;
    separator = ",\n";
    add(text, track);
    if (text.size() + ending.size() <= limit) continue;
    throw ProgramError(fmt::format(
        "{}: expected tracks that are at most {} bytes as JSON, which is what a browser can read, but its "
        "{} samples are more",
        name, grouped(limit), grouped(track_set.samples)));
  }
  text += ending;
  return text;
}

}  // namespace kinesphere::program
