// Bodies steered by hand: by a player, a test, a controller outside.
//
//   Steered ships = Steered::create({.start = states, .acceleration_limits = limits}).value();
//   ships.steer(3, world.time(), {0, 0, 5}).value();  // from now on, until told otherwise
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kinesphere/motion/piecewise_acceleration.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

struct SteeredMotionDefinition {
  /// States at start_time, by body.
  std::vector<State> start;
  /// A >= 0 (length / time^2), by body.
  std::vector<double> acceleration_limits;
  double start_time = 0.0;
};

/// Each body keeps its acceleration, at first zero, until it is steered again. Steering leaves position and
/// velocity as they are, so the world need not hear of it; set_velocity() leaves the acceleration as it is.
/// States before the last change of a body are forgotten.
class SteeredMotion final : public PiecewiseAcceleration {
 public:
  /// Errors: not_finite or out_of_range, naming the field and the body.
  static Result<SteeredMotion> create(SteeredMotionDefinition definition);

  /// Adds a body that moves on from `state` at time t, at first without acceleration, and returns its number.
  /// Errors: not_finite; out_of_range for a negative limit.
  Result<std::uint32_t> add(double t, const State& state, double acceleration_limit);

  /// Sets the acceleration of a body from t on. Errors: unknown_body; stale_body; not_finite; out_of_range
  /// when it is longer than the body's limit; time_backwards when t lies before the last change of the
  /// body.
  Result<void> steer(std::uint32_t body, double t, const Vec3& acceleration);

  /// The limit is a relative 1e-12 more than that of the definition, so that an acceleration that was scaled
  /// to that length passes however it was rounded.
  BodyDefinition definition(std::uint32_t body, double t) const override;
  Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const override;
  Result<std::uint32_t> read_body(std::span<const std::byte>& bytes) override;
  std::unique_ptr<Motion> clone() const override;

 private:
  explicit SteeredMotion(SteeredMotionDefinition definition);
  Vec3 acceleration(std::uint32_t body, std::int64_t, const State&) const override {
    return accelerations_[body];
  }

  std::vector<double> limits_;
  std::vector<Vec3> accelerations_;
};

}  // namespace kinesphere
