// Compares events with the truth, and answers them.
#include <cmath>
#include <sstream>
#include <utility>

#include "contact/contact_event.hpp"
#include "contact/contact_rule.hpp"
#include "kinesphere/response.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream {
namespace {

Contact contact_of(const Event& event) {
  Contact contact{event.first, event.second, event.wall};
  if (is_of_sensor(event.kind)) contact.sensed = event.distance;
  return contact;
}

bool is_begin(EventKind kind) {
  return kind == EventKind::contact_begin || kind == EventKind::wall_begin || kind == EventKind::sensor_enter;
}

}  // namespace

void Player::hear(const Event& event) {
  ++tally_.events;
  const Contact contact = contact_of(event);
  std::ostringstream line;
  line.precision(17);
  line << "at " << event.time << ": " << name_of(event.kind) << " of " << text_of(contact) << ", gap "
       << event.gap / truth_.tolerance() << " tolerances, approach " << event.approach_speed;
  tell(line.str());
  require(event.time == world_.time(), "an event of another time");
  if (event.kind == EventKind::bound_violation) truth_.fail("a bound is violated", contact, 0, event.time);
  if (event.kind == EventKind::woke) {
    require(woken_.erase(event.first) == 1, "an event reports as woken a body that did not sleep");
    require(event.first_state.velocity == Vec3{}, "a body that wakes moves");
    rounds_ = 3;
    return;
  }
  check_order(event);
  if (event.kind == EventKind::zeno_guard)
    states_[contact].held = false;
  else if (is_begin(event.kind))
    hear_begin(event, contact);
  else
    hear_end(event, contact);
  const bool wakes = event.kind == EventKind::contact_begin || event.kind == EventKind::contact_end;
  check_awake(wakes ? std::vector{event.first, event.second} : std::vector<BodyId>());
}

/// Checks that events of one instant come in order. After a change the ends that it caused come first, even
/// if others came before; then pending events; then events that the changes caused.
void Player::check_order(const Event& event) {
  const bool same_instant = last_event_ && last_event_->time == event.time;
  if (same_instant && !delivered_before(*last_event_, event))
    require(std::exchange(crossed_, false) || --rounds_ >= 0, "events of one instant in the wrong order");
  if (!same_instant) crossed_ = false;
  crossed_ = crossed_ || is_of_sensor(event.kind);
  last_event_ = event;
}

// Repeated contacts.

/// Returns limits of the acceleration that presses the two upon each other, as the world may know it.
Range Player::pressure_of(const Contact& contact) const {
  Range found;
  Vec3 planned;
  bool is_vague = false;
  const auto add = [&](BodyId id, double sign) {
    const Thing& thing = truth_.at(id);
    if (!thing.moves()) return;
    const BodyDefinition& body = thing.definition;
    // A body that sleeps accelerates again as soon as the contact wakes it.
    is_vague = is_vague || thing.sleeping || thing.sort == Sort::rigid;
    found.greatest +=
        thing.sort == Sort::rigid ? infinity : body.acceleration_limit + norm(body.planned_acceleration);
    found.least += body.acceleration_limit;
    planned += body.planned_acceleration * sign;
  };
  add(contact.first, 1.0);
  if (contact.wall == Wall::none) add(contact.second, -1.0);
  if (is_vague) return {0.0, found.greatest};
  found.least += norm(planned);
  return {(1.0 - 0x1p-20) * found.least, (1.0 + 0x1p-20) * found.least};
}

/// Returns the bodies that count a contact: those without a shape, or else the shapes that are carried.
std::vector<BodyId> Player::counting(const Contact& contact) const {
  std::vector<BodyId> found;
  for (const bool has_shape : {false, true}) {
    for (const BodyId id : {contact.first, contact.second})
      if (id != no_body && truth_.at(id).moves() && truth_.at(id).has_shape() == has_shape)
        found.push_back(id);
    if (!found.empty()) break;
  }
  return found;
}

/// Returns how long ago the last contact of the two was, if it was within the intervals of these, and limits
/// of what presses them: their own acceleration, and that of the contacts that they follow. A world stores
/// intervals and pressures with few digits: near their ends either is correct.
Player::Followed Player::followed_by(const Contact& contact, bool certainly) const {
  const ContactRule rule(truth_.definition());
  Followed found{infinity, pressure_of(contact)};
  for (const BodyId id : counting(contact)) {
    const Thing& thing = truth_.at(id);
    const BodyDefinition& body = thing.definition;
    double interval = rule.zeno_interval(body.acceleration_limit + norm(body.planned_acceleration));
    // The interval of a rigid body depends on how it has turned.
    if (thing.sort == Sort::rigid) interval = certainly ? rule.least_zeno_interval() : infinity;
    const double since = now() - thing.last_contact;
    if (!(since < (certainly ? (1.0 - 0x1p-20) * interval : interval))) continue;
    found.passed = std::min(found.passed, since);
    found.pressure.least = std::max(found.pressure.least, thing.pressure.least);
    found.pressure.greatest = std::max(found.pressure.greatest, thing.pressure.greatest);
  }
  return found;
}

