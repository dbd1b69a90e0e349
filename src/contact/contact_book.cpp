#include "contact/contact_book.hpp"

#include <algorithm>
#include <tuple>

namespace kinesphere {

void ContactBook::add(std::uint32_t body, double largest_acceleration) {
  recent_.add(body, rule_.zeno_interval(largest_acceleration));
  if (body >= flags_.size()) flags_.resize(body + std::size_t{1});
  flags_[body] = {};
  if (body < partners_.size()) partners_[body].clear();
  crossings_.clear(body);
}

bool ContactBook::touch(std::uint32_t a, std::uint32_t b) const {
  if (flags_[a].fixed) std::swap(a, b);
  const auto partners = partners_of(a);
  return std::find(partners.begin(), partners.end(), b) != partners.end();
}

void ContactBook::set_touching(const Event& contact, bool touching) {
  const std::uint32_t a = number_of(contact.first);
  const std::uint32_t b = number_of(contact.second);
  if (contact.wall != Wall::none) {
    std::uint8_t& set = flags_[a].walls;
    const std::uint8_t bit = wall_bit(contact.wall);
    set = static_cast<std::uint8_t>(touching ? set | bit : set & ~bit);
  } else {
    set_half(a, b, contact, touching);
    set_half(b, a, contact, touching);
  }
}

/// In the list of the first one.
void ContactBook::set_half(std::uint32_t body, std::uint32_t partner, const Event& contact, bool touching) {
  if (fixed_wait_ && flags_[body].fixed) return;
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
  flags_[body].walls = 0;
  if (body >= partners_.size()) return;
  for (const std::uint32_t partner : partners_of(body))
    if (!(fixed_wait_ && flags_[partner].fixed)) partners_[partner].erase(body);
  partners_[body].clear();
}

void ContactBook::set_links(std::uint32_t body, std::span<const std::uint32_t> partners,
                            std::vector<Crossing> crossings) {
  if (partners_.size() < flags_.size()) partners_.resize(flags_.size());
  for (const std::uint32_t before : partners_[body].all()) partners_[before].erase(body);
  partners_[body].clear();
  for (const std::uint32_t partner : partners) {
    partners_[body].add(partner);
    partners_[partner].add(body);
  }
  if (crossings.empty() && crossings_.of(body).empty()) return;
  crossings_.make_lists(flags_.size());
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
  if (partners_.size() < flags_.size()) partners_.resize(flags_.size());
  if (with_sensors) crossings_.make_lists(flags_.size());
}

/// The numbers of those bodies of a contact that count it: a body that does not move may be hit by many at
/// once.
std::span<const std::uint32_t> ContactBook::counting(const Event& contact,
                                                     std::array<std::uint32_t, 2>& room) const {
  std::size_t count = 0;
  for (const BodyId id : {contact.first, contact.second})
    if (id != no_body && !flags_[number_of(id)].fixed) room[count++] = number_of(id);
  return std::span(room).first(count);
}

bool ContactBook::is_jammed(const Event& current) const {
  std::array<std::uint32_t, 2> room{};
  return recent_.is_jammed(counting(current, room), current.time);
}

void ContactBook::note_contact(Event& begin) {
  std::array<std::uint32_t, 2> room{};
  const auto [repeated, jammed] = recent_.note(counting(begin, room), begin.time);
  begin.repeated = repeated;
  begin.jammed = jammed;
}

bool ContactBook::contacts_are_sound(const std::optional<Box>& box) const {
  // A contact as a crossing of its own.
  constexpr double contact = -1.0;
  std::vector<std::tuple<std::uint32_t, std::uint32_t, double, Senses>> there;
  std::vector<std::tuple<std::uint32_t, std::uint32_t, double, Senses>> back;
  for (std::uint32_t body = 0; body < flags_.size(); ++body) {
    std::uint8_t standing = 0;
    for (const Wall wall : walls)
      if (box && stands(*box, wall)) standing = static_cast<std::uint8_t>(standing | wall_bit(wall));
    if ((flags_[body].walls & ~standing) != 0) return false;
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
  return flags_.size() == bodies && recent_.size() == bodies && recent_.is_sound() &&
         partners_.size() <= bodies && crossings_.size() <= bodies && contacts_are_sound(box);
}

}  // namespace kinesphere
