#include "research/bench/paper.hpp"

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <vector>

#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "research/bench/report.hpp"
#include "research/bench/sections.hpp"

namespace kinesphere::program {
namespace {

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const Section& section : bench_sections()) names.emplace_back(section.name);
  return names;
}

}  // namespace

CLI::App* add_bench_paper_command(CLI::App& bench, BenchOptions& options) {
  CLI::App* paper = bench.add_subcommand("paper", "Repeat the paper's evaluation; takes minutes");
  add_bench_options(*paper, options, section_names(),
                    "The paper's lengths and repetitions; takes an hour or more");
  return paper;
}

int bench_paper(const BenchOptions& options) {
  check_bench_options(options, section_names());
  const BenchSettings& settings = bench_settings(effort_of(options));
  const Report report(options.output);
  describe_machine(report);
  if (!report.draws()) {
    report.note(
        "gnuplot is not installed: curves are left as scripts (*.gp). On Debian, install gnuplot-nox and run "
        "`gnuplot *.gp` in that folder.");
  }
  report.note(fmt::format(
      "Effort {}, seeds from 1 on. Times are CPU time of this process from the moment when all bodies are "
      "in; medians of repetitions ({}), in which those who are compared take turns. Every row has the hash "
      "of all contacts from seed 1, to the last bit: it is the same in every run. Those of two detectors "
      "differ, as bounces magnify the last bit. Results go to {}.",
      settings.name, settings.repetitions, options.output));
  const auto begin = std::chrono::steady_clock::now();
  for (const Section& section : bench_sections()) {
    if (!is_chosen(options, section.name)) continue;
    report.heading(section.title);
    section.run(report, settings);
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  print("Done in {:.0f} s.\n", spent.count());
  return exit_fine;
}

}  // namespace kinesphere::program
