// The subcommands for scenes: run, replay, verify and scenes.
#pragma once

#include <vector>

#include "command_line.hpp"

namespace kinesphere::program {

std::vector<Command> add_scene_commands(CLI::App& app);

}  // namespace kinesphere::program
