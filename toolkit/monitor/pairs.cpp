// Verdicts about pairs, and the certificates that trigger their rechecks.
#include <algorithm>

#include "monitor/engine.hpp"

namespace kinesphere {

/// Handles a pair that the search found: if the pair has no record and may cease to be apart before the
/// window ends, adds a certificate that fails at that time.
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

/// Returns the time until which the pair certainly is apart at all levels, or nothing if it is not apart now.
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

/// Decides the open pairs of a track after requested reports. Skips a pair with a verdict that expires now:
/// with the report of only one track it may seem undecided, and its own certificate will decide it.
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

/// Updates the verdicts about a pair, queues events for those that changed, and adds a certificate for the
/// next recheck. Creates a record if the pair is not apart.
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
  // Apart at one of several levels has a start time; apart at all levels has none.
  if (apart)
    for (LevelState& state : record->levels) state.since = -infinity;
  record->revision = pair_records_.fresh_revision();
  const auto [one, other] = std::minmax(a, b);
  if (until < (apart ? window().end : infinity))
    queue_.add({until, one, other, record->revision, of_open_record});
}

/// Removes the records of pairs that are apart again. Call it only when the windows end: until then the queue
/// may hold certificates without a record from before the record was made, which are stale as long as it
/// exists.
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
