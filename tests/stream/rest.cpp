// Sleeping bodies: what must wake them, what must not, and which events report it.
//
// Touch is measured from the true places: a body must wake if its true gap is small enough, and may wake if
// the bounds leave that open.
#include <algorithm>

#include "contact/contact_rule.hpp"
#include "stream/on_world.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream {
namespace {

bool contains(const std::vector<BodyId>& ids, BodyId id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

/// Returns true if the sleeping body is in touch with the other, certainly or perhaps.
bool Player::in_touch(BodyId id, BodyId resting, bool certainly) const {
  const TrueBody& body = truth_.at(id);
  if (id == resting || !body.present() || !truth_.may_touch(id, body.definition, resting)) return false;
  const ContactRule rule(truth_.definition());
  const double slack = told_.slack();
  if (certainly) {
    const Contact contact = id.index < resting.index ? Contact{id, resting} : Contact{resting, id};
    return truth_.gap(contact) <= rule.release_gap() - slack;
  }
  const BodyView view = world_.body(id).value();
  const Bound& bound = view.bound;
  const Bound bound_of_other = world_.body(resting).value().bound;
  const CollisionShape extent{bound, body.fixed, body.shape ? &*body.shape : nullptr};
  double least = truth_.limits(extent, {bound_of_other}).lower;
  if (body.rigid) {
    // The bounds of its points leave the ball around it.
    const double spin = std::max(body.rigid->spin(), norm(view.rigid->rotation.angular_velocity));
    const double since = truth_.time() - bound.time;
    least -=
        (body.rigid->angular_acceleration_limit + 2.0 * spin * spin) * body.definition.radius * since * since;
  }
  return least <= rule.release_gap() + slack;
}

/// Returns the body itself, if it sleeps, the sleeping bodies in touch with it, those in touch with them, and
/// so on.
std::vector<BodyId> Player::resting_with(BodyId id, bool certainly) const {
  std::vector<BodyId> reached{id};
  for (std::size_t k = 0; k < reached.size(); ++k)
    for (const TrueBody& body : truth_.bodies())
      if (body.alive && body.resting && !contains(reached, body.id) &&
          in_touch(reached[k], body.id, certainly))
        reached.push_back(body.id);
  if (!truth_.at(id).resting) reached.erase(reached.begin());
  return reached;
}

void Player::EventProcessor::join(const EventProcessor& other) {
  has_to_wake.insert(has_to_wake.end(), other.has_to_wake.begin(), other.has_to_wake.end());
  may_wake.insert(may_wake.end(), other.may_wake.begin(), other.may_wake.end());
}

/// Returns the bodies that an action on this body must wake.
Player::EventProcessor Player::island_of(BodyId id) const {
  const bool any = std::any_of(truth_.bodies().begin(), truth_.bodies().end(),
                               [](const TrueBody& body) { return body.alive && body.resting; });
  return any ? EventProcessor{resting_with(id, true), resting_with(id, false)} : EventProcessor{};
}

/// Returns the island of a sleeping body; empty for an awake one.
Player::EventProcessor Player::island_if_resting(BodyId id) const {
  return truth_.at(id).resting ? island_of(id) : EventProcessor{};
}

/// Checks that exactly the island has woken.
void Player::check_woken(const EventProcessor& island) {
  for (const BodyId id : truth_.ids()) {
    if (!truth_.at(id).resting) continue;
    const auto view = world_.body(id);
    if (view && view->sleeping) {
      require(!contains(island.has_to_wake, id), "a body in touch with one that wakes rests on");
      continue;
    }
    require(contains(island.may_wake, id), "a body that nothing has touched is awake");
    truth_.wake(id);
    // Removed and disabled bodies have no events.
    if (view && view->enabled) woken_.insert(id);
    changed();
  }
}

void Player::hear_woken(const Event& event) {
  require(woken_.erase(event.first) == 1, "an event reports as woken a body that did not sleep");
  require(event.second == no_body && event.wall == Wall::none, "a body is woken with another");
  require(event.first_state.velocity == Vec3{}, "a body that wakes moves");
  changed();
}

/// Wakes the bodies of the events of one contact.
void Player::wake_by(const Event& event) {
  EventProcessor island;
  if (event.kind == EventKind::contact_begin || event.kind == EventKind::contact_end)
    for (const BodyId id : {event.first, event.second})
      if (truth_.is_present(id)) island.join(island_if_resting(id));
  check_woken(island);
}

void Player::rest(BodyId id) {
  if (is_rigid(id)) return;
  const bool rested = truth_.at(id).resting;
  const auto done = on_world([&](World& world) { return world.sleep(id); });
  if (!done) throw Disagreement("rest: " + done.error().message);
  require(world_.body(id).value().sleeping, "a body does not rest");
  if (rested) return;
  woken_.erase(id);
  truth_.rest(id);
  told_.redirected(id);
  changed();
}

/// Puts one body to sleep, or it and all in contact with it.
void Player::rest(const Operation& operation) {
  if (kind_.crowd) return;
  const auto id = any_moving(operation);
  if (!id || !truth_.is_present(*id)) return;
  std::vector<BodyId> ids{*id};
  if (operation.byte(0) % 2 == 0)
    for (const BodyId other : truth_.ids())
      if (!truth_.at(other).fixed && truth_.is_present(other) && in_touch(*id, other, true))
        ids.push_back(other);
  for (const BodyId body : ids) rest(body);
}

void Player::wake(const Operation& operation) {
  const auto id = any_moving(operation);
  if (!id || !truth_.is_present(*id)) return;
  const auto done = waking(island_if_resting(*id), [&](World& world) { return world.wake(*id); });
  if (!done) throw Disagreement("wake: " + done.error().message);
}

}  // namespace kinesphere::stream
