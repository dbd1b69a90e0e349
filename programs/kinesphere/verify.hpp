// `kinesphere verify`: a detector and the oracle on the same scene, every begin and end compared.
#pragma once

#include <CLI/App.hpp>

#include "named_detector.hpp"
#include "scene_options.hpp"
#include "simulation/oracle/comparison.hpp"
#include "summary.hpp"

namespace kinesphere::program {

struct VerifyOptions {
  SceneOptions scene;
};

/// `options` must live until the command line has been parsed.
CLI::App* add_verify_command(CLI::App& program, VerifyOptions& options);
/// Returns the exit code. Throws ProgramError.
int verify(const VerifyOptions& options, const NamedDetector& detector = {});

/// What the comparison found, with the first difference if there is one.
void add_comparison(Summary& summary, const ContactComparison& comparison);

}  // namespace kinesphere::program
