// Sleeping bodies: what must wake with others, what must not, and which events report it.
#include <algorithm>

#include "contact/contact_rule.hpp"
#include "kinesphere/certificates.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream {

/// Returns true if the two are in touch, certainly by their true places or perhaps by their bounds.
bool Player::in_touch(const Thing& a, const Thing& b, bool certainly) const {
  if (!truth_.meet(a, b) || !a.definition.solid || !b.definition.solid) return false;
  const double release = ContactRule(truth_.definition()).release_gap();
  const double errors = truth_.report_errors({a.id, b.id});
  if (certainly) return truth_.gap({a.id, b.id}, now()) <= release - truth_.slack() - errors;
  const World& world = world_;
  return world.certificates().distance_limits(a.id, b.id, now())->lower <= release + truth_.slack() + errors;
}

/// Notes the bodies that have woken. Those in touch with them must have woken, too; and, if these bodies were
/// touched where they are, no others than those in touch with them.
void Player::check_awake(const std::optional<std::vector<BodyId>>& touched) {
  std::vector<BodyId> woken;
  for (Thing& thing : truth_.things) {
    if (!thing.present() || !thing.sleeping || world_.body(thing.id)->sleeping) continue;
    thing.wake(now());
    woken.push_back(thing.id);
    rounds_ = 3;
  }
  woken_.insert(woken.begin(), woken.end());
  for (const BodyId id : woken) {
    const Thing& thing = truth_.at(id);
    for (const Thing& other : truth_.things)
      if (other.sleeping && in_touch(thing, other, true))
        throw Disagreement("a body in touch with one that wakes sleeps on");
    if (!touched || std::ranges::count(*touched, id) > 0) continue;
    const auto may_wake_it = [&](BodyId other) {
      return other != id && other != no_body && in_touch(thing, truth_.at(other), false);
    };
    if (std::ranges::none_of(*touched, may_wake_it) && std::ranges::none_of(woken, may_wake_it))
      throw Disagreement("a body that nothing has touched is awake");
  }
}

}  // namespace kinesphere::stream
