// `kinesphere scenes`: the built-in scenes, one line each.
#include "scenes/scene_commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "base/help_text.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "scenes/scene_file.hpp"
#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

std::string range(double least, double largest) {
  return least == largest ? number(least) : fmt::format("{} - {}", number(least), number(largest));
}

}  // namespace

CLI::App* add_scenes_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("scenes", "List the built-in scenes");
  add_examples(*command, {"kinesphere scenes", "kinesphere run gas", "kinesphere verify paper2"});
  return command;
}

int list_scenes() {
  constexpr auto row = "{:<20} {:>9}  {:<14}  {:<12}  {:<13}  {:<13}  {:<13} {:>7}\n";
  print(row, "name", "bodies", "motion", "response", "radius", "speed", "limit", "seconds");
  for (const SceneParameters& scene : built_in_scenes()) {
    print(row, scene.name, grouped(scene.bodies), name_of(scene.motion), name_of(scene.response),
          range(scene.radius_min, scene.radius_max), range(scene.speed_min, scene.speed_max),
          range(scene.limit_min, scene.limit_max), number(scene.seconds));
  }
  return exit_fine;
}

}  // namespace kinesphere::program
