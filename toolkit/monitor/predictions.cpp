#include "monitor/predictions.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace kinesphere {
namespace {

/// A home contains the path for this part of the look-ahead time longer: more makes larger homes, with more
/// near tracks, less makes more searches.
constexpr double look_ahead_to_spare = 0.75;
/// Room for other paths, in parts of the length of the path.
constexpr double room_beside_path = 0.1;

/// False if two that go straight on never come nearer than `reach` (length).
bool may_meet(const State& first, const State& second, double reach) {
  const Vec3 offset = first.position - second.position;
  const Vec3 velocity = first.velocity - second.velocity;
  const double x2 = norm_squared(offset), v2 = norm_squared(velocity), xv = dot(offset, velocity);
  const double r2 = reach * reach;
  return x2 <= r2 || (xv < 0.0 && v2 * (x2 - r2) <= xv * xv);
}

}  // namespace

std::span<const Components> Predictions::levels_of(const Track& a, const Track& b) const {
  if (!definition_->shard.contains(std::min(a.id, b.id))) return {};
  const std::span<const Components> levels = separations_->between(a.track_class, b.track_class);
  const bool looks_ahead = std::any_of(levels.begin(), levels.end(),
                                       [](const Components& level) { return level.look_ahead > 0.0; });
  return looks_ahead ? levels : std::span<const Components>();
}

void Predictions::set_path(std::uint32_t number, TrackId id, std::size_t track_class, const State& state,
                           const ErrorBound& error, double now, std::vector<MonitorEvent>& events) {
  if (number >= tracks_.size()) tracks_.resize(number + 1);
  Track& track = tracks_[number];
  track.path = {now, state, error * definition_->prediction_error_part};
  if (!track.present) {
    track.present = true;
    track.id = id;
    track.track_class = track_class;
    track.until = -infinity;
  }
  if (!stays_home(number, now)) find_home(number, now);
  decide_all(number, now, events);
}

void Predictions::remove(std::uint32_t number) {
  if (number >= tracks_.size() || !tracks_[number].present) return;
  for (const std::uint32_t other : homes_.near(number)) remove_pair(number, other);
  homes_.remove(number);
  tracks_[number] = {};
}

/// Returns half of the largest distance of two tracks, if they are alike, at the closest approach of a pair
/// that is predicted. Well clear may be lost up to the modified tau before, at another vertical distance.
double Predictions::margin(const Track& track) const {
  return separations_->margin(track.track_class) +
         separations_->modified_tau(track.track_class) * std::abs(track.path.state.velocity.z) +
         track.path.error.total(separations_->stretch(track.track_class));
}

Components Predictions::with_errors(const Components& level, const Track& a, const Track& b) const {
  return definition_->prediction_error_part > 0.0 ? level.enlarged(a.path.error + b.path.error) : level;
}

/// True if the track's path from now until its look-ahead time after the home's end is in the home, which
/// contains both ends only if it contains the path.
bool Predictions::stays_home(std::uint32_t number, double now) const {
  const Track& track = tracks_[number];
  if (!(now < track.until)) return false;
  const Region home = homes_.region(number, 0);
  const double room = home.radius - margin(track);
  const double end = track.until + separations_->look_ahead(track.track_class);
  const auto is_inside = [&](double t) {
    return norm(track.path.state_at(t).position - home.centre) <= room;
  };
  return is_inside(now) && is_inside(end);
}

/// Gives the track a home for its present path, and finds the tracks near it. A near pair with a prediction
/// stays near until that has ended.
void Predictions::find_home(std::uint32_t number, double now) {
  Track& track = tracks_[number];
  const double look_ahead = separations_->look_ahead(track.track_class);
  track.until = std::max(now + look_ahead_to_spare * look_ahead, std::nextafter(now, infinity));
  const double half = 0.5 * (track.until - now + look_ahead);
  const State middle = track.path.state_at(now + half);
  const double radius = norm(middle.velocity) * half * (1.0 + room_beside_path) + 2.0 * margin(track);
  const Region home{middle.position, radius};
  add_due({track.until, DueTime::About::region, number});
  homes_.place(number, std::span(&home, 1), [this](std::uint32_t a, std::uint32_t b) {
    return !levels_of(tracks_[a], tracks_[b]).empty();
  });
  for (const std::uint32_t other : homes_.gone()) {
    const PairPrediction* pair = find_pair(number, other);
    if (pair != nullptr && pair->is_predicted()) continue;
    remove_pair(number, other);
    homes_.part(number, other);
  }
}

PairPrediction* Predictions::find_pair(std::uint32_t a, std::uint32_t b) {
  return tracks_[a].pairs > 0 && tracks_[b].pairs > 0 ? pairs_.find(a, b) : nullptr;
}

