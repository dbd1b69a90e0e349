#include "engine/run_pool.hpp"

#include <utility>

namespace kinesphere {

RunPool::RunPool(WorldState& tables, const EventProcessor& main, std::size_t workers, const Probe& probe,
                 ResponseHandler* handler)
    : handler_(handler) {
  for (std::size_t worker = 0; worker < workers; ++worker) {
    EventProcessor& island = workers_.emplace_back(Worker{EventProcessor(tables, main.time())}).processor;
    island.queue().order_by(main.queue().order());
    island.reports().ask(probe, "run");
  }
}

void RunPool::clear() {
  updates_kept_ = 0;
  for (Worker& runner : workers_) runner.log.clear();
}

void RunPool::run(Cluster& group, std::span<const PairCertificate> due, BatchState& batch,
                  std::uint32_t worker) {
  auto& [island, beside] = workers_[worker];
  group.needs_run = false;
  group.executed = group.is_unsent = true;
  ++group.runs;
  group.updates_are_checked = false;
  group.failed = true;
  beside.begin(batch, group.index);
  island.begin(beside, due, group.dirty, group.pending);
  try {
    const auto gone = advance(workers_[worker]);
    group.failed = !gone || beside.is_full();
    if (!gone && !beside.failure) beside.failure = gone.error();
  } catch (...) {
    group.record = end(workers_[worker], worker);
    throw;
  }
  group.record = end(workers_[worker], worker);
}

RunRecord RunPool::end(Worker& runner, std::uint32_t worker) {
  runner.processor.certifier().for_each_certificate(
      runner.processor.queue(), [&](const PairCertificate& pair) { runner.log.late_pairs.add(pair); });
  return runner.log.end(worker, runner.processor.work());
}

/// Advances the cluster as World::Engine::advance() does, except that no windows start. Only recertifies
/// dirty bodies if the batch has no duration.
Result<void> RunPool::advance(Worker& runner) {
  auto& [island, beside] = runner;
  if (!beside.batch->is_in_batch(island.time())) return island.recertify();
  std::uint32_t round = 0;
  for (;;) {
    if (island.is_gathering()) {
      if (auto gathered = island.gather(); !gathered) return gathered;
    }
    while (const std::optional<Event> event = island.pop()) {
      beside.events.add({round, *event});
      if (handler_ != nullptr) {
        if (auto answered = respond(runner, *event); !answered) return answered;
      }
      if (!beside.conflicts.empty()) return {};
    }
    if (auto settled = island.recertify(); !settled) return settled;
    if (!beside.conflicts.empty() || beside.is_full()) return {};
    ++round;
    if (!island.events().pending().empty()) continue;
    const double next = island.next_time();
    if (!beside.batch->is_in_batch(next)) return {};
    if (next > island.time()) round = 0;
    island.begin_instant(next);
  }
}

Result<void> RunPool::respond(Worker& runner, const Event& event) {
  const auto answer = handler_->respond(event);
  if (!answer) return answer.error();
  const auto note = [&](BodyId body, const std::optional<Vec3>& velocity) {
    if (velocity) runner.log.undo_log.add({body, handler_->origin(body)});
  };
  note(event.first, answer->first_velocity);
  note(event.second, answer->second_velocity);
  if (auto turned = handler_->apply(event, *answer); !turned) return turned;
  if (answer->first_velocity) runner.processor.set_velocity(event.first, *answer->first_velocity);
  if (answer->second_velocity) runner.processor.set_velocity(event.second, *answer->second_velocity);
  return {};
}

void RunPool::drop_rolled_back(Clusters& groups, BatchState& batch) {
  constexpr std::size_t few = 1 << 12;
  std::size_t all = 0;
  for (const Worker& runner : workers_) all += runner.log.updates.all().size();
  if (all < 2 * updates_kept_ + few) return;
  updates_kept_ = 0;
  for (const Cluster& group : groups.all()) updates_kept_ += updates_of(group).size();
  if (all < 2 * updates_kept_ + few) return;
  for (std::uint32_t worker = 0; worker < workers_.size(); ++worker) {
    SpeculationLog& log = workers_[worker].log;
    SpeculationLog checkpoint;
    for (Cluster& group : groups.all()) {
      RunRecord& outcome = group.record;
      if (!group.executed || outcome.worker != worker) continue;
      const std::uint32_t first_kick = outcome.updates.begin;
      outcome.events = checkpoint.events.add(log.events, outcome.events);
      outcome.updates = checkpoint.updates.add(log.updates, outcome.updates);
      outcome.late_pairs = checkpoint.late_pairs.add(log.late_pairs, outcome.late_pairs);
      outcome.read_set = checkpoint.read_set.add(log.read_set, outcome.read_set);
      outcome.undo_log = checkpoint.undo_log.add(log.undo_log, outcome.undo_log);
      outcome.conflicts = {};
      checkpoint.work.push_back(log.work[outcome.work]);
      outcome.work = static_cast<std::uint32_t>(checkpoint.work.size() - 1);
      for (const std::uint32_t number : groups.members_of(group)) {
        std::uint32_t& update = batch.slots[number].update;
        if (update != BatchState::none) update = outcome.updates.begin + (update - first_kick);
      }
    }
    log = std::move(checkpoint);
  }
}

}  // namespace kinesphere
