#include "distributed/transit.hpp"

#include <algorithm>
#include <utility>

#include "distributed/guarded.hpp"

namespace kinesphere {
namespace {

/// The body has set out from `departure`, if there is one, for as long as this lives.
class TemporaryDeparture {
 public:
  TemporaryDeparture(Motion& motion, std::uint32_t number, const std::optional<Departure>& departure)
      : motion_(motion), number_(number) {
    if (!departure) return;
    before_ = motion.departure(number);
    motion.depart(number, *departure).value();
  }
  TemporaryDeparture(const TemporaryDeparture&) = delete;
  TemporaryDeparture& operator=(const TemporaryDeparture&) = delete;
  ~TemporaryDeparture() {
    if (before_) (void)motion_.depart(number_, *before_);
  }

 private:
  Motion& motion_;
  std::uint32_t number_;
  std::optional<Departure> before_;
};

}  // namespace

Parcel Transit::pack(std::uint32_t number) const {
  const Bodies& bodies = local_.bodies();
  const Roster::Entry& entry = local_.roster[number];
  Parcel parcel;
  parcel.name = local_.name_of(number);
  parcel.owner = entry.owner;
  const auto [body, home] = bodies.keep(number);
  parcel.body = body;
  parcel.home = home;
  parcel.filter = bodies.filters.of(number);
  parcel.contacts = KeptContacts::of(local_.tables.book, number);
  const Windows& windows = local_.tables.windows;
  parcel.is_registered = windows.contains(number);
  if (parcel.is_registered) {
    parcel.tier = windows.window_of(number).tier;
    parcel.end = windows.end_of(number);
  }
  motion_.write_body(entry.in_motion, parcel.motion).value();
  // Numbers become names.
  PartnerList partners;
  std::vector<Crossing>& crossings = parcel.contacts.crossings;
  for (const std::uint32_t partner : parcel.contacts.partners.all()) partners.add(local_.name_of(partner));
  for (Crossing& crossing : crossings) crossing.partner = local_.name_of(crossing.partner);
  if (const DanglingLinks::Links* links = dangling_.of(parcel.name)) {
    for (const std::uint32_t partner : links->partners) partners.add(partner);
    crossings.insert(crossings.end(), links->crossings.begin(), links->crossings.end());
  }
  parcel.contacts.partners = std::move(partners);
  return parcel;
}

Parcel Transit::pack_as_it_began(std::uint32_t number, Islands& islands) {
  const Group* group = islands.group_of(number);
  const Kept* kept = group != nullptr && group->attempted ? islands.kept(number) : nullptr;
  Parcel parcel;
  if (kept == nullptr) {
    parcel = pack(number);
  } else {
    std::optional<Departure> before;
    for (const auto& [body, departure] : islands.turned_of(*group))
      if (!before && body.index == local_.name_of(number)) before = departure;
    const TemporaryDeparture as_it_began(motion_, local_.roster[number].in_motion, before);
    const Bodies::Kept now = local_.bodies().keep(number);
    const KeptContacts contacts = KeptContacts::of(local_.tables.book, number);
    local_.bodies().put_back(number, kept->body);
    kept->contacts.put_back(local_.tables.book, number);
    parcel = pack(number);
    local_.bodies().put_back(number, now);
    contacts.put_back(local_.tables.book, number);
  }
  if (group != nullptr) {
    for (const Event& event : group->pending)
      if (event.first.index == parcel.name) parcel.pending.push_back(event);
  }
  return parcel;
}

Parcel::Due Transit::due_of(const HotPair& pair, std::uint32_t number) const {
  if (!pair.has_second()) return {pair.time, pair.second};
  return {pair.time, local_.name_of(pair.first == number ? pair.second : pair.first)};
}

/// When the part of the phase began, if there is one; else now.
std::uint32_t Transit::stamp_of(std::uint32_t number, const Islands* islands) const {
  const Kept* kept = islands != nullptr ? islands->kept(number) : nullptr;
  return kept != nullptr ? kept->body.body.stamp : local_.bodies()[number].stamp;
}

HotPair Transit::hot_pair(const Parcel::Due& due, std::uint32_t number, std::uint32_t other,
                          const Islands* islands) const {
  HotPair pair = local_.everybody.facts().hot_pair(due.time, number, other);
  pair.first_stamp = stamp_of(pair.first, islands);
  if (pair.has_second()) pair.second_stamp = stamp_of(pair.second, islands);
  return pair;
}

void Transit::add_due(std::vector<Parcel>& parcels, std::span<const std::uint32_t> numbers,
                      Islands* islands) {
  if (numbers.empty()) return;
  places_.resize(local_.bodies().numbers());
  for (std::size_t k = 0; k < numbers.size(); ++k) places_[numbers[k]] = static_cast<std::uint32_t>(k) + 1;
  const auto note = [&](const HotPair& pair) {
    const std::uint32_t first = places_[pair.first];
    const std::uint32_t second = pair.has_second() ? places_[pair.second] : 0;
    if (first == 0 && second == 0) return;
    if (stamp_of(pair.first, islands) != pair.first_stamp) return;
    if (pair.has_second() && stamp_of(pair.second, islands) != pair.second_stamp) return;
    if (first != 0) parcels[first - 1].due.push_back(due_of(pair, pair.first));
    if (second != 0) parcels[second - 1].due.push_back(due_of(pair, pair.second));
  };
  local_.everybody.agenda().for_each(note);
  if (islands != nullptr) {
    for (const Group& group : islands->groups()) {
      if (group.joined()) continue;
      for (const HotPair& pair : islands->due_of(group)) note(pair);
    }
  }
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    places_[numbers[k]] = 0;
    if (!loose_) continue;
    if (const auto loose = loose_->find(numbers[k]); loose != loose_->end())
      parcels[k].due.insert(parcels[k].due.end(), loose->second.begin(), loose->second.end());
  }
}

