#include "command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <new>
#include <sstream>
#include <string>

#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "base/standard_streams.hpp"
#include "kinesphere/version.hpp"

namespace kinesphere::program {
namespace {

std::string commands_of(const CLI::App& app) {
  const auto commands = app.get_subcommands({});
  std::string text;
  for (std::size_t k = 0; k < commands.size(); ++k)
    text += (k == 0 ? "" : k + 1 < commands.size() ? ", " : " or ") + commands[k]->get_name();
  return text;
}

int parse_and_run(CLI::App& app, const std::vector<Command>& commands, int argc, char** argv) {
  reserve_standard_streams();
  app.set_version_flag("--version", std::string(version));
  app.require_subcommand(0, 1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    std::ostringstream text;
    const int exit_code = app.exit(help, text, text);
    write_output(text.str());
    finish_output();
    return exit_code;
  } catch (const CLI::ExtrasError& error) {
    const std::string_view first = argv[1];
    if (!app.get_subcommands().empty() || first.starts_with('-'))
      throw ProgramError(fmt::format("{} (see --help)", error.what()));
    throw ProgramError(
        fmt::format("there is no command {}: expected {} (see --help)", first, commands_of(app)));
  } catch (const CLI::ParseError& error) {
    throw ProgramError(fmt::format("{} (see --help)", error.what()));
  }
  if (app.get_subcommands().empty() && !app.get_subcommands({}).empty())
    throw ProgramError(fmt::format("expected a command: {} (see --help)", commands_of(app)));
  const auto chosen = std::find_if(commands.begin(), commands.end(),
                                   [](const Command& command) { return static_cast<bool>(*command.parsed); });
  const int exit_code = chosen->run();
  finish_output();
  if (exit_code == exit_fine) check_messages();
  return exit_code;
}

}  // namespace

int run_program(const Program& program, int argc, char** argv) {
  const auto complain = [&program](std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    print_message("{}: {}\n", program.name, message);
    return exit_wrong_input;
  };
  try {
    CLI::App app(program.description, program.name);
    app.footer(program.footer);
    std::vector<Command> commands;
    for (const auto& add : program.add_commands)
      for (Command& command : add(app)) commands.push_back(std::move(command));
    return parse_and_run(app, commands, argc, argv);
  } catch (const ProgramError& error) {
    return complain(error.what());
  } catch (const std::bad_alloc&) {
    return complain("out of memory");
  }
}

Command add_left_out_command(CLI::App& app, const std::string& name) {
  const CLI::App* const command = app.add_subcommand(name, "Not in this build")->prefix_command();
  return {command, [name]() -> int {
            throw ProgramError(fmt::format(
                "this program was built for scenes alone, without {}. All of it: scripts/setup.sh "
                "program && cmake --preset release && cmake --build --preset release",
                name));
          }};
}

}  // namespace kinesphere::program
