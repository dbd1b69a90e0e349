// A part of a phase: each rank runs the islands that have a body of its own, and ranks tell each other what
// joins islands, until each has run its islands with all bodies that belong to them.
#include <algorithm>
#include <utility>

#include "archive/archive.hpp"
#include "distributed/domain.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

template <class Self, class Archive>
void transfer_kick(Self& kick, Archive& archive) {
  archive(kick.time, kick.window.tier, kick.window.end, kick.bound, kick.middle);
}

enum class Standing : std::uint8_t { content, has_news, has_failed };

/// The rank goes on with its islands as long as this lives.
template <class T>
class Present {
 public:
  Present(T*& place, T& value) : place_(place) { place_ = &value; }
  Present(const Present&) = delete;
  Present& operator=(const Present&) = delete;
  ~Present() { place_ = nullptr; }

 private:
  T*& place_;
};

}  // namespace

/// What a rank has to say to the others.
struct DistributedWorld::Domain::Round {
  explicit Round(std::size_t ranks) : lists(ranks), kicks(ranks), wanted(ranks), parcels(ranks) {}

  std::vector<Box> asks;  ///< boxes in which all bodies have to be known
  // To each of them.
  std::vector<std::vector<JoinList>> lists;
  std::vector<std::vector<BodyKick>> kicks;
  std::vector<std::vector<std::uint32_t>> wanted;   ///< names
  std::vector<std::vector<std::uint32_t>> parcels;  ///< numbers

  bool is_empty() const {
    const auto none = [](const auto& all) {
      return std::all_of(all.begin(), all.end(), [](const auto& some) { return some.empty(); });
    };
    return asks.empty() && none(lists) && none(kicks) && none(wanted) && none(parcels);
  }
};

/// From now to `until`, or to the end of a part of the phase, or to `latest`: returns where the part ends.
Result<double> DistributedWorld::Domain::run_part(double until, double latest) {
  Islands& islands = *islands_of_run_;
  const double stop = communicator_.least(islands.take_due(until, latest));
  islands.open(stop);
  ++parts_;
  {
    const Present present(islands_, islands);
    bool more = true;
    while (more) {
      use_lists();
      if (!here_ && !islands.attempt_all([this](const Group& group) { return is_ready(group); }))
        here_ = islands.failure();
      const auto shared = share();
      if (!shared) {
        islands.close();
        return shared.error();
      }
      more = *shared;
    }
  }
  if (auto done = finish_part(); !done) return done.error();
  return stop;
}

bool DistributedWorld::Domain::is_ours(const Group& group) const {
  const auto members = islands_of_run_->members_of(group);
  return std::any_of(members.begin(), members.end(), [this](std::uint32_t number) { return is_own(number); });
}

/// All pairs of its bodies are known here.
bool DistributedWorld::Domain::is_ready(const Group& group) const {
  const auto members = islands_of_run_->members_of(group);
  return is_ours(group) && std::all_of(members.begin(), members.end(), [this](std::uint32_t number) {
           return is_own(number) || !tables_.windows.contains(number) || covers(box_of(number));
         });
}

/// In ascending order.
std::vector<int> DistributedWorld::Domain::owners_of(const Group& group) const {
  std::vector<int> owners;
  for (const std::uint32_t number : islands_of_run_->members_of(group)) {
    const int owner = entries_[number].owner;
    if (std::find(owners.begin(), owners.end(), owner) == owners.end()) owners.push_back(owner);
  }
  std::sort(owners.begin(), owners.end());
  return owners;
}

