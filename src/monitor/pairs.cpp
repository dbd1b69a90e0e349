// What is certain of pairs, and when it is to be looked at again.
#include <algorithm>

#include "monitor/engine.hpp"

namespace kinesphere {

/// Puts a pair that has no record on the agenda, for when it may not be apart any more: `a` and `b` may come
/// near each other before the window ends.
void Monitor::Engine::find_pair(std::uint32_t a, std::uint32_t b) {
  if (a == b || levels_of(a, b).empty() || pair_records_.find(a, b) != nullptr) return;
  ++counters_.near_pairs;
  const double horizon = window().end;
  const double until = apart_until(a, b, horizon).value_or(time_);
  if (until < horizon) add_certificate(a, b, until);
}

bool Monitor::Engine::is_decided(std::uint32_t a, std::uint32_t b) {
  const std::span<const Components> levels = levels_of(a, b);
  counters_.rechecks += levels.size();
  return std::all_of(levels.begin(), levels.end(), [&](const Components& level) {
    return forecast(a, b, level, infinity).verdict != Verdict::undecided;
  });
}

/// If they are apart at all levels.
std::optional<double> Monitor::Engine::apart_until(std::uint32_t a, std::uint32_t b, double horizon) {
  double until = infinity;
  for (const Components& level : levels_of(a, b)) {
    ++counters_.rechecks;
    const SeparationForecast now = forecast(a, b, level, horizon);
    if (now.verdict != Verdict::apart) return std::nullopt;
    until = std::min(until, now.until);
  }
  return until;
}

void Monitor::Engine::add_certificate(std::uint32_t a, std::uint32_t b, double time) {
  const auto [first, second] = std::minmax(a, b);
  queue_.add({time, first, second, tracks_[first].life, tracks_[second].life});
}

void Monitor::Engine::decide_open_pairs(std::uint32_t number) {
  const std::vector<std::uint32_t> partners = tracks_[number].open;
  for (const std::uint32_t other : partners) decide(number, other);
}

/// After reports that were asked for. A pair that is due now waits for its turn: with the report of one track
/// alone it may seem undecided.
void Monitor::Engine::decide_pairs_not_due(std::uint32_t number) {
  const std::vector<std::uint32_t> partners = tracks_[number].open;
  for (const std::uint32_t other : partners) {
    const std::vector<LevelState>& levels = pair_records_.find(number, other)->levels;
    const bool is_due = std::any_of(levels.begin(), levels.end(), [this](const LevelState& state) {
      return -infinity < state.until && state.until <= time_;
    });
    if (!is_due) decide(number, other);
  }
}

/// Says what is certain of two tracks now, tells what has changed, and keeps a record if they are not apart.
void Monitor::Engine::decide(std::uint32_t a, std::uint32_t b) {
  PairRecord* record = pair_records_.find(a, b);
  if (record == nullptr) {
    const double horizon = window().end;
    if (const auto until = apart_until(a, b, horizon)) {
      if (*until < horizon) add_certificate(a, b, *until);
      return;
    }
    record = &pair_records_.add(a, b, levels_of(a, b).size());
    tracks_[a].open.push_back(b);
    tracks_[b].open.push_back(a);
  }
  double until = infinity;
  bool apart = true;
  for (std::uint32_t level = 0; level < record->levels.size(); ++level) {
    decide_level(a, b, level, record->levels[level]);
    const LevelState& state = record->levels[level];
    until = std::min(until, state.until);
    apart = apart && state.verdict == Verdict::apart;
  }
  // That they are apart at one level of several has a begin; that they are apart has none.
  if (apart)
    for (LevelState& state : record->levels) state.since = -infinity;
  record->version = pair_records_.fresh_version();
  const auto [one, other] = std::minmax(a, b);
  if (until < (apart ? window().end : infinity))
    queue_.add({until, one, other, record->version, of_open_record});
}

/// Records of pairs that are apart again go when the windows end, and not before: until then hot pairs
/// without a record, from before it came, may stand in the agenda, and are void as long as there is one.
void Monitor::Engine::close_records() {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> closed;
  pair_records_.for_each([&](std::uint32_t a, std::uint32_t b, const PairRecord& record) {
    if (record.is_apart()) closed.emplace_back(a, b);
  });
  for (const auto& [a, b] : closed) {
    pair_records_.remove(a, b);
    std::erase(tracks_[a].open, b);
    std::erase(tracks_[b].open, a);
  }
}

void Monitor::Engine::decide_level(std::uint32_t a, std::uint32_t b, std::uint32_t level, LevelState& state) {
  ++counters_.rechecks;
  const SeparationForecast now = forecast(a, b, levels_of(a, b)[level], infinity);
  // What was certain stays so, also if later reports alone would leave it open.
  const bool still = state.verdict != Verdict::undecided && state.until > time_;
  if (now.verdict == state.verdict || still) {
    const bool known_longer = still && now.verdict != state.verdict;
    state.until = known_longer ? state.until : still ? std::max(state.until, now.until) : now.until;
    return;
  }
  const auto [first, second] = std::minmax(tracks_[a].id, tracks_[b].id);
  queue({.time = time_,
         .kind = MonitorEventKind::verdict,
         .first = first,
         .second = second,
         .level = level,
         .verdict = now.verdict,
         .before = state.verdict,
         .since = state.since});
  state = {now.verdict, time_, now.until};
}
}  // namespace kinesphere
