// How long a registered box should last: a small cost model per body.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kinesphere {

/// A long horizon means few registrations, but a large box that meets many others. A registration whose box
/// leaves the body a way D beyond its own width w costs about `registration_cost + larger + density (2 (w +
/// D))^3` candidate tests and lasts in proportion to D; `larger` are those with boxes so much larger that
/// this one lies within them whatever its own size is. Per unit of time that is least where 2 D^3 + 3 w D^2 =
/// w^3 + (registration_cost + larger) / (8 density). In two dimensions the square of 2 (w + D) stands for the
/// cube, and it is least where D^2 = w^2 + (registration_cost + larger) / (4 density).
class Horizon {
 public:
  /// To be read into.
  Horizon() = default;
  /// Between these lengths the way is chosen: the longest is for a body that is alone, the shortest for one
  /// among others at the same place, whom no smaller box would shut out.
  Horizon(double first_way, double shortest_way, double longest_way)
      : way_(std::clamp(first_way, shortest_way, longest_way)),
        shortest_way_(shortest_way),
        longest_way_(longest_way) {}

  static Horizon of_new_body(double first_way, double contact_tolerance) {
    return {first_way, 0x1p8 * contact_tolerance, 0x1p40 * contact_tolerance};
  }

  /// Whether a box counts as `larger` beside one of the other extent.
  static bool is_larger(double extent, double than_extent) { return extent > 4.0 * than_extent; }

  /// Learns from a search with a box of this extent, and chooses the next way.
  void learn(std::size_t candidates, std::size_t larger, double box_extent, double body_width,
             int dimensions = 3) {
    const double reach = 2.0 * std::max(box_extent, shortest_way_);
    const double size = dimensions == 2 ? reach * reach : reach * reach * reach;
    density_ += learning_rate * (static_cast<double>(candidates - larger) / size - density_);
    const double fixed_cost = registration_cost + static_cast<double>(larger);
    if (dimensions == 2) {
      const double best = std::sqrt(body_width * body_width + fixed_cost / (4.0 * density_));
      way_ = std::clamp(std::clamp(best, 0.5 * way_, 2.0 * way_), shortest_way_, longest_way_);
      return;
    }
    const double w = body_width;
    const double target = w * w * w + fixed_cost / (8.0 * density_);
    double way = way_;
    for (int step = 0; step < 3; ++step) {
      const double excess = (2.0 * way + 3.0 * w) * way * way - target;
      way -= excess / (6.0 * way * (way + w));
      way = std::clamp(way, 0.5 * way_, 2.0 * way_);
    }
    way_ = std::clamp(way, shortest_way_, longest_way_);
  }

  /// The horizon (time) of a body with this speed and acceleration.
  double length(double speed, double acceleration) const {
    return std::min(2.0 * way_ / (speed + std::sqrt(speed * speed + 2.0 * acceleration * way_)), longest);
  }

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [way, shortest, longest_way, density] = self;
    archive(way, shortest, longest_way, density);
  }
  /// For one that was read: true when it could have been made and have learnt this.
  bool is_sound(double contact_tolerance) const {
    const Horizon made = of_new_body(way_, contact_tolerance);
    return shortest_way_ == made.shortest_way_ && longest_way_ == made.longest_way_ && way_ == made.way_ &&
           std::isfinite(way_) && density_ >= 0.0 && std::isfinite(density_);
  }

 private:
  static constexpr double registration_cost = 4.0;
  static constexpr double learning_rate = 0.25;
  /// For a body at rest, in any unit of time: its horizon must be finite.
  static constexpr double longest = 0x1p100;

  double way_ = 0.0;
  double shortest_way_ = 0.0;
  double longest_way_ = 0.0;
  double density_ = 0.0;
};

}  // namespace kinesphere