/// Tells the others what is new of islands, and learns the same from them. False when nothing is, anywhere.
Result<bool> DistributedWorld::Domain::share() {
  Round round(ranks());
  if (!here_ && ranks() > 1) note_news(round);
  const Standing standing = here_              ? Standing::has_failed
                            : round.is_empty() ? Standing::content
                                               : Standing::has_news;
  ByteWriter writer;
  writer(standing, round.asks);
  std::vector<std::vector<Box>> asked;
  bool any = false;
  bool failed = false;
  for (const Bytes& bytes : communicator_.gather(writer.bytes())) {
    Standing theirs{};
    ByteReader reader(bytes);
    reader(theirs, asked.emplace_back());
    any = any || theirs == Standing::has_news;
    failed = failed || theirs == Standing::has_failed;
  }
  if (failed) return agree(here_ ? Result<void>(*here_) : Result<void>()).error();
  if (!any) return false;
  ++rounds_;
  for (std::size_t from = 0; from < ranks(); ++from) {
    if (static_cast<int>(from) == rank()) continue;
    for (const Box& box : asked[from]) known_[from].add(box);
    for (const std::uint32_t number : own_bodies_in(asked[from])) hold(number, static_cast<int>(from), round);
  }
  std::vector<Bytes> outgoing;
  for (std::size_t to = 0; to < ranks(); ++to) outgoing.push_back(bytes_for(to, round));
  take_in(communicator_.exchange(std::move(outgoing)));
  // What has come with space that was asked for may be in the way of those who asked.
  for (const std::uint32_t own : std::exchange(asking_, {}))
    if (!islands_->groups()[own].joined()) islands_->run_again(own);
  return true;
}

/// The rank gets a copy of an own body, unless it has one.
void DistributedWorld::Domain::hold(std::uint32_t number, int by, Round& round) {
  if (is_held(number, by)) return;
  entries_[number].holders.push_back(by);
  round.parcels[static_cast<std::size_t>(by)].push_back(number);
}

Communicator::Bytes DistributedWorld::Domain::bytes_for(std::size_t to, const Round& round) {
  if (static_cast<int>(to) == rank()) return {};
  std::vector<Parcel> parcels;
  for (const std::uint32_t number : round.parcels[to]) {
    parcels.push_back(pack_as_it_began(number));
    parcels.back().enters = true;
  }
  add_due(parcels, round.parcels[to]);
  if (parcels.empty() && round.lists[to].empty() && round.kicks[to].empty() && round.wanted[to].empty())
    return {};
  ByteWriter writer;
  writer(parcels, round.lists[to], round.wanted[to], round.kicks[to].size());
  for (const BodyKick& kick : round.kicks[to]) {
    writer(name_of(kick.number));
    transfer_kick(kick, writer);
  }
  return writer.take();
}

void DistributedWorld::Domain::take_in(const std::vector<Bytes>& incoming) {
  std::vector<Parcel> all;
  std::vector<std::pair<std::uint32_t, BodyKick>> kicks;
  for (std::size_t from = 0; from < incoming.size(); ++from) {
    if (incoming[from].empty()) continue;
    ByteReader reader(incoming[from]);
    std::vector<Parcel> parcels;
    std::vector<JoinList> lists;
    std::vector<std::uint32_t> wanted;
    std::size_t count = 0;
    reader(parcels, lists, wanted, count);
    std::move(parcels.begin(), parcels.end(), std::back_inserter(all));
    std::move(lists.begin(), lists.end(), std::back_inserter(lists_));
    for (const std::uint32_t name : wanted) owed_.emplace_back(static_cast<int>(from), name);
    for (; count > 0 && !reader.failed(); --count) {
      std::uint32_t name = 0;
      BodyKick kick{};
      reader(name);
      transfer_kick(kick, reader);
      kicks.emplace_back(name, kick);
    }
  }
  auto beginning = install(all);
  if (!beginning) {
    here_ = beginning.error();
    return;
  }
  tables_.book.start_side_by_side(bodies().sensors.any());
  const auto later = std::partition(beginning->due.begin(), beginning->due.end(),
                                    [this](const HotPair& pair) { return islands_->comes(pair.time); });
  std::for_each(later, beginning->due.end(), [this](const HotPair& pair) { everybody_.agenda().add(pair); });
  beginning->due.erase(later, beginning->due.end());
  islands_->add(*beginning);
  for (auto& [name, kick] : kicks) {
    const auto number = find(name);
    if (!number) continue;
    kick.number = *number;
    islands_->add_foreign_kick(kick);
  }
}

