// Rechecks of certificates that fail now, and report requests through a Poll.
#include <array>
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

/// Takes the first certificate from the queue and rechecks it, polling first if a poll is given.
Result<void> Monitor::Engine::recheck(const Poll* poll) {
  const PairCertificate pair = queue_.first();
  queue_.drop_first();
  if (is_stale(pair)) return {};
  if (!pair.has_second()) {
    look_at_silence(pair.first);
    return {};
  }
  const PairRecord* record = pair_records_.find(pair.first, pair.second);
  if (poll != nullptr && (record == nullptr || record->is_expiring(time_))) {
    if (Result<void> asked = ask_about(pair, *poll); !asked) return asked;
    // The reports may have made the certificate stale.
    if (is_stale(pair)) return {};
  }
  decide(pair.first, pair.second);
  return {};
}

/// Requests a report of one track and, if that leaves open whether the pair is apart or within, of the other
/// one.
Result<void> Monitor::Engine::ask_about(const PairCertificate& pair, const Poll& poll) {
  const auto [a, b] = std::pair(pair.first, pair.second);
  // Puts the certificate back into the queue if the poll fails or throws.
  ScopeGuard requeue([&] { queue_.add(pair); });
  const std::array<std::uint32_t, 2> both = is_less_certain(a, b) ? std::array{a, b} : std::array{b, a};
  for (const std::uint32_t number : both) {
    if (is_stale(pair) || is_decided(a, b)) break;
    if (!(tracks_[number].estimate.timestamp() < time_)) continue;
    if (Result<void> asked = ask(std::span(&number, 1), poll, Placing::now); !asked) return asked;
  }
  for (const std::uint32_t number : both) decide_pairs_not_due(number);
  requeue.dismiss();
  return {};
}

/// Requests reports of these tracks, checks all returned reports, then applies them. Errors: those of
/// check(); none of the reports is applied then.
Result<void> Monitor::Engine::ask(std::span<const std::uint32_t> numbers, const Poll& poll, Placing placing) {
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
    if (reports[k]) take(ids[k], *reports[k], placing);
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (reports[k]) predict(*tracks_.find(ids[k]));
  return {};
}
}  // namespace kinesphere
