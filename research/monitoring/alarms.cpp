#include "research/monitoring/alarms.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "monitor/separation_forecast.hpp"

namespace kinesphere {
namespace {

Span both_there(const RecordedSky& sky, const TrackPair& pair) {
  const Span& a = sky.span(pair.first);
  const Span& b = sky.span(pair.second);
  return {std::max(a.begin, b.begin), std::min(a.end, b.end)};
}

double overlap(const Span& a, const Span& b) {
  return std::max(0.0, std::min(a.end, b.end) - std::max(a.begin, b.begin));
}

const std::vector<Span>& of(const std::map<TrackPair, std::vector<Span>>& spans, const TrackPair& pair) {
  static const std::vector<Span> none;
  const auto at = spans.find(pair);
  return at == spans.end() ? none : at->second;
}

/// Calls visit(span, verdict) for each verdict that was reported of a pair while its two tracks were there.
template <class Visit>
void for_each_verdict(const std::vector<VerdictChange>& changes, const Span& there, Visit visit) {
  double begin = there.begin;
  Verdict verdict = Verdict::apart;
  for (const VerdictChange& change : changes) {
    const double end = std::clamp(change.time, begin, there.end);
    if (end > begin) visit(Span{begin, end}, verdict);
    begin = end;
    verdict = change.verdict;
  }
  if (there.end > begin) visit(Span{begin, there.end}, verdict);
}

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

VerdictHistory watch(Monitor& monitor, const RecordedSky& sky, const std::vector<Delivery>& deliveries) {
  std::vector<std::pair<double, TrackId>> ends;
  for (TrackId track = 0; track < sky.size(); ++track) ends.emplace_back(sky.span(track).end, track);
  std::sort(ends.begin(), ends.end());
  VerdictHistory history;
  const auto go_to = [&](double time) {
    for (const MonitorEvent& event : monitor.events(std::max(time, monitor.time())))
      if (event.kind == MonitorEventKind::verdict)
        history[{event.first, event.second}].push_back({event.time, event.verdict});
  };
  auto end = ends.begin();
  const auto let_go = [&](double until) {
    for (; end != ends.end() && end->first <= until; ++end) {
      go_to(end->first);
      if (monitor.contains(end->second)) monitor.remove(end->second).value();
    }
  };
  for (const Delivery& delivery : deliveries) {
    let_go(delivery.time);
    go_to(delivery.time);
    monitor.report(delivery.track, delivery.report).value();
    go_to(delivery.time);
  }
  let_go(ends.back().first);
  return history;
}

Correctness correctness_of(const VerdictHistory& history, const RecordedSky& sky,
                           const std::map<TrackPair, std::vector<Span>>& clearly,
                           const std::map<TrackPair, std::vector<Span>>& loosely) {
  Correctness correctness;
  static const std::vector<VerdictChange> no_changes;
  for (TrackId first = 0; first < sky.size(); ++first)
    for (TrackId second = first + 1; second < sky.size(); ++second) {
      const TrackPair pair{first, second};
      const Span there = both_there(sky, pair);
      if (!(there.begin < there.end)) continue;
      correctness.pair_time += there.end - there.begin;
      for (const Span& span : of(clearly, pair)) correctness.within_time += overlap(span, there);
      const auto at = history.find(pair);
      for_each_verdict(at == history.end() ? no_changes : at->second, there,
                       [&](const Span& span, Verdict verdict) {
                         if (verdict == Verdict::undecided)
                           correctness.undecided_time += span.end - span.begin;
                         double within = 0.0;
                         for (const Span& truly : of(verdict == Verdict::within ? loosely : clearly, pair))
                           within += overlap(truly, span);
                         if (verdict == Verdict::apart) correctness.wrong_time += within;
                         if (verdict == Verdict::within)
                           correctness.wrong_time += std::max(0.0, span.end - span.begin - within);
                       });
    }
  return correctness;
}

Alarms alarms_of(const VerdictHistory& history, const RecordedSky& sky) {
  Alarms alarms;
  for (const auto& [pair, changes] : history)
    for_each_verdict(changes, both_there(sky, pair), [&, &which = pair](const Span& span, Verdict verdict) {
      if (verdict == Verdict::apart) return;
      std::vector<Span>& spans = alarms[which];
      if (!spans.empty() && spans.back().end == span.begin)
        spans.back().end = span.end;
      else
        spans.push_back(span);
    });
  return alarms;
}

Alarms straight_on_alarms(const RecordedSky& sky, const std::vector<Delivery>& deliveries, double distance,
                          double look_ahead, double step) {
  Alarms alarms;
  std::map<TrackId, TrackReport> latest;
  std::set<TrackPair> warned;
  const auto warns = [&](const TrackReport& a, const TrackReport& b, double now) {
    const auto ahead = [now](const TrackReport& report) {
      return report.state.position + report.state.velocity * (now - report.timestamp);
    };
    const Vec3 offset = ahead(a) - ahead(b);
    const Vec3 velocity = a.state.velocity - b.state.velocity;
    const double v2 = norm_squared(velocity);
    const double nearest = v2 > 0.0 ? std::clamp(-dot(offset, velocity) / v2, 0.0, look_ahead) : 0.0;
    return norm(offset + velocity * nearest) <= distance;
  };
  const auto look = [&](double now) {
    std::erase_if(latest, [&](const auto& known) { return sky.span(known.first).end <= now; });
    std::set<TrackPair> warnings;
    for (auto a = latest.begin(); a != latest.end(); ++a)
      for (auto b = std::next(a); b != latest.end(); ++b)
        if (warns(a->second, b->second, now)) warnings.insert({a->first, b->first});
    for (const TrackPair& pair : warnings) {
      std::vector<Span>& spans = alarms[pair];
      if (warned.count(pair) == 0) spans.push_back({now, now});
      spans.back().end = now + step;
    }
    warned = std::move(warnings);
  };
  if (deliveries.empty()) return alarms;
  double next = (std::floor(deliveries.front().time / step) + 1.0) * step;
  for (const Delivery& delivery : deliveries) {
    for (; next <= delivery.time; next += step) look(next);
    TrackReport& known = latest.try_emplace(delivery.track, delivery.report).first->second;
    if (known.timestamp < delivery.report.timestamp) known = delivery.report;
  }
  return alarms;
}

AlarmScore score_of(const Alarms& alarms, const std::map<TrackPair, std::vector<Span>>& truth,
                    double look_ahead) {
  AlarmScore score;
  Alarms distinct;
  for (const auto& [pair, spans] : alarms)
    for (const Span& span : spans) {
      std::vector<Span>& joined = distinct[pair];
      if (!joined.empty() && span.begin <= joined.back().end + look_ahead)
        joined.back().end = span.end;
      else
        joined.push_back(span);
    }
  for (const auto& [pair, approaches] : truth)
    for (const Span& approach : approaches) {
      ++score.approaches;
      std::optional<double> first;
      for (const Span& alarm : of(distinct, pair))
        if (!first && alarm.end >= approach.begin && alarm.begin <= approach.end) first = alarm.begin;
      if (!first)
        ++score.missed;
      else if (*first > approach.begin)
        ++score.late;
    }
  for (const auto& [pair, spans] : distinct)
    for (const Span& alarm : spans) {
      ++score.alarms;
      const std::vector<Span>& approaches = of(truth, pair);
      if (std::none_of(approaches.begin(), approaches.end(), [&](const Span& approach) {
            return approach.begin <= alarm.end + look_ahead && approach.end >= alarm.begin;
          }))
        ++score.false_alarms;
    }
  return score;
}

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
