// StepPotential: pairs of bodies whose potential energy changes in steps with the gap between them, as a
// response to events: square wells and shoulders, Lennard-Jones potentials in steps, sticky spheres, bonds.
//
//   const StepPotential well =
//       StepPotential::create({.distances = {0.5}, .energies = {-1.0}}, world.definition()).value();
//   world.set_sensor(0, well.sensor()).value();
//   world.run(60.0, source, [&](const Event& event) { return well.respond(event); }, sink).value();
//
// A chain of bonds: the neighbours in it have a state of their own (World::set_pair_state), and a potential
// that they cannot leave. The sensor has the distances of both.
//
//   const StepPotential bond = StepPotential::create(
//       {.distances = {0.2}, .energies = {0.0}, .outside = infinity}, world.definition()).value();
//   const auto respond = [&](const Event& event) {
//     return event.pair_state == bonded ? bond.respond(event) : well.respond(event);
//   };
//
// Source: Alder and Wainwright, J. Chem. Phys. 31, 459 (1959), appendix; chains: Rapaport, J. Phys. A 11,
// L213 (1978).
#pragma once

#include <vector>

#include "kinesphere/event.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/sensor.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// A potential of steps between two bodies, and the response that follows from it. Copies are independent.
class StepPotential {
 public:
  /// The energy of a pair, as a function of its gap.
  struct Definition {
    /// Gaps between the surfaces of two bodies at which their energy changes (length, > 0), from the nearest
    /// to the farthest.
    std::vector<double> distances{};
    /// energies[k]: potential energy of a pair whose gap is less than distances[k], but not less than the one
    /// before (mass length^2 / time^2, with the masses of BodyDefinition::mass). Infinity repels any speed.
    std::vector<double> energies{};
    /// Energy beyond the last distance. Infinity for a bond, which two that are within it never leave.
    double outside = 0.0;
    /// Of contacts of two bodies and with walls, in [0, 1].
    double restitution = 1.0;
  };
  /// Makes a potential for a world with this definition. Errors: out_of_range or not_finite for distances
  /// that do not ascend from 0 on by more than four times the separation distance and the contact tolerance
  /// of the world, for energies that are not as many, not numbers or -infinity, and for the restitution.
  static Result<StepPotential> create(const Definition& potential, const WorldDefinition& world);

  /// Returns what create() was given.
  const Definition& definition() const { return definition_; }
  /// Returns a sensor with the distances of the potential, which the bodies have to have.
  Sensor sensor() const { return {.distances = definition_.distances}; }
  /// Returns the potential energy of a pair with this gap (length).
  double energy(double gap) const;

  /// Returns the response to an event: at a distance of the potential, the two gain or lose what their energy
  /// changes by along the line between them, or are turned back (Response::turned_back) where they have too
  /// little; at a contact they bounce. Energy and momentum are conserved to rounding, but for the
  /// restitution. Two that are within a distance from the start, or after a teleport, keep their velocities.
  /// Nobody gets to where the energy is infinite. A chain that has come to rest, with contacts that lose
  /// energy, may have more bonds at their full length than can hold at one instant; these give way, by an
  /// eighth of the contact tolerance at a time.
  /// Other events, and other distances, have no effect. Cost: O(log(distances)).
  Response respond(const Event& event) const;

 private:
  StepPotential(const Definition& definition, double crossing)
      : definition_(definition), crossing_(crossing) {}

  Definition definition_;
  /// A first crossing is told at most so far from its distance (length); one of two that have been turned
  /// back less than twice as far.
  double crossing_;
};

}  // namespace kinesphere
