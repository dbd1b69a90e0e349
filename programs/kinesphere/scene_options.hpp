// The options with which a scene is chosen and changed on the command line.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <vector>

#include "scene_file.hpp"

namespace kinesphere::program {

struct SceneOptions {
  std::string scene;
  /// What the options given change, in their order.
  std::vector<std::function<void(SceneSource&)>> changes;

  /// The chosen scene with its changes. Throws ProgramError.
  SceneSource source() const;
};

/// `options` must live until the command line has been parsed.
void add_scene_options(CLI::App& command, SceneOptions& options);
/// --response and --restitution, for commands that may let bodies react.
void add_response_options(CLI::App& command, SceneOptions& options);

}  // namespace kinesphere::program
