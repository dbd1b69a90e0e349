// Recorded motion from text files: who was where at which times.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinesphere/motion/recorded_tracks.hpp"
#include "track_columns.hpp"

namespace kinesphere::program {

/// How a recording is read.
struct TrackOptions {
  TrackHints hints;
  /// A longer time between two samples of one id splits them into two tracks. Default: 2.5 times the median
  /// time between consecutive samples of one id, over the whole file.
  std::optional<double> max_gap;
};

struct RecordedTrack {
  std::string id;                    ///< as in the file; 3.0 and 3.000000e+00 are 3
  std::vector<TrackSample> samples;  ///< at least 2, by time
};

struct Recording {
  TrackColumns columns;
  std::vector<RecordedTrack> tracks;  ///< without interruption, by the first sample's place in the file
  std::size_t ids = 0;
  std::size_t samples = 0;       ///< in all tracks
  std::size_t left_out = 0;      ///< samples that were alone between two gaps
  double sample_interval = 0.0;  ///< the median
  double max_gap = 0.0;
};

/// Throws ProgramError naming file, line and expectation: a field that is no finite number, two samples of
/// one id at one time, a file without any track.
Recording parse_tracks(std::string text, const std::string& file, const TrackOptions& options);
/// Plain or gzipped.
Recording read_tracks(const std::string& file, const TrackOptions& options);

}  // namespace kinesphere::program
