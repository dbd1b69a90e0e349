#include "research/bench/benchmark.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <memory>
#include <thread>

#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "base/validators.hpp"
#include "kinesphere/version.hpp"
#include "kinesphere/workers.hpp"
#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

/// Returns the text after the colon in the first line of a /proc file that begins with `label`.
std::string field_of(const char* file, const std::string& label) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (!line.starts_with(label) || colon == std::string::npos) continue;
    const std::size_t text = line.find_first_not_of(" \t", colon + 1);
    if (text != std::string::npos) return line.substr(text);
  }
  return "unknown";
}

std::string load() {
  std::ifstream stream("/proc/loadavg");
  std::string minute;
  return stream >> minute ? minute : "unknown";
}

#if defined(__clang__)
constexpr const char* compiler = "clang " __clang_version__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

/// Returns labelled lines. Facts that the system does not provide are given as unknown.
std::string machine_description() {
  Summary summary;
  summary.row("processor", field_of("/proc/cpuinfo", "model name"));
  summary.row("cores", std::to_string(std::thread::hardware_concurrency()));
  summary.row("memory", field_of("/proc/meminfo", "MemTotal"));
  summary.row("load", load() + " when the benchmark began");
  summary.row("compiler", compiler);
  summary.row("flags", KINESPHERE_FLAGS);
  summary.row("version", fmt::format("kinesphere {}", version));
  summary.row("date", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr))));
  return summary.text();
}

void check(const BenchOptions& options, const Benchmark& benchmark) {
  std::vector<std::string> parts = benchmark.parts;
  if (options.threads) parts.push_back(benchmark.threads_part);
  for (const std::string& name : options.only) {
    if (std::find(parts.begin(), parts.end(), name) == parts.end()) {
      throw ProgramError(
          fmt::format("--only: expected some of {}, but got '{}'", fmt::join(parts, ", "), name));
    }
  }
  if (options.full && options.quick)
    throw ProgramError("--full: expected without --quick, but both are given");
}

}  // namespace

bool BenchOptions::has(std::string_view part) const {
  return only.empty() || std::find(only.begin(), only.end(), part) != only.end();
}

Command add_benchmark(CLI::App& app, const Benchmark& benchmark) {
  const auto options = std::make_shared<BenchOptions>();
  options->output = "bench-" + benchmark.name;
  CLI::App* const command = app.add_subcommand(benchmark.name, benchmark.description);
  command->add_option("--output", options->output, "Folder for tables (CSV), figures and gnuplot scripts")
      ->type_name("FOLDER")
      ->capture_default_str();
  std::string parts = fmt::format("Some of {}", fmt::join(benchmark.parts, ","));
  if (!benchmark.threads_part.empty()) parts += fmt::format(",{} (with --threads)", benchmark.threads_part);
  command->add_option("--only", options->only, parts)->type_name("NAME,...")->delimiter(',');
  command->add_flag("--full", options->full, benchmark.full_description);
  command->add_flag("--quick", options->quick, "Tiny sizes, to see that everything works; takes seconds");
  if (!benchmark.threads_part.empty())
    command
        ->add_option(
            "--threads", options->threads,
            "Only this: whole simulations by World::run, on so many threads and on one, against a loop")
        ->check(whole_number(Workers::most_threads, 1));
  return {command, [benchmark, options] {
            check(*options, benchmark);
            const Report report(options->output);
            const std::string machine = machine_description();
            report.file("machine.txt", machine);
            print("{}\n", machine);
            benchmark.run(*options, report);
            return exit_fine;
          }};
}

}  // namespace kinesphere::program
