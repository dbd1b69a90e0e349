// The motion of a game that moves its bodies in fixed steps: straight lines between its last two frames.
//
//   Frames frames = Frames::create({.start = positions,
//                                   .velocities = velocities,
//                                   .acceleration_limits = limits,
//                                   .interval = 1.0 / 60}).value();
//   // add bodies with frames.definition(); then, each frame:
//   frames.push(positions).value();
//   while (auto event = world.advance(frames.latest_time(), frames.probe()).value()) { ... }
//   positions = frames.latest();  // where changes at events have left the bodies
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
  /// Positions in frame 0, by body.
  std::vector<Vec3> start;
  /// Velocities there, by body; when empty all zero. They count for the promise: the second frame is to move
  /// the bodies with these velocities up to A dt.
  std::vector<Vec3> velocities{};
  /// A >= 0 (length / time^2), by body, gravity included. See Frames for what exactly it limits.
  std::vector<double> acceleration_limits;
  /// dt > 0 (time): frame k shows the bodies at start_time + k dt.
  double interval = 1.0 / 60.0;
  /// e >= 0 (length): how far off the game's positions may be, such as half a unit in the last place of the
  /// numbers that it keeps them in.
  double position_error = 0.0;
  double start_time = 0.0;
  /// Whether push() refuses positions that break a promise, instead of reporting them in violations().
  bool refuse_violations = false;
};

/// Positions with which a body broke its promise: see Frames.
struct FrameViolation {
  std::uint32_t body;
  /// > 0 (length): how far the position lies beyond where the acceleration limit lets the body be.
  double excess;
  /// (length / time^2): the limit that would have allowed it.
  double acceleration;
  /// (length / time): of the body in the frame that was pushed.
  Vec3 velocity;
};

/// A body's velocity is that of the chord between the two frames, so it jumps at each frame; still the body
/// keeps a promise. If its true acceleration is at most A (or the game itself steps velocities by at most A
/// dt) then chord velocities differ by at most A dt from frame to frame, that is, positions p of the game
/// satisfy |p_(k+1) - 2 p_k + p_(k-1)| <= A dt^2. After a time s from any moment on, the jumps add up to at
/// most
///   sum over frames in between of A dt (s - their time) <= A dt s + 1/2 A s^2,
/// which is the general bound with velocity error A dt and acceleration limit A. Positions that are off by e
/// make chord velocities off by 2 e / dt, which is added to the velocity error.
///
/// States are known from the last frame but one to the last, so a game looks at the world one frame late.
///
/// A contact comes at its exact time, between those two frames. Whoever wants it answered there changes the
/// velocity in the frames and in the world (a BodyMap does both in one call):
///   frames.set_velocity(id.index, event->time, velocity).value();
///   world.set_velocity(id, velocity).value();
/// From then to the last frame the body goes on with that velocity, and the game takes its place from
/// latest() and its velocity from there.
///
/// A velocity jump that the game makes by itself, in a frame that it pushes, is not covered by the promise.
/// push() holds every position against the formula above and reports such jumps in violations(): a bounce off
/// the game's own walls, an explosion, a position that was set. The world must be told of each, with its time
/// at latest_time() before the frame is pushed, and before it goes on:
///   for (const FrameViolation& turn : frames.violations())
///     world.set_velocity(ids[turn.body], turn.velocity).value();
/// or, with a BodyMap, bodies.report_violations(world, frames). A jump that falls between two frames makes
/// two chords differ from the one before, so it is reported twice, and told twice.
class FrameMotion final : public Motion {
 public:
  /// Errors: not_finite or out_of_range, naming the field and the body.
  static Result<FrameMotion> create(FrameMotionDefinition definition);

  /// The next frame: the position of every body (that of a removed one is not looked at). Errors, which leave
  /// everything as it was: out_of_range for a wrong number of positions and, with refuse_violations, for the
  /// first position that breaks a promise; not_finite, naming the body.
  Result<void> push(std::span<const Vec3> positions);
  /// Who broke its promise in the frame that was pushed last, by body.
  std::span<const FrameViolation> violations() const { return violations_; }
  /// How often that has happened in all frames.
  std::uint64_t violation_count() const { return violation_count_; }

  /// States can be asked for from previous_time() to latest_time(), once there are two frames; before that
  /// both are start_time.
  double previous_time() const;
  double latest_time() const;

  /// Where the bodies are at latest_time(), changes included.
  const std::vector<Vec3>& latest() const { return latest_; }

  /// A new body, in `state` at time t, and its number: that of a removed body if there is one, else size() as
  /// it was. It goes on with its velocity to the latest frame; later frames are to have its position. Needs
  /// previous_time() <= t <= latest_time(). Errors: not_finite, time_backwards, out_of_range.
  Result<std::uint32_t> add(double t, const State& state, double acceleration_limit);

  std::size_t size() const override { return latest_.size(); }
  bool contains(std::uint32_t body) const override;
  BodyDefinition definition(std::uint32_t body, double t) const override;
  State state(std::uint32_t body, double t) const override;
  /// One segment.
  Trajectory trajectory(std::uint32_t body, double begin, double end) const override;
  /// Both need previous_time() <= t <= latest_time().
  Result<void> set_velocity(std::uint32_t body, double t, const Vec3& velocity) override;
  Result<void> teleport(std::uint32_t body, double t, const State& state) override;
  /// The last change in the latest frame, or the frame before it.
  MotionOrigin origin(std::uint32_t body) const override;
  /// Needs previous_time() <= departure.time <= latest_time().
  Result<void> set_origin(std::uint32_t body, const MotionOrigin& origin) override;
  Result<void> remove(std::uint32_t body) override;
  /// A body can be read only in the frame in which it was written: a motion that was created anew takes as
  /// many push() before (of no positions while it has no bodies). Later frames are to have its position.
  /// What violations() says of the body stays where it was written.
  Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const override;
  Result<std::uint32_t> read_body(std::span<const std::byte>& bytes) override;
  std::unique_ptr<Motion> clone() const override;

 private:
  explicit FrameMotion(FrameMotionDefinition definition);
  /// From its time to latest_time().
  struct Chord {
    double begin;  ///< of the frame before the last one, or the last change since; infinite once removed
    Vec3 position;
    Vec3 velocity;

    Segment segment(double end) const;
  };

  double time_of(std::uint64_t frame) const;
  const Chord& known_chord(std::uint32_t body, double t, std::string_view call,
                           std::string_view argument) const;
  Result<void> check_change(std::string_view call, std::uint32_t body, double t) const;
  void turn(std::uint32_t body, double t, const State& state);
  std::optional<FrameViolation> violation(std::uint32_t body, const Vec3& position) const;

  std::vector<Chord> chords_;
  std::vector<Vec3> latest_;
  std::vector<Vec3> pushed_;  ///< positions in the latest frame, without the changes since
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
