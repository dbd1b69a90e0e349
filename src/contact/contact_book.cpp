#include "contact/contact_book.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace kinesphere {

void ContactBook::add(std::uint32_t body, double largest_acceleration) {
  if (body >= entries_.size()) entries_.resize(body + 1);
  entries_[body] = Entry();
  set_largest_acceleration(body, largest_acceleration);
  if (body < partners_.size()) partners_[body].clear();
  crossings_.clear(body);
}

bool ContactBook::touch(std::uint32_t a, std::uint32_t b) const {
  if (entries_[a].fixed) std::swap(a, b);
  const auto partners = partners_of(a);
  return std::find(partners.begin(), partners.end(), b) != partners.end();
}

Senses ContactBook::senses_of(const Event& leave) const {
  for (const Crossing& crossing : crossings_of(number_of(leave.first), number_of(leave.second)))
    if (crossing.distance == leave.distance) return crossing.senses;
  return Senses::neither;
}

void ContactBook::set_touching(const Event& contact, bool touching) {
  const std::uint32_t a = number_of(contact.first);
  const std::uint32_t b = number_of(contact.second);
  if (contact.wall != Wall::none) {
    std::uint8_t& set = entries_[a].walls;
    const std::uint8_t bit = wall_bit(contact.wall);
    set = static_cast<std::uint8_t>(touching ? set | bit : set & ~bit);
  } else {
    set_half(a, b, contact, touching);
    set_half(b, a, contact, touching);
  }
}

/// In the list of the first one.
void ContactBook::set_half(std::uint32_t body, std::uint32_t partner, const Event& contact, bool touching) {
  if (fixed_wait_ && entries_[body].fixed) return;
  if (is_of_sensor(contact.kind)) {
    const Crossing crossing{partner, contact.distance, contact.senses};
    if (touching) {
      crossings_.add(body, crossing);
    } else {
      crossings_.erase(body, crossing);
    }
  } else if (touching) {
    if (body >= partners_.size()) partners_.resize(body + std::size_t{1});
    partners_[body].add(partner);
  } else if (body < partners_.size()) {
    partners_[body].erase(partner);
  }
}

void ContactBook::release_all(std::uint32_t body) {
  entries_[body].walls = 0;
  if (body >= partners_.size()) return;
  for (const std::uint32_t partner : partners_of(body))
    if (!(fixed_wait_ && entries_[partner].fixed)) partners_[partner].erase(body);
  partners_[body].clear();
}

void ContactBook::set_links(std::uint32_t body, std::span<const std::uint32_t> partners,
                            std::vector<Crossing> crossings) {
  if (partners_.size() < entries_.size()) partners_.resize(entries_.size());
  for (const std::uint32_t before : partners_[body].all()) partners_[before].erase(body);
  partners_[body].clear();
  for (const std::uint32_t partner : partners) {
    partners_[body].add(partner);
    partners_[partner].add(body);
  }
  if (crossings.empty() && crossings_.of(body).empty()) return;
  crossings_.make_lists(entries_.size());
  for (const Crossing& before : crossings_.of(body))
    crossings_.erase(before.partner, {body, before.distance, before.senses});
  std::sort(crossings.begin(), crossings.end());
  for (const Crossing& crossing : crossings)
    crossings_.add(crossing.partner, {body, crossing.distance, crossing.senses});
  crossings_.set(body, crossings);
}

void ContactBook::start_side_by_side(bool with_sensors) {
  fixed_wait_ = true;
  // No list may have to be made while others are read.
  if (partners_.size() < entries_.size()) partners_.resize(entries_.size());
  if (with_sensors) crossings_.make_lists(entries_.size());
}

ContactBook::Kept ContactBook::keep(std::uint32_t body) const {
  const Crossings::List crossed = crossings_of(body);
  return {entries_[body],
          body < partners_.size() ? partners_[body] : PartnerList(),
          {crossed.begin(), crossed.end()}};
}

void ContactBook::put_back(std::uint32_t body, const Kept& kept) {
  entries_[body] = kept.entry;
  if (body < partners_.size()) partners_[body] = kept.partners;
  crossings_.set(body, kept.crossings);
}

void ContactBook::put_back_alone(std::uint32_t body, const Kept& kept) { entries_[body] = kept.entry; }

