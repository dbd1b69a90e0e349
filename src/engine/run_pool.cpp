#include "engine/run_pool.hpp"

#include <utility>

namespace kinesphere {

RunPool::RunPool(WorldState& state, const EventProcessor& main, std::size_t workers, const Probe& probe,
                 ResponseHandler* handler)
    : handler_(handler) {
  for (std::size_t worker = 0; worker < workers; ++worker) {
    EventProcessor& processor = workers_.emplace_back(Worker{EventProcessor(state, main.time())}).processor;
    processor.queue().order_by(main.queue().order());
    processor.reports().ask(probe, "run");
  }
}

void RunPool::clear() {
  updates_left_ = 0;
  for (Worker& worker : workers_) worker.log.clear();
}

void RunPool::run(Cluster& cluster, std::span<const PairCertificate> due, BatchState& batch,
                  std::uint32_t worker) {
  auto& [processor, log] = workers_[worker];
  cluster.needs_run = false;
  cluster.executed = cluster.is_unsent = true;
  ++cluster.runs;
  cluster.updates_are_checked = false;
  cluster.failed = true;
  log.begin(batch, cluster.index);
  processor.begin(log, due, cluster.dirty, cluster.pending);
  try {
    const auto advanced = advance(workers_[worker]);
    cluster.failed = !advanced || log.is_full();
    if (!advanced && !log.failure) log.failure = advanced.error();
  } catch (...) {
    cluster.record = end(workers_[worker], worker);
    throw;
  }
  cluster.record = end(workers_[worker], worker);
}

RunRecord RunPool::end(Worker& worker, std::uint32_t number) {
  worker.processor.certifier().for_each_certificate(
      worker.processor.queue(), [&](const PairCertificate& pair) { worker.log.late_pairs.add(pair); });
  return worker.log.end(number, worker.processor.work());
}

/// Advances the cluster as World::Engine::advance() does, except that no windows start. Only recertifies
/// dirty bodies if the batch has no duration.
Result<void> RunPool::advance(Worker& worker) {
  auto& [processor, log] = worker;
  if (!log.batch->is_in_batch(processor.time())) return processor.recertify();
  std::uint32_t round = 0;
  for (;;) {
    if (processor.is_gathering()) {
      if (auto gathered = processor.gather(processor.time()); !gathered) return gathered;
    }
    while (const std::optional<Event> event = processor.pop()) {
      log.events.add({round, *event});
      if (handler_ != nullptr) {
        if (auto answered = respond(worker, *event); !answered) return answered;
      }
      if (!log.conflicts.empty()) return {};
    }
    if (auto recertified = processor.recertify(); !recertified) return recertified;
    if (!log.conflicts.empty() || log.is_full()) return {};
    ++round;
    if (!processor.events().pending().empty()) continue;
    const double next = processor.next_time();
    if (!log.batch->is_in_batch(next)) return {};
    if (next > processor.time()) round = 0;
    processor.begin_instant(next);
  }
}

Result<void> RunPool::respond(Worker& worker, const Event& event) {
  const auto answer = handler_->respond(event);
  if (!answer) return answer.error();
  const auto note = [&](BodyId body, const std::optional<Vec3>& velocity) {
    if (velocity) worker.log.undo_log.add({body, handler_->origin(body)});
  };
  note(event.first, answer->first_velocity);
  note(event.second, answer->second_velocity);
  if (auto applied = handler_->apply(event, *answer); !applied) return applied;
  if (answer->first_velocity) worker.processor.set_velocity(event.first, *answer->first_velocity);
  if (answer->second_velocity) worker.processor.set_velocity(event.second, *answer->second_velocity);
  return {};
}

void RunPool::drop_rolled_back(Clusters& clusters, BatchState& batch) {
  constexpr std::size_t few = 1 << 12;
  std::size_t all = 0;
  for (const Worker& worker : workers_) all += worker.log.updates.all().size();
  if (all < 2 * updates_left_ + few) return;
  updates_left_ = 0;
  for (const Cluster& cluster : clusters.all()) updates_left_ += updates_of(cluster).size();
  if (all < 2 * updates_left_ + few) return;
  for (std::uint32_t worker = 0; worker < workers_.size(); ++worker) {
    SpeculationLog& log = workers_[worker].log;
    SpeculationLog checkpoint;
    for (Cluster& cluster : clusters.all()) {
      RunRecord& record = cluster.record;
      if (!cluster.executed || record.worker != worker) continue;
      const std::uint32_t first_update = record.updates.begin;
      record.events = checkpoint.events.add(log.events, record.events);
      record.updates = checkpoint.updates.add(log.updates, record.updates);
      record.late_pairs = checkpoint.late_pairs.add(log.late_pairs, record.late_pairs);
      record.read_set = checkpoint.read_set.add(log.read_set, record.read_set);
      record.undo_log = checkpoint.undo_log.add(log.undo_log, record.undo_log);
      record.conflicts = {};
      checkpoint.work.push_back(log.work[record.work]);
      record.work = static_cast<std::uint32_t>(checkpoint.work.size() - 1);
      for (const std::uint32_t number : clusters.members_of(cluster)) {
        std::uint32_t& update = batch.slots[number].update;
        if (update != BatchState::none) update = record.updates.begin + (update - first_update);
      }
    }
    log = std::move(checkpoint);
  }
}

}  // namespace kinesphere
