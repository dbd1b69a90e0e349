#include "speculation/speculative_runner.hpp"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

constexpr std::size_t clusters_at_once = 8;

}  // namespace

SpeculativeRunner::SpeculativeRunner(WorldState& state, EventProcessor& main, PoolLease& lease,
                                     const Probe& probe, ResponseHandler* handler)
    : state_(state),
      main_(main),
      lease_(lease),
      handler_(handler),
      sizer_(lease.is_eager() ? BatchSizer::eager()
                              : BatchSizer(lease.count(), state.bodies.table().live_count())),
      pool_(state, main, lease.count(), probe, handler) {}

bool SpeculativeRunner::run(double until, std::deque<Event>& events) {
  const Bodies& bodies = state_.bodies;
  assert(main_.is_certified());
  // Sleep records and pending changes have effects beyond a cluster; a pair filter is user code that would be
  // called during speculation.
  if (!bodies.sleep_records.empty() || !bodies.changes.empty() || bodies.filters.has_pair_filter())
    return false;
  if (sizer_.skips_epoch()) return false;
  begin_batch(take_due(until, infinity));
  const auto all = [](const Cluster&) { return true; };
  const bool done = is_worthwhile() && execute_all(all);
  if (done) {
    for (const EventInRound* one : commit(all)) events.push_back(one->event);
  } else {
    rollback();
  }
  end_batch();
  sizer_.pause(done);
  if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
  return done;
}

double SpeculativeRunner::take_due(double until, double latest) {
  batch_.begin = main_.time();
  batch_.epoch_end = main_.epoch_end();
  batch_.next_slice = main_.next_slice();
  batch_.until = until;
  due_.clear();
  return main_.queue().take_until(
      until, std::min(main_.pause(), latest), sizer_.most_due(state_.bodies.table().live_count()), due_,
      [certifier = main_.certifier()](const PairCertificate& pair) { return certifier.is_stale(pair); });
}

void SpeculativeRunner::begin_batch(double stop) {
  batch_.stop = stop;
  exclusive_.reset();
  // Certificates due after `stop` were taken for a longer batch.
  const auto later = std::partition_point(
      due_.begin(), due_.end(), [=](const PairCertificate& pair) { return pair.failure_time < stop; });
  std::for_each(later, due_.end(), [this](const PairCertificate& pair) { main_.queue().add(pair); });
  due_.erase(later, due_.end());
  sizer_.begin();
  failure_.reset();
  pool_.clear();
  conflicts_.clear();
  cross_pairs_.clear();
  clusters_.form(due_, state_.bodies, batch_.slots);
  batch_.has_checkpoint.clear();
  // Spare room for bodies added by conflicts, so that the list rarely grows while it has contents.
  if (batch_.checkpoints.size() < clusters_.checkpoint_count())
    batch_.checkpoints = std::vector<BodyCheckpoint>(2 * clusters_.checkpoint_count());
  InitialWork initial;
  for (const std::uint32_t number : main_.dirty().numbers())
    if (state_.bodies[number].dirty) initial.dirty.push_back(number);
  main_.events().pending().for_each([&](const Event& event) { initial.pending.push_back(event); });
  add(initial);
  state_.contacts.start_side_by_side(state_.bodies.sensors.any());
}

void SpeculativeRunner::end_batch() {
  clusters_.clear();
  state_.contacts.stop_side_by_side();
}

/// Returns true if there are enough clusters and none has half of the due pairs or more.
bool SpeculativeRunner::is_worthwhile() const {
  constexpr std::size_t few = 16;
  std::size_t all = 0;
  std::size_t largest = 0;
  for (const Cluster& cluster : clusters_.all()) {
    all += cluster.due.size();
    largest = std::max<std::size_t>(largest, cluster.due.size());
  }
  return clusters_.size() >= few && 2 * largest < all && all >= sizer_.fewest_due();
}

void SpeculativeRunner::merge_bodies(std::span<const std::uint32_t> numbers) {
  Cluster* cluster = nullptr;
  for (const std::uint32_t number : numbers) {
    Cluster* const theirs = cluster_of(number);
    if (theirs == nullptr || theirs == cluster) continue;
    if (cluster != nullptr) merge(*cluster, *theirs);
    cluster = cluster_of(number);
  }
  if (cluster == nullptr) cluster = &clusters_.add();
  for (const std::uint32_t number : numbers)
    if (cluster_of(number) == nullptr) add_member(*cluster, number);
}

