// The base of motions whose acceleration is constant between fixed multiples of an interval.
//
// A motion of your own takes one function:
//
//   class Homing : public PiecewiseAcceleration {
//     Vec3 acceleration(std::uint32_t body, std::int64_t k, const State& state) const override;
//     ... promise(), clone()
//   };
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "kinesphere/motion/motion.hpp"

namespace kinesphere {

class PiecewiseAcceleration : public Motion {
 public:
  std::size_t size() const final { return courses_.size(); }
  /// Cost: O(1) when t has not gone back since the last call, else one step for every interval since the
  /// body's last kick.
  State state(std::uint32_t body, double t) const final;
  Trajectory trajectory(std::uint32_t body, double begin, double end) const final;
  bool set_velocity(std::uint32_t body, double t, const Vec3& velocity) final;

 protected:
  /// States at start_time by body. Interval k lasts from k * interval to (k + 1) * interval; with an infinite
  /// interval everything happens in interval 0. Times must stay within 2^50 intervals of 0, where these
  /// products are still distinct.
  PiecewiseAcceleration(const std::vector<State>& start, double start_time,
                        double interval = std::numeric_limits<double>::infinity());

  /// The acceleration during what is left of interval k, for a body in `state` at the beginning of that: at
  /// the beginning of the interval, or later if the body was kicked in it. Must depend on nothing but the
  /// arguments and what changes only together with restart().
  virtual Vec3 acceleration(std::uint32_t body, std::int64_t k, const State& state) const = 0;

  /// Forgets the past: from t on the body moves on from `state`.
  void restart(std::uint32_t body, double t, const State& state);
  /// When the body was last kicked or restarted.
  double last_change(std::uint32_t body) const { return courses_[body].since; }
  /// A promise with the state at t, and no errors.
  BodyDefinition definition_with(std::uint32_t body, double t, double acceleration_limit,
                                 const Vec3& planned_acceleration = {}) const;

 private:
  /// All answers are found by walking from piece to piece, from the last kick on, so they are the same
  /// whichever piece is remembered.
  struct Course {
    double since;  ///< time of the last kick
    State state;   ///< then
    Segment piece;
  };

  const Segment& piece_at(std::uint32_t body, double t) const;
  Segment piece_from(std::uint32_t body, double t, const State& state) const;
  Segment piece_after(std::uint32_t body, const Segment& piece) const;
  std::int64_t interval_number(double t) const;

  double interval_;
  mutable std::vector<Course> courses_;
};

}  // namespace kinesphere
