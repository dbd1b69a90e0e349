// The command-line options about what files and streams mean, which all commands share.
#pragma once

#include <CLI/App.hpp>
#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "formats/streams/report_format.hpp"

namespace kinesphere::program {

/// Group of these options in the help.
inline constexpr const char* input_group = "Reading";

/// Adds --format, --columns, --where, --frame-rate, --time-unit, --unit, --dates, --positions and --altitude.
/// `positions` is the type of that
/// option's value in the help. `choices` must live until the command line has been parsed.
void add_input_options(CLI::App& command, FormatChoices& choices, const char* positions);

/// Adds an option that takes one of a few names. `value` must live until the command line has been parsed.
template <class Value>
void add_choice(CLI::App& command, const std::string& name, Value& value,
                const std::map<std::string, Value>& choices, const std::string& default_name,
                const std::string& description, const std::string& group_name = input_group) {
  std::string names;
  for (const auto& [each, ignored] : choices) names += (names.empty() ? "" : "|") + each;
  const auto problem = [name, names, choices](const std::string& text) {
    return choices.contains(text) ? std::string() : "expected one of " + names + ", but got '" + text + "'";
  };
  command
      .add_option_function<std::string>(
          name, [&value, choices](const std::string& text) { value = choices.at(text); }, description)
      ->check(CLI::Validator(problem, "", "choice"))
      ->type_name(names)
      ->default_str(default_name)
      ->group(group_name);
}

}  // namespace kinesphere::program
