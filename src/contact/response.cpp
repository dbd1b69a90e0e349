#include "kinesphere/response.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {
namespace {

/// Share of a velocity change that a body takes: the limit of other / (own + other). Two massless bodies take
/// half each; two bodies of infinite mass take all of it each.
double share(double own, double other) {
  own = own < 0.0 ? 0.0 : own;
  other = other < 0.0 ? 0.0 : other;
  if (std::isinf(other)) return 1.0;
  if (own == 0.0 && other == 0.0) return 0.5;
  const double mass = own + other;
  return std::isinf(mass) && std::isfinite(own) ? 0.5 * other / (0.5 * own + 0.5 * other) : other / mass;
}

/// Returns the change of relative normal speed: the approach speed plus the rebound speed, which is
/// `restitution` times the approach speed, or zero if the contact is jammed.
double both_speeds(const Event& contact, double restitution) {
  return (1.0 + (contact.jammed ? 0.0 : restitution)) * contact.approach_speed;
}

/// Returns velocities that change the relative velocity along the normal by `speed`.
Bounce rebound(const Event& contact, double first_mass, double second_mass, double speed) {
  const Vec3 change = contact.normal * speed;
  if (contact.second == no_body) return {contact.first_state.velocity - change, {}};
  return {contact.first_state.velocity - change * share(first_mass, second_mass),
          contact.second_state.velocity + change * share(second_mass, first_mass)};
}

}  // namespace

Bounce bounce(const Event& contact, double first_mass, double second_mass, double restitution) {
  return rebound(contact, first_mass, second_mass,
                 both_speeds(contact, contact.repeated ? 1.0 : restitution));
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

double least_resting_speed(double contact_tolerance, double acceleration) {
  return std::sqrt(3.0 * contact_tolerance * acceleration);
}

}  // namespace kinesphere
