#include "research/monitoring/polling.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "monitor/separation_forecast.hpp"
#include "research/monitoring/alarms.hpp"

namespace kinesphere {
namespace {

Monitor monitor_for(const RecordedSky& sky, const PollingSettings& settings) {
  return Monitor::create({.dimensions = sky.dimensions(),
                          .start_time = sky.span(0).begin,
                          .classes = {sky.promise()},
                          .separations = {{0, 0, {Separation::sphere(settings.distance)}}},
                          .tolerance = settings.tolerance,
                          .window = settings.window})
      .value();
}

/// A track that appears or vanishes. Changes are sorted by time.
struct Change {
  double time;
  bool comes;
  TrackId track;
};

std::vector<Change> changes_of(const RecordedSky& sky) {
  std::vector<Change> changes;
  for (TrackId track = 0; track < sky.size(); ++track) {
    changes.push_back({sky.span(track).begin, true, track});
    changes.push_back({sky.span(track).end, false, track});
  }
  std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) {
    return std::tie(a.time, a.comes, a.track) < std::tie(b.time, b.comes, b.track);
  });
  return changes;
}

}  // namespace

Polling poll_when_needed(const RecordedSky& sky, const PollingSettings& settings) {
  Polling polling;
  const std::vector<Change> changes = changes_of(sky);
  MonitorDefinition definition = monitor_for(sky, settings).definition();
  definition.start_time = changes.front().time;
  Monitor monitor = Monitor::create(definition).value();
  std::map<TrackPair, double> undecided_since;
  const auto decide = [&](const TrackPair& pair, double time) {
    const auto at = undecided_since.find(pair);
    if (at == undecided_since.end()) return;
    polling.undecided_time += time - at->second;
    undecided_since.erase(at);
  };
  const Poll poll = [&](std::span<const TrackId> ids, double time,
                        std::span<std::optional<TrackReport>> reports) {
    for (std::size_t k = 0; k < ids.size(); ++k) reports[k] = sky.report(ids[k], time);
  };
  for (const Change& change : changes) {
    for (const MonitorEvent& event : monitor.events(change.time, poll)) {
      if (event.kind != MonitorEventKind::verdict) continue;
      decide({event.first, event.second}, event.time);
      if (event.verdict == Verdict::undecided) undecided_since[{event.first, event.second}] = event.time;
    }
    if (change.comes) {
      monitor.report(change.track, sky.report(change.track, change.time)).value();
    } else {
      for (TrackId other = 0; other < sky.size(); ++other)
        decide(std::minmax(change.track, other), change.time);
      monitor.remove(change.track).value();
    }
  }
  polling.reports = monitor.counters().reports;
  return polling;
}

Polling poll_everybody(const RecordedSky& sky, const PollingSettings& settings, double interval) {
  MonitorDefinition definition = monitor_for(sky, settings).definition();
  const std::vector<Delivery> deliveries = sky.polled(interval);
  definition.start_time = deliveries.front().time;
  Monitor monitor = Monitor::create(definition).value();
  const VerdictHistory history = watch(monitor, sky, deliveries);
  return {monitor.counters().reports, correctness_of(history, sky, {}, {}).undecided_time};
}

std::uint64_t polling_floor(const RecordedSky& sky, const PollingSettings& settings, double step) {
  const TrackClass track_class = sky.promise();
  const Component distance{.limit = settings.distance};
  std::uint64_t asked = 0;
  std::map<TrackId, TrackEstimate> there;
  const std::vector<Change> changes = changes_of(sky);
  auto change = changes.begin();
  const auto ask = [&](TrackId track, double time) {
    ++asked;
    TrackEstimate& estimate = there[track] = {};
    estimate.update(sky.report(track, time), track_class, time, settings.window);
  };
  for (double time = changes.front().time; change != changes.end(); time += step) {
    for (; change != changes.end() && change->time <= time; ++change) {
      if (change->comes)
        ask(change->track, change->time);
      else
        there.erase(change->track);
    }
    std::vector<std::pair<TrackId, TrackEstimate>> truth;
    for (const auto& [track, knowledge] : there) {
      truth.emplace_back(track, TrackEstimate{});
      truth.back().second.update(sky.report(track, time), track_class, time, settings.window);
    }
    for (const auto& one : there) {
      const TrackId track = one.first;
      const TrackEstimate& estimate = one.second;
      const ReachableSet& set = TrackEstimate::tightest(estimate.hypotheses().front(), time);
      const Vec3 centre = set.centre_at(time);
      const double radius = set.radius_at(time).total();
      const bool open = std::any_of(truth.begin(), truth.end(), [&](const auto& other) {
        if (other.first == track) return false;
        const Vec3& place = other.second.hypotheses().front().latest.state.position;
        const double between = norm(centre - place);
        if (between - radius > settings.distance ||
            between + radius <= settings.distance + settings.tolerance)
          return false;
        const DistanceBetween limits = distance_between(estimate, other.second, distance, time);
        return !(limits.lower > settings.distance || limits.upper <= settings.distance + settings.tolerance);
      });
      if (open) ask(track, time);
    }
  }
  return asked;
}

}  // namespace kinesphere