/// Precondition: the pair has no PairPrediction.
PairPrediction& Predictions::add_pair(std::uint32_t a, std::uint32_t b, std::size_t levels) {
  ++tracks_[a].pairs;
  ++tracks_[b].pairs;
  PairPrediction& pair = pairs_.add(a, b);
  pair.levels.resize(levels);
  return pair;
}

/// Removes the PairPrediction of a pair, if it has one.
void Predictions::remove_pair(std::uint32_t a, std::uint32_t b) {
  if (find_pair(a, b) == nullptr) return;
  --tracks_[a].pairs;
  --tracks_[b].pairs;
  pairs_.remove(a, b);
}

void Predictions::decide_all(std::uint32_t number, double now, std::vector<MonitorEvent>& events) {
  // A pair whose prediction has ended may part: the last of those near takes its place.
  for (std::size_t k = homes_.near(number).size(); k-- > 0;)
    decide(number, homes_.near(number)[k], now, events);
}

/// Returns how the two pass each other at the separation that decides whether they are predicted: the
/// enlarged one if they are. `pass` is that at the separation itself.
StraightPass Predictions::judge(const State& first, const State& second, const Components& level,
                                const StraightPass& pass, bool is_predicted, double now) const {
  const double margin = definition_->prediction_margin;
  return is_predicted && margin > 0.0 ? straight_pass(first, second, level.enlarged(margin), now) : pass;
}

/// Updates the predictions of a near pair from the two paths, adds events for those that change, and sets the
/// time at which time alone may change them.
void Predictions::decide(std::uint32_t a, std::uint32_t b, double now, std::vector<MonitorEvent>& events) {
  const Track& one = tracks_[a];
  const Track& other = tracks_[b];
  const State first = one.path.state_at(now), second = other.path.state_at(now);
  PairPrediction* known = find_pair(a, b);
  const bool was_predicted = known != nullptr && known->is_predicted();
  if (!was_predicted && !may_meet(first, second, margin(one) + margin(other))) {
    if (known != nullptr) remove_pair(a, b);
    return;
  }
  const std::span<const Components> levels = levels_of(one, other);
  PairPrediction& pair = known != nullptr ? *known : add_pair(a, b, levels.size());
  const double hold = definition_->prediction_hold;
  const double resolution = std::max(definition_->time_resolution, std::abs(now) * 0x1p-50);
  double due = infinity;
  for (std::uint32_t level = 0; level < levels.size(); ++level) {
    const double look_ahead = levels[level].look_ahead;
    if (!(look_ahead > 0.0)) continue;
    LevelPrediction& state = pair.levels[level];
    const Components separation = with_errors(levels[level], one, other);
    const StraightPass pass = straight_pass(first, second, separation, now);
    const StraightPass judged = judge(first, second, separation, pass, state.predicted, now);
    // They meet if their closest approach (or the loss of well clear) comes in the look-ahead time, or they
    // are within the separation now. The times of one pass, computed at two times, differ by rounding.
    const auto from_of = [&](const StraightPass& straight) {
      if (straight.begin == infinity) return infinity;
      const double entry = separation.predicts_entry ? straight.begin : straight.closest_within();
      return std::min(straight.begin, entry - look_ahead);
    };
    const bool holds = from_of(judged) <= now + resolution && judged.end > now;
    if (state.holds)
      state.held_until = now;
    else
      state.held_since = now;
    state.holds = holds;
    const double confirmed = state.held_since + definition_->prediction_confirmation;
    const bool begins = holds && !state.predicted && confirmed <= now;
    const bool ends = !holds && state.predicted && state.held_until + hold <= now;
    if (begins) state.since = now;
    if (begins || ends) {
      state.predicted = begins;
      events.push_back({.time = now,
                        .kind = begins ? MonitorEventKind::predicted : MonitorEventKind::prediction_ended,
                        .first = std::min(one.id, other.id),
                        .second = std::max(one.id, other.id),
                        .level = level,
                        .since = state.since,
                        .likely_time = pass.begin,
                        .closest_time = pass.closest_time,
                        .closest_distance = pass.closest_distance});
    }
    if (holds) {
      const StraightPass next = judge(first, second, separation, pass, state.predicted, now);
      due = std::min(due, std::max(next.end, now + resolution));
      if (!state.predicted) due = std::min(due, std::max(confirmed, now + resolution));
    } else {
      due = std::min(due, std::max(from_of(state.predicted ? judged : pass), now + resolution));
      if (state.predicted) due = std::min(due, std::max(state.held_until + hold, now + resolution));
    }
  }
  // The homes may have parted while the pair was predicted.
  if (was_predicted && !pair.is_predicted() && !homes_.touch(a, b)) {
    remove_pair(a, b);
    return homes_.part(a, b);
  }
  if (due == pair.due) return;
  pair.due = due;
  if (due < infinity) add_due({due, DueTime::About::pair, std::min(a, b), std::max(a, b)});
}

