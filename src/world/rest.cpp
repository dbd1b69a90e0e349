// Rest: bodies whose caller says that they stay where they are, and what wakes them.
//
// A body at rest has a bound that stands still, without velocity, plan, growth or limits. Everything else
// follows from that by the common rules: its report never becomes old, its window has no end, and neither
// have facts about it and others that stand still. What it promises once it is awake waits in a table of its
// own.
//
// Bodies in touch wake together. That is decided by their gaps now, not by the contacts in the book, which
// forgets bouncing bodies that do not approach; and by a search, to which bodies that were changed since the
// last advance are added.
#include <algorithm>

#include "world/engine.hpp"

namespace kinesphere {

void World::Engine::rest(BodyId id) {
  const std::uint32_t number = id.index;
  Body& body = bodies_[number];
  if (body.is_resting()) return;
  const MotionLimits limits = motion_limits_of(definition_of(number));
  const bool known = body.bound.time == time_;
  if (!known) change_of(number).kicked_to = Vec3{};
  body.rest_number = static_cast<std::uint32_t>(rests_.size());
  rests_.push_back({number, limits});
  if (known) stand_still(body);
  if (definition_.contacts == ContactMode::impacts) book_.release_all(number);
  void_facts(number);
}

void World::Engine::stand_still(Body& body) const {
  body.bound.velocity = {};
  body.bound.planned_acceleration = {};
  body.bound.growth_speed = 0.0;
  body.bound.growth_acceleration = 0.0;
}

/// The last one takes its place in the table.
void World::Engine::forget_rest(std::uint32_t number) {
  const std::uint32_t rest = bodies_[number].rest_number;
  if (rest == Body::none) return;
  bodies_[rests_.back().body].rest_number = rest;
  bodies_[number].rest_number = Body::none;
  rests_[rest] = rests_.back();
  rests_.pop_back();
}

/// The body is awake: from here, without velocity, with the limits that it had. If there has been no report
/// since it rests, the change that waits for one tells all that.
void World::Engine::resume(std::uint32_t number) {
  Body& body = bodies_[number];
  const bool known = body.is_at_rest();
  const BodyDefinition definition = definition_of(number);
  forget_rest(number);
  if (known) body.bound = bound_of(definition, {body.bound.position, {}}, time_);
}

/// The same, and the caller will be told.
void World::Engine::rouse(std::uint32_t number) {
  resume(number);
  void_facts(number);
  const Sphere now = sphere(number);
  book_.tell({.kind = EventKind::woken,
              .time = time_,
              .first = now.id,
              .first_state = {now.state.position, {}},
              .point = now.state.position,
              .first_user_data = now.user_data});
}

/// The body, if it rests, and all resting bodies in touch with it, with those, and so on.
void World::Engine::wake_island(std::uint32_t number) {
  if (rests_.empty()) return;
  std::vector<std::uint32_t> island = resting_in_touch(number);
  if (bodies_[number].is_resting()) rouse(number);
  while (!island.empty()) {
    const std::uint32_t next = island.back();
    island.pop_back();
    if (!bodies_[next].is_resting()) continue;
    const auto further = resting_in_touch(next);
    island.insert(island.end(), further.begin(), further.end());
    rouse(next);
  }
}

/// Something has touched or left a body.
void World::Engine::wake_by(const Event& event) {
  if (event.kind != EventKind::contact_begin && event.kind != EventKind::contact_end) return;
  for (const BodyId id : {event.first, event.second})
    if (is_alive(id) && bodies_[id.index].is_resting()) wake_island(id.index);
}

std::vector<std::uint32_t> World::Engine::resting_in_touch(std::uint32_t number) const {
  std::vector<std::uint32_t> found;
  if (!bodies_[number].present()) return found;
  const double apart = book_.rule().release_gap();
  const Vec3 room = Vec3{1.0, 1.0, 1.0} * apart;
  const Extent own = extent(number);
  const Box box = own.shape ? box_of(*own.shape) : box_now(own.bound);
  for (const std::uint32_t other : bodies_in({box.lower - room, box.upper + room})) {
    if (other != number && bodies_[other].is_resting() && may_touch(number, other) &&
        gap_now(own, extent(other)).lower <= apart)
      found.push_back(other);
  }
  return found;
}

}  // namespace kinesphere
