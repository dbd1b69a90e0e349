// How bodies really move: what a probe reads, and what no detector but the oracle may look into.
//
// Bodies are named by their number in the motion: 0, 1, 2, ... . In a world to which the bodies were added in
// the same order, and none removed, that is the index of their id, so `motion.probe()` can be handed to
// World::advance. In any other world a BodyMap (body_map.hpp) tells which body is which.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/motion/trajectory.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"

namespace kinesphere {

/// Functions that return a Result name what was wrong in it. The others (definition, state, trajectory) throw
/// BadResult, in every build type, and abort with its message where exceptions are switched off. Their errors
/// are those of all functions that take a body and a time:
///   unknown_body    the motion has never had a body of this number
///   stale_body      it has been removed
///   not_finite      the time is NaN or infinite
///   time_backwards  the body is not known at this time any more: it lies before its last change, or (Frames)
///                   before the last frame but one
///   out_of_range    the body is not known at this time yet (Frames: after the last frame)
///
/// Threads. Several may use a motion at the same time as long as they ask about different bodies and change
/// different bodies (set_velocity, teleport, depart). Adding and removing bodies, and whatever else changes
/// more than one body, needs the motion for itself. This holds for all motions of the library; what they are
/// made from, such as the function of a VelocityField, must allow it too.
class Motion {
 public:
  virtual ~Motion() = default;

  /// All bodies have smaller numbers than this.
  virtual std::size_t size() const = 0;
  /// Whether there is a body of this number: false when it has been removed.
  virtual bool contains(std::uint32_t body) const { return body < size(); }
  /// The body's promise (limit, plan, errors) and its state at time t; the radius is left at its default.
  virtual BodyDefinition definition(std::uint32_t body, double t) const = 0;
  /// State at time t, which may not lie before the body's last change (or its start). The answer does not
  /// depend on which times were asked for before, nor on other bodies.
  virtual State state(std::uint32_t body, double t) const = 0;
  /// The exact motion during [begin, end], begin not before the last change, as it will be if nobody changes
  /// it. The first segment begins at or before `begin`, the last one ends at `end`. Its states are those that
  /// state() gives, to the last bit. Also out_of_range: end before begin.
  virtual Trajectory trajectory(std::uint32_t body, double begin, double end) const = 0;

  // Changes. On an error everything stays as it was. Errors of all: as above; unsupported for motions that
  // cannot be changed in this way, such as recordings.

  /// Gives the body a new velocity at time t. Errors: not_finite.
  virtual Result<void> set_velocity(std::uint32_t body, double t, const Vec3& velocity) = 0;
  /// Puts the body into another state at time t. Errors: not_finite.
  virtual Result<void> teleport(std::uint32_t body, double t, const State& state);
  /// The body's last change, or its start: when that was, and the state since then. Its motion from then on
  /// depends on this and on what the motion knows of it (limit, plan, steering). Throws BadResult: as above
  /// without the time; unsupported.
  virtual MotionOrigin origin(std::uint32_t body) const;
  /// The body sets out from there, which may be before its last change: so changes are taken back, to the
  /// bit. Errors: not_finite; Frames: time_backwards and out_of_range.
  virtual Result<void> set_origin(std::uint32_t body, const MotionOrigin& origin);
  /// From now on there is no body of this number. The next body that is added takes the number again.
  virtual Result<void> remove(std::uint32_t body);

  // Bodies that move to another motion, in another process or in a later run.

  /// Appends what the future of this body depends on and the motion knows of it alone: its last change,
  /// limits, steering, track, the name under which random forces are drawn for it. What all bodies have in
  /// common (seed, interval, gravity, field) is not written. The bytes may go between machines, and they say
  /// themselves where they end, so bodies can be written one after the other. They hold no checksum: damage
  /// that leaves numbers which a body can have is not noticed. Errors, and then nothing is appended: as above
  /// without the time; unsupported.
  virtual Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const;
  /// Adds the body that write_body() wrote at the front of `bytes`, takes it from there and returns its
  /// number here, which may be another one. This motion must have been created with the same definition; it
  /// may have other bodies, or none. From then on state(), trajectory(), definition() and departure() give,
  /// to the last bit, what they give where the body was written, as long as it is changed in the same ways.
  /// There it stays until it is removed. Errors, and then motion and `bytes` are as they were: bad_bytes for
  /// bytes that are cut short, were written by another kind of motion, or hold what no body can have;
  /// unsupported.
  ///
  /// A motion of your own that has both must not let anything depend on a body's number, must write numbers
  /// in an order that all machines share, and must check all that it reads: examples/own_motion.cpp.
  virtual Result<std::uint32_t> read_body(std::span<const std::byte>& bytes);

  /// An independent copy, changes included.
  virtual std::unique_ptr<Motion> clone() const = 0;

  /// A callable for World::advance, for worlds whose id.index is the number in this motion. It throws
  /// BadResult, which World::advance lets pass: unknown_body when asked about a body that this motion does
  /// not have, or that was added to the world after another one had been removed (so that its index has been
  /// used before and need not be the number here); and as state().
  auto probe() const {
    return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      const std::size_t bodies = size();
      for (std::size_t k = 0; k < ids.size(); ++k) {
        require_number(ids[k], bodies);
        states[k] = state(ids[k].index, time);
      }
    };
  }

 private:
  friend class SingleMotionSource;
  static void require_number(BodyId id, std::size_t size);
};

/// For World::run, in worlds whose id.index is the number in a motion, which must outlive it. It throws
/// BadResult: as Motion::probe(), and as departure() and depart() of the motion.
class SingleMotionSource final : public MotionSource {
 public:
  explicit SingleMotionSource(Motion& motion) : motion_(motion) {}

  void states(std::span<const BodyId> ids, double time, std::span<State> states) override;
  MotionOrigin origin(BodyId body) const override;
  void set_origin(BodyId body, const MotionOrigin& origin) override;

 private:
  Motion& motion_;
};

}  // namespace kinesphere
