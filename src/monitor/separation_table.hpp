// Lookup of the separations between two track classes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "monitor/reachable_set.hpp"

namespace kinesphere {

class SeparationTable {
 public:
  explicit SeparationTable(const MonitorDefinition& definition)
      : classes_(definition.classes.size()),
        of_pairs_(classes_ * classes_),
        margins_(classes_),
        look_aheads_(classes_) {
    for (const SeparationRule& rule : definition.separations) {
      const auto [a, b, levels] = rule;
      std::vector<Components>& components = of_pairs_[std::min(a, b) * classes_ + std::max(a, b)];
      for (const Separation& level : levels) {
        components.emplace_back(level, definition.dimensions, definition.tolerance);
        const double margin = 0.5 * reach_of(level, definition.dimensions) + 2.0 * definition.tolerance;
        margins_[a] = std::max(margins_[a], margin);
        margins_[b] = std::max(margins_[b], margin);
        look_aheads_[a] = std::max(look_aheads_[a], level.look_ahead);
        look_aheads_[b] = std::max(look_aheads_[b], level.look_ahead);
      }
    }
  }

  std::span<const Components> between(std::size_t a, std::size_t b) const {
    return of_pairs_[std::min(a, b) * classes_ + std::max(a, b)];
  }
  /// Returns the search margin of a class. Two tracks within any separation, or outside of it by at most
  /// about the tolerance, are no farther apart than the sum of their margins.
  double margin(std::size_t track_class) const { return margins_[track_class]; }
  /// Returns the longest look-ahead time of all separations of a class.
  double look_ahead(std::size_t track_class) const { return look_aheads_[track_class]; }

 private:
  static double reach_of(const Separation& separation, int dimensions) {
    const auto& [shape, horizontal, vertical, look_ahead] = separation;
    if (dimensions == 2) return horizontal;
    return shape == Separation::Shape::cylinder ? ErrorBound::cylinder(horizontal, vertical).total()
                                                : std::max(horizontal, vertical);
  }

  std::size_t classes_;
  std::vector<std::vector<Components>> of_pairs_;
  std::vector<double> margins_;
  std::vector<double> look_aheads_;
};

}  // namespace kinesphere
