// How long a registered box should last: a small cost model per body.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kinesphere {

/// A long horizon means few registrations, but a large box that meets many others. A registration whose box
/// leaves the body a way D beyond its own width w costs about `registration_cost + density (2 (w + D))^3`
/// candidate tests and lasts in proportion to D. Per unit of time that is least where 2 D^3 + 3 w D^2 = w^3 +
/// registration_cost / (8 density).
class Horizon {
 public:
  /// `longest_way` (length) is for a body that is alone.
  Horizon(double first_way, double longest_way) : way_(first_way), longest_way_(longest_way) {}

  /// Learns from a search with a box of this extent, and chooses the next way.
  void learn(std::size_t candidates, double box_extent, double body_width) {
    const double reach = 2.0 * box_extent;
    density_ += learning_rate * (static_cast<double>(candidates) / (reach * reach * reach) - density_);
    const double w = body_width;
    const double target = w * w * w + registration_cost / (8.0 * density_);
    double way = way_;
    for (int step = 0; step < 3; ++step) {
      const double excess = (2.0 * way + 3.0 * w) * way * way - target;
      way -= excess / (6.0 * way * (way + w));
      way = std::clamp(way, 0.5 * way_, 2.0 * way_);
    }
    way_ = std::min(way, longest_way_);
  }

  /// The horizon (time) of a body with this speed and acceleration.
  double length(double speed, double acceleration) const {
    return std::min(2.0 * way_ / (speed + std::sqrt(speed * speed + 2.0 * acceleration * way_)), longest);
  }

 private:
  static constexpr double registration_cost = 4.0;
  static constexpr double learning_rate = 0.25;
  /// For a body at rest, in any unit of time: its horizon must be finite.
  static constexpr double longest = 0x1p100;

  double way_;
  double longest_way_;
  double density_ = 0.0;
};

}  // namespace kinesphere
