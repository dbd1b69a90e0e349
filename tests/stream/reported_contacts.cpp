// Compares events with the truth.
#include "stream/reported_contacts.hpp"

#include <algorithm>

#include "kinesphere/event_hash.hpp"
#include "number/infinity.hpp"

namespace kinesphere::stream {
namespace {

[[noreturn]] void fail(const std::string& what, const Contact& contact, double gap) {
  throw Disagreement(text_of(contact) + ": " + what + ", gap " + std::to_string(gap));
}

Contact contact_of(const Event& event) {
  Contact contact{event.first, event.second, event.wall};
  if (event.kind == EventKind::sensor_enter || event.kind == EventKind::sensor_leave)
    contact.sensed = event.distance;
  return contact;
}

/// The ball around a half-space is infinite.
Ball ball_around(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape))
    return {0.5 * (box->lower + box->upper), 0.501 * norm(box->upper - box->lower) + 1e-9};
  if (const auto* triangle = std::get_if<Triangle>(&shape)) {
    const auto& [a, b, c] = *triangle;
    return {a, 1.001 * std::max(norm(b - a), norm(c - a)) + 1e-9};
  }
  if (std::holds_alternative<Mesh>(shape)) return ball_around(bounding_box(shape, infinity));
  return {{}, infinity};
}

bool is_end(const Event& event) {
  return event.kind == EventKind::contact_end || event.kind == EventKind::wall_end ||
         event.kind == EventKind::sensor_leave;
}

}  // namespace

ReportedContacts::ReportedContacts(const WorldDefinition& definition, Truth& truth)
    : rule_(definition),
      truth_(truth),
      rounding_(1e-12 + (definition.box ? 0x1p-50 * norm_one(definition.box->lower) : 0.0)),
      slack_(1e-3 * rule_.tolerance() + rounding_),
      space_(definition) {}

ReportedContacts::ReportedState& ReportedContacts::reported(const Contact& contact) {
  return const_cast<ReportedState&>(std::as_const(*this).reported(contact));
}

const ReportedContacts::ReportedState& ReportedContacts::reported(const Contact& contact) const {
  const std::uint32_t first = contact.first.index;
  if (contact.wall != Wall::none) return walls_[first][static_cast<std::size_t>(contact.wall) - 1];
  if (!contact.sensed) return pairs_(first, contact.second.index);
  const auto place = std::find(sensor_distances.begin(), sensor_distances.end(), *contact.sensed);
  if (place == sensor_distances.end()) fail("no sensor has this distance", contact, 0.0);
  return sensed_[static_cast<std::size_t>(place - sensor_distances.begin())](first, contact.second.index);
}

/// Calls `action` for every possible contact of the body, ignoring filters and disabled partners.
template <class Action>
void ReportedContacts::for_each(BodyId id, Action action) const {
  for (const TrueBody& other : truth_.bodies()) {
    if (!other.alive || other.id == id) continue;
    Contact contact = id.index < other.id.index ? Contact{id, other.id} : Contact{other.id, id};
    action(contact);
    for (const double distance : sensor_distances) {
      contact.sensed = distance;
      action(contact);
    }
  }
  if (truth_.at(id).fixed) return;
  for (const Wall wall : truth_.walls()) action(Contact{.first = id, .wall = wall});
}

ContactEvents ReportedContacts::wanted(const Contact& contact) const {
  if (contact.sensed) return ContactEvents::begin_and_end;
  const auto of = [this](BodyId id) {
    const TrueBody& body = truth_.at(id);
    return body.fixed ? ContactEvents{} : body.definition.contacts.value_or(truth_.definition().contacts);
  };
  return contact.wall == Wall::none ? of(contact.first) | of(contact.second) : of(contact.first);
}

// Changes.

