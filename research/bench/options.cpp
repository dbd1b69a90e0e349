#include "research/bench/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "research/bench/machine.hpp"

namespace kinesphere::program {

void add_bench_options(CLI::App& command, BenchOptions& options, const std::vector<std::string>& names,
                       const std::string& full_description) {
  command.add_option("--output", options.output, "Folder for tables (CSV), figures and gnuplot scripts")
      ->type_name("FOLDER")
      ->capture_default_str();
  command.add_option("--only", options.only, fmt::format("Some of {}", fmt::join(names, ",")))
      ->type_name("NAME,...")
      ->delimiter(',');
  command.add_flag("--full", options.full, full_description);
  command.add_flag("--quick", options.quick, "Tiny sizes, to see that everything works; takes seconds");
}

void check_bench_options(const BenchOptions& options, const std::vector<std::string>& names) {
  for (const std::string& name : options.only) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw ProgramError(
          fmt::format("--only: expected some of {}, but got '{}'", fmt::join(names, ", "), name));
    }
  }
  if (options.full && options.quick)
    throw ProgramError("--full: expected without --quick, but both are given");
}

Effort effort_of(const BenchOptions& options) {
  return options.full ? Effort::full : options.quick ? Effort::quick : Effort::usual;
}

bool is_chosen(const BenchOptions& options, std::string_view name) {
  const auto& only = options.only;
  return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
}

void describe_machine(const Report& report) {
  const std::string machine = machine_description();
  report.file("machine.txt", machine);
  print("{}\n", machine);
}

}  // namespace kinesphere::program
