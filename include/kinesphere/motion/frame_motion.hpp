// FrameMotion: bodies of a game that moves them in fixed steps, on straight lines between its last two
// frames.
//
//   FrameMotion frames = FrameMotion::create({.start = positions,
//                                             .velocities = velocities,
//                                             .acceleration_limits = limits,
//                                             .interval = 1.0 / 60}).value();
//   // add bodies with frames.definition(); then, each frame:
//   frames.push(positions).value();
//   while (auto event = world.advance(frames.latest_time(), frames.probe()).value()) { ... }
//   positions = frames.latest();  // includes the changes made at events
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

struct FrameMotionDefinition {
  /// Positions (length) in frame 0, by body.
  std::vector<Vec3> start;
  /// Velocities (length / time) in frame 0, by body; empty means zero. The motion limits include them: the
  /// second frame must move the bodies with these velocities, up to A dt.
  std::vector<Vec3> velocities{};
  /// A >= 0 (length / time^2), by body, gravity included. See FrameMotion for its exact meaning.
  std::vector<double> acceleration_limits;
  /// dt > 0 (time): frame k shows the bodies at start_time + k dt.
  double interval = 1.0 / 60.0;
  /// e >= 0 (length): the largest error of the game's positions, such as half a unit in the last place of
  /// their number format.
  double position_error = 0.0;
  double start_time = 0.0;
  /// If true, push() refuses positions that violate a motion limit, instead of reporting them in
  /// violations().
  bool refuse_violations = false;
};

/// A body whose pushed position violates its acceleration limit: see FrameMotion.
struct FrameViolation {
  std::uint32_t body;
  /// > 0 (length): the distance by which the position exceeds what the acceleration limit permits.
  double excess;
  /// (length / time^2): the least limit that would have permitted the position.
  double acceleration;
  /// (length / time): velocity of the body in the pushed frame.
  Vec3 velocity;
};

/// Motion limits. The velocity of a body is that of the chord between the two frames, so it jumps at each
/// frame, and still obeys motion limits. If the true acceleration is at most A (or the game itself steps
/// velocities by at most A dt), chord velocities differ by at most A dt from frame to frame: positions p of
/// the game satisfy |p_(k+1) - 2 p_k + p_(k-1)| <= A dt^2. After a time s from any moment on, the jumps add
/// up to at most
///   sum over frames in between of A dt (s - their time) <= A dt s + 1/2 A s^2,
/// which is the general bound with velocity error A dt and acceleration limit A. Position errors of e cause
/// chord velocity errors of 2 e / dt, which are added to the velocity error.
///
/// Delay. States are known from the previous frame to the latest one, so the game sees events one frame
/// late.
///
/// Responses. A contact is reported at its exact time, between those two frames. A response there changes
/// the velocity in the frames and in the world (a BodyMap does this in one call):
///   frames.set_velocity(id.index, event->time, velocity).value();
///   world.set_velocity(id, velocity).value();
/// Until the latest frame the body continues with that velocity; the game then takes its position from
/// latest() and continues from there with that velocity.
///
/// Violations. The motion limits do not cover a velocity jump of the game itself, in a frame that it
/// pushes: a bounce off the game's own walls, an explosion, a teleport. push() checks every position
/// against the formula above and reports such jumps in violations(). The caller must declare each of them
/// to the world, at world.time() == previous_time() (the latest time before the push), before the world
/// advances:
///   for (const FrameViolation& violation : frames.violations())
///     world.set_velocity(ids[violation.body], violation.velocity).value();
/// With a BodyMap, bodies.report_violations(world, frames) does this. A jump between two frames makes two
/// chords differ from their predecessors, so it is reported, and must be declared, twice.
class FrameMotion final : public Motion {
 public:
  /// Creates the motion at frame 0. Errors: not_finite or out_of_range, naming the field and the body.
  static Result<FrameMotion> create(FrameMotionDefinition definition);

  /// Appends the next frame: the position (length) of every body; that of a removed body is ignored.
  /// Errors, which leave everything unchanged: out_of_range for a wrong number of positions and, with
  /// refuse_violations, for the first position that violates a motion limit; not_finite, naming the body.
  Result<void> push(std::span<const Vec3> positions);
  /// Returns the violations in the latest pushed frame, by body.
  std::span<const FrameViolation> violations() const { return violations_; }
  /// Returns the number of violations in all frames.
  std::uint64_t violation_count() const { return violation_count_; }

  /// States are known from previous_time() to latest_time(), once there are two frames; before that, each
  /// is start_time.
  double previous_time() const;
  double latest_time() const;

  /// Returns the positions at latest_time(), including changes.
  const std::vector<Vec3>& latest() const { return latest_; }

  /// Adds a body in `state` at time t and returns its number: that of a removed body if there is one, else
  /// the former size(). The body continues with its velocity to the latest frame; later frames must contain
  /// its position. Needs previous_time() <= t <= latest_time(). Errors: not_finite, time_backwards,
  /// out_of_range.
  Result<std::uint32_t> add(double t, const State& state, double acceleration_limit);

  std::size_t size() const override { return latest_.size(); }
  bool contains(std::uint32_t body) const override;
  BodyDefinition definition(std::uint32_t body, double t) const override;
  State state(std::uint32_t body, double t) const override;
  /// Returns one segment.
  Trajectory trajectory(std::uint32_t body, double begin, double end) const override;
  /// set_velocity() and teleport() need previous_time() <= t <= latest_time().
  Result<void> set_velocity(std::uint32_t body, double t, const Vec3& velocity) override;
  Result<void> teleport(std::uint32_t body, double t, const State& state) override;
  /// Returns the last change since the previous frame, or else the body at the previous frame.
  MotionOrigin origin(std::uint32_t body) const override;
  /// Needs previous_time() <= origin.time <= latest_time().
  Result<void> set_origin(std::uint32_t body, const MotionOrigin& origin) override;
  Result<void> remove(std::uint32_t body) override;
  /// read_body() accepts a body only in the frame in which it was written: a newly created motion must
  /// first have had as many calls of push() (without positions while it has no bodies). Later frames must
  /// contain the body's position. Entries in violations() are not transferred.
  Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const override;
  Result<std::uint32_t> read_body(std::span<const std::byte>& bytes) override;
  std::unique_ptr<Motion> clone() const override;

 private:
  explicit FrameMotion(FrameMotionDefinition definition);
  /// Straight line of a body from `begin` to latest_time().
  struct Chord {
    double begin;  ///< time of the previous frame or of the last change since; infinite once removed
    Vec3 position;
    Vec3 velocity;

    Segment segment(double end) const;
  };

  double time_of(std::uint64_t frame) const;
  const Chord& known_chord(std::uint32_t body, double t, std::string_view call,
                           std::string_view argument) const;
  Result<void> check_change(std::string_view call, std::uint32_t body, double t) const;
  void restart_chord(std::uint32_t body, double t, const State& state);
  std::optional<FrameViolation> violation(std::uint32_t body, const Vec3& position) const;

  std::vector<Chord> chords_;
  std::vector<Vec3> latest_;
  std::vector<Vec3> pushed_;  ///< positions in the latest frame, without later changes
  std::vector<double> limits_;
  std::vector<std::uint32_t> free_;  ///< numbers of removed bodies
  std::vector<FrameViolation> violations_;
  std::uint64_t violation_count_ = 0;
  bool refuse_violations_;
  double interval_;
  double position_error_;
  double start_time_;
  std::uint64_t latest_frame_ = 0;
};

}  // namespace kinesphere