void SpeculativeRunner::add(const InitialWork& more) {
  batch_.slots.resize(state_.bodies.numbers());
  const auto cluster_with = [this](std::initializer_list<std::uint32_t> numbers) -> Cluster& {
    merge_bodies(numbers);
    Cluster& cluster = *cluster_of(*numbers.begin());
    rollback(cluster);
    cluster.needs_run = cluster.is_unsent = true;
    return cluster;
  };
  for (const PairCertificate& pair : more.due) {
    Cluster& cluster =
        pair.has_second() ? cluster_with({pair.first, pair.second}) : cluster_with({pair.first});
    clusters_.add_due(cluster, pair);
  }
  for (const std::uint32_t number : more.dirty) cluster_with({number}).dirty.push_back(number);
  for (const Event& event : more.pending)
    cluster_with({state_.bodies.table().number_of(event.first)}).pending.push_back(event);
}

/// Returns false on failure, or when rollbacks exceed 8 times the first-run work; the caller falls back to
/// advance().
bool SpeculativeRunner::execute_found() {
  if (exception_) return false;
  if (sizer_.repeats_too_often()) return false;
  pool_.drop_rolled_back(clusters_, batch_);
  assert(batch_.slots.size() == state_.bodies.numbers());
  batch_.has_checkpoint.resize(clusters_.checkpoint_count(), 0);
  if (batch_.checkpoints.size() < clusters_.checkpoint_count())
    batch_.checkpoints.resize(clusters_.checkpoint_count());
  // Large clusters start first, so that no worker waits for them at the end.
  constexpr std::size_t large = 16;
  std::stable_partition(to_run_.begin(), to_run_.end(),
                        [this](std::uint32_t own) { return clusters_[own].due.size() >= large; });
  for (const std::uint32_t own : to_run_) {
    Cluster& cluster = clusters_[own];
    sizer_.note_run(cluster.due.size(), std::exchange(cluster.has_run, true));
  }
  try {
    lease_.for_each(to_run_.size(), clusters_at_once,
                    [this](std::size_t k, std::size_t) { checkpoint(clusters_[to_run_[k]]); });
    lease_.for_each(to_run_.size(), clusters_at_once, [this](std::size_t k, std::size_t worker) {
      Cluster& cluster = clusters_[to_run_[k]];
      pool_.run(cluster, due_of(cluster), batch_, static_cast<std::uint32_t>(worker));
    });
  } catch (const std::exception& thrown) {
    // A callback that throws again does so when events are processed one by one.
    failure_ = Error{ErrorCode::callback_threw, "callback", no_body, thrown.what()};
    return false;
  } catch (...) {
    failure_ = Error{ErrorCode::callback_threw, "callback", no_body, "something that is no std::exception"};
    return false;
  }
  conflicts_.note_runs(to_run_);
  end_before_exclusive();
  for (const std::uint32_t own : to_run_) {
    if (!clusters_[own].failed) continue;
    // No error exists if the run exceeded the maximum number of updates. Otherwise this is the first error of
    // its worker.
    failure_ = pool_.failure_of(clusters_[own]);
    return false;
  }
  return true;
}

/// Ends the batch before the first instant at which a cluster needs the main processor. Clusters that have
/// done anything at that instant or later are executed again.
void SpeculativeRunner::end_before_exclusive() {
  double first = infinity;
  for (const std::uint32_t own : to_run_) first = std::min(first, clusters_[own].record.stop);
  if (first == infinity) return;
  assert(first == batch_.stop);
  exclusive_ = first;
  for (const Cluster& cluster : clusters_.all())
    if (!cluster.is_merged() && cluster.executed && cluster.record.time >= first) run_again(cluster.index);
}

/// Saves the state of the cluster's bodies at the start of the batch. Other clusters may read it during the
/// run.
void SpeculativeRunner::checkpoint(const Cluster& cluster) {
  for (const std::uint32_t number : clusters_.members_of(cluster)) {
    const std::uint32_t slot = batch_.slots[number].checkpoint;
    if (std::exchange(batch_.has_checkpoint[slot], std::uint8_t{1}) != 0) continue;
    batch_.checkpoints[slot] = {state_.bodies.checkpoint(number),
                                ContactCheckpoint::of(state_.contacts, number)};
    state_.bodies.rigid.keep(state_.bodies[number]);
  }
}

void SpeculativeRunner::rollback() {
  for (Cluster& cluster : clusters()) {
    rollback(cluster);
    if (cluster.is_merged()) continue;
    const std::span<const PairCertificate> due = due_of(cluster);
    deferred_.insert(deferred_.end(), due.begin(), due.end());
  }
  main_.queue().add_all(deferred_);
}

