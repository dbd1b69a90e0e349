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
#include "kinesphere/event.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/workers.hpp"
#include "kinesphere/world.hpp"
#include "simulation/detector/detector_counters.hpp"

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
  /// Goes on to `until` by itself, as World::run does: `respond` and `sink` are called as there, with events
  /// as advance() returns them. `motion`, which moves the bodies, is told of new velocities too. Errors:
  /// unsupported, those of World::run, and what the motion throws.
  virtual Result<void> run(double until, Motion& motion, const ResponseFn& respond, const EventFn& sink,
                           Workers& workers);
  virtual double time() const = 0;
  virtual DetectorCounters counters() const = 0;
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

// Detectors read `motion`, through state() alone, as long as they live.

/// The default engine: a World.
Result<std::unique_ptr<Detector>> make_world_detector(const WorldDefinition& definition,
                                                      const Motion& motion);
/// The same where every body senses all others at these distances. Errors: as World::set_sensor().
Result<std::unique_ptr<Detector>> make_sensing_detector(const WorldDefinition& definition,
                                                        const Motion& motion, const Sensor& sensor);

}  // namespace kinesphere
