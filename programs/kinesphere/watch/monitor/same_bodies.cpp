#include "watch/monitor/same_bodies.hpp"
#include "formats/fields/wrong_input.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geography/flat_length.hpp"

namespace kinesphere::program {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// A track that has been silent for so many of its intervals has ended. Fewer give up tracks of which two
/// reports were lost, more leave longer what stands where an id has ended.
constexpr double silent_intervals = 3.0;
/// From so many reports on the intervals of a track say how often it reports.
constexpr std::uint32_t enough_reports = 4;
/// Part of an earlier interval that counts when a shorter one follows.
constexpr double remembered = 0.875;
/// A link is given up before its track is stale, at this part of that time.
constexpr double before_stale = 0.95;
/// For so many intervals a track may be anywhere in what its class allows, and a track that begins there may
/// go on as it; later that says nothing but where the place is small, and near where it would be straight on.
constexpr double near_intervals = 5.0;
/// Reports of each of two that are alike before they are one body.
constexpr std::uint32_t enough_alike = 3;

}  // namespace

SameBodies::SameBodies(const Limits& limits, TrackNames& names)
    : limits_(limits), names_(names), places_(limits.horizontal) {}

Sighting* SameBodies::find(TrackId track) {
  NamedTrack* const named = track != 0 ? names_.find(track) : nullptr;
  return named != nullptr ? &named->seen : nullptr;
}

const Sighting* SameBodies::find(TrackId track) const { return const_cast<SameBodies*>(this)->find(track); }

SameBodies::Change SameBodies::take(TrackId track, Sighting& seen, const TrackReport& report, bool is_first,
                                    const Monitor& monitor) {
  Change change;
  note(track, seen, report, is_first);
  if (is_first) {
    if (!given_up_.contains(track)) link(track, report, monitor);
    return change;
  }
  if (seen.later != 0 && report.timestamp >= find(seen.later)->first)
    compare(seen.later, report, seen.later, monitor, change);
  if (seen.link.former == 0) return change;
  if (seen.link.may_go_on)
    schedule(track);
  else
    compare(track, report, seen.link.former, monitor, change);
  return change;
}

/// Remembers a report.
void SameBodies::note(TrackId track, Sighting& seen, const TrackReport& report, bool is_first) {
  if (!is_first && report.timestamp <= seen.stamp) return;
  fastest_ = std::max(fastest_, std::min(flat_length(report.state.velocity), limits_.fastest));
  // What goes straight on for the time of silence gets no farther than this.
  const double needed = limits_.horizontal + fastest_ * limits_.silence;
  if (needed > places_.edge()) places_.widen(2.0 * needed);
  if (is_first) {
    seen = {.first = report.timestamp};
    seen.place = places_.add(track, report.state, report.timestamp);
  } else {
    seen.interval = std::max(report.timestamp - seen.stamp, remembered * seen.interval);
    places_.set(seen.place, report.state, report.timestamp);
  }
  ++seen.reports;
  seen.stamp = report.timestamp;
  seen.state = report.state;
  seen.velocity_error = report.velocity_error.horizontal();
}

/// Links a track to the one that it may go on as, or be another id of, if there is one: the nearest one.
void SameBodies::link(TrackId track, const TrackReport& report, const Monitor& monitor) {
  TrackId former = 0;
  double nearest = never;
  places_.near(report.state.position, [&](const LatestPlaces::Entry& entry) {
    const double gap = report.timestamp - entry.stamp;
    const Vec3 between = entry.state.position + entry.state.velocity * gap - report.state.position;
    const double flat = flat_length(between);
    if (flat > nearest || std::abs(gap) > limits_.silence || entry.track == track) return;
    if (flat == nearest && entry.track > former) return;
    const bool is_soon = limits_.has_steady_rate && gap <= near_intervals * find(entry.track)->interval;
    const bool is_near = flat <= limits_.horizontal && std::abs(between.z) <= limits_.vertical;
    if (!is_soon && !(is_near && is_known_well(entry.track, monitor))) return;
    // A track that has reported at this time is another body, or of one sender.
    if (gap <= 0.0 && !is_moving(report, entry.track)) return;
    if (find(entry.track)->later != 0 || !may_be(report, entry.track, monitor)) return;
    former = entry.track;
    nearest = flat;
  });
  if (former == 0) return;
  find(former)->later = track;
  Sighting& seen = *find(track);
  seen.link = {.former = former, .may_go_on = find(former)->stamp < report.timestamp};
  schedule(track);
}

