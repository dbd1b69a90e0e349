// The subcommands for scenes: run, replay, verify and scenes.
#pragma once

#include <vector>

#include "command_line.hpp"

namespace kinesphere::program {

std::vector<Command> add_scene_commands(CLI::App& app);

/// `kinesphere scenes` lists the built-in scenes, one in a line.
CLI::App* add_scenes_command(CLI::App& program);
/// Returns the exit code.
int list_scenes();

}  // namespace kinesphere::program
