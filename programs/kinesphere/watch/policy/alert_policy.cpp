#include "watch/policy/alert_policy.hpp"

#include <cmath>
#include <utility>

namespace kinesphere::program {
namespace {

bool is_verdict(const MonitorEvent& event) { return event.kind == MonitorEventKind::verdict; }

/// Returns true if the event begins `predicted` or `within` of an encounter.
bool begins(const MonitorEvent& event, const Encounter& encounter) {
  return is_verdict(event) ? event.verdict == Verdict::within && !encounter.within
                           : event.kind == MonitorEventKind::predicted;
}

}  // namespace

AlertFate AlertPolicy::take(MonitorEvent& event, bool is_in_area, std::optional<AlertFate> held) {
  const Key key{event.first, event.second, event.level};
  const auto found = encounters_.find(key);
  Encounter encounter = found == encounters_.end() ? Encounter{} : found->second;
  AlertFate fate = fate_of(event, encounter);
  encounter.is_held = encounter.is_held || held;
  // Two at rest are told once.
  const bool is_told_held = held == AlertFate::at_rest && begins(event, encounter) && !encounter.is_told();
  if (fate == AlertFate::written && encounter.is_held && !is_told_held)
    fate = held.value_or(AlertFate::encounter);
  if (fate == AlertFate::written && !is_in_area) fate = AlertFate::elsewhere;
  if (fate == AlertFate::written && !has_room(event.time)) fate = AlertFate::too_many;
  if (begins(event, encounter)) {
    (is_verdict(event) ? encounter.within_since : encounter.predicted_since) = event.time;
    if (fate == AlertFate::elsewhere) encounter.is_elsewhere = true;
    if (fate == AlertFate::written) {
      (is_verdict(event) ? encounter.within_told : encounter.predicted_told) = true;
      encounter.is_elsewhere = false;
    }
  } else if (is_verdict(event) && encounter.within && !kinds_.undecided) {
    event.before = Verdict::within;
    event.since = encounter.within_since;
  }
  if (!is_verdict(event))
    encounter.predicted = event.kind == MonitorEventKind::predicted;
  else if (event.verdict != Verdict::undecided)
    encounter.within = event.verdict == Verdict::within;
  // The end of one that is held is still to be told.
  if (encounter.predicted || encounter.within || (encounter.is_held && encounter.is_told())) {
    put(key, encounter);
  } else if (found != encounters_.end()) {
    erase(key);
  }
  return fate;
}

/// Precondition: the encounter is as before the event.
AlertFate AlertPolicy::fate_of(const MonitorEvent& event, const Encounter& encounter) const {
  const bool is_asked_for = is_verdict(event) ? kinds_.within : kinds_.predicted;
  if (kinds_.undecided) {
    const bool is_of_within = event.verdict == Verdict::within || event.before == Verdict::within;
    return is_asked_for || (is_verdict(event) && !is_of_within) ? AlertFate::written : AlertFate::other_kind;
  }
  const bool begin = begins(event, encounter);
  if (is_verdict(event) && !begin && !encounter.within) return AlertFate::undecided;
  if (!is_asked_for) return AlertFate::other_kind;
  bool is_new;
  if (begin)
    is_new = !encounter.within_told && (is_verdict(event) || !encounter.predicted_told);
  else if (is_verdict(event))
    is_new = event.verdict == Verdict::apart && !(encounter.predicted && kinds_.predicted);
  else
    is_new = !(encounter.within && kinds_.within);
  return is_new && (begin || encounter.is_told()) ? AlertFate::written : AlertFate::encounter;
}

/// Returns the event that tells of an encounter which begins for the reader now.
MonitorEvent AlertPolicy::begin_of(const Key& key, Encounter& encounter, double time) const {
  MonitorEvent event{.time = time, .first = key.first, .second = key.second, .level = key.level};
  if (encounter.within && kinds_.within) {
    event.verdict = Verdict::within;
    event.since = encounter.within_since;
    encounter.within_told = true;
  } else {
    event.kind = MonitorEventKind::predicted;
    event.since = encounter.predicted_since;
    encounter.predicted_told = true;
  }
  return event;
}

std::vector<MonitorEvent> AlertPolicy::enter_area(TrackId track, double time) {
  std::vector<MonitorEvent> events;
  for (const Key& key : encounters_of(track)) {
    Encounter& encounter = encounters_.at(key);
    if (!encounter.is_elsewhere || encounter.is_held) continue;
    if (!has_room(time)) break;
    encounter.is_elsewhere = false;
    events.push_back(begin_of(key, encounter, time));
  }
  return events;
}

std::optional<MonitorEvent> AlertPolicy::release(const Key& key, double time, bool is_in_area, bool held) {
  Encounter& encounter = encounters_.at(key);
  encounter.is_held = held;
  const bool is_on = (encounter.within && kinds_.within) || (encounter.predicted && kinds_.predicted);
  if (is_on) {
    const bool is_news = encounter.within && kinds_.within ? !encounter.within_told : !encounter.is_told();
    if (!is_news) return std::nullopt;
    if (!is_in_area) encounter.is_elsewhere = true;
    if (!is_in_area || !has_room(time)) return std::nullopt;
    encounter.is_elsewhere = false;
    return begin_of(key, encounter, time);
  }
  const Encounter over = encounter;
  encounter.predicted_told = encounter.within_told = false;
  if (!encounter.predicted && !encounter.within) erase(key);
  if (!over.is_told() || !is_in_area || !has_room(time)) return std::nullopt;
  MonitorEvent event{.time = time, .first = key.first, .second = key.second, .level = key.level};
  if (over.within_told) {
    event.before = Verdict::within;
    event.since = over.within_since;
  } else {
    event.kind = MonitorEventKind::prediction_ended;
    event.since = over.predicted_since;
  }
  return event;
}

void AlertPolicy::put(const Key& key, const Encounter& encounter) {
  if (encounters_.insert_or_assign(key, encounter).second)
    for (const TrackId track : {key.first, key.second}) by_track_.insert({track, key});
}

void AlertPolicy::erase(const Key& key) {
  encounters_.erase(key);
  for (const TrackId track : {key.first, key.second}) by_track_.erase({track, key});
}

std::vector<AlertPolicy::Key> AlertPolicy::encounters_of(TrackId track) const {
  std::vector<Key> keys;
  for (auto at = by_track_.lower_bound({track, Key{}}); at != by_track_.end() && at->first == track; ++at)
    keys.push_back(at->second);
  return keys;
}

void AlertPolicy::forget(TrackId track) {
  for (const Key& key : encounters_of(track)) erase(key);
}

bool AlertPolicy::has_room(double time) {
  if (!(time < second_ + 1.0)) {
    second_ = std::floor(time);
    written_ = 0;
  }
  if (written_ < most_) {
    ++written_;
    return true;
  }
  if (refused_.alerts == 0) refused_.since = second_;
  ++refused_.alerts;
  return false;
}

std::optional<AlertPolicy::Refused> AlertPolicy::refused_before(double time) {
  if (refused_.alerts == 0 || time < refused_.since + 1.0) return std::nullopt;
  return std::exchange(refused_, Refused{});
}

}  // namespace kinesphere::program
