// Other ways to find the same contacts, to compare the world with: those of the papers, and fixed steps.
//
// Like the world they read their motion through state() alone. They know neither space that repeats nor two
// dimensions, and answer unsupported.
#pragma once

#include <memory>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/world_definition.hpp"
#include "simulation/detector/detector.hpp"

namespace kinesphere {

struct PaperOptions {
  /// Edge of the finest cells (length), 0 < cell_edge <= 1e200, at least 1024 contact tolerances being used;
  /// 0: the cost model chooses, and again whenever the bodies have doubled in number. A body crosses about
  /// speed / cell_edge faces per unit of time, each an event.
  double cell_edge = 0.0;
  /// Leave candidates out of the event tree that come after the reset of their body (paper, section 3.3).
  bool trimming = true;
};

/// The paper's algorithm (Kim, Guibas and Shin 2005): hierarchical grids, entering, leaving, resetting and
/// colliding events. Errors: out_of_range for options.
Result<std::unique_ptr<Detector>> make_paper_detector(const WorldDefinition& definition, const Motion& motion,
                                                      const PaperOptions& options = {});
/// Its ancestor for ballistic spheres (Kim, Guibas and Shin 1998): exact event times, no probes. add()
/// answers unsupported for a body with a limit or with errors, and for one with a plan of its own.
Result<std::unique_ptr<Detector>> make_ballistic_detector(const WorldDefinition& definition,
                                                          const Motion& motion);

/// The broad phase of Hubbard (1995): space-time bounds of all bodies, rebuilt after each of their
/// collisions, and a sweep over time through their faces. They are built for twice the running mean of the
/// time to their first meeting.
Result<std::unique_ptr<Detector>> make_hubbard_detector(const WorldDefinition& definition,
                                                        const Motion& motion);
/// The predictor of Hayward and others (1995): a safe interval for every pair, and the urgent ones looked at
/// first. O(n^2) memory.
Result<std::unique_ptr<Detector>> make_hayward_detector(const WorldDefinition& definition,
                                                        const Motion& motion);

enum class FixedStepSearch { grid, all_pairs };
/// Looks at all bodies every `step` (time) > 0, through a grid or pair by pair: late by up to a step, and
/// blind in between. Errors: out_of_range for the step.
Result<std::unique_ptr<Detector>> make_fixed_step_detector(const WorldDefinition& definition,
                                                           const Motion& motion, double step,
                                                           FixedStepSearch search = FixedStepSearch::grid);

}  // namespace kinesphere
