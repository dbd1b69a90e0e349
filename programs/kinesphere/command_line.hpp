// The frame of all programs: parses the command line, prints help, turns errors into one line and an exit
// code.
#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace kinesphere::program {

/// Parses the command line, then calls `run_command`, which must run the command that `app` has parsed, one
/// of those of `app`, and return its exit code. To be used as the body of main(). Returns the exit code;
/// exit_wrong_input, with a message on standard error, for a ProgramError, a command line that is invalid or
/// has no command, or exhausted memory.
int run_program(CLI::App& app, const std::function<int()>& run_command, int argc, char** argv);

}  // namespace kinesphere::program