/// Restores the state before the first run of the cluster.
void SpeculativeRunner::rollback(Cluster& cluster) {
  if (!cluster.executed) return;
  for (const std::uint32_t number : members_of(cluster)) {
    if (checkpoint_of(number) == nullptr) continue;
    BatchState::BodySlot& slot = batch_.slots[number];
    BodyCheckpoint& before = batch_.checkpoints[slot.checkpoint];
    state_.bodies.restore(number, before.body);
    state_.bodies.rigid.go_back(state_.bodies[number]);
    before.contacts.restore(state_.contacts, number);
    before.first_change = {};
    slot.update = BatchState::none;
  }
  // Origins are restored in reverse order, so that a body changed several times gets its first origin.
  const std::span<const UndoEntry> undone = undo_log_of(cluster);
  std::for_each(undone.rbegin(), undone.rend(), [this](const UndoEntry& entry) { restore_origin(entry); });
  cluster.executed = false;
}

/// Restores one origin. An exception is stored, so that all other bodies are restored before it is rethrown.
void SpeculativeRunner::restore_origin(const UndoEntry& entry) {
  try {
    handler_->set_origin(entry.first, entry.second);
  } catch (...) {
    if (exception_) return;
    exception_ = std::current_exception();
    failure_ = Error{ErrorCode::callback_threw, "source", no_body, "run: source threw as it went back"};
  }
}

void SpeculativeRunner::add_member(Cluster& cluster, std::uint32_t number) {
  rollback(cluster);
  cluster.needs_run = true;
  clusters_.add_member(cluster, number);
}

/// Rolls two clusters back and merges them. Precondition: neither is merged already. If both arguments are
/// one cluster, it is executed again.
void SpeculativeRunner::merge(Cluster& one, Cluster& other) {
  rollback(one);
  rollback(other);
  one.needs_run = true;
  if (&one != &other) clusters_.merge(one, other);
}

/// Adds conflicting bodies to clusters, and merges a cluster with those that changed bodies of its read set
/// too early. Returns true if clusters must be executed again.
bool SpeculativeRunner::merge_conflicts() {
  bool any = false;
  for (const std::uint32_t own : to_run_) {
    for (const std::uint32_t number : pool_.conflicts_of(clusters_[own])) {
      any = true;
      Cluster* const theirs = cluster_of(number);
      if (theirs != nullptr) {
        merge(clusters_.root_of(own), *theirs);
      } else {
        add_member(clusters_.root_of(own), number);
      }
    }
  }
  return merge_read_sets() || any;
}

bool SpeculativeRunner::merge_read_sets() {
  constexpr std::size_t clusters_at_once = 512;
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> found(lease_.count());
  lease_.for_each(clusters_.size(), clusters_at_once, [&](std::size_t k, std::size_t worker) {
    Cluster& cluster = clusters_.all()[k];
    if (cluster.is_merged()) return;
    cluster.superseded = 0;
    for (const auto& [number, time, is_certified] : read_set_of(cluster)) {
      const BodyCheckpoint* const before = checkpoint_of(number);
      if (before == nullptr) continue;
      // merge_updates() compares the new swept sphere of the body with those of other clusters.
      if (before->first_change.invalidated < time && sizer_.may_decline()) {
        cluster.superseded += is_certified ? 1 : 0;
      } else if (before->first_change.changed <= time) {
        found[worker].emplace_back(cluster.index, number);
      }
    }
  });
  bool any = false;
  for (const auto& some : found) {
    for (const auto& [own, number] : some) {
      Cluster& ours = clusters_.root_of(own);
      Cluster& theirs = *cluster_of(number);
      if (&ours == &theirs) continue;
      merge(ours, theirs);
      any = true;
    }
  }
  return any;
}

/// Returns the certificate of two bodies in their state after these updates.
PairCertificate SpeculativeRunner::certificate_of(const SweptSphereUpdate& update,
                                                  const SweptSphereUpdate& other, double until) const {
  const bool in_order = state_.bodies.table().comes_before(update.number, other.number);
  const auto& [first, second] = in_order ? std::tie(update, other) : std::tie(other, update);
  return {until, first.number, second.number, first.revision, second.revision};
}

