// Pairs of bodies that may come near each other during a step.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "paths/step_paths.hpp"
#include "space/stretch_grid.hpp"

namespace kinesphere {

class NearPairs {
 public:
  /// With `only`, pairs of that body alone are found.
  NearPairs(double distance, std::optional<std::uint32_t> only);

  /// Calls visit(first, second), first < second, for each pair that may come within the distance.
  template <class Visit>
  void find(std::span<const StepPath> paths, Visit visit) {
    found_.clear();
    if (only_) {
      find_of_one(paths);
    } else {
      find_of_all(paths);
    }
    for (const auto& [a, b] : found_) visit(std::min(a, b), std::max(a, b));
  }
  /// Estimate of the work of the last find(), in nanoseconds: a measure that is the same in every run.
  double work() const { return work_; }

 private:
  struct Pair {
    std::uint32_t a, b;
  };
  void find_of_one(std::span<const StepPath> paths);
  void find_of_all(std::span<const StepPath> paths);
  bool may_meet(const StepPath& a, const StepPath& b) const;

  double distance_;
  std::optional<std::uint32_t> only_;
  StretchGrid grid_;
  std::vector<Stretch> stretches_;
  std::vector<Pair> found_;
  double work_ = 0.0;
};

}  // namespace kinesphere
