#include "distributed/batch_exchange.hpp"

#include <algorithm>
#include <utility>

#include "distributed/guarded.hpp"

namespace kinesphere {
namespace {

enum class Standing : std::uint8_t { content, has_news, has_failed };

}  // namespace

BatchExchange::BatchExchange(Communicator& communicator, ErrorConsensus& consensus, RankState& rank_state,
                             Migration& migration, HaloRegions& known, SpeculativeRunner& runner)
    : communicator_(communicator),
      consensus_(consensus),
      rank_(rank_state),
      migration_(migration),
      known_(known),
      runner_(runner),
      round_(communicator.ranks()) {}

Result<void> BatchExchange::run() {
  for (;;) {
    join_requested();
    if (!consensus_.has_noted() &&
        !runner_.execute_all([this](const Cluster& cluster) { return is_ready(cluster); }))
      consensus_.note(*runner_.failure());
    const auto shared = share();
    if (!shared) return shared.error();
    if (!*shared) return {};
  }
}

bool BatchExchange::is_ours(const Cluster& cluster) const {
  const auto members = runner_.members_of(cluster);
  return std::any_of(members.begin(), members.end(), [this](std::uint32_t number) { return is_own(number); });
}

/// True if the cluster has an own member and this rank knows all pairs of its members: each registered ghost
/// in it has its swept sphere within this rank's halo region.
bool BatchExchange::is_ready(const Cluster& cluster) const {
  const auto members = runner_.members_of(cluster);
  return is_ours(cluster) && std::all_of(members.begin(), members.end(), [this](std::uint32_t number) {
           return is_own(number) || !rank_.state.broad_phase.contains(number) ||
                  known_.covers(rank_.box_of(number));
         });
}

/// Returns the ranks that own members of the cluster, in ascending order.
std::vector<int> BatchExchange::owners_of(const Cluster& cluster) const {
  std::vector<int> owners;
  for (const std::uint32_t number : runner_.members_of(cluster)) {
    const int owner = rank_.directory[number].owner;
    if (std::find(owners.begin(), owners.end(), owner) == owners.end()) owners.push_back(owner);
  }
  std::sort(owners.begin(), owners.end());
  return owners;
}

/// Exchanges one round of news about clusters with all ranks. Returns false if no rank has news. Errors: the
/// first error that a rank has noted.
Result<bool> BatchExchange::share() {
  if (!consensus_.has_noted() && communicator_.ranks() > 1) note_news();
  const Standing standing = consensus_.has_noted() ? Standing::has_failed
                            : round_.is_empty()    ? Standing::content
                                                   : Standing::has_news;
  ByteWriter writer;
  writer(standing, round_.asks);
  std::vector<std::vector<Box>> asked;
  bool any = false;
  bool failed = false;
  for (const Communicator::Bytes& bytes : communicator_.gather(writer.bytes())) {
    Standing theirs{};
    ByteReader reader(bytes);
    reader(theirs, asked.emplace_back());
    any = any || theirs == Standing::has_news;
    failed = failed || theirs == Standing::has_failed;
  }
  if (failed) return consensus_.agree_on_noted().error();
  if (!any) return false;
  ++rounds_;
  SendBuffers buffers(communicator_.ranks());
  for (int rank = 0; rank < communicator_.ranks(); ++rank) {
    if (rank == communicator_.rank()) continue;
    const std::vector<Box>& boxes = asked[static_cast<std::size_t>(rank)];
    for (const Box& box : boxes) known_[rank].add(box);
    for (const std::uint32_t number : rank_.own_bodies_in(boxes)) send(number, rank);
    consensus_.note(guarded([&] { send_to(rank, buffers); }));
  }
  round_ = Round(communicator_.ranks());
  take_in(buffers.exchange(communicator_));
  // Bodies that arrived with requested boxes may interact with the clusters that requested them.
  for (const std::uint32_t own : std::exchange(asking_, {}))
    if (!runner_.clusters()[own].is_merged()) runner_.run_again(own);
  return true;
}

/// Writes this round's message for `rank` to the outbox, with the bodies that it sends there.
void BatchExchange::send_to(int rank, SendBuffers& buffers) {
  auto& [message, bodies] = round_.to(rank);
  for (const std::uint32_t number : bodies) {
    message.bodies.push_back(migration_.pack_checkpoint(number, runner_));
    message.bodies.back().enters = true;
  }
  migration_.add_due(message.bodies, bodies, &runner_);
  if (!message.is_empty()) buffers.add(rank, message);
}

void BatchExchange::take_in(const std::vector<Communicator::Bytes>& incoming) {
  std::vector<RoundMessage> messages(incoming.size());
  std::vector<BodyMessage> received;
  for (std::size_t from = 0; from < incoming.size(); ++from) {
    if (incoming[from].empty()) continue;
    RoundMessage& message = messages[from];
    ByteReader reader(incoming[from]);
    reader(message);
    std::move(message.bodies.begin(), message.bodies.end(), std::back_inserter(received));
    std::move(message.lists.begin(), message.lists.end(), std::back_inserter(lists_));
  }
  std::optional<InitialWork> beginning;
  consensus_.note(guarded([&]() -> Result<void> {
    auto installed = migration_.install(received, &runner_);
    if (!installed) return installed.error();
    beginning = std::move(*installed);
    return {};
  }));
  if (!beginning) return;
  rank_.state.contacts.start_side_by_side(rank_.bodies().sensors.any());
  const auto later =
      std::partition(beginning->due.begin(), beginning->due.end(),
                     [this](const PairCertificate& pair) { return runner_.is_in_batch(pair.failure_time); });
  std::for_each(later, beginning->due.end(),
                [this](const PairCertificate& pair) { rank_.main.queue().add(pair); });
  beginning->due.erase(later, beginning->due.end());
  runner_.add(*beginning);
  for (std::size_t from = 0; from < messages.size(); ++from) {
    for (const std::uint32_t name : messages[from].wanted)
      if (const auto number = rank_.directory.find(name)) send(*number, static_cast<int>(from));
    for (auto& [name, foreign] : messages[from].updates) {
      const auto number = rank_.directory.find(name);
      if (!number) continue;
      foreign.number = *number;
      runner_.add_foreign_update(foreign);
    }
  }
}

/// Merges the clusters in received lists as soon as this rank holds all of their bodies.
void BatchExchange::join_requested() {
  std::erase_if(lists_, [this](JoinList& list) { return join_requested(list); });
}

/// Merges the bodies of one list. Returns false if the list has to wait for bodies to arrive or to join a
/// cluster.
bool BatchExchange::join_requested(JoinList& list) {
  std::vector<std::uint32_t> numbers;
  for (const JoinList::Member& member : list.together) {
    if (const auto number = rank_.directory.find(member.name)) {
      numbers.push_back(*number);
    } else {
      ask_for(member);
    }
  }
  if (numbers.size() < list.together.size()) return false;
  runner_.merge_bodies(numbers);
  std::erase_if(list.read_set, [&](std::uint32_t name) {
    const auto number = rank_.directory.find(name);
    if (!number || !is_own(*number)) return true;
    if (runner_.cluster_of(*number) == nullptr) return false;
    numbers.push_back(*number);
    runner_.merge_bodies(numbers);
    return true;
  });
  return list.read_set.empty();
}

/// Requests a body that this rank does not hold: a registered one by its box, others by name.
void BatchExchange::ask_for(const JoinList::Member& member) {
  if (member.is_registered) {
    ask_for(member.box);
  } else {
    round_.to(member.owner).message.wanted.push_back(member.name);
  }
}

/// Adds the box to the halo region and requests its bodies. Returns false if the halo region covers it
/// already.
bool BatchExchange::ask_for(const Box& box) {
  const bool is_new = known_.cover(box);
  if (is_new) round_.asks.push_back(box);
  return is_new;
}

/// Schedules a ghost of an own body for rank `to`, unless that rank holds one.
void BatchExchange::send(std::uint32_t number, int to) {
  if (rank_.directory.add_holder(number, to)) round_.to(to).bodies.push_back(number);
}

void BatchExchange::note_news() {
  for (Cluster& cluster : runner_.clusters()) {
    if (cluster.is_merged() || !cluster.is_unsent || !is_ours(cluster)) continue;
    cluster.is_unsent = false;
    note_space(cluster);
    note_list(cluster, std::nullopt);
    note_updates(cluster);
  }
  for (const auto& [own, number] : runner_.take_conflicts()) {
    const Cluster& cluster = runner_.clusters()[own];
    if (!cluster.is_merged()) note_list(cluster, number);
  }
}

/// Requests the boxes that the swept spheres of the cluster's ghosts and of its updates need.
void BatchExchange::note_space(const Cluster& cluster) {
  bool any = false;
  for (const std::uint32_t number : runner_.members_of(cluster))
    if (!is_own(number) && rank_.state.broad_phase.contains(number))
      any = ask_for(rank_.box_of(number)) || any;
  for (const SweptSphereUpdate& update : runner_.updates_of(cluster))
    any = ask_for(rank_.box_of(update)) || any;
  if (any) asking_.push_back(cluster.index);
}

/// Sends the cluster's list to the owners of its members and of its read set; if `met` is given, only to the
/// owner of `met`, which the cluster has to merge with.
void BatchExchange::note_list(const Cluster& cluster, std::optional<std::uint32_t> met) {
  std::vector<int> owners;
  const auto note = [&](std::uint32_t number) {
    const int owner = rank_.directory[number].owner;
    if (owner != communicator_.rank() && std::find(owners.begin(), owners.end(), owner) == owners.end())
      owners.push_back(owner);
  };
  if (met) {
    note(*met);
  } else {
    for (const std::uint32_t number : runner_.members_of(cluster)) note(number);
    for (const ReadEntry& entry : runner_.read_set_of(cluster)) note(entry.number);
  }
  if (owners.empty()) return;
  JoinList list;
  const auto add = [&](std::uint32_t number) {
    const bool is_registered = rank_.state.broad_phase.contains(number);
    list.together.push_back({rank_.name_of(number), rank_.directory[number].owner, is_registered,
                             is_registered ? rank_.box_of(number) : Box{}});
  };
  for (const std::uint32_t number : runner_.members_of(cluster)) add(number);
  if (met) add(*met);
  for (const ReadEntry& entry : runner_.read_set_of(cluster))
    list.read_set.push_back(rank_.name_of(entry.number));
  for (const int owner : owners) round_.to(owner).message.lists.push_back(list);
}

/// Sends each swept-sphere update of an own body to the ranks whose halo region it meets and that own no
/// member of the cluster.
void BatchExchange::note_updates(const Cluster& cluster) {
  std::optional<std::vector<int>> owners;
  for (const SweptSphereUpdate& update : runner_.updates_of(cluster)) {
    if (!is_own(update.number)) continue;
    for (const int to : known_.ranks_that_meet(rank_.box_of(update))) {
      if (!owners) owners = owners_of(cluster);
      if (std::binary_search(owners->begin(), owners->end(), to)) continue;
      send(update.number, to);
      round_.to(to).message.updates.push_back({rank_.name_of(update.number), update});
    }
  }
}

}  // namespace kinesphere
