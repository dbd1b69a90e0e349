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

#include "engine/island.hpp"

namespace kinesphere {

void Island::rest(std::uint32_t number) {
  Body& body = bodies()[number];
  if (body.is_resting()) return;
  const MotionLimits limits = motion_limits_of(bodies().definition_of(number));
  const bool known = body.bound.time == time_;
  if (!known) bodies().change_of(number).kicked_to = Vec3{};
  bodies().rests.add(body, {number, limits});
  if (known) body.stand_still();
  if (bodies().definition().contacts == ContactMode::impacts) book().release_all(number);
  void_facts(number);
}

/// The body is awake: from here, without velocity, with the limits that it had. If there has been no report
/// since it rests, the change that waits for one tells all that.
void Island::resume(std::uint32_t number) {
  Body& body = bodies()[number];
  const bool known = body.is_at_rest();
  const BodyDefinition definition = bodies().definition_of(number);
  bodies().rests.remove(bodies(), number);
  if (known) body.bound = bound_of(definition, {body.bound.position, {}}, time_);
}

/// The same, and the caller will be told.
void Island::rouse(std::uint32_t number) {
  resume(number);
  void_facts(number);
  const Sphere now = sphere(number);
  instant_.tell({.kind = EventKind::woken,
                 .time = time_,
                 .first = now.id,
                 .first_state = {now.state.position, {}},
                 .point = now.state.position,
                 .first_user_data = now.user_data});
}

/// The body, if it rests, and all resting bodies in touch with it, with those, and so on.
void Island::wake(std::uint32_t number) {
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

/// Something has touched or left a body.
void Island::wake_by(const Event& event) {
  if (event.kind != EventKind::contact_begin && event.kind != EventKind::contact_end) return;
  for (const BodyId id : {event.first, event.second})
    if (bodies().table().is_alive(id) && bodies()[id.index].is_resting()) wake(id.index);
}

std::vector<std::uint32_t> Island::resting_in_touch(std::uint32_t number) const {
  std::vector<std::uint32_t> found;
  if (!bodies()[number].present()) return found;
  const double apart = book().rule().release_gap();
  const Vec3 room = Vec3{1.0, 1.0, 1.0} * apart;
  const Extent own = extent_of(bodies(), number);
  const Box box = box_now(bodies(), own, time_);
  for (const std::uint32_t other : bodies_in({box.lower - room, box.upper + room})) {
    if (other != number && bodies()[other].is_resting() && bodies().may_touch(number, other) &&
        gap_at(bodies(), time_, own, extent_of(bodies(), other)).lower <= apart)
      found.push_back(other);
  }
  return found;
}

}  // namespace kinesphere