Event ReportedContacts::end_now(const World& world, const Contact& contact) const {
  const double now = truth_.time();
  const auto sphere = [&](BodyId body) {
    const Bound bound = world.body(body).value().bound;
    const auto& shape = truth_.at(body).shape;
    return Sphere{
        body, bound.radius, {bound.centre_at(now), bound.velocity_at(now)}, shape ? &*shape : nullptr};
  };
  const Sphere first = sphere(contact.first);
  if (contact.wall != Wall::none)
    return wall_event(EventKind::wall_end, now, first, *truth_.definition().box, contact.wall);
  Event end = contact_event(contact.sensed ? EventKind::sensor_leave : EventKind::contact_end, now, first,
                            sphere(contact.second), space_);
  end.distance = contact.sensed.value_or(0.0);
  return end;
}

GapLimits ReportedContacts::limits(const World& world, const Contact& contact) const {
  const Bound bound = world.body(contact.first).value().bound;
  if (contact.wall != Wall::none)
    return gap_limits(bound, half_space(*truth_.definition().box, contact.wall), truth_.time());
  const Bound other = world.body(contact.second).value().bound;
  const auto extent = [this](BodyId id, const Bound& its_bound) {
    const TrueBody& body = truth_.at(id);
    return CollisionShape{its_bound, body.fixed, body.shape ? &*body.shape : nullptr};
  };
  return truth_.limits(extent(contact.first, bound), extent(contact.second, other));
}

std::vector<Before> ReportedContacts::before(const World& world, BodyId id) const {
  std::vector<Before> found;
  for_each(id, [&](const Contact& contact) {
    if (!is_open(contact)) return;
    found.push_back({contact, end_now(world, contact),
                     truth_.gap(contact) >= rule_.separation_distance() - slack(contact),
                     truth_.turns(contact)});
  });
  return found;
}

void ReportedContacts::expect_end(const Before& before, bool certain) {
  ReportedState& state = reported(before.contact);
  state.opened = true;
  if (certain) state = {.touching = state.touching};
  if (!state.touching) return;
  auto end =
      std::find_if(ends_.begin(), ends_.end(), [&](const End& e) { return e.contact == before.contact; });
  if (end == ends_.end()) end = ends_.insert(end, {before.contact, {}, false, before.turns});
  if (end->certain) return;
  end->candidates.push_back(before.end);
  end->certain = certain;
}

void ReportedContacts::gone(const std::vector<Before>& before) {
  for (const Before& contact : before) expect_end(contact, true);
}

void ReportedContacts::replaced(const World& world, BodyId id, const std::vector<Before>& before) {
  truth_.note_acceleration(id);
  for (const Before& b : before) {
    // Of a rigid body these are the limits of the ball around it. They say nothing of parts that are known
    // less well since an earlier report: the world may end such a contact now, or with the next report.
    const bool certain = !b.turns && limits(world, b.contact).lower >=
                                         b.contact.sensed.value_or(0.0) + rule_.separation_distance();
    const bool opened = truth_.gap(b.contact) >= rule_.separation_distance() - slack(b.contact);
    if (certain || b.is_over || (opened && truth_.turns(b.contact))) expect_end(b, certain);
    if (opened) reported(b.contact).opened = true;
  }
  for_each(id, [this](const Contact& contact) { look_again(contact); });
}

void ReportedContacts::refiltered(BodyId id, const std::vector<Before>& before) {
  for (const Before& contact : before)
    if (!truth_.may_be_reported(contact.contact)) expect_end(contact, true);
  for_each(id, [this](const Contact& contact) { look_again(contact); });
}

void ReportedContacts::redirected(BodyId id) {
  truth_.note_acceleration(id);
  for_each(id, [this](const Contact& contact) {
    if (contact.sensed) return;
    ReportedState& state = reported(contact);
    // The world may look before the next change of the same instant, or not: another begin is possible.
    state.turned = state.approached;
    state.opened = state.opened || state.approached || state.touching;
    look_again(contact);
  });
}

