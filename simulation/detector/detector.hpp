// Detector: one interface for all algorithms that find contacts, so that claims about them can be checked by
// running them on one scene.
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
#include "kinesphere/event.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/workers.hpp"
#include "kinesphere/world.hpp"
#include "simulation/detector/detector_counters.hpp"

namespace kinesphere {

/// A detector watches bodies of a motion. A body goes by its number in the motion; an id in an event has that
/// number as index and generation 0. Calls and errors mean what they mean in World.
class Detector {
 public:
  virtual ~Detector() = default;

  /// Returns the name in messages and tables of results.
  virtual std::string_view name() const = 0;
  /// Adds body number `body` at time(). `definition` has the state of the body at that time.
  virtual Result<void> add(std::uint32_t body, const BodyDefinition& definition) = 0;
  /// Removes the body at time(). Ends of its contacts are events that advance() still returns.
  virtual Result<void> remove(std::uint32_t body) = 0;
  /// Gives the body this velocity from time() on. Precondition: the caller has set it in the motion already.
  virtual Result<void> set_velocity(std::uint32_t body, const Vec3& velocity) = 0;
  /// Advances to the next event, or to time `until` without one, and returns the event.
  virtual Result<std::optional<Event>> advance(double until) = 0;
  /// Runs to time `until` as World::run does: `respond` and `sink` are called as there, with events as
  /// advance() returns them. New velocities are set in `motion`, which moves the bodies. Errors: unsupported,
  /// those of World::run, and what the motion throws.
  virtual Result<void> run(double until, Motion& motion, const ResponseFn& respond, const EventFn& sink,
                           Workers& workers);
  virtual double time() const = 0;
  virtual DetectorCounters counters() const = 0;
  /// Returns the bound of the body as of its last report; a sphere that does not grow if the detector keeps
  /// no bounds. Errors: unknown_body, stale_body.
  virtual Result<Bound> bound(std::uint32_t body) const = 0;
  /// Returns the first difference that an audit finds; nothing if there is none or the detector has no audit.
  virtual std::optional<AuditFinding> audit() const { return std::nullopt; }
  /// Returns the memory that the detector takes, if it keeps count.
  virtual std::optional<Memory> memory() const { return std::nullopt; }
  // Recording (recording.hpp), for detectors that are a World: each body has its number as user data. Errors:
  // unsupported, and those of World.
  virtual Result<void> start_recording();
  virtual Result<std::vector<std::byte>> stop_recording();
  // The bodies that cost most probes (World::Inspection::busiest()), for detectors that are a World. Errors:
  // unsupported, and those of World.
  virtual Result<void> set_profiling(bool on);
  virtual Result<std::vector<BusyBody>> busiest(std::size_t count) const;
};

/// Makes a detector that watches the bodies of a motion.
using DetectorMaker =
    std::function<Result<std::unique_ptr<Detector>>(const WorldDefinition& definition, const Motion& motion)>;

// A detector reads `motion`, by state() alone, as long as the detector lives.

/// Makes the default engine: a World.
Result<std::unique_ptr<Detector>> make_world_detector(const WorldDefinition& definition,
                                                      const Motion& motion);
/// Makes a World in which each body senses all others at these distances. Errors: as World::set_sensor().
Result<std::unique_ptr<Detector>> make_sensing_detector(const WorldDefinition& definition,
                                                        const Motion& motion, const Sensor& sensor);

}  // namespace kinesphere