/// Islands that others have joined are joined here, as soon as all of their bodies are known.
void DistributedWorld::Domain::use_lists() {
  std::erase_if(lists_, [this](JoinList& list) {
    std::vector<std::uint32_t> numbers;
    bool all_known = true;
    for (const JoinList::Member& member : list.together) {
      if (const auto number = find(member.name)) {
        numbers.push_back(*number);
        continue;
      }
      all_known = false;
      if (member.is_registered && !covers(member.box)) {
        known_[static_cast<std::size_t>(rank())].add(member.box);
        asks_.push_back(member.box);
      } else if (!member.is_registered) {
        wanted_.emplace_back(member.owner, member.name);
      }
    }
    if (!all_known) return false;
    if (!numbers.empty()) islands_->join_bodies(numbers);
    std::erase_if(list.counted_on, [&](std::uint32_t name) {
      const auto number = find(name);
      if (!number || !is_own(*number)) return true;
      if (islands_->group_of(*number) == nullptr) return false;
      numbers.push_back(*number);
      islands_->join_bodies(numbers);
      return true;
    });
    return list.counted_on.empty();
  });
}

void DistributedWorld::Domain::note_news(Round& round) {
  round.asks = std::exchange(asks_, {});
  for (const auto& [owner, name] : std::exchange(wanted_, {}))
    round.wanted[static_cast<std::size_t>(owner)].push_back(name);
  for (const auto& [by, name] : std::exchange(owed_, {}))
    if (const auto number = find(name)) hold(*number, by, round);
  for (Group& group : islands_->groups()) {
    if (group.joined() || !group.is_news || !is_ours(group)) continue;
    group.is_news = false;
    note_asks(group, round);
    note_list(group, std::nullopt, round);
    note_kicks(group, round);
  }
  for (const auto& [own, number] : islands_->take_meetings()) {
    const Group& group = islands_->groups()[own];
    if (!group.joined()) note_list(group, number, round);
  }
}

/// Asks for what lies in the way of the island's bodies.
void DistributedWorld::Domain::note_asks(const Group& group, Round& round) {
  const auto ask = [&](const Box& box) {
    if (covers(box)) return false;
    known_[static_cast<std::size_t>(rank())].add(box);
    round.asks.push_back(box);
    return true;
  };
  bool any = false;
  for (const std::uint32_t number : islands_of_run_->members_of(group))
    if (!is_own(number) && tables_.windows.contains(number)) any = ask(box_of(number)) || any;
  if (group.attempted)
    for (const BodyKick& kick : islands_of_run_->kicks_of(group)) any = ask(box_of(kick)) || any;
  if (any) asking_.push_back(group.own);
}

/// Tells the owners of its bodies, and of those it counts on, and of one that it meets, of an island.
void DistributedWorld::Domain::note_list(const Group& group, std::optional<std::uint32_t> met, Round& round) {
  std::vector<int> to;
  const auto note = [&](std::uint32_t number) {
    const int owner = entries_[number].owner;
    if (owner != rank() && std::find(to.begin(), to.end(), owner) == to.end()) to.push_back(owner);
  };
  if (met) {
    note(*met);
  } else {
    for (const std::uint32_t number : islands_of_run_->members_of(group)) note(number);
    for (const CountedOn& counted_on : islands_of_run_->counted_on_of(group)) note(counted_on.number);
  }
  if (to.empty()) return;
  JoinList list;
  const auto add = [&](std::uint32_t number) {
    const bool is_registered = tables_.windows.contains(number);
    list.together.push_back(
        {name_of(number), entries_[number].owner, is_registered, is_registered ? box_of(number) : Box{}});
  };
  for (const std::uint32_t number : islands_of_run_->members_of(group)) add(number);
  if (met) add(*met);
  for (const CountedOn& counted_on : islands_of_run_->counted_on_of(group))
    list.counted_on.push_back(name_of(counted_on.number));
  for (const int owner : to) round.lists[static_cast<std::size_t>(owner)].push_back(list);
}

