// The frame of all benchmarks that write tables: their common options, the machine, the report.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "command_line.hpp"
#include "research/bench/report.hpp"

namespace kinesphere::program {

enum class Effort {
  quick,  ///< seconds: shows that everything works, no more
  usual,  ///< minutes
  full,   ///< an hour or more: the paper's own lengths and repetitions
};

/// Returns the settings that belong to an effort.
template <class Settings>
const Settings& chosen(Effort effort, const Settings& quick, const Settings& usual, const Settings& full) {
  return effort == Effort::quick ? quick : effort == Effort::full ? full : usual;
}

struct BenchOptions {
  std::string output;             ///< folder
  std::vector<std::string> only;  ///< names of parts; empty for all
  bool full = false;
  bool quick = false;
  std::optional<int> threads{};  ///< of `speed`: compare this many threads with one, instead of rivals

  Effort effort() const { return full ? Effort::full : quick ? Effort::quick : Effort::usual; }
  bool has(std::string_view part) const;
};

struct Benchmark {
  std::string name;
  std::string description;
  std::string full_description;    ///< what --full does
  std::vector<std::string> parts;  ///< names for --only
  /// Runs with options that are right, after the machine has been described.
  std::function<void(const BenchOptions& options, const Report& report)> run;
  std::string threads_part{};  ///< if not empty: it takes --threads, and with that has this part too
};

/// Returns the names of a range of parts.
template <class Parts>
std::vector<std::string> names_of_parts(const Parts& parts) {
  std::vector<std::string> names;
  names.reserve(std::size(parts));
  for (const auto& part : parts) names.emplace_back(part.name);
  return names;
}

/// Adds the command of a benchmark, which writes tables (CSV), figures and machine.txt into a folder.
Command add_benchmark(CLI::App& app, const Benchmark& benchmark);

}  // namespace kinesphere::program
