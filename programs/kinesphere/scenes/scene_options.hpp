// The options that choose and change a scene on the command line.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <vector>

#include "scenes/scene_file.hpp"

namespace kinesphere::program {

struct SceneOptions {
  std::string scene;
  /// Changes by the given options, in their order on the command line.
  std::vector<std::function<void(SceneSource&)>> changes;

  /// Returns the chosen scene with its changes. Throws ProgramError.
  SceneSource source() const;
};

/// `options` must live until the command line has been parsed.
void add_scene_options(CLI::App& command, SceneOptions& options);
/// Adds --response and --restitution, for commands in which bodies may react.
void add_response_options(CLI::App& command, SceneOptions& options);

}  // namespace kinesphere::program
