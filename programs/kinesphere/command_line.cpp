#include "command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <new>
#include <sstream>
#include <string>

#include "base/help_text.hpp"
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

/// Returns ": did you mean WORD?" for a word that is nearly one of `known`; empty for another.
std::string question_about(std::string_view word, const std::vector<std::string>& known) {
  const std::string_view meant = meant_word(word, known);
  return meant.empty() ? "" : fmt::format(": did you mean {}?", meant);
}

/// Throws ProgramError naming the first argument that is neither a command nor an option.
[[noreturn]] void refuse_extra(const CLI::App& app, const std::string& first, std::string_view reason) {
  const auto chosen = app.get_subcommands();
  if (chosen.empty() && !first.starts_with('-')) {
    std::vector<std::string> names;
    for (const CLI::App* const command : app.get_subcommands({})) names.push_back(command->get_name());
    const std::string question = question_about(first, names);
    throw ProgramError(fmt::format("there is no command {}{} (see --help)", first,
                                   question.empty() ? ": expected " + commands_of(app) : question));
  }
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const std::vector<std::string> extras = app.remaining(true);
  const auto extra = std::ranges::find_if(extras, [](const auto& each) { return each.starts_with('-'); });
  if (extra == extras.end()) throw ProgramError(fmt::format("{} (see --help)", reason));
  std::vector<std::string> names;
  for (const CLI::Option* const option : command.get_options()) {
    const std::string name = option->get_name();
    if (name.starts_with('-')) names.push_back(name);
  }
  const std::string given = extra->substr(0, extra->find('='));
  throw ProgramError(fmt::format("{} has no option {}{} (see --help)", command.get_name(), given,
                                 question_about(given, names)));
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
    refuse_extra(app, argv[1], error.what());
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
    app.formatter(make_help_formatter());
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
