#include "engine/rest.hpp"

#include "engine/bodies_in.hpp"
#include "engine/island.hpp"

namespace kinesphere {

void Resting::rest(std::uint32_t number) {
  Body& body = bodies()[number];
  if (body.is_resting()) return;
  const MotionLimits limits = motion_limits_of(bodies().definition_of(number));
  const bool known = body.bound.time == island_.time();
  if (!known) bodies().change_of(number).kicked_to = Vec3{};
  bodies().rests.add(body, {number, limits});
  if (known) body.stand_still();
  if (bodies().definition().contacts == ContactMode::impacts) tables_.book.release_all(number);
  island_.void_facts(number);
}

/// If there has been no report since it rests, the change that waits for one tells all that.
void Resting::resume(std::uint32_t number) {
  Body& body = bodies()[number];
  const bool known = body.is_at_rest();
  const BodyDefinition definition = bodies().definition_of(number);
  bodies().rests.remove(bodies(), number);
  if (known) body.bound = bound_of(definition, {body.bound.position, {}}, island_.time());
}

/// As resume(), and the caller will be told.
void Resting::rouse(std::uint32_t number) {
  resume(number);
  island_.void_facts(number);
  const Sphere now = sphere_at(bodies(), island_.time(), number);
  island_.instant().tell({.kind = EventKind::woken,
                          .time = island_.time(),
                          .first = now.id,
                          .first_state = {now.state.position, {}},
                          .point = now.state.position,
                          .first_user_data = now.user_data});
}

void Resting::wake(std::uint32_t number) {
  if (bodies().rests.empty()) return;
  std::vector<std::uint32_t> island = resting_in_touch(number);
  if (bodies()[number].is_resting()) rouse(number);
  while (!island.empty()) {
    const std::uint32_t next = island.back();
    island.pop_back();
    if (!bodies()[next].is_resting()) continue;
    const auto further = resting_in_touch(next);
    island.insert(island.end(), further.begin(), further.end());
    rouse(next);
  }
}

void Resting::wake_by(const Event& event) {
  if (event.kind != EventKind::contact_begin && event.kind != EventKind::contact_end) return;
  for (const BodyId id : {event.first, event.second})
    if (bodies().table().is_alive(id) && bodies()[id.index].is_resting()) wake(id.index);
}

std::vector<std::uint32_t> Resting::resting_in_touch(std::uint32_t number) const {
  std::vector<std::uint32_t> found;
  if (!bodies()[number].present()) return found;
  const double apart = tables_.book.rule().release_gap();
  const Vec3 room = Vec3{1.0, 1.0, 1.0} * apart;
  const Extent own = extent_of(bodies(), number);
  const Box box = box_now(bodies(), own, island_.time());
  for (const std::uint32_t other :
       bodies_in({box.lower - room, box.upper + room}, tables_, island_.unsettled(), island_.time())) {
    if (other != number && bodies()[other].is_resting() && bodies().may_touch(number, other) &&
        gap_at(bodies(), island_.time(), own, extent_of(bodies(), other)).lower <= apart)
      found.push_back(other);
  }
  return found;
}

}  // namespace kinesphere
