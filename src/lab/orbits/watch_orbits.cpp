#include "lab/orbits/watch_orbits.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace kinesphere {
namespace {

/// Answers what the monitor asks.
class Reporter {
 public:
  Reporter(const std::vector<Orbit>& orbits, const WatchOptions& options)
      : orbits_(orbits), window_(std::exp2(std::floor(std::log2(options.window)))) {
    for (const Orbit& orbit : orbits) windows_.push_back(windows_for(orbit, options.stray));
  }

  TrackReport report(TrackId id, double time) const {
    // Plans end as windows end.
    const double end = (std::floor(time / window_) + windows_[id]) * window_;
    const Orbit::Outlook outlook = orbits_[id].outlook(time, end - time);
    return {.stamp = time,
            .state = outlook.state,
            .position_error = Orbit::position_error,
            .velocity_error = Orbit::velocity_error,
            .plan = TrackReport::Plan{.acceleration = outlook.acceleration,
                                      .acceleration_limit = outlook.deviation,
                                      .valid_until = end}};
  }

 private:
  /// How many windows a plan is to be good for.
  double windows_for(const Orbit& orbit, double stray) const {
    double windows = 1.0;
    while (windows < 64.0) {
      const double longer = 2.0 * windows * window_;
      if (0.5 * orbit.outlook(0.0, longer).deviation * longer * longer > stray) break;
      windows *= 2.0;
    }
    return windows;
  }

  const std::vector<Orbit>& orbits_;
  double window_;
  std::vector<double> windows_;
};

}  // namespace

Result<OrbitWatch> watch_orbits(const std::vector<Orbit>& orbits, double until, const WatchOptions& options) {
  double acceleration = 0.0;
  for (const Orbit& orbit : orbits) acceleration = std::max(acceleration, orbit.largest_acceleration());
  // While a pair passes the tolerance at the largest relative speed there is time for one more look.
  double speed = 0.0;
  for (const Orbit& orbit : orbits) speed = std::max(speed, orbit.largest_speed());
  auto created = Monitor::create({.classes = {{.acceleration_limit = acceleration}},
                                  .separations = {{0, 0, {Separation::sphere(options.distance)}}},
                                  .tolerance = options.tolerance,
                                  .time_resolution = 0.25 * options.tolerance / speed,
                                  .window = options.window});
  if (!created) return created.error();
  Monitor& monitor = created.value();
  const Reporter reporter(orbits, options);
  for (std::uint32_t k = 0; k < orbits.size(); ++k)
    if (const Result<void> taken = monitor.report(k, reporter.report(k, 0.0)); !taken) return taken.error();

  const Poll poll = [&](std::span<const TrackId> ids, double time,
                        std::span<std::optional<TrackReport>> reports) {
    for (std::size_t k = 0; k < ids.size(); ++k) reports[k] = reporter.report(ids[k], time);
  };
  OrbitWatch watch;
  std::map<std::pair<TrackId, TrackId>, std::size_t> open;
  for (;;) {
    const auto next = monitor.advance(until, poll);
    if (!next) return next.error();
    if (!*next) break;
    const MonitorEvent& event = **next;
    if (event.kind != MonitorEventKind::verdict) continue;
    const std::pair pair(event.first, event.second);
    if (event.verdict == Verdict::undecided) ++watch.undecided;
    if (event.before == Verdict::undecided) watch.undecided_time += event.time - event.since;
    if (event.verdict == Verdict::within) {
      open[pair] = watch.approaches.size();
      watch.approaches.push_back({.first = static_cast<std::uint32_t>(event.first),
                                  .second = static_cast<std::uint32_t>(event.second),
                                  .begin = event.time,
                                  .end = until});
    } else if (event.before == Verdict::within) {
      watch.approaches[open.at(pair)].end = event.time;
    }
  }
  sort_by_pair(watch.approaches);
  watch.counters = monitor.counters();
  return watch;
}

}  // namespace kinesphere
