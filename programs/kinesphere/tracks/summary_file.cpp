// The summary of `kinesphere tracks` as JSON.
#include "tracks/summary_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/escaped_text.hpp"
#include "tracks/coverage_summary.hpp"
#include "tracks/track_cells.hpp"

namespace kinesphere::program {

std::string summary_json(const std::vector<std::string>& files, const TrackSet& track_set,
                         const TrackScene& scene, const TracksResult& result) {
  std::vector<std::string> names;
  for (const std::string& file : files) names.push_back(json_text(file));
  const Scene& run = scene.scene;
  std::string text =
      fmt::format(R"({{"files": [{}], "format": {}, "ids": {}, "tracks": {}, "rows": {}, "samples": {})",
                  fmt::join(names, ", "), json_text(track_set.format), track_set.presences.size(),
                  track_set.tracks.size(), track_set.rows, track_set.samples);
  text += fmt::format(
      R"(, "filtered": {}, "ignored": {}, "on_ground": {}, "missing": {}, "malformed": {}, "repeated": {}, "duplicates": {}, "echoes": {}, "too_fast": {}, "alone": {})",
      track_set.filtered.count, track_set.ignored.count, track_set.on_ground.count, track_set.missing.count,
      track_set.malformed.count, track_set.repeated.count, track_set.duplicates.count, track_set.echoes.count,
      track_set.too_fast.count, track_set.left_out);
  text += fmt::format(R"(, "from": {}, "until": {}, "span_s": {})",
                      json_of_time(track_set.times, run.world.start_time),
                      json_of_time(track_set.times, run.end_time), run.end_time - run.world.start_time);
  text += fmt::format(
      R"(, "approaches": {}, "left_out_by_ids": {}, "left_out_by_duration": {}, "probes": {})",
      result.approaches.size(), result.left_out.by_ids, result.left_out.by_duration, result.probes);
  text += fmt::format(R"(, "certain": {})", std::ranges::count_if(result.approaches, &Approach::is_certain));
  text += ", " + json_of_handovers(track_set, result.of_one_body);
  text += fmt::format(R"(, "outside": "{}", {})", name_of(track_set.outside),
                      json_members_of(result.vanishings, track_set));
  return text + fmt::format(", {}, \"hash\": \"{:016x}\"}}\n", json_members_of(result.coverage, track_set),
                            result.hash);
}

}  // namespace kinesphere::program
