// `kinesphere watch`: reports certain facts about the separation of tracks in a stream.
#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/ids/identities.hpp"
#include "formats/streams/report_format.hpp"

namespace kinesphere::program {

struct WatchOptions {
  std::string file = "-";
  std::vector<std::string> more_files;  ///< that are refused
  FormatChoices choices;
  std::vector<std::string> separations;
  std::string look_ahead, confirm, hold;
  std::string own;
  IdentityChoice ids;
  bool distinct_ids = false;
  std::string rest;
  std::vector<std::string> only, areas;
  std::optional<std::uint64_t> most_alerts;
  std::optional<int> dimensions;
  std::string acceleration, largest_speed;
  std::vector<std::string> classes;
  bool no_classes = false;
  std::string position_error, velocity_error, stamp_error;
  std::string silence, forget, leap;
  std::string clock = "stream";
  std::string origin, radius;
  std::optional<std::size_t> most_malformed;
  std::optional<std::size_t> most_tracks, most_pairs;
  std::string snapshot, snapshot_every;
  std::string alerts;  ///< empty: standard output
  std::string share;
  std::string summary;
  std::string plot;
  std::optional<int> serve;
  bool text = false;
  bool quiet = false;
  const CLI::App* command = nullptr;  ///< which has them as they were given
};

/// `options` must live until the command line has been parsed.
CLI::App* add_watch_command(CLI::App& program, WatchOptions& options);
/// Watches until the stream ends or the process is asked to stop (SIGINT, SIGTERM, SIGHUP); returns the exit
/// code. Throws ProgramError.
int watch(const WatchOptions& options);

}  // namespace kinesphere::program
