// Queries of a monitor: answer(), open_pairs(), crowd() and needed().
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

#include "monitor/engine.hpp"
#include "monitor/straight_pass.hpp"

namespace kinesphere {

/// Returns the time until which a pair that is not open is certified to be apart, or nothing if no earlier
/// certificate holds now. Reports that say less do not end a certificate. Cost: O(1).
std::optional<double> Monitor::Engine::certified_until(std::uint32_t a, std::uint32_t b) const {
  const PairRecord* pair = pairs_.find(a, b);
  const double until = pair != nullptr ? pair->due : std::min(tracks_[a].own, tracks_[b].own);
  return until > time_ ? std::optional(until) : std::nullopt;
}

Result<PairAnswer> Monitor::Engine::answer(TrackId first, TrackId second, std::uint32_t level) const {
  for (const TrackId id : {first, second})
    if (!tracks_.find(id))
      return Error{ErrorCode::unknown_body, id == first ? "first" : "second", no_body,
                   "answer: there is no track " + std::to_string(id)};
  if (first == second)
    return Error{ErrorCode::out_of_range, "second", no_body,
                 "answer: second must be another track than first"};
  const std::uint32_t a = *tracks_.find(first), b = *tracks_.find(second);
  const std::span<const Components> levels = levels_of(a, b);
  if (!definition_.shard.contains(std::min(first, second)))
    return Error{ErrorCode::out_of_range, "second", no_body,
                 "answer: first and second must be of a shard that is watched"};
  if (levels.empty())
    return Error{ErrorCode::out_of_range, "second", no_body,
                 "answer: no separation is watched between first, of class " +
                     std::to_string(tracks_[a].track_class) + ", and second, of class " +
                     std::to_string(tracks_[b].track_class)};
  if (level >= levels.size())
    return Error{ErrorCode::out_of_range, "level", no_body,
                 "answer: level must be less than " + std::to_string(levels.size()) + ", but is " +
                     std::to_string(level)};
  const KnownTrack& one = tracks_[a];
  const KnownTrack& other = tracks_[b];
  PairAnswer answer;
  const SeparationForecast now = forecast(a, b, levels[level]);
  const PairRecord* pair = pairs_.find(a, b);
  const bool is_open = pair != nullptr && pair->is_open();
  const LevelState state = is_open ? pair->levels[level] : LevelState{};
  answer.verdict = is_open ? state.verdict : now.verdict;
  answer.since = state.since;
  answer.until = !is_open || now.verdict == state.verdict ? std::max(now.until, state.until) : state.until;
  if (!is_open && now.verdict != Verdict::apart)
    if (const auto until = certified_until(a, b)) {
      answer.verdict = Verdict::apart;
      answer.until = *until;
    }
  const Component& nearest = *levels[level].begin();
  const DistanceBetween between = distance_between(one.estimate, other.estimate, nearest, time_);
  answer.lower = std::max(0.0, between.lower);
  answer.upper = between.upper;

  const State first_state = straight_on(one), second_state = straight_on(other);
  const StraightPass pass = straight_pass(first_state, second_state, levels[level], time_);
  answer.likely_time = pass.begin;
  answer.closest_time = pass.closest_time;
  answer.closest_distance = pass.closest_distance;
  const Vec3 velocity = first_state.velocity - second_state.velocity;
  const Vec3 closest = first_state.position - second_state.position + velocity * (pass.closest_time - time_);
  answer.closest_horizontal = norm({closest.x, closest.y, 0.0});
  answer.closest_vertical = std::abs(closest.z);
  answer.relative_speed = norm(velocity);
  answer.inevitable_by =
      answer.verdict == Verdict::within
          ? time_
          : certain_within_by(one.estimate, other.estimate, levels[level], time_, resolution());
  answer.avoidable_until =
      avoidable_until(first_state, second_state, acceleration_limit(one) + acceleration_limit(other),
                      levels[level], pass, time_);
  answer.predicted = predictions_.is_predicted(a, b, level);
  answer.ask = is_less_certain(a, b) ? first : second;
  answer.ask_by = answer.verdict == Verdict::undecided ? time_ : answer.until;
  return answer;
}

/// Returns the state now of a track that goes straight on from its latest report.
State Monitor::Engine::straight_on(const KnownTrack& track) const {
  const ReachableSet& set = TrackEstimate::tightest(track.estimate.hypotheses().front(), time_);
  return {set.centre_at(time_), set.velocity_at(time_)};
}

/// Returns the limit of a track's acceleration now: that of its class, or of plans beyond it.
ErrorBound Monitor::Engine::acceleration_limit(const KnownTrack& track) const {
  return track.estimate.hypotheses().front().plans.limit_from(time_, classes_[track.track_class]);
}

std::vector<OpenPair> Monitor::Engine::open_pairs() const {
  std::vector<OpenPair> pairs;
  pairs_.for_each([&](std::uint32_t a, std::uint32_t b, const PairRecord& record) {
    const auto [first, second] = std::minmax(tracks_[a].id, tracks_[b].id);
    for (std::uint32_t level = 0; level < record.levels.size(); ++level)
      if (const LevelState& state = record.levels[level]; state.verdict != Verdict::apart)
        pairs.push_back({first, second, level, state.verdict, state.since});
  });
  std::sort(pairs.begin(), pairs.end(), [](const OpenPair& p, const OpenPair& q) {
    return std::tie(p.first, p.second, p.level) < std::tie(q.first, q.second, q.level);
  });
  return pairs;
}

std::vector<TrackId> Monitor::Engine::crowd(std::size_t pairs) const {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t number = 0; number < tracks_.numbers(); ++number)
    if (tracks_[number].present && !tracks_[number].open.empty()) numbers.push_back(number);
  std::sort(numbers.begin(), numbers.end(), [this](std::uint32_t a, std::uint32_t b) {
    const KnownTrack& one = tracks_[a];
    const KnownTrack& other = tracks_[b];
    return one.open.size() != other.open.size() ? one.open.size() > other.open.size() : one.id < other.id;
  });
  std::vector<TrackId> crowd;
  std::vector<bool> is_chosen(tracks_.numbers(), false);
  for (std::size_t left = open_pairs_, k = 0; left > pairs; ++k) {
    const KnownTrack& track = tracks_[numbers[k]];
    const auto closed = std::count_if(track.open.begin(), track.open.end(),
                                      [&](std::uint32_t other) { return !is_chosen[other]; });
    if (closed == 0) continue;
    left -= static_cast<std::size_t>(closed);
    is_chosen[numbers[k]] = true;
    crowd.push_back(track.id);
  }
  return crowd;
}

std::vector<ReportRequest> Monitor::Engine::needed(double until) const {
  std::vector<ReportRequest> needs;
  pairs_.for_each([&](std::uint32_t a, std::uint32_t b, const PairRecord& pair) {
    const double by = pair.is_undecided() ? time_ : std::max(time_, pair.due);
    if (by > until && !pair.is_undecided()) return;
    const auto [asked, other] = is_less_certain(a, b) ? std::pair(a, b) : std::pair(b, a);
    needs.push_back({tracks_[asked].id, by, tracks_[other].id});
  });
  std::sort(needs.begin(), needs.end(), [](const ReportRequest& p, const ReportRequest& q) {
    return std::tie(p.by, p.track, p.other) < std::tie(q.by, q.track, q.other);
  });
  std::set<TrackId> seen;
  std::erase_if(needs, [&](const ReportRequest& need) { return !seen.insert(need.track).second; });
  return needs;
}
}  // namespace kinesphere
