// Ballistic: bodies in free flight under a common gravity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kinesphere/motion/piecewise_acceleration.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

/// The bodies of a Ballistic motion.
struct BallisticDefinition {
  /// States at start_time, by body.
  std::vector<State> start{};
  /// Gravity of all bodies (length / time^2).
  Vec3 gravity{};
  double start_time = 0.0;

  friend bool operator==(const BallisticDefinition&, const BallisticDefinition&) = default;
};

/// Free flight: gravity is the planned acceleration, and the acceleration limit is 0.
class Ballistic final : public PiecewiseAcceleration {
 public:
  /// Creates the motion. Errors: not_finite, naming the field and the body.
  static Result<Ballistic> create(const BallisticDefinition& definition);

  /// Adds a body that continues from `state` at time t, and returns its number. Errors: not_finite.
  Result<std::uint32_t> add(double t, const State& state) { return add_body("add", t, state); }

  /// Returns the common gravity (length / time^2).
  const Vec3& gravity() const { return gravity_; }

  BodyDefinition definition(std::uint32_t body, double t) const override;
  Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const override;
  Result<std::uint32_t> read_body(std::span<const std::byte>& bytes) override;
  std::unique_ptr<Motion> clone() const override;

 private:
  explicit Ballistic(const BallisticDefinition& definition);
  Vec3 acceleration(std::uint32_t, std::int64_t, const State&) const override { return gravity_; }

  Vec3 gravity_;
};

}  // namespace kinesphere
