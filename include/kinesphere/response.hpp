// Textbook collision responses: velocities after a contact.
#pragma once

#include "kinesphere/event.hpp"

namespace kinesphere {

struct Bounce {
  Vec3 first_velocity;
  Vec3 second_velocity;  ///< zero for a wall
};

/// Returns the velocities after a frictionless central bounce with the given masses (> 0; the second is
/// ignored for a wall; infinity for a static body, if the other body can move) and restitution in [0, 1].
/// Momentum is conserved. A `repeated` contact loses no energy (restitution 1), which prevents inelastic
/// collapse from stopping time (Luding and McNamara's TC model). Bodies of a `jammed` contact separate with
/// zero speed, whatever the restitution. A mass of 0 is the limit of small masses: that body takes the
/// whole velocity change, and two such bodies take half of it each. A negative mass counts as 0. Finite
/// input therefore gives finite velocities. NaN gives velocities that are NaN, which World::set_velocity()
/// refuses by name.
[[nodiscard]] Bounce bounce(const Event& contact, double first_mass, double second_mass, double restitution);

/// Like bounce(), for bodies that settle in a heap. A `repeated` contact loses energy too, but no two
/// bodies separate more slowly than with `resting_speed` (> 0) or, in a contact that is not repeated or has
/// restitution 1, than their approach speed. Nothing stops entirely: a settled heap keeps making tiny hops
/// of that speed, at a bounded cost: a body that carries n times its own weight has about n g /
/// resting_speed contacts per unit of time. To separate resting from flight, set the world's zeno_interval
/// to the time of such a hop, 2 resting_speed / g, and resting_speed to at least least_resting_speed().
/// Masses: as for bounce().
[[nodiscard]] Bounce settle(const Event& contact, double first_mass, double second_mass, double restitution,
                            double resting_speed);

/// Returns sqrt(3 contact_tolerance acceleration): the speed of a body that falls from the outer edge of
/// the contact tolerance to half of it inside, where the world rechecks the contact. Slower bodies would
/// sink until only the Zeno guard holds them. `acceleration` is the largest of a body, limit and plan
/// together. Each argument must be >= 0.
[[nodiscard]] double least_resting_speed(double contact_tolerance, double acceleration);

}  // namespace kinesphere
