// The subcommands of the program: one for each use.
#include "commands.hpp"

#include <CLI/CLI.hpp>

#include "command_line.hpp"
#include "scenes/list_scenes.hpp"
#include "scenes/replay.hpp"
#include "scenes/run.hpp"
#include "scenes/verify.hpp"
#include "tracks/tracks.hpp"
#include "view/view.hpp"
#include "watch/watch.hpp"

namespace kinesphere::program {

int run_kinesphere(int argc, char** argv) {
  CLI::App app("Kinesphere: every collision among moving spheres, without time steps.", "kinesphere");
  app.footer(
      "Exit status: 0, whether there are approaches and alerts or not; 1 if two answers differ that should "
      "not (--verify, verify, replay); 2 on wrong input, with one line that says what was expected.");
  RunOptions run_options;
  ReplayOptions replay_options;
  TracksOptions tracks_options;
  VerifyOptions verify_options;
  ViewOptions view_options;
  WatchOptions watch_options;
  const CLI::App& run = *add_run_command(app, run_options);
  const CLI::App& replay = *add_replay_command(app, replay_options);
  const CLI::App& tracks = *add_tracks_command(app, tracks_options);
  const CLI::App& verify = *add_verify_command(app, verify_options);
  const CLI::App& scenes = *add_scenes_command(app);
  const CLI::App& view = *add_view_command(app, view_options);
  add_watch_command(app, watch_options);
  const auto run_command = [&] {
    if (run) return program::run(run_options);
    if (replay) return program::replay(replay_options);
    if (tracks) return program::tracks(tracks_options);
    if (verify) return program::verify(verify_options);
    if (scenes) return list_scenes();
    if (view) return program::view(view_options);
    return program::watch(watch_options);
  };
  return run_program(app, run_command, argc, argv);
}

}  // namespace kinesphere::program
