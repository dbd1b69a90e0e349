// The table of detectors by name, for programs, tests and benchmarks.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "research/rivals/rivals.hpp"
#include "simulation/detector/detector.hpp"

namespace kinesphere {

/// Settings that only some detectors take.
struct DetectorSettings {
  /// Time step > 0 of detectors with fixed steps.
  std::optional<double> step{};
  PaperOptions paper{};
};

/// A detector with its name and properties.
struct DetectorEntry {
  std::string_view name;
  std::string_view description;  ///< one line
  bool takes_step;               ///< tests at fixed steps, so it may miss contacts
  bool ballistic_only;           ///< refuses bodies with an acceleration limit
  Result<std::unique_ptr<Detector>> (*make)(const WorldDefinition& definition, const Motion& motion,
                                            const DetectorSettings& settings);
};

/// Returns all detectors, the default one first.
const std::vector<DetectorEntry>& detector_table();

/// Returns a maker of the detector with this name. Errors: out_of_range for `name` if it is not in the table,
/// and for `settings` if a step is missing or not allowed.
Result<DetectorMaker> detector_maker(std::string_view name, const DetectorSettings& settings = {});

}  // namespace kinesphere
