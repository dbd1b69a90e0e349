// FrameMotion: bodies of a game that moves them in steps, on straight lines between its last two frames.
//
//   FrameMotion frames = FrameMotion::create({.start = positions}).value();
//   BodyMap bodies;
//   bodies.add_all(world, frames, {.radius = 0.2}).value();
//   // each frame, after the game has moved its bodies; frames may have any lengths:
//   time += dt;
//   bodies.push(world, frames, positions, time).value();
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
#include "kinesphere/rigid_body.hpp"

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
  /// > 0 (time). Frames that are pushed without a time of their own follow each other after this time: frame
  /// k shows the bodies at start_time + k interval. Frames with times may have any lengths; bodies with an
  /// acceleration limit cost least if none is longer than this.
  double interval = 1.0 / 60.0;
  /// e >= 0 (length): the largest error of the game's positions, such as half a unit in the last place of
  /// their number format.
  double position_error = 0.0;
  /// Time of frame 0; 0 is best (WorldDefinition::start_time).
  double start_time = 0.0;
  /// Orientations of rigid bodies in frame 0, by body: quaternions of length 1. Without them the frames do
  /// not say how bodies turn.
  std::optional<std::vector<Quaternion>> rotations{};

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
/// jumps at each frame, and still obeys motion limits. Let the frames have the lengths d_1, d_2, ..., and let
/// the true acceleration be at most A. The velocity u_i of a chord is the mean velocity in its frame, so it
/// is within A d_i / 2 of the true velocities at both ends of the frame. For two chords i < k, with the time
/// s from the end of the first to the begin of the other, this gives
///   |u_k - u_i| <= A d_i / 2 + A s + A d_k / 2 <= A (d + s),   d = the longest frame:
/// the jumps within a time s add up to at most A (d + s). A game that itself steps velocities by at most A
/// d_i in frame i, before or after it moves the bodies, obeys the same. Integrated, this is the general bound
/// with velocity error A d and acceleration limit A; the world is given A * interval as velocity error.
/// Position errors of e cause chord velocity errors of 2 e / interval, which are added to it.
///
/// push() adds up the jumps of each body, less A times the frames in between, and informs the world of the
/// body's velocity where the sum exceeds the velocity error, its part for position errors included. So all
/// frames are certified, longer and shorter ones. While positions are exact and no frame is longer than
/// `interval`, that happens only at a violation: a position with which the velocity jumps by more than A
/// times the longer one of the two frames, which is listed in violations(). After a longer frame it may
/// happen to bodies that keep their limits. The second frame must move the bodies with the velocities of
/// frame 0, up to A times its length.
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
/// Rotations. A motion that was created with `rotations` takes the orientations of all bodies in each frame.
/// Between two frames a body turns with the constant angular velocity that leads from the one orientation to
/// the other by the shorter way, so it must turn by less than half a turn in a frame. push() informs the
/// world of each angular velocity that differs from the one of the frame before, which bodies that are not
/// rigid there have no use for. A body whose RigidBody has the angular acceleration limit 0, the default,
/// needs no RotationProbe; BodyMap::rotation_probe() is one for the others. The frames alone turn the bodies,
/// so BodyMap::add_rigid_body() accepts none with moments of inertia, which contacts would turn.
///
/// Removed bodies. Their entries in pushed positions must be NaN, as in latest(). A number is used again only
/// after such a push, and its entry must then be the position of the new body. An entry that a game forgot to
/// replace is therefore an error, and never moves another body.
class FrameMotion final : public Motion {
 public:
  /// Creates the motion at frame 0. Errors: not_finite or out_of_range, naming the field and the body.
  static Result<FrameMotion> create(FrameMotionDefinition definition);

  /// Appends the next frame: the position (length) of every body, NaN for a removed one, at `time`, which
  /// must be later than latest_time(). Without a time the frame comes `interval` after the one before; a game
  /// whose frames differ in length has to give it, or all velocities are wrong. Informs the world, in which
  /// BodyId::index must be the number here, of the new velocities (see above); a body that is disabled there
  /// is skipped. For other worlds: BodyMap::push(). Needs world.time() == latest_time(). Errors, which leave
  /// motion and world unchanged: out_of_range for a wrong number of positions or another time of the world;
  /// not_finite, naming the body or the time; time_backwards for a time that is not later; stale_body for a
  /// removed body whose position is not NaN; those of World::set_velocities(). Cost: O(n).
  Result<void> push(World& world, std::span<const Vec3> positions, std::optional<double> time = {});
  /// Appends the next frame of a motion that was created with rotations: the orientations, too, quaternions
  /// of length 1 by body; those of removed bodies have no effect. Errors: as above; out_of_range for a wrong
  /// number of rotations, for a length other than 1, and for a motion without rotations; those of
  /// World::change() for angular velocities.
  Result<void> push(World& world, std::span<const Vec3> positions, std::span<const Quaternion> rotations,
                    std::optional<double> time = {});
  /// Appends the next frame if no world has to be informed of a new velocity: all bodies have a limit and
  /// keep it, and none turns. Errors: as above; out_of_range, naming the first body with a new velocity.
  Result<void> push(std::span<const Vec3> positions, std::optional<double> time = {});
  Result<void> push(std::span<const Vec3> positions, std::span<const Quaternion> rotations,
                    std::optional<double> time = {});
  /// Returns the violations of acceleration limits in the latest pushed frame, by body. The world has been
  /// informed of them; a limit that is often violated is too small.
  std::span<const FrameViolation> violations() const { return violations_; }
  /// Returns the number of violations in all frames.
  std::uint64_t violation_count() const { return violation_count_; }