/// Returns true if the begin must be marked as repeated, or if it may.
bool Player::is_repeated(const Event& begin, const Contact& contact, bool certainly) const {
  const ContactRule rule(truth_.definition());
  const auto [passed, limits] = followed_by(contact, certainly);
  const double pressure = certainly ? limits.least : limits.greatest;
  if (passed < rule.least_zeno_interval()) return true;
  if (!(passed < infinity) || !(pressure > 0.0)) return false;
  const double speed = (certainly ? 1.0 - 0x1p-20 : 1.0 + 0x1p-20) * rule.zeno_speed(pressure);
  return passed == 0.0 || begin.approach_speed < speed;
}

void Player::note_begin(const Contact& contact) {
  const Range pressure{(1.0 - 0x1p-4) * followed_by(contact, true).pressure.least,
                       followed_by(contact, false).pressure.greatest};
  for (const BodyId id : counting(contact)) {
    truth_.at(id).last_contact = now();
    truth_.at(id).pressure = pressure;
  }
}

void Player::hear_begin(const Event& event, const Contact& contact) {
  ++tally_.begins;
  if (!truth_.may_be_told(contact)) truth_.fail("a begin that may not be told", contact, event.gap, now());
  ContactState& state = states_[contact];
  const Real slack = truth_.slack();
  const Real gap = truth_.told_gap(contact, now());
  if (gap > contact.distance() + truth_.tolerance() + truth_.report_errors(contact) + slack)
    truth_.fail("an invented begin", contact, gap, now());
  const auto is_told = [&](Real true_gap, Real allowed) { return std::abs(true_gap - event.gap) <= allowed; };
  // Hulls do not know how deep they overlap.
  if (!scenario().errors && (truth_.is_of_balls(contact) || gap > 0) &&
      !is_told(gap, slack + 1e-12L * std::abs(gap)) &&
      !is_told(truth_.gap(contact, now()), slack + lengths(1e-9)))
    truth_.fail("a begin with a wrong gap", contact, gap, now());
  if (!contact.sensed && event.already_touching != state.touching)
    truth_.fail("already_touching is wrong", contact, gap, now());
  if (contact.sensed && state.touching) truth_.fail("entered twice", contact, gap, now());
  if (!contact.sensed) {
    if (event.repeated ? !is_repeated(event, contact, false) : is_repeated(event, contact, true))
      truth_.fail("a begin wrongly marked as repeated", contact, gap, now());
    note_begin(contact);
  }
  state = {.touching = wants_ends(truth_.wanted(contact))};
  if (!scenario().errors && now() != truth_.last_change && !contact.sensed) check_approach(event, contact);
}

void Player::hear_end(const Event& event, const Contact& contact) {
  if (!states_[contact].touching) truth_.fail("an end without a begin", contact, event.gap, now());
  const Real slack = truth_.slack();
  if (now() != truth_.last_change) {
    const Real gap = truth_.told_gap(contact, now());
    const Real least =
        contact.distance() + truth_.separation_distance() - truth_.report_errors(contact) - slack;
    if (gap < least) truth_.fail("an early end", contact, gap, now());
    if (!scenario().errors && std::abs(gap - event.gap) > slack + 1e-12L * std::abs(gap))
      truth_.fail("an end with a wrong gap", contact, gap, now());
  } else if (!scenario().steered && !scenario().errors && !scenario().spins) {
    check_gap_before_change(event, contact);
  }
  states_[contact].touching = false;
}

/// An end that a change causes has the gap from before that change.
void Player::check_gap_before_change(const Event& event, const Contact& contact) {
  Real nearest = infinity;
  const auto look = [&] {
    const auto is_there = [&](BodyId id) {
      return id.index < truth_.things.size() && truth_.at(id).id == id;
    };
    if (!is_there(contact.first) || (contact.second != no_body && !is_there(contact.second))) return;
    // Some hulls do not know how deep they overlap.
    for (const Real gap : {truth_.told_gap(contact, now()), truth_.gap(contact, now())})
      if (std::abs(gap - event.gap) < std::abs(nearest - event.gap)) nearest = gap;
  };
  look();
  for (std::vector<Thing>& before : befores_) {
    std::swap(before, truth_.things);
    look();
    std::swap(before, truth_.things);
  }
  const bool is_deep = nearest <= -lengths(1e-3);
  if (!is_deep && std::abs(nearest - event.gap) > truth_.slack() + lengths(1e-9))
    truth_.fail("an end with another gap than before the change", contact, nearest, now());
}

