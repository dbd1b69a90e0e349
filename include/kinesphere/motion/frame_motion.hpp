// FrameMotion: bodies of a game that moves them in fixed steps, on straight lines between its last two
// frames.
//
//   FrameMotion frames = FrameMotion::create({.start = positions, .interval = 1.0 / 60}).value();
//   BodyMap bodies;
//   bodies.add_all(world, frames, {.radius = 0.2}).value();
//   // each frame, after the game has moved its bodies:
//   bodies.push(world, frames, positions).value();
//   for (const Event& event : world.events(frames.latest_time(), bodies.probe())) { ... }
//   positions = frames.latest();  // includes the changes made at events
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

class World;

/// Frame 0 of a FrameMotion, and what its bodies promise.
struct FrameMotionDefinition {
  /// Positions (length) in frame 0, by body.
  std::vector<Vec3> start{};
  /// Velocities (length / time) in frame 0, by body; empty means zero.
  std::vector<Vec3> velocities{};
  /// A >= 0 (length / time^2), by body, gravity included; infinite for a body without a limit. Empty means
  /// that no body has one. See FrameMotion for the meaning of both.
  std::vector<double> acceleration_limits{};
  /// dt > 0 (time): frame k shows the bodies at start_time + k dt.
  double interval = 1.0 / 60.0;
  /// e >= 0 (length): the largest error of the game's positions, such as half a unit in the last place of
  /// their number format.
  double position_error = 0.0;
  double start_time = 0.0;

  friend bool operator==(const FrameMotionDefinition&, const FrameMotionDefinition&) = default;
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

  friend constexpr bool operator==(const FrameViolation&, const FrameViolation&) = default;
};

/// Bodies without an acceleration limit (the default). Their velocities are news at every frame: nothing is
/// promised but straight motion from one pushed position to the next. push() informs the world of each
/// velocity that differs from the one of the frame before. Take this where velocities jump: players, boids,
/// bounces off walls of the game's own, explosions.
///
/// Bodies with a limit. The world is not informed while the limit holds, so a body that flies far from all
/// others costs nothing at a push. The velocity of a body is that of the chord between the two frames, so it
/// jumps at each frame, and still obeys motion limits. If the true acceleration is at most A (or the game
/// itself steps velocities by at most A dt), chord velocities differ by at most A dt from frame to frame:
/// positions p of the game satisfy |p_(k+1) - 2 p_k + p_(k-1)| <= A dt^2. After a time s from any moment on,
/// the jumps add up to at most
///   sum over frames in between of A dt (s - their time) <= A dt s + 1/2 A s^2,
/// which is the general bound with velocity error A dt and acceleration limit A. Position errors of e cause
/// chord velocity errors of 2 e / dt, which are added to the velocity error. The second frame must move the
/// bodies with the velocities of frame 0, up to A dt. A position that violates the limit is listed in
/// violations(), and push() informs the world of the body's new velocity.
///
/// Costs. A body whose velocity the world is informed of costs a probe and a search in that frame. A limit
/// costs probes and rechecks of all neighbours that the body could reach within it: where velocities jump by
/// the speed of the bodies, a limit that covers the jumps makes a frame 10 to 30 times as expensive.
///
/// Delay. States are known from the previous frame to the latest one, so the game sees events one frame
/// late. A position far away is a fast flight there, with all contacts on the way; BodyMap::teleport() puts
/// a body elsewhere without one. On periodic axes push unwrapped positions.
///
/// Responses. A contact is reported at its exact time, between those two frames. A response there changes
/// the velocity in the frames and in the world. BodyMap::set_velocity() does both; without a map:
///   frames.set_velocity(id.index, event->time, velocity).value();
///   world.set_velocity(id, velocity).value();
/// Until the latest frame the body continues with that velocity; the game then takes its position from
/// latest() and continues from there with that velocity.
///
/// Removed bodies. Their entries in pushed positions must be NaN, as in latest(). A number is used again only
/// after such a push, and its entry must then be the position of the new body. An entry that a game forgot to
/// replace is therefore an error, and never moves another body.
class FrameMotion final : public Motion {
 public:
  /// Creates the motion at frame 0. Errors: not_finite or out_of_range, naming the field and the body.
  static Result<FrameMotion> create(FrameMotionDefinition definition);

