// The monitor of a watch, and the pairs that are none: crowds that stand, and ids of one body.
#include "watch/monitor/pair_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/program_error.hpp"
#include "formats/fields/wrong_input.hpp"

namespace kinesphere::program {

PairMonitor::PairMonitor(const WatchSettings& settings, WatchCounts& counts, WatchedTracks& tracks,
                         Next& next)
    : settings_(settings), counts_(counts), tracks_(tracks), next_(next) {}

void PairMonitor::begin(double start_time) {
  monitor_.emplace(require(Monitor::create(tracks_.map().definition(tracks_.classes(), start_time))));
  begin_bodies();
  groups_.emplace(cutting());
}

void PairMonitor::restore(const std::vector<std::byte>& monitor) {
  auto restored = Monitor::restore(monitor);
  if (!restored) throw WrongInput(message_of(restored.error()));
  monitor_.emplace(std::move(*restored));
  begin_bodies();
  groups_.emplace(cutting());
}

void PairMonitor::check() const {
  bool is_sound = tracks_.names().size() == monitor_->size();
  tracks_.names().for_each(
      [&](const NamedTrack& track) { is_sound = is_sound && monitor_->contains(track_id_of(track.text)); });
  for (const auto& [track, group] : group_tracks_) is_sound = is_sound && groups_->is_group(group);
  if (!is_sound) throw WrongInput("expected the tracks of the monitor in the snapshot");
}

void PairMonitor::begin_bodies() {
  // Who asks for each change of a verdict gets those of all ids.
  if (settings_.has_distinct_ids || settings_.kinds.undecided) return;
  constexpr double any = std::numeric_limits<double>::infinity();
  SameBodies::Limits limits{.horizontal = any,
                            .vertical = any,
                            .fastest = tracks_.classes().fastest(),
                            .silence = settings_.silence,
                            .has_steady_rate = settings_.has_steady_rate,
                            .own = settings_.own_track()};
  for (const NamedSeparation& named : settings_.separations) {
    limits.horizontal = std::min(limits.horizontal, named.separation.horizontal);
    if (tracks_.map().dimensions() == 3)
      limits.vertical = std::min(limits.vertical, named.separation.vertical);
  }
  bodies_.emplace(limits, tracks_.names());
}

/// Returns cells so small that two tracks in one are within the smallest separation, with room for errors.
TrackGroups::Cutting PairMonitor::cutting() const {
  TrackGroups::Cutting cutting{.edge = settings_.small_length()};
  constexpr double part = 0.25;
  if (tracks_.map().dimensions() == 3) {
    cutting.height = std::numeric_limits<double>::infinity();
    for (const NamedSeparation& named : settings_.separations)
      cutting.height = std::min(cutting.height, part * named.separation.vertical);
  }
  cutting.slow = cutting.edge / settings_.silence;
  constexpr double walking_pace = 1.0;  // metres per second
  if (tracks_.map().is_geographic()) cutting.slow = std::min(cutting.slow, walking_pace);
  return cutting;
}

void PairMonitor::go_on(double now) {
  now = std::max(monitor_->time(), now);
  give_up_until(now);
  advance(now);
  if (now < next_forgetting_) return;
  next_forgetting_ = now + settings_.forget;
  if (bodies_) bodies_->forget_before(now - settings_.forget);
  for (const TrackGroups::Cell& group : groups_->forget_before(now - settings_.forget)) end_group(group);
}

void PairMonitor::advance(double until) {
  for (;;) {
    const auto event = require(monitor_->advance(until));
    if (!event) return;
    const bool is_dropped = event->kind == MonitorEventKind::dropped;
    const auto removed = is_dropped ? removed_.find(event->first) : removed_.end();
    next_.tell(*event, removed == removed_.end() ? LeftFor{"silence"} : removed->second);
    if (is_dropped) leave(event->first);
    drop_crowd();
  }
}

/// Lets tracks go on as those that have ended by this time. Moves time on to that of the last one.
void PairMonitor::give_up_until(double time) {
  while (bodies_ && bodies_->next_time() <= time) {
    advance(std::max(monitor_->time(), bodies_->next_time()));
    const auto given_up = bodies_->give_up(monitor_->time(), *monitor_);
    if (!given_up) continue;
    if (!given_up->is_handover) {
      release_from(given_up->later);
      continue;
    }
    const LeftFor left_for{"handover", tracks_.names().text(given_up->later)};
    if (settings_.share.contains(given_up->former)) ++counts_.handovers;
    next_.hand_over(given_up->former, left_for);
    remove(given_up->former, left_for);
    settle();
  }
}

bool PairMonitor::has_room() const {
  // The other half is reserved for watched tracks that approach each other.
  return tracks_.names().size() < settings_.most_tracks &&
         monitor_->open_pair_count() < settings_.most_pairs / 2 + 1;
}

/// Removes the tracks in most open pairs if there are too many open pairs, until half of the limit is left.
void PairMonitor::drop_crowd() {
  if (monitor_->open_pair_count() <= settings_.most_pairs) return;
  for (const TrackId id : monitor_->crowd(settings_.most_pairs / 2)) {
    remove(id, {"crowd"});
    ++counts_.dropped;
  }
}

void PairMonitor::remove(TrackId track, const LeftFor& left_for) {
  require(monitor_->remove(track));
  removed_.insert_or_assign(track, left_for);
}

/// Forgets a track that the monitor has dropped.
void PairMonitor::leave(TrackId track) {
  next_.forget(track);
  const TrackId parted = bodies_ ? bodies_->remove(track) : 0;
  tracks_.names().remove(track);
  removed_.erase(track);
  if (const auto group = group_tracks_.find(track); group != group_tracks_.end()) {
    groups_->dissolve(group->second);
    group_tracks_.erase(group);
  }
  if (parted != 0) release_from(parted);
}

/// Releases a track that has parted from the one that it might have been, and those that may be the first of
/// these.
void PairMonitor::release_from(TrackId later) {
  for (TrackId track = later; track != 0; track = bodies_->later_of(track)) next_.release(track);
}

PairMonitor::Taken PairMonitor::take(const WatchedTracks::Arrival& arrival, std::string& refusal) {
  std::optional<TrackGroups::Cell> group;
  if (is_in_group(arrival, group)) {
    if (group)
      report_group(*group, arrival);
    else
      ++counts_.grouped;
    return Taken::in_group;
  }
  const auto taken = monitor_->report(arrival.id, arrival.on_map);
  if (taken) return Taken::alone;
  refusal = message_of(taken.error());
  return Taken::refused;
}

void PairMonitor::compare(const WatchedTracks::Arrival& arrival, bool is_first) {
  if (!bodies_) return;
  const SameBodies::Change change =
      bodies_->take(arrival.id, arrival.known->seen, arrival.on_map, is_first, *monitor_);
  for (const TrackId later : change.parted)
    for (TrackId each = later; each != 0; each = bodies_->later_of(each)) release_later(each);
  if (change.one_body) next_.tell_one_body(change.one_body->former, change.one_body->later);
}

void PairMonitor::release_due() {
  if (to_release_.empty()) return;
  settle();
  for (const TrackId track : std::exchange(to_release_, {})) next_.release(track);
}

std::vector<SameBodies::Change::Pair> PairMonitor::undecided() const {
  return bodies_ ? bodies_->undecided() : std::vector<SameBodies::Change::Pair>{};
}

/// Returns true for a report of a track that is in a group; `group`: which, if the monitor is due to get a
/// report of it.
bool PairMonitor::is_in_group(const WatchedTracks::Arrival& arrival,
                              std::optional<TrackGroups::Cell>& group) {
  const SourceReport& report = arrival.report;
  const TrackReport& on_map = arrival.on_map;
  if (report.id == settings_.own) return false;
  if (groups_->size() >= settings_.most_tracks && !groups_->contains(arrival.id)) return false;
  std::optional<double> speed;
  if (report.velocity) speed = norm(*report.velocity);
  const auto outcome = groups_->take(arrival.id, on_map.state.position, speed, on_map.timestamp);
  if (outcome.dissolved) end_group(*outcome.dissolved);
  if (!outcome.group) return false;
  if (outcome.is_new) {
    ++counts_.groups;
    next_.tell_group(group_name(*outcome.group), outcome.joined.size());
  }
  for (const TrackId member : outcome.joined)
    if (monitor_->contains(member)) remove(member, {"group"});
  if (groups_->is_due(*outcome.group, on_map.timestamp, 0.5 * settings_.window)) group = outcome.group;
  return true;
}

/// Reports the track that stands for a group: at the cell's centre, with an error that reaches all of the
/// cell.
void PairMonitor::report_group(const TrackGroups::Cell& group, const WatchedTracks::Arrival& arrival) {
  const TrackReport& on_map = arrival.on_map;
  const auto [edge, height, slow] = groups_->cutting();
  TrackReport of_group = on_map;
  // Members may have several classes.
  of_group.track_class = 0;
  of_group.state = {groups_->centre_of(group), {}};
  if (height == 0.0) of_group.state.position.z = on_map.state.position.z;
  of_group.position_error = on_map.position_error + ErrorBound::cylinder(std::sqrt(0.5) * edge, 0.5 * height);
  if (std::isfinite(on_map.velocity_error.total()))
    of_group.velocity_error = on_map.velocity_error + ErrorBound(slow);
  const std::string name = group_name(group);
  const TrackId id = track_id_of(name);
  if (!monitor_->report(id, of_group)) return;
  group_tracks_[id] = group;
  NamedTrack* const known = tracks_.names().find(id);
  NamedTrack& named = known != nullptr ? *known : tracks_.names().add(id, name);
  named = {.text = name,
           .stamp = arrival.report.stamp,
           .position = arrival.report.position,
           .declared = arrival.declared};
  named.declared.motion_class = 0;
  named.rest.is_at_rest = tracks_.has_rest();
}

void PairMonitor::end_group(const TrackGroups::Cell& group) {
  const TrackId id = track_id_of(group_name(group));
  group_tracks_.erase(id);
  if (monitor_->contains(id)) remove(id, {"dissolved"});
}

std::string PairMonitor::group_name(const TrackGroups::Cell& group) const {
  const Vec3 centre = groups_->centre_of(group);
  const auto& frame = tracks_.map().frame();
  if (!frame) return fmt::format("group at {:.6g},{:.6g},{:.6g}", centre.x, centre.y, centre.z);
  const Vec3 at = frame->geographic(centre);
  return fmt::format("group at {:.5f},{:.5f},{:.0f}", at.y, at.x, at.z);
}

}  // namespace kinesphere::program