  /// States are known from previous_time() to latest_time(), once there are two frames; before that, each
  /// is start_time.
  double previous_time() const { return previous_time_; }
  double latest_time() const { return latest_time_; }
  /// Returns the number of frames that have been pushed.
  std::uint64_t latest_frame() const { return latest_frame_; }
  /// True while each frame k has been at start_time() + k interval(), with or without a time of its own.
  bool has_equal_frames() const { return has_equal_frames_; }
  /// Return these fields of the definition.
  double interval() const { return interval_; }
  double position_error() const { return position_error_; }
  double start_time() const { return start_time_; }

  /// Returns the positions at latest_time(), including changes; NaN for removed bodies.
  const std::vector<Vec3>& latest() const { return latest_; }
  /// True if the motion was created with rotations.
  bool has_rotations() const { return has_rotations_; }
  /// Returns the orientations at latest_time() by body, those of removed bodies without a meaning; empty for
  /// a motion that was created without rotations.
  const std::vector<Quaternion>& latest_rotations() const { return latest_rotations_; }

  /// Adds a body in `state` at time t and returns its number: that of a body removed before the latest push
  /// if there is one, else the former size(). The body continues with its velocity to the latest frame;
  /// later frames must contain its position. It has no acceleration limit unless one is given. Needs
  /// previous_time() <= t <= latest_time(). In a motion with rotations it has this orientation until the
  /// latest frame. Errors: not_finite, time_backwards, out_of_range.
  Result<std::uint32_t> add(double t, const State& state,
                            double acceleration_limit = std::numeric_limits<double>::infinity(),
                            const Quaternion& orientation = {});

  std::size_t size() const override { return latest_.size(); }
  bool contains(std::uint32_t body) const override;
  BodyDefinition definition(std::uint32_t body, double t) const override;
  State state(std::uint32_t body, double t) const override;
  /// Returns nothing for a motion that was created without rotations.
  std::optional<Rotation> rotation(std::uint32_t body, double t) const override;
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
  /// first have had as many calls of push() (without positions while it has no bodies), with the same times
  /// of the last two frames and the same has_equal_frames(). Later frames must contain the body's position.
  /// Entries in violations() are not transferred.
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

  /// How a body turns from `begin` to latest_time().
  struct Turn {
    double begin;  ///< time of the previous frame, or at which the body was added since
    Quaternion orientation;
    Vec3 angular_velocity;
  };

  double time_of(std::uint64_t frame) const;
  /// Returns the length of the latest frame (time).
  double length() const { return has_equal_frames_ ? interval_ : latest_time_ - previous_time_; }
  /// Returns e1 of a body with a limit (length / time).
  double velocity_error(std::uint32_t body) const {
    return limits_[body] * interval_ + 2.0 * position_error_ / interval_;
  }
  double jumps_before(std::uint32_t body) const;
  const Chord& known_chord(std::uint32_t body, double t, std::string_view call,
                           std::string_view argument) const;
  Result<void> check_change(std::string_view call, std::uint32_t body, double t) const;
  void restart_chord(std::uint32_t body, double t, const State& state);
  /// What the game gives for a frame.
  struct Given {
    std::span<const Vec3> positions;
    std::span<const Quaternion> rotations;
    std::optional<double> time;
  };
  /// A frame that has been checked, and what a world has to be informed of in it, by body.
  struct NextFrame {
    double time;
    double length;
    bool has_equal_frames;
    std::vector<std::uint32_t> bodies{};
    std::vector<Vec3> velocities{};
    std::vector<FrameViolation> violations{};
    std::vector<double> jumps{};             ///< of all bodies; empty where frames are equal
    std::vector<std::uint32_t> turned{};     ///< bodies with a new angular velocity
    std::vector<Vec3> angular_velocities{};  ///< of `turned`
  };
  std::optional<FrameViolation> violation(std::uint32_t body, const Vec3& position, double length) const;
  Result<NextFrame> next_frame(std::string_view call, const Given& given) const;
  void move(NextFrame& next, std::uint32_t body, const Vec3& position) const;
  void turn(NextFrame& next, std::uint32_t body, const Quaternion& orientation) const;
  /// Pushes a frame to a world in which body k is ids[k].
  Result<void> push(std::string_view call, World& world, std::span<const BodyId> ids, const Given& given);
  void append(NextFrame next, const Given& given);

  std::vector<Chord> chords_;
  std::vector<Vec3> latest_;
  std::vector<Vec3> pushed_;  ///< positions in the latest frame, without later changes
  std::vector<double> limits_;
  std::vector<std::uint32_t> removed_;  ///< numbers of bodies removed since the latest push
  std::vector<std::uint32_t> free_;     ///< numbers that may be used again
  /// Of bodies with a limit: their jumps of velocity, less what the limit allows for in the time between
  /// them, added up to the latest frame since their world was last informed. Unused while frames are equal.
  std::vector<double> jumps_;
  std::vector<Turn> turns_;                   ///< empty for a motion without rotations
  std::vector<Quaternion> latest_rotations_;  ///< empty for a motion without rotations
  std::vector<FrameViolation> violations_;
  std::uint64_t violation_count_ = 0;
  double interval_;
  double position_error_;
  double start_time_;
  double previous_time_;
  double latest_time_;
  std::uint64_t latest_frame_ = 0;
  bool has_equal_frames_ = true;
  bool has_rotations_;
};

}  // namespace kinesphere