  /// Appends the next frame: the position (length) of every body, NaN for a removed one. Informs the world,
  /// in which BodyId::index must be the number here, of the new velocities (see above); a body that is
  /// disabled there is skipped. For other worlds: BodyMap::push(). Needs world.time() == latest_time().
  /// Errors, which leave motion and world unchanged: out_of_range for a wrong number of positions or another
  /// time of the world; not_finite, naming the body; stale_body for a removed body whose position is not
  /// NaN; those of World::set_velocities(). Cost: O(n).
  Result<void> push(World& world, std::span<const Vec3> positions);
  /// Appends the next frame if no world has to be informed of a new velocity: all bodies have a limit and
  /// keep it. Errors: as above; out_of_range, naming the first body with a new velocity.
  Result<void> push(std::span<const Vec3> positions);
  /// Returns the violations of acceleration limits in the latest pushed frame, by body. The world has been
  /// informed of them; a limit that is often violated is too small.
  std::span<const FrameViolation> violations() const { return violations_; }
  /// Returns the number of violations in all frames.
  std::uint64_t violation_count() const { return violation_count_; }

  /// States are known from previous_time() to latest_time(), once there are two frames; before that, each
  /// is start_time.
  double previous_time() const;
  double latest_time() const;
  /// Returns the number of frames that have been pushed.
  std::uint64_t latest_frame() const { return latest_frame_; }
  /// Return these fields of the definition.
  double interval() const { return interval_; }
  double position_error() const { return position_error_; }
  double start_time() const { return start_time_; }

  /// Returns the positions at latest_time(), including changes; NaN for removed bodies.
  const std::vector<Vec3>& latest() const { return latest_; }

  /// Adds a body in `state` at time t and returns its number: that of a body removed before the latest push
  /// if there is one, else the former size(). The body continues with its velocity to the latest frame;
  /// later frames must contain its position. It has no acceleration limit unless one is given. Needs
  /// previous_time() <= t <= latest_time(). Errors: not_finite, time_backwards, out_of_range.
  Result<std::uint32_t> add(double t, const State& state,
                            double acceleration_limit = std::numeric_limits<double>::infinity());

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
  /// Removes the body of this number. The number is used again after the next push, which must have NaN for
  /// it.
  Result<void> remove(std::uint32_t body) override;
  /// read_body() accepts a body only in the frame in which it was written: a newly created motion must
  /// first have had as many calls of push() (without positions while it has no bodies). Later frames must
  /// contain the body's position. Entries in violations() are not transferred.
  Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const override;
  Result<std::uint32_t> read_body(std::span<const std::byte>& bytes) override;
  std::unique_ptr<Motion> clone() const override;

 private:
  friend class BodyMap;
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
  /// Velocities that a world has to be informed of in the next frame, by body, and violations.
  struct NextFrame {
    std::vector<std::uint32_t> bodies{};
    std::vector<Vec3> velocities{};
    std::vector<FrameViolation> violations{};
  };
  Result<NextFrame> next_frame(std::string_view call, std::span<const Vec3> positions) const;
  /// Pushes a frame to a world in which body k is ids[k].
  Result<void> push(std::string_view call, World& world, std::span<const BodyId> ids,
                    std::span<const Vec3> positions);
  void append(NextFrame next, std::span<const Vec3> positions);

  std::vector<Chord> chords_;
  std::vector<Vec3> latest_;
  std::vector<Vec3> pushed_;  ///< positions in the latest frame, without later changes
  std::vector<double> limits_;
  std::vector<std::uint32_t> removed_;  ///< numbers of bodies removed since the latest push
  std::vector<std::uint32_t> free_;     ///< numbers that may be used again
  std::vector<FrameViolation> violations_;
  std::uint64_t violation_count_ = 0;
  double interval_;
  double position_error_;
  double start_time_;
  std::uint64_t latest_frame_ = 0;
};

}  // namespace kinesphere