void Transit::add_due(Parcel& parcel, std::uint32_t number, std::span<const HotPair> pairs) const {
  for (const HotPair& pair : pairs)
    if (pair.first == number || (pair.has_second() && pair.second == number))
      parcel.due.push_back(due_of(pair, number));
}

Result<Beginning> Transit::install(std::vector<Parcel>& parcels, const Islands* islands) {
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
      local_.tables.windows.enter(number, roomy_bound(local_.bodies(), number, local_.time()), local_.time(),
                                  parcel.window());
    for (const Parcel::Due& due : parcel.due) {
      if (due.other >= HotPair::renewal) {
        beginning.due.push_back(hot_pair(due, number, due.other, islands));
      } else if (const auto other = local_.roster.find(due.other)) {
        beginning.due.push_back(hot_pair(due, number, *other, islands));
      } else if (loose_) {
        (*loose_)[number].push_back(due);
      }
    }
    for (Event& event : parcel.pending) {
      event.first = local_.bodies().id_of(number);
      beginning.pending.push_back(event);
    }
  }
  // Of two bodies that have come together, each has brought their pair.
  std::sort(beginning.due.begin(), beginning.due.end());
  const auto same = [](const HotPair& a, const HotPair& b) { return !(a < b) && !(b < a); };
  beginning.due.erase(std::unique(beginning.due.begin(), beginning.due.end(), same), beginning.due.end());
  local_.tables.windows.tidy();
  return beginning;
}

/// The body itself: whom it touches, and where it is registered, comes later.
Result<std::uint32_t> Transit::install(Parcel& parcel) {
  Bodies& bodies = local_.bodies();
  Roster& roster = local_.roster;
  std::span<const std::byte> bytes(parcel.motion);
  const auto known = roster.find(parcel.name);
  if (known) {
    if (auto removed = motion_.remove(roster[*known].in_motion); !removed) return removed.error();
  }
  const auto in_motion = motion_.read_body(bytes);
  if (!in_motion) return in_motion.error();
  const std::uint32_t number = known ? *known : bodies.add(BodyDefinition{}, parcel.name);
  Body& body = bodies[number];
  const std::uint32_t generation = body.generation;
  const std::uint32_t stamp = parcel.is_void || !known ? body.stamp + 1 : body.stamp;
  body = parcel.body;
  body.generation = generation;
  body.stamp = stamp;
  body.shape_number = body.change_number = body.rest_number = Body::none;
  bodies.filters.keep(number, parcel.filter);
  bodies.set_solid(number, body.solid);
  if (bodies.space().repeats()) bodies.homes[number] = parcel.home;
  if (!known) {
    local_.tables.book.add(number, 0.0);
    roster.add(parcel.name, number, parcel.owner);
  }
  roster[number].owner = parcel.owner;
  roster[number].in_motion = *in_motion;
  parcel.contacts.put_back_alone(local_.tables.book, number);
  if (body.dirty) {
    body.dirty = false;
    local_.everybody.unsettled().add(local_.bodies(), number);
  }
  return number;
}

/// Links of the two that have found each other dangle no longer.
void Transit::link(const Parcel& parcel) {
  std::vector<std::uint32_t> partners;
  std::vector<Crossing> crossings;
  DanglingLinks::Links missing;
  for (const std::uint32_t name : parcel.contacts.partners.all()) {
    if (const auto partner = local_.roster.find(name)) {
      partners.push_back(*partner);
      dangling_.remove(name, parcel.name);
    } else {
      missing.partners.push_back(name);
    }
  }
  for (const Crossing& crossing : parcel.contacts.crossings) {
    if (const auto partner = local_.roster.find(crossing.partner)) {
      crossings.push_back({*partner, crossing.distance, crossing.senses});
      dangling_.remove(crossing.partner, parcel.name);
    } else {
      missing.crossings.push_back(crossing);
    }
  }
  local_.tables.book.set_links(*local_.roster.find(parcel.name), partners, std::move(crossings));
  dangling_.set(parcel.name, std::move(missing));
}

Result<std::vector<Parcel>> Transit::exchange(Communicator& communicator, Agreement& agreement,
                                              Outbox& outbox) {
  std::vector<Parcel> parcels;
  for (const Communicator::Bytes& bytes : outbox.exchange(communicator)) {
    ByteReader reader(bytes);
    while (reader.remaining() > 0 && !reader.failed()) reader(parcels.emplace_back());
  }
  agreement.note(guarded([&]() -> Result<void> {
    auto beginning = install(parcels, nullptr);
    if (!beginning) return beginning.error();
    local_.everybody.agenda().add_all(beginning->due);
    return {};
  }));
  if (auto agreed = agreement.agree_on_noted(); !agreed) return agreed.error();
  return parcels;
}

void Transit::drop(std::uint32_t number) {
  const std::uint32_t name = local_.name_of(number);
  for (const std::uint32_t partner : local_.tables.book.partners_of(number))
    dangling_.add_partner(local_.name_of(partner), name);
  for (const Crossing& crossing : local_.tables.book.crossings_of(number))
    dangling_.add_crossing(local_.name_of(crossing.partner), {name, crossing.distance, crossing.senses});
  local_.tables.book.set_links(number, {}, {});
  dangling_.remove(name);
  if (local_.tables.windows.contains(number)) local_.tables.windows.leave(number);
  (void)motion_.remove(local_.roster[number].in_motion);
  local_.roster.remove(name, number);
  local_.bodies().remove(number);
}

}  // namespace kinesphere
