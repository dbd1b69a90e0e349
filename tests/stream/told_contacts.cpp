// Events held against the truth.
#include "stream/told_contacts.hpp"

#include <algorithm>

#include "kinesphere/scene.hpp"

namespace kinesphere::stream {
namespace {

[[noreturn]] void fail(const std::string& what, const Contact& contact, double gap) {
  throw Disagreement(text_of(contact) + ": " + what + ", gap " + std::to_string(gap));
}

Contact contact_of(const Event& event) { return {event.first, event.second, event.wall}; }

bool is_end(const Event& event) {
  return event.kind == EventKind::contact_end || event.kind == EventKind::wall_end;
}

bool same(const Event& a, const Event& b) {
  EventHash first, second;
  first.add(a);
  second.add(b);
  return first.value() == second.value() && a.gap == b.gap && a.approach_speed == b.approach_speed &&
         a.first_state == b.first_state && a.second_state == b.second_state;
}

}  // namespace

ToldContacts::ToldContacts(const WorldDefinition& definition, Truth& truth)
    // Far below the tolerance, above rounding.
    : rule_(definition), truth_(truth), slack_(1e-3 * rule_.tolerance() + 1e-12) {}

ToldContacts::Told& ToldContacts::told(const Contact& contact) {
  return const_cast<Told&>(std::as_const(*this).told(contact));
}

const ToldContacts::Told& ToldContacts::told(const Contact& contact) const {
  const std::uint32_t first = contact.first.index;
  if (contact.wall != Wall::none) return walls_[first][static_cast<std::size_t>(contact.wall) - 1];
  return pairs_(first, contact.second.index);
}

/// Every contact of the body that there could be, but for filters and disabled partners.
template <class Action>
void ToldContacts::for_each(BodyId id, Action action) const {
  for (const TrueBody& other : truth_.bodies()) {
    if (!other.alive || other.id == id) continue;
    action(id.index < other.id.index ? Contact{id, other.id} : Contact{other.id, id});
  }
  if (!truth_.definition().box) return;
  for (const Wall wall : walls) action(Contact{.first = id, .wall = wall});
}

// Changes.

std::vector<Before> ToldContacts::before(const World& world, BodyId id) const {
  const auto sphere = [&](BodyId body) {
    const Bound bound = world.body(body).value().bound;
    return Sphere{body, bound.radius, {bound.centre_at(truth_.time()), bound.velocity_at(truth_.time())}};
  };
  std::vector<Before> found;
  for_each(id, [&](const Contact& contact) {
    if (!told(contact).touching) return;
    const Event end = contact.wall == Wall::none
                          ? contact_event(EventKind::contact_end, truth_.time(), sphere(contact.first),
                                          sphere(contact.second))
                          : wall_event(EventKind::wall_end, truth_.time(), sphere(contact.first),
                                       *truth_.definition().box, contact.wall);
    found.push_back({contact, end, truth_.gap(contact) >= rule_.separation_distance() - slack_});
  });
  return found;
}

void ToldContacts::expect_end(const Before& before, bool certain) {
  if (impacts()) {
    if (certain) told(before.contact) = {};
    return;
  }
  auto end =
      std::find_if(ends_.begin(), ends_.end(), [&](const End& e) { return e.contact == before.contact; });
  if (end == ends_.end()) end = ends_.insert(end, {before.contact, {}, false});
  if (end->certain) return;
  end->candidates.push_back(before.end);
  end->certain = certain;
}

void ToldContacts::gone(const std::vector<Before>& before) {
  for (const Before& contact : before) expect_end(contact, true);
}

void ToldContacts::replaced(const World& world, BodyId id, const std::vector<Before>& before) {
  for (const Before& b : before) {
    const Bound bound = world.body(b.contact.first).value().bound;
    const GapLimits limits =
        b.contact.wall == Wall::none
            ? gap_limits(bound, world.body(b.contact.second).value().bound, truth_.time())
            : gap_limits(bound, half_space(*truth_.definition().box, b.contact.wall), truth_.time());
    const bool certain = limits.lower >= rule_.separation_distance();
    if (certain || b.is_over) expect_end(b, certain);
    if (truth_.gap(b.contact) >= rule_.separation_distance() - slack_) told(b.contact).opened = true;
  }
  for_each(id, [this](const Contact& contact) { look_again(contact); });
}

void ToldContacts::refiltered(BodyId id, const std::vector<Before>& before) {
  for (const Before& contact : before)
    if (!truth_.may_touch(contact.contact)) expect_end(contact, true);
  for_each(id, [this](const Contact& contact) { look_again(contact); });
}

void ToldContacts::kicked(BodyId id) {
  if (!impacts()) return;
  for_each(id, [this](const Contact& contact) {
    told(contact).touching = false;
    look_again(contact);
  });
}

void ToldContacts::appeared(BodyId id) {
  pairs_.resize(static_cast<std::uint32_t>(truth_.bodies().size()));
  walls_.resize(truth_.bodies().size());
  // An index that is used again may have an end on its way still, but is in no contact.
  for_each(id, [this](const Contact& contact) {
    told(contact) = {};
    look_again(contact);
  });
}

/// Nothing is known of a contact: bouncing bodies may be deep in each other, as long as they part.
void ToldContacts::look_again(const Contact& contact) {
  Told& state = told(contact);
  if (!impacts() || state.touching || !truth_.may_touch(contact)) return;
  state.due = true;
  // The Zeno guard may take an eighth of the tolerance more.
  state.floor = std::min(0.0, truth_.gap(contact) - 0.125 * rule_.tolerance() + rule_.tolerance());
}

// Events.

void ToldContacts::hear(const Event& event) {
  const Contact contact = contact_of(event);
  if (is_end(event) && take_end(event, contact)) return;
  settle_ends();
  switch (event.kind) {
    case EventKind::contact_begin:
    case EventKind::wall_begin:
      return begin(event, contact);
    case EventKind::contact_end:
    case EventKind::wall_end:
      return end(event, contact);
    case EventKind::zeno_guard:
      if (!impacts()) fail("a Zeno guard, though contacts last", contact, event.gap);
      if (event.gap > rule_.tolerance()) fail("a Zeno guard outside the tolerance", contact, event.gap);
      if (truth_.may_touch(contact))
        told(contact).floor =
            std::min(told(contact).floor, event.gap - 0.125 * rule_.tolerance() + rule_.tolerance());
      return;
    default:
      fail("an event that nothing explains", contact, event.gap);
  }
}

/// True when the event is an end that a change brought about.
bool ToldContacts::take_end(const Event& event, const Contact& contact) {
  const auto end =
      std::find_if(ends_.begin(), ends_.end(), [&](const End& e) { return e.contact == contact; });
  if (end == ends_.end()) return false;
  const bool known = std::any_of(end->candidates.begin(), end->candidates.end(),
                                 [&](const Event& candidate) { return same(candidate, event); });
  if (!known && !end->certain) return false;
  if (!known) fail("the end by a change does not have the states before it", contact, event.gap);
  for (const End& other : ends_)
    if (other.certain && delivered_before(other.candidates.front(), event))
      fail("an end by a change comes too late", other.contact, other.candidates.front().gap);
  told(contact).touching = false;
  ends_.erase(end);
  return true;
}

void ToldContacts::settle_ends() {
  for (const End& end : ends_)
    if (end.certain) fail("its end by a change is not told", end.contact, end.candidates.front().gap);
  ends_.clear();
}

bool ToldContacts::is_repeated(BodyId id) const {
  const TrueBody& body = truth_.at(id);
  const double acceleration = body.definition.acceleration_limit + norm(body.definition.planned_acceleration);
  return truth_.time() - body.last_contact < rule_.zeno_interval(acceleration);
}

void ToldContacts::begin(const Event& event, const Contact& contact) {
  if (!truth_.may_touch(contact)) fail("a begin of bodies that may not touch", contact, event.gap);
  const double gap = truth_.gap(contact);
  if (std::abs(gap - event.gap) > slack_) fail("a begin with a wrong gap", contact, event.gap);
  if (event.gap > rule_.tolerance()) fail("a begin before the bodies are near", contact, gap);
  const bool pair = contact.wall == Wall::none;
  if (!(event.first_state == truth_.state(contact.first)) ||
      (pair && !(event.second_state == truth_.state(contact.second))))
    fail("a begin with wrong states", contact, gap);
  const bool repeated = is_repeated(contact.first) || (pair && is_repeated(contact.second));
  if (event.repeated != repeated) fail("a begin wrongly marked as repeated", contact, gap);
  truth_.at(contact.first).last_contact = truth_.time();
  if (pair) truth_.at(contact.second).last_contact = truth_.time();
  Told& state = told(contact);
  if (impacts() && event.approach_speed <= 0.0) fail("an impact that does not approach", contact, gap);
  if (state.touching && !(impacts() && state.opened)) fail("a begin told twice", contact, gap);
  state = {.touching = true};
}

void ToldContacts::end(const Event& event, const Contact& contact) {
  if (impacts()) fail("an end in a world of impacts", contact, event.gap);
  if (!truth_.may_touch(contact)) fail("an end of bodies that may not touch", contact, event.gap);
  if (!told(contact).touching) fail("an end without a begin", contact, event.gap);
  const double gap = truth_.gap(contact);
  if (std::abs(gap - event.gap) > slack_) fail("an end with a wrong gap", contact, event.gap);
  if (event.gap < rule_.separation_distance()) fail("an end before the bodies are apart", contact, gap);
  told(contact).touching = false;
}

// Between events.

void ToldContacts::move_on_to(double time) {
  if (time > truth_.time()) {
    settle_ends();
    for (const TrueBody& body : truth_.bodies()) {
      if (!body.present()) continue;
      for (const TrueBody& other : truth_.bodies()) {
        if (other.id.index >= body.id.index) break;
        const Contact contact{other.id, body.id};
        if (other.present() && truth_.may_touch(contact)) check_contact(contact, time);
      }
      if (!truth_.definition().box) continue;
      for (const Wall wall : walls) check_contact({.first = body.id, .wall = wall}, time);
    }
  }
  truth_.move_on_to(time);
}

/// The first time from `from` on at which the gap certainly passes a level.
std::optional<double> ToldContacts::reaches(const Contact& contact, Crossing crossing, double level,
                                            double from, double until) const {
  const double beyond = crossing == Crossing::falls_to ? level - slack_ : level + slack_;
  if (!truth_.may_reach(contact, crossing, beyond, until)) return std::nullopt;
  return truth_.course(contact).first_time(crossing, beyond, from, until);
}

void ToldContacts::check_contact(const Contact& contact, double until) {
  Told& state = told(contact);
  const double now = truth_.time();
  if (impacts()) return check_impacts(contact, state, until);
  if (state.touching) {
    if (const auto time = reaches(contact, Crossing::rises_to, rule_.release_gap(), now, until))
      fail("they part untold at " + std::to_string(*time), contact, truth_.gap(contact));
  } else if (const auto time = reaches(contact, Crossing::falls_to, -rule_.tolerance(), now, until)) {
    fail("they touch untold at " + std::to_string(*time), contact, truth_.gap(contact));
  }
}

void ToldContacts::check_impacts(const Contact& contact, Told& state, double until) {
  double from = truth_.time();
  if (state.touching) {
    state.opened = state.opened || truth_.opens_before(contact, until);
    const auto parted = reaches(contact, Crossing::rises_to, rule_.release_gap(), from, until);
    if (!parted) return;
    state = {};
    from = *parted;
  }
  const double gap = truth_.gap(contact);
  if (state.due && gap < -rule_.tolerance() - slack_ && truth_.approach_speed(contact) > 1e-9)
    fail("their approach is not told", contact, gap);
  state.due = false;
  if (state.floor < 0.0) {
    // Once they have come out as far as this, the next approach counts again.
    const auto out = reaches(contact, Crossing::rises_to, rule_.surface_gap(), from, until);
    check_free(contact, state, from, out.value_or(until));
    if (!out) return;
    state.floor = 0.0;
    from = *out;
  }
  check_free(contact, state, from, until);
}

void ToldContacts::check_free(const Contact& contact, Told& state, double from, double until) const {
  const double floor = state.floor - rule_.tolerance();
  if (const auto time = reaches(contact, Crossing::falls_to, floor, from, until))
    fail("they touch untold at " + std::to_string(*time), contact, truth_.gap(contact));
}

}  // namespace kinesphere::stream
