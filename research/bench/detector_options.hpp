// The options with which a detector is chosen and told what it needs to know.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "named_detector.hpp"

namespace kinesphere::program {

struct DetectorOptions {
  std::string name = "world";
  std::optional<double> step;
  std::optional<double> cell_edge;
  bool no_trimming = false;

  /// The detector, named after itself and its step if it has one. Throws ProgramError for options that do not
  /// fit the detector.
  NamedDetector chosen() const;
};

/// `options` must live until the command line has been parsed.
void add_detector_options(CLI::App& command, DetectorOptions& options);

}  // namespace kinesphere::program
