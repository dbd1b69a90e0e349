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
  /// Of a body that has none yet, or to be read into.
  Horizon() = default;
  Horizon(double first_way, double contact_tolerance) : way_(possible(first_way, contact_tolerance)) {}

  bool is_chosen() const { return way_ > 0.0; }

  /// The way may be far too long among so many. What is learnt takes bodies to be spread evenly in a box, and
  /// weighs the cost of a search, which is made once; neighbours cost as long as they are near, which may be
  /// for ever among slow bodies that lie in clusters. The body's own width leaves no choice.
  bool is_crowded(std::size_t candidates, double body_width) const {
    constexpr std::size_t many = 64;
    return candidates > many && way_ > body_width;
  }
  /// How far the body may go in its next box (length).
  double way() const { return way_; }
  void halve(double contact_tolerance) { way_ = possible(0.5 * way_, contact_tolerance); }

  /// Whether a box counts as `larger` beside one of the other extent.
  static bool is_larger(double extent, double than_extent) { return extent > 4.0 * than_extent; }

  /// Learns from a search with a box of this extent, and chooses the next way.
  void learn(std::size_t candidates, std::size_t larger, double box_extent, double body_width,
             double contact_tolerance, int dimensions = 3) {
    const double reach = 2.0 * std::max(box_extent, shortest_way * contact_tolerance);
    const double size = dimensions == 2 ? reach * reach : reach * reach * reach;
    density_ += learning_rate * (static_cast<double>(candidates - larger) / size - density_);
    const double fixed_cost = registration_cost + static_cast<double>(larger);
    if (dimensions == 2) {
      const double best = std::sqrt(body_width * body_width + fixed_cost / (4.0 * density_));
      way_ = possible(std::clamp(best, 0.5 * way_, 2.0 * way_), contact_tolerance);
      return;
    }
    const double w = body_width;
    const double target = w * w * w + fixed_cost / (8.0 * density_);
    double way = way_;
    // One step of Newton's method goes too far up, the second one comes back.
    for (int step = 0; step < 2; ++step) {
      const double excess = (2.0 * way + 3.0 * w) * way * way - target;
      way = std::clamp(way - excess / (6.0 * way * (way + w)), 0.5 * way_, 2.0 * way_);
    }
    way_ = possible(way, contact_tolerance);
  }

  /// The horizon (time) of a body with this square of its speed, and this acceleration.
  double length(double squared_speed, double acceleration) const {
    const double speed_at_the_end = std::sqrt(squared_speed + 2.0 * acceleration * way_);
    return std::min(2.0 * way_ / (std::sqrt(squared_speed) + speed_at_the_end), longest);
  }

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [way, density] = self;
    archive(way, density);
  }
  /// For one that was read: true when it could have been chosen and have learnt this.
  bool is_sound(double contact_tolerance) const {
    return std::isfinite(way_) && way_ == possible(way_, contact_tolerance) && density_ >= 0.0 &&
           std::isfinite(density_);
  }

 private:
  static constexpr double registration_cost = 4.0;
  static constexpr double learning_rate = 0.25;
  /// For a body at rest, in any unit of time: its horizon must be finite.
  static constexpr double longest = 0x1p100;
  /// In contact tolerances: of a body among others at the same place, whom no smaller box would shut out.
  static constexpr double shortest_way = 0x1p8;
  /// In contact tolerances: of a body that is alone.
  static constexpr double longest_way = 0x1p40;

  static double possible(double way, double contact_tolerance) {
    return std::clamp(way, shortest_way * contact_tolerance, longest_way * contact_tolerance);
  }

  double way_ = 0.0;      ///< length; 0: none is chosen yet
  double density_ = 0.0;  ///< bodies per volume, or per area in two dimensions
};

}  // namespace kinesphere
