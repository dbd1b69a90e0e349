// What bodies do when they touch, for callers who want the textbook answer.
#pragma once

#include "kinesphere/event.hpp"

namespace kinesphere {

struct Bounce {
  Vec3 first_velocity;
  Vec3 second_velocity;  ///< zero for a wall
};

/// Velocities after a frictionless central bounce with the given masses (> 0; the second is unused for a
/// wall) and restitution in [0, 1]. Momentum is kept; a `repeated` contact is answered without loss
/// (restitution 1), which keeps inelastic collapse from stopping time (Luding and McNamara's TC model).
Bounce bounce(const Event& contact, double first_mass, double second_mass, double restitution);

}  // namespace kinesphere
