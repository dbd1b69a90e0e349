// What a watch tells of the events of its monitor.
#include "watch/policy/alert_desk.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/program_error.hpp"
#include "formats/fields/wrong_input.hpp"

namespace kinesphere::program {

AlertDesk::AlertDesk(const WatchSettings& settings, WatchCounts& counts, const WatchedTracks& tracks,
                     const PairMonitor& pairs, Next& next)
    : settings_(settings),
      counts_(counts),
      tracks_(tracks),
      pairs_(pairs),
      next_(next),
      policy_(settings.kinds, settings.most_alerts) {
  counts_.turns.resize(settings.separations.size());
}

void AlertDesk::check() const {
  const TrackNames& names = tracks_.names();
  bool is_sound = counts_.turns.size() == settings_.separations.size();
  policy_.for_each([&](const AlertPolicy::Key& key) {
    is_sound = is_sound && key.level < settings_.separations.size() && key.first < key.second &&
               names.find(key.first) != nullptr && names.find(key.second) != nullptr;
  });
  if (!is_sound) throw WrongInput("expected encounters of tracks in the snapshot");
}

void AlertDesk::tell(const MonitorEvent& event, const LeftFor& left_for) {
  // A watch of another share tells of this track.
  if (settings_.share.contains(event.first)) count_and_write(event, left_for);
  if (event.kind == MonitorEventKind::stale || event.kind == MonitorEventKind::dropped) tell_lost(event);
  if (event.kind == MonitorEventKind::resumed)
    for (const AlertPolicy::Key& key : policy_.encounters_of(event.first))
      policy_.encounter(key).loss.reset();
  if (event.kind == MonitorEventKind::reclassified) policy_.forget(event.first);
}

void AlertDesk::count_and_write(MonitorEvent event, const LeftFor& left_for) {
  ++counts_.events[static_cast<std::size_t>(event.kind)];
  if (event.kind == MonitorEventKind::verdict) {
    auto& turns = counts_.turns[event.level];
    ++(event.verdict == Verdict::apart       ? turns.apart
       : event.verdict == Verdict::undecided ? turns.undecided
                                             : turns.within);
  }
  const AlertFate fate = fate_of(event);
  ++counts_.fates[static_cast<std::size_t>(fate)];
  if (fate == AlertFate::written) write_event(event, left_for);
}

AlertFate AlertDesk::fate_of(MonitorEvent& event) {
  if (is_of_pair(event.kind))
    return policy_.take(event, is_in_area({event.first, event.second, event.level}), hold_of(event));
  const TrackId own = settings_.own_track();
  if (!settings_.kinds.tracks || (own != 0 && own != event.first)) return AlertFate::of_track;
  // Where a track was is not known once it has been dropped.
  const bool is_elsewhere =
      tracks_.map().has_areas() && event.kind != MonitorEventKind::dropped && !is_in_area(event.first);
  if (is_elsewhere) return AlertFate::elsewhere;
  return policy_.has_room(event.time) ? AlertFate::written : AlertFate::too_many;
}

/// Returns the fate of all events of a pair for now, if they are not told; nothing for events that are never
/// told of any pair.
std::optional<AlertFate> AlertDesk::hold_of(const MonitorEvent& event) const {
  if (settings_.kinds.undecided) return std::nullopt;
  const bool is_never_told = event.kind == MonitorEventKind::verdict && event.verdict == Verdict::undecided;
  return is_never_told ? std::nullopt : hold_of(event.first, event.second);
}

std::optional<AlertFate> AlertDesk::hold_of(TrackId first, TrackId second) const {
  if (pairs_.may_be_one(first, second)) return AlertFate::same_body;
  return tracks_.are_at_rest(first, second) ? std::optional(AlertFate::at_rest) : std::nullopt;
}

bool AlertDesk::is_in_area(TrackId track) const {
  const auto view = monitor().track(track);
  return view && tracks_.map().is_in_area(*view);
}

/// True if one of the two is in an area, or there are no areas.
bool AlertDesk::is_in_area(const AlertPolicy::Key& pair) const {
  return !tracks_.map().has_areas() || is_in_area(pair.first) || is_in_area(pair.second);
}

void AlertDesk::enter_area(TrackId track) {
  if (!tracks_.map().has_areas() || !is_in_area(track)) return;
  for (const MonitorEvent& event : policy_.enter_area(track, monitor().time())) write_event(event);
}

/// Tells that a track was lost in its encounters: when it becomes stale, and when it is dropped.
void AlertDesk::tell_lost(const MonitorEvent& event) {
  const bool is_stale = event.kind == MonitorEventKind::stale;
  for (const AlertPolicy::Key& key : policy_.encounters_of(event.first)) {
    Encounter& encounter = policy_.encounter(key);
    if (is_stale) note_loss(key, encounter);
    const bool is_on = encounter.predicted || encounter.within;
    if (!settings_.kinds.lost || !encounter.loss || !encounter.is_told() || !is_on) continue;
    // Streams that lose a report now and then tell of it once.
    if (is_stale && std::exchange(encounter.silence_told, true)) continue;
    tell_lost(event.first, key, encounter, {is_stale ? "stale" : "dropped"});
  }
}

/// Remembers the closest approach that is expected now.
void AlertDesk::note_loss(const AlertPolicy::Key& key, Encounter& encounter) const {
  const PairAnswer answer = require(monitor().answer(key.first, key.second, key.level));
  encounter.loss = Encounter::Loss{answer.closest_time, answer.closest_distance};
}

void AlertDesk::tell_lost(TrackId track, const AlertPolicy::Key& key, const Encounter& encounter,
                          const LeftFor& left_for) {
  ++counts_.lost;
  next_.write_lost(begin_alert(key.first), {monitor().time(), track, key, encounter, left_for});
}

/// Tells of the handover in the encounters that have been told.
void AlertDesk::hand_over(TrackId former, const LeftFor& left_for) {
  for (const AlertPolicy::Key& key : policy_.encounters_of(former)) {
    Encounter& encounter = policy_.encounter(key);
    if (!settings_.kinds.lost || !encounter.is_told()) continue;
    note_loss(key, encounter);
    tell_lost(former, key, encounter, left_for);
  }
  // The monitor's event of the removal finds no encounters.
  policy_.forget(former);
}

/// Tells of the encounters of a track that are held no more.
void AlertDesk::release(TrackId track) {
  for (const AlertPolicy::Key& key : policy_.encounters_of(track)) {
    const Encounter& encounter = policy_.encounter(key);
    const auto hold = hold_of(key.first, key.second);
    // Two at rest are told once.
    const bool is_told_held = hold == AlertFate::at_rest && !encounter.is_told();
    if (!encounter.is_held || (hold && !is_told_held)) continue;
    const auto event = policy_.release(key, monitor().time(), is_in_area(key), hold.has_value());
    if (event) write_event(*event);
  }
}

void AlertDesk::tell_one_body(TrackId former, TrackId later) {
  const TrackId lower = std::min(former, later), own = settings_.own_track();
  const bool is_watched = own == 0 || former == own || later == own;
  if (!settings_.share.contains(lower) || !is_watched) return;
  if (!is_in_area({former, later, 0}) || !policy_.has_room(monitor().time())) return;
  ++counts_.one_bodies;
  next_.write_one_body(begin_alert(lower), monitor().time(), former, later);
}

void AlertDesk::tell_group(const std::string& name, std::size_t tracks) {
  const TrackId id = track_id_of(name);
  if (settings_.share.contains(id)) next_.write_group(begin_alert(id), monitor().time(), name, tracks);
}

void AlertDesk::write_event(const MonitorEvent& event, const LeftFor& left_for) {
  next_.write_event(begin_alert(event.first), event, left_for);
}

std::uint64_t AlertDesk::begin_alert(TrackId lower) {
  ++counts_.alerts;
  write_refused(monitor().time());
  return lower % settings_.share.of;
}

void AlertDesk::write_refused(double time) {
  if (const auto refused = policy_.refused_before(time)) next_.write_refused(settings_.share.first, *refused);
}

void AlertDesk::finish() { write_refused(std::numeric_limits<double>::infinity()); }

std::size_t AlertDesk::undecided_bodies() const {
  const auto pairs = pairs_.undecided();
  return static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.end(), [this](const auto& pair) {
    const auto keys = policy_.encounters_of(pair.later);
    return std::any_of(keys.begin(), keys.end(), [&](const AlertPolicy::Key& key) {
      return key.first == pair.former || key.second == pair.former;
    });
  }));
}

}  // namespace kinesphere::program
