// `kinesphere-bench paths`: what the approaches of bodies on known paths cost.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>

namespace kinesphere::program {

struct PathOptions {
  std::string file;  ///< arcs; empty: satellites drawn at random
  std::uint32_t satellites = 10'000;
  std::uint64_t seed = 1;
  double hours = 24.0;
  double distance = 5.0;
  int turns = 3;
};

/// Adds the command. `options` must live until the command line has been parsed.
CLI::App* add_bench_paths_command(CLI::App& bench, PathOptions& options);
/// Times the search on one thread and on two, and prints a table. Returns the exit code, which says if both
/// found the same. Throws ProgramError.
int bench_paths(const PathOptions& options);

}  // namespace kinesphere::program
