#include "kinesphere/response.hpp"

namespace kinesphere {

Bounce bounce(const Event& contact, double first_mass, double second_mass, double restitution) {
  const double kept = contact.repeated ? 1.0 : restitution;
  const Vec3 change = contact.normal * ((1.0 + kept) * contact.approach_speed);
  if (contact.second == no_body) return {contact.first_state.velocity - change, {}};
  const double mass = first_mass + second_mass;
  return {contact.first_state.velocity - change * (second_mass / mass),
          contact.second_state.velocity + change * (first_mass / mass)};
}

}  // namespace kinesphere
