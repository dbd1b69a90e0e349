// The common options of all benchmarks.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "research/bench/report.hpp"
#include "research/bench/settings.hpp"

namespace kinesphere::program {

struct BenchOptions {
  std::string output;             ///< folder
  std::vector<std::string> only;  ///< names of parts; empty for all
  bool full = false;
  bool quick = false;
};

/// Adds --output, --only, --full and --quick. `options` must live until the command line has been parsed.
void add_bench_options(CLI::App& command, BenchOptions& options, const std::vector<std::string>& names,
                       const std::string& full_description);

/// Throws ProgramError if --only has an unknown name, or both --full and --quick are given.
void check_bench_options(const BenchOptions& options, const std::vector<std::string>& names);
Effort effort_of(const BenchOptions& options);
bool is_chosen(const BenchOptions& options, std::string_view name);

/// Writes the machine to the terminal and to machine.txt.
void describe_machine(const Report& report);

}  // namespace kinesphere::program
