// RandomForces: bodies under random forces that change at fixed times (the first experiment of the paper).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kinesphere/motion/piecewise_acceleration.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

/// The bodies of a RandomForces motion, and their forces.
struct RandomForcesDefinition {
  /// States at start_time, by body.
  std::vector<State> start{};
  /// A >= 0 (length / time^2), by body.
  std::vector<double> acceleration_limits{};
  /// > 0 (time): forces change at its multiples.
  double interval = 0.2;
  std::uint64_t seed = 1;
  double start_time = 0.0;

  friend bool operator==(const RandomForcesDefinition&, const RandomForcesDefinition&) = default;
};

/// During each interval a body has a constant acceleration, drawn uniformly from the ball of radius A. The
/// draw depends on nothing but (seed, name of the body, interval), so set_velocity() does not change the
/// force. The name of a body is its number in the motion that created it, and stays with it through
/// read_body(). Bodies that were created in different motions and come together may therefore have equal
/// names and equal forces.
class RandomForces final : public PiecewiseAcceleration {
 public:
  /// Creates the motion. Errors: not_finite or out_of_range, naming the field and the body.
  static Result<RandomForces> create(RandomForcesDefinition definition);

  /// Adds a body that continues from `state` at time t, and returns its number, which is also its name.
  /// Errors: not_finite; out_of_range for a negative limit and for times beyond 2^50 intervals.
  Result<std::uint32_t> add(double t, const State& state, double acceleration_limit);

  /// Returns the seed of the definition.
  std::uint64_t seed() const { return seed_; }

  BodyDefinition definition(std::uint32_t body, double t) const override;
  Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const override;
  Result<std::uint32_t> read_body(std::span<const std::byte>& bytes) override;
  std::unique_ptr<Motion> clone() const override;

 private:
  explicit RandomForces(RandomForcesDefinition definition);
  Vec3 acceleration(std::uint32_t body, std::int64_t k, const State& state) const override;

  std::vector<double> limits_;
  std::vector<std::uint32_t> names_;  ///< names under which forces are drawn
  std::uint64_t seed_;
};

}  // namespace kinesphere
