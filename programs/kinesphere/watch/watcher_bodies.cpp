// Ids that may be one body: what is told of them, and of tracks that go on under another id.
#include <algorithm>
#include <limits>

#include "base/program_error.hpp"
#include "watch/watcher.hpp"

namespace kinesphere::program {

/// Precondition: there is a monitor.
void Watcher::begin_bodies() {
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
  return std::nullopt;
}

/// Takes a report that the monitor has taken.
void Watcher::compare_bodies(TrackId track, Sighting& seen, const TrackReport& report, bool is_first) {
  if (!bodies_) return;
  const SameBodies::Change change = bodies_->take(track, seen, report, is_first, *monitor_);
  for (const TrackId later : change.parted) release_from(later);
  if (change.one_body) report_one_body(*change.one_body);
}

/// Tells of the encounters of a track that has parted from the one that it might have been, and of those of
/// tracks that may be the first of these.
void Watcher::release_from(TrackId later) {
  for (TrackId track = later; track != 0; track = bodies_->later_of(track)) release(track);
}

/// Tells of the encounters of a track that are held no more.
void Watcher::release(TrackId track) {
  for (const AlertPolicy::Key& key : policy_.encounters_of(track)) {
    if (!policy_.encounter(key).is_held || hold_of(key.first, key.second)) continue;
    const auto event = policy_.release(key, monitor_->time(), is_in_area(key));
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
    const auto given_up = bodies_->give_up(monitor_->time());
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
