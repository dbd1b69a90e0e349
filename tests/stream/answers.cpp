// Compares certified predictions with the truth: what they exclude does not happen while bodies go on as they
// do.
#include <utility>

#include "stream/player.hpp"

namespace kinesphere::stream {

/// Calls call(), and shrinks a ball that has grown too large for periodic space.
template <class Call>
void Player::while_there_is_room(Call call) {
  try {
    call();
  } catch (const BadResult& result) {
    if (result.error().argument != "radius" || !world_.contains(result.error().body)) throw;
    shrink(result.error().body);
  }
}

void Player::ask() {
  if (scenario().answers) while_there_is_room([this] { check_answers(); });
}

void Player::check_answers() {
  const std::vector<BodyId> ids = truth_.present();
  if (ids.size() < 2) return;
  const bool asks = draw_.one_in(4);
  const auto certificates = asks ? world_.certificates(probe()) : world_.certificates();
  for (int k = 0; k < 6; ++k) {
    const BodyId a = draw_.any_of(ids), b = draw_.any_of(ids);
    if (a != b && (truth_.at(a).moves() || truth_.at(b).moves())) check_pair(certificates, a, b);
  }
  check_account(draw_.any_of(ids));
  check_approach(certificates, draw_.any_of(ids));
  check_safe_time(certificates);
  check_queries(asks);
}

void Player::check_account(BodyId id) const {
  std::map<BodyId, bool> touched;
  for (const BodyId other : world_.touching(id).value()) touched[other] = true;
  std::map<std::pair<BodyId, double>, bool> sensed;
  for (const auto& [other, distance] : world_.sensor_overlaps(id).value()) sensed[{other, distance}] = true;
  for (const auto& [contact, state] : states_) {
    // Ends that a change has caused are told by the next advance.
    if (!contact.has(id) || contact.wall != Wall::none || now() == truth_.last_change) continue;
    const BodyId other = contact.first == id ? contact.second : contact.first;
    const bool is_counted =
        contact.sensed ? sensed.contains({other, *contact.sensed}) : touched.contains(other);
    if (wants_ends(truth_.wanted(contact)) && is_counted != state.touching)
      truth_.fail("another contact is counted than was told", contact, 0, now());
  }
}

/// Checks that no two begin to touch before the time that the world is safe until.
void Player::check_safe_time(const World::Certificates& certificates) {
  const double end = std::min(certificates.safe_until()->time, now() + times(0.3));
  if (!(end > now())) return;
  truth_.for_each_contact([&](const Contact& contact) {
    const auto spins = [&](BodyId id) { return id != no_body && truth_.at(id).spin_limit > 0.0; };
    // Without ends, two that move apart are no contact, however deep they overlap.
    const bool may_be_deep = !wants_ends(truth_.wanted(contact)) && !states_[contact].clear;
    if (!contact.sensed && !spins(contact.first) && !spins(contact.second) && !may_be_deep)
      truth_.require_side(contact, now(), end, Side::above, -truth_.tolerance(), truth_.slack(),
                          "safe_until of the world is too late");
  });
}

void Player::check_pair(const World::Certificates& certificates, BodyId a, BodyId b) {
  ++tally_.answers;
  const Contact contact{a, b};
  const Thing& one = truth_.at(a);
  const Thing& other = truth_.at(b);
  const bool spins = one.spin_limit > 0.0 || other.spin_limit > 0.0;
  const double time = draw_.one_in(2) ? now() : now() + times(draw_.uniform(0.0, 0.2));
  const DistanceLimits limits = certificates.distance_limits(a, b, time).value();
  // Spins change at the next step, and a sleeping body may be woken until then.
  if ((time != now() && spins) || one.sleeping || other.sleeping) return;
  const double slack = truth_.slack();
  const Real gap = truth_.gap(contact, time);
  const Real shallow = std::min(gap, truth_.told_gap(contact, time));
  // Hulls do not know how deep they overlap.
  const bool turns = one.sort == Sort::rigid || other.sort == Sort::rigid;
  if ((!turns || gap > 0) && limits.lower > gap + slack)
    truth_.fail("a lower limit is too large", contact, gap, time);
  if (limits.upper + truth_.report_errors(contact) < shallow - slack)
    truth_.fail("an upper limit is too small", contact, gap, time);
  if (gap <= 0 || spins) return;
  const double distance = std::min(static_cast<double>(gap) * draw_.uniform(), truth_.tolerance() * 0x1p41);
  const double safe = certificates.safe_until(a, b, distance)->time;
  const double end = std::min(safe, now() + times(0.5));
  if (end > now())
    truth_.require_side(contact, now(), end, Side::above, distance, slack, "safe_until is too late");
}

void Player::check_approach(const World::Certificates& certificates, BodyId id) {
  const double distance = lengths(draw_.uniform(0.0, 0.2));
  const double time = certificates.earliest_approach(id, distance)->time;
  const double end = std::min(time, now() + times(0.3));
  if (!(end > now())) return;
  const Thing& thing = truth_.at(id);
  for (const BodyId other : truth_.present()) {
    const Thing& partner = truth_.at(other);
    if (id == other || !truth_.meet(thing, partner) || thing.spin_limit > 0.0 || partner.spin_limit > 0.0)
      continue;
    truth_.require_side({id, other}, now(), end, Side::above, distance, truth_.slack(),
                        "earliest_approach is too late");
  }
}

}  // namespace kinesphere::stream
