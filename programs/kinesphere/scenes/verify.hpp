// `kinesphere verify`: runs a detector and the oracle on one scene and compares every begin and end.
#pragma once

#include <CLI/App.hpp>

#include "scenes/named_detector.hpp"
#include "scenes/scene_options.hpp"
#include "scenes/summary.hpp"
#include "simulation/oracle/comparison.hpp"

namespace kinesphere::program {

struct VerifyOptions {
  SceneOptions scene;
};

/// `options` must live until the command line has been parsed.
CLI::App* add_verify_command(CLI::App& program, VerifyOptions& options);
/// Returns the exit code. Throws ProgramError.
int verify(const VerifyOptions& options, const NamedDetector& detector = {});

/// Adds the result of the comparison, with the first difference if there is one.
void add_comparison(Summary& summary, const ContactComparison& comparison);

}  // namespace kinesphere::program