/// Merges clusters whose updated bodies may meet. Returns true if clusters must be executed again.
bool SpeculativeRunner::merge_updates() {
  std::vector<ClusterUpdate> updates;
  const std::size_t fresh = conflicts_.take(clusters_, pool_, updates);
  if (fresh == 0) return false;
  bool any = false;
  for (const auto& [a, b, until, is_stale] : find_conflicts(state_, updates, fresh, batch_.begin, lease_)) {
    const auto [own, foreign] =
        updates[a].cluster == BatchState::unassigned ? std::pair(b, a) : std::pair(a, b);
    if (updates[foreign].cluster == BatchState::unassigned) {
      // The body represents its cluster, which another process executes.
      const std::uint32_t number = updates[foreign].update->number;
      if (batch_.slots[number].cluster != updates[own].cluster)
        conflicts_.note_conflict(updates[own].cluster, number);
      continue;
    }
    Cluster& one = clusters_.root_of(updates[a].cluster);
    Cluster& other = clusters_.root_of(updates[b].cluster);
    if (&one == &other) continue;
    // Processes exchange the late certificates of each cluster, but none between two clusters; so distributed
    // worlds merge in any case.
    if (until != Conflict::unknown && !batch_.is_in_batch(until) && sizer_.may_decline()) {
      if (!is_stale)
        cross_pairs_.note(one, other, certificate_of(*updates[a].update, *updates[b].update, until));
      continue;
    }
    merge(one, other);
    any = true;
  }
  return any;
}

void SpeculativeRunner::commit(const Cluster& cluster, bool is_counted,
                               std::vector<const EventInRound*>& committed) {
  if (is_counted) {
    const WorkCounters& work = pool_.work_of(cluster);
    main_.work().counters += work.counters;
    main_.work().recertified += {work.recertified.bodies, work.recertified.near - cluster.superseded};
    main_.work().counters.hot_pairs -= cluster.superseded;
  }
  const std::span<const PairCertificate> left = late_pairs_of(cluster);
  deferred_.insert(deferred_.end(), left.begin(), left.end());
  for (const EventInRound& one : pool_.events_of(cluster)) committed.push_back(&one);
  if (!state_.bodies.shapes.any()) return;
  for (const std::uint32_t number : members_of(cluster))
    batch_.checkpoints[batch_.slots[number].checkpoint].contacts.update_static(state_.contacts, number);
}

void SpeculativeRunner::commit(std::vector<const EventInRound*>& committed) {
  register_updates();
  // The work is counted as if a search had found the pair.
  cross_pairs_.for_each_standing(clusters_, [this](const PairCertificate& pair) {
    main_.work().recertified += {0, 1};
    ++main_.work().counters.hot_pairs;
    deferred_.push_back(pair);
  });
  main_.discard_initial_work();
  main_.queue().add_all(deferred_);
  std::sort(committed.begin(), committed.end(), [](const EventInRound* a, const EventInRound* b) {
    if (a->event.time != b->event.time) return a->event.time < b->event.time;
    if (a->round != b->round) return a->round < b->round;
    // Events of one cause are neighbours in one list.
    return &a->cause() == &b->cause() ? a < b : delivered_before(a->cause().event, b->cause().event);
  });
  // The table hands out freed numbers again, last freed first, so the order counts.
  for (const EventInRound* one : committed) {
    if (one->removes_first) state_.bodies.remove(state_.bodies.table().number_of(one->event.first));
    if (one->removes_second) state_.bodies.remove(state_.bodies.table().number_of(one->event.second));
  }
  main_.advance_clock(std::min<double>(batch_.until, batch_.stop));
  sizer_.adapt(state_.bodies.table().live_count());
}

/// Registers the new swept spheres in the broad phase, and takes out departed bodies. Bodies whose windows
/// end with the batch are included, since queries may come before the next window start if the run is
/// interrupted.
void SpeculativeRunner::register_updates() {
  std::vector<BroadPhase::Arrival> arrivals;
  std::vector<const SweptSphereUpdate*> updates;
  for (const Cluster& cluster : clusters_.all()) {
    if (cluster.is_merged()) continue;
    std::uint32_t slot = cluster.record.updates.begin;
    for (const SweptSphereUpdate& update : updates_of(cluster)) {
      if (batch_.slots[update.number].update != slot++) continue;
      if (update.is_departure()) {
        if (state_.broad_phase.contains(update.number)) state_.broad_phase.leave(update.number);
        continue;
      }
      arrivals.push_back({update.number, update.time, update.window});
      updates.push_back(&update);
    }
  }
  state_.broad_phase.enter_all(
      arrivals,
      [&](std::size_t k) {
        const SweptSphereUpdate& update = *updates[k];
        return margin_for(state_.bodies, update.number, BoundAt(update.bound, update.time));
      },
      lease_);
  state_.broad_phase.tidy(lease_);
}

}  // namespace kinesphere
