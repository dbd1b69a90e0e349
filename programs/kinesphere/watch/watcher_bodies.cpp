// Pairs of which nothing more is told for a while: ids that may be one body, and tracks at rest. Tracks that
// go on under another id.
#include <algorithm>
#include <limits>
#include <utility>

#include "base/program_error.hpp"
#include "watch/watcher.hpp"

namespace kinesphere::program {

/// Precondition: there is a monitor.
void Watcher::begin_bodies() {
  rest_ = {.speed = settings_.rest_speed, .room = cutting().edge};
  // Who asks for each change of a verdict gets those of all ids.
  if (settings_.has_distinct_ids || settings_.kinds.undecided) return;
  constexpr double any = std::numeric_limits<double>::infinity();
  SameBodies::Limits limits{.horizontal = any,
                            .vertical = any,
                            .fastest = settings_.classes.fastest(),
                            .silence = settings_.silence,
                            .has_steady_rate = settings_.has_steady_rate,
                            .own = settings_.own.empty() ? 0 : track_id_of(settings_.own)};
  for (const NamedSeparation& named : settings_.separations) {
    limits.horizontal = std::min(limits.horizontal, named.separation.horizontal);
    if (dimensions_ == 3) limits.vertical = std::min(limits.vertical, named.separation.vertical);
  }
  bodies_.emplace(limits, names_);
}

/// Returns the fate of all events of a pair for now, if they are not told; nothing for events that are never
/// told of any pair.
std::optional<AlertFate> Watcher::hold_of(const MonitorEvent& event) const {
  if (settings_.kinds.undecided) return std::nullopt;
  const bool is_never_told = event.kind == MonitorEventKind::verdict && event.verdict == Verdict::undecided;
  return is_never_told ? std::nullopt : hold_of(event.first, event.second);
}

std::optional<AlertFate> Watcher::hold_of(TrackId first, TrackId second) const {
  if (bodies_ && bodies_->may_be_one(first, second)) return AlertFate::same_body;
  if (rest_.speed == 0.0) return std::nullopt;
  const NamedTrack* const one = names_.find(first);
  const NamedTrack* const other = names_.find(second);
  const bool are_at_rest =
      one != nullptr && other != nullptr && one->rest.is_at_rest && other->rest.is_at_rest;
  return are_at_rest ? std::optional(AlertFate::at_rest) : std::nullopt;
}

/// Takes the latest report of a track, which may get under way by it.
void Watcher::note_rest(TrackId id, NamedTrack& track, const SourceReport& report, const TrackReport& on_map,
                        bool is_first) {
  if (rest_.speed == 0.0) return;
  std::optional<double> speed = report.ground_speed;
  if (!speed && report.velocity) speed = norm({report.velocity->x, report.velocity->y, 0.0});
  if (!speed && report.said_kind == MotionPreset::aid_to_navigation) speed = 0.0;
  if (rest_.take(track.rest, on_map.state.position, speed, on_map.timestamp, is_first))
    to_release_.push_back(id);
}

std::size_t Watcher::undecided_bodies() const {
  if (!bodies_) return 0;
  const auto pairs = bodies_->undecided();
  return static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.end(), [this](const auto& pair) {
    const auto keys = policy_.encounters_of(pair.later);
    return std::any_of(keys.begin(), keys.end(), [&](const AlertPolicy::Key& key) {
      return key.first == pair.former || key.second == pair.former;
    });
  }));
}

/// Takes a report that the monitor has taken.
void Watcher::compare_bodies(TrackId track, Sighting& seen, const TrackReport& report, bool is_first) {
  if (!bodies_) return;
  const SameBodies::Change change = bodies_->take(track, seen, report, is_first, *monitor_);
  for (const TrackId later : change.parted)
    for (TrackId each = later; each != 0; each = bodies_->later_of(each)) to_release_.push_back(each);
  if (change.one_body) report_one_body(*change.one_body);
}

/// Tells of the encounters of a track that has parted from the one that it might have been, and of those of
/// tracks that may be the first of these.
void Watcher::release_from(TrackId later) {
  for (TrackId track = later; track != 0; track = bodies_->later_of(track)) release(track);
}

/// Tells of the encounters that are held no more by the report that has just been taken, as they are with it.
void Watcher::release_due() {
  if (to_release_.empty()) return;
  advance(monitor_->time());
  for (const TrackId track : std::exchange(to_release_, {})) release(track);
}

/// Tells of the encounters of a track that are held no more.
void Watcher::release(TrackId track) {
  for (const AlertPolicy::Key& key : policy_.encounters_of(track)) {
    const Encounter& encounter = policy_.encounter(key);
    const auto hold = hold_of(key.first, key.second);
    // Two at rest are told once.
    const bool is_told_held = hold == AlertFate::at_rest && !encounter.is_told();
    if (!encounter.is_held || (hold && !is_told_held)) continue;
    const auto event = policy_.release(key, monitor_->time(), is_in_area(key), hold.has_value());
    if (!event) continue;
    ++counts_.alerts;
    write(event->first, alert_line(context(), *event, {}));
  }
}

void Watcher::report_one_body(const SameBodies::Change::Pair& pair) {
  const TrackId lower = std::min(pair.former, pair.later);
  const TrackId own = settings_.own.empty() ? 0 : track_id_of(settings_.own);
  const bool is_watched = own == 0 || pair.former == own || pair.later == own;
  if (!settings_.share.contains(lower) || !is_watched) return;
  if (!is_in_area({pair.former, pair.later, 0}) || !policy_.has_room(monitor_->time())) return;
  ++counts_.one_bodies;
  ++counts_.alerts;
  write(lower, one_body_line(context(), monitor_->time(), pair.former, pair.later));
}

/// Lets tracks go on as those that have ended by this time. Moves time on to that of the last one.
void Watcher::give_up_until(double time) {
  if (!bodies_) return;
  while (bodies_->next_time() <= time) {
    advance(std::max(monitor_->time(), bodies_->next_time()));
    const auto given_up = bodies_->give_up(monitor_->time(), *monitor_);
    if (!given_up) continue;
    if (!given_up->is_handover) {
      release_from(given_up->later);
      continue;
    }
    hand_over(*given_up);
    advance(monitor_->time());
  }
}

/// Removes a track as which another one goes on, and tells so in its encounters that have been told.
void Watcher::hand_over(const SameBodies::GivenUp& given_up) {
  const LeftFor left_for{"handover", names_.text(given_up.later)};
  if (settings_.share.contains(given_up.former)) ++counts_.handovers;
  for (const AlertPolicy::Key& key : policy_.encounters_of(given_up.former)) {
    Encounter& encounter = policy_.encounter(key);
    if (!settings_.kinds.lost || !encounter.is_told()) continue;
    const PairAnswer answer = require(monitor_->answer(key.first, key.second, key.level));
    encounter.loss = Encounter::Loss{answer.closest_time, answer.closest_distance};
    ++counts_.alerts;
    ++counts_.lost;
    write(key.first, lost_line(context(), {monitor_->time(), given_up.former, key, encounter, left_for}));
  }
  // The monitor's event of the removal finds no encounters.
  policy_.forget(given_up.former);
  remove(given_up.former, left_for);
}

}  // namespace kinesphere::program
