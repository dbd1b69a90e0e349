// Textbook collision responses: velocities after a contact.
//
//   for (const Event& event : world.events(60.0, probe)) {
//     if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) continue;
//     const Bounce after = bounce(event, 0.8);
//     set_velocity(event.first, after.first_velocity);
//     if (event.second_can_move()) set_velocity(event.second, after.second_velocity);
//   }
//
// Bodies that are to come to rest upon each other, as stacks and heaps, need settle(): with bounce() they hop
// for ever.
#pragma once

#include <limits>

#include "kinesphere/event.hpp"
#include "kinesphere/run.hpp"

namespace kinesphere {

/// Velocities (length / time) of both bodies after a contact.
struct Bounce {
  Vec3 first_velocity;
  Vec3 second_velocity;  ///< zero for a wall
  /// Of rigid bodies (radians / time); otherwise zero.
  Vec3 first_angular_velocity{};
  Vec3 second_angular_velocity{};

  friend constexpr bool operator==(const Bounce&, const Bounce&) = default;
};

/// Returns the velocities after a frictionless bounce with restitution in [0, 1], and with the masses of the
/// event (BodyDefinition::mass). Momentum is conserved, and of rigid bodies also the angular momentum; with
/// restitution 1, energy is. Bodies that do not approach, as where a contact ends, keep their velocities. A
/// static body, a sleeping one and a wall keep their velocity and turn the other body, whatever its mass. A
/// body of infinite mass keeps its velocity in all other contacts, so two of them do not turn each other. A
/// `repeated` contact loses no energy (restitution 1), which prevents inelastic collapse from stopping time
/// (Luding and McNamara's TC model). In a stack under gravity nearly all slow contacts are repeated, since
/// the lowest body hops upon the ground all the time: such bodies do not come to rest, and their contacts
/// grow more frequent, up to about 5 sqrt(g / contact_tolerance) in a unit of time for each body of a heap.
/// settle() brings them to rest. Bodies of a `jammed` contact separate with zero speed, whatever the
/// restitution. NaN gives velocities that are NaN, which World::set_velocity() refuses by name.
[[nodiscard]] Bounce bounce(const Event& contact, double restitution);

/// Like the above, with these masses (> 0; the second is ignored for a wall) instead of those of the event. A
/// static or sleeping body keeps its velocity all the same. A mass of 0 is the limit of small masses: that
/// body takes the whole velocity change, and two such bodies take half of it each. A negative mass counts as
/// 0. Finite input therefore gives finite velocities.
[[nodiscard]] Bounce bounce(const Event& contact, double first_mass, double second_mass, double restitution);

/// How rough spheres or discs bounce: Walton's model of three parameters.
struct Roughness {
  /// Normal restitution in [0, 1], as for the bounce() above.
  double restitution = 1.0;
  /// Tangential restitution in [-1, 1] of a contact that sticks: what is left of the tangential velocity of
  /// the surfaces there, turned back. -1 is smooth, and 1 loses no energy.
  double tangential_restitution = 1.0;
  /// Coulomb's coefficient of friction (>= 0): a contact slides whose tangential impulse would be more than
  /// this times the normal one.
  double friction = std::numeric_limits<double>::infinity();
  /// Moment of inertia of each body about its diameter, in units of its mass and squared radius (> 0): 2/5
  /// for solid spheres, 2/3 for hollow ones, 1/2 for discs.
  double inertia = 0.4;
};

/// Returns the velocities and angular velocities after a bounce of rough bodies: balls that turn
/// (World::add_rigid_body() with one part, a ball around the position), walls, and static bodies, which keep
/// their velocity and do not turn. Momentum is conserved, angular momentum to the contact tolerance; with
/// both restitutions 1, energy is. A ball that does not turn, of World::add(), cannot be given an angular
/// velocity: run() refuses it by name. Source: Walton, in Particulate Two-Phase Flow (1993), ch. 25; Luding,
/// Granular Matter 10, 235 (2008).
[[nodiscard]] Bounce bounce(const Event& contact, const Roughness& rough);

/// Like bounce(), for bodies that settle in a heap. A `repeated` contact loses energy too, but no two
/// bodies separate more slowly than with `resting_speed` (> 0) or, in a contact that is not repeated or has
/// restitution 1, than their approach speed. Nothing stops entirely: a settled heap keeps making tiny hops
/// of that speed, at a bounded cost: a body that carries n times its own weight has about n g /
/// resting_speed contacts per unit of time. To separate resting from flight, set the world's zeno_interval
/// to the time of such a hop, 2 resting_speed / g, and resting_speed to at least least_resting_speed().
/// Masses: as for bounce().
[[nodiscard]] Bounce settle(const Event& contact, double restitution, double resting_speed);
[[nodiscard]] Bounce settle(const Event& contact, double first_mass, double second_mass, double restitution,
                            double resting_speed);

/// Returns the response, for World::run(), that gives the bodies of the contact these velocities. It leaves
/// out walls, static bodies, sleeping ones and those whose mass in the event is infinite. Bodies that the
/// contact turns get their angular velocities, too.
[[nodiscard]] Response response_of(const Event& contact, const Bounce& after);

/// Returns sqrt(3 contact_tolerance acceleration): the speed of a body that falls from the outer edge of
/// the contact tolerance to half of it inside, where the world rechecks the contact. Slower bodies would
/// sink until only the Zeno guard holds them. `acceleration` is the largest of a body, limit and plan
/// together. Each argument must be >= 0.
[[nodiscard]] double least_resting_speed(double contact_tolerance, double acceleration);

}  // namespace kinesphere
