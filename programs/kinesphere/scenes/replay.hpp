// `kinesphere replay`: repeats a recording, and reports whether all results are equal.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace kinesphere::program {

struct ReplayOptions {
  std::string file;
  bool hash_only = false;
};

/// `options` must live until the command line has been parsed.
CLI::App* add_replay_command(CLI::App& program, ReplayOptions& options);
/// Returns the exit code. Throws ProgramError.
int replay(const ReplayOptions& options);

}  // namespace kinesphere::program
