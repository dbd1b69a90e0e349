// The options with which a detector is chosen and told what it needs to know.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "lab/detector_table.hpp"

namespace kinesphere::program {

struct DetectorOptions {
  std::string name = "world";
  std::optional<double> step;
  std::optional<double> cell_edge;
  bool no_trimming = false;

  /// Throws ProgramError for options that do not fit the detector.
  DetectorMaker maker() const;
  /// For a summary: the name, and the step if there is one.
  std::string description() const;
};

/// `options` must live until the command line has been parsed.
void add_detector_options(CLI::App& command, DetectorOptions& options);

}  // namespace kinesphere::program