void ReportedContacts::appeared(BodyId id) {
  truth_.note_acceleration(id);
  const auto count = static_cast<std::uint32_t>(truth_.bodies().size());
  pairs_.resize(count);
  for (PairTable<ReportedState>& pairs : sensed_) pairs.resize(count);
  walls_.resize(truth_.bodies().size());
  // A reused index may have a pending end, but is in no contact.
  for_each(id, [this](const Contact& contact) {
    reported(contact) = {};
    look_again(contact);
  });
}

/// True if an approach of the two is reported: that of all contacts or, where the caller wants begins and
/// ends alone, the first one of a contact that began without.
bool ReportedContacts::is_watched(const Contact& contact, const ReportedState& state) const {
  return wants_approaches(wanted(contact)) || (state.touching && !state.approached);
}

/// Resets the state of a contact: bouncing bodies may overlap deeply, as long as they separate.
void ReportedContacts::look_again(const Contact& contact) {
  ReportedState& state = reported(contact);
  if (state.approached || !is_watched(contact, state) || !truth_.may_be_reported(contact)) return;
  if (truth_.turns(contact)) {
    // Whether the two approach is not known of overlapping ones.
    state.approached = state.opened = truth_.gap(contact) < rule_.surface_gap();
    return;
  }
  state.due = true;
  // The Zeno guard may use an eighth of the tolerance more.
  state.floor = std::min(0.0, truth_.gap(contact) - 0.125 * rule_.tolerance() + rule_.tolerance());
}

// Events.

void ReportedContacts::hear(const Event& event) {
  const Contact contact = contact_of(event);
  if (is_end(event) && take_end(event, contact)) return;
  settle_ends();
  switch (event.kind) {
    case EventKind::contact_begin:
    case EventKind::wall_begin:
    case EventKind::sensor_enter:
      return begin(event, contact);
    case EventKind::contact_end:
    case EventKind::wall_end:
    case EventKind::sensor_leave:
      return end(event, contact);
    case EventKind::zeno_guard:
      if (event.gap > rule_.tolerance()) fail("a Zeno guard outside the tolerance", contact, event.gap);
      if (truth_.may_be_reported(contact)) {
        // Further approaches may be reported until then, or not.
        ReportedState& state = reported(contact);
        if (!is_watched(contact, state) && !state.opened)
          fail("a Zeno guard, though no approach is watched", contact, event.gap);
        state.guarded = state.approached = state.opened = true;
      }
      return;
    default:
      fail("an event that nothing explains", contact, event.gap);
  }
}

/// Returns true if the event is an end that a change caused.
bool ReportedContacts::take_end(const Event& event, const Contact& contact) {
  const auto end =
      std::find_if(ends_.begin(), ends_.end(), [&](const End& e) { return e.contact == contact; });
  if (end == ends_.end()) return false;
  const bool known = std::any_of(end->candidates.begin(), end->candidates.end(),
                                 [&](const Event& candidate) { return same(candidate, event, end->turns); });
  if (!known && !end->certain) return false;
  if (!known) fail("the end by a change does not have the states before it", contact, event.gap);
  for (const End& other : ends_)
    if (other.certain && delivered_before(other.candidates.front(), event))
      fail("an end by a change comes too late", other.contact, other.candidates.front().gap);
  reported(contact).touching = false;
  look_again(contact);
  ends_.erase(end);
  return true;
}

void ReportedContacts::settle_ends() {
  for (const End& end : ends_)
    if (end.certain) fail("its end by a change is not reported", end.contact, end.candidates.front().gap);
  ends_.clear();
}

