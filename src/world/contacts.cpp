// Contacts: what an event says, and when it is delivered.
#include <algorithm>
#include <tuple>

#include "world/engine.hpp"

namespace kinesphere {

HalfSpace half_space(const Box& box, Wall wall) {
  const int index = static_cast<int>(wall) - 1;
  const int axis = index / 2;
  const bool upper = index % 2 == 1;
  HalfSpace inside;
  inside.normal[axis] = upper ? -1.0 : 1.0;
  inside.offset = upper ? -box.upper[axis] : box.lower[axis];
  return inside;
}

Event World::Engine::contact(EventKind kind, std::uint32_t a, std::uint32_t b) const {
  const auto [first, second] = std::minmax(a, b);
  const Bound& one = bodies_[first].bound;
  const Bound& two = bodies_[second].bound;
  Event event{.kind = kind, .time = time_, .first = id_of(first), .second = id_of(second)};
  event.first_state = {one.centre_at(time_), one.velocity_at(time_)};
  event.second_state = {two.centre_at(time_), two.velocity_at(time_)};
  const Vec3 difference = event.second_state.position - event.first_state.position;
  const double distance = norm(difference);
  event.normal = distance > 0.0 ? difference / distance : Vec3{1.0, 0.0, 0.0};
  event.gap = distance - (one.radius + two.radius);
  event.approach_speed = dot(event.normal, event.first_state.velocity - event.second_state.velocity);
  event.point = event.first_state.position + event.normal * (one.radius + 0.5 * event.gap);
  return event;
}

Event World::Engine::wall_contact(EventKind kind, std::uint32_t number, Wall wall) const {
  const Bound& bound = bodies_[number].bound;
  const HalfSpace inside = half_space(*definition_.box, wall);
  Event event{.kind = kind, .time = time_, .first = id_of(number), .wall = wall};
  event.first_state = {bound.centre_at(time_), bound.velocity_at(time_)};
  event.normal = -inside.normal;
  const double distance = dot(inside.normal, event.first_state.position) - inside.offset;
  event.gap = distance - bound.radius;
  event.approach_speed = dot(event.normal, event.first_state.velocity);
  event.point = event.first_state.position + event.normal * distance;
  return event;
}

bool World::Engine::is_touching(std::uint32_t a, std::uint32_t b) const {
  const auto& partners = bodies_[a].touching;
  return std::find(partners.begin(), partners.end(), b) != partners.end();
}

/// What either body watches of the other concerns the old state.
void World::Engine::set_touching(std::uint32_t a, std::uint32_t b, bool touching) {
  unwatch(a, b);
  unwatch(b, a);
  if (touching) {
    bodies_[a].touching.push_back(b);
    bodies_[b].touching.push_back(a);
  } else {
    std::erase(bodies_[a].touching, b);
    std::erase(bodies_[b].touching, a);
  }
}

/// The body touches nothing any more, and nobody is told.
void World::Engine::release_all(std::uint32_t number) {
  while (!bodies_[number].touching.empty()) set_touching(number, bodies_[number].touching.back(), false);
  bodies_[number].touching_walls = 0;
}

namespace {

auto delivery_order(const Event& event) {
  return std::tie(event.kind, event.first, event.second, event.wall);
}

}  // namespace

/// Queues an event of this instant; the same event is not queued twice.
void World::Engine::announce(Event&& event) {
  const auto same = [&](const Event& other) { return delivery_order(other) == delivery_order(event); };
  if (std::none_of(pending_.begin(), pending_.end(), same)) pending_.push_back(std::move(event));
}

/// The next event of this instant that still holds after what the caller did at the ones before it.
std::optional<Event> World::Engine::deliver() {
  while (!pending_.empty()) {
    const auto next = std::min_element(pending_.begin(), pending_.end(), [](const Event& a, const Event& b) {
      return delivery_order(a) < delivery_order(b);
    });
    Event event = *next;
    pending_.erase(next);
    if (!still_holds(event)) continue;
    take_effect(event);
    ++counters_.events[static_cast<std::size_t>(event.kind)];
    return event;
  }
  return std::nullopt;
}

bool World::Engine::still_holds(const Event& event) const {
  const auto lives = [this](BodyId id) { return id == no_body || id == id_of(id.index); };
  const bool all_live = lives(event.first) && lives(event.second);
  switch (event.kind) {
    case EventKind::contact_begin: {
      if (!all_live) return false;
      const Event now = contact(event.kind, event.first.index, event.second.index);
      return rule_.decide(false, now.gap, now.approach_speed) == ContactRule::Change::begin;
    }
    case EventKind::wall_begin: {
      if (!all_live) return false;
      const Event now = wall_contact(event.kind, event.first.index, event.wall);
      return rule_.decide(false, now.gap, now.approach_speed) == ContactRule::Change::begin;
    }
    default:
      return true;
  }
}

/// Changes the contact's state and brings the event up to date with kicks of this instant.
void World::Engine::take_effect(Event& event) {
  const std::uint32_t first = event.first.index;
  const std::uint32_t second = event.second.index;
  switch (event.kind) {
    case EventKind::contact_begin: {
      event = contact(event.kind, first, second);
      const bool first_repeated = note_contact(first);
      const bool second_repeated = note_contact(second);
      event.repeated = first_repeated || second_repeated;
      set_touching(first, second, true);
      changed_.emplace_back(first, second);
      break;
    }
    case EventKind::wall_begin:
      event = wall_contact(event.kind, first, event.wall);
      event.repeated = note_contact(first);
      bodies_[first].touching_walls |= wall_bit(event.wall);
      changed_.emplace_back(first, first);
      break;
    case EventKind::contact_end:
      if (id_of(first) != event.first || id_of(second) != event.second) break;
      event = contact(event.kind, first, second);
      set_touching(first, second, false);
      changed_.emplace_back(first, second);
      break;
    case EventKind::wall_end:
      if (id_of(first) != event.first) break;
      event = wall_contact(event.kind, first, event.wall);
      bodies_[first].touching_walls &= static_cast<std::uint8_t>(~wall_bit(event.wall));
      changed_.emplace_back(first, first);
      break;
    case EventKind::bound_violation:
    case EventKind::zeno_guard:
      break;
  }
}

/// Notes that the body touches something now; true when the last time was less than its Zeno interval ago.
bool World::Engine::note_contact(std::uint32_t number) {
  Body& body = bodies_[number];
  const bool repeated = time_ - body.last_contact < rule_.zeno_interval(body.largest_acceleration());
  body.last_contact = time_;
  if (repeated) ++counters_.repeated_contacts;
  return repeated;
}

}  // namespace kinesphere
