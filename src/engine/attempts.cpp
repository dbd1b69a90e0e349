#include "engine/attempts.hpp"

#include <utility>

namespace kinesphere {

Attempts::Attempts(Tables& tables, const Island& everybody, std::size_t workers, const Probe& probe,
                   Answerer* answerer)
    : answerer_(answerer) {
  for (std::size_t worker = 0; worker < workers; ++worker) {
    Island& island = runners_.emplace_back(Runner{Island(tables, everybody.time())}).island;
    island.agenda().order_by(everybody.agenda().order());
    island.reports().ask(probe, "run");
  }
}

void Attempts::clear() {
  kicks_kept_ = 0;
  for (Runner& runner : runners_) runner.beside.clear();
}

void Attempts::run(Group& group, std::span<const HotPair> due, Sea& sea, std::uint32_t worker) {
  auto& [island, beside] = runners_[worker];
  group.again = false;
  group.attempted = group.is_news = true;
  ++group.attempts;
  group.kicks_are_compared = false;
  group.failed = true;
  beside.begin(sea, group.own);
  island.begin(beside, due, group.unsettled, group.pending);
  try {
    const auto gone = go_on(runners_[worker]);
    group.failed = !gone || beside.is_full();
    if (!gone && !beside.failure) beside.failure = gone.error();
  } catch (...) {
    group.outcome = end(runners_[worker], worker);
    throw;
  }
  group.outcome = end(runners_[worker], worker);
}

Outcome Attempts::end(Runner& runner, std::uint32_t worker) {
  runner.island.facts().for_each_hot_pair(runner.island.agenda(),
                                          [&](const HotPair& pair) { runner.beside.left.add(pair); });
  return runner.beside.end(worker, runner.island.work());
}

/// As World::Engine::advance(), but that no windows start. Where islands go nowhere, it settles what is
/// unsettled.
Result<void> Attempts::go_on(Runner& runner) {
  auto& [island, beside] = runner;
  if (!beside.sea->comes(island.time())) return island.settle();
  std::uint32_t round = 0;
  for (;;) {
    if (island.is_gathering()) {
      if (auto gathered = island.gather(); !gathered) return gathered;
    }
    while (const std::optional<Event> event = island.deliver()) {
      beside.told.add({round, *event});
      if (answerer_ != nullptr) {
        if (auto answered = answer(runner, *event); !answered) return answered;
      }
      if (!beside.claims.empty()) return {};
    }
    if (auto settled = island.settle(); !settled) return settled;
    if (!beside.claims.empty() || beside.is_full()) return {};
    ++round;
    if (!island.instant().pending().empty()) continue;
    const double next = island.next_time();
    if (!beside.sea->comes(next)) return {};
    if (next > island.time()) round = 0;
    island.come_to(next);
  }
}

Result<void> Attempts::answer(Runner& runner, const Event& event) {
  const auto answer = answerer_->answer(event);
  if (!answer) return answer.error();
  const auto note = [&](BodyId body, const std::optional<Vec3>& velocity) {
    if (velocity) runner.beside.turned.add({body, answerer_->departure(body)});
  };
  note(event.first, answer->first_velocity);
  note(event.second, answer->second_velocity);
  if (auto turned = answerer_->turn(event, *answer); !turned) return turned;
  if (answer->first_velocity) runner.island.kick(event.first, *answer->first_velocity);
  if (answer->second_velocity) runner.island.kick(event.second, *answer->second_velocity);
  return {};
}

void Attempts::forget_taken_back(Groups& groups, Sea& sea) {
  constexpr std::size_t few = 1 << 12;
  std::size_t all = 0;
  for (const Runner& runner : runners_) all += runner.beside.kicks.all().size();
  if (all < 2 * kicks_kept_ + few) return;
  kicks_kept_ = 0;
  for (const Group& group : groups.all()) kicks_kept_ += kicks_of(group).size();
  if (all < 2 * kicks_kept_ + few) return;
  for (std::uint32_t worker = 0; worker < runners_.size(); ++worker) {
    Beside& beside = runners_[worker].beside;
    Beside kept;
    for (Group& group : groups.all()) {
      Outcome& outcome = group.outcome;
      if (!group.attempted || outcome.worker != worker) continue;
      const std::uint32_t first_kick = outcome.kicks.begin;
      outcome.told = kept.told.add(beside.told, outcome.told);
      outcome.kicks = kept.kicks.add(beside.kicks, outcome.kicks);
      outcome.left = kept.left.add(beside.left, outcome.left);
      outcome.counted_on = kept.counted_on.add(beside.counted_on, outcome.counted_on);
      outcome.turned = kept.turned.add(beside.turned, outcome.turned);
      outcome.claims = {};
      kept.works.push_back(beside.works[outcome.work]);
      outcome.work = static_cast<std::uint32_t>(kept.works.size() - 1);
      for (const std::uint32_t number : groups.members_of(group)) {
        std::uint32_t& kick = sea.places[number].kick;
        if (kick != Sea::none) kick = outcome.kicks.begin + (kick - first_kick);
      }
    }
    beside = std::move(kept);
  }
}

}  // namespace kinesphere
