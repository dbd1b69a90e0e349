// Is what a detector found the truth? Its begins and ends against the oracle's, one by one.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulation/detector/detector.hpp"
#include "simulation/run/simulate.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

struct ContactComparison {
  /// Begins and ends that both report, with the true gap within the promise at the detector's time.
  std::uint64_t matched = 0;
  /// Those that one of the two reports and the promise leaves open: the gap only grazes the tolerance.
  std::uint64_t grazing = 0;
  /// What the detector reported, but later than the promise allows.
  std::uint64_t late = 0;
  /// What it should have reported and did not, and the reverse.
  std::uint64_t missed = 0;
  std::uint64_t invented = 0;
  /// Times of the oracle at which the bare distance is not what it should be: a fault of the oracle.
  std::uint64_t oracle_faults = 0;
  double largest_time_difference = 0.0;  ///< among the matched
  std::optional<std::string> first_difference;

  bool agrees() const { return late == 0 && missed == 0 && invented == 0 && oracle_faults == 0; }
};

/// Told now and then which part of a comparison is done, from 0 to 1.
using ComparisonProgress = std::function<void(double part)>;

/// Compares the events of a run of `scene` with the truth: the exact course of the gap of all bodies that
/// come near each other, along their trajectories, without any bound or engine. Only for scenes in which
/// nobody bounces: with bounces two correct programs drift apart. Errors: unsupported otherwise, and where
/// space repeats; not_finite, time_backwards and out_of_range as simulate() and World::add(). Cost: as the
/// pieces of all trajectories, and the bodies that come near each other. Memory: 112 bytes for each piece,
/// and some for each pair that comes near.
Result<ContactComparison> compare_with_oracle(const Scene& scene, const std::vector<Event>& events,
                                              const ComparisonProgress& on_progress = {});

/// Runs the scene under the detector and compares.
Result<ContactComparison> verify(const Scene& scene, const DetectorMaker& make);

}  // namespace kinesphere
