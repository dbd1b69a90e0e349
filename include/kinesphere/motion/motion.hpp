// Motion: the true trajectories of bodies, from which a probe reads. A world sees them only through its
// probe.
//
// A motion numbers its bodies 0, 1, 2, ... . If the bodies were added to a world in this order and none was
// removed, the number equals BodyId::index, and `motion.probe()` can be passed to World::advance(). For any
// other world a BodyMap (body_map.hpp) relates ids to numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/motion/trajectory.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/rigid_body.hpp"
#include "kinesphere/run.hpp"

namespace kinesphere {

/// Errors. Functions that return a Result return the error. The others (definition, state, trajectory)
/// throw BadResult in every build type; without exceptions they print its message and abort. All functions
/// that take a body and a time have these errors:
///   unknown_body    the motion has never had a body of this number
///   stale_body      the body has been removed
///   not_finite      the time is NaN or infinite
///   time_backwards  the time lies before the body's last change or (FrameMotion) before the previous frame
///   out_of_range    the body is not yet known at this time (FrameMotion: after the latest frame)
///
/// Threads. Several threads may use a motion at the same time if they query and change different bodies
/// (set_velocity, teleport, set_origin). Adding and removing bodies, and every other change of more than
/// one body, requires exclusive access. This holds for all motions of the library if the parts that the
/// caller supplies, such as the function of a VelocityField, allow it too.
class Motion {
 public:
  virtual ~Motion() = default;

  /// Upper bound of body numbers: every body has a smaller number.
  virtual std::size_t size() const = 0;
  /// True if there is a body of this number; false if it has been removed.
  virtual bool contains(std::uint32_t body) const { return body < size(); }
  /// Returns the body's motion limits (acceleration limit, planned acceleration, errors) and its state at
  /// time t; the radius keeps its default.
  virtual BodyDefinition definition(std::uint32_t body, double t) const = 0;
  /// Returns the state at time t, which must not lie before the body's last change (or its start). The
  /// result does not depend on earlier queries, nor on other bodies.
  virtual State state(std::uint32_t body, double t) const = 0;
  /// Returns the rotation of a rigid body at time t, as state() returns its state, or nothing if this motion
  /// does not know how its bodies turn, as by default.
  virtual std::optional<Rotation> rotation(std::uint32_t body, double t) const;
  /// Returns the exact motion during [begin, end] if the body is not changed; `begin` must not lie before
  /// its last change. The first segment begins at or before `begin`, the last one ends at `end`. Its states
  /// equal those of state() to the last bit. Errors: as above; out_of_range for end < begin.
  virtual Trajectory trajectory(std::uint32_t body, double begin, double end) const = 0;

  // Changes. On an error nothing has changed. Errors of all: as above; unsupported for motions that do not
  // support the change, such as recorded tracks.

  /// Sets the velocity (length / time) of the body at time t. Errors: not_finite.
  virtual Result<void> set_velocity(std::uint32_t body, double t, const Vec3& velocity) = 0;
  /// Sets the state of the body at time t. Errors: not_finite.
  virtual Result<void> teleport(std::uint32_t body, double t, const State& state);
  /// Returns the time of the body's last change, or of its start, and its state then. The motion since then
  /// depends on this origin and on the body's own parameters (limit, plan, steering). Throws BadResult: as
  /// above without the errors of the time; unsupported.
  virtual MotionOrigin origin(std::uint32_t body) const;
  /// Makes the body move from this origin, which may lie before its last change; this undoes changes bit
  /// for bit. Errors: not_finite; FrameMotion also time_backwards and out_of_range.
  virtual Result<void> set_origin(std::uint32_t body, const MotionOrigin& origin);
  /// Removes the body of this number. The next body that is added reuses the number.
  virtual Result<void> remove(std::uint32_t body);

  // Transfer of bodies to another motion, in another process or a later run.

  /// Appends the data of this body alone on which its future depends: last change, limits, steering, track,
  /// and the name under which random forces are drawn for it. Data common to all bodies (seed, interval,
  /// gravity, field) is not written. The bytes are portable between machines and self-delimiting, so
  /// several bodies can be written one after the other. They hold no checksum: damage that yields valid
  /// numbers goes undetected. Errors, after which nothing is appended: as above without those of the time;
  /// unsupported.
  virtual Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const;
  /// Adds the body that write_body() wrote at the front of `bytes`, removes it from `bytes` and returns its
  /// number here, which may differ from its number there. This motion must have been created with the same
  /// definition; it may have other bodies, or none. From then on state(), trajectory(), definition() and
  /// origin() return, to the last bit, what they return in the motion that wrote the body, as long as the
  /// body gets the same changes. The body stays in that other motion until it is removed there. Errors,
  /// after which motion and `bytes` are unchanged: bad_bytes for bytes that are truncated, were written by
  /// another kind of motion, or hold values that no body can have; unsupported.
  ///
  /// A user-defined motion that implements write_body() and read_body() must not depend on body numbers,
  /// must write numbers in a byte order that is the same on all machines, and must validate all that it
  /// reads: examples/own_motion.cpp.
  virtual Result<std::uint32_t> read_body(std::span<const std::byte>& bytes);

  /// Returns an independent copy, including all changes.
  virtual std::unique_ptr<Motion> clone() const = 0;

  /// Returns a callable for World::advance(), for worlds whose BodyId::index is the number in this motion,
  /// which must outlive it.
  /// It throws BadResult, which passes through World::advance(): the errors of state(), and unknown_body
  /// for a body that this motion does not have, or that reused the index of a removed body (its index need
  /// not be the number here).
  auto probe() const& {
    return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      const std::size_t bodies = size();
      for (std::size_t k = 0; k < ids.size(); ++k) {
        require_number(ids[k], bodies);
        states[k] = state(ids[k].index, time);
      }
    };
  }
  /// A temporary motion would be gone before the world asks.
  void probe() const&& = delete;

 private:
  friend class SingleMotionSource;
  static void require_number(BodyId id, std::size_t size);
};

/// Motion source for World::run(), for worlds whose BodyId::index is the number in a motion. The motion
/// must outlive it. It throws BadResult: as Motion::probe(), and as origin() and set_origin() of the
/// motion.
class SingleMotionSource final : public MotionSource {
 public:
  /// Moves the bodies by this motion.
  explicit SingleMotionSource(Motion& motion) : motion_(motion) {}

  void states(std::span<const BodyId> ids, double time, std::span<State> states) override;
  MotionOrigin origin(BodyId body) const override;
  void set_origin(BodyId body, const MotionOrigin& origin) override;

 private:
  Motion& motion_;
};

}  // namespace kinesphere
