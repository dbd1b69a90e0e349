// What came of the islands of a part of a phase: events, and copies that are renewed.
#include <algorithm>

#include "distributed/guarded.hpp"
#include "distributed/phase_part.hpp"

namespace kinesphere {

std::vector<OrderedEvent> PhasePart::finish() {
  add_costs();
  const BodyTable& table = local_.bodies().table();
  // Of several owners, the one of the first body counts the work.
  const auto is_counted = [&](const Group& group) {
    const auto members = islands_.members_of(group);
    return is_own(*std::min_element(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) {
      return table.comes_before(a, b);
    }));
  };
  std::vector<OrderedEvent> events;
  for (const Told* told : islands_.finish(is_counted)) {
    Event event = told->event;
    if (!is_own(table.number_of(event.first))) continue;
    event.first.world = event.second.world = 0;
    events.push_back({event, told->round});
  }
  return events;
}

/// An island costs each of its bodies the same.
void PhasePart::add_costs() {
  for (const Group& group : islands_.groups()) {
    if (group.joined() || !group.attempted) continue;
    const float cost = static_cast<float>(1 + group.due.size()) / static_cast<float>(group.members.size());
    for (const std::uint32_t number : islands_.members_of(group)) local_.roster[number].cost += cost;
  }
}

Result<void> PhasePart::renew_copies() {
  if (communicator_.ranks() == 1) return {};
  Outbox outbox(communicator_.ranks());
  agreement_.note(guarded([&] {
    for (const Group& group : islands_.groups())
      if (!group.joined() && group.attempted) renew_copies(group, outbox);
  }));
  const auto renewed = transit_.exchange(communicator_, agreement_, outbox);
  return renewed ? Result<void>() : renewed.error();
}

/// Of own bodies of the island.
void PhasePart::renew_copies(const Group& group, Outbox& outbox) {
  const std::vector<std::uint32_t> kicked = own_kicked(group);
  for (const std::uint32_t number : kicked)
    for (const int to : known_.ranks_that_meet(local_.box_of(number))) local_.roster.add_holder(number, to);
  std::optional<std::vector<int>> owners;
  for (const std::uint32_t number : islands_.members_of(group)) {
    if (!is_own(number) || local_.roster[number].holders.empty()) continue;
    const bool is_kicked = std::binary_search(kicked.begin(), kicked.end(), number);
    // Its copies are dropped in any case.
    if (!is_kicked && local_.tables.windows.end_of(number) <= local_.time()) continue;
    if (!owners) owners = owners_of(group);
    std::optional<Parcel> parcel;
    for (const int to : local_.roster[number].holders) {
      if (std::binary_search(owners->begin(), owners->end(), to)) continue;
      if (!parcel) parcel = pack_changed(number, is_kicked, group);
      outbox.add(to, *parcel);
    }
  }
}

/// In ascending order.
std::vector<std::uint32_t> PhasePart::own_kicked(const Group& group) const {
  std::vector<std::uint32_t> kicked;
  for (const BodyKick& kick : islands_.kicks_of(group))
    if (is_own(kick.number)) kicked.push_back(kick.number);
  std::sort(kicked.begin(), kicked.end());
  kicked.erase(std::unique(kicked.begin(), kicked.end()), kicked.end());
  return kicked;
}

/// The body with the hot pairs that the island has left.
Parcel PhasePart::pack_changed(std::uint32_t number, bool is_kicked, const Group& group) const {
  Parcel parcel = transit_.pack(number);
  parcel.enters = is_kicked;
  parcel.is_void = islands_.kept(number)->body.body.stamp != local_.bodies()[number].stamp;
  transit_.add_due(parcel, number, islands_.left_of(group));
  return parcel;
}

}  // namespace kinesphere
