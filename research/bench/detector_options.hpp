// The options that choose a detector and set its parameters.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "scenes/named_detector.hpp"

namespace kinesphere::program {

struct DetectorOptions {
  std::string name = "world";
  std::optional<double> step;
  std::optional<double> cell_edge;
  bool no_trimming = false;

  /// Returns the detector, named after itself and its step if it has one. Throws ProgramError for options
  /// that do not fit the detector.
  NamedDetector chosen() const;
};

/// Adds the options to a command. `options` must live until the command line has been parsed.
void add_detector_options(CLI::App& command, DetectorOptions& options);

}  // namespace kinesphere::program
