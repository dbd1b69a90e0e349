// Reads any bytes as a file of tracks, for fuzz_tables and for a test with damaged files.
#include "program/formats/any_table.hpp"

#include <algorithm>

#include "base/program_error.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program {
namespace {

TrackOptions chosen_options(unsigned choice) {
  TrackOptions options;
  options.missing = static_cast<MissingPolicy>(choice % 3);
  options.duplicates = static_cast<DuplicatePolicy>(choice / 3 % 3);
  if (choice % 5 == 0) options.max_speed = 2.0;
  if (choice % 4 == 3) options.hints.format = choice % 8 == 3 ? "ucy" : "eth";
  return options;
}

std::optional<std::string> defect_of(const RecordedTrack& track) {
  const std::vector<TrackSample>& samples = track.samples;
  if (samples.size() < 2) return "a track of fewer than two samples";
  if (!std::all_of(samples.begin(), samples.end(),
                   [](const TrackSample& sample) { return is_finite(sample.position); }))
    return "a sample that is nowhere";
  if (std::adjacent_find(samples.begin(), samples.end(), [](const TrackSample& a, const TrackSample& b) {
        return !(a.time < b.time);
      }) != samples.end())
    return "samples that are not in the order of time";
  return std::nullopt;
}

}  // namespace

AnyTable read_any_table(const std::string& text, unsigned choice) {
  try {
    for (const RecordedTrack& track : parse_tracks({{"t.csv", text}}, chosen_options(choice)).tracks)
      if (auto defect = defect_of(track)) return {true, std::move(defect)};
    return {true};
  } catch (const ProgramError& error) {
    const std::string message = error.what();
    if (!message.starts_with("t.csv:")) return {false, "an error that does not name the file: " + message};
    if (message.find('\n') != std::string::npos) return {false, "an error of several lines: " + message};
    return {};
  }
}

}  // namespace kinesphere::program
