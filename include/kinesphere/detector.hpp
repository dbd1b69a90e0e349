// Several ways to find the same contacts, behind one interface, so that every claim is a comparison
// that anyone can run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/unit_costs.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// A detector watches bodies that are named by their number in a motion; ids in its events
/// have that number as index and generation 0. The calls mean what they mean in World, and so do their
/// errors.
class Detector {
 public:
  virtual ~Detector() = default;

  virtual std::string_view name() const = 0;
  /// Adds body number `body` at the current time, with its state there in `definition`.
  virtual Result<void> add(std::uint32_t body, const BodyDefinition& definition) = 0;
  virtual Result<void> remove(std::uint32_t body) = 0;
  /// From the current time on the body has this velocity. The caller has set it in the motion already.
  virtual Result<void> set_velocity(std::uint32_t body, const Vec3& velocity) = 0;
  virtual Result<std::optional<Event>> advance(double until) = 0;
  virtual double time() const = 0;
  virtual Counters counters() const = 0;
  /// What the detector knows to contain the body, as of its last report; a sphere that does not grow where it
  /// keeps no bound. Errors: unknown_body, stale_body.
  virtual Result<Bound> bound(std::uint32_t body) const = 0;
  /// Differences that an audit finds, if the detector has one.
  virtual std::optional<AuditFinding> audit() const { return std::nullopt; }
  /// What it takes, for detectors that know.
  virtual std::optional<Memory> memory() const { return std::nullopt; }
  // Recording (recording.hpp), for detectors that are a World: bodies carry their number as user data.
  // Errors: unsupported, and those of World.
  virtual Result<void> start_recording();
  virtual Result<std::vector<std::byte>> stop_recording();
};

/// Makes the detector that is to watch the bodies of a motion.
using DetectorMaker =
    std::function<Result<std::unique_ptr<Detector>>(const WorldDefinition& definition, const Motion& motion)>;

// Detectors read `motion` through state() alone, the oracle through trajectory() too; it must outlive them.
// Only the world knows of space that repeats and of two dimensions: the others answer unsupported.

/// The default engine: a World.
Result<std::unique_ptr<Detector>> make_world_detector(const WorldDefinition& definition,
                                                      const Motion& motion);
/// The same where every body senses all others at these distances. Errors: as World::set_sensor().
Result<std::unique_ptr<Detector>> make_sensing_detector(const WorldDefinition& definition,
                                                        const Motion& motion, const Sensor& sensor);
/// Brute force over exact trajectories: every root of every pair's distance polynomial, isolated
/// rigorously. O(n^2) memory and time; the truth to compare with.
Result<std::unique_ptr<Detector>> make_oracle(const WorldDefinition& definition, const Motion& motion);

/// How the paper's detector solves eq 9 for the time of a colliding event.
enum class MeetingSolver {
  certified,  ///< Newton steps along the line of centres (earliest_meeting): never late
  numeric,    ///< the quartic of eq 10, numerically, as the paper did
  /// Its closed form: may miss contacts, most of all where limits are small. Uses the machine's mathematical
  /// library, so runs may differ between machines.
  closed_form,
};

struct PaperOptions {
  /// Edge of the finest cells (length), 0 < cell_edge <= 1e200, at least 1024 contact tolerances being used;
  /// 0: the cost model chooses, and again whenever the bodies have doubled in number. A body crosses about
  /// speed / cell_edge faces per unit of time, each an event.
  double cell_edge = 0.0;
  /// Leave candidates out of the event tree that come after the reset of their body (paper, section 3.3).
  bool trimming = true;
  MeetingSolver solver = MeetingSolver::certified;
  /// What the cost model reckons with.
  UnitCosts unit_costs = UnitCosts::reference();
  /// Reckon with costs that are measured at start-up (calibrate_unit_costs) instead. They suit this machine
  /// better, but two runs may then differ in their probes and in the last digits of their contacts.
  bool calibrated = false;
};

/// The paper's algorithm (Kim, Guibas and Shin 2005): hierarchical grids, entering, leaving, resetting and
/// colliding events. Errors: out_of_range for options.
Result<std::unique_ptr<Detector>> make_paper_detector(const WorldDefinition& definition, const Motion& motion,
                                                      const PaperOptions& options = {});
/// Its ancestor for ballistic spheres (Kim, Guibas and Shin 1998): exact event times, no probes. add()
/// answers unsupported for a body with a limit or with errors, and for one with a plan of its own.
Result<std::unique_ptr<Detector>> make_ballistic_detector(const WorldDefinition& definition,
                                                          const Motion& motion);

struct HubbardOptions {
  /// How long space-time bounds are built for (time) > 0, each time a rebuild of all, or 0: twice the running
  /// mean of the time to their first meeting.
  double interval = 0.0;
  /// Find all crossings of faces in the interval, and not only those up to the first meeting. The contacts
  /// are the same, the work is not.
  bool all_crossings = false;
};

/// The broad phase of Hubbard (1995): space-time bounds of all bodies, rebuilt after each of their
/// collisions, and a sweep over time through their faces. Errors: out_of_range for options.
Result<std::unique_ptr<Detector>> make_hubbard_detector(const WorldDefinition& definition,
                                                        const Motion& motion,
                                                        const HubbardOptions& options = {});
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
