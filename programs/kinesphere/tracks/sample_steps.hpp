// Between which samples a body is at a time.
#pragma once

#include <cstdint>
#include <optional>

#include "simulation/tracks/approaches.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// The times (seconds) of the samples of a track on both sides of a time: of one sample twice where the time
/// is its own, and nothing where there is none (--outside).
struct SampleStep {
  std::optional<double> before, after;
};

SampleStep step_at(const RecordedTrack& track, double time);

/// Between which samples the closest point of an approach lies, on the curves through them.
struct ApproachSteps {
  SampleStep first, second;

  /// The longer of the two times between samples; nothing where one of them is open.
  std::optional<double> longest() const;
};

ApproachSteps steps_of(const Approach& approach, const TrackSet& track_set);

}  // namespace kinesphere::program
