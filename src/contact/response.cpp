#include "kinesphere/response.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {
namespace {

/// The two leave each other with `kept` times their approach speed, or with none where they are jammed.
Bounce rebound(const Event& contact, double first_mass, double second_mass, double kept) {
  if (contact.jammed) kept = 0.0;
  const Vec3 change = contact.normal * ((1.0 + kept) * contact.approach_speed);
  if (contact.second == no_body) return {contact.first_state.velocity - change, {}};
  const double mass = first_mass + second_mass;
  // The lighter of a finite and an infinite mass takes all of the change.
  const auto share_of = [mass](double other) {
    return std::isinf(mass) ? (std::isinf(other) ? 1.0 : 0.0) : other / mass;
  };
  return {contact.first_state.velocity - change * share_of(second_mass),
          contact.second_state.velocity + change * share_of(first_mass)};
}

}  // namespace

Bounce bounce(const Event& contact, double first_mass, double second_mass, double restitution) {
  return rebound(contact, first_mass, second_mass, contact.repeated ? 1.0 : restitution);
}

Bounce settle(const Event& contact, double first_mass, double second_mass, double restitution,
              double resting_speed) {
  const double approach = contact.approach_speed;
  if (!(approach > 0.0)) return rebound(contact, first_mass, second_mass, restitution);
  const bool gains = contact.repeated && restitution < 1.0;
  const double least = gains ? resting_speed : std::min(resting_speed, approach);
  return rebound(contact, first_mass, second_mass, std::max(restitution, least / approach));
}

double least_resting_speed(double contact_tolerance, double acceleration) {
  return std::sqrt(3.0 * contact_tolerance * acceleration);
}

}  // namespace kinesphere
