// Verdicts about pairs, and the times until which they hold.
#include <algorithm>

#include "monitor/engine.hpp"

namespace kinesphere {

/// Returns the time until which the pair certainly is apart at all levels, or nothing if it is not apart now.
std::optional<double> Monitor::Engine::apart_until(std::uint32_t a, std::uint32_t b) {
  double until = infinity;
  for (const Components& level : levels_of(a, b)) {
    ++counters_.rechecks;
    const SeparationForecast now = forecast(a, b, level);
    if (now.verdict != Verdict::apart) return std::nullopt;
    until = std::min(until, now.until);
  }
  return until;
}

/// Sets the time until which a pair that is not open is apart; now if it may not be so.
void Monitor::Engine::certify(std::uint32_t a, std::uint32_t b, PairRecord& pair) {
  set_due(a, b, pair, apart_until(a, b).value_or(time_));
}

void Monitor::Engine::set_due(std::uint32_t a, std::uint32_t b, PairRecord& pair, double time) {
  if (pair.due == time) return;
  pair.due = time;
  add_due({time, DueTime::About::pair, std::min(a, b), std::max(a, b)});
}

void Monitor::Engine::decide_open_pairs(std::uint32_t number) {
  const std::vector<std::uint32_t> partners = tracks_[number].open;
  for (const std::uint32_t other : partners) decide(number, other);
}

/// Decides the open pairs of a track after requested reports. Skips a pair with a verdict that expires now:
/// with the report of only one track it may seem undecided, and it is due by itself.
void Monitor::Engine::decide_pairs_not_due(std::uint32_t number) {
  const std::vector<std::uint32_t> partners = tracks_[number].open;
  for (const std::uint32_t other : partners) {
    const std::vector<LevelState>& levels = pairs_.find(number, other)->levels;
    const bool is_due = std::any_of(levels.begin(), levels.end(), [this](const LevelState& state) {
      return -infinity < state.until && state.until <= time_;
    });
    if (!is_due) decide(number, other);
  }
}

/// Updates the verdicts about two tracks that are near each other, queues events for those that changed, and
/// sets the time of the next recheck.
void Monitor::Engine::decide(std::uint32_t a, std::uint32_t b) {
  PairRecord& pair = *pairs_.find(a, b);
  if (!pair.is_open()) {
    certify(a, b, pair);
    if (pair.due > time_) return;
    open(a, b, pair);
  }
  double until = infinity;
  for (std::uint32_t level = 0; level < pair.levels.size(); ++level) {
    decide_level(a, b, level, pair.levels[level]);
    until = std::min(until, pair.levels[level].until);
  }
  if (pair.is_apart()) return close(a, b, pair, until);
  set_due(a, b, pair, until);
}

/// Gives a pair verdicts of its own.
void Monitor::Engine::open(std::uint32_t a, std::uint32_t b, PairRecord& pair) {
  pair.levels.resize(levels_of(a, b).size());
  tracks_[a].open.push_back(b);
  tracks_[b].open.push_back(a);
  ++open_pairs_;
}

/// A pair is apart at all levels again until `until`.
void Monitor::Engine::close(std::uint32_t a, std::uint32_t b, PairRecord& pair, double until) {
  pair.levels = {};
  std::erase(tracks_[a].open, b);
  std::erase(tracks_[b].open, a);
  --open_pairs_;
  if (!near_.are_near(a, b)) return pairs_.remove(a, b);
  set_due(a, b, pair, until);
}

void Monitor::Engine::decide_level(std::uint32_t a, std::uint32_t b, std::uint32_t level, LevelState& state) {
  ++counters_.rechecks;
  const SeparationForecast now = forecast(a, b, levels_of(a, b)[level]);
  // A certain verdict holds until its time even if later reports alone would leave it open.
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
