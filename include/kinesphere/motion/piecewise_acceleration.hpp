// PiecewiseAcceleration: base class of motions with constant acceleration between multiples of an interval.
//
// A user-defined motion needs one function:
//
//   class Homing : public PiecewiseAcceleration {
//     Vec3 acceleration(std::uint32_t body, std::int64_t k, const State& state) const override;
//     ... definition(), clone()
//   };
//
// If its bodies are to move to other motions it also needs write_body() and read_body(), which write and
// read origin() and the data that the class stores for the body. examples/own_motion.cpp shows all of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "kinesphere/motion/motion.hpp"

namespace kinesphere {

/// A motion whose accelerations are constant in each interval of time; a base class for motions of your own.
class PiecewiseAcceleration : public Motion {
 public:
  std::size_t size() const final { return paths_.size(); }
  bool contains(std::uint32_t body) const final;
  /// Returns the state at time t. Also throws BadResult for times beyond 2^50 intervals. Cost: O(1) if t
  /// has not decreased since the last call; otherwise, and after read_body(), one step for every interval
  /// since the body's last change.
  State state(std::uint32_t body, double t) const final;
  Trajectory trajectory(std::uint32_t body, double begin, double end) const final;
  Result<void> set_velocity(std::uint32_t body, double t, const Vec3& velocity) final;
  Result<void> teleport(std::uint32_t body, double t, const State& state) final;
  MotionOrigin origin(std::uint32_t body) const final;
  Result<void> set_origin(std::uint32_t body, const MotionOrigin& origin) final;
  Result<void> remove(std::uint32_t body) final;

  /// Returns the length of the intervals (time); infinite if there is only one.
  double interval() const { return interval_; }

 protected:
  /// Creates bodies from their states at start_time. Interval k lasts from k * interval to (k + 1) *
  /// interval; with an infinite interval everything happens in interval 0. Times must stay within 2^50
  /// intervals of 0, where these products are still distinct.
  PiecewiseAcceleration(const std::vector<State>& start, double start_time,
                        double interval = std::numeric_limits<double>::infinity());

  /// Adds a body that continues from `state` at time t. Returns its number: that of a removed body if there
  /// is one, else the former size(). The derived class must then set its own data of the body. `call`
  /// begins the message of an error. Errors: not_finite; out_of_range for times too far from 0.
  Result<std::uint32_t> add_body(std::string_view call, double t, const State& state);
  /// Sets the derived class's data of a body that add_body() has returned.
  template <class Value>
  static void keep_of(std::vector<Value>& values, std::uint32_t body, Value value) {
    if (body == values.size()) values.emplace_back();
    values[body] = std::move(value);
  }

  /// Returns the acceleration (length / time^2) during the rest of interval k for a body in `state` at the
  /// start of that rest: the beginning of the interval, or the time of a change in it. It must depend on
  /// nothing but the arguments and data that changes only together with restart(). Several threads call it
  /// concurrently for different bodies if they use the motion concurrently.
  virtual Vec3 acceleration(std::uint32_t body, std::int64_t k, const State& state) const = 0;

  /// Discards the history: from t on the body continues from `state`.
  void restart(std::uint32_t body, double t, const State& state);
  /// Returns the time when the body was last changed or restarted. Needs a body that exists.
  double last_change(std::uint32_t body) const { return paths_[body].since; }
  /// Returns a definition with these motion limits, the state at t, and zero errors.
  BodyDefinition definition_with(std::uint32_t body, double t, double acceleration_limit,
                                 const Vec3& planned_acceleration = {}) const;
  /// Returns such a definition with the limit of the body from `limits`, which is read only after the body
  /// is known to exist.
  BodyDefinition definition_with(std::uint32_t body, double t, const std::vector<double>& limits) const;

 private:
  /// History of one body. All results are computed piece by piece from the last change on, so they do not
  /// depend on which piece is cached.
  struct Path {
    double since;  ///< time of the last change; infinite once the body has been removed
    State state;   ///< state at that time
    Segment piece;
  };

  const Segment& piece_at(std::uint32_t body, double t) const;
  Segment piece_from(std::uint32_t body, double t, const State& state) const;
  Segment piece_after(std::uint32_t body, const Segment& piece) const;
  std::int64_t interval_number(double t) const;
  const Segment& known_piece_at(std::uint32_t body, double t, std::string_view call,
                                std::string_view argument) const;
  /// Returns the latest valid time: 2^50 intervals.
  double latest_time() const;
  /// Returns an error if the body cannot be changed at time t.
  Result<void> check_change(std::string_view call, std::uint32_t body, double t) const;

  double interval_;
  mutable std::vector<Path> paths_;
  std::vector<std::uint32_t> free_;  ///< numbers of removed bodies
};

}  // namespace kinesphere
