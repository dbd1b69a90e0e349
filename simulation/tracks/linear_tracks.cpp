// Motion along recorded tracks: straight on from sample to sample, for some bodies or for all.
#include "simulation/tracks/linear_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "motion/checks.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

Trajectory straight_lines(const Track& track) {
  Trajectory result;
  for (std::size_t k = 0; k + 1 < track.size(); ++k) {
    const TrackSample& here = track[k];
    const TrackSample& next = track[k + 1];
    result.push_back({.begin = here.time,
                      .end = next.time,
                      .position = here.position,
                      .velocity = (next.position - here.position) / (next.time - here.time)});
  }
  return result;
}

/// Returns the curve of a body, with straight lines before and behind it.
Trajectory with_straight_ends(const RecordedTracks& curves, std::uint32_t body) {
  const double first = curves.first_time(body), last = curves.last_time(body);
  // Any length serves: the motion goes on straight beyond the first and the last segment.
  Trajectory result = curves.trajectory(body, first - 1.0, last);
  const State end = curves.state(body, last);
  result.push_back({.begin = last, .end = last + 1.0, .position = end.position, .velocity = end.velocity});
  return result;
}

}  // namespace

Result<LinearTracks> LinearTracks::create(const std::vector<Track>& tracks) {
  // RecordedTracks::create() checks the samples; it refuses the ones that are wrong here.
  if (auto curves = RecordedTracks::create(tracks); !curves) return curves.error();
  std::vector<Path> paths;
  paths.reserve(tracks.size());
  for (const Track& track : tracks) paths.push_back({straight_lines(track)});
  return LinearTracks(std::move(paths));
}

Result<LinearTracks> LinearTracks::create_among(const RecordedTracks& curves,
                                                const std::vector<Track>& tracks,
                                                const std::vector<bool>& is_straight) {
  if (auto checked = RecordedTracks::create(tracks); !checked) return checked.error();
  std::vector<Path> paths;
  paths.reserve(tracks.size());
  for (std::uint32_t body = 0; body < tracks.size(); ++body) {
    if (is_straight[body])
      paths.push_back({straight_lines(tracks[body])});
    else
      paths.push_back({with_straight_ends(curves, body),
                       curves.definition(body, curves.first_time(body)).acceleration_limit, false});
  }
  return LinearTracks(std::move(paths));
}

LinearTracks::LinearTracks(std::vector<Path> paths)
    : paths_(std::move(paths)), last_turns_(paths_.size(), -infinity) {}

std::vector<SceneTurn> LinearTracks::turns() const {
  std::vector<SceneTurn> turns;
  for (std::uint32_t body = 0; body < paths_.size(); ++body) {
    const Trajectory& trajectory = paths_[body].trajectory;
    if (!paths_[body].has_turns) continue;
    for (std::size_t k = 1; k < trajectory.size(); ++k)
      turns.push_back({trajectory[k].begin, body, trajectory[k].velocity});
  }
  return turns;
}

void LinearTracks::require_known(std::uint32_t body, double t) const {
  if (body >= size() || !std::isfinite(t)) [[unlikely]]
    refuse_question("state", *this, body, "t", t, {-infinity, infinity});
}

/// Returns the segment at time t. At a sample that is the segment before it, until set_velocity() has been
/// called for the turn.
const Segment& LinearTracks::segment(std::uint32_t body, double t) const {
  require_known(body, t);
  const Trajectory& known = paths_[body].trajectory;
  const bool turned = t <= last_turns_[body];
  const auto begins_after = [turned](double time, const Segment& segment) {
    return turned ? time < segment.begin : time <= segment.begin;
  };
  return *(std::upper_bound(known.begin() + 1, known.end(), t, begins_after) - 1);
}

BodyDefinition LinearTracks::definition(std::uint32_t body, double t) const {
  const State now = state(body, t);
  return {.acceleration_limit = paths_[body].acceleration_limit,
          .position = now.position,
          .velocity = now.velocity};
}

State LinearTracks::state(std::uint32_t body, double t) const { return segment(body, t).state_at(t); }

Trajectory LinearTracks::trajectory(std::uint32_t body, double begin, double end) const {
  require_known(body, begin);
  if (!std::isfinite(end)) refuse_question("trajectory", *this, body, "end", end, {begin, infinity});
  if (end < begin) refuse_order("trajectory", body, begin, end);
  const Trajectory& known = paths_[body].trajectory;
  const auto begins_after = [](double time, const Segment& segment) { return time < segment.begin; };
  auto next = std::upper_bound(known.begin() + 1, known.end(), begin, begins_after) - 1;
  Trajectory result;
  while (result.empty() || (result.back().end < end && next != known.end())) result.push_back(*next++);
  // The motion goes straight on before the first sample and after the last.
  if (begin < result.front().begin) {
    Segment& first = result.front();
    first.position += (begin - first.begin) * first.velocity;
    first.begin = begin;
  }
  result.back().end = end;
  return result;
}

Result<void> LinearTracks::set_velocity(std::uint32_t body, double t, const Vec3& velocity) {
  if (auto wrong = wrong_body("set_velocity", *this, body)) return *wrong;
  const Trajectory& known = paths_[body].trajectory;
  const auto begins_before = [](const Segment& segment, double time) { return segment.begin < time; };
  const auto turn = std::lower_bound(known.begin() + 1, known.end(), t, begins_before);
  if (!paths_[body].has_turns || turn == known.end() || turn->begin != t || !(turn->velocity == velocity))
    return cannot_change("set_velocity", *this, body, "turned but at their samples");
  last_turns_[body] = t;
  return {};
}

std::unique_ptr<Motion> LinearTracks::clone() const { return std::make_unique<LinearTracks>(*this); }

}  // namespace kinesphere
