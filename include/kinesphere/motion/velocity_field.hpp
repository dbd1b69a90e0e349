// VelocityField: bodies that follow a velocity field within a limited acceleration (paper, section 4.3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "kinesphere/motion/piecewise_acceleration.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

/// The velocity field of the paper's example: up along the centre line of a box, out under the top, down
/// the sides, in along the bottom. With x', y' in [-1, 1] across the box of half widths a and b, z' in [0,
/// 1] up its height H, and h(z) = 4 z (1 - z), q(s) = 1 - 3 s^2, Q(s) = s - s^3 (so Q' = q),
///   w =  speed h(z') (q(x') + q(y')) / 2
///   u = -speed h'(z') Q(x') a / (2 H),    v = -speed h'(z') Q(y') b / (2 H).
/// The field has no divergence, no flow through the walls, and w = speed in the middle. Outside the box it
/// equals the field at the nearest point of the box.
struct Circulation {
  Box box{};           ///< with lower < upper on every axis
  double speed = 0.0;  ///< (length / time)

  /// Returns the velocity at a position.
  Vec3 operator()(const Vec3& position) const;
};

/// The bodies of a VelocityField, and the field that they follow.
struct VelocityFieldDefinition {
  /// Velocity by position: a Circulation, or a user-defined function, which must always return the same
  /// finite value for the same argument.
  std::function<Vec3(const Vec3&)> field;
  /// States at start_time, by body.
  std::vector<State> start{};
  /// A >= 0 (length / time^2), by body.
  std::vector<double> acceleration_limits{};
  /// > 0 (time): bodies sample the field at its multiples, and when their velocity is set.
  double interval = 0.1;
  /// > 0 (time): time in which a body would reach the velocity of the field if its limit permits. Less than
  /// half the interval causes growing overshoot.
  double response_time = 0.5;
  double start_time = 0.0;
};

/// During each interval the acceleration is constant: (field(x) - v) / response_time with x and v at the
/// beginning of the interval, shortened to the body's limit if it is longer.
class VelocityField final : public PiecewiseAcceleration {
 public:
  /// Creates the motion. Errors: not_finite or out_of_range, naming the field of the definition and the
  /// body.
  static Result<VelocityField> create(VelocityFieldDefinition definition);

  /// Adds a body that continues from `state` at time t, and returns its number. Errors: not_finite (also if
  /// the field is not finite there); out_of_range for a negative limit and for times beyond 2^50 intervals.
  Result<std::uint32_t> add(double t, const State& state, double acceleration_limit);

  /// Returns the velocity field; std::function::target() tells which one.
  const std::function<Vec3(const Vec3&)>& field() const { return field_; }
  double response_time() const { return response_time_; }

  BodyDefinition definition(std::uint32_t body, double t) const override;
  Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const override;
  Result<std::uint32_t> read_body(std::span<const std::byte>& bytes) override;
  std::unique_ptr<Motion> clone() const override;

 private:
  explicit VelocityField(VelocityFieldDefinition definition);
  Vec3 acceleration(std::uint32_t body, std::int64_t k, const State& state) const override;

  std::function<Vec3(const Vec3&)> field_;
  std::vector<double> limits_;
  double response_time_;
};

}  // namespace kinesphere
