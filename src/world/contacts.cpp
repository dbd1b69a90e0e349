// Contacts: what an event says, and when it is delivered.
#include <algorithm>

#include "world/engine.hpp"

namespace kinesphere {

Sphere World::Engine::sphere(std::uint32_t number) const {
  const Bound& bound = bodies_[number].bound;
  return {id_of(number), bound.radius, {bound.centre_at(time_), bound.velocity_at(time_)}};
}

Event World::Engine::contact(EventKind kind, std::uint32_t a, std::uint32_t b) const {
  return contact_event(kind, time_, sphere(a), sphere(b));
}

Event World::Engine::wall_contact(EventKind kind, std::uint32_t number, Wall wall) const {
  return wall_event(kind, time_, sphere(number), *definition_.box, wall);
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

/// Queues an event of this instant; the same event is not queued twice.
void World::Engine::announce(const Event& event) {
  // A caller who kicks at a Zeno guard must not get the same one again at the same instant, for ever.
  if (!guards_told_.contains(event)) pending_.insert(event);
}

/// The next event of this instant that still holds after what the caller did at the ones before it.
std::optional<Event> World::Engine::deliver() {
  while (!pending_.empty()) {
    Event event = pending_.extract(pending_.begin()).value();
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
    case EventKind::contact_begin:
      event = contact(event.kind, first, second);
      note_contact(event);
      set_touching(first, second, true);
      changed_.emplace_back(first, second);
      break;
    case EventKind::wall_begin:
      event = wall_contact(event.kind, first, event.wall);
      note_contact(event);
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
    case EventKind::zeno_guard:
      guards_told_.insert(event);
      break;
    case EventKind::bound_violation:
      break;
  }
}

/// True when the body touched something less than its Zeno interval ago.
bool World::Engine::is_repeated(std::uint32_t number) const {
  const Body& body = bodies_[number];
  return time_ - body.last_contact < rule_.zeno_interval(body.largest_acceleration());
}

/// Marks the begin of a contact if it is a repeated one, and remembers it for the next.
void World::Engine::note_contact(Event& begin) {
  const bool pair = begin.second != no_body;
  begin.repeated = is_repeated(begin.first.index) || (pair && is_repeated(begin.second.index));
  if (begin.repeated) ++counters_.repeated_contacts;
  bodies_[begin.first.index].last_contact = time_;
  if (pair) bodies_[begin.second.index].last_contact = time_;
}

}  // namespace kinesphere
