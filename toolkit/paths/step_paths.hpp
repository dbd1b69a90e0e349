// Paths over the steps of a block of time: a chord for each body and step, with a proven deviation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "paths/arc_table.hpp"

namespace kinesphere {

/// Equal steps of time, the last of which may be shorter.
struct Steps {
  double begin, end, length;
  std::size_t count;

  static Steps of(double begin, double end, double length);
  double time(std::size_t step) const {
    return step >= count ? end : begin + static_cast<double>(step) * length;
  }
};

/// A body during a step: at the part x in [0, 1] of the step it is within `radius` of
///   begin + (end - begin) x + 4 bend x (1 - x)
/// if it exists then. The radius is negative if it does not exist in the step at all.
struct StepPath {
  Vec3 begin{}, end{}, bend{};
  double radius = -1.0;

  bool exists() const { return radius >= 0.0; }
};

/// The bodies' paths in successive steps. Buffers are kept from one block to the next.
class StepPaths {
 public:
  explicit StepPaths(const ArcTable& arcs) : arcs_(arcs) {}

  /// Computes the paths in the steps from `first` to before `last`.
  void compute(const Steps& steps, std::size_t first, std::size_t last);
  /// Returns the paths of all bodies in a step, counted from the first that was computed.
  std::span<const StepPath> at(std::size_t step) const {
    return {paths_.data() + step * arcs_.bodies(), arcs_.bodies()};
  }

 private:
  void compute(std::size_t body);
  void compute_within(std::size_t body, std::size_t arc, std::size_t first, std::size_t last);
  StepPath across(std::size_t body, std::size_t arc, double from, double to);

  const ArcTable& arcs_;
  std::vector<double> times_;  ///< begin and middle of each step, then the end of the last
  std::vector<Vec3> points_;   ///< positions at times_
  std::vector<StepPath> paths_;
};

}  // namespace kinesphere
