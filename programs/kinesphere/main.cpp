// The command line of Kinesphere: one subcommand for each use.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <sstream>
#include <string>

#include "bench/bench.hpp"
#include "kinesphere/version.hpp"
#include "list_scenes.hpp"
#include "program_error.hpp"
#include "replay.hpp"
#include "run.hpp"
#include "standard_output.hpp"
#include "standard_streams.hpp"
#include "tracks.hpp"
#include "verify.hpp"
#include "view.hpp"
#include "watch.hpp"

namespace kinesphere::program {
namespace {

int complain(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  print_message("kinesphere: {}\n", message);
  return exit_wrong_input;
}

int main(int argc, char** argv) {
  CLI::App app("Kinesphere: every collision among moving spheres, without time steps.", "kinesphere");
  app.set_version_flag("--version", std::string(version));
  app.require_subcommand(0, 1);
  RunOptions run_options;
  ReplayOptions replay_options;
  VerifyOptions verify_options;
  TracksOptions tracks_options;
  ViewOptions view_options;
  WatchOptions watch_options;
  BenchCommands bench_commands;
  const CLI::App* const run_command = add_run_command(app, run_options);
  const CLI::App* const replay_command = add_replay_command(app, replay_options);
  const CLI::App* const tracks_command = add_tracks_command(app, tracks_options);
  const CLI::App* const verify_command = add_verify_command(app, verify_options);
  const CLI::App* const scenes_command = add_scenes_command(app);
  const CLI::App* const view_command = add_view_command(app, view_options);
  const CLI::App* const watch_command = add_watch_command(app, watch_options);
  const CLI::App* const bench_command = add_bench_command(app, bench_commands);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    std::ostringstream text;
    const int exit_code = app.exit(help, text, text);
    write_output(text.str());
    finish_output();
    return exit_code;
  } catch (const CLI::ParseError& error) {
    return complain(fmt::format("{} (see --help)", error.what()));
  }
  const auto finished = [](int exit_code) {
    finish_output();
    if (exit_code == exit_fine) check_messages();
    return exit_code;
  };
  if (*run_command) return finished(run(run_options));
  if (*replay_command) return finished(replay(replay_options));
  if (*tracks_command) return finished(tracks(tracks_options));
  if (*verify_command) return finished(verify(verify_options));
  if (*scenes_command) return finished(list_scenes());
  if (*view_command) return finished(view(view_options));
  if (*watch_command) return finished(watch(watch_options));
  if (*bench_command) return finished(bench(*bench_command, bench_commands));
  throw ProgramError(
      "expected a command: run, replay, tracks, verify, scenes, view, watch or bench (see --help)");
}

}  // namespace
}  // namespace kinesphere::program

int main(int argc, char** argv) {
  using namespace kinesphere::program;
  try {
    reserve_standard_streams();
    return kinesphere::program::main(argc, argv);
  } catch (const ProgramError& error) {
    return complain(error.what());
  } catch (const std::bad_alloc&) {
    return complain("out of memory");
  }
}
