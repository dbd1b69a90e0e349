// The frame of all programs: parses the command line, prints help, turns errors into one line and an exit
// code.
#pragma once

#include <functional>
#include <string>
#include <vector>

// Its header takes longer to compile than most sources.
namespace CLI {
class App;
}

namespace kinesphere::program {

/// A subcommand and what runs it, which returns the exit code.
struct Command {
  const CLI::App* parsed;
  std::function<int()> run;
};

/// A program with subcommands.
struct Program {
  std::string name;
  std::string description;
  std::string footer;  ///< of its help
  /// Each adds some of the subcommands.
  std::vector<std::function<std::vector<Command>(CLI::App&)>> add_commands;
};

/// Parses the command line and runs the command that it has. To be used as the body of main(). Returns the
/// exit code; exit_wrong_input, with a message on standard error, for a ProgramError, a command line that is
/// invalid or has no command, or exhausted memory.
int run_program(const Program& program, int argc, char** argv);

/// Adds a command that says that this build is without it.
Command add_left_out_command(CLI::App& app, const std::string& name);

}  // namespace kinesphere::program