/// Tells of kicked bodies all ranks to whose space they come.
void DistributedWorld::Domain::note_kicks(const Group& group, Round& round) {
  if (!group.attempted) return;
  std::optional<std::vector<int>> owners;
  for (const BodyKick& kick : islands_of_run_->kicks_of(group)) {
    if (!is_own(kick.number)) continue;
    const Box box = box_of(kick);
    for (std::size_t to = 0; to < ranks(); ++to) {
      const int other = static_cast<int>(to);
      if (other == rank() || !known_[to].meets(box, bodies().space())) continue;
      if (!owners) owners = owners_of(group);
      if (std::binary_search(owners->begin(), owners->end(), other)) continue;
      hold(kick.number, other, round);
      round.kicks[to].push_back(kick);
    }
  }
}

/// What came of the islands becomes what came of everybody, and those who have copies learn of it.
Result<void> DistributedWorld::Domain::finish_part() {
  Islands& islands = *islands_of_run_;
  const auto is_counted = [&](const Group& group) {
    const auto members = islands.members_of(group);
    const auto first = std::min_element(
        members.begin(), members.end(),
        [this](std::uint32_t a, std::uint32_t b) { return bodies().table().comes_before(a, b); });
    return is_own(*first);
  };
  for (const Group& group : islands.groups()) {
    if (group.joined() || !group.attempted) continue;
    const float cost = static_cast<float>(1 + group.due.size()) / static_cast<float>(group.members.size());
    for (const std::uint32_t number : islands.members_of(group)) entries_[number].cost += cost;
  }
  for (const Told* told : islands.finish(is_counted)) {
    Event event = told->event;
    if (!is_own(bodies().table().number_of(event.first))) continue;
    event.first.world = event.second.world = 0;
    hash_.add(event);
    events_.push_back({event, told->round});
  }
  auto pushed = push();
  islands.close();
  lists_.clear();
  return pushed;
}

/// Bodies that have changed go to those who have copies but have not run their island, and to those to whose
/// space they have been kicked.
Result<void> DistributedWorld::Domain::push() {
  if (ranks() == 1) return {};
  std::vector<ByteWriter> writers(ranks());
  for (const Group& group : islands_of_run_->groups()) {
    if (group.joined() || !group.attempted) continue;
    std::vector<std::uint32_t> kicked;
    for (const BodyKick& kick : islands_of_run_->kicks_of(group))
      if (is_own(kick.number)) kicked.push_back(kick.number);
    std::sort(kicked.begin(), kicked.end());
    kicked.erase(std::unique(kicked.begin(), kicked.end()), kicked.end());
    for (const std::uint32_t number : kicked) {
      const Box box = box_of(number);
      for (std::size_t to = 0; to < ranks(); ++to)
        if (static_cast<int>(to) != rank() && known_[to].meets(box, bodies().space()) &&
            !is_held(number, static_cast<int>(to)))
          entries_[number].holders.push_back(static_cast<int>(to));
    }
    std::optional<std::vector<int>> owners;
    for (const std::uint32_t number : islands_of_run_->members_of(group)) {
      if (!is_own(number) || entries_[number].holders.empty()) continue;
      const bool is_kicked = std::binary_search(kicked.begin(), kicked.end(), number);
      // Its copies are dropped in any case.
      if (!is_kicked && tables_.windows.end_of(number) <= time()) continue;
      if (!owners) owners = owners_of(group);
      std::optional<Parcel> parcel;
      for (const int to : entries_[number].holders) {
        if (std::binary_search(owners->begin(), owners->end(), to)) continue;
        if (!parcel) {
          parcel = pack(number);
          parcel->enters = is_kicked;
          parcel->is_void = islands_of_run_->kept(number)->body.body.stamp != bodies()[number].stamp;
          for (const HotPair& pair : islands_of_run_->left_of(group))
            if (pair.first == number || (pair.has_second() && pair.second == number))
              parcel->due.push_back(due_of(pair, number));
        }
        writers[static_cast<std::size_t>(to)](*parcel);
      }
    }
  }
  std::vector<Windows::Starter> none;
  return receive(writers, none);
}

}  // namespace kinesphere