Range ReportedContacts::relative_accelerations(const Contact& contact) const {
  Range found{0.0, 0.0};
  Vec3 planned;
  bool is_vague = false;
  const auto add = [&](BodyId id, double sign) {
    const TrueBody& body = truth_.at(id);
    if (body.fixed) return;
    // A body that sleeps accelerates again as soon as the contact wakes it.
    is_vague = is_vague || body.resting || body.rigid;
    found.greatest += truth_.largest_accelerations(id).greatest;
    found.least += body.definition.acceleration_limit;
    planned += body.definition.planned_acceleration * sign;
  };
  add(contact.first, 1.0);
  if (contact.wall == Wall::none) add(contact.second, -1.0);
  if (is_vague) return {0.0, found.greatest};
  found.least += norm(planned);
  return {(1.0 - 0x1p-20) * found.least, (1.0 + 0x1p-20) * found.least};
}

ReportedContacts::Followed ReportedContacts::followed_by(const Contact& contact, bool certainly) const {
  Followed found;
  for (const BodyId id : {contact.first, contact.second}) {
    if (id == no_body || truth_.at(id).fixed) continue;
    const TrueBody& body = truth_.at(id);
    const auto [least, greatest] = truth_.largest_accelerations(id);
    const double of_least = rule_.zeno_interval(least);
    // The less a body accelerates, the longer is its interval, unless it does not accelerate at all.
    const double longest = least > 0.0 || greatest == 0.0 ? of_least : infinity;
    // A world stores the interval with few digits: near its end either mark is correct.
    const double shortest = (1.0 - 0x1p-20) * std::min(of_least, rule_.zeno_interval(greatest));
    const double since = truth_.time() - body.last_contact;
    if (!(since < (certainly ? shortest : longest))) continue;
    found.passed = std::min(found.passed, since);
    found.pressure = std::max(found.pressure, certainly ? body.pressure.least : body.pressure.greatest);
  }
  return found;
}

bool ReportedContacts::is_repeated(const Event& begin, const Contact& contact, bool certainly) const {
  const Followed last = followed_by(contact, certainly);
  if (last.passed < rule_.least_zeno_interval()) return true;
  const Range own = relative_accelerations(contact);
  const double pressure = std::max(last.pressure, certainly ? own.least : own.greatest);
  if (!(last.passed < infinity) || !(pressure > 0.0)) return false;
  const double speed = (certainly ? 1.0 - 0x1p-20 : 1.0 + 0x1p-20) * rule_.zeno_speed(pressure);
  return last.passed == 0.0 || begin.approach_speed < speed;
}

void ReportedContacts::note_begin(const Contact& contact) {
  const Range own = relative_accelerations(contact);
  // A world stores the pressure with few digits.
  const Range pressure{std::max((1.0 - 0x1p-4) * own.least, followed_by(contact, true).pressure),
                       std::max(own.greatest, followed_by(contact, false).pressure)};
  for (const BodyId id : {contact.first, contact.second}) {
    if (id == no_body) continue;
    truth_.at(id).last_contact = truth_.time();
    truth_.at(id).pressure = pressure;
  }
}

/// In periodic space a state may be reported in another image, and rounded.
bool ReportedContacts::same_state(const State& reported, BodyId id) const {
  const State truth = truth_.state(id);
  if (!space_.repeats()) return reported == truth;
  const Vec3 shift = truth_.shift_to_nearest(reported.position, truth.position);
  return reported.velocity == truth.velocity && norm(reported.position + shift - truth.position) <= rounding_;
}

/// The angular velocity of a body that is not rigid is reported as 0.
bool ReportedContacts::same_spin(const Vec3& reported, BodyId id) const {
  if (!truth_.at(id).rigid) return reported == Vec3{};
  const Vec3 truth = truth_.rotation(id, truth_.time()).angular_velocity;
  return norm(reported - truth) <= 1e-12 * (1.0 + norm(truth));
}

