// Rechecks of pairs that are due, and report requests through a Poll.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "monitor/engine.hpp"
#include "number/scope_guard.hpp"

namespace kinesphere {

/// Returns true if a report of `a` promises to tighten the bounds more than a report of `b`.
bool Monitor::Engine::is_less_certain(std::uint32_t a, std::uint32_t b) const {
  const double of_a = tracks_[a].estimate.worth_asking(time_);
  const double of_b = tracks_[b].estimate.worth_asking(time_);
  return of_a != of_b ? of_a > of_b : tracks_[a].id < tracks_[b].id;
}

/// Rechecks a pair that is due, polling first if a poll is given.
Result<void> Monitor::Engine::recheck(const DueTime& due, const Poll* poll) {
  if (poll != nullptr && pairs_.find(due.first, due.second)->is_expiring(time_)) {
    if (Result<void> asked = ask_about(due, *poll); !asked) return asked;
    // The reports may have decided the pair.
    if (!is_due(due)) return {};
  }
  decide(due.first, due.second);
  return {};
}

/// Requests a report of one track and, if that leaves open whether the pair is apart or within, of the other
/// one.
Result<void> Monitor::Engine::ask_about(const DueTime& due, const Poll& poll) {
  const auto [a, b] = std::pair(due.first, due.second);
  // The pair is due again if the poll fails or throws.
  ScopeGuard again([&] { due_.add(due); });
  const std::array<std::uint32_t, 2> both = is_less_certain(a, b) ? std::array{a, b} : std::array{b, a};
  for (const std::uint32_t number : both) {
    if (!is_due(due) || is_decided(a, b)) break;
    if (!(tracks_[number].estimate.timestamp() < time_)) continue;
    if (Result<void> asked = ask(std::span(&number, 1), poll); !asked) return asked;
  }
  for (const std::uint32_t number : both) decide_pairs_not_due(number);
  again.dismiss();
  return {};
}

bool Monitor::Engine::is_decided(std::uint32_t a, std::uint32_t b) {
  const std::span<const Components> levels = levels_of(a, b);
  counters_.rechecks += levels.size();
  return std::all_of(levels.begin(), levels.end(), [&](const Components& level) {
    return forecast(a, b, level).verdict != Verdict::undecided;
  });
}

bool Monitor::Engine::has_undecided_pair(std::uint32_t number) const {
  const std::vector<std::uint32_t>& partners = tracks_[number].open;
  return std::any_of(partners.begin(), partners.end(),
                     [&](std::uint32_t other) { return pairs_.find(number, other)->is_undecided(); });
}

/// Returns the time of the next round: a multiple of its length, which doubles with every 8 rounds in which
/// nothing is requested, so that a gap takes a number of rounds like the logarithm of its length. Where
/// doubles are too coarse for that length, it is longer.
double Monitor::Engine::next_round() const {
  constexpr int rounds_of_a_length = 8, longest = 300, binary_digits = 50;
  const int resolvable = std::clamp(exponent_of(time_) - binary_digits, -longest, longest);
  const int rung =
      std::clamp(rung_ + static_cast<int>(quiet_rounds_) / rounds_of_a_length, resolvable, longest);
  return (std::floor(time_ * power_of_two(-rung)) + 1.0) * power_of_two(rung);
}

/// A report has come: the next round is not late.
void Monitor::Engine::hasten_round() {
  if (quiet_rounds_ == 0) return;
  quiet_rounds_ = 0;
  round_ = std::min(round_, next_round());
}

/// Requests reports of tracks with a plan that ends before the next round, and of tracks of undecided pairs.
Result<void> Monitor::Engine::ask_round(const Poll& poll) {
  const double next = next_round();
  std::vector<std::uint32_t> asked;
  for (std::uint32_t number = 0; number < tracks_.numbers(); ++number) {
    const KnownTrack& track = tracks_[number];
    if (track.present && track.estimate.timestamp() < time_ &&
        (track.estimate.first_end() < next || has_undecided_pair(number)))
      asked.push_back(number);
  }
  if (!asked.empty()) {
    if (Result<void> done = ask(asked, poll); !done) return done;
    for (const std::uint32_t number : asked) decide_pairs_not_due(number);
  }
  quiet_rounds_ = asked.empty() ? quiet_rounds_ + 1 : 0;
  round_ = next;
  return {};
}

/// Requests reports of these tracks, checks all returned reports, then applies them. Errors: those of
/// check(); none of the reports is applied then.
Result<void> Monitor::Engine::ask(std::span<const std::uint32_t> numbers, const Poll& poll) {
  std::vector<TrackId> ids;
  for (const std::uint32_t number : numbers) ids.push_back(tracks_[number].id);
  std::vector<std::optional<TrackReport>> reports(ids.size());
  {
    asking_ = true;
    const ScopeGuard answered([&] { asking_ = false; });
    poll(ids, time_, reports);
  }
  counters_.polls += ids.size();
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (reports[k])
      if (Result<void> checked = check(ids[k], *reports[k], "advance"); !checked) return checked;
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (reports[k]) take(ids[k], *reports[k]);
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (reports[k]) predict(*tracks_.find(ids[k]));
  return {};
}
}  // namespace kinesphere
