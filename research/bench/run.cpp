// `kinesphere-bench run` and `verify`: as those of `kinesphere`, under any detector.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/program_error.hpp"
#include "base/validators.hpp"
#include "research/bench/commands.hpp"
#include "research/rivals/rivals.hpp"
#include "scenes/run.hpp"
#include "scenes/summary.hpp"
#include "scenes/verify.hpp"

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

/// The options that choose a detector and set its parameters.
struct DetectorOptions {
  std::string name = "world";
  std::optional<double> step;
  std::optional<double> cell_edge;
  bool no_trimming = false;

  /// Returns the detector, named after itself and its step if it has one. Throws ProgramError for options
  /// that do not fit the detector.
  NamedDetector chosen() const;
};

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

}  // namespace

Command add_run(CLI::App& app) {
  const auto options = std::make_shared<RunOptions>();
  const auto detector = std::make_shared<DetectorOptions>();
  CLI::App* const command = add_run_command(app, *options);
  add_detector_options(*command, *detector);
  return {command, [options, detector] {
            if (detector->name != "world" && (options->threads || !options->record.empty()))
              throw ProgramError("--threads, --record: expected only with --detector world");
            return run(*options, detector->chosen());
          }};
}

Command add_verify(CLI::App& app) {
  const auto options = std::make_shared<VerifyOptions>();
  const auto detector = std::make_shared<DetectorOptions>();
  CLI::App* const command = add_verify_command(app, *options);
  add_detector_options(*command, *detector);
  return {command, [options, detector] { return verify(*options, detector->chosen()); }};
}

}  // namespace kinesphere::program
