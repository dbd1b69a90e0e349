#include "stream/truth.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <sstream>

#include "kinesphere/random.hpp"

namespace kinesphere::stream {
namespace {

/// Work for which a scenario is cut short: less than half a second.
constexpr std::size_t most_work = 5'000'000;

}  // namespace

std::string text_of(const Contact& contact) {
  std::ostringstream text;
  text << contact.first << " and ";
  if (contact.wall == Wall::none)
    text << contact.second;
  else
    text << name_of(contact.wall);
  if (contact.sensed) text << " within " << *contact.sensed;
  return text.str();
}

Truth::Truth(const Scenario& scenario)
    : now(scenario.definition().start_time),
      last_change(now),
      gaps(scenario.definition(), scenario.unit_length()),
      scenario_(scenario),
      definition_(scenario.definition()) {}

double Truth::separation_distance() const {
  return std::isnan(definition_.separation_distance) ? 4.0 * tolerance() : definition_.separation_distance;
}

void Truth::put(const Thing& thing) {
  if (thing.id.index >= things.size()) things.resize(thing.id.index + 1u, {.alive = false});
  at(thing.id) = thing;
}

std::vector<BodyId> Truth::present() const {
  std::vector<BodyId> ids;
  for (const Thing& thing : things)
    if (thing.present()) ids.push_back(thing.id);
  return ids;
}

/// Errors of a report depend on its body and its time alone.
State Truth::report(const Thing& thing, double time) const {
  State state = state_of(thing, time);
  const double error = thing.definition.position_error;
  if (error == 0.0) return state;
  Random random = Random::at(scenario_.seed, thing.id.index, std::bit_cast<std::uint64_t>(time));
  const auto off = [&](double most) {
    Vec3 way = 0.99 * most * random.point_in_ball();
    if (scenario_.flat) way.z = 0.0;
    return way;
  };
  state.position += off(error);
  if (!thing.sleeping) state.velocity += off(thing.definition.velocity_error);
  return state;
}

// Who meets whom.

bool Truth::meet(const Thing& a, const Thing& b) const {
  return a.present() && b.present() && (a.moves() || b.moves()) &&
         passes(a.definition.filter, b.definition.filter) &&
         (!has_pair_filter || passes_pair_filter(a.id, b.id));
}

bool Truth::senses(const Thing& a, const Thing& b, double distance) const {
  const Sensor& sensor = sensors[a.definition.sensor_class];
  return (sensor.mask & b.definition.filter.category) != 0 &&
         std::ranges::find(sensor.distances, distance) != sensor.distances.end();
}

bool Truth::has_wall(Wall wall) const {
  const int axis = (static_cast<int>(wall) - 1) / 2;
  return definition_.box && axis < definition_.dimensions && !definition_.periodic[axis];
}

bool Truth::may_be_told(const Contact& contact) const {
  const Thing& a = at(contact.first);
  if (a.id != contact.first || !a.present()) return false;
  if (contact.wall != Wall::none)
    return !a.has_shape() && has_wall(contact.wall) &&
           (!definition_.wall_filter || passes(*definition_.wall_filter, a.definition.filter));
  const Thing& b = at(contact.second);
  if (b.id != contact.second || !meet(a, b)) return false;
  if (contact.sensed) return senses(a, b, *contact.sensed) || senses(b, a, *contact.sensed);
  return a.definition.solid && b.definition.solid;
}

ContactEvents Truth::wanted(const Contact& contact) const {
  if (contact.sensed) return ContactEvents::begin_and_end;
  const auto of = [&](BodyId id) {
    const Thing& thing = at(id);
    return thing.moves() ? thing.definition.contacts.value_or(definition_.contacts) : ContactEvents{};
  };
  return contact.wall != Wall::none ? of(contact.first) : of(contact.first) | of(contact.second);
}

// Gaps.

Real Truth::gap(const Contact& contact, Real time, const Measure& how) const {
  if (contact.wall != Wall::none) return gaps.to_wall(at(contact.first), contact.wall, time);
  return gaps.between(at(contact.first), at(contact.second), time, how);
}

Real Truth::told_gap(const Contact& contact, Real time) const {
  const bool turns = at(contact.first).sort == Sort::rigid ||
                     (contact.second != no_body && at(contact.second).sort == Sort::rigid);
  return gap(contact, time, {.is_deep = !turns});
}

bool Truth::is_of_balls(const Contact& contact) const {
  return at(contact.first).is_ball() && (contact.wall != Wall::none || at(contact.second).is_ball());
}

double Truth::report_errors(const Contact& contact) const {
  const double error = at(contact.first).definition.position_error;
  return 2.0 * (contact.second == no_body ? error : error + at(contact.second).definition.position_error);
}

Real Truth::speed(const Thing& thing, Real from, Real until) const {
  if (!thing.moves() || thing.sleeping) return 0;
  const Real middle = (from + until) / 2;
  const auto spin_at = [&](Real time) { return std::abs(thing.spin.speed_at(static_cast<double>(time))); };
  const Real spin = thing.sort == Sort::rigid ? std::max(spin_at(from), spin_at(until)) * thing.reach : 0;
  const Path& path = thing.path;
  return length(path.velocity_at(middle)) + length(path.acceleration) * (until - from) / 2 + spin +
         std::abs(thing.radius.rate);
}

/// Returns an upper limit of the speed at which the gap changes.
Real Truth::closing_speed(const Contact& contact, Real from, Real until) const {
  const Thing& a = at(contact.first);
  if (contact.wall != Wall::none) return speed(a, from, until);
  const Thing& b = at(contact.second);
  const auto turns_or_stays = [](const Thing& thing) { return thing.sort == Sort::rigid || !thing.moves(); };
  if (turns_or_stays(a) || turns_or_stays(b)) return speed(a, from, until) + speed(b, from, until);
  const Real middle = (from + until) / 2;
  return length(a.path.velocity_at(middle) - b.path.velocity_at(middle)) +
         length(a.path.acceleration - b.path.acceleration) * (until - from) / 2 + std::abs(a.radius.rate) +
         std::abs(b.radius.rate);
}

double Truth::slack() const {
  Real fastest = 0;
  for (const Thing& thing : things)
    if (thing.present()) fastest = std::max(fastest, speed(thing, now, now));
  const double instant = std::nextafter(std::abs(now), infinity) - std::abs(now);
  const double places = (norm(scenario_.origin()) + 20.0 * scenario_.unit_length()) * 0x1p-52;
  return 2e-3 * tolerance() + 4.0 * (instant * static_cast<double>(fastest) + places);
}

void Truth::require_side(const Contact& contact, Real from, Real until, Side side, Real level, double slack,
                         const std::string& what) const {
  require_side(contact, from, until, side, level, slack, what, 0);
}

void Truth::require_side(const Contact& contact, Real from, Real until, Side side, Real level, double slack,
                         const std::string& what, int depth) const {
  if (gaps.work() > (scenario_.crowd ? 20 : 1) * most_work) throw CutShort();
  const Real middle = (from + until) / 2;
  const Real change = 1.0001L * closing_speed(contact, from, until) * (until - from) / 2;
  const Real gap = this->gap(contact, middle, {true, level + 1.01L * change + tolerance()});
  const Real clear = side == Side::above ? gap - level : level - gap;
  if (clear > change) return;
  if (clear < -slack) fail(what, contact, gap, middle);
  if (change < 0.05L * slack || depth > 45 || !(middle > from && middle < until)) return;
  require_side(contact, from, middle, side, level, slack, what, depth + 1);
  require_side(contact, middle, until, side, level, slack, what, depth + 1);
}

void Truth::fail(const std::string& what, const Contact& contact, Real gap, Real time) const {
  std::ostringstream text;
  text.precision(17);
  text << what << ": " << text_of(contact) << ", gap " << static_cast<double>(gap / tolerance())
       << " tolerances at " << time << ", now " << now << ", last change " << last_change << ", sorts "
       << static_cast<int>(at(contact.first).sort);
  if (contact.second != no_body) text << " and " << static_cast<int>(at(contact.second).sort);
  throw Disagreement(text.str());
}

}  // namespace kinesphere::stream