/// The candidate of a rigid body has the point, normal and gap of the ball around it.
bool ReportedContacts::same(const Event& a, const Event& b, bool turns) const {
  if (turns)
    return a.kind == b.kind && a.time == b.time && contact_of(a) == contact_of(b) &&
           a.first_state.velocity == b.first_state.velocity &&
           a.second_state.velocity == b.second_state.velocity;
  EventHash first, second;
  first.add(a);
  second.add(b);
  if (first.value() != second.value()) return false;
  if (!space_.repeats())
    return a.gap == b.gap && a.approach_speed == b.approach_speed && a.first_state == b.first_state &&
           a.second_state == b.second_state;
  const Vec3 way = a.second_state.position - a.first_state.position;
  const Vec3 other = b.second_state.position - b.first_state.position;
  return std::abs(a.gap - b.gap) <= rounding_ && a.first_state.velocity == b.first_state.velocity &&
         a.second_state.velocity == b.second_state.velocity &&
         (a.wall != Wall::none || norm(way - other) <= rounding_);
}

void ReportedContacts::begin(const Event& event, const Contact& contact) {
  if (!truth_.may_be_reported(contact)) fail("a begin of bodies that may not touch", contact, event.gap);
  const double gap = truth_.gap(contact);
  const double told_gap = event.gap - event.distance;
  const bool is_deep = truth_.hides_depth(contact) && gap < -1e-3;
  if (!is_deep && std::abs(gap - told_gap) > slack(contact))
    fail("a begin with a wrong gap", contact, event.gap);
  if (!is_deep && std::abs(truth_.exact_gap(contact) - told_gap) > slack(contact))
    fail("a begin with another gap than the exact one", contact, event.gap);
  if (told_gap > rule_.tolerance()) fail("a begin before the bodies are near", contact, gap);
  const bool pair = contact.wall == Wall::none;
  if (!same_state(event.first_state, contact.first) ||
      (pair && !same_state(event.second_state, contact.second)))
    fail("a begin with wrong states", contact, gap);
  if (!same_spin(event.first_angular_velocity, contact.first) ||
      (pair && !same_spin(event.second_angular_velocity, contact.second)))
    fail("a begin with wrong angular velocities", contact, gap);
  const auto repeats = [&](bool certainly) {
    return !contact.sensed && is_repeated(event, contact, certainly);
  };
  if (event.repeated ? !repeats(false) : repeats(true))
    fail("a begin wrongly marked as repeated", contact, gap);
  if (truth_.turns(contact)) {
    const auto [least, greatest] = truth_.closing_speeds(contact);
    if (!(event.approach_speed >= least && event.approach_speed <= greatest))
      fail("a begin with the approach speed " + std::to_string(event.approach_speed) + ", not one from " +
               std::to_string(least) + " to " + std::to_string(greatest),
           contact, gap);
  }
  if (!contact.sensed) note_begin(contact);
  ReportedState& state = reported(contact);
  const ContactEvents events = wanted(contact);
  const bool ends = wants_ends(events);
  if (event.already_touching != (state.touching && !contact.sensed))
    fail("a begin says wrongly whether the two were in touch", contact, gap);
  const bool first = ends && !state.touching;
  if (!first && event.approach_speed <= 0.0) fail("an impact that does not approach", contact, gap);
  // The two must have parted since the last report of an approach, or a response has parted them.
  if (!first && !state.opened && state.approached) fail("a begin is reported twice", contact, gap);
  const bool approaches = event.approach_speed > 0.0;
  state = {.touching = ends, .approached = approaches || contact.sensed, .guarded = state.guarded};
  // Rounding alone may produce so slow an approach.
  state.opened = event.approach_speed < 1e-9;
  if (!state.approached) look_again(contact);
}

void ReportedContacts::end(const Event& event, const Contact& contact) {
  if (!wants_ends(wanted(contact))) fail("an end that nobody asks for", contact, event.gap);
  if (!truth_.may_be_reported(contact)) fail("an end of bodies that may not touch", contact, event.gap);
  if (!reported(contact).touching) fail("an end without a begin", contact, event.gap);
  const double gap = truth_.gap(contact);
  const double told_gap = event.gap - event.distance;
  if (std::abs(gap - told_gap) > slack(contact)) fail("an end with a wrong gap", contact, event.gap);
  if (std::abs(truth_.exact_gap(contact) - told_gap) > slack(contact))
    fail("an end with another gap than the exact one", contact, event.gap);
  if (told_gap < rule_.separation_distance()) fail("an end before the bodies are apart", contact, gap);
  reported(contact) = {};
}

