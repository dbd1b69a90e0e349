// `kinesphere bench`: measurements that anyone can repeat.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace kinesphere::program {

struct BenchOptions {
  std::string output = "bench-paper";
  std::vector<std::string> only;  ///< names of sections; all when empty
  bool full = false;
  bool quick = false;
};

/// `options` must live until the command line has been parsed.
CLI::App* add_bench_command(CLI::App& program, BenchOptions& options);
/// `kinesphere bench paper`. Returns the exit code. Throws ProgramError.
int bench_paper(const BenchOptions& options);

}  // namespace kinesphere::program
