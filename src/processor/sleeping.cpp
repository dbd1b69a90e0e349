#include "processor/sleeping.hpp"

#include "processor/bodies_in.hpp"
#include "processor/event_processor.hpp"

namespace kinesphere {

void Sleeping::sleep(std::uint32_t number) {
  Body& body = bodies()[number];
  if (body.is_sleeping()) return;
  const MotionLimits limits = motion_limits_of(bodies().definition_of(number));
  // A body with a velocity in a report of now stops; the next advance asks whether it does.
  const bool known = body.fresh(processor_.time()) && body.bound.velocity == Vec3{};
  if (!known) bodies().change_of(number).velocity = Vec3{};
  if (body.bound.time == processor_.time()) body.bound.velocity = {};
  bodies().sleep_records.add(body, number).limits = limits;
  if (known) body.stand_still();
  state_.contacts.turn_reported(number);
  processor_.events().drop_woken(bodies().id_of(number));
  processor_.invalidate(number);
}

/// If there has been no report since the body fell asleep, the pending change contains the velocity and the
/// limits.
void Sleeping::resume(std::uint32_t number) {
  Body& body = bodies()[number];
  const bool known = body.is_at_rest();
  const BodyDefinition definition = bodies().definition_of(number);
  bodies().sleep_records.remove(bodies(), number);
  if (known) body.bound = bound_of(definition, {body.bound.position, {}}, processor_.time());
}

/// Wakes the body as resume() does, and queues an event EventKind::woke.
void Sleeping::wake_one(std::uint32_t number) {
  resume(number);
  processor_.invalidate(number);
  processor_.events().queue_first(
      woke_event(processor_.time(), sphere_at(bodies(), processor_.time(), number)));
}

void Sleeping::wake(std::uint32_t number) {
  if (bodies().sleep_records.empty()) return;
  std::vector<std::uint32_t> island = sleeping_in_touch(number);
  if (bodies()[number].is_sleeping()) wake_one(number);
  while (!island.empty()) {
    const std::uint32_t next = island.back();
    island.pop_back();
    if (!bodies()[next].is_sleeping()) continue;
    const auto further = sleeping_in_touch(next);
    island.insert(island.end(), further.begin(), further.end());
    wake_one(next);
  }
}

void Sleeping::wake_by(Event& event) {
  if (event.kind != EventKind::contact_begin && event.kind != EventKind::contact_end) return;
  event.first_traits.is_sleeping = event.second_traits.is_sleeping = false;
  for (const BodyId id : {event.first, event.second})
    if (bodies().table().is_alive(id) && bodies()[id.index].is_sleeping()) wake(id.index);
}

std::vector<std::uint32_t> Sleeping::sleeping_in_touch(std::uint32_t number) const {
  std::vector<std::uint32_t> found;
  if (!bodies()[number].present()) return found;
  const double apart = state_.contacts.rule().release_gap();
  const Vec3 margin = Vec3{1.0, 1.0, 1.0} * apart;
  const CollisionShape own = collision_shape_of(bodies(), number);
  const Box box = box_now(bodies(), own, processor_.time());
  for (const std::uint32_t other :
       bodies_in({box.lower - margin, box.upper + margin}, state_, processor_.dirty())) {
    if (other != number && bodies()[other].is_sleeping() && bodies().may_touch(number, other) &&
        gap_at(bodies(), processor_.time(), own, collision_shape_of(bodies(), other)).lower <= apart)
      found.push_back(other);
  }
  return found;
}

}  // namespace kinesphere
