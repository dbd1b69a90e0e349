#include "research/monitoring/recorded_sky.hpp"

#include <algorithm>
#include <limits>

#include "kinesphere/random.hpp"
#include "simulation/oracle/oracle.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/tracks/approaches.hpp"
#include "simulation/tracks/scene_of_tracks.hpp"

namespace kinesphere {
namespace {

/// Returns an upper bound on the speed on a segment: the speed at its begin and all that its acceleration can
/// add.
double largest_speed(const Segment& segment) {
  constexpr int pieces = 64;
  const double step = (segment.end - segment.begin) / pieces;
  double largest = 0.0;
  for (int k = 0; k < pieces; ++k) {
    const double s = k * step;
    const Vec3 velocity = segment.velocity + (segment.acceleration + segment.jerk * (0.5 * s)) * s;
    const double turn = std::max(norm(segment.acceleration + segment.jerk * s),
                                 norm(segment.acceleration + segment.jerk * (s + step)));
    largest = std::max(largest, norm(velocity) + turn * step);
  }
  return largest;
}

}  // namespace

Result<RecordedSky> RecordedSky::create(const std::vector<Track>& tracks, int dimensions) {
  auto motion = RecordedTracks::create(tracks);
  if (!motion) return motion.error();
  return RecordedSky(std::move(*motion), tracks, dimensions);
}

RecordedSky::RecordedSky(RecordedTracks motion, std::vector<Track> tracks, int dimensions)
    : motion_(std::move(motion)), tracks_(std::move(tracks)), dimensions_(dimensions) {
  for (std::uint32_t k = 0; k < tracks_.size(); ++k) {
    const Span span{tracks_[k].front().time, tracks_[k].back().time};
    spans_.push_back(span);
    limits_.push_back(motion_.definition(k, span.begin).acceleration_limit);
    fastest_turn_ = std::max(fastest_turn_, limits_.back());
    for (const Segment& segment : motion_.trajectory(k, span.begin, span.end))
      fastest_ = std::max(fastest_, largest_speed(segment));
  }
}

double RecordedSky::track_time() const {
  double sum = 0.0;
  for (const Span& span : spans_) sum += span.end - span.begin;
  return sum;
}

TrackReport RecordedSky::report(TrackId track, double time) const {
  return {.timestamp = time,
          .state = motion_.state(static_cast<std::uint32_t>(track), time),
          .plan = TrackReport::Plan{.acceleration_limit = limits_[track]}};
}

std::vector<Delivery> RecordedSky::deliveries(const ReportingSettings& settings) const {
  std::vector<Delivery> all;
  for (TrackId track = 0; track < size(); ++track) {
    Random random = Random::at(settings.seed, track, 0);
    const auto error = [&](double radius) {
      Vec3 drawn = random.point_in_ball();
      if (dimensions_ == 2) drawn.z = 0.0;
      return radius * drawn;
    };
    const Span& there = spans_[track];
    for (double time = there.begin; time < there.end; time += settings.interval * random.uniform(0.2, 1.8)) {
      TrackReport report = RecordedSky::report(track, time);
      report.state.position += error(settings.position_error);
      report.state.velocity += error(settings.velocity_error);
      report.position_error = settings.position_error;
      report.velocity_error = settings.velocity_error;
      const double delay = time == there.begin ? 0.0 : settings.delay * random.uniform(0.0, 1.0);
      if (time + delay < there.end) all.push_back({time + delay, track, report});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Delivery& a, const Delivery& b) { return a.time < b.time; });
  return all;
}

std::vector<Delivery> RecordedSky::polled(double interval) const {
  std::vector<Delivery> all;
  for (TrackId track = 0; track < size(); ++track) {
    const Span& there = spans_[track];
    all.push_back({there.begin, track, report(track, there.begin)});
    for (double k = std::floor(there.begin / interval) + 1.0; k * interval < there.end; ++k)
      all.push_back({k * interval, track, report(track, k * interval)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Delivery& a, const Delivery& b) { return a.time < b.time; });
  return all;
}

Result<std::map<TrackPair, std::vector<Span>>> RecordedSky::within(double distance) const {
  Result<Scene> scene = scene_of_tracks(tracks_, distance, Interpolation::spline);
  if (!scene) return scene.error();
  std::vector<Event> events;
  const SceneObserver observer{.on_event = [&](const Event& event) { events.push_back(event); }};
  const auto done = run_scene(*scene, make_oracle, observer);
  if (!done) return done.error();
  std::map<TrackPair, std::vector<Span>> spans;
  for (const Approach& approach : approaches_in(*scene, events)) {
    const auto [first, second] = std::minmax(approach.first, approach.second);
    spans[{first, second}].push_back({approach.begin, approach.end});
  }
  return spans;
}

}  // namespace kinesphere
