// `kinesphere view`: shows the viewer in a browser.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace kinesphere::program {

struct ViewOptions {
  std::string folder;  ///< empty: where the viewer has been built or installed
  int port = 0;        ///< 0: any that is free
  bool no_browser = false;
};

/// `options` must live until the command line has been parsed.
CLI::App* add_view_command(CLI::App& program, ViewOptions& options);
/// Serves until the process is asked to stop (SIGINT, SIGTERM); returns the exit code. Throws ProgramError.
int view(const ViewOptions& options);

}  // namespace kinesphere::program
