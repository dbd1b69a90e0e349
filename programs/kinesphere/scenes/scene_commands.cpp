#include "scenes/scene_commands.hpp"

#include <memory>

#include "scenes/replay.hpp"
#include "scenes/run.hpp"
#include "scenes/verify.hpp"

namespace kinesphere::program {

std::vector<Command> add_scene_commands(CLI::App& app) {
  const auto run_options = std::make_shared<RunOptions>();
  const auto replay_options = std::make_shared<ReplayOptions>();
  const auto verify_options = std::make_shared<VerifyOptions>();
  return {{add_run_command(app, *run_options), [=] { return run(*run_options); }},
          {add_replay_command(app, *replay_options), [=] { return replay(*replay_options); }},
          {add_verify_command(app, *verify_options), [=] { return verify(*verify_options); }},
          {add_scenes_command(app), list_scenes}};
}

}  // namespace kinesphere::program
