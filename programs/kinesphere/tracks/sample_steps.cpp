// Between which samples a body is at a time.
#include "tracks/sample_steps.hpp"

#include <algorithm>

namespace kinesphere::program {

SampleStep step_at(const RecordedTrack& track, double time) {
  auto first = track.samples.begin(), last = track.samples.end();
  // A body of one sample that stays has a second one where it reaches to, which is none of the recording.
  if (track.reaches_back_to == first->time) ++first;
  if (track.reaches_on_to == (last - 1)->time) --last;
  const auto after = std::lower_bound(first, last, time,
                                      [](const TrackSample& sample, double t) { return sample.time < t; });
  SampleStep step;
  if (after != last) step.after = after->time;
  if (step.after == time)
    step.before = time;
  else if (after != first)
    step.before = (after - 1)->time;
  return step;
}

std::optional<double> ApproachSteps::longest() const {
  if (!first.before || !first.after || !second.before || !second.after) return std::nullopt;
  return std::max(*first.after - *first.before, *second.after - *second.before);
}

ApproachSteps steps_of(const Approach& approach, const TrackSet& track_set) {
  const double time = approach.closest.time;
  return {step_at(track_set.tracks[approach.first], time), step_at(track_set.tracks[approach.second], time)};
}

}  // namespace kinesphere::program
