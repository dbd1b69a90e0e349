// `kinesphere run`: simulates a scene and prints its events and cost.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "scenes/named_detector.hpp"
#include "scenes/scene_options.hpp"

namespace kinesphere::program {

struct RunOptions {
  SceneOptions scene;
  std::string contacts;
  std::string frames;
  std::string record;
  std::string plot;
  std::optional<double> frame_interval;
  std::optional<int> threads;
  bool audit = false;
  bool explain = false;
  bool hash_only = false;
  bool quiet = false;
  bool verbose = false;
};

/// `options` must live until the command line has been parsed.
CLI::App* add_run_command(CLI::App& program, RunOptions& options);
/// Returns the exit code. Throws ProgramError.
int run(const RunOptions& options, const NamedDetector& detector = {});

}  // namespace kinesphere::program
