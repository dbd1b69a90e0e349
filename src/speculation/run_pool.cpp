#include "speculation/run_pool.hpp"

#include <utility>

namespace kinesphere {

RunPool::RunPool(WorldState& state, const EventProcessor& main, std::size_t workers, const Probe& probe,
                 ResponseHandler* handler)
    : state_(state), handler_(handler) {
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
  return worker.log.end(number, worker.processor.work(), worker.processor.time());
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
    for (;;) {
      const bool has_cause = processor.events().has_ends();
      const std::optional<Event> event = processor.pop();
      if (!event) break;
      log.events.add({round, *event, has_cause ? log.events.all().back().after_cause + 1 : 0});
      if (handler_ != nullptr) {
        if (auto answered = respond(worker, *event); !answered) return answered;
      }
      if (!log.conflicts.empty() || log.stop < infinity) return {};
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
  if (changes_more_than_clusters(event, *answer)) {
    worker.log.stop = event.time;
    worker.log.batch->stop.lower_to(event.time);
    return {};
  }
  const auto parts = parts_of(event, *answer);
  for (const BodyResponse& part : parts)
    if (part.velocity) worker.log.undo_log.add({part.body, handler_->origin(part.body)});
  if (auto applied = handler_->apply(event, *answer); !applied) return applied;
  for (const BodyResponse& part : parts)
    if (part.velocity) worker.processor.set_velocity(part.body, *part.velocity);
  for (const BodyResponse& part : parts) {
    if (!part.angular_velocity) continue;
    const std::uint32_t number = state_.bodies.table().number_of(part.body);
    worker.processor.set_angular_velocity(number, *part.angular_velocity);
  }
  EventInRound& delivered = worker.log.events.all().back();
  delivered.removes_first = act(worker, parts[0]);
  delivered.removes_second = act(worker, parts[1]);
  return {};
}

/// Returns true if the response concerns more than the bodies of a cluster and what is theirs alone: the
/// whole world, a static body, or the table of changes, in which the new velocities of a body wait that has
/// no fresh report.
bool RunPool::changes_more_than_clusters(const Event& event, const Response& answer) const {
  const auto is_more = [&](const BodyResponse& part) {
    const bool is_turned = part.velocity || part.angular_velocity;
    if (!is_turned && part.action == BodyAction::none) return false;
    const Body& body = state_.bodies[state_.bodies.table().number_of(part.body)];
    return part.action == BodyAction::sleep || body.is_static() || (is_turned && !body.fresh(event.time));
  };
  const auto parts = parts_of(event, answer);
  return answer.stop || is_more(parts[0]) || is_more(parts[1]);
}

/// Removes or disables the body in its cluster. What all clusters share is left to the commit: its number in
/// the table, and its place in the broad phase. Returns true if the body is removed.
bool RunPool::act(Worker& worker, const BodyResponse& part) {
  if (part.action == BodyAction::none) return false;
  const std::uint32_t number = state_.bodies.table().number_of(part.body);
  worker.processor.detach(number);
  if (!worker.log.conflicts.empty()) return false;
  const bool is_removed = part.action == BodyAction::remove;
  (is_removed ? state_.bodies[number].alive : state_.bodies[number].enabled) = false;
  return is_removed;
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
    SpeculationLog compacted;
    for (Cluster& cluster : clusters.all()) {
      RunRecord& record = cluster.record;
      if (!cluster.executed || record.worker != worker) continue;
      const std::uint32_t first_update = record.updates.begin;
      record.events = compacted.events.add(log.events, record.events);
      record.updates = compacted.updates.add(log.updates, record.updates);
      record.late_pairs = compacted.late_pairs.add(log.late_pairs, record.late_pairs);
      record.read_set = compacted.read_set.add(log.read_set, record.read_set);
      record.undo_log = compacted.undo_log.add(log.undo_log, record.undo_log);
      record.conflicts = {};
      compacted.work.push_back(log.work[record.work]);
      record.work = static_cast<std::uint32_t>(compacted.work.size() - 1);
      for (const std::uint32_t number : clusters.members_of(cluster)) {
        std::uint32_t& update = batch.slots[number].update;
        if (update != BatchState::none) update = record.updates.begin + (update - first_update);
      }
    }
    log = std::move(compacted);
  }
}

}  // namespace kinesphere
