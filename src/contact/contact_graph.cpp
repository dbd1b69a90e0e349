#include "contact/contact_graph.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace kinesphere {

void ContactGraph::add(std::uint32_t body, double largest_acceleration) {
  rate_.add(body, rule_.zeno_interval(largest_acceleration));
  if (body >= flags_.size()) flags_.resize(body + std::size_t{1});
  flags_[body] = {};
  if (body < partners_.size()) partners_[body].clear();
  overlaps_.clear(body);
}

ContactState ContactGraph::wall_state(std::uint32_t body, Wall wall) const {
  const Flags& flags = flags_[body];
  const unsigned index = static_cast<unsigned>(wall) - 1u;
  return {.approach = static_cast<ApproachState>((flags.wall_approaches >> (2u * index)) & 3u),
          .jams = flags.wall_jams,
          .guard_reported = (flags.wall_guards & wall_bit(wall)) != 0};
}

void ContactGraph::set_wall_state(std::uint32_t body, Wall wall, bool touching, const ContactState& state) {
  Flags& flags = flags_[body];
  const unsigned shift = 2u * (static_cast<unsigned>(wall) - 1u);
  const auto with_bit = [wall](std::uint8_t set, bool on) {
    return static_cast<std::uint8_t>(on ? set | wall_bit(wall) : set & ~wall_bit(wall));
  };
  flags.walls = with_bit(flags.walls, touching);
  flags.wall_guards = with_bit(flags.wall_guards, state.guard_reported);
  flags.wall_jams = flags.walls == 0 ? std::uint8_t{0} : state.jams;
  flags.wall_approaches = static_cast<std::uint16_t>((flags.wall_approaches & ~(3u << shift)) |
                                                     (static_cast<unsigned>(state.approach) << shift));
}

void ContactGraph::set_touching(const Event& contact, bool touching) {
  const std::uint32_t a = number_of(contact.first);
  if (contact.wall != Wall::none)
    return set_wall_state(a, contact.wall, touching, touching ? wall_state(a, contact.wall) : ContactState{});
  const std::uint32_t b = number_of(contact.second);
  if (is_of_sensor(contact.kind)) {
    set_overlap(a, b, contact, touching);
    set_overlap(b, a, contact, touching);
    pairs_.set_turned(a, b, std::nullopt);
  } else {
    const ContactState* const known = contact_of(a, b);
    const ContactState state = known ? *known : ContactState{};
    set_half(a, b, touching ? &state : nullptr);
    set_half(b, a, touching ? &state : nullptr);
  }
}

void ContactGraph::turn_back(const Event& crossing) {
  set_touching(crossing, crossing.kind == EventKind::sensor_leave);
  pairs_.set_turned(number_of(crossing.first), number_of(crossing.second), crossing.distance);
}

void ContactGraph::set_state(const Event& contact, const ContactState& state) {
  const std::uint32_t a = number_of(contact.first);
  if (contact.wall != Wall::none) return set_wall_state(a, contact.wall, true, state);
  const std::uint32_t b = number_of(contact.second);
  set_half(a, b, &state);
  set_half(b, a, &state);
}

/// Sets the state of `partner` in the list of `body` only; nullptr removes it. Lists of static bodies have no
/// states.
void ContactGraph::set_half(std::uint32_t body, std::uint32_t partner, const ContactState* state) {
  const bool is_static = flags_[body].is_static();
  if (state != nullptr) {
    if (body >= partners_.size()) partners_.resize(body + std::size_t{1});
    partners_[body].set({partner, is_static ? ContactState{} : *state});
  } else if (body < partners_.size()) {
    partners_[body].erase(partner);
  }
}

/// Adds or removes an overlap in the list of `body` only.
void ContactGraph::set_overlap(std::uint32_t body, std::uint32_t partner, const Event& overlap, bool within) {
  const OverlapRecord record{partner, overlap.distance, overlap.senses};
  if (within) {
    overlaps_.add(body, record);
  } else {
    overlaps_.erase(body, record);
  }
}

void ContactGraph::turn_approaches(std::uint32_t body) {
  if (flags_[body].walls != 0) {
    for (const Wall wall : walls) {
      ContactState state = wall_state(body, wall);
      if (!touches_wall(body, wall) || state.approach != ApproachState::reported) continue;
      state.approach = ApproachState::turned;
      set_wall_state(body, wall, true, state);
    }
  }
  for (const ContactRecord& record : partners_of(body)) {
    ContactState state = flags_[body].is_static() ? *contact_of(body, record.partner) : record.state;
    if (state.approach != ApproachState::reported) continue;
    state.approach = ApproachState::turned;
    set_half(body, record.partner, &state);
    set_half(record.partner, body, &state);
  }
}