/// The approach speed of balls and walls.
void Player::check_approach(const Event& event, const Contact& contact) const {
  if (!truth_.is_of_balls(contact) || truth_.definition().periodic.any()) return;
  const Thing& a = truth_.at(contact.first);
  const auto has_vanished = [&](const Thing& thing) {
    return thing.radius.has_vanished(now(), lengths(1e-9));
  };
  if (has_vanished(a)) return;
  Real expected = 0, speed = truth_.speed(a, now(), now());
  if (contact.wall != Wall::none) {
    const int number = static_cast<int>(contact.wall) - 1;
    const Real outwards = coordinate(a.path.velocity_at(now()), number / 2);
    expected = (number % 2 == 1 ? outwards : -outwards) + a.radius.rate;
  } else {
    const Thing& b = truth_.at(contact.second);
    const Vector way = b.path.at(now()) - a.path.at(now());
    if (length(way) < lengths(1e-3) || has_vanished(b)) return;
    const Vector velocity = b.path.velocity_at(now()) - a.path.velocity_at(now());
    expected = -dot(way, velocity) / length(way) + a.radius.rate + b.radius.rate;
    speed = std::max(speed, truth_.speed(b, now(), now()));
  }
  const Real rounding = (norm(scenario().origin()) + lengths(20.0)) * 0x1p-52L / lengths(1e-3);
  if (std::abs(expected - event.approach_speed) > (1e-9L + rounding) * speed)
    truth_.fail("a wrong speed of approach", contact, event.gap, now());
}

// Responses.

void Player::respond(const Event& event) {
  const Contact contact = contact_of(event);
  if (is_begin(event.kind) && !contact.sensed && scenario().bounces && event.approach_speed > 0.0) {
    const double restitution = scenario().losses ? scenario().restitution : 1.0;
    const double resting_speed =
        std::max(speeds(0.05), least_resting_speed(truth_.tolerance(), speeds(8.0) / scenario().unit_time()));
    const Response response = response_of(
        event, scenario().settles ? settle(event, restitution, resting_speed) : bounce(event, restitution));
    bool is_whole = true;
    bool is_of_points = true;
    const auto give = [&](BodyId id, const auto& velocity, const auto& angular_velocity) {
      if (velocity) turn(id, *velocity);
      if (id == no_body) return;
      is_of_points = is_of_points && truth_.at(id).sort != Sort::rigid;
      if (!angular_velocity) return;
      if (norm(*angular_velocity) < 0.8 * truth_.at(id).largest_spin)
        spin(id, *angular_velocity);
      else
        is_whole = false;
    };
    give(event.first, response.first_velocity, response.first_angular_velocity);
    give(event.second, response.second_velocity, response.second_angular_velocity);
    states_[contact].held = is_whole && is_of_points && !event.jammed && event.gap > -truth_.tolerance() &&
                            (response.first_velocity || response.second_velocity) && !scenario().errors;
  }
  if (!scenario().actions) return;
  for (const BodyId id : {event.first, event.second})
    if (id != no_body && draw_.one_in(25)) act(id);
  if (draw_.one_in(12)) perform_any_change();
}

/// Removes or disables a body, or puts it to sleep.
void Player::act(BodyId id) {
  if (!world_.contains(id) || !truth_.at(id).enabled) return;
  Thing& thing = truth_.at(id);
  const std::size_t kind = draw_.below(3);
  if (kind == 2 && !can_rest(thing)) return;
  begin_change(kind == 0 ? "remove at an event" : kind == 1 ? "disable at an event" : "sleep at an event");
  if (kind == 0) {
    world_.remove(id).value();
    leave(thing);
  } else if (kind == 1) {
    world_.disable(id).value();
    thing.enabled = thing.sleeping = false;
    woken_.erase(id);
  } else {
    rest(thing);
  }
  truth_.last_change = now();
  check_awake();
  for (auto& [contact, state] : states_)
    if (contact.has(id)) state.held = false;
}

// Silence.

void Player::check_silence(double from, double until) {
  for (const auto& [contact, state] : states_)
    if (state.touching && !truth_.may_be_told(contact)) truth_.fail("an end is not told", contact, 0, from);
  std::erase_if(states_, [&](const auto& entry) { return !truth_.may_be_told(entry.first); });
  const double slack = truth_.slack();
  const double tolerance = truth_.tolerance();
  const double separation = truth_.separation_distance();
  truth_.for_each_contact([&](const Contact& contact) {
    ContactState& state = states_[contact];
    const ContactEvents wanted = truth_.wanted(contact);
    const double errors = truth_.report_errors(contact);
    const auto require = [&](Side side, Real level, const char* what) {
      truth_.require_side(contact, from, until, side, contact.distance() + level, slack, what);
    };
    if (state.touching)
      require(Side::below, separation + tolerance + errors, "they part untold");
    else if (wants_ends(wanted) || state.clear)
      require(Side::above, -tolerance, "they touch untold");
    if (state.held && wants_approaches(wanted) && !contact.sensed)
      require(Side::above, -1.26L * tolerance, "bounced bodies sink");
    if (wants_ends(wanted) && !state.held) return;
    const Real gap = truth_.gap(contact, until, {.enough = 4.0 * separation});
    if (gap > 2.0 * separation + errors && !wants_ends(wanted)) state.clear = true;
    if (gap > 2.0 * separation) state.held = false;
  });
}

}  // namespace kinesphere::stream
