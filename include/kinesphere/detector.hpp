// Several ways to find the same contacts, behind one interface, so that every claim is a comparison
// that anyone can run.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "kinesphere/body.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// A detector watches bodies that are named by their number in a motion; ids in its events
/// have that number as index and generation 0. The calls mean what they mean in World.
class Detector {
 public:
  virtual ~Detector() = default;

  virtual std::string_view name() const = 0;
  /// Adds body number `body` at the current time, with its state there in `definition`.
  virtual Result<void> add(std::uint32_t body, const BodyDefinition& definition) = 0;
  virtual Result<void> remove(std::uint32_t body) = 0;
  /// The motion has been kicked already.
  virtual Result<void> kick(std::uint32_t body, const Vec3& velocity) = 0;
  virtual Result<std::optional<Event>> advance(double until) = 0;
  virtual double time() const = 0;
  virtual Counters counters() const = 0;
  /// The radius of what the detector knows to contain the body at the current time (the body's own
  /// radius where it keeps no bound).
  virtual double bound_radius(std::uint32_t body) const = 0;
  /// Differences that an audit finds, if the detector has one.
  virtual std::optional<AuditFinding> audit() const { return std::nullopt; }
};

// Detectors read `motion` through state() alone, the oracle through trajectory() too; it must outlive them.

/// The default engine: a World.
Result<std::unique_ptr<Detector>> make_world_detector(const WorldDefinition& definition,
                                                      const Motion& motion);
/// Brute force over exact trajectories: every root of every pair's distance polynomial, isolated
/// rigorously. O(n^2) memory and time; the truth to compare with.
Result<std::unique_ptr<Detector>> make_oracle(const WorldDefinition& definition, const Motion& motion);
/// Looks at all bodies every `step`, through a grid: late by up to a step, and blind in between.
Result<std::unique_ptr<Detector>> make_fixed_step_detector(const WorldDefinition& definition,
                                                           const Motion& motion, double step);

}  // namespace kinesphere
