// Rivals: other algorithms that find contacts, to compare the world with: those of the papers, and fixed
// steps.
//
// Like the world they read their motion by state() alone. They return unsupported for periodic space and for
// two dimensions.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/world_definition.hpp"
#include "simulation/detector/detector.hpp"

namespace kinesphere {

/// Options of the paper's algorithm.
struct PaperOptions {
  /// Edge of the finest cells (length), 0 < cell_edge <= 1e200; at least 1024 contact tolerances are used. 0:
  /// the cost model chooses, and again whenever the number of bodies has doubled. A body crosses about speed
  /// / cell_edge faces per unit of time, each an event.
  double cell_edge = 0.0;
  /// Leaves candidates that come after the reset of their body out of the event tree (paper, section 3.3).
  bool trimming = true;
};

/// Makes the paper's algorithm (Kim, Guibas and Shin 2005): hierarchical grids; entering, leaving, resetting
/// and colliding events. Errors: out_of_range for options.
Result<std::unique_ptr<Detector>> make_paper_detector(const WorldDefinition& definition, const Motion& motion,
                                                      const PaperOptions& options = {});
/// Makes the algorithm for ballistic spheres (Kim, Guibas and Shin 1998): exact event times, no probes. add()
/// returns unsupported for a body with an acceleration limit or errors, and for one with a planned
/// acceleration of its own.
Result<std::unique_ptr<Detector>> make_ballistic_detector(const WorldDefinition& definition,
                                                          const Motion& motion);

/// Makes Hubbard's broad phase (1995): space-time bounds of all bodies, rebuilt after each of their
/// collisions, and a sweep over time through their faces. The bounds last twice the running mean of the time
/// to their first meeting.
Result<std::unique_ptr<Detector>> make_hubbard_detector(const WorldDefinition& definition,
                                                        const Motion& motion);
/// Makes the predictor of Hayward and others (1995): a safe interval for every pair, the most urgent pair
/// rechecked first. Memory: O(n^2).
Result<std::unique_ptr<Detector>> make_hayward_detector(const WorldDefinition& definition,
                                                        const Motion& motion);

enum class FixedStepSearch { grid, all_pairs };
/// Makes a detector that tests all bodies every `step` (time) > 0, by a grid or pair by pair: late by up to a
/// step, and blind in between. Errors: out_of_range for the step.
Result<std::unique_ptr<Detector>> make_fixed_step_detector(const WorldDefinition& definition,
                                                           const Motion& motion, double step,
                                                           FixedStepSearch search = FixedStepSearch::grid);

/// Settings that only some detectors take.
struct DetectorSettings {
  /// Time step > 0 of detectors with fixed steps.
  std::optional<double> step{};
  PaperOptions paper{};
};

/// A detector with its name and properties.
struct DetectorEntry {
  std::string_view name;
  bool takes_step;      ///< tests at fixed steps, so it may miss contacts
  bool ballistic_only;  ///< refuses bodies with an acceleration limit
  Result<std::unique_ptr<Detector>> (*make)(const WorldDefinition& definition, const Motion& motion,
                                            const DetectorSettings& settings);
};

/// Returns all detectors, the default one first.
const std::vector<DetectorEntry>& detector_table();

/// Returns a maker of the detector with this name. Errors: out_of_range for `name` if it is not in the table,
/// and for `settings` if a step is missing or not allowed.
Result<DetectorMaker> detector_maker(std::string_view name, const DetectorSettings& settings = {});

}  // namespace kinesphere
