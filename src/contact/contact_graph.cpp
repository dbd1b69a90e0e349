#include "contact/contact_graph.hpp"

#include <algorithm>
#include <tuple>

namespace kinesphere {

void ContactGraph::add(std::uint32_t body, double largest_acceleration) {
  rate_.add(body, rule_.zeno_interval(largest_acceleration));
  if (body >= flags_.size()) flags_.resize(body + std::size_t{1});
  flags_[body] = {};
  if (body < partners_.size()) partners_[body].clear();
  overlaps_.clear(body);
}

bool ContactGraph::touch(std::uint32_t a, std::uint32_t b) const {
  if (flags_[a].is_static) std::swap(a, b);
  const auto partners = partners_of(a);
  return std::find(partners.begin(), partners.end(), b) != partners.end();
}

void ContactGraph::set_touching(const Event& contact, bool touching) {
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

/// Adds or removes `partner` in the list of `body` only. Lists of static bodies stay unchanged while
/// statics_deferred_.
void ContactGraph::set_half(std::uint32_t body, std::uint32_t partner, const Event& contact, bool touching) {
  if (statics_deferred_ && flags_[body].is_static) return;
  if (is_of_sensor(contact.kind)) {
    const OverlapRecord overlap{partner, contact.distance, contact.senses};
    if (touching) {
      overlaps_.add(body, overlap);
    } else {
      overlaps_.erase(body, overlap);
    }
  } else if (touching) {
    if (body >= partners_.size()) partners_.resize(body + std::size_t{1});
    partners_[body].add(partner);
  } else if (body < partners_.size()) {
    partners_[body].erase(partner);
  }
}

void ContactGraph::release_all(std::uint32_t body) {
  flags_[body].walls = 0;
  if (body >= partners_.size()) return;
  for (const std::uint32_t partner : partners_of(body))
    if (!(statics_deferred_ && flags_[partner].is_static)) partners_[partner].erase(body);
  partners_[body].clear();
}

void ContactGraph::set_links(std::uint32_t body, std::span<const std::uint32_t> partners,
                             std::vector<OverlapRecord> overlaps) {
  if (partners_.size() < flags_.size()) partners_.resize(flags_.size());
  for (const std::uint32_t before : partners_[body].all()) partners_[before].erase(body);
  partners_[body].clear();
  for (const std::uint32_t partner : partners) {
    partners_[body].add(partner);
    partners_[partner].add(body);
  }
  if (overlaps.empty() && overlaps_.of(body).empty()) return;
  overlaps_.make_lists(flags_.size());
  for (const OverlapRecord& before : overlaps_.of(body))
    overlaps_.erase(before.partner, {body, before.distance, before.senses});
  std::sort(overlaps.begin(), overlaps.end());
  for (const OverlapRecord& overlap : overlaps)
    overlaps_.add(overlap.partner, {body, overlap.distance, overlap.senses});
  overlaps_.set(body, overlaps);
}

void ContactGraph::start_side_by_side(bool with_sensors) {
  statics_deferred_ = true;
  // Allocates every list now: threads read the outer vectors concurrently, so these must not grow later.
  if (partners_.size() < flags_.size()) partners_.resize(flags_.size());
  if (with_sensors) overlaps_.make_lists(flags_.size());
}

/// Returns the bodies of the event whose contact rate counts it: all but static ones, which many bodies may
/// hit at one time. The result refers to `buffer`.
std::span<const std::uint32_t> ContactGraph::counting(const Event& contact,
                                                      std::array<std::uint32_t, 2>& buffer) const {
  std::size_t count = 0;
  for (const BodyId id : {contact.first, contact.second})
    if (id != no_body && !flags_[number_of(id)].is_static) buffer[count++] = number_of(id);
  return std::span(buffer).first(count);
}

bool ContactGraph::is_jammed(const Event& current) const {
  std::array<std::uint32_t, 2> buffer{};
  return rate_.is_jammed(counting(current, buffer), current.time);
}

void ContactGraph::note_contact(Event& begin) {
  std::array<std::uint32_t, 2> buffer{};
  const auto [repeated, jammed] = rate_.note(counting(begin, buffer), begin.time);
  begin.repeated = repeated;
  begin.jammed = jammed;
}

bool ContactGraph::contacts_are_valid(const std::optional<Box>& box) const {
  // Pseudo-distance that marks a contact among the sensor overlaps.
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
    for (const OverlapRecord& overlap : overlaps_of(body)) {
      if (!(overlap.distance >= 0.0) || !(overlap.senses <= Senses::both)) return false;
      there.emplace_back(body, overlap.partner, overlap.distance, overlap.senses);
      back.emplace_back(overlap.partner, body, overlap.distance, overlap.senses);
    }
  }
  const auto impossible = [](const auto& pair) { return std::get<0>(pair) == std::get<1>(pair); };
  if (std::any_of(there.begin(), there.end(), impossible)) return false;
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  return there == back && std::adjacent_find(there.begin(), there.end()) == there.end();
}

bool ContactGraph::is_valid(std::size_t bodies, const std::optional<Box>& box) const {
  return flags_.size() == bodies && rate_.size() == bodies && rate_.is_valid() &&
         partners_.size() <= bodies && overlaps_.size() <= bodies && contacts_are_valid(box);
}

}  // namespace kinesphere
