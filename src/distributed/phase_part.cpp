#include "distributed/phase_part.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "distributed/guarded.hpp"

namespace kinesphere {
namespace {

enum class Standing : std::uint8_t { content, has_news, has_failed };

}  // namespace

PhasePart::PhasePart(Communicator& communicator, Agreement& agreement, LocalWorld& local, Transit& transit,
                     KnownSpaces& known, Islands& islands)
    : communicator_(communicator),
      agreement_(agreement),
      local_(local),
      transit_(transit),
      known_(known),
      islands_(islands),
      round_(communicator.ranks()) {}

Result<void> PhasePart::run() {
  for (;;) {
    join_as_told();
    if (!agreement_.has_noted() &&
        !islands_.attempt_all([this](const Group& group) { return is_ready(group); }))
      agreement_.note(*islands_.failure());
    const auto shared = share();
    if (!shared) return shared.error();
    if (!*shared) return {};
  }
}

bool PhasePart::is_ours(const Group& group) const {
  const auto members = islands_.members_of(group);
  return std::any_of(members.begin(), members.end(), [this](std::uint32_t number) { return is_own(number); });
}

/// All pairs of its bodies are known here.
bool PhasePart::is_ready(const Group& group) const {
  const auto members = islands_.members_of(group);
  return is_ours(group) && std::all_of(members.begin(), members.end(), [this](std::uint32_t number) {
           return is_own(number) || !local_.tables.windows.contains(number) ||
                  known_.covers(local_.box_of(number));
         });
}

/// In ascending order.
std::vector<int> PhasePart::owners_of(const Group& group) const {
  std::vector<int> owners;
  for (const std::uint32_t number : islands_.members_of(group)) {
    const int owner = local_.roster[number].owner;
    if (std::find(owners.begin(), owners.end(), owner) == owners.end()) owners.push_back(owner);
  }
  std::sort(owners.begin(), owners.end());
  return owners;
}

/// Tells the others what is new of islands, and learns the same from them. False when nothing is, anywhere.
Result<bool> PhasePart::share() {
  if (!agreement_.has_noted() && communicator_.ranks() > 1) note_news();
  const Standing standing = agreement_.has_noted() ? Standing::has_failed
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
  if (failed) return agreement_.agree_on_noted().error();
  if (!any) return false;
  ++rounds_;
  Outbox outbox(communicator_.ranks());
  for (int rank = 0; rank < communicator_.ranks(); ++rank) {
    if (rank == communicator_.rank()) continue;
    const std::vector<Box>& boxes = asked[static_cast<std::size_t>(rank)];
    for (const Box& box : boxes) known_[rank].add(box);
    for (const std::uint32_t number : local_.own_bodies_in(boxes)) send(number, rank);
    agreement_.note(guarded([&] { send_to(rank, outbox); }));
  }
  round_ = Round(communicator_.ranks());
  take_in(outbox.exchange(communicator_));
  // What has come with space that was asked for may be in the way of those who asked.
  for (const std::uint32_t own : std::exchange(asking_, {}))
    if (!islands_.groups()[own].joined()) islands_.run_again(own);
  return true;
}

/// What the round has for this rank.
void PhasePart::send_to(int rank, Outbox& outbox) {
  auto& [message, bodies] = round_.to(rank);
  for (const std::uint32_t number : bodies) {
    message.parcels.push_back(transit_.pack_as_it_began(number, islands_));
    message.parcels.back().enters = true;
  }
  transit_.add_due(message.parcels, bodies, &islands_);
  if (!message.is_empty()) outbox.add(rank, message);
}

void PhasePart::take_in(const std::vector<Communicator::Bytes>& incoming) {
  std::vector<RoundMessage> messages(incoming.size());
  std::vector<Parcel> parcels;
  for (std::size_t from = 0; from < incoming.size(); ++from) {
    if (incoming[from].empty()) continue;
    RoundMessage& message = messages[from];
    ByteReader reader(incoming[from]);
    reader(message);
    std::move(message.parcels.begin(), message.parcels.end(), std::back_inserter(parcels));
    std::move(message.lists.begin(), message.lists.end(), std::back_inserter(lists_));
  }
  std::optional<Beginning> beginning;
  agreement_.note(guarded([&]() -> Result<void> {
    auto installed = transit_.install(parcels, &islands_);
    if (!installed) return installed.error();
    beginning = std::move(*installed);
    return {};
  }));
  if (!beginning) return;
  local_.tables.book.start_side_by_side(local_.bodies().sensors.any());
  const auto later = std::partition(beginning->due.begin(), beginning->due.end(),
                                    [this](const HotPair& pair) { return islands_.comes(pair.time); });
  std::for_each(later, beginning->due.end(),
                [this](const HotPair& pair) { local_.everybody.agenda().add(pair); });
  beginning->due.erase(later, beginning->due.end());
  islands_.add(*beginning);
  for (std::size_t from = 0; from < messages.size(); ++from) {
    for (const std::uint32_t name : messages[from].wanted)
      if (const auto number = local_.roster.find(name)) send(*number, static_cast<int>(from));
    for (auto& [name, kick] : messages[from].kicks) {
      const auto number = local_.roster.find(name);
      if (!number) continue;
      kick.number = *number;
      islands_.add_foreign_kick(kick);
    }
  }
}

/// Islands that others have joined are joined here, as soon as all of their bodies are known.
void PhasePart::join_as_told() {
  std::erase_if(lists_, [this](JoinList& list) { return join_as_told(list); });
}

/// False if the list has to wait.
bool PhasePart::join_as_told(JoinList& list) {
  std::vector<std::uint32_t> numbers;
  for (const JoinList::Member& member : list.together) {
    if (const auto number = local_.roster.find(member.name)) {
      numbers.push_back(*number);
    } else {
      ask_for(member);
    }
  }
  if (numbers.size() < list.together.size()) return false;
  islands_.join_bodies(numbers);
  std::erase_if(list.counted_on, [&](std::uint32_t name) {
    const auto number = local_.roster.find(name);
    if (!number || !is_own(*number)) return true;
    if (islands_.group_of(*number) == nullptr) return false;
    numbers.push_back(*number);
    islands_.join_bodies(numbers);
    return true;
  });
  return list.counted_on.empty();
}

/// A registered body comes with the space around it, others by their names.
void PhasePart::ask_for(const JoinList::Member& member) {
  if (member.is_registered) {
    ask_for(member.box);
  } else {
    round_.to(member.owner).message.wanted.push_back(member.name);
  }
}

/// False if the space is known.
bool PhasePart::ask_for(const Box& box) {
  const bool is_new = known_.cover(box);
  if (is_new) round_.asks.push_back(box);
  return is_new;
}

/// The rank gets a copy of an own body, unless it has one.
void PhasePart::send(std::uint32_t number, int to) {
  if (local_.roster.add_holder(number, to)) round_.to(to).bodies.push_back(number);
}

void PhasePart::note_news() {
  for (Group& group : islands_.groups()) {
    if (group.joined() || !group.is_news || !is_ours(group)) continue;
    group.is_news = false;
    note_space(group);
    note_list(group, std::nullopt);
    note_kicks(group);
  }
  for (const auto& [own, number] : islands_.take_meetings()) {
    const Group& group = islands_.groups()[own];
    if (!group.joined()) note_list(group, number);
  }
}

/// Asks for what lies in the way of the island's bodies.
void PhasePart::note_space(const Group& group) {
  bool any = false;
  for (const std::uint32_t number : islands_.members_of(group))
    if (!is_own(number) && local_.tables.windows.contains(number))
      any = ask_for(local_.box_of(number)) || any;
  for (const BodyKick& kick : islands_.kicks_of(group)) any = ask_for(local_.box_of(kick)) || any;
  if (any) asking_.push_back(group.own);
}

/// Tells the owners of its bodies and of those it counts on of an island; or the owner of one that it meets.
void PhasePart::note_list(const Group& group, std::optional<std::uint32_t> met) {
  std::vector<int> owners;
  const auto note = [&](std::uint32_t number) {
    const int owner = local_.roster[number].owner;
    if (owner != communicator_.rank() && std::find(owners.begin(), owners.end(), owner) == owners.end())
      owners.push_back(owner);
  };
  if (met) {
    note(*met);
  } else {
    for (const std::uint32_t number : islands_.members_of(group)) note(number);
    for (const CountedOn& counted_on : islands_.counted_on_of(group)) note(counted_on.number);
  }
  if (owners.empty()) return;
  JoinList list;
  const auto add = [&](std::uint32_t number) {
    const bool is_registered = local_.tables.windows.contains(number);
    list.together.push_back({local_.name_of(number), local_.roster[number].owner, is_registered,
                             is_registered ? local_.box_of(number) : Box{}});
  };
  for (const std::uint32_t number : islands_.members_of(group)) add(number);
  if (met) add(*met);
  for (const CountedOn& counted_on : islands_.counted_on_of(group))
    list.counted_on.push_back(local_.name_of(counted_on.number));
  for (const int owner : owners) round_.to(owner).message.lists.push_back(list);
}

/// Tells of kicked bodies all ranks to whose space they come.
void PhasePart::note_kicks(const Group& group) {
  std::optional<std::vector<int>> owners;
  for (const BodyKick& kick : islands_.kicks_of(group)) {
    if (!is_own(kick.number)) continue;
    for (const int to : known_.ranks_that_meet(local_.box_of(kick))) {
      if (!owners) owners = owners_of(group);
      if (std::binary_search(owners->begin(), owners->end(), to)) continue;
      send(kick.number, to);
      round_.to(to).message.kicks.push_back({local_.name_of(kick.number), kick});
    }
  }
}

}  // namespace kinesphere
