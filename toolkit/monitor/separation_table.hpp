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
        modified_taus_(classes_),
        stretches_(classes_, 1.0),
        look_aheads_(classes_) {
    for (const SeparationRule& rule : definition.separations) {
      const auto [a, b, levels] = rule;
      std::vector<Components>& components = of_pairs_[std::min(a, b) * classes_ + std::max(a, b)];
      for (const Separation& level : levels) {
        components.emplace_back(level, definition.dimensions, definition.tolerance);
        const double margin = 0.5 * reach_of(level, definition.dimensions) + 2.0 * definition.tolerance;
        const double look_ahead = level.look_ahead > 0.0 ? level.look_ahead + level.modified_tau : 0.0;
        for (const std::size_t of : {a, b}) {
          margins_[of] = std::max(margins_[of], margin);
          modified_taus_[of] = std::max(modified_taus_[of], level.modified_tau);
          stretches_[of] = std::max(stretches_[of], components.back().begin()->stretch);
          look_aheads_[of] = std::max(look_aheads_[of], look_ahead);
        }
      }
    }
  }

  std::span<const Components> between(std::size_t a, std::size_t b) const {
    return of_pairs_[std::min(a, b) * classes_ + std::max(a, b)];
  }
  /// Returns the search margin of a class. Two tracks within any separation, or outside of it by at most
  /// about the tolerance, are no farther apart than the sum of their margins, and of their horizontal speeds
  /// times modified_tau().
  double margin(std::size_t track_class) const { return margins_[track_class]; }
  /// Returns the largest modified tau of all separations of a class.
  double modified_tau(std::size_t track_class) const { return modified_taus_[track_class]; }
  /// Returns the largest Component::stretch of all separations of a class, at least 1.
  double stretch(std::size_t track_class) const { return stretches_[track_class]; }
  /// Returns the longest look-ahead time of all separations of a class, each with its modified tau: if two
  /// that go straight on lose well clear, their horizontal distance falls to Separation::horizontal at most
  /// that much later.
  double look_ahead(std::size_t track_class) const { return look_aheads_[track_class]; }

 private:
  static double reach_of(const Separation& separation, int dimensions) {
    const auto& [shape, horizontal, vertical, look_ahead, modified_tau] = separation;
    if (dimensions == 2) return horizontal;
    return shape == Separation::Shape::ellipsoid ? std::max(horizontal, vertical)
                                                 : ErrorBound::cylinder(horizontal, vertical).total();
  }

  std::size_t classes_;
  std::vector<std::vector<Components>> of_pairs_;
  std::vector<double> margins_;
  std::vector<double> modified_taus_;
  std::vector<double> stretches_;
  std::vector<double> look_aheads_;
};

}  // namespace kinesphere
