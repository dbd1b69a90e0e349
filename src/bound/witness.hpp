// Witnesses of a contact: a point in each of two hulls, of which the gap is at most their distance.
//
// Each is a mean of a few points that are fixed in its hull. It stays in the hull while the weights change,
// as long as none is negative. So the two can keep up with each other where hulls slide along each other or
// pass through each other, while a fixed point would leave the other hull at once.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bound/relative_motion.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

class Witness {
 public:
  explicit Witness(double time) : time_(time) {}

  /// Adds a point of each hull, with the weight of both. `radius`: as in BoundBesideBound.
  void add(const Bound& first, const Bound& second, double radius, double weight) {
    motions_[count_] = BoundBesideBound(first, second, time_, radius);
    weights_[count_++] = weight;
  }

  /// Certified time before which the gap of the hulls stays below `distance`, as earliest_separation().
  double separation(double until, double distance) const {
    const auto with = [&](const Rates& rates) {
      const BoundBesideBound mean = mean_with(rates);
      const double time =
          earliest_separation(mean.bound, Bound{.time = time_}, time_, until, distance - mean.slack);
      return std::min(time, stays_until(rates, until));
    };
    const double fixed = with({});
    return fixed == infinity ? fixed : std::max(fixed, with(following()));
  }
  /// Upper limit of the gap at the time of the witness.
  double largest_gap() const {
    const BoundBesideBound mean = mean_with({});
    return gap_limits(mean.bound, Bound{.time = time_}, time_).upper + mean.slack;
  }

 private:
  /// Rates at which the weights change (1 / time); their sum is 0.
  using Rates = std::array<double, 4>;

  Vec3 place(std::size_t k) const { return motions_[k].bound.position; }

  /// Returns the rates with which the first witness follows the second as far as the points let it.
  Rates following() const {
    Vec3 velocity;
    for (std::size_t k = 0; k < count_; ++k) velocity += motions_[k].bound.velocity * weights_[k];
    std::array<Vec3, 3> way;
    for (std::size_t k = 1; k < count_; ++k) way[k - 1] = place(k) - place(0);
    const auto& [u, v, w] = way;
    std::array<double, 3> moved{};  // along each way
    if (count_ == 2) {
      moved[0] = dot(velocity, u) / norm_squared(u);
    } else if (count_ == 3) {
      const Vec3 across = cross(u, v);
      const double square = norm_squared(across);
      moved = {dot(cross(velocity, v), across) / square, dot(cross(u, velocity), across) / square, 0.0};
    } else if (count_ == 4) {
      const double volume = dot(cross(u, v), w);
      moved = {dot(cross(velocity, v), w) / volume, dot(cross(u, velocity), w) / volume,
               dot(cross(u, v), velocity) / volume};
    }
    Rates rates{};
    for (std::size_t k = 1; k < count_; ++k) {
      if (!std::isfinite(moved[k - 1])) return {};
      rates[k] = -moved[k - 1];
      rates[0] -= rates[k];
    }
    return rates;
  }

  /// Returns the time until which no weight is negative, or +infinity if that is after `until`.
  double stays_until(const Rates& rates, double until) const {
    double duration = infinity;
    for (std::size_t k = 0; k < count_; ++k)
      if (rates[k] < 0.0) duration = std::min(duration, weights_[k] / -rates[k]);
    const double time = rounding::sum_down(time_, duration * (1.0 - rounding::margin));
    return time > until ? infinity : std::max(time, time_);
  }

  /// Returns the motion of the first witness relative to the second. With P, V and G the position, velocity
  /// and plan of a point, its mean with the weights L + M s, the sum of M being 0, is
  ///   sum(L P) + (sum(L V) + sum(M P)) s + 1/2 (G + 2 sum(M V)) s^2.
  BoundBesideBound mean_with(const Rates& rates) const {
    BoundBesideBound mean = motions_[0];
    Bound& bound = mean.bound;
    bound.position = bound.velocity = {};
    double position_size = 0.0, velocity_size = 0.0, acceleration_size = norm_one(bound.planned_acceleration);
    for (std::size_t k = 0; k < count_; ++k) {
      const Bound& point = motions_[k].bound;
      bound.position += point.position * weights_[k];
      bound.velocity += point.velocity * weights_[k] + point.position * rates[k];
      bound.planned_acceleration += point.velocity * (2.0 * rates[k]);
      bound.radius = std::min(bound.radius, point.radius);
      bound.growth_speed = std::max(bound.growth_speed, point.growth_speed);
      bound.acceleration_limit = std::max(bound.acceleration_limit, point.acceleration_limit);
      mean.slack = std::max(mean.slack, motions_[k].slack);
      const double rate = std::abs(rates[k]);
      position_size = std::max(position_size, norm_one(point.position));
      velocity_size += norm_one(point.velocity) + norm_one(point.position) * rate;
      acceleration_size += 2.0 * norm_one(point.velocity) * rate;
    }
    mean.slack += rounding::margin * position_size;
    bound.growth_speed += rounding::margin * velocity_size;
    bound.acceleration_limit += rounding::margin * acceleration_size;
    return mean;
  }

  double time_;
  std::array<BoundBesideBound, 4> motions_{BoundBesideBound{Bound{}}, BoundBesideBound{Bound{}},
                                           BoundBesideBound{Bound{}}, BoundBesideBound{Bound{}}};
  std::array<double, 4> weights_{};
  std::size_t count_ = 0;
};

}  // namespace kinesphere
