// The subcommands for recordings and streams of what has moved: tracks, view and watch.
#pragma once

#include <vector>

#include "command_line.hpp"

namespace kinesphere::program {

/// A program that was built for scenes alone has them, too, to say that they are left out.
std::vector<Command> add_recording_commands(CLI::App& app);

}  // namespace kinesphere::program