/// Compares a report of one of two linked tracks with the other one. If they can not be one body under two
/// ids they part.
void SameBodies::compare(TrackId later, const TrackReport& report, TrackId other, const Monitor& monitor,
                         Change& change) {
  if (!is_moving(report, other) || !may_be(report, other, monitor)) {
    part(later);
    change.parted.push_back(later);
    return;
  }
  schedule(later);
  Sighting::Link& link = find(later)->link;
  const TrackId latest = find(later)->later;
  if (link.may_go_on && latest != 0) change.parted.push_back(latest);
  link.may_go_on = false;
  ++(other == later ? link.former_alike : link.alike);
  if (link.is_told || std::min(link.alike, link.former_alike) < enough_alike) return;
  link.is_told = true;
  change.one_body = Change::Pair{link.former, later};
}

/// Returns true if the body of a report may be where another track may be, with its velocity.
bool SameBodies::may_be(const TrackReport& report, TrackId other, const Monitor& monitor) const {
  const auto view = monitor.track(other);
  if (!view) return false;
  const Sighting& seen = *find(other);
  const double late = monitor.time() - report.timestamp;
  const Vec3 position = report.state.position + report.state.velocity * late;
  const double moved = norm(report.state.velocity) * report.timestamp_error;
  const ErrorBound& limit = monitor.definition().classes[view->track_class].acceleration_limit;
  const double turned = report.velocity_error.horizontal() + seen.velocity_error +
                        limit.horizontal() * std::max(0.0, monitor.time() - seen.stamp);
  return std::any_of(view->places.begin(), view->places.end(), [&](const TrackView::Place& place) {
    const Vec3 between = position - place.centre;
    const bool is_there =
        flat_length(between) <= place.radius.horizontal() + report.position_error.horizontal() + moved &&
        std::abs(between.z) <= place.radius.vertical() + report.position_error.vertical() + moved;
    // An acceleration that has no limit allows any velocity.
    return is_there && !(flat_length(report.state.velocity - place.velocity) > turned);
  });
}

/// Returns true if a track is in a place no larger than the separation. Of others that are silent it cannot
/// be said whether they have ended.
bool SameBodies::is_known_well(TrackId track, const Monitor& monitor) const {
  const auto view = monitor.track(track);
  return view && view->places.front().radius.horizontal() <= limits_.horizontal;
}

/// Returns true if a report is of a velocity that errors do not explain: then equal ones say something.
bool SameBodies::is_moving(const TrackReport& report, TrackId other) const {
  return flat_length(report.state.velocity) >
         report.velocity_error.horizontal() + find(other)->velocity_error;
}

void SameBodies::part(TrackId later) {
  unschedule(later);
  Sighting& seen = *find(later);
  if (Sighting* const former = find(seen.link.former); former != nullptr) former->later = 0;
  seen.link = {};
}

/// Sets when a link is given up.
void SameBodies::schedule(TrackId later) {
  unschedule(later);
  Sighting& seen = *find(later);
  const Sighting& former = *find(seen.link.former);
  const double longest = before_stale * limits_.silence;
  double interval = former.interval;
  bool is_known = former.reports >= enough_reports;
  if (!is_known && seen.reports >= enough_reports) {
    // One body reports as often under both of its ids.
    interval = std::max({interval, seen.interval, seen.first - former.stamp});
    is_known = true;
  }
  const bool is_regular = is_known && limits_.has_steady_rate;
  seen.link.due = former.stamp + (is_regular ? std::min(silent_intervals * interval, longest) : longest);
  due_.insert({seen.link.due, later});
}

