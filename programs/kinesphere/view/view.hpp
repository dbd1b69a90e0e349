// `kinesphere view`: shows the viewer in a browser, with the given files.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "tracks/reading_policy.hpp"

namespace kinesphere::program {

struct ViewOptions {
  std::vector<std::string> files;  ///< a recording of a world, or tables of positions; may be empty
  TrackOptions reading;            ///< options for tables
  std::string reading_option;      ///< the name of one of those that was given; empty: there was none
  std::string folder;              ///< empty: where the viewer has been built or installed
  int port = 0;                    ///< 0: any that is free
  bool no_browser = false;
};

/// `options` must live until the command line has been parsed.
CLI::App* add_view_command(CLI::App& program, ViewOptions& options);
/// Serves until the process is asked to stop (SIGINT, SIGTERM); returns the exit code. Throws ProgramError.
int view(const ViewOptions& options);

}  // namespace kinesphere::program
