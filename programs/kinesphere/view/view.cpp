// `kinesphere view`: serves the viewer and the files to show, for this machine alone, and opens a browser.
#include "view/view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <vector>

#include "base/help_text.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "serving/built_pages.hpp"
#include "serving/local_server.hpp"
#include "tracks/reading_options.hpp"
#include "view/opened_files.hpp"

namespace kinesphere::program {
namespace {

const char* const viewer_page = "index.html";

std::string viewer_folder(const std::string& chosen) {
  if (!chosen.empty()) {
    if (has_page(chosen, viewer_page)) return chosen;
    throw ProgramError(
        fmt::format("--folder: expected a folder with {}, but {} has none", viewer_page, chosen));
  }
  if (const auto folder = folder_with_page(viewer_page)) return folder->string();
  std::vector<std::string> tried;
  for (const auto& folder : page_folders()) tried.push_back(folder.string());
  throw ProgramError(fmt::format("view: expected the viewer in one of {}; to build it: {}",
                                 fmt::join(tried, ", "), build_pages_command));
}

/// `opened` must live as long as the server.
void serve(LocalServer& server, const OpenedFiles& opened) {
  server.serve("/opened/files.json", "application/json", [&opened] { return opened.index(); });
  if (opened.recording)
    server.serve("/opened/recording", "application/octet-stream", opened.recording->content);
  if (opened.tracks) server.serve("/opened/tracks.json", "application/json", opened.tracks->content);
}

void open_browser(const std::string& address) {
  const std::string command = fmt::format("xdg-open {} >/dev/null 2>&1", address);
  if (std::system(command.c_str()) != 0)
    print_message("kinesphere: no browser could be opened: open {} in one\n", address);
}

}  // namespace

CLI::App* add_view_command(CLI::App& program, ViewOptions& options) {
  CLI::App* command =
      program.add_subcommand("view", "Show scenes and recordings in a browser, on this machine alone");
  add_reading_options(*command, options.files, options.reading)
      ->required(false)
      ->description(
          "A recording of `kinesphere run --record`, or text tables of positions as `kinesphere tracks` "
          "reads them; plain or gzipped, - for standard input");
  command->parse_complete_callback(
      [command, &options] { options.reading_option = given_reading_option(*command); });
  command->add_option("--folder", options.folder, "The viewer, if it is another one than was built here");
  command->add_option("--port", options.port, "Port of 127.0.0.1; any that is free when not given")
      ->check(CLI::Range(0, 65535));
  command->add_flag("--no-browser", options.no_browser, "Print the address, and open no browser");
  add_examples(*command, {"kinesphere view", "kinesphere view walk.csv --unit cm",
                          "kinesphere run paper1 --record gas.ksr && kinesphere view gas.ksr"});
  return command;
}

int view(const ViewOptions& options) {
  const std::string folder = viewer_folder(options.folder);
  const OpenedFiles opened = open_files(options.files, options.reading, options.reading_option);
  LocalServer server(
      "--port",
      "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; img-src "
      "'self' data: blob:; font-src 'self' data:; worker-src 'self' blob:; frame-ancestors 'none'");
  if (!server.serve_folder("/", folder))
    throw ProgramError(fmt::format("--folder: {} cannot be read", folder));
  serve(server, opened);
  // Blocked in all threads; this one waits for these signals.
  sigset_t stops;
  sigemptyset(&stops);
  sigaddset(&stops, SIGINT);
  sigaddset(&stops, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &stops, nullptr);
  server.start(options.port);
  // The page requests files only if its address says so, since other servers have none.
  const std::string address = server.address() + (options.files.empty() ? "" : "#opened");
  print("{}\n", address);
  finish_output();
  if (!options.no_browser) open_browser(address);
  int signal = 0;
  sigwait(&stops, &signal);
  return exit_fine;
}

}  // namespace kinesphere::program
