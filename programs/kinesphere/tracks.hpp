// `kinesphere tracks`: who came close to whom in a recording of real motion.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "kinesphere/scene.hpp"
#include "track_file.hpp"

namespace kinesphere::program {

struct TracksOptions {
  std::string file;
  double distance = 0.0;
  std::optional<double> tolerance;
  TrackOptions reading;
  std::string contacts;
  bool verify = false;
  bool quiet = false;
};

/// `options` must live until the command line has been parsed.
CLI::App* add_tracks_command(CLI::App& program, TracksOptions& options);
/// Returns the exit code. Throws ProgramError.
int tracks(const TracksOptions& options);

/// The recording as a scene: each track is a body of half the distance as radius, which is there from its
/// first sample to its last, so that a contact is an approach. Throws ProgramError naming `file`.
Scene scene_of(const Recording& recording, const std::string& file, double distance, double tolerance);

}  // namespace kinesphere::program