/// Returns false if this time is stale.
bool Predictions::is_due(const DueTime& due) const {
  if (due.about == DueTime::About::region)
    return tracks_[due.first].present && tracks_[due.first].until == due.time;
  const PairPrediction* pair = pairs_.find(due.first, due.second);
  return pair != nullptr && pair->due == due.time;
}

void Predictions::advance(double now, std::vector<MonitorEvent>& events) {
  while (next_time() <= now) {
    const DueTime due = due_.take_first();
    if (!is_due(due)) continue;
    if (due.about == DueTime::About::region) {
      find_home(due.first, now);
      decide_all(due.first, now, events);
    } else {
      decide(due.first, due.second, now, events);
    }
  }
}

bool Predictions::restore(std::span<const std::optional<TrackKey>> tracks, double now) {
  if (tracks_.size() > tracks.size()) return false;
  for (std::uint32_t number = 0; number < tracks.size(); ++number) {
    const bool is_present = number < tracks_.size() && tracks_[number].present;
    const std::optional<TrackKey>& key = tracks[number];
    if ((key && separations_->look_ahead(key->track_class) > 0.0) != is_present) return false;
    if (!is_present) continue;
    tracks_[number].id = key->id;
    tracks_[number].track_class = key->track_class;
    if (!is_valid(tracks_[number], now)) return false;
  }
  const auto homes_of = [this](std::uint32_t number) { return tracks_[number].present ? 1U : 0U; };
  const auto matters = [&](std::uint32_t a, std::uint32_t b) {
    return !levels_of(tracks_[a], tracks_[b]).empty();
  };
  if (!homes_.rebuild(tracks_.size(), homes_of, matters) || !restore_pairs()) return false;
  index_due();
  return true;
}

/// Returns false if a pair that was read cannot be one of these tracks.
bool Predictions::restore_pairs() {
  bool valid = true;
  pairs_.for_each([&](std::uint32_t a, std::uint32_t b, const PairPrediction& pair) {
    const auto is_present = [&](std::uint32_t number) {
      return number < tracks_.size() && tracks_[number].present;
    };
    valid =
        valid && a < b && is_present(a) && is_present(b) && !std::isnan(pair.due) && !pair.levels.empty() &&
        pair.levels.size() == levels_of(tracks_[a], tracks_[b]).size() &&
        (homes_.are_near(a, b) || pair.is_predicted()) &&
        std::all_of(pair.levels.begin(), pair.levels.end(), [](const LevelPrediction& level) {
          return !std::isnan(level.since) && !std::isnan(level.held_since) && !std::isnan(level.held_until);
        });
    if (!valid) return;
    if (!homes_.are_near(a, b)) homes_.join(a, b);
    ++tracks_[a].pairs;
    ++tracks_[b].pairs;
  });
  return valid;
}

bool Predictions::is_valid(const Track& track, double now) const {
  const auto& [time, state, error] = track.path;
  return time <= now && std::isfinite(time) && is_finite(state.position) && is_finite(state.velocity) &&
         error.total() >= 0.0 && error.horizontal() >= 0.0 && error.vertical() >= 0.0 &&
         std::isfinite(error.total(separations_->stretch(track.track_class))) && std::isfinite(track.until);
}

/// Adds a time to the queue. Precondition: the track or the pair has this time.
void Predictions::add_due(const DueTime& due) {
  if (due_.are_stale(tracks_.size() + pairs_.size())) return index_due();
  due_.add(due);
}

/// Makes the queue from the times of the tracks and pairs.
void Predictions::index_due() {
  due_.clear();
  for (std::uint32_t number = 0; number < tracks_.size(); ++number)
    if (tracks_[number].present) due_.add({tracks_[number].until, DueTime::About::region, number});
  pairs_.for_each([&](std::uint32_t a, std::uint32_t b, const PairPrediction& pair) {
    if (pair.due < infinity) due_.add({pair.due, DueTime::About::pair, a, b});
  });
}

std::vector<PredictedPair> Predictions::predicted_pairs(double now) const {
  std::vector<PredictedPair> predicted;
  pairs_.for_each([&](std::uint32_t a, std::uint32_t b, const PairPrediction& pair) {
    const Track& one = tracks_[a];
    const Track& other = tracks_[b];
    const auto [first, second] = std::minmax(one.id, other.id);
    for (std::uint32_t level = 0; level < pair.levels.size(); ++level) {
      if (!pair.levels[level].predicted) continue;
      const StraightPass pass = straight_pass(one.path.state_at(now), other.path.state_at(now),
                                              with_errors(levels_of(one, other)[level], one, other), now);
      predicted.push_back({first, second, level, pair.levels[level].since, pass.begin, pass.closest_time,
                           pass.closest_distance});
    }
  });
  std::sort(predicted.begin(), predicted.end(), [](const PredictedPair& p, const PredictedPair& q) {
    return std::tie(p.first, p.second, p.level) < std::tie(q.first, q.second, q.level);
  });
  return predicted;
}

}  // namespace kinesphere
