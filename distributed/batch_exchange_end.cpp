// The end of a batch: BatchExchange commits events and renews ghosts.
#include <algorithm>

#include "distributed/batch_exchange.hpp"
#include "distributed/guarded.hpp"

namespace kinesphere {

std::vector<OrderedEvent> BatchExchange::finish() {
  add_costs();
  const BodyTable& table = rank_.bodies().table();
  // If several ranks own members, the owner of the first member counts the work.
  const auto is_counted = [&](const Cluster& cluster) {
    const auto members = runner_.members_of(cluster);
    return is_own(*std::min_element(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) {
      return table.comes_before(a, b);
    }));
  };
  std::vector<OrderedEvent> events;
  for (const EventInRound* committed : runner_.commit(is_counted)) {
    Event event = committed->event;
    if (!is_own(table.number_of(event.first))) continue;
    event.first.world = event.second.world = 0;
    events.push_back({event, committed->round});
  }
  return events;
}

/// Distributes the cost of each executed cluster equally over its members.
void BatchExchange::add_costs() {
  for (const Cluster& cluster : runner_.clusters()) {
    if (cluster.is_merged() || !cluster.executed) continue;
    const float cost =
        static_cast<float>(1 + cluster.due.size()) / static_cast<float>(cluster.members.size());
    for (const std::uint32_t number : runner_.members_of(cluster)) rank_.directory[number].cost += cost;
  }
}

Result<void> BatchExchange::renew_ghosts() {
  if (communicator_.ranks() == 1) return {};
  SendBuffers buffers(communicator_.ranks());
  consensus_.note(guarded([&] {
    for (const Cluster& cluster : runner_.clusters())
      if (!cluster.is_merged() && cluster.executed) renew_ghosts(cluster, buffers);
  }));
  const auto renewed = migration_.exchange(communicator_, consensus_, buffers, &runner_);
  return renewed ? Result<void>() : renewed.error();
}

/// Writes to the outbox the cluster's own bodies whose ghosts on other ranks are outdated, and ghosts for
/// ranks whose halo region an updated swept sphere meets.
void BatchExchange::renew_ghosts(const Cluster& cluster, SendBuffers& buffers) {
  const std::vector<std::uint32_t> updated = own_updated(cluster);
  for (const std::uint32_t number : updated)
    for (const int to : known_.ranks_that_meet(rank_.box_of(number))) rank_.directory.add_holder(number, to);
  std::optional<std::vector<int>> owners;
  for (const std::uint32_t number : runner_.members_of(cluster)) {
    if (!is_own(number) || rank_.directory[number].holders.empty()) continue;
    const bool is_updated = std::binary_search(updated.begin(), updated.end(), number);
    // The window ends now, so its ghosts are dropped at the next window start.
    if (!is_updated && rank_.state.broad_phase.end_of(number) <= rank_.time()) continue;
    if (!owners) owners = owners_of(cluster);
    std::optional<BodyMessage> message;
    for (const int to : rank_.directory[number].holders) {
      if (std::binary_search(owners->begin(), owners->end(), to)) continue;
      if (!message) message = pack_changed(number, is_updated, cluster);
      buffers.add(to, *message);
    }
  }
}

/// Returns the numbers of own bodies with swept-sphere updates in the cluster, unique and in ascending order.
std::vector<std::uint32_t> BatchExchange::own_updated(const Cluster& cluster) const {
  std::vector<std::uint32_t> updated;
  for (const SweptSphereUpdate& update : runner_.updates_of(cluster))
    if (is_own(update.number)) updated.push_back(update.number);
  std::sort(updated.begin(), updated.end());
  updated.erase(std::unique(updated.begin(), updated.end()), updated.end());
  return updated;
}

/// Packs the body with the certificates that the cluster has left for later.
BodyMessage BatchExchange::pack_changed(std::uint32_t number, bool is_updated, const Cluster& cluster) const {
  BodyMessage message = migration_.pack(number);
  message.enters = is_updated;
  message.is_stale = runner_.checkpoint_of(number)->body.body.revision != rank_.bodies()[number].revision;
  migration_.add_late_pairs(message, number, cluster, runner_);
  return message;
}

}  // namespace kinesphere
