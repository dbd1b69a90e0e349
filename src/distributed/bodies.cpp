// Bodies come to a rank and go from it.
#include <algorithm>
#include <utility>

#include "distributed/domain.hpp"
#include "engine/validation.hpp"

namespace kinesphere {
namespace {

/// A departure for as long as this lives.
class As {
 public:
  As(Motion& motion, std::uint32_t number, const std::optional<Departure>& departure)
      : motion_(motion), number_(number) {
    if (!departure) return;
    before_ = motion.departure(number);
    motion.depart(number, *departure).value();
  }
  As(const As&) = delete;
  As& operator=(const As&) = delete;
  ~As() {
    if (before_) (void)motion_.depart(number_, *before_);
  }

 private:
  Motion& motion_;
  std::uint32_t number_;
  std::optional<Departure> before_;
};

}  // namespace

std::optional<std::uint32_t> DistributedWorld::Domain::find(std::uint32_t name) const {
  const auto found = roster_.find(name);
  if (found == roster_.end()) return std::nullopt;
  return found->second;
}

/// The body as it is now, but for hot pairs.
Parcel DistributedWorld::Domain::pack(std::uint32_t number) const {
  Parcel parcel;
  parcel.name = name_of(number);
  parcel.owner = entries_[number].owner;
  const auto [body, home] = bodies().keep(number);
  parcel.body = body;
  parcel.home = home;
  parcel.filter = bodies().filters.of(number);
  parcel.contacts = KeptContacts::of(tables_.book, number);
  const Windows& windows = tables_.windows;
  parcel.is_registered = windows.contains(number);
  if (parcel.is_registered) {
    parcel.tier = windows.window_of(number).tier;
    parcel.end = windows.end_of(number);
  }
  motion_.write_body(entries_[number].in_motion, parcel.motion).value();
  const auto named = [&](std::vector<std::uint32_t> numbers) {
    PartnerList names;
    for (const std::uint32_t other : numbers) names.add(name_of(other));
    return names;
  };
  const auto touched = parcel.contacts.partners.all();
  parcel.contacts.partners = named({touched.begin(), touched.end()});
  for (Crossing& crossing : parcel.contacts.crossings) crossing.partner = name_of(crossing.partner);
  if (const auto links = dangling_.find(parcel.name); links != dangling_.end()) {
    for (const std::uint32_t partner : links->second.partners) parcel.contacts.partners.add(partner);
    parcel.contacts.crossings.insert(parcel.contacts.crossings.end(), links->second.crossings.begin(),
                                     links->second.crossings.end());
  }
  return parcel;
}

/// The body as it was when the part of the phase began, which islands may have changed since, with its news
/// that waited to be told then.
Parcel DistributedWorld::Domain::pack_as_it_began(std::uint32_t number) {
  const Group* group = islands_->group_of(number);
  const Kept* kept = group != nullptr && group->attempted ? islands_->kept(number) : nullptr;
  Parcel parcel;
  if (kept == nullptr) {
    parcel = pack(number);
  } else {
    std::optional<Departure> before;
    for (const auto& [body, departure] : islands_->turned_of(*group))
      if (!before && body.index == name_of(number)) before = departure;
    const As as(motion_, entries_[number].in_motion, before);
    const Bodies::Kept now = bodies().keep(number);
    const KeptContacts contacts = KeptContacts::of(tables_.book, number);
    bodies().put_back(number, kept->body);
    kept->contacts.put_back(tables_.book, number);
    parcel = pack(number);
    bodies().put_back(number, now);
    contacts.put_back(tables_.book, number);
  }
  if (group != nullptr) {
    for (const Event& event : group->pending)
      if (event.first.index == parcel.name) parcel.pending.push_back(event);
  }
  return parcel;
}

Parcel::Due DistributedWorld::Domain::due_of(const HotPair& pair, std::uint32_t number) const {
  if (!pair.has_second()) return {pair.time, pair.second};
  return {pair.time, name_of(pair.first == number ? pair.second : pair.first)};
}

/// The stamp of the body when the part of the phase began, if there is one; else its present one.
std::uint32_t DistributedWorld::Domain::stamp_as_it_began(std::uint32_t number) const {
  const Kept* kept = islands_ != nullptr ? islands_->kept(number) : nullptr;
  return kept != nullptr ? kept->body.body.stamp : bodies()[number].stamp;
}

/// A hot pair that was known then.
HotPair DistributedWorld::Domain::pair_as_it_began(const Parcel::Due& due, std::uint32_t number,
                                                   std::uint32_t other) const {
  HotPair pair = everybody_.facts().hot_pair(due.time, number, other);
  pair.first_stamp = stamp_as_it_began(pair.first);
  if (pair.has_second()) pair.second_stamp = stamp_as_it_began(pair.second);
  return pair;
}

/// The hot pairs of some bodies, of which these are the parcels: as they were when the part of the phase
/// began, if there is one.
void DistributedWorld::Domain::add_due(std::vector<Parcel>& parcels, std::span<const std::uint32_t> numbers) {
  if (numbers.empty()) return;
  // By number, one more than the place.
  places_.resize(bodies().numbers());
  for (std::size_t k = 0; k < numbers.size(); ++k) places_[numbers[k]] = static_cast<std::uint32_t>(k) + 1;
  const auto note = [&](const HotPair& pair) {
    const std::uint32_t first = places_[pair.first];
    const std::uint32_t second = pair.has_second() ? places_[pair.second] : 0;
    if (first == 0 && second == 0) return;
    if (stamp_as_it_began(pair.first) != pair.first_stamp) return;
    if (pair.has_second() && stamp_as_it_began(pair.second) != pair.second_stamp) return;
    if (first != 0) parcels[first - 1].due.push_back(due_of(pair, pair.first));
    if (second != 0) parcels[second - 1].due.push_back(due_of(pair, pair.second));
  };
  for (const auto& [number, loose] : loose_)
    if (const std::uint32_t at = places_[number]; at != 0)
      parcels[at - 1].due.insert(parcels[at - 1].due.end(), loose.begin(), loose.end());
  everybody_.agenda().for_each(note);
  if (islands_ != nullptr) {
    for (const Group& group : islands_->groups()) {
      if (group.joined()) continue;
      for (const HotPair& pair : islands_->due_of(group)) note(pair);
    }
  }
  for (const std::uint32_t number : numbers) places_[number] = 0;
}

Result<Beginning> DistributedWorld::Domain::install(std::vector<Parcel>& parcels) {
  Beginning beginning;
  std::vector<std::uint32_t> numbers;
  for (Parcel& parcel : parcels) {
    const auto number = install(parcel);
    if (!number) return number.error();
    numbers.push_back(*number);
    if (parcel.body.dirty) beginning.unsettled.push_back(*number);
  }
  for (const Parcel& parcel : parcels) link(parcel);
  for (std::size_t k = 0; k < parcels.size(); ++k) {
    Parcel& parcel = parcels[k];
    const std::uint32_t number = numbers[k];
    if (parcel.enters && parcel.is_registered)
      tables_.windows.enter(number, roomy_bound(bodies(), number, time()), time(), parcel.window());
    for (const Parcel::Due& due : parcel.due) {
      if (due.other >= HotPair::renewal) {
        beginning.due.push_back(pair_as_it_began(due, number, due.other));
      } else if (const auto other = find(due.other)) {
        beginning.due.push_back(pair_as_it_began(due, number, *other));
      } else if (resuming_) {
        loose_[number].push_back(due);
      }
    }
    for (Event& event : parcel.pending) {
      event.first = bodies().id_of(number);
      beginning.pending.push_back(event);
    }
  }
  // Of two bodies that have come together, each has brought their pair.
  std::sort(beginning.due.begin(), beginning.due.end());
  const auto same = [](const HotPair& a, const HotPair& b) { return !(a < b) && !(b < a); };
  beginning.due.erase(std::unique(beginning.due.begin(), beginning.due.end(), same), beginning.due.end());
  tables_.windows.tidy();
  return beginning;
}

/// The body itself: whom it touches, and where it is registered, comes later.
Result<std::uint32_t> DistributedWorld::Domain::install(Parcel& parcel) {
  std::span<const std::byte> bytes(parcel.motion);
  const auto known = find(parcel.name);
  if (known) {
    if (auto removed = motion_.remove(entries_[*known].in_motion); !removed) return removed.error();
  }
  const auto in_motion = motion_.read_body(bytes);
  if (!in_motion) return in_motion.error();
  const std::uint32_t number = known ? *known : bodies().add(BodyDefinition{}, parcel.name);
  Body& body = bodies()[number];
  const std::uint32_t generation = body.generation;
  const std::uint32_t stamp = parcel.is_void || !known ? body.stamp + 1 : body.stamp;
  body = parcel.body;
  body.generation = generation;
  body.stamp = stamp;
  body.shape_number = body.change_number = body.rest_number = Body::none;
  bodies().filters.keep(number, parcel.filter);
  bodies().set_solid(number, body.solid);
  if (bodies().space().repeats()) bodies().homes[number] = parcel.home;
  if (!known) {
    tables_.book.add(number, 0.0);
    roster_.emplace(parcel.name, number);
    entries_.resize(bodies().numbers());
    is_copy_.resize(bodies().numbers());
    entries_[number] = {};
    is_copy_[number] = parcel.owner == rank() ? 0 : 1;
    if (parcel.owner != rank()) copies_.push_back(number);
  }
  entries_[number].owner = parcel.owner;
  entries_[number].in_motion = *in_motion;
  parcel.contacts.put_back_alone(tables_.book, number);
  if (body.dirty) {
    body.dirty = false;
    everybody_.unsettled().add(bodies(), number);
  }
  return number;
}

void DistributedWorld::Domain::link(const Parcel& parcel) {
  const std::uint32_t number = *find(parcel.name);
  std::vector<std::uint32_t> partners;
  std::vector<Crossing> crossings;
  Links missing;
  // Of one that is known, the link is no longer missing.
  const auto found = [&](std::uint32_t name) {
    const auto links = dangling_.find(name);
    if (links == dangling_.end()) return;
    std::erase(links->second.partners, parcel.name);
    std::erase_if(links->second.crossings, [&](const Crossing& c) { return c.partner == parcel.name; });
    if (links->second.partners.empty() && links->second.crossings.empty()) dangling_.erase(links);
  };
  for (const std::uint32_t name : parcel.contacts.partners.all()) {
    const auto partner = find(name);
    if (partner) {
      partners.push_back(*partner);
      found(name);
    } else {
      missing.partners.push_back(name);
    }
  }
  for (const Crossing& crossing : parcel.contacts.crossings) {
    const auto partner = find(crossing.partner);
    if (partner) {
      crossings.push_back({*partner, crossing.distance, crossing.senses});
      found(crossing.partner);
    } else {
      missing.crossings.push_back(crossing);
    }
  }
  tables_.book.set_links(number, partners, std::move(crossings));
  if (missing.partners.empty() && missing.crossings.empty()) {
    dangling_.erase(parcel.name);
  } else {
    dangling_[parcel.name] = std::move(missing);
  }
}

/// The body is not known here any more. start_windows(), which drops many copies, takes them out of copies_.
void DistributedWorld::Domain::drop(std::uint32_t number) {
  const std::uint32_t name = name_of(number);
  const auto partners = tables_.book.partners_of(number);
  for (const std::uint32_t partner : partners) dangling_[name_of(partner)].partners.push_back(name);
  for (const Crossing& crossing : tables_.book.crossings_of(number))
    dangling_[name_of(crossing.partner)].crossings.push_back({name, crossing.distance, crossing.senses});
  tables_.book.set_links(number, {}, {});
  dangling_.erase(name);
  if (tables_.windows.contains(number)) tables_.windows.leave(number);
  (void)motion_.remove(entries_[number].in_motion);
  roster_.erase(name);
  entries_[number] = {};
  is_copy_[number] = 0;
  bodies().remove(number);
}

/// Around the way of a kicked body until its window ends.
Box DistributedWorld::Domain::box_of(const BodyKick& kick) const {
  const RoomyBound bound = room_for(bodies(), kick.number, MovedBound(kick.bound, kick.time));
  return bodies().space().within(
      bound.box_of_way(kick.window.end < infinity ? kick.window.end - kick.time : 0.0));
}

void DistributedWorld::Domain::states(std::span<const BodyId> ids, double time, std::span<State> states) {
  for (std::size_t k = 0; k < ids.size(); ++k)
    states[k] = motion_.state(entries_[ids[k].world].in_motion, time);
}

Departure DistributedWorld::Domain::departure(BodyId body) const {
  return motion_.departure(entries_[body.world].in_motion);
}

void DistributedWorld::Domain::depart(BodyId body, const Departure& departure) {
  motion_.depart(entries_[body.world].in_motion, departure).value();
}

}  // namespace kinesphere
