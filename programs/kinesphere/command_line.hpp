// What all programs do around their commands: parse, print help, turn errors into one line and an exit code.
#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace kinesphere::program {

/// The body of main(): parses the command line, then calls `run_command`, which runs the command that `app`
/// has parsed and returns its exit code. Returns the exit code: exit_wrong_input, with a message on standard
/// error, for a ProgramError, for a command line that cannot be parsed and for exhausted memory.
int run_program(CLI::App& app, const std::function<int()>& run_command, int argc, char** argv);

}  // namespace kinesphere::program
