// The detectors by name, for programs, tests and benchmarks.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "research/rivals/rivals.hpp"
#include "simulation/detector/detector.hpp"

namespace kinesphere {

/// What some detectors can be told.
struct DetectorSettings {
  /// Time step > 0 of those that take one.
  std::optional<double> step{};
  PaperOptions paper{};
};

struct DetectorEntry {
  std::string_view name;
  std::string_view description;  ///< one line
  bool takes_step;               ///< looks at fixed steps, so it may miss contacts
  bool ballistic_only;           ///< refuses bodies with a limit
  Result<std::unique_ptr<Detector>> (*make)(const WorldDefinition& definition, const Motion& motion,
                                            const DetectorSettings& settings);
};

/// All detectors, the default one first.
const std::vector<DetectorEntry>& detector_table();

/// Makes the detector of this name. Errors: out_of_range naming `name` for one that is not in the table, and
/// naming `settings` where a step is missing or not wanted.
Result<DetectorMaker> detector_maker(std::string_view name, const DetectorSettings& settings = {});

}  // namespace kinesphere