void SameBodies::unschedule(TrackId later) {
  Sighting::Link& link = find(later)->link;
  due_.erase({link.due, later});
  link.due = never;
}

double SameBodies::next_time() const { return due_.empty() ? never : due_.begin()->first; }

std::optional<SameBodies::GivenUp> SameBodies::give_up(double time, const Monitor& monitor) {
  if (next_time() > time) return std::nullopt;
  const TrackId later = due_.begin()->second;
  const TrackId former = find(later)->link.former;
  part(later);
  const bool may_be_there = !limits_.has_steady_rate && !is_known_well(former, monitor);
  if (former == limits_.own || may_be_there) return GivenUp{former, later, false};
  // The former one may itself be another one that has ended.
  Sighting& ended = *find(former);
  if (const Sighting::Link link = ended.link; link.former != 0) {
    part(former);
    find(link.former)->later = later;
    find(later)->link = link;
    find(later)->link.due = never;
    schedule(later);
  }
  given_up_[former] = time;
  return GivenUp{former, later, true};
}

TrackId SameBodies::remove(TrackId track) {
  const Sighting* const seen = find(track);
  if (seen == nullptr || seen->reports == 0) return 0;
  const TrackId later = seen->later;
  const bool was_between = later != 0 && seen->link.former != 0;
  if (later != 0) part(later);
  if (seen->link.former != 0) part(track);
  places_.remove(seen->place);
  return was_between ? later : 0;
}

bool SameBodies::may_be_one(TrackId a, TrackId b) const { return goes_back_to(a, b) || goes_back_to(b, a); }

/// True if a track is linked to an earlier one, or to one that is and may have ended, and so on. Of two that
/// both report, others may be one or the other, but not both.
bool SameBodies::goes_back_to(TrackId track, TrackId earlier) const {
  for (const Sighting* seen = find(track); seen != nullptr; seen = find(seen->link.former)) {
    if (seen->link.former == earlier) return true;
    if (!seen->link.may_go_on) return false;
  }
  return false;
}

std::vector<SameBodies::Change::Pair> SameBodies::undecided() const {
  std::vector<Change::Pair> pairs;
  for (const auto& [time, later] : due_)
    if (find(later)->link.may_go_on) pairs.push_back({find(later)->link.former, later});
  return pairs;
}

TrackId SameBodies::later_of(TrackId track) const {
  const Sighting* const seen = find(track);
  return seen != nullptr ? seen->later : 0;
}

void SameBodies::forget_before(double time) {
  std::erase_if(given_up_, [time](const auto& given_up) { return given_up.second < time; });
}

/// Returns false unless the track knows of its links as the tracks at their other ends do.
bool SameBodies::is_linked_well(TrackId track) const {
  const Sighting& seen = *find(track);
  const TrackId former_id = seen.link.former;
  const Sighting *const former = find(former_id), *const later = find(seen.later);
  if (seen.reports == 0) return former_id == 0 && seen.later == 0;
  const bool has_former = former_id == 0 || (former != nullptr && former->later == track);
  const bool has_later = seen.later == 0 || (later != nullptr && later->link.former == track);
  return has_former && has_later && std::isfinite(seen.link.due) == (former_id != 0);
}

void SameBodies::go_on() {
  std::vector<TrackId> tracks;
  names_.for_each([&](const NamedTrack& named) { tracks.push_back(track_id_of(named.text)); });
  places_.widen(std::max(places_.edge(), 2.0 * (limits_.horizontal + fastest_ * limits_.silence)));
  for (const TrackId track : tracks) {
    Sighting& seen = *find(track);
    if (!is_linked_well(track)) throw WrongInput("expected links between tracks of the snapshot");
    if (seen.reports == 0) continue;
    seen.place = places_.add(track, seen.state, seen.stamp);
    if (std::isfinite(seen.link.due)) due_.insert({seen.link.due, track});
  }
}

}  // namespace kinesphere::program
