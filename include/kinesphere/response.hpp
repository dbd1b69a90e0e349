// What bodies do when they touch, for callers who want the textbook answer.
#pragma once

#include "kinesphere/event.hpp"

namespace kinesphere {

struct Bounce {
  Vec3 first_velocity;
  Vec3 second_velocity;  ///< zero for a wall
};

/// Velocities after a frictionless central bounce with the given masses (> 0; the second is unused for a
/// wall; infinity for a fixed body, if the other can move) and restitution in [0, 1]. Momentum is kept; a
/// `repeated` contact is answered without loss (restitution 1), which keeps inelastic collapse from stopping
/// time (Luding and McNamara's TC model). Bodies whose contact is `jammed` part with no speed, whatever the
/// restitution.
/// A mass of 0 is the limit of small ones: that body takes all of the change and, where both have none, half
/// of it. A negative mass counts as 0. So the answer to finite numbers is finite. A NaN gives velocities that
/// are NaN, which World::set_velocity refuses by name.
[[nodiscard]] Bounce bounce(const Event& contact, double first_mass, double second_mass, double restitution);

/// As bounce(), for bodies that come to rest in a heap: also a `repeated` contact loses energy, but no two
/// leave each other more slowly than with `resting_speed` (> 0) or, in a contact that is not repeated or of
/// restitution 1, than they came. So nothing stops dead: a heap at rest keeps up tiny hops of that speed, and
/// its cost is bounded: a body that carries n times its own weight has about n g / resting_speed contacts in
/// a unit of time. For rest to be told from flight the world's zeno_interval should be the time of such a
/// hop, 2 resting_speed / g, and resting_speed at least least_resting_speed(). Masses as for bounce().
[[nodiscard]] Bounce settle(const Event& contact, double first_mass, double second_mass, double restitution,
                            double resting_speed);

/// sqrt(3 tolerance acceleration): the speed of a body that falls from the outer edge of the contact
/// tolerance to half of it inside, where the world looks again. Slower ones would sink to where only the Zeno
/// guard holds them. `acceleration` is the largest of a body, limit and plan; both must be >= 0.
[[nodiscard]] double least_resting_speed(double contact_tolerance, double acceleration);

}  // namespace kinesphere
