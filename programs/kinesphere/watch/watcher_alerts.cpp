// What a watch tells of events: alerts, and which of them are written.
#include "watch/watcher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/program_error.hpp"

namespace kinesphere::program {

void Watcher::report(const MonitorEvent& event) {
  // A watch of another share reports this track.
  const bool is_reported = settings_.share.contains(event.first);
  if (is_reported) count_and_report(event);
  const bool is_lost = event.kind == MonitorEventKind::stale || event.kind == MonitorEventKind::dropped;
  if (is_lost) report_lost(event);
  if (event.kind == MonitorEventKind::resumed)
    for (const AlertPolicy::Key& key : policy_.encounters_of(event.first))
      policy_.encounter(key).loss.reset();
  if (event.kind == MonitorEventKind::reclassified) policy_.forget(event.first);
  if (event.kind != MonitorEventKind::dropped) return;
  leave(event.first);
}

/// Forgets a track that the monitor has dropped.
void Watcher::leave(TrackId track) {
  policy_.forget(track);
  const TrackId parted = bodies_ ? bodies_->remove(track) : 0;
  names_.remove(track);
  removed_.erase(track);
  if (const auto group = group_tracks_.find(track); group != group_tracks_.end()) {
    groups_->dissolve(group->second);
    group_tracks_.erase(group);
  }
  if (parted != 0) release_from(parted);
}

AlertFate Watcher::fate_of(MonitorEvent& event) {
  if (is_of_pair(event.kind))
    return policy_.take(event, is_in_area({event.first, event.second, event.level}), hold_of(event));
  const bool is_asked_for =
      settings_.kinds.tracks && (settings_.own.empty() || track_id_of(settings_.own) == event.first);
  if (!is_asked_for) return AlertFate::of_track;
  // Where a track was is not known once it has been dropped.
  const bool is_elsewhere =
      !areas_.empty() && event.kind != MonitorEventKind::dropped && !is_in_area(event.first);
  if (is_elsewhere) return AlertFate::elsewhere;
  return policy_.has_room(event.time) ? AlertFate::written : AlertFate::too_many;
}

void Watcher::begin_areas() {
  for (const WatchedArea& area : settings_.areas) {
    if (!frame_) {
      areas_.push_back({{area.first, area.second, 0.0}, area.radius});
      continue;
    }
    const auto placed = frame_->place({area.second, area.first, 0.0}, false, {});
    if (!placed || std::abs(area.first) > 90.0)
      throw ProgramError(
          fmt::format("--area: expected a place in the radius of the map (--radius, --origin), but got {},{}",
                      area.first, area.second));
    areas_.push_back({placed->state.position, area.radius});
  }
}

bool Watcher::is_in_area(TrackId track) const {
  const auto view = monitor_->track(track);
  if (!view) return false;
  const auto contains = [&](const Circle& area) {
    return std::any_of(view->places.begin(), view->places.end(), [&](const TrackView::Place& place) {
      return std::hypot(place.centre.x - area.centre.x, place.centre.y - area.centre.y) <= area.radius;
    });
  };
  return std::any_of(areas_.begin(), areas_.end(), contains);
}

/// True if one of the two is in an area, or there are no areas.
bool Watcher::is_in_area(const AlertPolicy::Key& pair) const {
  return areas_.empty() || is_in_area(pair.first) || is_in_area(pair.second);
}

/// Tells of the encounters of a track that has entered an area.
void Watcher::enter_area(TrackId track) {
  if (areas_.empty() || !is_in_area(track)) return;
  for (const MonitorEvent& event : policy_.enter_area(track, monitor_->time())) {
    ++counts_.alerts;
    write(event.first, alert_line(context(), event, {}));
  }
}

/// Tells that a track was lost in its encounters: when it becomes stale, and when it is dropped.
void Watcher::report_lost(const MonitorEvent& event) {
  for (const AlertPolicy::Key& key : policy_.encounters_of(event.first)) {
    Encounter& encounter = policy_.encounter(key);
    if (event.kind == MonitorEventKind::stale) {
      const PairAnswer answer = require(monitor_->answer(key.first, key.second, key.level));
      encounter.loss = Encounter::Loss{answer.closest_time, answer.closest_distance};
    }
    const bool is_on = encounter.predicted || encounter.within;
    if (!settings_.kinds.lost || !encounter.loss || !encounter.is_told() || !is_on) continue;
    // Streams that lose a report now and then tell of it once.
    if (event.kind == MonitorEventKind::stale && std::exchange(encounter.silence_told, true)) continue;
    ++counts_.alerts;
    ++counts_.lost;
    const std::string_view reason = event.kind == MonitorEventKind::stale ? "stale" : "dropped";
    write(key.first, lost_line(context(), {event.time, event.first, key, encounter, {reason}}));
  }
}

void Watcher::write_refused(double time) {
  if (const auto refused = policy_.refused_before(time))
    alert_(settings_.share.first, refused_line(context(), *refused));
}

void Watcher::write(std::uint64_t share, std::string_view line) {
  write_refused(monitor_->time());
  alert_(share % settings_.share.of, line);
}

void Watcher::count_and_report(MonitorEvent event) {
  ++counts_.events[static_cast<std::size_t>(event.kind)];
  if (event.kind == MonitorEventKind::verdict) {
    auto& turns = counts_.turns[event.level];
    ++(event.verdict == Verdict::apart       ? turns.apart
       : event.verdict == Verdict::undecided ? turns.undecided
                                             : turns.within);
  }
  const AlertFate fate = fate_of(event);
  ++counts_.fates[static_cast<std::size_t>(fate)];
  if (fate != AlertFate::written) return;
  ++counts_.alerts;
  const auto removed = removed_.find(event.first);
  write(event.first,
        alert_line(context(), event, removed == removed_.end() ? LeftFor{"silence"} : removed->second));
}

AlertContext Watcher::context() const {
  return {settings_,      times_,     names_, *monitor_, frame_ ? frame_->stretch() : 1.0,
          is_geographic_, first_time_};
}

std::string Watcher::first_time() const {
  return clock_.has_begun() ? json_time(times_, first_time_) : "null";
}

std::string Watcher::last_time() const {
  return clock_.has_begun() ? json_time(times_, times_.seconds(clock_.now())) : "null";
}

double Watcher::time_covered() const {
  return clock_.has_begun() ? times_.seconds(clock_.now()) - first_time_ : 0.0;
}

}  // namespace kinesphere::program
