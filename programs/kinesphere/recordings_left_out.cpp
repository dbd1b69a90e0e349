// Replaces recording_commands.cpp in a program that was built for scenes alone (KINESPHERE_BUILD_PROGRAM).
#include "recording_commands.hpp"

namespace kinesphere::program {

std::vector<Command> add_recording_commands(CLI::App& app) {
  return {add_left_out_command(app, "tracks"), add_left_out_command(app, "view"),
          add_left_out_command(app, "watch")};
}

}  // namespace kinesphere::program
