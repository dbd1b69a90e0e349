// The motion of a game that moves its bodies in fixed steps: straight lines between its last two frames.
//
//   Frames frames = Frames::create({.start = positions,
//                                   .velocities = velocities,
//                                   .acceleration_limits = limits,
//                                   .interval = 1.0 / 60}).value();
//   // add bodies with frames.definition(); then, each frame:
//   frames.push(positions).value();
//   while (auto event = world.advance(frames.latest_time(), frames.probe()).value()) { ... }
//   positions = frames.latest();  // where kicks at events have left the bodies
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

struct FramesDefinition {
  /// Positions in frame 0, by body.
  std::vector<Vec3> start;
  /// Velocities there, by body; when empty all zero. Bodies can be added to the world before the second frame
  /// if that one moves them with these velocities up to A dt.
  std::vector<Vec3> velocities{};
  /// A >= 0 (length / time^2), by body, gravity included. See Frames for what exactly it limits.
  std::vector<double> acceleration_limits;
  /// dt > 0 (time): frame k shows the bodies at start_time + k dt.
  double interval = 1.0 / 60.0;
  /// e >= 0 (length): how far off the game's positions may be, such as half a unit in the last place of the
  /// numbers that it keeps them in.
  double position_error = 0.0;
  double start_time = 0.0;
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
/// A contact comes at its exact time, between those two frames. Whoever wants it answered there kicks the
/// body in the frames and in the world:
///   frames.set_velocity(id.index, event->time, velocity);
///   world.set_velocity(id, velocity).value();
/// From then to the last frame the body goes on with that velocity, and the game takes its place from
/// latest() and its velocity from there. A velocity jump that the game makes by itself, in a frame that it
/// pushes, is not covered by the promise either. The world must be told: with its time at latest_time(), push
/// the frame, then call
///   world.set_velocity(id, frames.state(id.index, world.time()).velocity).value();
/// before going on (and again a frame later if the jump fell between two frames, as then two chords differ
/// from the one before).
class Frames final : public Motion {
 public:
  /// Errors: not_finite or out_of_range, naming the field and the body.
  static Result<Frames> create(FramesDefinition definition);

  /// The next frame: the position of every body. Errors, which leave everything as it was: out_of_range for a
  /// wrong number of positions; not_finite, naming the body.
  Result<void> push(std::span<const Vec3> positions);

  /// States can be asked for from previous_time() to latest_time(), once there are two frames; before that
  /// both are start_time. Beyond, a debug build stops, and a release build answers
  /// with the extrapolation of the chord.
  double previous_time() const { return time_of(latest_frame_ == 0 ? 0 : latest_frame_ - 1); }
  double latest_time() const { return time_of(latest_frame_); }

  /// Where the bodies are at latest_time(), kicks included.
  const std::vector<Vec3>& latest() const { return latest_; }

  std::size_t size() const override { return latest_.size(); }
  BodyDefinition definition(std::uint32_t body, double t) const override;
  State state(std::uint32_t body, double t) const override;
  /// One segment.
  Trajectory trajectory(std::uint32_t body, double begin, double end) const override;
  /// Needs previous_time() <= t <= latest_time().
  bool set_velocity(std::uint32_t body, double t, const Vec3& velocity) override;
  std::unique_ptr<Motion> clone() const override;

 private:
  explicit Frames(FramesDefinition definition);
  double time_of(std::uint64_t frame) const { return start_time_ + static_cast<double>(frame) * interval_; }
  Segment piece(std::uint32_t body, double begin, double end) const;

  /// From its time to latest_time().
  struct Chord {
    double begin;  ///< of the frame before the last one, or the last kick since
    Vec3 position;
    Vec3 velocity;
  };

  std::vector<Chord> chords_;
  std::vector<Vec3> latest_;
  std::vector<double> limits_;
  double interval_;
  double position_error_;
  double start_time_;
  std::uint64_t latest_frame_ = 0;
};

}  // namespace kinesphere
