// The base of motions whose acceleration is constant between fixed multiples of an interval.
//
// A motion of your own takes one function:
//
//   class Homing : public PiecewiseAcceleration {
//     Vec3 acceleration(std::uint32_t body, std::int64_t k, const State& state) const override;
//     ... definition(), clone()
//   };
//
// Where its bodies are to move to other motions it takes write_body() and read_body() too: they write and
// read departure() and what the class keeps of the body itself. examples/own_motion.cpp shows all of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "kinesphere/motion/motion.hpp"

namespace kinesphere {

class PiecewiseAcceleration : public Motion {
 public:
  std::size_t size() const final { return courses_.size(); }
  bool contains(std::uint32_t body) const final;
  /// Cost: O(1) when t has not gone back since the last call, else, and after read_body(), one step for every
  /// interval since the body's last change.
  /// Throws BadResult too for times beyond 2^50 intervals.
  State state(std::uint32_t body, double t) const final;
  Trajectory trajectory(std::uint32_t body, double begin, double end) const final;
  Result<void> set_velocity(std::uint32_t body, double t, const Vec3& velocity) final;
  Result<void> teleport(std::uint32_t body, double t, const State& state) final;
  MotionOrigin origin(std::uint32_t body) const final;
  Result<void> set_origin(std::uint32_t body, const MotionOrigin& origin) final;
  Result<void> remove(std::uint32_t body) final;

 protected:
  /// States at start_time by body. Interval k lasts from k * interval to (k + 1) * interval; with an infinite
  /// interval everything happens in interval 0. Times must stay within 2^50 intervals of 0, where these
  /// products are still distinct.
  PiecewiseAcceleration(const std::vector<State>& start, double start_time,
                        double interval = std::numeric_limits<double>::infinity());

  /// A body that moves on from `state` at time t. Returns its number: that of a removed body if there is one,
  /// else size() as it was. What a derived class keeps by body is to be set then. `call` begins the message
  /// of an error: not_finite; out_of_range for times that are too far from 0.
  Result<std::uint32_t> add_body(std::string_view call, double t, const State& state);
  /// Sets what a derived class keeps of a body that add_body() has returned.
  template <class Value>
  static void keep_of(std::vector<Value>& values, std::uint32_t body, Value value) {
    if (body == values.size()) values.emplace_back();
    values[body] = std::move(value);
  }

  /// The acceleration during what is left of interval k, for a body in `state` at the beginning of that: at
  /// the beginning of the interval, or later if the body was changed in it. Must depend on nothing but the
  /// arguments and what changes only together with restart(). Called from several threads at the same time,
  /// for different bodies, where the motion is used so.
  virtual Vec3 acceleration(std::uint32_t body, std::int64_t k, const State& state) const = 0;

  /// Forgets the past: from t on the body moves on from `state`.
  void restart(std::uint32_t body, double t, const State& state);
  /// When the body was last changed or restarted. Needs a body that is there.
  double last_change(std::uint32_t body) const { return courses_[body].since; }
  /// A promise with the state at t, and no errors.
  BodyDefinition definition_with(std::uint32_t body, double t, double acceleration_limit,
                                 const Vec3& planned_acceleration = {}) const;
  /// The same, with limits by body: they are not read before the body is known to be there.
  BodyDefinition definition_with(std::uint32_t body, double t, const std::vector<double>& limits) const;

 private:
  /// All answers are found by walking from piece to piece, from the last change on, so they are the same
  /// whichever piece is remembered.
  struct Course {
    double since;  ///< time of the last change; infinite once the body has been removed
    State state;   ///< then
    Segment piece;
  };

  const Segment& piece_at(std::uint32_t body, double t) const;
  Segment piece_from(std::uint32_t body, double t, const State& state) const;
  Segment piece_after(std::uint32_t body, const Segment& piece) const;
  std::int64_t interval_number(double t) const;
  const Segment& known_piece_at(std::uint32_t body, double t, std::string_view call,
                                std::string_view argument) const;
  /// 2^50 intervals.
  double latest_time() const;
  /// Whether the body can be changed at time t.
  Result<void> check_change(std::string_view call, std::uint32_t body, double t) const;

  double interval_;
  mutable std::vector<Course> courses_;
  std::vector<std::uint32_t> free_;  ///< numbers of removed bodies
};

}  // namespace kinesphere
