// `kinesphere scenes`: the built-in scenes, one line each.
#pragma once

#include <CLI/App.hpp>

namespace kinesphere::program {

CLI::App* add_scenes_command(CLI::App& program);
int list_scenes();

}  // namespace kinesphere::program
