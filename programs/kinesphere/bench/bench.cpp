// `kinesphere bench paper`: the evaluation of the paper, repeated on this machine.
#include "bench/bench.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>

#include "bench/machine.hpp"
#include "bench/report.hpp"
#include "bench/sections.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

std::vector<std::string_view> section_names() {
  std::vector<std::string_view> names;
  for (const Section& section : bench_sections()) names.push_back(section.name);
  return names;
}

void check_names(const std::vector<std::string>& chosen) {
  const auto names = section_names();
  for (const std::string& name : chosen) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw ProgramError(
          fmt::format("--only: expected some of {}, but got '{}'", fmt::join(names, ", "), name));
    }
  }
}

Effort effort_of(const BenchOptions& options) {
  if (options.full && options.quick)
    throw ProgramError("--full: expected without --quick, but both are given");
  return options.full ? Effort::full : options.quick ? Effort::quick : Effort::usual;
}

}  // namespace

CLI::App* add_bench_command(CLI::App& program, BenchOptions& options) {
  CLI::App* command = program.add_subcommand("bench", "Measure, and compare with what was published");
  command->require_subcommand(1);
  CLI::App* paper = command->add_subcommand("paper", "Repeat the paper's evaluation; takes minutes");
  paper->add_option("--output", options.output, "Folder for tables (CSV), figures (SVG) and gnuplot scripts")
      ->type_name("FOLDER")
      ->capture_default_str();
  paper->add_option("--only", options.only, fmt::format("Some of {}", fmt::join(section_names(), ",")))
      ->type_name("NAME,...")
      ->delimiter(',');
  paper->add_flag("--full", options.full, "The paper's lengths and repetitions; takes an hour or more");
  paper->add_flag("--quick", options.quick, "Tiny sizes, to see that everything works; takes seconds");
  return command;
}

int bench_paper(const BenchOptions& options) {
  check_names(options.only);
  const BenchSettings& settings = bench_settings(effort_of(options));
  const Report report(options.output, settings);
  const std::string machine = machine_description();
  report.file("machine.txt", machine);
  fmt::print("{}\n", machine);
  report.note(fmt::format(
      "Effort {}, seeds from 1 on. Times are CPU time of this process from the moment when all bodies are "
      "in; medians of repetitions ({}), in which those who are compared take turns. Every row has the hash "
      "of all contacts from seed 1, to the last bit: it is the same in every run. Those of two detectors "
      "differ, as bounces magnify the last bit. Results go to {}.",
      settings.name, settings.repetitions, options.output));
  if (!report.draws()) {
    report.note(
        "gnuplot is not installed: curves are left as scripts (*.gp). On Debian, install gnuplot-nox and run "
        "`gnuplot *.gp` in that folder.");
  }
  const auto begin = std::chrono::steady_clock::now();
  for (const Section& section : bench_sections()) {
    const auto& only = options.only;
    if (!only.empty() && std::find(only.begin(), only.end(), section.name) == only.end()) continue;
    report.heading(section.title);
    section.run(report);
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  fmt::print("Done in {:.0f} s.\n", spent.count());
  return exit_fine;
}

}  // namespace kinesphere::program
