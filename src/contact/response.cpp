#include "kinesphere/response.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/rebound.hpp"

namespace kinesphere {
namespace {

/// Share of a velocity change that a body takes: the limit of other / (own + other). Two massless bodies take
/// half each, and a body of infinite mass takes nothing.
double share(double own, double other) {
  own = own < 0.0 ? 0.0 : own;
  other = other < 0.0 ? 0.0 : other;
  if (std::isinf(own)) return 0.0;
  if (std::isinf(other)) return 1.0;
  if (own == 0.0 && other == 0.0) return 0.5;
  const double mass = own + other;
  return std::isinf(mass) ? 0.5 * other / (0.5 * own + 0.5 * other) : other / mass;
}

bool stays(const BodyTraits& traits) { return traits.is_static || traits.is_sleeping; }

/// Returns the change of relative normal speed: the approach speed plus the rebound speed, which is
/// `restitution` times the approach speed, or zero if the contact is jammed. Bodies that do not approach, as
/// where a contact ends, are not turned.
double both_speeds(const Event& contact, double restitution) {
  return (1.0 + (contact.jammed ? 0.0 : restitution)) * std::max(contact.approach_speed, 0.0);
}

/// Returns a mass that one can divide by: 0 counts as a mass so small that its share is that of its limit.
double divisible(double mass) { return std::max(mass, 0x1p-900); }

/// Returns the change of a rigid body's normal velocity at the contact by a unit impulse there: the inverse
/// of its effective mass. `gain` is its spin gain along the normal.
double inverse_mass(double mass, const Vec3& gain, const Vec3& arm, const Vec3& normal) {
  return (std::isinf(mass) ? 0.0 : 1.0 / divisible(mass)) + dot(gain, cross(arm, normal));
}

/// Returns that of each body of an event; 0 for those that do not move.
std::array<double, 2> inverse_masses(const Event& event, double first_mass, double second_mass) {
  const Vec3& normal = event.normal;
  const double first =
      stays(event.first_traits)
          ? 0.0
          : inverse_mass(first_mass, event.first_spin_gain, event.point - event.first_state.position, normal);
  const bool is_alone = event.second == no_body;
  const double second = is_alone || stays(event.second_traits)
                            ? 0.0
                            : inverse_mass(second_mass, event.second_spin_gain,
                                           event.point - event.second_state.position, normal);
  return {first, second};
}

/// Returns velocities as rebound() does, for a contact that turns a rigid body.
Bounce rebound_with_spin(const Event& contact, double first_mass, double second_mass, double speed) {
  const Vec3& normal = contact.normal;
  const auto [first, second] = inverse_masses(contact, first_mass, second_mass);
  Bounce after{contact.first_state.velocity, contact.second_state.velocity, contact.first_angular_velocity,
               contact.second_angular_velocity};
  if (!(first + second > 0.0)) return after;
  const double impulse = speed / (first + second);
  if (first > 0.0) {
    if (!std::isinf(first_mass)) after.first_velocity -= normal * (impulse / divisible(first_mass));
    after.first_angular_velocity -= contact.first_spin_gain * impulse;
  }
  if (second > 0.0) {
    if (!std::isinf(second_mass)) after.second_velocity += normal * (impulse / divisible(second_mass));
    after.second_angular_velocity += contact.second_spin_gain * impulse;
  }
  return after;
}

}  // namespace

Bounce rebound(const Event& contact, double first_mass, double second_mass, double speed) {
  if (contact.first_spin_gain != Vec3{} || contact.second_spin_gain != Vec3{})
    return rebound_with_spin(contact, first_mass, second_mass, speed);
  const Vec3 change = contact.normal * speed;
  if (contact.second == no_body) return {contact.first_state.velocity - change, {}};
  const bool first_stays = stays(contact.first_traits);
  const bool second_stays = stays(contact.second_traits);
  const double first = first_stays ? 0.0 : second_stays ? 1.0 : share(first_mass, second_mass);
  const double second = second_stays ? 0.0 : first_stays ? 1.0 : share(second_mass, first_mass);
  return {contact.first_state.velocity - change * first, contact.second_state.velocity + change * second};
}

double inverse_effective_mass(const Event& event) {
  const auto [first, second] = inverse_masses(event, event.first_mass, event.second_mass);
  return first + second;
}

Bounce bounce(const Event& contact, double restitution) {
  return bounce(contact, contact.first_mass, contact.second_mass, restitution);
}

Bounce bounce(const Event& contact, double first_mass, double second_mass, double restitution) {
  return rebound(contact, first_mass, second_mass,
                 both_speeds(contact, contact.repeated ? 1.0 : restitution));
}

Bounce bounce(const Event& contact, const Roughness& rough) {
  const Vec3& normal = contact.normal;
  const bool is_wall = contact.second == no_body;
  const auto [first, second] = inverse_masses(contact, contact.first_mass, contact.second_mass);
  Bounce after{contact.first_state.velocity, contact.second_state.velocity, contact.first_angular_velocity,
               contact.second_angular_velocity};
  if (!(first + second > 0.0) || !(contact.approach_speed > 0.0)) return after;
  // The gap is within the tolerance, and not theirs.
  const double gap = is_wall ? contact.gap : 0.5 * contact.gap;
  const double first_radius = dot(contact.point - contact.first_state.position, normal) - gap;
  const double second_radius =
      is_wall ? 0.0 : dot(contact.second_state.position - contact.point, normal) - gap;
  const Vec3 relative =
      contact.first_state.velocity - contact.second_state.velocity +
      cross(contact.first_angular_velocity * first_radius + contact.second_angular_velocity * second_radius,
            normal);
  const Vec3 sliding = relative - normal * dot(relative, normal);
  const double along = both_speeds(contact, contact.repeated ? 1.0 : rough.restitution) / (first + second);
  const double sticks = (1.0 + rough.tangential_restitution) * rough.inertia / (1.0 + rough.inertia) *
                        norm(sliding) / (first + second);
  const double across = std::min(sticks, rough.friction * along);
  const Vec3 tangent = across > 0.0 ? sliding / norm(sliding) * across : Vec3{};
  const Vec3 impulse = normal * along + tangent;
  after.first_velocity -= impulse * first;
  after.second_velocity += impulse * second;
  const Vec3 turn = cross(normal, tangent);
  if (first > 0.0) after.first_angular_velocity -= turn * (first / (rough.inertia * first_radius));
  if (second > 0.0) after.second_angular_velocity -= turn * (second / (rough.inertia * second_radius));
  return after;
}

Bounce settle(const Event& contact, double restitution, double resting_speed) {
  return settle(contact, contact.first_mass, contact.second_mass, restitution, resting_speed);
}

Bounce settle(const Event& contact, double first_mass, double second_mass, double restitution,
              double resting_speed) {
  const double approach = contact.approach_speed;
  if (!(approach > 0.0)) return rebound(contact, first_mass, second_mass, both_speeds(contact, restitution));
  const bool gains = contact.repeated && restitution < 1.0;
  const double least = gains ? resting_speed : std::min(resting_speed, approach);
  const double restitution_now = std::max(restitution, least / approach);
  // The quotient overflows at the smallest approach speeds.
  const bool overflows = std::isinf(restitution_now) && !contact.jammed;
  return rebound(contact, first_mass, second_mass,
                 overflows ? approach + least : both_speeds(contact, restitution_now));
}

Response response_of(const Event& contact, const Bounce& after) {
  Response response;
  // A body of infinite mass keeps its velocity, and its certificates with it.
  if (!stays(contact.first_traits) && !std::isinf(contact.first_mass))
    response.first_velocity = after.first_velocity;
  if (contact.second != no_body && !stays(contact.second_traits) && !std::isinf(contact.second_mass))
    response.second_velocity = after.second_velocity;
  if (after.first_angular_velocity != contact.first_angular_velocity)
    response.first_angular_velocity = after.first_angular_velocity;
  if (after.second_angular_velocity != contact.second_angular_velocity)
    response.second_angular_velocity = after.second_angular_velocity;
  return response;
}

std::string_view name_of(BodyAction action) {
  constexpr std::array<std::string_view, 4> names{"none", "remove", "disable", "sleep"};
  return names[static_cast<std::size_t>(action)];
}

double least_resting_speed(double contact_tolerance, double acceleration) {
  return std::sqrt(3.0 * contact_tolerance * acceleration);
}

}  // namespace kinesphere
