// Which separations count between tracks of two classes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "monitor/claim.hpp"

namespace kinesphere {

class Levels {
 public:
  explicit Levels(const MonitorDefinition& definition)
      : classes_(definition.classes.size()), of_pairs_(classes_ * classes_), rooms_(classes_) {
    for (const SeparationRule& rule : definition.separations) {
      const auto [a, b, levels] = rule;
      std::vector<Components>& components = of_pairs_[std::min(a, b) * classes_ + std::max(a, b)];
      for (const Separation& level : levels) {
        components.emplace_back(level, definition.dimensions, definition.tolerance);
        const double room = 0.5 * reach_of(level, definition.dimensions) + 2.0 * definition.tolerance;
        rooms_[a] = std::max(rooms_[a], room);
        rooms_[b] = std::max(rooms_[b], room);
      }
    }
  }

  std::span<const Components> between(std::size_t a, std::size_t b) const {
    return of_pairs_[std::min(a, b) * classes_ + std::max(a, b)];
  }
  /// Two tracks that are within any separation, or about the tolerance outside, are no farther apart than
  /// their rooms together.
  double room(std::size_t track_class) const { return rooms_[track_class]; }

 private:
  static double reach_of(const Separation& separation, int dimensions) {
    const auto& [shape, horizontal, vertical] = separation;
    if (dimensions == 2) return horizontal;
    return shape == Separation::Shape::cylinder ? Spread::cylinder(horizontal, vertical).total()
                                                : std::max(horizontal, vertical);
  }

  std::size_t classes_;
  std::vector<std::vector<Components>> of_pairs_;
  std::vector<double> rooms_;
};

}  // namespace kinesphere
