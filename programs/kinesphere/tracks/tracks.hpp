// `kinesphere tracks`: finds close approaches in a track set of real motion.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tracks/approach_choice.hpp"
#include "tracks/error_option.hpp"
#include "tracks/reading_policy.hpp"

namespace kinesphere::program {

struct TracksOptions {
  std::vector<std::string> files;
  std::string distance;    ///< a number, and perhaps a unit
  std::string separation;  ///< sphere:LENGTH or cylinder:LENGTH:LENGTH, instead of `distance`
  std::optional<double> tolerance;
  ErrorOptions errors;
  TrackOptions reading;
  ApproachChoice choice;
  std::string contacts, minima, pairs, plot, summary;  ///< files to write; empty for none
  bool verify = false;
  bool quiet = false;
};

/// `options` must live until the command line has been parsed.
CLI::App* add_tracks_command(CLI::App& program, TracksOptions& options);
/// Returns the exit code. Throws ProgramError.
int tracks(const TracksOptions& options);

}  // namespace kinesphere::program
