// Comparison of the begins and ends that a detector reports with those of the oracle, one by one.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// Counts of begins and ends, by how the contacts of a detector agree with the truth.
struct ContactComparison {
  /// Begins and ends that detector and oracle report, with the true gap within the contact rule at the
  /// detector's time.
  std::uint64_t matched = 0;
  /// Begins and ends that only one of them reports and the contact rule leaves open: the gap only grazes the
  /// tolerance.
  std::uint64_t grazing = 0;
  /// Begins and ends that the detector reported later than the contact rule allows.
  std::uint64_t late = 0;
  /// Begins and ends that the detector had to report and did not (missed), and that it reported without cause
  /// (invented).
  std::uint64_t missed = 0;
  std::uint64_t invented = 0;
  /// Times of the oracle at which the distance is not what it should be: faults of the oracle.
  std::uint64_t oracle_faults = 0;
  double largest_time_difference = 0.0;  ///< among the matched begins and ends
  std::optional<std::string> first_difference;

  bool agrees() const { return late == 0 && missed == 0 && invented == 0 && oracle_faults == 0; }
};

/// Called now and then with the part of a comparison that is done, from 0 to 1.
using ComparisonProgress = std::function<void(double part)>;

/// Compares the events of a run of `scene` with the truth: the exact course of the gap of all bodies that
/// come near each other, along their trajectories, without bounds and without the engine. Precondition:
/// bodies do not bounce, as with bounces two correct programs drift apart. Cost: proportional to the pieces
/// of all trajectories, and to the pairs of bodies that come near each other. Memory: 112 bytes for each
/// piece, and some for each pair that comes near. Errors: unsupported if bodies bounce, ends are not reported
/// or space is periodic; not_finite, time_backwards and out_of_range as run_scene() and World::add().
Result<ContactComparison> compare_with_oracle(const Scene& scene, const std::vector<Event>& events,
                                              const ComparisonProgress& on_progress = {});

/// Runs the scene under the detector and compares its events with the truth. Errors: as run_scene() and
/// compare_with_oracle().
Result<ContactComparison> verify(const Scene& scene, const DetectorMaker& make);

}  // namespace kinesphere
