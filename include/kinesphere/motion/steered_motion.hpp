// SteeredMotion: bodies steered from outside, by a player, a test or a controller.
//
//   SteeredMotion ships = SteeredMotion::create({.start = states, .acceleration_limits = limits}).value();
//   ships.steer(3, world.time(), {0, 0, 5}).value();  // from now on, until the next call
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kinesphere/motion/piecewise_acceleration.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

/// The bodies of a SteeredMotion.
struct SteeredMotionDefinition {
  /// States at start_time, by body.
  std::vector<State> start{};
  /// A >= 0 (length / time^2), by body.
  std::vector<double> acceleration_limits{};
  double start_time = 0.0;

  friend bool operator==(const SteeredMotionDefinition&, const SteeredMotionDefinition&) = default;
};

/// Each body keeps its acceleration, at first zero, until it is steered again. Steering does not change
/// position and velocity, so the world needs no notice of it; set_velocity() does not change the
/// acceleration. States before the last change of a body are discarded.
class SteeredMotion final : public PiecewiseAcceleration {
 public:
  /// Creates the motion. Errors: not_finite or out_of_range, naming the field and the body.
  static Result<SteeredMotion> create(SteeredMotionDefinition definition);

  /// Adds a body that continues from `state` at time t, at first without acceleration, and returns its
  /// number. Errors: not_finite; out_of_range for a negative limit.
  Result<std::uint32_t> add(double t, const State& state, double acceleration_limit);

  /// Sets the acceleration (length / time^2) of a body from t on. Errors: unknown_body; stale_body;
  /// not_finite; out_of_range if it is longer than the body's limit; time_backwards if t lies before the
  /// last change of the body.
  Result<void> steer(std::uint32_t body, double t, const Vec3& acceleration);

  /// Returns the definition. Its acceleration limit exceeds the given one by a relative 1e-12, so that an
  /// acceleration scaled to the given length is valid however it was rounded.
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