void ContactGraph::set_links(std::uint32_t body, std::span<const ContactRecord> partners,
                             std::vector<OverlapRecord> overlaps) {
  if (partners_.size() < flags_.size()) partners_.resize(flags_.size());
  for (const ContactRecord& before : partners_[body].all()) partners_[before.partner].erase(body);
  partners_[body].clear();
  for (const auto& [partner, state] : partners) {
    set_half(body, partner, &state);
    set_half(partner, body, &state);
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

/// Returns the bodies of the event whose contact rate counts it: all but those with shapes, which many bodies
/// may hit at one time; of two with shapes, those that move. The result refers to `buffer`.
std::span<const std::uint32_t> ContactGraph::counting(const Event& contact,
                                                      std::array<std::uint32_t, 2>& buffer) const {
  std::size_t count = 0;
  for (const BodyId id : {contact.first, contact.second})
    if (id != no_body && flags_[number_of(id)].form == Form::ball) buffer[count++] = number_of(id);
  if (count > 0) [[likely]]
    return std::span(buffer).first(count);
  for (const BodyId id : {contact.first, contact.second})
    if (id != no_body && flags_[number_of(id)].form == Form::carried_shape) buffer[count++] = number_of(id);
  return std::span(buffer).first(count);
}

bool ContactGraph::is_jammed(const Event& current) const {
  std::array<std::uint32_t, 2> buffer{};
  return rate_.is_jammed(counting(current, buffer), current.time);
}

void ContactGraph::note_contact(Event& begin, double acceleration) {
  std::array<std::uint32_t, 2> buffer{};
  const auto [repeated, jammed] =
      rate_.note(counting(begin, buffer), {begin.time, begin.approach_speed, acceleration}, rule_);
  begin.repeated = repeated;
  begin.jammed = jammed;
}

ContactGraph::Jam ContactGraph::note_jam(const Event& current, const Threshold& threshold, bool is_deep) {
  // The first jams may end by themselves: a long chain of touching bodies takes more contacts at an instant
  // than one body may have.
  constexpr std::uint8_t last = 9;
  ContactState state = threshold.within ? threshold.state : ContactState{};
  const bool is_defied = state.jams > 0;
  if (is_defied && state.jams < last) ++state.jams;
  std::array<std::uint32_t, 2> buffer{};
  const std::span<const std::uint32_t> bodies = counting(current, buffer);
  const bool is_crushed = rate_.is_crushed(bodies);
  if (is_crushed) rate_.end_crush(bodies);
  const bool is_last = is_crushed || (is_defied && (is_deep || state.jams == last));
  const Jam jam{is_last, is_last || (is_deep && !state.guard_reported)};
  state.approach = is_last ? ApproachState::ignored : ApproachState::watched;
  state.guard_reported = state.guard_reported || jam.is_news;
  set_state(current, state);
  return jam;
}

bool ContactGraph::contacts_are_valid(const std::optional<Box>& box) const {
  // Pseudo-distance that marks a contact among the sensor overlaps.
  constexpr double contact = -1.0;
  using Link = std::tuple<std::uint32_t, std::uint32_t, double, Senses, ApproachState, std::uint8_t, bool>;
  std::vector<Link> there;
  std::vector<Link> back;
  for (std::uint32_t body = 0; body < flags_.size(); ++body) {
    std::uint8_t standing = 0;
    for (const Wall wall : walls)
      if (box && stands(*box, wall)) standing = static_cast<std::uint8_t>(standing | wall_bit(wall));
    if ((flags_[body].walls & ~standing) != 0) return false;
    for (const auto& [partner, state] : partners_of(body)) {
      if (!state.is_valid() || partner >= flags_.size()) return false;
      const bool has_state = !flags_[body].is_static() && !flags_[partner].is_static();
      const auto [approach, jams, guard_reported] = has_state ? state : ContactState{};
      there.emplace_back(body, partner, contact, Senses::neither, approach, jams, guard_reported);
      back.emplace_back(partner, body, contact, Senses::neither, approach, jams, guard_reported);
    }
    for (const OverlapRecord& overlap : overlaps_of(body)) {
      if (!(overlap.distance >= 0.0) || !(overlap.senses <= Senses::both)) return false;
      there.emplace_back(body, overlap.partner, overlap.distance, overlap.senses, ApproachState{}, 0, false);
      back.emplace_back(overlap.partner, body, overlap.distance, overlap.senses, ApproachState{}, 0, false);
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
         partners_.size() <= bodies && overlaps_.size() <= bodies && contacts_are_valid(box) &&
         pairs_.is_valid(bodies);
}

}  // namespace kinesphere
