#include "research/bench/detector_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "base/program_error.hpp"
#include "base/validators.hpp"
#include "research/rivals/detector_table.hpp"
#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

constexpr const char* detector_group = "Detector";

std::vector<std::string_view> detector_names() {
  std::vector<std::string_view> names;
  for (const DetectorEntry& entry : detector_table()) names.push_back(entry.name);
  return names;
}

const DetectorEntry& find_entry(const std::string& name) {
  const auto& table = detector_table();
  const auto entry = std::find_if(table.begin(), table.end(),
                                  [&](const DetectorEntry& known) { return known.name == name; });
  if (entry != table.end()) return *entry;
  throw ProgramError(
      fmt::format("--detector: expected one of {}, but got '{}'", fmt::join(detector_names(), ", "), name));
}

}  // namespace

NamedDetector DetectorOptions::chosen() const {
  const DetectorEntry& entry = find_entry(name);
  if (entry.takes_step && !step)
    throw ProgramError(fmt::format("--detector {}: expected --step with the step's length", name));
  if (!entry.takes_step && step)
    throw ProgramError("--step: expected only with --detector fixed-step or brute-force");
  if (name != "paper" && (cell_edge || no_trimming))
    throw ProgramError("--cell-edge, --no-trimming: expected only with --detector paper");
  DetectorSettings settings{.step = step};
  if (cell_edge) settings.paper.cell_edge = *cell_edge;
  settings.paper.trimming = !no_trimming;
  return {step ? fmt::format("{}, {} s", name, number(*step)) : name,
          require(detector_maker(name, settings))};
}

void add_detector_options(CLI::App& command, DetectorOptions& options) {
  command.add_option("--detector", options.name, "Who looks for contacts")
      ->type_name(fmt::format("{}", fmt::join(detector_names(), "|")))
      ->capture_default_str()
      ->group(detector_group);
  command.add_option("--step", options.step, "Time step of fixed-step and brute-force")
      ->check(finite_number())
      ->group(detector_group);
  command
      .add_option("--cell-edge", options.cell_edge,
                  "Edge of the finest cells of paper; its cost model's choice when not given")
      ->check(finite_number())
      ->group(detector_group);
  command
      .add_flag("--no-trimming", options.no_trimming,
                "Let paper keep candidates that come after the reset of their body")
      ->group(detector_group);
}

}  // namespace kinesphere::program