void ContactBook::tell_fixed(std::uint32_t body, const Kept& before) {
  const auto missing = [](const auto& from, const auto& in) {
    auto found = std::vector(from.begin(), from.end());
    std::erase_if(found, [&](const auto& one) { return std::find(in.begin(), in.end(), one) != in.end(); });
    return found;
  };
  for (const std::uint32_t gone : missing(before.partners.all(), partners_of(body)))
    if (entries_[gone].fixed) partners_[gone].erase(body);
  for (const std::uint32_t come : missing(partners_of(body), before.partners.all()))
    if (entries_[come].fixed) partners_[come].add(body);
  for (const Crossing& gone : missing(before.crossings, crossings_of(body)))
    if (entries_[gone.partner].fixed) crossings_.erase(gone.partner, {body, gone.distance, gone.senses});
  for (const Crossing& come : missing(crossings_of(body), before.crossings))
    if (entries_[come.partner].fixed) crossings_.add(come.partner, {body, come.distance, come.senses});
}

void ContactBook::describe_now(Event& event, const Sphere& first, const Sphere& second,
                               const std::optional<Box>& box) const {
  if (event.wall != Wall::none) {
    describe(event, first, *box);
  } else {
    describe(event, first, second, space_);
  }
}

bool ContactBook::still_begins(const Event& now, const Sphere& first, const Sphere& second) const {
  const ContactRule& rule = is_of_sensor(now.kind) ? sensor_rule_ : rule_;
  return rule.decide(false, now.gap - now.distance, now.approach_speed, approach_error(now, first, second)) ==
         ContactRule::Change::begin;
}

/// True when the body touched something less than its Zeno interval ago.
bool ContactBook::is_repeated(const Event& begin, std::uint32_t body) const {
  return begin.time - entries_[body].last_contact < entries_[body].zeno_interval.value();
}

/// How many contacts of this instant each of the two has had at least. Walls and fixed bodies do not count:
/// they may be hit by many at once.
std::uint32_t ContactBook::contacts_now(const Event& contact) const {
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  for (const BodyId id : {contact.first, contact.second}) {
    if (id == no_body || entries_[number_of(id)].fixed) continue;
    const Entry& entry = entries_[number_of(id)];
    least = std::min(least, entry.last_contact == contact.time ? std::uint32_t{entry.contacts_then} : 0);
  }
  return least;
}

void ContactBook::note_contact(Event& begin) {
  const bool pair = begin.second != no_body;
  const std::uint32_t first = number_of(begin.first);
  const std::uint32_t second = number_of(begin.second);
  begin.repeated = is_repeated(begin, first) || (pair && is_repeated(begin, second));
  begin.jammed = contacts_now(begin) >= many_at_one_instant;
  note_contact(first, begin.time);
  if (pair) note_contact(second, begin.time);
}

void ContactBook::note_contact(std::uint32_t body, double time) {
  Entry& entry = entries_[body];
  if (entry.fixed) return;
  if (entry.last_contact != time) entry.contacts_then = 0;
  if (entry.contacts_then < most_at_one_instant) ++entry.contacts_then;
  entry.last_contact = time;
}

bool ContactBook::contacts_are_sound(const std::optional<Box>& box) const {
  // A contact as a crossing of its own.
  constexpr double contact = -1.0;
  std::vector<std::tuple<std::uint32_t, std::uint32_t, double, Senses>> there;
  std::vector<std::tuple<std::uint32_t, std::uint32_t, double, Senses>> back;
  for (std::uint32_t body = 0; body < entries_.size(); ++body) {
    const Entry& entry = entries_[body];
    if (std::isnan(entry.last_contact) || !(entry.zeno_interval.value() >= 0.0)) return false;
    std::uint8_t standing = 0;
    for (const Wall wall : walls)
      if (box && stands(*box, wall)) standing = static_cast<std::uint8_t>(standing | wall_bit(wall));
    if ((entry.walls & ~standing) != 0) return false;
    for (const std::uint32_t partner : partners_of(body)) {
      there.emplace_back(body, partner, contact, Senses::neither);
      back.emplace_back(partner, body, contact, Senses::neither);
    }
    for (const Crossing& crossing : crossings_of(body)) {
      if (!(crossing.distance >= 0.0) || !(crossing.senses <= Senses::both)) return false;
      there.emplace_back(body, crossing.partner, crossing.distance, crossing.senses);
      back.emplace_back(crossing.partner, body, crossing.distance, crossing.senses);
    }
  }
  const auto impossible = [](const auto& pair) { return std::get<0>(pair) == std::get<1>(pair); };
  if (std::any_of(there.begin(), there.end(), impossible)) return false;
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  return there == back && std::adjacent_find(there.begin(), there.end()) == there.end();
}

bool ContactBook::is_sound(std::size_t bodies, const std::optional<Box>& box) const {
  return entries_.size() == bodies && partners_.size() <= bodies && crossings_.size() <= bodies &&
         contacts_are_sound(box);
}

}  // namespace kinesphere
