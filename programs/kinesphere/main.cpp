// The command line of Kinesphere: one subcommand for each use.
#include "command_line.hpp"
#include "recording_commands.hpp"
#include "scenes/scene_commands.hpp"

int main(int argc, char** argv) {
  using namespace kinesphere::program;
  return run_program(
      {.name = "kinesphere",
       .description = "Kinesphere: every collision among moving spheres, without time steps.",
       .footer =
           "Exit status: 0, whether there are approaches and alerts or not; 1 if two answers differ that "
           "should not (--verify, verify, replay); 2 on wrong input, with one line that says what was "
           "expected.",
       .add_commands = {add_scene_commands, add_recording_commands}},
      argc, argv);
}
