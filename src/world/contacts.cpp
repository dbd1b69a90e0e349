// Contacts: what an event says, and when it is delivered.
#include "world/engine.hpp"

namespace kinesphere {

Sphere World::Engine::sphere(std::uint32_t number) const {
  const Bound& bound = bodies_[number].bound;
  Sphere sphere{id_of(number),
                bound.radius,
                {bound.centre_at(time_), bound.velocity_at(time_)},
                shapes_.empty() ? nullptr : extent(number).shape,
                bodies_[number].user_data};
  if (space_.repeats()) sphere.state.position = space_.wrapped(sphere.state.position).position;
  return sphere;
}

Event World::Engine::contact(EventKind kind, std::uint32_t a, std::uint32_t b) const {
  return contact_event(kind, time_, sphere(a), sphere(b), space_);
}

Event World::Engine::wall_contact(EventKind kind, std::uint32_t number, Wall wall) const {
  return wall_event(kind, time_, sphere(number), *walls_, wall);
}

/// Who senses the other at the distance of this event now.
Senses World::Engine::senses_in(const Event& event) const {
  const Sensing first = sensing_of(event.first.index);
  const Sensing second = sensing_of(event.second.index);
  const bool by_first = sensors_.senses_one_way(first, second, event.distance);
  const bool by_second = sensors_.senses_one_way(second, first, event.distance);
  if (by_first && by_second) return Senses::both;
  return by_first ? Senses::first : by_second ? Senses::second : Senses::neither;
}

std::optional<Event> World::Engine::deliver() {
  std::optional<Event> event =
      book_.deliver([this](BodyId id) { return id == id_of(id.index) && bodies_[id.index].present(); },
                    [this](std::uint32_t number) { return sphere(number); },
                    [this](const Event& enter) { return senses_in(enter); }, walls_);
  if (!event) return event;
  // Of events that a snapshot held, ids have lost their tags.
  event->first.world = tag_;
  if (event->second != no_body) event->second.world = tag_;
  ++counters_.events[static_cast<std::size_t>(event->kind)];
  if (!rests_.empty()) wake_by(*event);
  if (event->repeated) ++counters_.repeated_contacts;
  return event;
}

}  // namespace kinesphere
