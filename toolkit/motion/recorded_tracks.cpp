// RecordedTracks: natural cubic splines through recorded samples.
#include "kinesphere/motion/recorded_tracks.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "input/input_check.hpp"

namespace kinesphere {

namespace {

void check_track(InputCheck& check, BodyId body, const Track& track) {
  check.require(track.size() >= 2, ErrorCode::out_of_range, {"tracks", body}, "must have at least 2 samples",
                track.size());
  for (std::size_t k = 0; k < track.size(); ++k) {
    const Subject sample{"tracks", body, "sample", k};
    check.finite(sample, track[k].time).finite(sample, track[k].position);
    if (k == 0) continue;
    const double before = track[k - 1].time;
    check.require(track[k].time > before, ErrorCode::out_of_range, sample,
                  "must be later than the one before it,", before, track[k].time);
  }
}

/// The straight step from one sample to the next.
struct Chord {
  double duration;
  Vec3 velocity;  ///< Mean velocity of the step.
};

Chord chord_from(const Track& track, std::size_t k) {
  const double duration = track[k + 1].time - track[k].time;
  return {duration, (track[k + 1].position - track[k].position) / duration};
}

/// Returns the accelerations M of the spline at its samples. Step k has the duration h_k and the chord
/// velocity c_k:
///   h_(k-1) M_(k-1) + 2 (h_(k-1) + h_k) M_k + h_k M_(k+1) = 6 (c_k - c_(k-1)),   M_first = M_last = 0,
/// but where the body rests at an end
///   2 h_0 M_0 + h_0 M_1 = 6 c_0,   h_(last-1) M_(last-1) + 2 h_(last-1) M_last = -6 c_(last-1).
/// Elimination without pivoting solves this accurately, since the matrix is diagonally dominant.
std::vector<Vec3> spline_accelerations(const Track& track, const RestingEnds& rests) {
  const std::size_t last = track.size() - 1;
  std::vector<Vec3> result(track.size());
  std::vector<double> next_factor(track.size(), 0.0);  // M_k = result[k] - next_factor[k] M_(k+1)
  Chord before = chord_from(track, 0);
  if (rests.first) {
    next_factor[0] = 0.5;
    result[0] = 3.0 / before.duration * before.velocity;
  }
  for (std::size_t k = 1; k < last; ++k) {
    const Chord after = chord_from(track, k);
    const double pivot = 2.0 * (before.duration + after.duration) - before.duration * next_factor[k - 1];
    next_factor[k] = after.duration / pivot;
    result[k] = (6.0 * (after.velocity - before.velocity) - before.duration * result[k - 1]) / pivot;
    before = after;
  }
  if (rests.last) {
    const Chord end = chord_from(track, last - 1);
    const double pivot = (2.0 - next_factor[last - 1]) * end.duration;
    result[last] = (-6.0 * end.velocity - end.duration * result[last - 1]) / pivot;
  }
  for (std::size_t k = last; k-- > 0;) result[k] -= next_factor[k] * result[k + 1];
  return result;
}

Trajectory spline(const Track& track, const RestingEnds& rests) {
  const std::vector<Vec3> accelerations = spline_accelerations(track, rests);
  Trajectory result;
  result.reserve(track.size());
  for (std::size_t k = 0; k + 1 < track.size(); ++k) {
    const Chord step = chord_from(track, k);
    const Vec3& here = accelerations[k];
    const Vec3& there = accelerations[k + 1];
    result.push_back({.begin = track[k].time,
                      .end = track[k + 1].time,
                      .position = track[k].position,
                      .velocity = step.velocity - step.duration / 6.0 * (2.0 * here + there),
                      .acceleration = here,
                      .jerk = (there - here) / step.duration});
  }
  return result;
}

bool is_finite(const Segment& segment) {
  const State last = segment.state_at(segment.end);
  return kinesphere::is_finite(last.position) && kinesphere::is_finite(last.velocity) &&
         std::isfinite(norm(segment.acceleration_at(segment.end)));
}

/// `rests_of` returns the ends at which a body rests.
template <class RestsOf>
Result<std::vector<Trajectory>> splines(const std::vector<Track>& tracks, RestsOf rests_of) {
  InputCheck check("RecordedTracks::create");
  std::vector<Trajectory> trajectories;
  trajectories.reserve(tracks.size());
  for (std::uint32_t body = 0; body < tracks.size(); ++body) {
    const BodyId id{body, 0};
    check_track(check, id, tracks[body]);
    if (check.error()) return *check.error();
    trajectories.push_back(spline(tracks[body], rests_of(body)));
    for (std::size_t k = 0; k < trajectories.back().size(); ++k) {
      check.require(is_finite(trajectories.back()[k]), ErrorCode::out_of_range, {"tracks", id, "sample", k},
                    "must give a curve that does not overflow", tracks[body][k].position);
    }
    if (check.error()) return *check.error();
  }
  return trajectories;
}

}  // namespace

Result<RecordedTracks> RecordedTracks::create(const std::vector<Track>& tracks, Outside outside) {
  const bool rests = outside == Outside::stay;
  auto trajectories = splines(tracks, [&](std::uint32_t) { return RestingEnds{rests, rests}; });
  if (!trajectories) return trajectories.error();
  return RecordedTracks(std::move(*trajectories), outside);
}

Result<RecordedTracks> RecordedTracks::create(const std::vector<Track>& tracks,
                                              const std::vector<RestingEnds>& ends) {
  InputCheck check("RecordedTracks::create");
  check.require(ends.size() == tracks.size(), ErrorCode::out_of_range, {"ends"},
                "must be one for each track, and so", tracks.size(), ends.size());
  if (check.error()) return *check.error();
  auto trajectories = splines(tracks, [&](std::uint32_t body) { return ends[body]; });
  if (!trajectories) return trajectories.error();
  return RecordedTracks(std::move(*trajectories), Outside::go_on);
}

std::unique_ptr<Motion> RecordedTracks::clone() const { return std::make_unique<RecordedTracks>(*this); }

}  // namespace kinesphere
