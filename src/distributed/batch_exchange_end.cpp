// The end of a batch: BatchExchange commits events and renews ghosts.
#include <algorithm>

#include "distributed/batch_exchange.hpp"
#include "distributed/guarded.hpp"

namespace kinesphere {

std::vector<OrderedEvent> BatchExchange::finish() {
  add_costs();
  const BodyTable& table = local_.bodies().table();
  // If several ranks own members, the owner of the first member counts the work.
  const auto is_counted = [&](const Cluster& group) {
    const auto members = runner_.members_of(group);
    return is_own(*std::min_element(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) {
      return table.comes_before(a, b);
    }));
  };
  std::vector<OrderedEvent> events;
  for (const EventInRound* told : runner_.commit(is_counted)) {
    Event event = told->event;
    if (!is_own(table.number_of(event.first))) continue;
    event.first.world = event.second.world = 0;
    events.push_back({event, told->round});
  }
  return events;
}

/// Distributes the cost of each executed cluster equally over its members.
void BatchExchange::add_costs() {
  for (const Cluster& group : runner_.clusters()) {
    if (group.is_merged() || !group.executed) continue;
    const float cost = static_cast<float>(1 + group.due.size()) / static_cast<float>(group.members.size());
    for (const std::uint32_t number : runner_.members_of(group)) local_.directory[number].cost += cost;
  }
}

Result<void> BatchExchange::renew_ghosts() {
  if (communicator_.ranks() == 1) return {};
  SendBuffers outbox(communicator_.ranks());
  agreement_.note(guarded([&] {
    for (const Cluster& group : runner_.clusters())
      if (!group.is_merged() && group.executed) renew_ghosts(group, outbox);
  }));
  const auto renewed = transit_.exchange(communicator_, agreement_, outbox);
  return renewed ? Result<void>() : renewed.error();
}

/// Writes to the outbox the cluster's own bodies whose ghosts on other ranks are outdated, and ghosts for
/// ranks whose halo region an updated swept sphere meets.
void BatchExchange::renew_ghosts(const Cluster& group, SendBuffers& outbox) {
  const std::vector<std::uint32_t> kicked = own_updated(group);
  for (const std::uint32_t number : kicked)
    for (const int to : known_.ranks_that_meet(local_.box_of(number)))
      local_.directory.add_holder(number, to);
  std::optional<std::vector<int>> owners;
  for (const std::uint32_t number : runner_.members_of(group)) {
    if (!is_own(number) || local_.directory[number].holders.empty()) continue;
    const bool is_kicked = std::binary_search(kicked.begin(), kicked.end(), number);
    // The window ends now, so its ghosts are dropped at the next window start.
    if (!is_kicked && local_.state.broad_phase.end_of(number) <= local_.time()) continue;
    if (!owners) owners = owners_of(group);
    std::optional<BodyMessage> message;
    for (const int to : local_.directory[number].holders) {
      if (std::binary_search(owners->begin(), owners->end(), to)) continue;
      if (!message) message = pack_changed(number, is_kicked, group);
      outbox.add(to, *message);
    }
  }
}

/// Returns the numbers of own bodies with swept-sphere updates in the cluster, unique and in ascending order.
std::vector<std::uint32_t> BatchExchange::own_updated(const Cluster& group) const {
  std::vector<std::uint32_t> kicked;
  for (const SweptSphereUpdate& update : runner_.updates_of(group))
    if (is_own(update.number)) kicked.push_back(update.number);
  std::sort(kicked.begin(), kicked.end());
  kicked.erase(std::unique(kicked.begin(), kicked.end()), kicked.end());
  return kicked;
}

/// Packs the body with the certificates that the cluster has left for later.
BodyMessage BatchExchange::pack_changed(std::uint32_t number, bool is_kicked, const Cluster& group) const {
  BodyMessage message = transit_.pack(number);
  message.enters = is_kicked;
  message.is_void = runner_.checkpoint_of(number)->body.body.revision != local_.bodies()[number].revision;
  transit_.add_due(message, number, runner_.late_pairs_of(group));
  return message;
}

}  // namespace kinesphere
