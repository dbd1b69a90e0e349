#include "contact/contact_book.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace kinesphere {
namespace {

/// For one that was read.
bool is_sound(Senses senses) { return senses <= Senses::both; }

}  // namespace

void ContactBook::add(std::uint32_t body, double largest_acceleration) {
  if (body >= entries_.size()) entries_.resize(body + 1);
  entries_[body] = Entry();
  set_largest_acceleration(body, largest_acceleration);
  partners_.clear(body);
  crossings_.clear(body);
}

bool ContactBook::touch(std::uint32_t a, std::uint32_t b) const {
  const auto partners = partners_of(a);
  return std::find(partners.begin(), partners.end(), b) != partners.end();
}

/// What the sensor_enter of the same two and the same distance told.
Senses ContactBook::senses_of(const Event& leave) const {
  for (const Crossing& crossing : crossings_of(leave.first.index, leave.second.index))
    if (crossing.distance == leave.distance) return crossing.senses;
  return Senses::neither;
}

/// Of the bodies, or of the body and the wall, that the event names: their contact or a sensor distance.
void ContactBook::set_touching(const Event& contact, bool touching) {
  const std::uint32_t a = contact.first.index;
  const std::uint32_t b = contact.second.index;
  if (contact.wall != Wall::none) {
    std::uint8_t& set = entries_[a].walls;
    const std::uint8_t bit = wall_bit(contact.wall);
    set = static_cast<std::uint8_t>(touching ? set | bit : set & ~bit);
  } else if (is_of_sensor(contact.kind)) {
    const Crossing of_a{b, contact.distance, contact.senses};
    const Crossing of_b{a, contact.distance, contact.senses};
    if (touching) {
      crossings_.add(a, of_a);
      crossings_.add(b, of_b);
    } else {
      crossings_.erase(a, of_a);
      crossings_.erase(b, of_b);
    }
  } else if (touching) {
    partners_.add(a, b);
    partners_.add(b, a);
  } else {
    partners_.erase(a, b);
    partners_.erase(b, a);
  }
}

void ContactBook::release_all(std::uint32_t body) {
  for (const std::uint32_t partner : partners_of(body)) partners_.erase(partner, body);
  partners_.clear(body);
  entries_[body].walls = 0;
}

void ContactBook::end(const Event& contact) {
  set_touching(contact, false);
  // An end that had come by itself has not taken effect yet.
  pending_.erase(contact);
  if (is_of_sensor(contact.kind) || !rule_.impacts_only()) ended_.insert(contact);
}

void ContactBook::announce(const Event& event) {
  // A caller who kicks at a Zeno guard must not get the same one again at the same instant, for ever.
  if (!guards_told_.contains(event)) pending_.insert(event);
}

/// Changes the contact's state and brings the event up to date with kicks of this instant. False when it does
/// not hold any more.
bool ContactBook::take_effect(Event& event, const Sphere& first, const Sphere& second,
                              const std::optional<Box>& box) {
  if (event.kind == EventKind::zeno_guard) guards_told_.insert(event);
  if (event.kind == EventKind::zeno_guard || event.kind == EventKind::bound_violation) return true;
  const bool begins_now = begins(event.kind);
  if (event.wall != Wall::none) {
    describe(event, first, *box);
  } else {
    describe(event, first, second, space_);
  }
  if (begins_now && !still_begins(event, first, second)) return false;
  if (begins_now && !is_of_sensor(event.kind)) note_contact(event);
  set_touching(event, begins_now);
  changed_.emplace_back(first.id.index, second.id.index);
  return true;
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
    if (id == no_body || entries_[id.index].fixed) continue;
    const Entry& entry = entries_[id.index];
    least = std::min(least, entry.last_contact == contact.time ? std::uint32_t{entry.contacts_then} : 0);
  }
  return least;
}

/// Marks the begin of a contact if it is a repeated or a jammed one, and remembers it for the next.
void ContactBook::note_contact(Event& begin) {
  const bool pair = begin.second != no_body;
  begin.repeated = is_repeated(begin, begin.first.index) || (pair && is_repeated(begin, begin.second.index));
  begin.jammed = contacts_now(begin) >= many_at_one_instant;
  note_contact(begin.first.index, begin.time);
  if (pair) note_contact(begin.second.index, begin.time);
}

void ContactBook::note_contact(std::uint32_t body, double time) {
  Entry& entry = entries_[body];
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
      if (!(crossing.distance >= 0.0) || !kinesphere::is_sound(crossing.senses)) return false;
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

bool ContactBook::is_sound(std::size_t bodies, double time, const std::optional<Box>& box,
                           const std::function<bool(BodyId)>& is_known) const {
  const auto event_is_sound = [&](const Event& event) {
    const bool pair = is_known(event.second) && event.first < event.second && event.wall == Wall::none;
    const bool wall = event.second == no_body && event.wall != Wall::none &&
                      static_cast<int>(event.wall) <= wall_count && box && stands(*box, event.wall);
    if (event.time != time || !is_known(event.first)) return false;
    if (!kinesphere::is_sound(event.senses)) return false;
    switch (event.kind) {
      case EventKind::bound_violation:
      case EventKind::woken:
        return event.second == no_body && event.wall == Wall::none;
      case EventKind::contact_begin:
      case EventKind::contact_end:
        return pair;
      case EventKind::wall_begin:
      case EventKind::wall_end:
        return wall;
      case EventKind::zeno_guard:
        return pair || wall;
      case EventKind::sensor_enter:
      case EventKind::sensor_leave:
        return pair && event.distance >= 0.0;
    }
    return false;
  };
  const auto change_is_sound = [&](const auto& pair) { return pair.first < bodies && pair.second < bodies; };
  return entries_.size() == bodies && partners_.size() <= bodies && crossings_.size() <= bodies &&
         contacts_are_sound(box) && pending_.is_sound() && pending_.all_of(event_is_sound) &&
         std::all_of(ended_.begin(), ended_.end(), event_is_sound) &&
         std::all_of(guards_told_.begin(), guards_told_.end(), event_is_sound) &&
         std::all_of(changed_.begin(), changed_.end(), change_is_sound);
}

}  // namespace kinesphere