void ReportedContacts::check_account(const World& world, BodyId id) const {
  const std::vector<BodyId> touching = world.touching(id).value();
  const std::vector<SensorOverlap> sensed = world.sensor_overlaps(id).value();
  std::size_t contacts = 0;
  std::size_t overlaps = 0;
  for_each(id, [&](const Contact& contact) {
    if (contact.wall != Wall::none || !wants_ends(wanted(contact))) return;
    const BodyId other = contact.first == id ? contact.second : contact.first;
    const bool listed = contact.sensed ? std::find(sensed.begin(), sensed.end(),
                                                   SensorOverlap{other, *contact.sensed}) != sensed.end()
                                       : std::find(touching.begin(), touching.end(), other) != touching.end();
    (contact.sensed ? overlaps : contacts) += listed ? 1u : 0u;
    const auto end =
        std::find_if(ends_.begin(), ends_.end(), [&](const End& e) { return e.contact == contact; });
    if (end != ends_.end() && !end->certain) return;
    if (listed != (reported(contact).touching && end == ends_.end()))
      fail("the account differs from what was reported", contact, 0.0);
  });
  const auto with_ends = std::count_if(touching.begin(), touching.end(), [&](BodyId other) {
    return wants_ends(wanted(id.index < other.index ? Contact{id, other} : Contact{other, id}));
  });
  if (sensed.size() != overlaps || static_cast<std::size_t>(with_ends) != contacts)
    throw Disagreement("touching() or sensed() names a body twice, or one that is gone");
}

// Between events.

void ReportedContacts::move_on_to(double time) {
  if (time > truth_.time()) {
    settle_ends();
    const std::vector<Ball> ways = ways_until(time);
    for (const TrueBody& body : truth_.bodies()) {
      if (!body.present()) continue;
      for (const TrueBody& other : truth_.bodies()) {
        if (other.id.index >= body.id.index) break;
        const Contact contact{other.id, body.id};
        if (other.present() && (any_reported(contact) || may_meet(ways[other.id.index], ways[body.id.index])))
          check_pair(contact, time);
      }
      if (body.fixed) continue;
      for (const Wall wall : truth_.walls())
        if (const Contact contact{.first = body.id, .wall = wall}; truth_.may_be_reported(contact))
          check_contact(contact, time);
    }
  }
  truth_.move_on_to(time);
}

/// Returns for each body, by index, a ball that it does not leave until `time`.
std::vector<Ball> ReportedContacts::ways_until(double time) const {
  const double s = time - truth_.time();
  std::vector<Ball> ways(truth_.bodies().size());
  for (const TrueBody& body : truth_.bodies()) {
    if (!body.present()) continue;
    if (body.shape) {
      ways[body.id.index] = ball_around(*body.shape);
      continue;
    }
    const State state = truth_.state(body.id);
    const double way = (norm(state.velocity) + 0.5 * norm(body.path.front().acceleration) * s) * s;
    ways[body.id.index] = {state.position, body.definition.radius + 1.001 * way + 1e-9};
  }
  return ways;
}

/// Returns true if the bodies may touch, sense each other, or be near enough for a contact to go on.
bool ReportedContacts::may_meet(const Ball& a, const Ball& b) const {
  const Vec3 way = b.centre + truth_.shift_to_nearest(b.centre, a.centre) - a.centre;
  const double near = sensor_distances.back() + rule_.release_gap() + slack_;
  return norm(way) <= a.radius + b.radius + near;
}

bool ReportedContacts::any_reported(const Contact& contact) const {
  const std::uint32_t first = contact.first.index;
  const std::uint32_t second = contact.second.index;
  return pairs_(first, second) != ReportedState{} ||
         std::any_of(sensed_.begin(), sensed_.end(), [=](const PairTable<ReportedState>& pairs) {
           return pairs(first, second) != ReportedState{};
         });
}

void ReportedContacts::check_pair(Contact contact, double until) {
  if (truth_.may_be_reported(contact)) check_contact(contact, until);
  for (const double distance : sensor_distances) {
    contact.sensed = distance;
    if (truth_.may_be_reported(contact)) check_contact(contact, until);
  }
}

/// Returns the first time after `from` at which the gap certainly passes a level.
std::optional<double> ReportedContacts::reaches(const Contact& contact, LevelCrossing overlap, double level,
                                                double from, double until) const {
  const double beyond = overlap == LevelCrossing::falls_to ? level - slack(contact) : level + slack(contact);
  if (!truth_.may_reach(contact, overlap, beyond, until)) return std::nullopt;
  return truth_.first_time(contact, overlap, beyond, from, until);
}

void ReportedContacts::check_contact(const Contact& contact, double until) {
  ReportedState& state = reported(contact);
  const double now = truth_.time();
  const ContactEvents events = wanted(contact);
  if (state.touching) {
    if (const auto time = reaches(contact, LevelCrossing::rises_to, rule_.release_gap(), now, until))
      fail("they part untold at " + std::to_string(*time), contact, truth_.gap(contact));
  } else if (wants_ends(events)) {
    if (const auto time = reaches(contact, LevelCrossing::falls_to, -rule_.tolerance(), now, until))
      fail("they touch untold at " + std::to_string(*time), contact, truth_.gap(contact));
    return;
  }
  if (!is_watched(contact, state)) return;
  if (truth_.turns(contact))
    check_parted(contact, state, until);
  else
    check_approaches(contact, state, until);
}

/// Of contacts whose speed of approach is unknown: after they have certainly parted the next one is reported.
void ReportedContacts::check_parted(const Contact& contact, ReportedState& state, double until) {
  state.opened = true;
  if (state.touching) return;
  double from = truth_.time();
  if (state.approached) {
    const auto parted = reaches(contact, LevelCrossing::rises_to, rule_.release_gap(), from, until);
    if (!parted) return;
    state = {};
    from = *parted;
  }
  check_free(contact, state, from, until);
}

void ReportedContacts::check_approaches(const Contact& contact, ReportedState& state, double until) {
  double from = truth_.time();
  if (std::exchange(state.turned, false) && !state.guarded && truth_.approach_speed(contact) <= 0.0) {
    state.approached = false;
    look_again(contact);
  }
  if (state.approached) {
    state.opened = state.opened || truth_.opens_before(contact, until);
    const auto parted = reaches(contact, LevelCrossing::rises_to, rule_.release_gap(), from, until);
    if (!parted) return;
    state = {};
    from = *parted;
  }
  const double gap = truth_.gap(contact);
  if (state.due && gap < -rule_.tolerance() - slack_ && truth_.approach_speed(contact) > 1e-9)
    fail("their approach is not reported", contact, gap);
  state.due = false;
  if (state.floor < 0.0) {
    // After a gap this wide the next approach counts again.
    const auto out = reaches(contact, LevelCrossing::rises_to, rule_.surface_gap(), from, until);
    check_free(contact, state, from, out.value_or(until));
    if (!out) return;
    state.floor = 0.0;
    from = *out;
  }
  check_free(contact, state, from, until);
}

void ReportedContacts::check_free(const Contact& contact, ReportedState& state, double from,
                                  double until) const {
  const double floor = state.floor - rule_.tolerance();
  if (const auto time = reaches(contact, LevelCrossing::falls_to, floor, from, until))
    fail("they touch untold at " + std::to_string(*time), contact, truth_.gap(contact));
}

}  // namespace kinesphere::stream
